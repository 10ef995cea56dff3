"""Compiled loops of the colour image: the walk of ``coverage.py``, weighed by colours.

They walk nothing themselves: the record of a sweep says where each edge left each pixel.
Images are ``(rows, columns, channels)``, so that what belongs to one pixel lies together.
"""

from __future__ import annotations

from packwork.compiled import helper, kernel
from packwork.raster.kernels.coverage import ABOVE

TO_WHOLE = 1.5 * 2.0**52
"""Rounds to whole numbers, without a call, what it is added to and taken from again. Derived."""


@helper(forceinline=True)
def _on_line(x, hair):
    """A crossing, put on the line of the grid from which rounding moved it by a hair.

    Whatever crosses a line crosses it at the same x then, and a ring leaves nothing behind.
    """
    line = (x + TO_WHOLE) - TO_WHOLE
    return line if abs(x - line) <= hair else x


@helper(forceinline=True)
def _piece(cell, x_a, x_b, y_a, y_b, width):
    """Pixel of a piece, its two x from the pixel's left side, its area; ``cell`` as recorded.

    The area is what the piece sweeps downward within the pixel: all of it from above.
    """
    is_above = cell <= ABOVE
    row = 0 if is_above else cell // width
    column = ABOVE - cell if is_above else cell - row * width
    # Edges longer than the record is precise stay in their pixels.
    left = min(max(x_a - column, 0.0), 1.0)
    right = min(max(x_b - column, 0.0), 1.0)
    depth = 1.0 if is_above else row + 1 - 0.5 * (y_a + y_b)
    return row * width + column, left, right, (right - left) * depth


@kernel
def deposit(
    points, starts, order, width, x_magic, area_magic, precision,
    cells, leaves, first, excess, buffer,
):  # fmt: skip
    """Deposit each recorded piece in ``buffer``, once a channel, times its ring's ``excess``.

    ``excess``: ``(rings, channels)``; ``buffer``: ``((height + 1) * width, channels)``. Deposits
    are multiples of a power of two, as those of the density are: their sums are exact.
    ``precision``: of the record's parameters, and of x where edges are short.
    """
    channels = excess.shape[1]
    as_pixel = buffer.dtype.type
    edge = 0
    for visit in range(order.shape[0]):
        ring = order[visit]
        begin, end = starts[ring], starts[ring + 1]
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            x_a, y_a = (points[v, 0] + x_magic) - x_magic, points[v, 1]
            x0, dx = x_a, ((points[w, 0] + x_magic) - x_magic) - x_a
            y0, dy = y_a, points[w, 1] - y_a
            hair = precision[0] * abs(dx) + precision[1]
            last = first[edge + 1] - 1
            for k in range(first[edge], last + 1):
                u = float(leaves[k])
                x_b = _on_line(x0 + dx * u, hair) if k < last else x0 + dx
                y_b = y0 + dy * u
                if cells[k] >= 0 or cells[k] <= ABOVE:
                    cell, left, right, area = _piece(cells[k], x_a, x_b, y_a, y_b, width)
                    for c in range(channels):
                        colour = excess[ring, c]
                        swept = (colour * right + area_magic) - area_magic
                        swept -= (colour * left + area_magic) - area_magic
                        here = (colour * area + area_magic) - area_magic
                        buffer[cell, c] += as_pixel(here)
                        buffer[cell + width, c] += as_pixel(swept - here)
                x_a, y_a = x_b, y_b
            edge += 1


@kernel
def accumulate(buffer, background, running, image):
    """Running sum down the columns, on the background; ``buffer`` is cleared behind it.

    ``buffer``: ``(height + 1, width * channels)``; ``background`` and ``running``: one row of the
    image, which is ``(height, width * channels)``.
    """
    height, width = image.shape
    for c in range(width):
        running[c] = 0.0
        buffer[height, c] = 0.0
    for r in range(height):
        for c in range(width):
            running[c] += buffer[r, c]
            image[r, c] = background[c] + running[c]
            buffer[r, c] = 0.0


@kernel
def pullback(points, starts, order, cells, leaves, first, adjoint, excess, gradient):
    """Add the vertex gradients of the sum of adjoint x colour image, exactly.

    As ``coverage.pullback``; the adjoint that a ring feels is that of all channels, each times
    the ring's ``excess``. ``adjoint``: ``(pixels, channels)``. Nothing pulls beyond the image.
    """
    size, channels = adjoint.shape
    edge = 0
    for visit in range(order.shape[0]):
        ring = order[visit]
        begin, end = starts[ring], starts[ring + 1]
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            u0, total, moment = 0.0, 0.0, 0.0
            for k in range(first[edge], first[edge + 1]):
                u1 = float(leaves[k])
                cell = cells[k]
                if 0 <= cell < size:
                    felt = 0.0
                    for c in range(channels):
                        felt += excess[ring, c] * adjoint[cell, c]
                    part = (u1 - u0) * felt
                    total += part
                    moment += part * (u0 + u1)
                u0 = u1
            edge += 1
            moment *= 0.5
            normal_x = points[w, 1] - points[v, 1]
            normal_y = points[v, 0] - points[w, 0]
            gradient[v, 0] += normal_x * (total - moment)
            gradient[v, 1] += normal_y * (total - moment)
            gradient[w, 0] += normal_x * moment
            gradient[w, 1] += normal_y * moment


@kernel
def sum_below(adjoint, running, below):
    """Sums of each column from each pixel down, ``(height + 1, width * channels)``.

    ``running``: one row of float64, in which they are summed.
    """
    height, width = adjoint.shape
    for c in range(width):
        running[c] = 0.0
        below[height, c] = 0.0
    for r in range(height - 1, -1, -1):
        for c in range(width):
            running[c] += adjoint[r, c]
            below[r, c] = running[c]


@kernel
def integrals(
    points, starts, order, width, x_magic, precision, cells, leaves, first, below, totals
):  # fmt: skip
    """Integral of the adjoint inside each ring, once a channel: the transpose of ``deposit``.

    ``below[cell, c]`` is the adjoint's sum from that pixel down, ``((height + 1) * width,
    channels)``; ``totals``: ``(rings, channels)``.
    """
    channels = totals.shape[1]
    edge = 0
    for visit in range(order.shape[0]):
        ring = order[visit]
        begin, end = starts[ring], starts[ring + 1]
        for c in range(channels):
            totals[ring, c] = 0.0
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            x_a, y_a = (points[v, 0] + x_magic) - x_magic, points[v, 1]
            x0, dx = x_a, ((points[w, 0] + x_magic) - x_magic) - x_a
            y0, dy = y_a, points[w, 1] - y_a
            hair = precision[0] * abs(dx) + precision[1]
            last = first[edge + 1] - 1
            for k in range(first[edge], last + 1):
                u = float(leaves[k])
                x_b = _on_line(x0 + dx * u, hair) if k < last else x0 + dx
                y_b = y0 + dy * u
                if cells[k] >= 0 or cells[k] <= ABOVE:
                    cell, left, right, area = _piece(cells[k], x_a, x_b, y_a, y_b, width)
                    rest = right - left - area
                    for c in range(channels):
                        totals[ring, c] += area * below[cell, c] + rest * below[cell + width, c]
                x_a, y_a = x_b, y_b
            edge += 1

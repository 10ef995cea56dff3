"""Compiled loops of the renderer: plain arithmetic on arrays that were checked outside.

The signed area that a directed edge sweeps *downward* adds up, so all edges of all items go into
one accumulation buffer, and one running sum down the columns turns it into the density image.
Every edge is walked once, cell by cell. The walk leaves its deposit in the buffer and writes down
the cells and the parameters at which it left them; the pullback and the area integrals read that
record and never walk again. Deposits are multiples of a small power of two: sums of them are then
exact in the buffer's own precision, in any order, and a closed ring leaves exactly zero behind it.
"""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper, kernel

SPARE_ROWS = 3
"""Rows of the accumulation buffer beyond the image's: one for what falls off its lower
edge, two for the steps in the wrong order that ``_walk`` speaks of. Derived."""

ROWS_AHEAD = 8
"""Rows read before the ring that needs them comes. Larger evicts rows still in use, smaller
is reached too early. Tried."""

PIXELS_PER_LINE = 16
"""float32 pixels in a cache line of 64 bytes. Derived."""

ABOVE = -2
"""Record of a piece above the canvas in column c: ``ABOVE - c``. Other pieces off the
canvas are recorded as -1."""


@helper(forceinline=True)
def _walk(
    x0, y0, x1, y1, u_begin, u_end, cell_x, cell_y, end_x, end_y,
    x_magic, area_magic, width, buffer, cells, leaves, k,
):  # fmt: skip
    """Walk one edge piece that lies on the canvas; return the record's new length.

    Steps are chosen without branches, which no predictor could guess. An edge that ends on a corner
    of the grid may, by rounding, take its last two steps in the wrong order; the pieces after that
    are empty, but the cell may lie one beyond the image, for which ``buffer`` has spare rows.
    """
    cell = cell_y * width + cell_x
    dx = x1 - x0
    dy = y1 - y0
    u_span = u_end - u_begin
    steps_x = abs(end_x - cell_x)
    steps_y = abs(end_y - cell_y)
    step_x = 1 if dx > 0 else -1
    step_y = 1 if dy > 0 else -1
    jump_y = step_y * width
    next_x = float(cell_x + 1 if dx > 0 else cell_x)
    row_bottom = float(cell_y + 1)
    per_x = 1.0 / dx if steps_x > 0 else 2.0
    per_y = 1.0 / dy if steps_y > 0 else 2.0
    t_x = (next_x - x0) * per_x if steps_x > 0 else 2.0
    t_y = (float(cell_y + 1 if dy > 0 else cell_y) - y0) * per_y if steps_y > 0 else 2.0
    pace_x = abs(per_x)
    pace_y = abs(per_y)
    x = x0
    y = y0
    for _ in range(steps_x + steps_y):
        is_x = t_x < t_y
        t = min(t_x, t_y)
        crossing = ((x0 + dx * t) + x_magic) - x_magic
        x_next = next_x if is_x else crossing
        y_next = y0 + dy * t
        swept = x_next - x
        area = (swept * (row_bottom - 0.5 * (y + y_next)) + area_magic) - area_magic
        buffer[cell] += area
        buffer[cell + width] += swept - area
        cells[k] = cell
        leaves[k] = u_begin + t * u_span
        k += 1
        next_x += step_x if is_x else 0.0
        t_x += pace_x if is_x else 0.0
        t_y += 0.0 if is_x else pace_y
        row_bottom += 0.0 if is_x else step_y
        cell += step_x if is_x else jump_y
        x = x_next
        y = y_next
    cell = end_y * width + end_x
    row_bottom = float(end_y + 1)
    swept = x1 - x
    area = (swept * (row_bottom - 0.5 * (y + y1)) + area_magic) - area_magic
    buffer[cell] += area
    buffer[cell + width] += swept - area
    cells[k] = cell
    leaves[k] = u_end
    return k + 1


@helper
def _walk_above(x0, x1, u_begin, u_end, x_magic, width, buffer, cells, leaves, k):
    """Deposit a piece above the canvas: it covers its columns from row 0 on."""
    dx = x1 - x0
    step = 1 if dx > 0 else -1
    column = min(max(int(x0), 0), width - 1)
    last = min(max(int(x1), 0), width - 1)
    x = x0
    while column != last:
        border = float(column + 1 if dx > 0 else column)
        buffer[column] += border - x
        cells[k] = ABOVE - column
        leaves[k] = u_begin + (border - x0) / dx * (u_end - u_begin)
        k += 1
        x = border
        column += step
    buffer[column] += x1 - x
    cells[k] = ABOVE - column
    leaves[k] = u_end
    return k + 1


@helper
def _walk_clipped(
    x0, y0, x1, y1, x_magic, area_magic, width, height, buffer, cells, leaves, k
):  # fmt: skip
    """Walk an edge that may leave the canvas: cut it at the canvas' four lines."""
    dx = x1 - x0
    dy = y1 - y0
    enter = 0.0
    leave = 1.0
    if dx != 0.0:
        u_left = (0.0 - x0) / dx
        u_right = (width - x0) / dx
        enter = min(max(min(u_left, u_right), 0.0), 1.0)
        leave = min(max(max(u_left, u_right), 0.0), 1.0)
    elif x0 < 0.0 or x0 >= width:
        leave = 0.0
    if leave <= enter:
        cells[k] = -1
        leaves[k] = 1.0
        return k + 1
    # The ends are exact on the canvas' lines, so that a ring leaves nothing behind.
    x_enter = x0 if enter == 0.0 else (0.0 if dx > 0.0 else float(width))
    x_leave = x1 if leave == 1.0 else (float(width) if dx > 0.0 else 0.0)
    if enter > 0.0:
        cells[k] = -1
        leaves[k] = enter
        k += 1
    u_top = 2.0
    u_bottom = 2.0
    if dy != 0.0:
        u_top = (0.0 - y0) / dy
        u_bottom = (height - y0) / dy
    u_first = min(max(min(u_top, u_bottom), enter), leave)
    u_second = min(max(max(u_top, u_bottom), enter), leave)
    for piece in range(3):
        u_a = enter if piece == 0 else (u_first if piece == 1 else u_second)
        u_b = u_first if piece == 0 else (u_second if piece == 1 else leave)
        if u_b <= u_a:
            continue
        x_a = x_enter if u_a == enter else ((x0 + dx * u_a) + x_magic) - x_magic
        x_b = x_leave if u_b == leave else ((x0 + dx * u_b) + x_magic) - x_magic
        x_a = min(max(x_a, 0.0), float(width))
        x_b = min(max(x_b, 0.0), float(width))
        y_middle = y0 + dy * 0.5 * (u_a + u_b)
        if y_middle >= height:
            cells[k] = -1
            leaves[k] = u_b
            k += 1
        elif y_middle < 0.0:
            k = _walk_above(x_a, x_b, u_a, u_b, x_magic, width, buffer, cells, leaves, k)
        else:
            y_a = min(max(y0 + dy * u_a, 0.0), height)
            y_b = min(max(y0 + dy * u_b, 0.0), height)
            k = _walk(
                x_a, y_a, x_b, y_b, u_a, u_b,
                min(int(x_a), width - 1), min(int(y_a), height - 1),
                min(int(x_b), width - 1), min(int(y_b), height - 1),
                x_magic, area_magic, width, buffer, cells, leaves, k,
            )  # fmt: skip
    if leave < 1.0:
        cells[k] = -1
        leaves[k] = 1.0
        k += 1
    return k


@helper
def _lowest_row(points, begin, end, height):
    """Row just below a ring, and a few more, on the canvas."""
    lowest = 0.0
    for v in range(begin, end):
        lowest = max(lowest, points[v, 1])
    return min(int(min(lowest, float(height))) + ROWS_AHEAD, height)


@helper
def _first_row(points, starts, order, height):
    """Row at which the first ring begins, on the canvas."""
    if order.shape[0] == 0 or points.shape[0] == 0:
        return 0
    y = points[min(starts[order[0]], points.shape[0] - 1), 1]
    return int(min(max(y, 0.0), float(height)))


@helper(forceinline=True)
def _fetch(image, reached, until):
    """Read one pixel of each cache line from ``reached`` to ``until``; return their sum.

    Edges wander down columns, which no hardware foresees. The sum has no other use than to keep the
    loop.
    """
    total = 0.0
    for pixel in range(reached, until, PIXELS_PER_LINE):
        total += image[pixel]
    return total


@kernel
def sweep(
    points, starts, order, descends, height, width, x_magic, area_magic,
    buffer, cells, leaves, first,
):  # fmt: skip
    """Deposit every edge in ``buffer`` and record its walk.

    Rings are visited in ``order``, which changes no result; if it ``descends`` from top
    to bottom, rows are fetched ahead. ``buffer`` is flat, height + ``SPARE_ROWS`` rows of
    ``width``, zero on entry. ``first[edge]`` receives where the record of an edge
    begins, edges counted as they are visited.
    """
    # A plain 0 has a type of its own, for which what is called would be compiled once more.
    k = np.int64(0)
    edge = 0
    reached = _first_row(points, starts, order, height) * width
    fetched = 0.0
    for visit in range(order.shape[0]):
        begin = starts[order[visit]]
        end = starts[order[visit] + 1]
        if descends:
            until = _lowest_row(points, begin, end, height) * width
            fetched += _fetch(buffer, reached, until)
            reached = max(reached, until)
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            first[edge] = k
            edge += 1
            x0 = (points[v, 0] + x_magic) - x_magic
            x1 = (points[w, 0] + x_magic) - x_magic
            y0 = points[v, 1]
            y1 = points[w, 1]
            if (
                min(x0, x1) < 0.0
                or max(x0, x1) >= width
                or min(y0, y1) < 0.0
                or max(y0, y1) >= height
            ):
                k = _walk_clipped(
                    x0, y0, x1, y1, x_magic, area_magic, width, height, buffer, cells, leaves, k
                )
                continue
            cell_x = int(x0)
            cell_y = int(y0)
            end_x = int(x1)
            end_y = int(y1)
            if cell_x == end_x and cell_y == end_y:
                cell = cell_y * width + cell_x
                swept = x1 - x0
                area = (swept * (cell_y + 1 - 0.5 * (y0 + y1)) + area_magic) - area_magic
                buffer[cell] += area
                buffer[cell + width] += swept - area
                cells[k] = cell
                leaves[k] = 1.0
                k += 1
            else:
                k = _walk(
                    x0, y0, x1, y1, 0.0, 1.0, cell_x, cell_y, end_x, end_y,
                    x_magic, area_magic, width, buffer, cells, leaves, k,
                )  # fmt: skip
    first[edge] = k
    return fetched


@kernel
def accumulate(buffer, density):
    """Running sum down the columns; ``buffer`` (height + 1 rows) is cleared behind it."""
    height = density.shape[0]
    width = density.shape[1]
    for c in range(width):
        density[0, c] = buffer[0, c]
        buffer[0, c] = 0.0
    for r in range(1, height):
        for c in range(width):
            density[r, c] = density[r - 1, c] + buffer[r, c]
            buffer[r, c] = 0.0
    for c in range(width):
        buffer[height, c] = 0.0


@kernel
def pullback(
    points, starts, order, descends, width, cells, leaves, first, adjoint, beyond, gradient
):  # fmt: skip
    """Vertex gradients of the sum of adjoint x coverage, exactly.

    For an edge a -> b with outward normal n (unnormalised):
    dL/da = n * integral of A (1 - u) du, dL/db = n * integral of A u du.
    """
    size = adjoint.shape[0]
    edge = 0
    reached = _first_row(points, starts, order, size // width) * width
    fetched = 0.0
    for visit in range(order.shape[0]):
        begin = starts[order[visit]]
        end = starts[order[visit] + 1]
        for v in range(begin, end):
            gradient[v, 0] = 0.0
            gradient[v, 1] = 0.0
        if descends:
            until = _lowest_row(points, begin, end, size // width) * width
            fetched += _fetch(adjoint, reached, until)
            reached = max(reached, until)
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            u0 = 0.0
            total = 0.0
            moment = 0.0
            for k in range(first[edge], first[edge + 1]):
                u1 = float(leaves[k])
                cell = cells[k]
                part = (u1 - u0) * (adjoint[cell] if 0 <= cell < size else beyond)
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
    return fetched


@kernel
def ring_integrals(points, starts, order, cells, leaves, first, image, prefix, totals):
    """Integral of a pixelwise constant image over each ring's inside, by Green's theorem.

    ``prefix[r, c]`` is the sum of column c above row r, row ``height`` included.
    """
    height = image.shape[0]
    width = image.shape[1]
    edge = 0
    for visit in range(order.shape[0]):
        begin = starts[order[visit]]
        end = starts[order[visit] + 1]
        total = 0.0
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            dx = points[w, 0] - points[v, 0]
            dy = points[w, 1] - points[v, 1]
            u0 = 0.0
            for k in range(first[edge], first[edge + 1]):
                u1 = float(leaves[k])
                cell = cells[k]
                if 0 <= cell < height * width:
                    row = cell // width
                    column = cell - row * width
                    y = points[v, 1] + dy * 0.5 * (u0 + u1)
                    above = prefix[row, column] + (y - row) * image[row, column]
                    total += dx * (u1 - u0) * (prefix[height, column] - above)
                elif cell <= ABOVE:
                    total += dx * (u1 - u0) * prefix[height, ABOVE - cell]
                u0 = u1
            edge += 1
        totals[order[visit]] = total


@kernel
def record_bounds(points, starts, height, width, rows, bounds):
    """Write first and last rows of rings ``(rings, 2)``, and how long their records are at most.

    A walk crosses a grid line once for each pixel it spans; eight cover cuts and rounding of an
    edge. Returns the sum of the bounds.
    """
    total = 0.0
    for ring in range(starts.shape[0] - 1):
        begin, end = starts[ring], starts[ring + 1]
        top, bottom, spanned = float(height), 0.0, 0.0
        if end > begin:
            last_x = min(max(points[end - 1, 0], 0.0), float(width))
            last_y = min(max(points[end - 1, 1], 0.0), float(height))
        for v in range(begin, end):
            x = min(max(points[v, 0], 0.0), float(width))
            y = min(max(points[v, 1], 0.0), float(height))
            spanned += abs(x - last_x) + abs(y - last_y)
            top, bottom = min(top, y), max(bottom, y)
            last_x, last_y = x, y
        rows[ring, 0], rows[ring, 1] = int(top), int(bottom)
        bounds[ring] = int(spanned) + 8 * (end - begin) + 1
        total += bounds[ring]
    return total

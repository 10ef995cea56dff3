"""The default losses in one or two passes over the image, and object-space sums."""

from __future__ import annotations

import math

from packwork.compiled import helper, kernel


@kernel
def gaps(buffer, container, running, line, empty, factor):
    """Empty container summed over blocks of ``factor`` x ``factor`` pixels.

    ``buffer`` is the accumulation buffer, left as it is; ``running`` and ``line`` are
    one row of scratch each.
    """
    running[:] = 0.0
    line[:] = 0.0
    height = container.shape[0]
    for r in range(height):
        _add_gaps(buffer[r], container[r], running, line)
        if (r + 1) % factor == 0 or r + 1 == height:
            _fold(line, factor, empty[r // factor])
            line[:] = 0.0


@kernel
def adjoint(
    buffer, container, running, line, emphasis, factor, outside, excess, reward, one, result
):
    """Running sum, clearing and the adjoint of the fused losses, row by row.

    ``buffer`` has one row more than the image. ``emphasis`` holds what covering a pixel
    pays beyond ``reward``, per block; ``one`` is the density above which a pixel is
    covered twice. All weights have the images' dtype, so that the loop stays in it.
    """
    running[:] = 0.0
    for r in range(container.shape[0]):
        if r % factor == 0:
            _unfold(emphasis[r // factor], factor, reward, line)
        _price(buffer[r], container[r], running, line, outside, excess, one, result[r])
    buffer[container.shape[0]] = 0.0


@helper
def _add_gaps(swept, container, running, line):
    """Next row of the running sum; ``line`` gains its empty container."""
    for c in range(running.shape[0]):
        covered = running[c] + swept[c]
        running[c] = covered
        gap = container[c] - container[c] * covered
        line[c] += max(gap, 0 * gap)


@helper
def _price(swept, container, running, line, outside, excess, one, row):
    """Next row of the running sum to its adjoint; ``line`` is what covering pays."""
    for c in range(running.shape[0]):
        density = running[c] + swept[c]
        running[c] = density
        swept[c] = 0.0
        inside = container[c]
        base = outside - outside * inside
        row[c] = base + (excess if density > one else -line[c] * inside)


@helper
def _fold(line, factor, blocks):
    """Sum ``line`` over blocks of ``factor``; the last may be cut off.

    Neighbouring sums in the inner loop do not wait for each other.
    """
    width = line.shape[0]
    blocks[:] = 0.0
    for k in range(factor):
        for b in range((width - k + factor - 1) // factor):
            blocks[b] += line[b * factor + k]


@helper
def _unfold(blocks, factor, reward, line):
    """Write each block's value plus ``reward`` to all of its pixels."""
    width = line.shape[0]
    for k in range(min(factor, width)):
        for b in range((width - k + factor - 1) // factor):
            line[b * factor + k] = reward + blocks[b]


@kernel
def steepen(empty, per_inside, slope):
    """Derivative of (empty * per_inside) ** 6 times ``slope``, in place of ``empty``."""
    for r in range(empty.shape[0]):
        for c in range(empty.shape[1]):
            share = empty[r, c] * per_inside[r, c]
            square = share * share
            empty[r, c] = slope * square * square * share * per_inside[r, c]


@kernel
def recall(x, y, areas, px_per_cu, inside, nearest_row, nearest_column, by_x, by_y):
    """Area-weighted distance, in pixels, of each centre from the container.

    ``by_x`` and ``by_y`` receive its derivative; returns the sum.
    """
    rows = inside.shape[0]
    columns = inside.shape[1]
    total = 0.0
    for i in range(x.shape[0]):
        x_px = x[i] * px_per_cu
        y_px = y[i] * px_per_cu
        column = int(min(max(x_px, 0.0), columns - 1.0))
        row = int(min(max(y_px, 0.0), rows - 1.0))
        by_x[i] = 0.0
        by_y[i] = 0.0
        if inside[row, column] and 0.0 <= x_px < columns and 0.0 <= y_px < rows:
            continue
        away_x = x_px - nearest_column[row, column] - 0.5
        away_y = y_px - nearest_row[row, column] - 0.5
        distance = math.sqrt(away_x * away_x + away_y * away_y)
        if distance > 0.0:
            by_x[i] = areas[i] * away_x / distance
            by_y[i] = areas[i] * away_y / distance
            total += areas[i] * distance
    return total


@kernel
def repel(x, y, kinds, order, reach, by_x, by_y):
    """Sum of (1 - distance / reach) ** 2 over pairs of one kind nearer than their reach.

    ``order`` sorts the items by kind; a pair's reach is the sum of two. ``by_x`` and
    ``by_y``, zero at first, receive the derivative.
    """
    total = 0.0
    for a in range(order.shape[0]):
        i = order[a]
        for b in range(a + 1, order.shape[0]):
            j = order[b]
            if kinds[j] != kinds[i]:
                break
            away_x = x[i] - x[j]
            away_y = y[i] - y[j]
            distance = math.sqrt(away_x * away_x + away_y * away_y)
            near = 1.0 - distance / (reach[i] + reach[j])
            if near <= 0.0 or distance == 0.0:
                total += max(near, 0.0)
                continue
            total += near * near
            push = -2.0 * near / ((reach[i] + reach[j]) * distance)
            by_x[i] += push * away_x
            by_y[i] += push * away_y
            by_x[j] -= push * away_x
            by_y[j] -= push * away_y
    return total

"""Running sums over windows; distance transforms; connected components."""

from __future__ import annotations

import numpy as np

from packwork.compiled import helper, kernel


@kernel
def box_sum_across(image, reach, out):
    """Sum of the ``2 reach + 1`` pixels about each one, along the rows."""
    height, width = image.shape
    last = height - 1
    # Each sum waits for the one before in its row, so four rows go at once.
    for p in range(0, height, 4):
        q, r, s = min(p + 1, last), min(p + 2, last), min(p + 3, last)
        first, second, third, fourth = 0.0, 0.0, 0.0, 0.0
        for c in range(min(reach, width)):
            first += image[p, c]
            second += image[q, c]
            third += image[r, c]
            fourth += image[s, c]
        for c in range(width):
            enters, leaves = c + reach, c - reach - 1
            if enters < width:
                first += image[p, enters]
                second += image[q, enters]
                third += image[r, enters]
                fourth += image[s, enters]
            if leaves >= 0:
                first -= image[p, leaves]
                second -= image[q, leaves]
                third -= image[r, leaves]
                fourth -= image[s, leaves]
            out[p, c], out[q, c], out[r, c], out[s, c] = first, second, third, fourth


@kernel
def box_sum_down(image, reach, factor, out):
    """Sum of the ``2 reach + 1`` pixels about each one, down the columns, times ``factor``.

    Whole rows are added and taken off, so that the loop is over neighbours in memory.
    """
    height, width = image.shape
    for c in range(width):
        out[0, c] = 0.0
    for r in range(min(reach + 1, height)):
        for c in range(width):
            out[0, c] += image[r, c]
    for r in range(1, height):
        enters = r + reach
        leaves = r - reach - 1
        for c in range(width):
            total = out[r - 1, c]
            if enters < height:
                total += image[enters, c]
            if leaves >= 0:
                total -= image[leaves, c]
            out[r, c] = total
    for r in range(height):
        for c in range(width):
            out[r, c] *= factor


@kernel
def distance_to(mask, out):
    """Distance of each pixel from the nearest True one, of which there is at least one."""
    height, width = mask.shape
    rows = _nearest_in_columns(mask)
    away, columns, stack = np.empty((3, width), np.int64)
    for r in range(height):
        first = 0
        while first < width:
            last = first + 1
            while last < width and not mask[r, last]:
                last += 1
            # Between two True pixels of a row none is nearer that lies beyond them.
            beyond = min(last + 1, width)
            if mask[r, first] and last == first + 1:
                out[r, first] = 0.0
            else:
                _nearest_in_row(rows[r, first:beyond], r, away, columns, stack)
                for c in range(beyond - first):
                    across = columns[c] - c
                    out[r, first + c] = np.sqrt(np.float64(away[columns[c]] + across * across))
            first = last


@kernel
def nearest_to(mask, nearest_row, nearest_column):
    """Row and column of the True pixel, one at least, that is nearest to each."""
    height, width = mask.shape
    rows = _nearest_in_columns(mask)
    away, columns, stack = np.empty((3, width), np.int64)
    for r in range(height):
        _nearest_in_row(rows[r], r, away, columns, stack)
        for c in range(width):
            nearest_row[r, c] = rows[r, columns[c]]
            nearest_column[r, c] = columns[c]


@helper
def _nearest_in_columns(mask):
    """Row of the True pixel nearest in each pixel's own column, the upper of two; -1 for none."""
    height, width = mask.shape
    rows = np.empty((height, width), np.int32)
    for r in range(height):
        for c in range(width):
            rows[r, c] = r if mask[r, c] else (rows[r - 1, c] if r > 0 else -1)
    for r in range(height - 2, -1, -1):
        for c in range(width):
            above, below = rows[r, c], rows[r + 1, c]
            if below > r and (above < 0 or below - r < r - above):
                rows[r, c] = below
    return rows


@helper
def _nearest_in_row(rows, r, away, columns, stack):
    """Column in which the True pixel nearest to each pixel of row ``r`` lies, in ``columns``.

    ``rows``: of the nearest in each column; ``away``: squared distances down columns, overwritten,
    as is ``stack``: columns that are nearest to some point of the row.
    """
    width = len(rows)
    for c in range(width):
        down = np.int64(rows[c] - r)
        away[c] = -1 if rows[c] < 0 else down * down
    last = -1
    for c in range(width):
        if away[c] < 0:
            continue
        while last >= 1 and _is_hidden(stack[last - 1], stack[last], c, away):
            last -= 1
        last += 1
        stack[last] = c
    k = 0
    for c in range(width):
        while k < last:
            here, after = stack[k] - c, stack[k + 1] - c
            if away[stack[k]] + here * here <= away[stack[k + 1]] + after * after:
                break
            k += 1
        columns[c] = stack[k]


@helper
def _is_hidden(left, middle, right, away):
    """True if no point of the row is nearest to the middle one of three columns."""
    a, b = middle - left, right - middle
    return (a + b) * (away[middle] - a * b) > b * away[left] + a * away[right]


@kernel
def label_components(mask, labels):
    """Number components of a mask, joined by sides, in ``labels``, 0 before; returns how many."""
    height, width = mask.shape
    waiting = np.empty(mask.size, np.int64)
    count = 0
    for first in range(mask.size):
        if not mask[first // width, first % width] or labels[first // width, first % width]:
            continue
        count += 1
        labels[first // width, first % width] = count
        waiting[0] = first
        many = 1
        while many > 0:
            many -= 1
            r, c = waiting[many] // width, waiting[many] % width
            for side in range(4):
                i = r + (side == 0) - (side == 1)
                j = c + (side == 2) - (side == 3)
                is_new = 0 <= i < height and 0 <= j < width and mask[i, j] and labels[i, j] == 0
                if is_new:
                    labels[i, j] = count
                    waiting[many] = i * width + j
                    many += 1
    return count


@kernel
def thin(image, removable, rows, cols):
    """Clear pixels of ``image`` (0 or 1, framed by zeros) in two turns until none is removable.

    ``removable[turn, code]`` says which go, by their eight neighbours: bit 0 is the one above,
    the others follow clockwise; none goes among eight. ``rows`` and ``cols`` hold the pixels that
    are 1, and are spent.
    """
    # Only those at an edge can go: inside, pixels wait until the edge comes to them.
    is_at_edge = np.zeros(image.shape, np.bool_)
    left = 0
    for k in range(rows.size):
        r, c = rows[k], cols[k]
        if _neighbours(image, r, c) != 255:
            is_at_edge[r, c] = True
            rows[left], cols[left] = r, c
            left += 1
    gone = np.empty((rows.size, 2), np.int64)
    turns_without_change = 0
    turn = 0
    while turns_without_change < 2:
        removed = 0
        kept = 0
        for k in range(left):
            r, c = rows[k], cols[k]
            if removable[turn, _neighbours(image, r, c)]:
                gone[removed, 0], gone[removed, 1] = r, c
                removed += 1
            else:
                rows[kept], cols[kept] = r, c
                kept += 1
        for k in range(removed):
            image[gone[k, 0], gone[k, 1]] = 0
        left = kept
        for k in range(removed):
            for r in range(gone[k, 0] - 1, gone[k, 0] + 2):
                for c in range(gone[k, 1] - 1, gone[k, 1] + 2):
                    if image[r, c] and not is_at_edge[r, c]:
                        is_at_edge[r, c] = True
                        rows[left], cols[left] = r, c
                        left += 1
        turns_without_change = 0 if removed else turns_without_change + 1
        turn = 1 - turn


@helper
def _neighbours(image, r, c):
    """Eight neighbours of a pixel as bits."""
    code = image[r - 1, c] | image[r - 1, c + 1] << 1 | image[r, c + 1] << 2
    code |= image[r + 1, c + 1] << 3 | image[r + 1, c] << 4 | image[r + 1, c - 1] << 5
    return code | image[r, c - 1] << 6 | image[r - 1, c - 1] << 7

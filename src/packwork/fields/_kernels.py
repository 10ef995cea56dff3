"""Running sums over windows."""

from __future__ import annotations

from packwork.compiled import kernel


@kernel
def box_sum_across(image, reach, out):
    """Sum of the ``2 reach + 1`` pixels about each one, along the rows."""
    height, width = image.shape
    for r in range(height):
        total = 0.0
        for c in range(min(reach, width)):
            total += image[r, c]
        for c in range(width):
            if c + reach < width:
                total += image[r, c + reach]
            if c - reach > 0:
                total -= image[r, c - reach - 1]
            out[r, c] = total


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

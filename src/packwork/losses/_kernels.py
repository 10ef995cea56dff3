"""The built-in losses in one pass over the image."""

from __future__ import annotations

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def linear_adjoint(buffer, container, running, adjoint, outside, excess, reward, one):
    """Running sum, clearing and the adjoint of containment, overlap and filling at once.

    ``buffer`` is the accumulation buffer (one row more than the image), ``running`` one
    row of scratch; ``one`` is the density above which a pixel is covered twice. All
    weights have the images' dtype, so that the loop stays in it.
    """
    height = adjoint.shape[0]
    width = adjoint.shape[1]
    for c in range(width):
        running[c] = 0.0
    for r in range(height):
        for c in range(width):
            density = running[c] + buffer[r, c]
            running[c] = density
            buffer[r, c] = 0.0
            inside = container[r, c]
            base = outside - outside * inside
            adjoint[r, c] = base + (excess if density > one else -reward * inside)
    for c in range(width):
        buffer[height, c] = 0.0

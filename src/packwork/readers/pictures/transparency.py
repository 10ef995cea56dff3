"""Alpha channels and enclosed white patches: whether they shape a picture."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.pictures.decode import Pixels
from packwork.readers.reading import notice

LEAST_WHITE = 240
"""Each channel of white, of 255, at least, in pictures and of sheets behind SVGs. Smaller takes
pale tiles for paper, larger keeps ivory paper. Chosen."""

MOST_WHITE = 1 / 3
"""Share of what is painted that white patches are holes up to. More are the body of a drawing
in outlines. Chosen."""


def without_enclosed_white(pixels: Pixels, solid: FloatArray) -> FloatArray:
    """Opacities, those of white patches that other paint surrounds brought to nothing.

    Parameters
    ----------
    solid
        Opacities of the pixels, 0..1.

    Examples
    --------
    >>> seal = np.zeros((9, 9, 4), np.uint8); seal[1:8, 1:8, 3] = 255; seal[4, 4, :3] = 255
    >>> float(without_enclosed_white(seal, seal[:, :, 3] / 255).sum())
    48.0
    """
    from scipy.ndimage import binary_dilation, label, maximum_filter

    least = pixels[:, :, :3].min(axis=2)
    painted = solid >= 0.5
    white = painted & (least >= LEAST_WHITE)
    if not white.any():
        return solid
    labels, count = label(white, np.ones((3, 3)))
    beside = np.pad(~painted, 1, constant_values=True)
    near_clear = binary_dilation(beside, np.ones((3, 3)))[1:-1, 1:-1]
    is_open = np.zeros(count + 1, dtype=bool)
    is_open[np.unique(labels[near_clear])] = True
    holes = white & ~is_open[labels]
    if not 0 < np.count_nonzero(holes) <= MOST_WHITE * np.count_nonzero(painted):
        return solid
    result = np.where(holes, 0.0, solid)
    # The pixels of the edge mix white and the paint beside it.
    edge = binary_dilation(holes, np.ones((3, 3))) & ~holes
    distance = 255.0 - least
    result[edge] *= distance[edge] / np.maximum(maximum_filter(distance, 3)[edge], 1.0)
    return result


LEAST_CLEAR_OF_ITEM = 0.001
"""Share of an item's picture that is clear where its transparency decides. Larger takes the
rounded corners of a playing card, 0.15 % of it, for an accident, and its white rim for paper;
smaller lets a few translucent pixels keep the paper round a drawing. Chosen."""

LEAST_CLEAR_OF_MASK = 0.01
"""The same of a mask. Larger passes over small windows in a plate; smaller lets the rounded
corners of a page hide what is painted on it. Chosen."""

FAINT_SHARE = 0.05
"""Painted area that is fainter than the threshold, edges left out, as a share of what is
inside, from which it is told. Larger is silent about shadows, smaller speaks of soft edges.
Chosen."""

_FAINTEST = 1 / 255
_SEEN = 10 / 255
_EDGE_PX = 3


def solidity(pixels: Pixels) -> FloatArray:
    """Opacity 0..1 of RGBA pixels, the most opaque one taken for 1: a faint shape is a shape.

    Examples
    --------
    >>> solidity(np.array([[[0, 0, 0, 100], [0, 0, 0, 50]]], np.uint8)).tolist()
    [[1.0, 0.5]]
    """
    alpha = pixels[:, :, 3].astype(np.float64)
    return np.asarray(alpha / max(float(alpha.max()), 255 * _FAINTEST))


def decides(solid: FloatArray, least_clear: float) -> bool:
    """Whether a real share of a picture is clear.

    Parameters
    ----------
    solid
        As :func:`solidity` gave it.
    least_clear
        Share of the pixels that are less than half as opaque as the most opaque one.

    Examples
    --------
    >>> page = np.ones((20, 20)); page[0, 0] = 0
    >>> decides(page, LEAST_CLEAR_OF_ITEM), decides(page, LEAST_CLEAR_OF_MASK)
    (True, False)
    """
    return float(np.count_nonzero(solid < 0.5)) >= least_clear * solid.size


def raised(solid: FloatArray, threshold: float) -> FloatArray:
    """Opacities ``[row, col]`` with the threshold brought to one half, where contours run.

    Examples
    --------
    >>> raised(np.array([0.0, 0.1, 0.2, 1.0]), 0.2).tolist()
    [0.0, 0.25, 0.5, 1.0]
    """
    if threshold == 0.5:
        return solid
    return np.interp(solid, [0.0, threshold, 1.0], [0.0, 0.5, 1.0])


def tell_what_is_faint(solid: FloatArray, threshold: float) -> None:
    """Notice that a real share of opacities ``[row, col]`` is fainter than the threshold."""
    from scipy.ndimage import binary_dilation

    inside = solid >= threshold
    faint = (solid > _SEEN) & ~inside
    if np.count_nonzero(faint) <= FAINT_SHARE * np.count_nonzero(inside):
        return
    faint &= ~binary_dilation(inside, np.ones((3, 3)), _EDGE_PX)
    share = float(np.count_nonzero(faint)) / max(1.0, float(np.count_nonzero(inside)))
    if share > FAINT_SHARE:
        notice(
            f"paints {share:.0%} of its area fainter than {threshold:g}, outside of its outline, "
            "as shadows are; a smaller --alpha-threshold takes it in"
        )

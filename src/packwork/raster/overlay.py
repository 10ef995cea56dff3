"""Pictures laid over each other at any place, turn and size: frames of a film.

A renderer of vectors takes ten times as long for the same frame. Each drawing is rendered
once, twice as fine as it is ever shown, and blurred by as much as a pixel of the frame, with
coarser copies of it beside; a frame takes one sample a pixel of the one that fits: mipmaps
(L. Williams, "Pyramidal parametrics", SIGGRAPH 1983, doi:10.1145/800059.801126).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.raster.kernels import overlay as kernels

Picture = npt.NDArray[np.uint8]
"""``(rows, columns, 4)``: red, green, blue and alpha; premultiplied where it says so."""

FINENESS = 2.0
"""Pixels of a texture per pixel of the frame, about: a texture is blurred by two of its pixels, so
that one sample sees all. More: edges shimmer; fewer: they blur. Derived."""

_EDGE = 2
"""Clear pixels round each level: one for the blur, one for the outermost sample."""

_SHIFT = _EDGE - 0.5
"""Where a level's own first pixel lies in it; each blurred pixel lies between two."""


@dataclass(frozen=True, eq=False)
class Texture:
    """One drawing in several sizes.

    ``levels``: premultiplied and blurred pictures, each half as fine as the one before, with a
    clear edge; ``matrix``: from the drawing's units to the pixels of the first level, without its
    edge.
    """

    levels: tuple[Picture, ...]
    matrix: FloatArray

    def lay(self, image: Picture, place: FloatArray) -> None:
        """Draw it over ``image``, premultiplied; ``place``: from the drawing's units to pixels."""
        if abs(np.linalg.det(place[:, :2])) < 1e-12:
            return
        inverse = affine.compose(self.matrix, affine.inverse(place))
        fineness = float(np.linalg.norm(inverse[:, :2], 2))
        level = min(max(round(np.log2(fineness / FINENESS)), 0), len(self.levels) - 1)
        inverse /= 2**level
        # Each level has an edge of its own.
        inverse[:, 2] += _SHIFT
        kernels.lay(image, self.levels[level], inverse)


def texture_of(picture: Picture, matrix: FloatArray) -> Texture:
    """Texture of a picture whose alpha is not premultiplied; ``matrix``: of the drawing's units.

    >>> dot = np.full((4, 4, 4), 255, dtype=np.uint8)
    >>> texture = texture_of(dot, affine.identity())
    >>> [level.shape[:2] for level in texture.levels]
    [(7, 7), (5, 5), (4, 4)]
    >>> image = np.zeros((4, 4, 4), dtype=np.uint8)
    >>> texture.lay(image, affine.similarity(1.0, 1.0, 0.0, 0.5))
    >>> image[:, :, 3].tolist()
    [[0, 0, 0, 0], [0, 255, 255, 0], [0, 255, 255, 0], [0, 0, 0, 0]]
    """
    levels = [premultiplied(picture)]
    while max(levels[-1].shape[:2]) > 1:
        levels.append(_halved(levels[-1]))
    return Texture(tuple(_blurred(level) for level in levels), matrix)


def _blurred(picture: Picture) -> Picture:
    """Means of each two by two neighbours, with a clear edge."""
    edged = np.pad(picture, ((_EDGE, _EDGE), (_EDGE, _EDGE), (0, 0))).astype(np.uint16)
    total = edged[1:, 1:] + edged[:-1, 1:] + edged[1:, :-1] + edged[:-1, :-1]
    return ((total + 2) // 4).astype(np.uint8)


def premultiplied(picture: Picture) -> Picture:
    """Colours times alpha.

    >>> premultiplied(np.array([[[200, 100, 0, 51]]], dtype=np.uint8)).tolist()
    [[[40, 20, 0, 51]]]
    """
    alpha = picture[:, :, 3:].astype(np.uint16)
    colours = (picture[:, :, :3] * alpha + 127) // 255
    return np.concatenate([colours.astype(np.uint8), picture[:, :, 3:]], axis=2)


def straight(picture: Picture) -> Picture:
    """Colours over alpha: the inverse of :func:`premultiplied`, but for rounding.

    >>> straight(np.array([[[40, 20, 0, 51], [0, 0, 0, 0]]], dtype=np.uint8)).tolist()
    [[[200, 100, 0, 51], [0, 0, 0, 0]]]
    """
    alpha = picture[:, :, 3:].astype(np.float32)
    colours = np.divide(
        255.0 * picture[:, :, :3], alpha, out=np.zeros_like(picture[:, :, :3], np.float32),
        where=alpha > 0,
    )  # fmt: skip
    rounded = np.minimum(colours + 0.5, 255.0).astype(np.uint8)
    return np.concatenate([rounded, picture[:, :, 3:]], axis=2)


def _halved(picture: Picture) -> Picture:
    """Means of two by two pixels; an odd edge is clear beyond."""
    rows, columns = picture.shape[:2]
    even = np.pad(picture, ((0, rows % 2), (0, columns % 2), (0, 0))).astype(np.uint16)
    total = even[0::2, 0::2] + even[1::2, 0::2] + even[0::2, 1::2] + even[1::2, 1::2]
    return ((total + 2) // 4).astype(np.uint8)

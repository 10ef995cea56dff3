"""State in which the content of a PDF paints (ISO 32000-1, 8.4 and 9.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine

NOWHERE = np.zeros((2, 2))
_EVERYWHERE = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])

_PAINTS = (frozenset({0, 2, 4, 6}), frozenset({1, 2, 5, 6}))
"""Modes of text in which letters are filled, and in which they are stroked."""


@final
@dataclass(frozen=True)
class Graphics:
    """Numbers of the graphics state by which a page is looked at.

    ``matrix``: from user space to the page, points; ``window``: box of the clip on the page.
    ``width``: of lines. ``spaces``: names of the colour spaces of fills and of strokes.
    ``em``, ``letters``: size of the font, and scale of the text matrix; ``mode``: of text.
    """

    matrix: FloatArray
    window: FloatArray = field(default_factory=lambda: _EVERYWHERE)
    width: float = 1.0
    spaces: tuple[str, str] = ("grey", "grey")
    em: float = 0.0
    letters: float = 1.0
    mode: int = 0

    def after(self, name: str, operands: Any) -> Graphics:
        """State after an operator that sets a number or a matrix; the same after any other.

        Examples
        --------
        >>> Graphics(affine.identity()).after("w", [3]).width
        3.0
        """
        if name == "cm":
            return replace(self, matrix=affine.compose(self.matrix, matrix_of(operands)))
        if name == "w":
            return replace(self, width=float(operands[0]))
        if name == "Tf":
            return replace(self, em=float(operands[1]))
        if name == "Tr":
            return replace(self, mode=int(operands[0]))
        if name == "BT":
            return replace(self, letters=1.0)
        if name == "Tm":
            return replace(self, letters=scale_of(matrix_of(operands)))
        return self

    def bounds(self, points: Sequence[FloatArray]) -> FloatArray:
        """``(2, 2)`` corners of the box of points on the page, as far as the clip lets it through.

        Examples
        --------
        >>> Graphics(affine.identity()).bounds([corners(1, 2, 3, 4)]).tolist()
        [[1.0, 2.0], [3.0, 4.0]]
        """
        placed = affine.apply(self.matrix, np.concatenate(points))
        low = np.maximum(placed.min(axis=0), self.window[0])
        return np.array([low, np.maximum(np.minimum(placed.max(axis=0), self.window[1]), low)])

    @property
    def line_pt(self) -> float:
        """Width of lines on the page."""
        return self.width * scale_of(self.matrix)

    @property
    def em_pt(self) -> float:
        """Height of an em of text on the page."""
        return self.em * self.letters * scale_of(self.matrix)

    @property
    def text_spaces(self) -> list[str]:
        """Colour spaces that letters are painted in; none in a mode that paints nothing."""
        return [self.spaces[k] for k in (0, 1) if self.mode in _PAINTS[k]]


def scale_of(matrix: FloatArray) -> float:
    """Root of the factor on areas of a map, 2 x 3."""
    return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def corners(left: float, low: float, right: float, high: float) -> FloatArray:
    """``(4, 2)`` corners of a box."""
    return np.array([[left, low], [right, high], [left, high], [right, low]], dtype=np.float64)


def matrix_of(numbers: Any) -> FloatArray:
    """Map, 2 x 3, of the six numbers of a PDF."""
    a, b, c, d, e, f = (float(v) for v in numbers)
    return np.array([[a, c, e], [b, d, f]])

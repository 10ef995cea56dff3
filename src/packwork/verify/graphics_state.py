"""State in which the content of a PDF paints (ISO 32000-1, 8.4 and 9.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.layouts.pdf import matrix_of
from packwork.verify.pdf_fonts import FontWidths

NOWHERE = np.zeros((2, 2))
_EVERYWHERE = np.array([[-np.inf, -np.inf], [np.inf, np.inf]])

_PAINTS = (frozenset({0, 2, 4, 6}), frozenset({1, 2, 5, 6}))
"""Modes of text in which letters are filled, and in which they are stroked."""

_LOW, _HIGH = -0.2, 0.75
"""How far letters reach below and above their base line, ems: usual ones."""

_NUMBERS = {"w": "width", "TL": "leading", "Tc": "spacing", "Tz": "stretch"}
"""Operators that set a number."""

_PAPER = {"RGB": 1.0, "grey": 1.0, "CMYK": 0.0}
"""Amount of each channel that leaves the paper bare."""


@final
@dataclass(frozen=True)
class Graphics:
    """Numbers of the graphics state by which a page is looked at; of pairs, fills come first.

    ``matrix``: from user space to the page, points; ``window``: box of the clip on the page.
    ``width``: of lines. ``spaces``: names of colour spaces; ``bare``: whether colours are those of
    paper; ``alphas``: opacities. ``font``, ``em``: widths of a font and its size; ``line``,
    ``text``: where a line of text began, and where it goes on; ``mode``, ``leading``, ``spacing``,
    ``stretch``: of text.
    """

    matrix: FloatArray
    window: FloatArray = field(default_factory=lambda: _EVERYWHERE)
    width: float = 1.0
    spaces: tuple[str, str] = ("grey", "grey")
    bare: tuple[bool, bool] = (False, False)
    alphas: tuple[float, float] = (1.0, 1.0)
    font: FontWidths = field(default_factory=FontWidths)
    em: float = 0.0
    line: FloatArray = field(default_factory=affine.identity)
    text: FloatArray = field(default_factory=affine.identity)
    mode: int = 0
    leading: float = 0.0
    spacing: float = 0.0
    stretch: float = 100.0

    def after(self, name: str, operands: Any) -> Graphics:
        """State after an operator that sets a number or a matrix; the same after any other.

        Examples
        --------
        >>> Graphics(affine.identity()).after("w", [3]).width
        3.0
        """
        if name in _NUMBERS:
            changed: dict[str, Any] = {_NUMBERS[name]: float(operands[0])}
            return replace(self, **changed)
        if name == "cm":
            return replace(self, matrix=affine.compose(self.matrix, matrix_of(operands)))
        if name == "Tr":
            return replace(self, mode=int(operands[0]))
        if name == "BT":
            return replace(self, line=affine.identity(), text=affine.identity())
        if name == "Tm":
            return replace(self, line=matrix_of(operands), text=matrix_of(operands))
        if name in {"Td", "TD"}:
            across, up = (float(v) for v in operands)
            leading = -up if name == "TD" else self.leading
            return replace(self._moved(across, up), leading=leading)
        if name in {"T*", "'", '"'}:
            return self._moved(0.0, -self.leading)
        return self

    def _moved(self, across: float, up: float) -> Graphics:
        line = affine.compose(self.line, affine.similarity(across, up, 0.0, 1.0))
        return replace(self, line=line, text=line)

    def coloured(self, is_stroke: bool, space: str, amounts: Sequence[Any] | None) -> Graphics:
        """State with another colour; None are the amounts at which a colour space begins."""
        paper = _PAPER.get(space)
        is_bare = bool(amounts) and all(v == paper for v in amounts or ())
        spaces, bare = list(self.spaces), list(self.bare)
        spaces[is_stroke], bare[is_stroke] = space, is_bare
        return replace(self, spaces=(spaces[0], spaces[1]), bare=(bare[0], bare[1]))

    def shown(self, operands: Any) -> tuple[FloatArray, Graphics]:
        """Box on the page of text that is shown, and the state after it; ``operands`` of ``TJ``."""
        em = self.em * self.stretch / 100
        width = em * self.font.width(operands, self.spacing / (self.em or 1.0))
        box = corners(min(width, 0.0), _LOW * self.em, max(width, 0.0), _HIGH * self.em)
        inside = replace(self, matrix=affine.compose(self.matrix, self.text))
        on = affine.compose(self.text, affine.similarity(width, 0.0, 0.0, 1.0))
        return inside.bounds([box]), replace(self, text=on)

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
        return self.em * scale_of(self.text) * scale_of(self.matrix)

    @property
    def text_paints(self) -> tuple[bool, bool]:
        """Two claims about letters: they are filled, they are stroked."""
        return self.mode in _PAINTS[0], self.mode in _PAINTS[1]


def scale_of(matrix: FloatArray) -> float:
    """Root of the factor on areas of a map, 2 x 3."""
    return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def corners(left: float, low: float, right: float, high: float) -> FloatArray:
    """``(4, 2)`` corners of a box."""
    return np.array([[left, low], [right, high], [left, high], [right, low]], dtype=np.float64)

"""Estimate of resvg's rendering time from counts, which bounds the size of pictures.

The figures behind the counts were measured on documents of one kind each; together they
are good to about a factor of three, which is enough to keep a hostile drawing from taking
minutes, and the same on every machine and under any load.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

from packwork.readers.budget.expansion import count_expanded
from packwork.readers.reading import TooRichError, left, spend
from packwork.readers.svg_syntax.page import Page
from packwork.readers.svg_syntax.painted import Painted, drawing_box, stretch

PICTURE_NS = 5e8
"""Nanoseconds that one picture may take. Larger makes hostile files slow, smaller makes
the pictures of rich drawings coarse. Chosen."""

MOST_NS = 2e9
"""Nanoseconds that the smallest picture may take; beyond, there is none. Chosen."""

LEAST_PX = 40
"""Longer side of the smallest picture. Chosen."""

_ELEMENT_NS, _LAYER_NS, _COVERED_NS, _HAIR_NS, _CROWD_NS = 2e4, 150.0, 6.0, 1e3, 0.05
"""For an element, a pixel of a layer, a pixel that a shape covers, a pixel along a line
thinner than one, and a row of a shape by the square of its edges there. Measured."""

_TOO_MANY = "has too many lines and layers one over another"

_MOST_ZOOM = 1e9
"""Page over the part of it that is shown, at most: beyond it no digits are left. Chosen."""

_MOST_SPILL = 25.0
"""Pictures that a layer is as large as, at most, where its content reaches beyond."""

_HAIR = 1 / 500
_HIDDEN_SHARE = 0.05


@dataclass(frozen=True)
class Work:
    """Counts of all that is to be rendered.

    Parameters
    ----------
    elements, layers
        After expansion: elements, and groups that are pictures of their own.
    depth
        How often shapes cover the page, by their boxes.
    hairs
        Length of thin lines, in sides of the page.
    crowd
        Edges of a shape that a row of pixels meets, squared, summed over shapes.
    spill
        Area of the box round all shapes, in pages, at least 1.
    page
        Longer side of the page in CSS pixels.
    """

    elements: float
    layers: float
    depth: float = 0.0
    hairs: float = 0.0
    crowd: float = 0.0
    spill: float = 1.0
    page: float = 1.0

    def nanoseconds(self, side: int, part: float) -> float:
        """Time for a picture of a part of the page, but for what its size does not change.

        Parameters
        ----------
        side
            Longer side of the picture, in pixels.
        part
            Longer side of what it shows, in CSS pixels.

        Examples
        --------
        >>> Work(elements=10, layers=0, depth=1.0).nanoseconds(100, 1.0)
        60000.0
        >>> Work(elements=10, layers=1, page=1e200).nanoseconds(100, 1e-9)
        37500000.0
        """
        zoom = min(max(1.0, self.page / part), _MOST_ZOOM)
        depth = min(self.elements, self.depth * zoom**2)
        layers = self.layers * min(_MOST_SPILL, self.spill * zoom**2)
        pixels = side * side * (_LAYER_NS * layers + _COVERED_NS * depth)
        return pixels + side * (_HAIR_NS * self.hairs * zoom + _CROWD_NS * self.crowd)

    def side(self, longest_px: int, part: float) -> int:
        """Longer side of a picture that takes a reasonable time, ``longest_px`` at most.

        Parameters
        ----------
        part
            Longer side of what it shows, in CSS pixels.

        Raises
        ------
        TooRichError
            If even the smallest one takes too long.

        Examples
        --------
        >>> Work(elements=10, layers=0).side(1000, 1.0)
        1000
        >>> Work(elements=10, layers=500).side(1000, 1.0) < 100
        True
        """
        side = float(longest_px)
        most = min(PICTURE_NS, left("pictures") / 3)
        while side > LEAST_PX and self.nanoseconds(int(side), part) > most:
            side /= 1.1
        side = max(side, min(LEAST_PX, longest_px))
        if self.nanoseconds(int(side), part) + _ELEMENT_NS * self.elements > MOST_NS:
            raise TooRichError(_TOO_MANY)
        return int(side)

    def spend(self, side: int, part: float) -> None:
        """Take a picture off the budget of the file, before it is made.

        Raises
        ------
        TooRichError
            If nothing is left for it.
        """
        spend(self.nanoseconds(side, part) + _ELEMENT_NS * self.elements, _TOO_MANY, "pictures")


def work_of(root: ET.Element, shapes: Sequence[Painted], page: Page | None) -> Work:
    """Counts of a clean drawing whose shapes are known.

    Examples
    --------
    >>> work_of(ET.fromstring('<svg><g opacity=".5"/></svg>'), [], None).layers
    1.0
    """
    width, height = _size(shapes, page)
    side = max(width, height)
    elements, layers = count_expanded(root)
    hidden = max(0.0, elements - len(shapes))
    depth, hairs, crowd = _HIDDEN_SHARE * hidden, 0.0, 0.0
    for shape in shapes:
        left, top, right, bottom = shape.bounds
        depth += min(1.0, (right - left) / width) * min(1.0, (bottom - top) / height)
        along, down = shape.lengths
        crowd += (down / height) ** 2
        if shape.painting.has_stroke:
            if shape.painting.pen.width * stretch(shape.matrix) < _HAIR * side:
                hairs += (along + down) / side
            crowd += 3 * (down / height) ** 2
    return Work(elements, layers, depth, hairs, crowd, _spill(shapes, width, height), side)


def _spill(shapes: Sequence[Painted], width: float, height: float) -> float:
    if not shapes:
        return 1.0
    lefts, tops, rights, bottoms = zip(*(shape.bounds for shape in shapes), strict=True)
    across, down = (max(rights) - min(lefts)) / width, (max(bottoms) - min(tops)) / height
    return float(max(1.0, across) * max(1.0, down))


def _size(shapes: Sequence[Painted], page: Page | None) -> tuple[float, float]:
    """Width and height of what is rendered, neither of them zero."""
    if page is not None:
        return page.width, page.height
    box = drawing_box(shapes)
    if box is None:
        return 1.0, 1.0
    width, height = box[2] - box[0], box[3] - box[1]
    return max(width, 1e-3 * height, 1e-9), max(height, 1e-3 * width, 1e-9)

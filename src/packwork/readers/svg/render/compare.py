"""Agreement of a region with resvg's rendering of the drawing that it was read from.

Both are drawn by resvg in the same small picture, so that its soft edges tell nothing
apart. Thin details need more pixels, so a poor agreement is looked at more closely.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region, oriented_rings
from packwork.readers.budget.rendering import Work
from packwork.readers.svg.render.resvg import TRACE_PX, View, coverage, solid_twin
from packwork.readers.svg_syntax.coordinates import PLAIN_VIEWPORT, Page

LEAST_AGREEMENT = 0.98
"""Intersection over union below which a reading counts as wrong. Larger traces drawings
for seams between their shapes, smaller lets a lost detail pass. Chosen."""

SIDES_PX = (64, 256, TRACE_PX)
"""Longer sides of the pictures, each looked at if the one before it disagrees. Of the
drawings of 26 public collections 8 % needed the second, 1 % the third. Tried."""

_HOPELESS = 0.9
_MANY_ELEMENTS = 5_000
_AROUND = 0.5
_STEPS = 100


class Comparison:
    """Pictures of a clean drawing, solid, of growing size, each made once.

    Parameters
    ----------
    root, page
        The drawing; without a page, user units are CSS pixels and nothing is cut off.
    region
        In CSS pixels, possibly empty: its box and half as much around it are looked at.

    Examples
    --------
    >>> import shapely
    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> from packwork.readers.budget.rendering import work_of
    >>> root = ET.fromstring('<svg width="20" height="20"><rect width="10" height="10"/></svg>')
    >>> page, half = read_page(root), shapely.box(0, 0, 10, 5)
    >>> round(Comparison(root, page, half, work_of(root, [], page)).agreement(half), 2)
    0.5
    """

    def __init__(self, root: ET.Element, page: Page | None, region: Region, work: Work) -> None:
        self._root, self._page = _on_page(solid_twin(root), page)
        self._part = _surroundings(region, page)
        longest = SIDES_PX[1:2] if work.elements > _MANY_ELEMENTS else SIDES_PX
        self._sides = list(dict.fromkeys(work.side(px, max(self._part[2:])) for px in longest))
        self._has_hairs = work.hairs > 0
        self._work = work
        self._shown: dict[int, FloatArray] = {}

    def agreement(self, region: Region) -> float:
        """Intersection over union of a region and what is shown.

        A second region is looked at as closely as the first one was.

        Raises
        ------
        UnfitError
            If resvg cannot render the drawing.
        """
        reached = 0.0
        for side in self._sides if not self._shown else [max(self._shown)]:
            if side not in self._shown:
                self._work.spend(side, max(self._part[2:]))
                self._shown[side] = coverage(self._root, self._page, self._part, side)
            reached = max(reached, iou(self._shown[side], _drawn(region, self._part, side)))
            is_hopeless = side >= SIDES_PX[1] and reached < _HOPELESS and not self._has_hairs
            if reached >= LEAST_AGREEMENT or is_hopeless:
                break
        return reached


def excess(shown: FloatArray, drawn: FloatArray) -> float:
    """Excess of a drawing over a region, both as pictures, as a share of the region.

    What is within a pixel of the region is not beyond it: filters leave hard edges.

    Examples
    --------
    >>> whole = np.ones((8, 8))
    >>> excess(whole, np.pad(np.ones((8, 4)), ((0, 0), (0, 4))))
    0.75
    """
    return float(np.maximum(shown - _spread(drawn), 0.0).sum() / max(1.0, drawn.sum()))


def side_by_side(
    region: Region, root: ET.Element, page: Page | None, side: int
) -> tuple[FloatArray, FloatArray]:
    """Pictures of a drawing and of a region, about the region.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.

    Examples
    --------
    >>> import shapely
    >>> root = ET.fromstring('<svg><rect width="10" height="10"/></svg>')
    >>> [float(p.max()) for p in side_by_side(shapely.box(0, 0, 9, 9), root, None, 40)]
    [1.0, 1.0]
    """
    part = _surroundings(region, page)
    return coverage(*_on_page(root, page), part, side), _drawn(region, part, side)


def iou(a: FloatArray, b: FloatArray) -> float:
    """Intersection over union of coverages; of nothing and nothing 1.

    Examples
    --------
    >>> iou(np.array([[1.0, 0.5]]), np.array([[1.0, 0.0]])).__round__(3)
    0.667
    """
    union = float(np.maximum(a, b).sum())
    return float(np.minimum(a, b).sum()) / union if union > 0 else 1.0


def _on_page(root: ET.Element, page: Page | None) -> tuple[ET.Element, Page]:
    """A drawing without a page on one that cuts nothing off."""
    if page is not None:
        return root, page
    root = copy.copy(root)
    root.attrib = {**root.attrib, "overflow": "visible"}
    return root, Page(*PLAIN_VIEWPORT, affine.identity())


def _surroundings(region: Region, page: Page | None) -> View:
    """Part of the page about a region; all of it about none."""
    if region.is_empty:
        width, height = PLAIN_VIEWPORT if page is None else (page.width, page.height)
        return 0.0, 0.0, width, height
    left, top, right, bottom = region.bounds
    around = _AROUND * max(right - left, bottom - top)
    left, top, right, bottom = left - around, top - around, right + around, bottom + around
    if page is not None:
        left, top = max(0.0, left), max(0.0, top)
        right, bottom = min(page.width, right), min(page.height, bottom)
    return left, top, right - left, bottom - top


def _drawn(region: Region, part: View, side: int) -> FloatArray:
    """The same picture of a region."""
    px = max(part[2:]) / side
    rings = [np.round((ring - part[:2]) * (_STEPS / px)) for ring in oriented_rings(region)]
    data = "".join(f"M{' '.join(map(str, ring.ravel().astype(int).tolist()))}z" for ring in rings)
    root = ET.Element("svg")
    ET.SubElement(root, "path", {"d": data, "fill-rule": "evenodd"})
    view = (0.0, 0.0, part[2] / px * _STEPS, part[3] / px * _STEPS)
    return coverage(root, Page(*view[2:], affine.identity()), view, side)


def _spread(picture: FloatArray) -> FloatArray:
    """The greatest of each pixel and its eight neighbours."""
    rows, columns = picture.shape
    padded = np.pad(picture, 1)
    parts = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return np.asarray(np.max(parts, axis=0))

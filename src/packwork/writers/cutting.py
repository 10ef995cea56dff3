"""Lines for a cutter: the items' outlines, one line round each, or one at a distance.

A line at a distance (a kiss cut, that leaves a rim of paper round a sticker) needs twice that
distance between items. Arcs of such a line lie within the true offset, so that where the gap
is kept no two lines meet; where it is not, lines that would cross become one.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, union
from packwork.geometry.polygon import Region, oriented_rings, polygon_parts, silhouette
from packwork.phrasing import number_of
from packwork.scene.layout import Layout
from packwork.scene.notation import attributes, path_data
from packwork.units import convert, length_asked
from packwork.writers.options import CutLine

_LOG = logging.getLogger(__name__)

SPOT = "CutContour"
"""Name of the colour that print-and-cut programs look for."""

MAGENTA = "#ff00ff"
"""How the line looks where there are no spot colours: what such programs show it as."""

HAIRLINE_PT = 0.25
"""Width of a cut line: what print shops ask for."""

QUADRANT = 16
"""Pieces of each quarter of an arc of a line at a distance: within 0.12 % of that distance."""

_JOINS = (0.005, 0.01, 0.02, 0.04, 0.08, 0.16)
"""Shares of an item's extent within which its parts are joined, the least that does counts.
Larger ones would leave little of its shape. Chosen."""


@dataclass(frozen=True, kw_only=True)
class CutOptions:
    """Choice of the lines that are cut.

    ``line`` says ``outlines`` (as they are, with holes), ``silhouette`` (one closed line round each
    item) or None (what the format always has); ``kiss`` is the distance of the line from the item,
    a length, or None.
    """

    line: CutLine | None = None
    kiss: str | None = None

    def __post_init__(self) -> None:
        if self.kiss is not None and length_asked("kiss_cut", self.kiss, "px", 1.0) <= 0:
            raise RecipeError("kiss_cut", f"must be more than nothing, not {self.kiss}")

    @property
    def is_asked(self) -> bool:
        """Whether lines are wanted in formats that have none of themselves."""
        return self.line is not None or self.kiss is not None


def cut_rings(layout: Layout, options: CutOptions) -> list[FloatArray]:
    """Closed lines to cut, canvas units.

    Examples
    --------
    >>> import numpy as np
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.item import FlatArt, Item
    >>> from packwork.scene.pose import Poses
    >>> square = Outline.from_rings([[[-1, -1], [1, -1], [1, 1], [-1, 1]]])
    >>> item, one = Item("square", "square", square, square, FlatArt("teal")), np.ones(1)
    >>> tile = Container("tile", "tile", square, 9.0, 9.0)
    >>> layout = Layout(tile, (item,), Poses(4 * one, 4 * one, 0 * one, one), one)
    >>> [len(ring) for ring in cut_rings(layout, CutOptions(line="outlines"))]
    [4]
    >>> float(np.ptp(cut_rings(layout, CutOptions(kiss="1"))[0][:, 0]))
    4.0
    """
    if options.kiss is None and options.line != "silhouette":
        return [ring for outline in layout.outlines for ring in outline.rings]
    shapes = [silhouette(outline.region) for outline in layout.outlines]
    if options.kiss is not None:
        container = layout.container
        offset = length_asked("kiss_cut", options.kiss, container.unit, container.side)
        shapes = _merge_crossing([buffered(shape, offset, quad_segs=QUADRANT) for shape in shapes])
    if options.line != "outlines":
        shapes = _join_parts(shapes)
    return [ring for shape in shapes for ring in oriented_rings(silhouette(shape))]


def cut_group(layout: Layout, options: CutOptions, digits: int) -> list[str]:
    """Group ``cut`` of an SVG: hairlines without a fill; nothing if no lines are asked for."""
    if options.is_asked:
        layout.container.check_edge("cut", "lines for a cutter")
    rings = cut_rings(layout, options) if options.is_asked else []
    if not rings:
        return []
    head = attributes(
        {
            "id": "cut",
            # So that a reader can draw them anew.
            "data-line": options.line or "",
            "data-kiss": options.kiss or "",
            "fill": "none",
            "stroke": MAGENTA,
            "stroke-width": f"{convert(HAIRLINE_PT, 'pt', layout.container.unit):.6g}",
        }
    )
    drawn = [f'<path d="{path_data(Outline.from_rings([ring]), digits)}"/>' for ring in rings]
    return [f"<g{head}>", *drawn, "</g>"]


def _merge_crossing(shapes: Sequence[Region]) -> list[Region]:
    """Shapes of which none overlap: those that do become one, in the place of the first."""
    pairs = shapely.STRtree(shapes).query(shapes, predicate="intersects").T
    if not any(a != b for a, b in pairs):
        return list(shapes)
    _LOG.warning("cut lines that would cross have become one; a larger --padding keeps them apart")
    return polygon_parts(union(list(shapes)))


def _join_parts(shapes: Sequence[Region]) -> list[Region]:
    """Each shape as one part, where that meets no other shape."""
    joined = list(shapes)
    left = 0
    for k, shape in enumerate(shapes):
        if len(polygon_parts(shape)) == 1:
            continue
        others = shapely.STRtree([one for n, one in enumerate(joined) if n != k])
        left += not _join_one(joined, k, others)
    if left:
        many = number_of(left, "item in several parts has", "items in several parts have")
        _LOG.warning("%s a cut line round each part", many)
    return joined


def _join_one(joined: list[Region], k: int, others: shapely.STRtree) -> bool:
    left, top, right, bottom = joined[k].bounds
    for share in _JOINS:
        reach = share * max(right - left, bottom - top)
        closed = buffered(buffered(joined[k], reach), -reach)
        whole = silhouette(union([closed, joined[k]]))
        if len(polygon_parts(whole)) == 1:
            if len(others.query(whole, predicate="intersects")):
                return False
            joined[k] = whole
            return True
    return False

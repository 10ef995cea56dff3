"""An SVG's bytes to the regions it paints: computed where shapes tell, else traced.

A white sheet behind an item's drawing is found and taken out.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from shapely.errors import GEOSException

from packwork.errors import ShapeError
from packwork.readers.budget.rendering import Work, check_tiles, work_of
from packwork.readers.gate.door import parse_untrusted
from packwork.readers.options import HALF
from packwork.readers.pages import PageFate
from packwork.readers.pictures.silhouette import LEAST_WHITE
from packwork.readers.reading import SHAPES_NS, TooRichError, UnfitError, notice, one_budget
from packwork.readers.svg.ink import Ink, painted_ink
from packwork.readers.svg.lettering import set_in_outlines
from packwork.readers.svg.resvg import LEAST_AGREEMENT, Comparison, View, solid_twin
from packwork.readers.svg.trace import (
    MAX_POINTS,
    MAX_RINGS,
    inked_part,
    is_plain_enough,
    needs_tracing,
    traced_ink,
)
from packwork.readers.svg.walk import painted_shapes, scale_steady_strokes
from packwork.readers.svg_syntax.coordinates import Page, read_page
from packwork.readers.svg_syntax.painted import Box, Painted, drawing_box
from packwork.scene.colour import css_colour

WHOLE_PAGE = 0.999
"""Share of the page from which a sheet, or a drawing, covers all of it. Chosen."""

EDGE = 0.002
"""How near to the page's edge, as a share of its longer side, paint touches it. Chosen."""

_SHOWN_BESIDES = frozenset({"image", "text"})
_SPECIAL = frozenset({"id", "opacity", "mask", "filter", "style", "clip-path"})


def drop_sheet(
    root: ET.Element, page: Page | None, shapes: Sequence[Painted], keep_page: bool | None = None
) -> tuple[list[Painted], PageFate]:
    """Take the sheet out of a clean drawing, in place; the shapes that are left, and its fate.

    A sheet is what is painted first, covers the page in one opaque near-white, has no line
    and no effect on it, and has more painted on it, which stays clear of the page's edges: what
    reaches them is printed on a card or a flag. A coloured tile stays. ``keep_page`` keeps it, or
    drops it whatever is on it; None: as it looks.

    >>> paper = '<rect width="9" height="9" fill="white"/>'
    >>> root = ET.fromstring(f'<svg viewBox="0 0 9 9">{paper}<circle r="3"/></svg>')
    >>> page = read_page(root)
    >>> shapes, fate = drop_sheet(root, page, painted_shapes(root, page), keep_page=False)
    >>> len(shapes), fate.name, [e.tag for e in root]
    (1, 'LEFT_OUT', ['circle'])
    """
    kept = list(shapes)
    if page is None or not kept or not _is_paper(kept[0], page):
        return kept, PageFate.NONE
    sheet = kept[0].element
    parent = _plain_parent(root, sheet)
    has_more = len(kept) > 1 or any(e.tag in _SHOWN_BESIDES for e in root.iter())
    if parent is None or not has_more:
        return kept, PageFate.NONE
    if keep_page or (keep_page is None and _touches(kept[1:], page)):
        return kept, PageFate.KEPT
    parent.remove(sheet)
    return kept[1:], PageFate.LEFT_OUT


def _touches(shapes: Sequence[Painted], page: Page) -> bool:
    """Whether what is painted reaches an edge of the page."""
    hair = EDGE * max(page.width, page.height)

    def is_near(box: Box | None) -> bool:
        return box is not None and (
            min(box[0], box[1]) <= hair
            or box[2] >= page.width - hair
            or box[3] >= page.height - hair
        )

    # Handles of curves may lie farther out than what is drawn: only then it is followed.
    if not is_near(drawing_box(shapes)):
        return False
    try:
        drawn = painted_ink(shapes).whole
    except (TooRichError, GEOSException):
        return True
    return not drawn.is_empty and is_near(drawn.bounds)


def _is_paper(shape: Painted, page: Page) -> bool:
    painting = shape.painting
    if shape.clips or painting.has_stroke or painting.fill_opacity < 1:
        return False
    if not is_near_white(painting.fill):
        return False
    return bool(painted_ink([shape]).fills.area >= WHOLE_PAGE * page.width * page.height)


def is_near_white(fill: str) -> bool:
    """Whether a paint is opaque and nearly white.

    >>> is_near_white("#fffff0"), is_near_white("#fd7"), is_near_white("none")
    (True, False, False)
    """
    try:
        *channels, opacity = css_colour(fill)
    except ValueError:
        return False
    return opacity == 255 and min(channels) >= LEAST_WHITE


def _plain_parent(root: ET.Element, sheet: ET.Element) -> ET.Element | None:
    """Parent of an element; None if anything refers to it or changes how it looks."""
    parents = {child: parent for parent in root.iter() for child in parent}
    element = sheet
    while element is not root:
        # Ids without use are gone by now: what has one shows elsewhere too.
        if _SPECIAL & element.attrib.keys() or (element is not sheet and element.tag != "g"):
            return None
        element = parents[element]
    return parents[sheet]


_SHAPE_NS = 2.5e5
"""For following a shape. Measured."""

MAX_SHAPES = int(SHAPES_NS / _SHAPE_NS)
"""Shapes that are followed one by one; of strangers' drawings with more, the picture is traced."""


_MARGIN = 0.01

LARGESSE = 20.0
"""Budget of what is read for good or as a container, in those of an item. Chosen."""


@dataclass(frozen=True, eq=False)
class PaintedDrawing:
    """An SVG that has been through the gate, and what it paints.

    ``ink`` is in CSS pixels, right and down from the page's corner.
    """

    root: ET.Element
    page: Page | None
    ink: Ink
    shapes: Sequence[Painted]
    sheet: PageFate = PageFate.NONE

    @cached_property
    def work(self) -> Work:
        """Counts of rendering its solid twin."""
        return work_of(solid_twin(self.root), self.shapes, self.page)


def read_drawing(
    data: bytes,
    *,
    is_compared: bool = False,
    is_on_paper: bool = False,
    keep_page: bool | None = None,
    alpha_threshold: float = HALF,
    tolerance: float | None = None,
) -> PaintedDrawing:
    """Drawing of an SVG file's bytes.

    Parameters
    ----------
    is_compared
        Whether what was computed from shapes is compared with a rendering, and traced
        from that where it differs, with a notice.
    is_on_paper
        Whether a white page behind all else is no part of it, as of items.
    keep_page
        Whether it stays all the same; None: as it looks.
    alpha_threshold
        Opacity from which what has to be traced is inside.
    tolerance
        Largest distance of a curve from its chords, in CSS pixels, where that is to be
        finer than for placing; not of what is compared.

    >>> drawing = read_drawing(b'<svg viewBox="0 0 9 9"><rect width="4" height="2"/></svg>')
    >>> drawing.ink.fills.area
    8.0
    """
    with one_budget(1.0 if is_compared else LARGESSE):
        root = parse_untrusted(data)
        page = read_page(root)
        scale_steady_strokes(root, page)
        set_in_outlines(root, page)
        shapes = painted_shapes(root, page)
        sheet = PageFate.NONE
        if is_on_paper:
            shapes, sheet = drop_sheet(root, page, shapes, keep_page)
        if needs_tracing(root):
            drawing = _traced(root, page, shapes, alpha_threshold)
        elif is_compared:
            drawing = _compared(root, page, shapes, alpha_threshold)
        else:
            drawing = PaintedDrawing(root, page, painted_ink(shapes, tolerance), shapes)
        return replace(drawing, sheet=sheet)


def _compared(
    root: ET.Element, page: Page | None, shapes: list[Painted], threshold: float
) -> PaintedDrawing:
    """Drawing as computed from its shapes, or traced where that is nearer to its picture."""
    try:
        if len(shapes) > MAX_SHAPES:
            raise TooRichError(f"has {len(shapes):,} shapes")
        drawing = PaintedDrawing(root, page, painted_ink(shapes), shapes)
        if not is_plain_enough(drawing.ink.body):
            raise TooRichError(f"needs more than {MAX_POINTS:,} points or {MAX_RINGS:,} rings")
        comparison = Comparison(root, page, drawing.ink.body, drawing.work)
        share = comparison.agreement(drawing.ink.whole)
    except (TooRichError, GEOSException, ShapeError) as problem:
        traced = _traced(root, page, shapes, threshold, is_sure=True)
        why = problem.what if isinstance(problem, TooRichError) else "has edges too close to tell"
        notice(f"is traced from its picture, for it {why}")
        return traced
    if share >= LEAST_AGREEMENT or drawing.work.hairs > 0:
        # Of lines thinner than its pixels a picture tells little.
        return drawing
    traced = _traced(root, page, shapes, threshold)
    # Without a page the traced one stands elsewhere.
    if page is not None and comparison.agreement(traced.ink.whole) <= share:
        return drawing
    notice(f"is traced from its picture, with which its shapes as read agree to {share:.1%} only")
    return traced


def _traced(
    root: ET.Element,
    page: Page | None,
    shapes: list[Painted],
    threshold: float,
    *,
    is_sure: bool = False,
) -> PaintedDrawing:
    """Drawing as its picture shows it.

    ``is_sure`` says that ``shapes`` are all that it paints, so that what is too thin for a coarse
    picture is known from them.
    """
    if page is None:
        root = copy.copy(root)
        page = _framed(root, shapes)
    work = work_of(solid_twin(root), shapes, page)
    # Twice: the tiles must suit the page to find the ink, and the ink to look closer.
    check_tiles(root, shapes, max(page.width, page.height))
    part = _shown_part(shapes, page) if is_sure else inked_part(root, page, work)
    if part is not None:
        check_tiles(root, shapes, max(part[2:]))
    known = shapes if is_sure else ()
    return PaintedDrawing(root, page, traced_ink(root, page, part, work, threshold, known), shapes)


def _shown_part(shapes: Sequence[Painted], page: Page) -> View | None:
    """Box of all shapes on the page, with a margin; None if there are none."""
    box = drawing_box(shapes)
    if box is None:
        return None
    left, top = max(0.0, box[0]), max(0.0, box[1])
    width, height = min(page.width, box[2]) - left, min(page.height, box[3]) - top
    margin = _MARGIN * max(width, height)
    if min(width, height) <= 0:
        return None
    return left - margin, top - margin, width + 2 * margin, height + 2 * margin


def _framed(root: ET.Element, shapes: list[Painted]) -> Page:
    """Page round the shapes of a drawing that states none; the root is told of it."""
    box = drawing_box(shapes)
    if box is None:
        raise UnfitError("states no size; give its <svg> a viewBox")
    left, top, width, height = box[0], box[1], box[2] - box[0], box[3] - box[1]
    root.attrib = {k: v for k, v in root.attrib.items() if k not in {"width", "height"}}
    root.attrib["viewBox"] = f"{left!r} {top!r} {width!r} {height!r}"
    page = read_page(root)
    if page is None:
        raise UnfitError("states no size; give its <svg> a viewBox")
    return page

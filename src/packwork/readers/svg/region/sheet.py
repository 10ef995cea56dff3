"""White background rectangles behind drawings: detection and removal."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

from shapely.errors import GEOSException

from packwork.readers.pages import PageFate
from packwork.readers.pictures.transparency import LEAST_WHITE as LEAST_WHITE
from packwork.readers.reading import TooRichError
from packwork.readers.svg.region.ink import painted_ink
from packwork.readers.svg_syntax.coordinates import Page
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
    """Take the sheet out of a clean drawing, in place.

    A sheet is what is painted first, covers the page in one opaque near-white, has no line
    and no effect on it, and has more painted on it, which stays clear of the page's edges: what
    reaches them is printed on a card or a flag. A coloured tile stays.

    Parameters
    ----------
    keep_page
        Whether the sheet is to stay; None: as it looks; False drops it whatever is on it.

    Returns
    -------
    tuple of list of Painted and PageFate
        The shapes that are left, and what became of the sheet.

    Examples
    --------
    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> from packwork.readers.svg.paint.walk import painted_shapes
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

    Examples
    --------
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

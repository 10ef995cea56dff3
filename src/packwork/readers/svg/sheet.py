"""The white page that drawing programs leave behind a drawing: paper, not part of it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

from packwork.readers.svg.ink import painted_ink
from packwork.readers.svg.page import Page
from packwork.readers.svg.painted import Painted
from packwork.readers.unfit import notice
from packwork.scene.colour import css_colour

LEAST_WHITE = 240
"""Each channel of a sheet's colour, of 255, at least. Smaller takes pale tiles for paper,
larger keeps ivory paper. Chosen."""

WHOLE_PAGE = 0.999
"""Share of the page that a sheet covers at least. Chosen."""

_SHOWN_BESIDES = frozenset({"image", "text"})
_SPECIAL = frozenset({"id", "opacity", "mask", "filter", "style", "clip-path"})


def drop_sheet(root: ET.Element, page: Page | None, shapes: Sequence[Painted]) -> list[Painted]:
    """Take the sheet out of a clean drawing, in place; says so.

    A sheet is what is painted first, covers the page in one opaque near-white, has no line
    and no effect on it, and has more painted on it. A coloured tile stays.

    Parameters
    ----------
    shapes
        As ``painted_shapes`` gave them.

    Returns
    -------
    list of Painted
        The shapes that are left.

    Examples
    --------
    >>> from packwork.readers.svg.page import read_page
    >>> from packwork.readers.svg.walk import painted_shapes
    >>> paper = '<rect width="9" height="9" fill="white"/>'
    >>> root = ET.fromstring(f'<svg viewBox="0 0 9 9">{paper}<circle r="3"/></svg>')
    >>> page = read_page(root)
    >>> len(drop_sheet(root, page, painted_shapes(root, page))), [e.tag for e in root]
    (1, ['circle'])
    """
    kept = list(shapes)
    if page is None or not kept or not _is_paper(kept[0], page):
        return kept
    sheet = kept[0].element
    parent = _plain_parent(root, sheet)
    has_more = len(kept) > 1 or any(e.tag in _SHOWN_BESIDES for e in root.iter())
    if parent is None or not has_more:
        return kept
    parent.remove(sheet)
    notice("its white page was left out; give it another colour or a line to keep it")
    return kept[1:]


def _is_paper(shape: Painted, page: Page) -> bool:
    painting = shape.painting
    if shape.clips or painting.has_stroke or painting.fill_opacity < 1:
        return False
    if not _is_near_white(painting.fill):
        return False
    return bool(painted_ink([shape]).fills.area >= WHOLE_PAGE * page.width * page.height)


def _is_near_white(fill: str) -> bool:
    try:
        *channels, opacity = css_colour(fill)
    except ValueError:
        return False
    return opacity == 255 and min(channels) >= LEAST_WHITE


def _plain_parent(root: ET.Element, sheet: ET.Element) -> ET.Element | None:
    """What an element stands in; None if anything refers to it or changes how it looks."""
    parents = {child: parent for parent in root.iter() for child in parent}
    element = sheet
    while element is not root:
        # Ids without use are gone by now: what has one shows elsewhere too.
        if _SPECIAL & element.attrib.keys() or (element is not sheet and element.tag != "g"):
            return None
        element = parents[element]
    return parents[sheet]

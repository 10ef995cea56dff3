"""What cannot be computed from shapes alone (masks, patterns, pictures), traced.

The clean drawing is rendered by resvg and the edge of its opacity followed.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

import shapely
from shapely.geometry import Polygon

from packwork.geometry.polygon import Region
from packwork.readers.gate.vocabulary import TEXTS, TRACED
from packwork.readers.options import HALF
from packwork.readers.svg.ink import TracedInk
from packwork.readers.svg.page import Page
from packwork.readers.svg.render import TRACE_PX as TRACE_PX
from packwork.readers.svg.render import Part, coverage, inked
from packwork.readers.svg.render import page_picture as page_picture
from packwork.readers.svg.solid import solid_twin
from packwork.readers.svg.work import Work

FIND_PX = 250
"""Longer side of the rendering in which the ink is looked for. Larger costs time, smaller
loses specks between its pixels. Chosen."""

_SIMPLIFY_PX = 0.05
_FAINTEST = 0.5 / 255


def needs_tracing(root: ET.Element) -> bool:
    """Whether a clean drawing uses anything that shapes and plain clips do not tell.

    Examples
    --------
    >>> needs_tracing(ET.fromstring("<svg><g><text>a</text></g></svg>"))
    True
    """
    return any(
        element.tag in TRACED or (element.tag == "clipPath" and not _is_plain(element))
        for element in root.iter()
    )


def traced_ink(
    root: ET.Element, page: Page, part: Part | None, work: Work, threshold: float = HALF
) -> TracedInk:
    """Where a clean drawing is more opaque than not, in CSS pixels; possibly empty.

    Opacities above zero count as full: a faint shape is a shape.

    Parameters
    ----------
    root, page
        The drawing.
    part
        What is rendered, as ``inked_part`` gave it.
    work
        Of its solid twin.
    threshold
        Opacity from which what is traced is inside, as a share of the most opaque place's.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing, or not in reasonable time.

    Examples
    --------
    >>> from packwork.readers.svg.page import read_page
    >>> from packwork.readers.svg.work import work_of
    >>> root = ET.fromstring('<svg width="20" height="20"><rect width="10" height="10"/></svg>')
    >>> page = read_page(root)
    >>> part = (0.0, 0.0, 20.0, 20.0)
    >>> round(traced_ink(root, page, part, work_of(root, [], page)).whole.area)
    100
    """
    if part is None:
        return TracedInk(Polygon())
    whole = _traced(solid_twin(root), page, part, work, threshold)
    if not any("stroke-dasharray" in element.attrib for element in root.iter()):
        return TracedInk(whole)
    dashless = solid_twin(root, with_dashes=False)
    return TracedInk(whole, _traced(dashless, page, part, work, threshold))


def inked_part(root: ET.Element, page: Page, work: Work) -> Part | None:
    """Box of what a clean drawing shows on its page, with a margin; None if nothing.

    Raises
    ------
    UnfitError
        As for ``traced_ink``.

    Examples
    --------
    >>> from packwork.readers.svg.page import read_page
    >>> from packwork.readers.svg.work import work_of
    >>> root = ET.fromstring('<svg width="100" height="50"><rect width="10" height="9"/></svg>')
    >>> page = read_page(root)
    >>> [round(side, 1) for side in inked_part(root, page, work_of(root, [], page))]
    [-0.8, -0.8, 11.6, 10.8]
    """
    whole = (0.0, 0.0, page.width, page.height)
    return inked(
        coverage(solid_twin(root), page, whole, work.side(FIND_PX, max(page.width, page.height))),
        whole,
    )


def _traced(twin: ET.Element, page: Page, part: Part, work: Work, threshold: float) -> Region:
    from packwork.readers.pictures.contours import contour_region
    from packwork.readers.pictures.transparency import raised, tell_what_is_faint

    side = work.side(TRACE_PX, max(part[2:]))
    opacity = coverage(twin, page, part, side)
    # What a mask lets through faintly is a shape all the same.
    solid = opacity / max(float(opacity.max()), _FAINTEST)
    tell_what_is_faint(solid, threshold)
    traced = contour_region(raised(solid, threshold), _SIMPLIFY_PX)
    px = max(part[2:]) / side
    return shapely.transform(traced, lambda points: points * px + part[:2])


def _is_plain(clip: ET.Element) -> bool:
    """Whether a clip path is made of shapes in the units of what it cuts."""
    if clip.get("clipPathUnits", "userSpaceOnUse") != "userSpaceOnUse":
        return False
    return not any(element.tag in TEXTS for element in clip.iter())

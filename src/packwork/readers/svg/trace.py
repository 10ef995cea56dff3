"""Tracing of rendered drawings, for what shapes alone do not tell (masks, patterns, pictures).

The clean drawing is rendered by resvg and the edge of its opacity followed.

Renderers let slivers vanish that are thinner than a sixteenth of a pixel.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region, polygon_parts
from packwork.readers.budget.rendering import LEAST_PX, Work
from packwork.readers.options import HALF
from packwork.readers.svg.ink import TracedInk
from packwork.readers.svg.resvg import FIND_PX, TRACE_PX, View, coverage, inked, solid_twin
from packwork.readers.svg_syntax.coordinates import Page
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.shapes import flattened_all
from packwork.readers.svg_syntax.vocabulary import TEXTS, TRACED

MAX_STEPS = 4_000_000
"""Points along all lines that are looked up; of longer ones fewer. Chosen: a second's work."""

_STEP_PX = 0.5


def touched(
    shapes: Sequence[Painted], part: tuple[float, float, float, float], shape: tuple[int, ...]
) -> BoolArray:
    """Pixels that the edges of shapes pass through, clips passed over.

    ``part`` is left, top, width and height of what the picture shows, in CSS pixels, ``shape`` its
    rows and columns.
    """
    found = np.zeros(shape[:2], dtype=bool)
    px = max(part[2:]) / max(shape)
    length = sum(sum(painted.lengths) for painted in shapes)
    step = max(_STEP_PX * px, length / MAX_STEPS)
    for painted in shapes:
        if painted.window is not None and painted.window.is_empty:
            continue
        tolerance = px / max(np.abs(painted.matrix[:, :2]).max(), 1e-12)
        lines = flattened_all(painted.pieces, tolerance)
        has_fill = painted.painting.has_fill
        is_closed = np.array([has_fill or piece.is_closed for piece in painted.pieces])
        ends = _edge_ends(painted.matrix, lines, is_closed)
        columns, rows = ((_along(ends, step) - part[:2]) / px).astype(int).T
        is_shown = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
        found[rows[is_shown], columns[is_shown]] = True
    return found


def _edge_ends(matrix: FloatArray, lines: Sequence[FloatArray], is_closed: BoolArray) -> FloatArray:
    """``(n, 2, 2)`` both ends of each edge; after an open line's last point, that point twice."""
    counts = np.array([len(line) for line in lines])
    is_line = counts >= np.where(is_closed, 1, 2)
    counts, is_closed = counts[is_line], is_closed[is_line]
    if len(counts) == 0:
        return np.empty((0, 2, 2))
    points = np.concatenate([line for line, is_one in zip(lines, is_line, strict=True) if is_one])
    last = np.cumsum(counts) - 1
    after = np.arange(1, len(points) + 1)
    after[last] = np.where(is_closed, last - counts + 1, last)
    placed = affine.apply(matrix, points)
    return np.stack([placed, placed[after]], axis=1)


def _along(ends: FloatArray, step: float) -> FloatArray:
    """Points along edges, a step apart at most, the first end of each among them."""
    counts = 1 + (np.hypot(*(ends[:, 1] - ends[:, 0]).T) / step).astype(int)
    edge = np.repeat(np.arange(len(ends)), counts)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[edge]
    return np.asarray(ends[edge, 0] + share[:, None] * (ends[edge, 1] - ends[edge, 0]))


MAX_POINTS, MAX_RINGS = 60_000, 2_000
"""Points and rings of an item's outline. Every stage goes over them again and again; detailed
maps have half as many. Larger makes runs slow, smaller coarsens rich drawings. Chosen."""

_COARSE_GAIN, _COARSER = 10.0, 2
"""By how much a coarse picture is strengthened, so that what is thin closes up, and how much
coarser each is than the one before. Chosen."""

_SIMPLIFY_PX = 0.05
_FAINTEST = 0.5 / 255


def needs_tracing(root: ET.Element) -> bool:
    """Whether a clean drawing uses anything that shapes and plain clips do not tell."""
    return any(
        element.tag in TRACED or (element.tag == "clipPath" and not _is_plain(element))
        for element in root.iter()
    )


def traced_ink(
    root: ET.Element,
    page: Page,
    part: View | None,
    work: Work,
    threshold: float = HALF,
    shapes: Sequence[Painted] = (),
) -> TracedInk:
    """Region in which a clean drawing is more opaque than not, in CSS pixels; possibly empty.

    Opacities above zero count as full: a faint shape is a shape. From ``threshold``, a share of the
    most opaque place's opacity, it is inside. Of ``shapes``, which it is known to paint, lines that
    a coarse picture is too coarse to show count as shown.
    """
    if part is None:
        return TracedInk(Polygon(), Polygon())
    whole, side = _traced(solid_twin(root), page, part, work, threshold, TRACE_PX, shapes)
    if not any("stroke-dasharray" in element.attrib for element in root.iter()):
        return TracedInk(whole, whole)
    twin = solid_twin(root, with_dashes=False)
    return TracedInk(whole, _traced(twin, page, part, work, threshold, side, shapes)[0])


def is_plain_enough(region: Region) -> bool:
    """Whether an outline has no more points and rings than an item may have."""
    rings = shapely.get_rings(polygon_parts(region))
    points = int(shapely.get_num_coordinates(rings).sum())
    return points <= MAX_POINTS and len(rings) <= MAX_RINGS


def inked_part(root: ET.Element, page: Page, work: Work) -> View | None:
    """Box of what a clean drawing shows on its page, with a margin; None if nothing.

    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> from packwork.readers.budget.rendering import work_of
    >>> root = ET.fromstring('<svg width="100" height="50"><rect width="10" height="9"/></svg>')
    >>> page = read_page(root)
    >>> [round(side, 1) for side in inked_part(root, page, work_of(root, [], page))]
    [-0.8, -0.8, 11.6, 10.8]
    """
    whole = (0.0, 0.0, page.width, page.height)
    side = work.side(FIND_PX, max(page.width, page.height))
    work.spend(side, max(page.width, page.height))
    return inked(coverage(solid_twin(root), page, whole, side), whole)


def _traced(
    twin: ET.Element,
    page: Page,
    part: View,
    work: Work,
    threshold: float,
    longest_px: int,
    shapes: Sequence[Painted],
) -> tuple[Region, int]:
    """Region that a picture shows, and the longer side of that picture.

    Of what is too rich the picture is made coarser, and all that shows in it counts as full.
    """
    from packwork.readers.pictures.contours import contour_region
    from packwork.readers.pictures.silhouette import raised, tell_what_is_faint

    side = work.side(longest_px, max(part[2:]))
    while True:
        work.spend(side, max(part[2:]))
        opacity = coverage(twin, page, part, side)
        # What a mask lets through faintly is a shape all the same.
        strongest = 1.0 if shapes else float(opacity.max())
        opacity = opacity / max(strongest, _FAINTEST)
        if shapes:
            # Takes half a second to load.
            from scipy.ndimage import maximum_filter

            is_solid = maximum_filter(opacity, 3) >= 1 / 2
            opacity[touched(shapes, part, opacity.shape) & ~is_solid] = 1.0
        if side < TRACE_PX:
            opacity = np.minimum(1.0, opacity * _COARSE_GAIN)
        elif not shapes:
            tell_what_is_faint(opacity, threshold)
        opacity = raised(opacity, threshold)
        if side <= LEAST_PX or _edges(opacity) <= MAX_POINTS:
            traced = contour_region(opacity, _SIMPLIFY_PX)
            if side <= LEAST_PX or is_plain_enough(traced):
                return _on_page(traced, part, side), side
        side = max(LEAST_PX, side // _COARSER)


def _on_page(traced: Region, part: View, side: int) -> Region:
    """Region in CSS pixels."""
    px = max(part[2:]) / side
    return shapely.transform(traced, lambda points: points * px + part[:2])


def _edges(opacity: FloatArray) -> int:
    """Places where a picture goes from more opaque than not to less."""
    solid = opacity >= 1 / 2
    return sum(int(np.count_nonzero(np.diff(solid, axis=axis))) for axis in (0, 1))


def _is_plain(clip: ET.Element) -> bool:
    """Whether a clip path is made of shapes in the units of what it cuts."""
    if clip.get("clipPathUnits", "userSpaceOnUse") != "userSpaceOnUse":
        return False
    return not any(element.tag in TEXTS for element in clip.iter())

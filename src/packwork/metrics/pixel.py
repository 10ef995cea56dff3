"""Measures by pixels: the paper's, of the true outlines, and how well a container's shape shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_to, label_components
from packwork.fields.morphology import closed
from packwork.geometry.outline import Outline, joined
from packwork.raster.coverage import image_shape
from packwork.raster.membership import centre_count
from packwork.scene.container import Container

RESOLUTION = 1_200
"""Pixels on the canvas' longer side, as in the paper."""

DISTANCE_CANVAS = 600
"""L-nU is in pixels of a canvas of this size."""


@dataclass(frozen=True)
class PixelMetrics:
    """Pixel measures of a layout.

    ``LC``: layout coverage: share of the container's pixels in at least one item.
    ``LC_ratio``: covered over uncovered pixels of the container, as the paper's text reads;
    infinite if all are covered.
    ``OO``: object overlap: pixels in two or more items over the container's pixels.
    ``EA``: exceeding area: pixels in an item and not in the container, over the container's.
    ``LnU``: layout non-uniformity: mean squared distance, in pixels of a 600 px canvas, from the
    container's uncovered pixels to the nearest item; 0 if all are covered.
    """

    LC: float
    LC_ratio: float
    OO: float
    EA: float
    LnU: float


def pixel_metrics(outlines: Sequence[Outline], container: Container) -> PixelMetrics:
    """Measure items in place (canvas units) against their container.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[0, 0], [8, 0], [8, 8], [0, 8.0]])])
    >>> half = Outline.from_rings([np.array([[0, 0], [4, 0], [4, 8], [0, 8.0]])])
    >>> pixel_metrics([half], Container("square", "square", square, 8, 8)).LC
    0.5
    """
    px_per_cu = RESOLUTION / container.side
    shape = image_shape(container.width, container.height, RESOLUTION)

    def to_px(points: FloatArray) -> FloatArray:
        return points * px_per_cu

    counts = _counts(outlines, to_px, shape)
    is_in_some = counts > 0
    inside = _counts([container.outline], to_px, shape) > 0
    whole = max(int(np.count_nonzero(inside)), 1)
    covered = int(np.count_nonzero(inside & is_in_some))
    uncovered = whole - covered
    return PixelMetrics(
        LC=covered / whole,
        LC_ratio=covered / uncovered if uncovered else float("inf"),
        OO=int(np.count_nonzero(counts > 1)) / whole,
        EA=(int(np.count_nonzero(is_in_some)) - covered) / whole,
        LnU=_non_uniformity(is_in_some, inside),
    )


AT_ONCE = 2_000
"""Outlines whose points are in memory side by side: those of a hundred thousand take gigabytes.
Chosen."""


def _counts(
    outlines: Sequence[Outline], to_px: Callable[[FloatArray], FloatArray], shape: tuple[int, int]
) -> npt.NDArray[np.int32]:
    """Outlines that hold each pixel's centre; ``to_px`` takes points ``(n, 2)`` to pixels."""
    counts = np.zeros(shape, dtype=np.int32)
    for first in range(0, len(outlines), AT_ONCE):
        points, starts = joined(outlines[first : first + AT_ONCE])
        counts += centre_count(to_px(points), starts, shape)
    return counts


def _non_uniformity(covered: BoolArray, inside: BoolArray) -> float:
    gaps = inside & ~covered
    if not gaps.any() or not covered.any():
        return 0.0
    distance = distance_to(covered)
    in_canvas = distance[gaps] * (DISTANCE_CANVAS / RESOLUTION)
    return float(np.mean(in_canvas**2))


SHAPE_RESOLUTION = 400
"""Pixels on the container's longer side. Larger is slower and changes neither number by a
hundredth. Tried."""

REACH = 0.03
"""Of the container's longer side: farther than that from any item, a place looks empty; and
gaps up to twice as wide are closed by the eye. Larger finds a sparse layout good, smaller a
cloud of words bad. Tried on 30 layouts, by eye."""

SPECK = 1e-4
"""Share of the container's square box below which a part of it is not looked at: it cannot be
seen whether there is anything in it. Chosen."""


@dataclass(frozen=True)
class ShapeMetrics:
    """Fidelity of a layout to its container's shape.

    ``bare``: share of the container that is farther from any item than 3 % of its longer side.
    ``shape``: overlap of the container with the layout's morphological closing by a disc of that
    radius: area of what both share, over that of both together. Bays of the container that such a
    disc cannot enter count for neither.
    ``parts``, ``bare_parts``: separate parts of the container large enough to be seen, and how many
    of them hold nothing.
    """

    bare: float
    shape: float
    parts: int
    bare_parts: int


def shape_metrics(outlines: Sequence[Outline], container: Container) -> ShapeMetrics:
    """Compare items in place (canvas units) with the shape they are to fill.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[0, 0], [8, 0], [8, 8], [0, 8.0]])])
    >>> half = Outline.from_rings([np.array([[0, 0], [4, 0], [4, 8], [0, 8.0]])])
    >>> found = shape_metrics([half], Container("square", "square", square, 8, 8))
    >>> found.bare, found.shape, found.bare_parts
    (0.47, 0.5, 0)
    """
    inside, covered = _images(outlines, container.outline)
    reach_px = REACH * SHAPE_RESOLUTION
    whole = int(np.count_nonzero(inside))
    if whole == 0:
        return ShapeMetrics(0.0, 1.0, 0, 0)
    bare = inside & (distance_to(covered) > reach_px)
    seen = closed(covered, reach_px)
    beyond = seen & ~closed(inside, reach_px)
    parts, empty = _parts(inside, covered)
    return ShapeMetrics(
        bare=int(np.count_nonzero(bare)) / whole,
        shape=int(np.count_nonzero(seen & inside)) / (whole + int(np.count_nonzero(beyond))),
        parts=parts,
        bare_parts=empty,
    )


def _images(outlines: Sequence[Outline], container: Outline) -> tuple[BoolArray, BoolArray]:
    """Pixels of the container, and those of the items, with a margin for what sticks out."""
    left, top, right, bottom = container.bounds
    px_per_cu = SHAPE_RESOLUTION / container.extent
    margin = int(REACH * SHAPE_RESOLUTION) + 2
    rows, columns = (int(np.ceil(v * px_per_cu)) + 2 * margin for v in (bottom - top, right - left))

    def to_px(points: FloatArray) -> FloatArray:
        return (points - [left, top]) * px_per_cu + margin

    several = [container], outlines
    inside, covered = (_counts(those, to_px, (rows, columns)) > 0 for those in several)
    return inside, covered


def _parts(inside: BoolArray, covered: BoolArray) -> tuple[int, int]:
    labels, count = label_components(inside)
    sizes = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    held = np.bincount(labels[covered & inside], minlength=count + 1)[1:]
    counts = sizes >= SPECK * SHAPE_RESOLUTION**2
    return int(np.count_nonzero(counts)), int(np.count_nonzero(counts & (held == 0)))

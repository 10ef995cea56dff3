"""All measures of a layout together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypedDict

import numpy as np
import shapely

from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import PORTION, regions
from packwork.metrics.exact import (
    STRIP,
    ExactMetrics,
    exact_coverage,
    exact_metrics,
    metrics_by_strips,
)
from packwork.metrics.pixel import PixelMetrics, ShapeMetrics, pixel_metrics, shape_metrics
from packwork.metrics.torus import in_cell, torus_metrics
from packwork.metrics.touching import touching_metrics
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.threads import at_once


class ExactShares(TypedDict):
    """Measures in exact geometry, by names that say what they are and by those of papers."""

    coverage: float
    """Share of the container that is covered."""
    overlap: float
    """Share that is covered twice."""
    outside: float
    """Area outside the container, as a share of it."""
    LC: float
    """Coverage."""
    OO: float
    """Overlap."""
    EA: float
    """Outside."""
    overlap_area: float
    """Overlap in squared canvas units."""
    outside_area: float
    """Outside in squared canvas units."""
    min_gap: float
    """Smallest distance of two items, canvas units."""


class Metrics(TypedDict):
    """Measures of a layout, as docs/reference/units.md explains them."""

    coverage: float
    """Share of the container that is covered."""
    overlap: float
    """Share that is covered twice."""
    outside: float
    """Area outside the container, as a share of it."""
    unevenness: float
    """Mean squared distance from uncovered points to the nearest item, px of 600."""
    LC: float
    """Coverage."""
    LC_ratio: float
    """Covered over uncovered."""
    OO: float
    """Overlap."""
    EA: float
    """Outside."""
    LnU: float
    """Unevenness."""
    LC_ink: float
    """Share of the container that is really drawn on, exact."""
    bare: float
    """Share of the container that is far from any item."""
    shape: float
    """How far the container's shape shows."""
    parts: int
    """Parts of the container that are large enough to be seen."""
    bare_parts: int
    """How many of these hold nothing."""
    exact: ExactShares
    """The same in exact geometry."""


@dataclass(frozen=True)
class LayoutMetrics:
    """All measures of a layout, by pixels and in exact geometry.

    ``pixel``: the paper's measures, of the outlines.
    ``exact``: the same shares without pixels, of the outlines.
    ``ink``: exact share of the container that is really drawn: holes and gaps of the items'
    appearance taken off.
    ``seen``: whether the container's shape shows, of the outlines.
    """

    pixel: PixelMetrics
    exact: ExactMetrics
    ink: float
    seen: ShapeMetrics

    def as_dict(self) -> Metrics:
        """Plain numbers under the names of the report, those that say what they are first."""
        pixel, exact, seen = self.pixel, self.exact, self.seen
        return Metrics(
            coverage=pixel.LC,
            overlap=pixel.OO,
            outside=pixel.EA,
            unevenness=pixel.LnU,
            LC=pixel.LC,
            LC_ratio=pixel.LC_ratio,
            OO=pixel.OO,
            EA=pixel.EA,
            LnU=pixel.LnU,
            LC_ink=self.ink,
            bare=seen.bare,
            shape=seen.shape,
            parts=seen.parts,
            bare_parts=seen.bare_parts,
            exact=ExactShares(
                coverage=exact.coverage,
                overlap=exact.overlap,
                outside=exact.exceeding,
                LC=exact.coverage,
                OO=exact.overlap,
                EA=exact.exceeding,
                overlap_area=exact.overlap_area,
                outside_area=exact.outside_area,
                min_gap=exact.min_gap,
            ),
        )


def measure(layout: Layout) -> LayoutMetrics:
    """Measure a layout's outlines, and the ink of its items, against its container.

    Of a tile on the torus: what lies in one cell of all that repeats.
    """
    if layout.container.lattice is not None:
        return _measured_in_cell(layout, layout.container.lattice)
    # Exact measures of many are themselves made by several threads.
    if len(layout.items) > STRIP:
        pixel, seen = at_once(_of_kind, [(_pixels, layout), (_shape, layout)])
        exact = exact_of(layout)
    else:
        pixel, seen, exact = at_once(
            _of_kind, [(_pixels, layout), (_shape, layout), (exact_of, layout)]
        )
    ink = exact.coverage if _is_all_ink(layout) else _ink_coverage(layout, exact)
    return LayoutMetrics(pixel=pixel, exact=exact, ink=ink, seen=seen)


def _measured_in_cell(layout: Layout, lattice: Lattice) -> LayoutMetrics:
    seen, whole = in_cell(layout.outlines, lattice), layout.container.outline
    cell = Container(layout.container.name, "", whole, lattice.width, lattice.height)
    exact = exact_of(layout)
    ink = exact.coverage
    if not _is_all_ink(layout):
        ink = exact_coverage(in_cell(layout.inks, lattice), whole)
    return LayoutMetrics(pixel_metrics(seen, cell), exact, ink, shape_metrics(seen, cell))


def _is_all_ink(layout: Layout) -> bool:
    return all(item.ink is item.outline for item in layout.items)


def _of_kind(kind: Callable[[Layout], Any], layout: Layout) -> Any:
    return kind(layout)


def exact_of(layout: Layout, *, once: bool = False) -> ExactMetrics:
    """Exact measures of a layout's outlines: within its container, or on the torus of a tile.

    With ``once`` the outlines in place are not kept for other measures.
    """
    container = layout.container
    if container.lattice is not None:
        return torus_metrics(layout.outlines, container.lattice)
    if (found := touching_metrics(layout)) is not None:
        return found
    if not once:
        return exact_metrics(layout.outlines, container.outline)
    places = np.column_stack([layout.poses.x, layout.poses.y])
    radii = np.array([item.outline.radius for item in layout.items])
    reach = (radii * layout.poses.axis_scales.max(axis=1))[:, None]
    boxes = np.hstack([places - reach, places + reach])
    return metrics_by_strips(boxes, lambda some: layout.placed(some.tolist()), container.outline)


def _pixels(layout: Layout) -> PixelMetrics:
    return pixel_metrics(layout.outlines, layout.container)


def _shape(layout: Layout) -> ShapeMetrics:
    return shape_metrics(layout.outlines, layout.container)


def _ink_coverage(layout: Layout, exact: ExactMetrics) -> float:
    container = layout.container.outline
    drawn = {(item.ink, item.outline): item for item in layout.items}
    areas = {key: item.outline.area for key, item in drawn.items() if item.ink is item.outline}
    others = [key for key in drawn if key not in areas]
    areas |= zip(others, _areas_inside([drawn[key] for key in others]), strict=True)
    own = np.array([areas[item.ink, item.outline] for item in layout.items])
    if not exact.is_clean or np.isnan(own).any() or not container.region.is_valid:
        return exact_coverage(layout.inks, container)
    # Inside outlines that neither meet nor stick out, ink does not either.
    return float((own * layout.poses.scale**2).sum() / container.region.area)


def _areas_inside(items: Sequence[Item]) -> list[float]:
    """Area of each item's ink, its own units; NaN if it is not inside its outline, or not valid."""
    found: list[float] = []
    for begin in range(0, len(items), PORTION):
        some = items[begin : begin + PORTION]
        inks, outlines = regions([one.ink for one in some]), regions([one.outline for one in some])
        is_inside = shapely.is_valid(inks) & shapely.is_valid(outlines)
        is_asked = is_inside & ~np.array([one.is_filled_ink for one in some])
        is_inside[is_asked] = shapely.covers(outlines[is_asked], inks[is_asked])
        found += np.where(is_inside, shapely.area(inks), np.nan).tolist()
    return found

"""Nesting: parts of true size on as little of a strip or sheet as possible."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
import shapely

from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.metrics.certificate import HAIR, Promise, broken, unclean
from packwork.metrics.measure import LayoutMetrics, measure
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.separation.shapes import FREE_TURNS, Part, boxes_of, spare
from packwork.separation.strip import StripSearch, WorkBound
from packwork.units import Unit

MOST_PARTS = 2_000
"""Parts of all kinds: prices of pairs take 64 bytes each, a pass over them a second."""

MOST_TURNS = 20_000
"""Angles of all kinds of parts: each is drawn once, in a millisecond."""

SPARSEST = 10.0
"""Length of a strip over that of one without gaps, at most."""


@dataclass(frozen=True, kw_only=True)
class SheetPart:
    """An item of true size, how many of it, and the angles at which it may lie."""

    item: Item
    count: int = 1
    angles: tuple[float, ...] | None = (0.0,)
    """In radians, clockwise on screen; None: any."""

    scale: float = 1.0
    """Sheet units of one of the item's own."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """Strip of a height, and of a length that need not be used up, on which parts lie."""

    height: float
    length: float = math.inf
    unit: Unit = "px"
    name: str = "sheet"


@dataclass(frozen=True)
class Nest:
    """Layout of all parts, on a container that is as long as they need."""

    layout: Layout
    metrics: LayoutMetrics
    faults: tuple[str, ...]
    certified: bool

    @property
    def length(self) -> float:
        """Used length, in the sheet's unit."""
        return self.layout.container.width

    def report(self) -> dict[str, Any]:
        """Plain numbers and texts for a report file."""
        return {
            **self.layout.manifest["nest"],
            "metrics": self.metrics.as_dict(), "faults": list(self.faults),
            "certified": self.certified,
        }  # fmt: skip


def nest(
    parts: Sequence[SheetPart], sheet: Sheet, *, gap: float = 0.0, seed: int = 0, workers: int = 2,
    work: WorkBound, stop: Callable[[], bool] = lambda: False,
) -> Nest:  # fmt: skip
    """Lay all parts on as short a part of a sheet as the search finds.

    Parameters
    ----------
    gap
        Smallest distance between parts, and of them from the sheet's edge, in its unit.
    work
        Passes or seconds that it searches.
    stop
        Asked after each pass whether to end with the best so far.

    Raises
    ------
    RecipeError
        If a part is higher than the sheet at every angle that it may have, or there is none.
    """
    parts = [one for one in parts if one.count]
    count = sum(one.count for one in parts)
    if not count:
        raise RecipeError("items", "there is nothing to nest; name parts")
    if count > MOST_PARTS:
        raise RecipeError("items", f"{count:,} parts are more than {MOST_PARTS:,}; nest fewer")
    turns = sum(FREE_TURNS if one.angles is None else len(one.angles) for one in parts)
    if turns > MOST_TURNS:
        raise RecipeError("rotate", f"{turns:,} angles of all parts are more than {MOST_TURNS:,}")
    # What is certified of a layout is a hair of its longer side, which no strip exceeds.
    sides = [one.item.outline.radius * 2.0 * one.scale for one in parts]
    longest = sum(side * one.count for side, one in zip(sides, parts, strict=True))
    areas = sum(one.item.outline.area * one.scale**2 * one.count for one in parts)
    longest = min(longest, SPARSEST * areas / sheet.height + 2.0 * max(sides))
    least = gap + 2.0 * HAIR * max(sheet.height, longest)
    regions = [_part(one, sheet, least) for one in parts]
    # A gap's half lies around each part; the other half to the edge is the sheet's.
    inner = sheet.height - least
    strip = StripSearch(regions, inner, seed=seed, workers=workers, work=work, stop=stop).run()
    items = tuple(one.item for one in parts for _ in range(one.count))
    scales = [one.scale for one in parts for _ in range(one.count)]
    x, y, angle = strip.poses.T
    poses = Poses(x + least / 2.0, y + least / 2.0, angle, scales)
    placed = Layout(_sheet_of(sheet, strip.length + least), items, poses, np.ones(len(items)))
    area = float(placed.areas.sum())
    promise = Promise(gap)
    about = {
        "length": placed.container.width, "height": sheet.height, "unit": sheet.unit,
        "sheet_length": sheet.length if math.isfinite(sheet.length) else None,
        "parts": len(items), "density": area / (placed.container.width * sheet.height),
        "passes": work.done, "seed": seed, "workers": workers,
    }  # fmt: skip
    manifest = {"promised": asdict(promise), "nest": about, "seed": seed}
    layout = replace(placed, manifest=manifest)
    metrics = measure(layout)
    faults = tuple(broken(promise, layout, metrics.exact))
    certified = not faults and not unclean(promise, layout, metrics.exact)
    return Nest(layout, metrics, faults, certified)


def _part(asked: SheetPart, sheet: Sheet, gap: float) -> Part:
    """The part as the search takes it, with half the gap about it."""
    region = shapely.transform(asked.item.outline.region, lambda points: points * asked.scale)
    part = Part(region=spare(region, gap), count=asked.count, turns=asked.angles)
    boxes = boxes_of(part)[1]
    height = float((boxes[:, 3] - boxes[:, 1]).min()) + gap
    if height > sheet.height:
        raise RecipeError(
            "items",
            f"{asked.item.name} is {height:.9g} {sheet.unit} high with the distance that it keeps, "
            f"and the sheet {sheet.height:.9g} {sheet.unit}; allow other angles or a larger one",
        )
    return part


def _sheet_of(sheet: Sheet, length: float) -> Container:
    return Container(
        sheet.name, sheet.name, Outline.box(0.0, 0.0, length, sheet.height), length, sheet.height,
        sheet.unit,
    )  # fmt: skip

"""Sheets and parts of a nest, and the sheets with parts on them that come of it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.geometry import box

from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import Region
from packwork.geometry.rectangles import ROUNDING
from packwork.metrics.certificate import Promise, broken, unclean
from packwork.metrics.measure import LayoutMetrics, measure
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.mapped import mirrored
from packwork.scene.pose import Poses
from packwork.separation.shapes import Floats
from packwork.units import Unit
from packwork.writers.placements import line_lengths, turned_over

SLIVER = 0.01
"""Share of a sheet's height up to which what lies below its parts is not told."""


@dataclass(frozen=True, kw_only=True)
class SheetPart:
    """An item of true size, how many of it, and the angles at which it may lie."""

    item: Item
    count: int = 1
    angles: tuple[float, ...] | None = (0.0,)
    """In radians, clockwise on screen; None: any."""

    scale: float = 1.0
    """Sheet units of one of the item's own."""

    mirrors: bool = False
    """Whether it may be turned over."""

    priority: int = 0
    """Parts of a higher one are laid first, and are not left out for those of a lower one."""

    is_optional: bool = False
    """Whether it only fills what the others leave of the sheets that they take. Not on a strip."""

    together: str = ""
    """Name: all parts of the same one lie on one sheet, or none of them is laid."""


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """Ground for parts: a rectangle, any outline, a strip of open length, a least square."""

    height: float
    length: float = math.inf
    unit: Unit = "px"
    name: str = "sheet"
    count: int | None = None
    """Number of them; None: as many as are needed."""

    outline: Outline | None = None
    """Region of it that may be used, with holes; None: all of it."""

    held: Layout | None = None
    """Layout that lies on it already, and stays where it is."""

    @property
    def is_strip(self) -> bool:
        """True for a strip of open length, and for a square of open side."""
        return math.isinf(self.length)

    @property
    def is_square(self) -> bool:
        """True for the smallest square that holds all parts."""
        return math.isinf(self.height)

    @cached_property
    def region(self) -> Region:
        """Region of a sheet that is no strip."""
        return box(0.0, 0.0, self.length, self.height) if self.outline is None else (
            self.outline.region
        )  # fmt: skip

    def scaled(self, scale: float, unit: Unit) -> Sheet:
        """The same sheet in another unit, of which one of its own has ``scale``."""
        if unit == self.unit:
            return self
        if self.held is not None:
            raise RecipeError("sheet", f"{self.name} is in {self.unit}, others are in {unit}")
        outline = self.outline
        if outline is not None:
            outline = outline.mapped(affine.similarity(0.0, 0.0, 0.0, scale))
        return replace(
            self, height=self.height * scale, length=self.length * scale, unit=unit, outline=outline
        )

    def container(self, length: float) -> Container:
        """The sheet as a container; a strip is cut off at its used length."""
        if self.is_strip:
            height = length if self.is_square else self.height
            outline = Outline.box(0.0, 0.0, length, height)
            return Container(self.name, self.name, outline, length, height, self.unit)
        outline = self.outline or Outline.box(0.0, 0.0, self.length, self.height)
        return Container(self.name, self.name, outline, self.length, self.height, self.unit)


@dataclass(frozen=True)
class NestedSheet:
    """One sheet with the parts on it.

    ``length``, ``height``: how far from its left and its top edge it is used, in its unit.
    """

    layout: Layout
    metrics: LayoutMetrics
    length: float
    height: float
    faults: tuple[str, ...]
    certified: bool

    @property
    def used_area(self) -> float:
        """Area of the sheet left of its used length."""
        outline = self.layout.container.outline.region
        x0, y0, _, y1 = outline.bounds
        return float(intersection(outline, box(x0, y0, self.length, y1)).area)

    @property
    def rest_area(self) -> float:
        """Area of the sheet right of its used length."""
        return max(float(self.layout.container.outline.region.area) - self.used_area, 0.0)

    @property
    def rest(self) -> str:
        """Sizes of what lies right of its used length and below its parts; empty for nothing.

        Of a sheet that is no rectangle, the area of the former.
        """
        ground = self.layout.container
        if not ground.outline.region.equals(box(0.0, 0.0, ground.width, ground.height)):
            return f"{self.rest_area:,.1f} {ground.unit}²" if self.rest_area else ""
        right, below = ground.width - self.length, ground.height - self.height
        pieces = [(right, ground.height)] if self.rest_area else []
        if below > SLIVER * ground.height:
            pieces.append((self.length, below))
        return " and ".join(f"{w:.6g} x {h:.6g} {ground.unit}" for w, h in pieces)

    @property
    def density(self) -> float:
        """Area of its parts over that of the sheet left of its used length."""
        return float(self.layout.areas.sum() / self.used_area)


@dataclass(frozen=True)
class NestedSheets:
    """All sheets that are used, in their order.

    ``unplaced``: parts that found no room, and how many of each; ``left``: optional ones;
    ``unplaced_area``: area of the former; ``advice``: sentences on what may do better.
    """

    sheets: tuple[NestedSheet, ...]
    unplaced: tuple[tuple[Item, int], ...]
    left: tuple[tuple[Item, int], ...]
    about: dict[str, Any]
    unplaced_area: float = 0.0
    advice: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Used length of the last sheet, in its unit."""
        return self.sheets[-1].length if self.sheets else 0.0

    @property
    def density(self) -> float:
        """Area of all parts over that of the sheets that they take, the last one as far as used."""
        used = sum(one.used_area for one in self.sheets)
        return sum(float(one.layout.areas.sum()) for one in self.sheets) / used if used else 0.0

    @cached_property
    def line_lengths(self) -> tuple[float, float]:
        """Lengths of all lines that are cut and of those that are engraved, in the sheets' unit."""
        every = [line_lengths(one.layout) for one in self.sheets]
        return sum(cut for cut, _ in every), sum(engraved for _, engraved in every)

    @property
    def certified(self) -> bool:
        """Whether all that is laid keeps what is promised."""
        return bool(self.sheets) and all(one.certified for one in self.sheets)

    @property
    def faults(self) -> tuple[str, ...]:
        """Parts of the promise that do not hold, a sentence each."""
        return tuple(fault for one in self.sheets for fault in one.faults)

    def report(self) -> dict[str, Any]:
        """Plain numbers and texts for a report file."""
        sheets = [
            {"length": one.length, "density": one.density, "parts": len(one.layout.items),
             "rest_area": one.rest_area, "metrics": one.metrics.as_dict()}
            for one in self.sheets
        ]  # fmt: skip
        return {
            **self.about, "parts": sum(one["parts"] for one in sheets), "length": self.length,
            "density": self.density, "sheets": sheets, "cut_length": self.line_lengths[0],
            "engraved_length": self.line_lengths[1], "unplaced_area": self.unplaced_area,
            "unplaced": [{"part": item.name, "count": count} for item, count in self.unplaced],
            "optional_left": [{"part": item.name, "count": count} for item, count in self.left],
            "faults": list(self.faults), "certified": self.certified, "advice": list(self.advice),
        }  # fmt: skip


def sheet_file(path: Path, number: int, count: int) -> Path:
    """File of one of several sheets.

    >>> sheet_file(Path("a.dxf"), 2, 3).name, sheet_file(Path("a.dxf"), 1, 1).name
    ('a-2.dxf', 'a.dxf')
    """
    return path.with_name(f"{path.stem}-{number}{path.suffix}") if count > 1 else path


def layout_on(sheet: Sheet, laid: Sequence[SheetPart], poses: Floats, edge: float) -> Layout:
    """Layout of a sheet: what it held, and parts at poses (x, y, angle, side)."""
    x, y, angle, side = poses.T
    over = side < 0.0
    turned = {one.item: mirrored(one.item) for one in dict.fromkeys(laid) if one.mirrors}
    items = [turned[one.item] if is_over else one.item
             for one, is_over in zip(laid, over, strict=True)]  # fmt: skip
    placed = Poses(x, y, angle, np.array([one.scale for one in laid]))
    far = [item.outline.mapped(placed.matrix(k)).bounds[2:] for k, item in enumerate(items)]
    right = max((max(one) if sheet.is_square else one[0] for one in far), default=0.0)
    container = sheet.container(right + edge)
    before = 0 if sheet.held is None else len(sheet.held.items)
    if sheet.held is not None:
        items = [*sheet.held.items, *items]
        placed = Poses(*(
            np.concatenate([getattr(sheet.held.poses, one.name), getattr(placed, one.name)])
            for one in fields(Poses)
        ))  # fmt: skip
    earlier = [] if sheet.held is None else sorted(turned_over(sheet.held))
    numbers = [*earlier, *(np.flatnonzero(over) + before + 1).tolist()]
    usual = Counter(one.angles for one in laid).most_common(1)[0][0] if laid else ()
    own = [k for k, one in enumerate(laid, before + 1) if one.angles != usual]
    rules = {"mirrored": numbers, "rotate": rotation_text(usual),
             "own_angles": [*range(1, before + 1), *own]}  # fmt: skip
    return Layout(container, tuple(items), placed, np.ones(len(items)), rules)


def rotation_text(angles: tuple[float, ...] | None) -> str:
    """Angles as options of runs say them.

    >>> rotation_text(None), rotation_text((0.0, math.pi)), rotation_text((0.0,))
    ('free', '0,180', '0,')
    """
    if angles is None:
        return "free"
    degrees = ",".join(f"{math.degrees(angle):.12g}" for angle in angles)
    return degrees if len(angles) > 1 else f"{degrees or 0},"


def measured(layout: Layout, promise: Promise, edge: float, about: dict[str, Any]) -> NestedSheet:
    """A sheet, measured; ``edge``: distance that parts keep from its edge."""
    regions = [outline.region for outline in layout.outlines]
    length, height = layout.container.width, layout.container.height
    _, _, right, bottom = shapely.total_bounds(regions)
    if about["sheet_length"] is not None:
        length, height = min(right + edge, length), min(bottom + edge, height)
    used = {**about, "parts": len(regions), "length": float(length), **layout.manifest}
    manifest = {"promised": asdict(promise), "nest": used, "seed": about["seed"]}
    layout = replace(layout, manifest=manifest)
    metrics = measure(layout)
    faults = tuple(broken(promise, layout, metrics.exact))
    boundary, margin, unit = (
        layout.container.outline.region.boundary,
        about["margin"],
        about["unit"],
    )
    nearest = float(shapely.distance(boundary, regions).min())
    if nearest < margin - ROUNDING * layout.container.side:
        faults += (f"a part is {nearest:.3g} {unit} from the edge instead of {margin:.3g} {unit}",)
    certified = not faults and not unclean(promise, layout, metrics.exact)
    return NestedSheet(layout, metrics, float(length), float(height), faults, certified)

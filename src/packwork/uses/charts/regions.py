"""Groups of a chart in the parts of a container that have their names, as on a map.

A name is written at the top of its part, and that place is taken off the room of the part's marks,
so that none covers it.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray
from packwork.errors import RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference, polygon_parts, simplify
from packwork.geometry.polygon import Region
from packwork.phrasing import enumerated
from packwork.readers.container import read_parts
from packwork.readers.maps import region_key
from packwork.readers.tables.cells import cell_text
from packwork.scene.container import Container
from packwork.uses.charts.groups import left_out
from packwork.uses.charts.marks import ChartRead
from packwork.uses.charts.pen import Pen

_LOG = logging.getLogger("packwork")

APART = 0.003
"""Width along a border that marks keep free on either side, over the canvas' longer side. Larger
wastes small parts, smaller lets marks of neighbours seem one group. Chosen by eye."""

SLIM = 0.04
"""The same over the side of a square as large as the part, at most: the smallest part gives all
marks their scale, and may be a few pixels wide. Chosen by eye."""

ISLAND = 0.01
"""Share of a part's area that an island of it has at least to take marks. Smaller ones have no room
for one and cost time. Chosen."""

SPECK = 0.001
"""Side of a square as large as the room of a part, over the canvas' longer side, at least: marks
in less are not seen. Chosen."""

LARGEST, SMALLEST, SIZES = 0.024, 0.014, 4
"""Height of an em of names over the canvas' longer side, and how many are tried. Larger takes the
room of marks, smaller cannot be read. Chosen by eye."""

MOST_OF = 0.12
"""Share of a full part that its name takes at most: the fullest part gives all marks their scale,
and a larger one would make all of them smaller. Chosen."""

SPARE = 2.0
"""How much more room to its marks than the fullest part a part keeps beside a larger name. Smaller
names more parts and may make marks smaller, where a name leaves only nooks. Chosen."""

WIDE_EM, HIGH_EM, FOOT_EM = 0.6, 1.35, 0.35
"""Room beside letters on both sides together, height of it, and from its foot to their line."""

PLACES = 40
"""Places each way that are tried for a name. Chosen."""

BORDER = 0.0012
"""Width of a border that is drawn, over the canvas' longer side. Chosen by eye."""

FINE = 0.0005
"""By how much a border that is drawn may be off, over the same. Chosen by eye."""


@dataclass(frozen=True, eq=False)
class NamedRegion:
    """A part of a container: what is drawn of it, the room of its marks, and its name's place.

    ``em``: height of the name's letters, 0 for none; ``x``: their middle, ``y``: their line.
    """

    name: str
    border: Outline
    room: Outline
    em: float = 0.0
    x: float = 0.0
    y: float = 0.0

    def mapped(self, matrix: FloatArray) -> NamedRegion:
        """Image under a map that neither turns nor stretches."""
        x, y = affine.apply(matrix, np.array([[self.x, self.y]]))[0].tolist()
        border, room = (one.mapped(matrix) for one in (self.border, self.room))
        return replace(self, border=border, room=room, em=self.em * float(matrix[0, 0]), x=x, y=y)


def in_regions(chart: ChartRead, container: Container) -> tuple[ChartRead, list[NamedRegion]]:
    """A chart of those rows whose group is a part of a container, and these parts.

    Parts come in the order of the groups, then those that have none.

    Raises
    ------
    RecipeError
        If the container names no parts, or none that is a group.
    """
    named = read_parts(container, asked=chart.groups)
    if not named:
        raise RecipeError(
            "in_regions",
            f"{container.name} names no parts; use a map in GeoJSON, or an SVG whose shapes have "
            "titles or ids",
        )
    parts = {region_key(name): (name, region) for name, region in named}
    known = [region_key(name) in parts for name in chart.groups]
    if not any(known):
        met, there = (enumerated(list(one), 4) for one in (chart.groups, [n for n, _ in named]))
        raise RecipeError(
            "in_regions", f"no part of {container.name} is named {met}; it has {there}"
        )
    found = _without_strangers(chart, np.array(known))
    order = [*(region_key(name) for name in found.groups)]
    order += [name for name in parts if name not in set(order)]
    titles = dict(zip(order, found.groups, strict=False))
    asked = np.bincount(found.group_of, weights=found.areas, minlength=len(found.groups))
    rooms = [parts[name][1].area for name in order[: len(asked)]]
    kept = SPARE * asked * float((np.array(rooms) / asked).min())
    least = dict(zip(order, kept.tolist(), strict=False))
    return found, _regions({name: parts[name] for name in order}, titles, least, container)


def _without_strangers(chart: ChartRead, known: BoolArray) -> ChartRead:
    """The chart without marks whose group is no part, which is told."""
    if known.all():
        return chart
    kept = np.flatnonzero(known[chart.group_of])
    new = np.cumsum(known) - 1
    left = chart.subset(kept)
    strange = {region_key(name) for name, one in zip(chart.groups, known, strict=True) if not one}
    column = chart.options.by or ""
    rows = [
        k for k, row in enumerate(chart.table.rows)
        if region_key(cell_text(row.get(column))) in strange
    ]  # fmt: skip
    told = left_out(chart.table, column, "is no part of the map", rows, chart.options.label_by)
    _LOG.warning("%s", told)
    return replace(
        left,
        groups=tuple(name for name, one in zip(chart.groups, known, strict=True) if one),
        group_of=new[left.group_of],
        notices=(*chart.notices, told),
        lost=(*chart.lost, told),
        ends=(float(left.values.min()), float(left.values.max())),
    )


def _regions(
    parts: Mapping[str, tuple[str, Region]],
    titles: Mapping[str, str],
    least: Mapping[str, float],
    container: Container,
) -> list[NamedRegion]:
    """Parts with room for marks and a place for their names, which leave those the ``least``."""
    side = container.side
    found = []
    for key, (name, region) in parts.items():
        title, border = titles.get(key, name), Outline.from_region(region)
        apart = min(APART * side, SLIM * float(np.sqrt(region.area)))
        inner = buffered(region, -apart, join_style="mitre")
        room = _without_islands(inner)
        if room.area < (SPECK * side) ** 2:
            if key in titles:
                raise RecipeError("in_regions", f"{title} has no room for marks; leave it out")
            found.append(NamedRegion(title, border, border))
            continue
        em, x, y, plate = _place(title, room, side, least.get(key, 0.0))
        if plate is not None:
            room = _without_islands(difference(room, plate))
        found.append(NamedRegion(title, border, Outline.from_region(room), em, x, y))
    return found


def _without_islands(room: Region) -> shapely.MultiPolygon:
    """Parts that have room for marks, with all their holes: others lie there, or a name."""
    parts = polygon_parts(room)
    return shapely.MultiPolygon([part for part in parts if part.area > ISLAND * room.area])


def _place(
    name: str, room: Region, side: float, least: float
) -> tuple[float, float, float, Region | None]:
    """Height of a name's letters, their middle and line, and the plate they take.

    It is as high up in the room as goes, and as far in the middle there; of no height and plate
    where the room is too narrow.
    """
    left, top, right, bottom = room.bounds
    x, y = (one.ravel() for one in np.meshgrid(
        np.linspace(left, right, PLACES), np.linspace(top, bottom, PLACES)
    ))  # fmt: skip
    shapely.prepare(room)
    for em in np.geomspace(LARGEST, SMALLEST, SIZES) * side:
        wide, high = Pen.width(name, em) + WIDE_EM * em, HIGH_EM * em
        if wide * high > max(MOST_OF * room.area, room.area - least):
            continue
        boxes = shapely.box(x - wide / 2, y, x + wide / 2, y + high)
        fits = np.flatnonzero(shapely.contains(room, boxes))
        if len(fits):
            highest = fits[y[fits] <= y[fits].min() + high]
            best = highest[np.argmin(np.abs(x[highest] - x[fits].mean()))]
            foot = float(y[best] + high - FOOT_EM * em)
            return float(em), float(x[best]), foot, boxes[best]
    return 0.0, 0.0, 0.0, None


def draw_regions(pen: Pen, regions: Sequence[NamedRegion], side: float, pale: str) -> None:
    """Borders and names of all parts."""
    for one in regions:
        plainer = simplify(one.border.region, FINE * side, keeps_topology=True)
        drawn = buffered(plainer.boundary, BORDER * side / 2)
        try:
            pen.shape(Outline.from_region(drawn), 0.0, 0.0, 1.0, pale)
        except ShapeError:
            continue
        if one.em:
            pen.write_about(one.name, one.x, one.y, one.em)

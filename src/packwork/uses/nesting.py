"""Nesting: parts of true size on as few sheets and as little of the last one as possible.

It tells of parts of several pieces, which come apart when they are cut.
"""

from __future__ import annotations

import logging
import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from shapely.geometry import box

from packwork.compaction.outer_simplify import inner_simplified
from packwork.errors import RecipeError
from packwork.geometry.overlay import buffered, polygon_parts
from packwork.geometry.polygon import Region
from packwork.metrics.certificate import HAIR, Promise
from packwork.phrasing import enumerated
from packwork.progress import Stop, until_over
from packwork.separation.container import SquareGround, SquareSearch
from packwork.separation.ground import Ground
from packwork.separation.push import pushed
from packwork.separation.shapes import FREE_TURNS, Part, boxes_of, placed, spare
from packwork.separation.strip import StripSearch, WorkBound
from packwork.separation.windows import (
    EMPTIEST,
    FreeSheet,
    LaidSheet,
    lay_on_sheets,
    lay_on_strip,
)
from packwork.uses.fewer_sheets import advice_on_sheets
from packwork.uses.nested import NestedSheet, NestedSheets, Sheet, SheetPart, layout_on, measured
from packwork.uses.tilings import tiling_of
from packwork.uses.tool_reach import tell_unreached

_LOG = logging.getLogger("packwork")


def tell_pieces(parts: Sequence[SheetPart]) -> None:
    """Name parts of more than one piece, and how many they have, in a line of the log."""
    pieces = {
        one.item.name: int(shapely.get_num_geometries(one.item.outline.region)) for one in parts
    }
    if loose := [f"{name} ({count})" for name, count in pieces.items() if count > 1]:
        _LOG.warning("of several pieces, which come apart when they are cut: %s", enumerated(loose))


FEW = 400
"""Parts up to which a strip is searched as a whole: of 600, pieces are 2 to 5 points denser within
a minute. Tried."""

MOST_AT_ONCE = 2_000
"""Parts of one search: prices of pairs take 64 bytes each, a pass over them a second."""

MOST_PARTS = 100_000
"""Parts on sheets or a strip, which are laid a few sheets, or a piece, after the other."""

MOST_TURNS = 20_000
"""Angles of all kinds of parts: each is drawn once, in a millisecond."""

SPARSEST = 10.0
"""Length of a strip over that of one without gaps, at most."""

MOST_SHEETS = 10_000

MOST_EDGE_CORNERS, EDGE_TOLERANCE = 256, 2e-4
"""Sheets whose edge has more are simplified, inward, for the search, by that share of its side."""


def nest(
    parts: Sequence[SheetPart], sheets: Sequence[Sheet], *, gap: float = 0.0,
    margin: float | None = None, tool: float = 0.0, seed: int = 0, workers: int = 2,
    work: WorkBound, stop: Callable[[], bool] = lambda: False,
) -> NestedSheets:  # fmt: skip
    """Lay parts on as few sheets as the search finds, and on as short a part of the last one.

    Parameters
    ----------
    sheets
        All kinds of them, taken in this order; of one unit. A strip is alone.
    gap
        Smallest distance between parts, in the sheets' unit.
    margin
        Smallest distance of parts from a sheet's edge, at least the gap; the gap if None.
    tool
        Diameter of what goes round parts: the gap at least; places that it cannot enter are told.
    work
        Passes or seconds that it searches.
    stop
        Asked after each pass whether to end with the best so far.

    Raises
    ------
    RecipeError
        If a part is larger than every sheet at every angle that it may have, or there is none.
    """
    parts = [one for one in parts if one.count]
    _check(parts, sheets)
    gap = max(gap, tool)
    tell_pieces(parts)
    if tool:
        tell_unreached(parts, tool, sheets[0].unit)
    margin = _margin(margin, gap, sheets[0].unit)
    about = {
        "unit": sheets[0].unit,
        "height": None if sheets[0].is_square else sheets[0].height,
        "sheet_length": None if sheets[0].is_strip else sheets[0].length,
        "gap": gap, "margin": margin, "effort": work.name or None, "passes": 0,
        "seed": seed, "workers": workers,
    }  # fmt: skip
    tiled = _tiled(parts, sheets, about, until_over(stop, work.seconds))
    if tiled is not None and tiled[1]:
        return tiled[0]
    # What is certified of a layout is a hair of its longer side.
    hair = 2.0 * HAIR * max(_longest(parts, sheet) for sheet in sheets)
    least, edge = gap + hair, margin + hair
    # A gap's half lies around each part; what is left to the edge is the sheet's.
    inset = edge - least / 2.0
    kept = [_part(one, least) for one in parts]
    if sheets[0].is_strip:
        height, work.margins = sheets[0].height - 2.0 * inset, 2.0 * inset
        _check_fit(parts, kept, [(math.inf, height)], sheets, 2.0 * inset)
        lay = lay_on_strip
        if sheets[0].is_square or sum(part.count for part in kept) <= FEW:
            lay = _lay_at_once
        on_it = lay(kept, height, seed=seed, workers=workers, work=work, stop=stop)
        kinds, missing = [0], Counter[int]()
        on_it = _together(kept, on_it, FreeSheet(_as_long(kept, on_it, height)))
        laid = [replace(on_it, poses=on_it.poses + np.array([inset, inset, 0.0, 0.0]))]
    else:
        usable = [_usable(sheet, inset) for sheet in sheets]
        bounds = [one.bounds for one in usable]
        sizes = [(x1 - x0, y1 - y0) for x0, y0, x1, y1 in bounds]
        _check_fit(parts, kept, sizes, sheets, 2.0 * inset)
        held = [_held(sheet, least) for sheet in sheets]
        kinds = _kinds(sheets, [one.area for one in usable], kept)
        free = [FreeSheet(usable[kind], held[kind]) for kind in kinds]
        laid, missing = lay_on_sheets(
            kept, free, seed=seed, workers=workers, work=work, stop=stop
        )  # fmt: skip
        laid = [_together(kept, one, free[one.sheet]) for one in laid]
    about["passes"] = work.done
    by_sheet = {one.sheet: one for one in laid}
    found = list[NestedSheet]()
    for k, kind in enumerate(kinds):
        if k in by_sheet or sheets[kind].held is not None:
            on_it = by_sheet.get(k, LaidSheet(k, (), np.zeros((0, 4))))
            layout = layout_on(sheets[kind], [parts[n] for n in on_it.kinds], on_it.poses, edge)
            found.append(measured(layout, Promise(gap), edge, about))
    result = _result(found, parts, missing, about)
    if tiled is not None and _rank(tiled[0]) < _rank(result):
        return tiled[0]
    if result.unplaced or any(sheet.held is not None for sheet in sheets):
        return result
    return replace(result, advice=advice_on_sheets(found, parts, gap, edge, work))


def _result(
    found: Sequence[NestedSheet], parts: Sequence[SheetPart], missing: Counter[int],
    about: dict[str, Any],
) -> NestedSheets:  # fmt: skip
    unplaced, optional = (
        tuple((parts[n].item, missing[n]) for n in sorted(missing) if parts[n].is_optional is left)
        for left in (False, True)
    )
    areas = [one.item.outline.region.area * one.scale**2 for one in parts]
    lacking = sum(areas[n] * count for n, count in missing.items() if not parts[n].is_optional)
    return NestedSheets(tuple(found), unplaced, optional, about, lacking)


def _tiled(
    parts: Sequence[SheetPart], sheets: Sequence[Sheet], about: dict[str, Any], stop: Stop
) -> tuple[NestedSheets, bool] | None:
    """Rectangles in exact places, certified, and whether they need no less; None of others."""
    gap, margin = about["gap"], about["margin"]
    tiling = tiling_of(parts, sheets, gap, margin, about["seed"], stop)
    if tiling is None:
        return None
    found = [
        measured(layout_on(sheets[0], [tiling.parts[n] for n in one.kinds], one.poses, margin),
                 Promise(gap), margin, about)
        for one in tiling.sheets
    ]  # fmt: skip
    result = _result(found, parts, tiling.missing, about)
    return (result, tiling.is_least) if result.certified else None


def _rank(found: NestedSheets) -> tuple[float, int, float]:
    """Order of nests, the best first: what has no room, sheets, and the last one's length."""
    return found.unplaced_area, len(found.sheets), found.length


def _lay_at_once(
    parts: Sequence[Part], height: float, *, seed: int, workers: int, work: WorkBound,
    stop: Callable[[], bool],
) -> LaidSheet:  # fmt: skip
    """Lay parts on a strip, or on a square where its height is infinite, in one search."""
    search, ground = StripSearch, Ground(height)
    if math.isinf(height):
        search, ground = SquareSearch, SquareGround()
    strip = search(parts, ground, seed=seed, workers=workers, work=work, stop=stop)
    poses = strip.run().poses
    return LaidSheet(0, tuple(strip.problem.shape_of.tolist()), poses)


def _together(parts: Sequence[Part], laid: LaidSheet, ground: FreeSheet) -> LaidSheet:
    """A sheet whose parts are pushed together, so that what is left over is one piece."""
    regions = _regions(parts, laid)
    ways = pushed(regions, ground.region, ground.held)
    return replace(laid, poses=laid.poses + np.pad(ways, ((0, 0), (0, 2))))


def _regions(parts: Sequence[Part], laid: LaidSheet) -> list[Region]:
    return [placed(parts[n].region, pose) for n, pose in zip(laid.kinds, laid.poses, strict=True)]


def _as_long(parts: Sequence[Part], laid: LaidSheet, height: float) -> Region:
    """As much of a strip, or of a square, as its parts take."""
    _, _, right, bottom = shapely.total_bounds(_regions(parts, laid))
    return box(0.0, 0.0, right, min(height, bottom))


def _check(parts: Sequence[SheetPart], sheets: Sequence[Sheet]) -> None:
    for one in parts:
        if one.count < 0:
            raise RecipeError("items", f"there are {one.count} of {one.item.name}; use 0 or more")
    if any(sheet.count == 0 for sheet in sheets):
        raise RecipeError("sheet", "there are 0 of it; give 1 or more")
    count = sum(one.count for one in parts)
    if not count:
        raise RecipeError("items", "there is nothing to nest; name parts")
    most = MOST_AT_ONCE if sheets[0].is_square else MOST_PARTS
    if count > most:
        raise RecipeError("items", f"{count:,} parts are more than {most:,}; nest fewer")
    turns = sum(FREE_TURNS if one.angles is None else len(one.angles) for one in parts)
    if turns > MOST_TURNS:
        raise RecipeError("rotate", f"{turns:,} angles of all parts are more than {MOST_TURNS:,}")
    optional = next((one for one in parts if one.is_optional), None)
    if sheets[0].is_strip and optional is not None:
        raise RecipeError(
            "items",
            f"{optional.item.name} is optional, and a strip of open length has always room; give a "
            "sheet, or take out --optional or the column 'optional'",
        )
    sets = Counter[str]()
    for one in parts:
        sets[one.together] += one.count if one.together else 0
        column = f"column 'together' of {one.item.name}"
        if one.is_optional and one.together:
            raise RecipeError("items", f"{column}: parts of a name are laid all or none; make them "
                              "not optional, or leave that cell empty")  # fmt: skip
        if sets[one.together] > MOST_AT_ONCE:
            raise RecipeError(
                "items", f"{column}: more than {MOST_AT_ONCE:,} parts go together; nest fewer"
            )
    if len(sheets) > 1 and any(sheet.is_strip for sheet in sheets):
        raise RecipeError(
            "sheet",
            "a strip of open length has no end after which others come; a number with decimals has "
            "a point, as 600.5x400mm",
        )


def _margin(margin: float | None, gap: float, unit: str) -> float:
    """Distance from the edge: the gap unless one is given; RecipeError where that is less."""
    if margin is None or margin >= gap:
        return gap if margin is None else margin
    raise RecipeError(
        "margin",
        f"{margin:g} is less than {gap:g}, the distance of parts; to go nearer to the edge, give a "
        f"sheet whose sides are {2.0 * (gap - margin):g} {unit} longer",
    )


def _longest(parts: Sequence[SheetPart], sheet: Sheet) -> float:
    """Longer side of a sheet; of a strip, one that its used length does not exceed."""
    if not sheet.is_strip:
        return max(sheet.length, sheet.height)
    sides = [one.item.outline.radius * 2.0 * one.scale for one in parts]
    in_a_row = sum(side * one.count for side, one in zip(sides, parts, strict=True))
    hulls = [one.item.outline.region.convex_hull.area * one.scale**2 for one in parts]
    areas = sum(hull * one.count for hull, one in zip(hulls, parts, strict=True))
    if sheet.is_square:
        return float(min(in_a_row, math.sqrt(SPARSEST * areas) + 2.0 * max(sides)))
    most = SPARSEST * areas / sheet.height + 2.0 * max(sides)
    return float(max(sheet.height, min(in_a_row, most)))


def _part(asked: SheetPart, gap: float) -> Part:
    """The part as the search takes it, with half the gap about it."""
    region = shapely.transform(asked.item.outline.region, lambda points: points * asked.scale)
    return Part(
        region=spare(region, gap), count=asked.count, turns=asked.angles, mirrors=asked.mirrors,
        priority=asked.priority, is_optional=asked.is_optional, together=asked.together,
    )  # fmt: skip


def _usable(sheet: Sheet, inset: float) -> Region:
    """Region of a sheet in which parts may lie, each with half the gap about it."""
    region = sheet.region
    if shapely.get_num_coordinates(region) > MOST_EDGE_CORNERS:
        x0, y0, x1, y1 = region.bounds
        region = inner_simplified(region, EDGE_TOLERANCE * math.hypot(x1 - x0, y1 - y0))
    inner = buffered(region, -inset, join_style="mitre")
    if not polygon_parts(inner):
        raise RecipeError("sheet", f"{sheet.name} has no room within its margin")
    return inner


def _kinds(sheets: Sequence[Sheet], areas: Sequence[float], parts: Sequence[Part]) -> list[int]:
    """Numbers of the kinds of sheets, as often as there are some or as they may be needed.

    That is one for each part at most: two that are longer and wider than half a sheet cover a
    quarter of it.
    """
    needed = sum(part.count * part.region.area for part in parts) / EMPTIEST
    count = sum(part.count for part in parts)
    taken = list[int]()
    for k, (sheet, area) in enumerate(zip(sheets, areas, strict=True)):
        enough = min(max(math.ceil(needed / area) + 2, count), MOST_SHEETS)
        taken += [k] * (enough if sheet.count is None else sheet.count)
    return taken


def _check_fit(
    parts: Sequence[SheetPart], kept: Sequence[Part], sizes: Sequence[tuple[float, float]],
    sheets: Sequence[Sheet], edge: float,
) -> None:  # fmt: skip
    """Raise RecipeError for a part whose box is larger than that of every sheet."""
    for asked, part in zip(parts, kept, strict=True):
        _, boxes = boxes_of(part)
        wide, tall = (boxes[:, 2] - boxes[:, 0]), (boxes[:, 3] - boxes[:, 1])
        if any(((wide <= length) & (tall <= height)).any() for length, height in sizes):
            continue
        sheet = sheets[int(np.argmax([length * height for length, height in sizes]))]
        unit = sheet.unit
        if sheet.is_strip:
            size, room = f"{tall.min() + edge:.9g} {unit} high", f"{sheet.height:.9g} {unit}"
        else:
            k = int(np.argmin(np.maximum(wide, tall)))
            size = f"{wide[k] + edge:.9g} x {tall[k] + edge:.9g} {unit}"
            room = f"{sheet.length:.9g} x {sheet.height:.9g} {unit}"
        raise RecipeError(
            "items",
            f"{asked.item.name} is {size} with the distance that it keeps, and the sheet {room}; "
            "allow other angles or a larger one"
            + (", or state its unit, as 600x400mm" if unit == "px" else ""),
        )


def _held(sheet: Sheet, gap: float) -> tuple[Region, ...]:
    """Regions of what lies on a sheet already, with half the gap about each."""
    if sheet.held is None:
        return ()
    return tuple(spare(outline.region, gap) for outline in sheet.held.outlines)

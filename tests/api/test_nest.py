"""``packwork.nest``: files and shapes in memory, of true size, saved a file a sheet."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity

import packwork as pw
from packwork.separation.strip import WorkBound
from packwork.uses.nest_request import read_parts, read_sheets
from packwork.uses.nest_work import work_of
from packwork.uses.nesting import nest

TILE = shapely.box(0, 0, 40, 30)
PLATE = shapely.box(0, 0, 60, 60).difference(shapely.box(5, 5, 55, 55))
DISC = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30">'
    '<circle cx="15" cy="15" r="15"/></svg>'
)


def test_files_and_shapes_lie_in_units_of_the_sheet(tmp_path: Path) -> None:
    (tmp_path / "disc.svg").write_text(DISC, encoding="utf-8")
    found = pw.nest(
        "100x80mm", [(TILE, 5), f"{tmp_path / 'disc.svg'}*2"], kerf="1mm", margin=3, passes=150
    )
    assert found.certified
    assert not found.unplaced
    assert sum(map(len, found)) == 7
    regions = [outline.region for layout in found for outline in layout.outlines]
    assert sorted(round(region.area) for region in regions) == [707] * 2 + [1200] * 5
    room = shapely.box(3, 3, 97, 77).buffer(1e-9)
    assert all(room.covers(region) for region in regions)
    paths = found.save(tmp_path / "a.geojson")
    assert [path.name for path in paths] == [f"a-{k}.geojson" for k in range(1, len(found) + 1)]
    assert sum(len(pw.Layout.load(path)) for path in paths) == 7
    assert found.report["certified"]


@pytest.mark.parametrize(
    "parts", [TILE, [TILE], [(TILE, 1)], {TILE: 1}, pw.Item("t", outline=TILE)]
)
def test_one_part_may_be_given_in_many_ways(parts: object) -> None:
    found = pw.nest("50mm", parts, passes=3)
    assert len(found) == len(found.layouts[0]) == 1


def test_a_sheet_is_any_outline_and_holes_are_filled_where_asked() -> None:
    hide = shapely.Point(60, 60).buffer(60)
    small = shapely.box(0, 0, 40, 40)
    inside = pw.nest(hide, [PLATE, small], passes=200)
    assert inside.certified
    assert len(inside.layouts[0]) == 2
    left = pw.nest(shapely.box(0, 0, 61, 61), [PLATE, small], holes="fill", passes=30)
    assert left.unplaced == {"part": 1}


def test_what_is_in_the_way_is_one_line() -> None:
    with pytest.raises(pw.RecipeError, match="larger one"):
        pw.nest("30x20mm", TILE, passes=3)
    with pytest.raises(pw.RecipeError, match="kerf"):
        pw.nest("300x200mm", TILE, kerf=float("nan"), passes=3)
    with pytest.raises(pw.RecipeError, match="nothing to nest"):
        pw.nest("300x200mm", passes=3)


@pytest.mark.parametrize(
    ("sheet", "part", "asked", "said"),
    [
        ("100mm", TILE, {"passes": 0}, "passes"),
        ("100mm", TILE, {"time": float("nan")}, "time"),
        ("100mm", TILE, {"time": 1.0, "passes": 9}, "one of them"),
        ("100mm", TILE, {"effort": "most"}, "one of draft, normal, best, not 'most'"),
        ("100mm", TILE, {"time": float("inf")}, "time"),
        ("100mm", (TILE, -1), {"passes": 1}, "use 0 or more"),
        ("100x100mm*0", TILE, {"passes": 1}, "sheet"),
        ("square", TILE, {"passes": 1, "kerf": "5%"}, "kerf"),
    ],
)
def test_what_has_no_meaning_is_named(sheet: str, part: object, asked: dict, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=said):
        pw.nest(sheet, part, **asked)


def test_parts_of_one_name_without_room_are_added_up() -> None:
    found = pw.nest(
        "10x10mm*1", [(shapely.box(0, 0, 5, 5), 6), (shapely.box(0, 0, 6, 6), 4)], passes=9
    )
    assert found.unplaced == {"part": sum(one["count"] for one in found.report["unplaced"])}


def test_thin_frames_that_make_a_long_strip_are_certified() -> None:
    frame = shapely.box(0, 0, 90, 90).difference(shapely.box(0.5, 0.5, 89.5, 89.5))
    assert pw.nest("92mm", (frame, 30), rotate="none", passes=2).certified


def test_a_part_that_lies_turned_over_stays_said_to(tmp_path: Path) -> None:
    hook = shapely.Polygon([(0, 0), (40, 0), (40, 10), (10, 10), (10, 30), (0, 30)])
    room = shapely.affinity.scale(hook, -1, 1).buffer(1, join_style="mitre")
    first = pw.nest(room, hook, rotate="none", mirror=True, passes=200)
    assert first.layouts[0].manifest["nest"]["mirrored"] == [1]
    (path,) = first.save(tmp_path / "a.geojson")
    again = pw.nest(path, shapely.box(0, 0, 0.5, 0.5), passes=9)
    assert again.layouts[0].manifest["nest"]["mirrored"] == [1]


def test_of_many_parts_an_effort_is_more_places() -> None:
    parts = list(read_parts("builtin:star*9000", "mm", "none"))
    efforts = ("draft", "normal")
    assert [work_of(parts[:1], effort=one).places for one in efforts] == [18_000_000, 36_000_000]


def test_a_search_ends_when_it_is_told_to() -> None:
    found = pw.nest("100mm", (TILE, 30), time=600.0, stop=lambda: True)
    assert len(found.layouts[0]) == 30
    assert found.certified


def test_there_is_one_table_and_one_pdf_for_all_sheets(tmp_path: Path) -> None:
    found = pw.nest("60x45mm", [(TILE, 3)], kerf=1, passes=300)
    assert len(found) > 1
    for ending, start in ((".csv", b"\xef\xbb\xbfsheet,number,part,x_mm"), (".pdf", b"%PDF-")):
        (path,) = found.save(tmp_path / f"a{ending}")
        assert path.read_bytes().startswith(start)


def test_progress_tells_the_length_that_is_reported() -> None:
    work = WorkBound(passes=3)
    (sheet,) = read_sheets("40mm")
    found = nest(list(read_parts("square@10mm*3", "mm", "none")), [sheet], gap=2.0, work=work)
    assert work.best_so_far == f"length {found.length:.5g}"
    assert found.length > 12.0


def test_parts_that_leave_room_for_no_other_have_a_sheet_each() -> None:
    # A quarter of a sheet each, but longer and wider than half of it.
    found = pw.nest("400x400mm", [(shapely.box(0, 0, 202, 202), 30)], passes=1)
    assert not found.unplaced
    assert [len(layout.outlines) for layout in found] == [1] * 30


@pytest.mark.parametrize(
    ("sheet", "parts", "said"),
    [
        (100, "star", "sheet: use a size such as '600x400mm', not 100"),
        ((100, 50), "star", "sheet: use a size such as '600x400mm', not (100, 50)"),
        (np.array([100, 50]), "star", "sheet: use a size such as '600x400mm', not [100, 50]"),
        ([100, "50mm"], "star", "sheet: use a size such as '600x400mm', not [100, '50mm']"),
        ("100mm", {"star": -3}, "parts: a count is -3; use 0 or more"),
        ("100mm", {"star": 2.5}, "parts: a count is 2.5; use a whole number such as 3"),
        ("100mm", {"star": "3"}, "parts: a count is '3'; use a whole number such as 3"),
        ("100mm", [(TILE, 2.5)], "parts: a count is 2.5; use a whole number such as 3"),
    ],
)
def test_numbers_that_mean_nothing_are_refused(sheet: object, parts: object, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=re.escape(said)):
        pw.nest(sheet, parts)

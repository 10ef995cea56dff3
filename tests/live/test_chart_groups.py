"""A chart in groups: its marks stay in their group's container, by hand and poured anew."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.chart_groups import region_of_one
from packwork.live.commands.command import Library
from packwork.live.commands.container import PlaceContainer
from packwork.live.document import Document
from packwork.live.face.offers import columns_of, read_again
from packwork.live.relayout import poured_again
from packwork.live.session import Session

ROWS = [
    {"land": land, "cups": cups, "part": part}
    for land, cups, part in [
        ("Finland", 12, "Europe"), ("Iceland", 9, "Europe"), ("Norway", 8, "Europe"),
        ("Brazil", 5.8, "America"), ("Canada", 6.5, "America"),
        ("Japan", 3.4, "Asia"), ("Vietnam", 1.9, "Asia"),
    ]
]  # fmt: skip


@pytest.fixture(scope="module")
def chart() -> pw.Layout:
    return pw.chart(
        "circle", ROWS, size_by="cups", label_by="land", by="part",
        effort="draft", levels="50,100", seed=1,
    )  # fmt: skip


def lies_at_home(session: Session) -> bool:
    """Whether marks of each group lie in another part of the container than those of all others."""
    parts = [part.buffer(1e-6) for part in session.layout.container.outline.region.geoms]
    poses, names = session.document.poses, list(session.document.chart_groups)
    for name, rows in session.document.chart_groups.items():
        room = shapely.union_all(np.array_split(parts, len(names))[names.index(name)])
        if not shapely.contains_xy(room, poses.x[rows], poses.y[rows]).all():
            return False
    return True


def spread(session: Session) -> dict[str, float]:
    """Distance of the marks of each group from their middle, at most."""
    poses, found = session.document.poses, {}
    for name, rows in session.document.chart_groups.items():
        places = np.column_stack([poses.x[rows], poses.y[rows]])
        found[name] = float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())
    return found


def test_groups_are_poured_anew_each_in_its_own(chart: pw.Layout) -> None:
    session = chart.edit()
    assert list(session.document.chart_groups) == ["Europe", "America", "Asia"]
    moments = []
    for seed in (1, 2):
        session.apply(poured_again(session.document, seed, moments.append))
        session.finish()
        assert session.is_certified
        assert max(spread(session).values()) < chart.container.width / 4
    assert session.layout.poses.scale == pytest.approx(chart.poses.scale)
    assert not np.array_equal(session.layout.poses.x, chart.poses.x)
    assert {len(one.poses) for one in moments if one.poses is not None} == {7}


def test_a_mark_that_is_dragged_into_another_group_goes_back(chart: pw.Layout) -> None:
    session = chart.edit()
    there = session.document.poses
    session.do("move", item=6, x=float(there.x[4]), y=float(there.y[4]) + 40)
    session.settle()
    assert session.is_certified
    assert any("taken back, for Vietnam belongs to Asia" in one for one in session.advice)
    assert any("not at" in one and "Vietnam belongs to Asia" in one for one in session.unmet)
    assert np.array_equal(session.document.poses.x, there.x)
    session.do("move", item=6, x=float(there.x[6]) + 5, y=float(there.y[6]))
    session.settle()
    assert session.document.poses.x[6] != there.x[6]


def test_groups_keep_their_containers(chart: pw.Layout) -> None:
    session = chart.edit()
    with pytest.raises(RecipeError, match="each group of a chart has one of its own"):
        session.set_container("heart")
    with pytest.raises(RecipeError, match="container"):
        session.do("place_container", x=30)


@pytest.mark.parametrize("more", [
    {"kind": "remove", "items": (5,)},
    {"kind": "duplicate", "item": 5},
    {"kind": "duplicate", "item": 4},
])  # fmt: skip
@pytest.mark.parametrize("is_together", [True, False], ids=["together", "apart"])
def test_a_mark_goes_back_though_others_come_or_go(
    chart: pw.Layout, more: dict[str, object], *, is_together: bool
) -> None:
    session = chart.edit()
    there = session.document.poses
    move = {"kind": "move", "item": 6, "x": float(there.x[4]), "y": float(there.y[4]) + 60}
    commands = [{"kind": "together", "commands": [move, more]}] if is_together else [move, more]
    for command in commands:
        session.do(**command)
    session.settle()
    assert any("taken back, for Vietnam belongs to Asia" in one for one in session.advice)
    assert lies_at_home(session)
    home = float(there.x[6]), float(there.y[6])
    session.do("move", item=6, x=home[0] + 3, y=home[1])
    session.settle()
    assert not any("taken back" in one and "belongs" in one for one in session.advice)
    assert lies_at_home(session)


def test_a_copy_that_is_taken_to_another_group_goes_to_its_own(chart: pw.Layout) -> None:
    session = chart.edit()
    there = session.document.poses
    session.do("duplicate", item=6)
    session.do("move", item=7, x=float(there.x[4]), y=float(there.y[4]) + 60)
    session.settle()
    assert any("Vietnam belongs to Asia" in one for one in session.advice)
    assert lies_at_home(session)


def test_copies_for_which_their_group_has_no_room_go_nowhere_else(chart: pw.Layout) -> None:
    session = chart.edit()
    there = session.document.poses
    for _ in range(3):
        session.do("duplicate", item=0)
    session.do("move", item=6, x=float(there.x[4]), y=float(there.y[4]) + 60)
    session.settle()
    assert session.is_certified
    assert lies_at_home(session)
    assert any("taken back, for Finland belongs to Europe" in one for one in session.advice)
    assert np.array_equal(session.document.poses.x, there.x)


def test_marks_on_a_map_stay_in_their_regions(tmp_path: Path) -> None:
    (tmp_path / "land.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 60">'
        '<path id="Asia" d="M0 0H40V30H0ZM0 40H30V60H0Z"/><path id="Europe" d="M40 0H99V30H40Z"/>'
        '<path id="America" d="M40 30H99V60H40Z"/></svg>',
        encoding="utf-8",
    )
    layout = pw.chart(
        str(tmp_path / "land.svg"), ROWS, size_by="cups", label_by="land", by="part",
        in_regions=True, effort="draft", levels="50", seed=1,
    )  # fmt: skip
    assert layout.manifest["groups"] == ["Europe", "America", "Asia"]
    assert layout.manifest["group_parts"] == [1, 1, 2]
    kept = tmp_path / "map.packwork"
    layout.edit().save(kept)
    # The file of the map is not needed any more.
    (tmp_path / "land.svg").unlink()
    session = pw.Session.open(kept)
    there = session.document.poses
    session.do("move", item=6, x=float(there.x[4]), y=float(there.y[4]) + 30)
    session.finish()
    assert any("taken back, for Vietnam belongs to Asia" in one for one in session.advice)
    assert np.array_equal(session.document.poses.x, there.x)
    # The island of its region is its home as well.
    island = list(layout.container.outline.region.geoms)[-1].centroid
    session.do("move", item=6, x=island.x, y=island.y)
    session.finish()
    assert not any("taken back" in one for one in session.advice)
    session.apply(poured_again(session.document, 2, lambda _: None))
    session.finish()
    assert session.is_certified
    assert region_of_one(session.document).equals(session.document.container.outline.region)
    assert session.layout.poses.scale == pytest.approx(layout.poses.scale)


@pytest.mark.parametrize("parts", [[1, 1], [2, 2, 2], [3, 0, 1], ["1", 1, 2], "112"])
def test_a_manifest_that_says_wrong_numbers_of_parts_is_not_heeded(
    chart: pw.Layout, parts: object
) -> None:
    session = replace(chart, manifest={**chart.manifest, "group_parts": parts}).edit()
    there = session.document.poses
    session.do("move", item=6, x=float(there.x[4]), y=float(there.y[4]) + 40)
    session.finish()
    assert any("belongs to Asia" in one for one in session.advice)


def test_groups_keep_all_islands_of_their_containers(tmp_path: Path) -> None:
    (tmp_path / "two.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
        '<path d="M5 5H45V95H5ZM55 5H95V95H55Z"/></svg>',
        encoding="utf-8",
    )
    layout = pw.chart(
        str(tmp_path / "two.svg"), ROWS, size_by="cups", label_by="land", by="part",
        effort="draft", levels="50", seed=1,
    )  # fmt: skip
    assert layout.manifest["groups"] == ["Europe", "America", "Asia"]
    session = layout.edit()
    assert lies_at_home(session)
    for seed in (1, 2):
        session.apply(poured_again(session.document, seed, lambda _: None))
        session.settle()
        assert session.is_certified
        assert lies_at_home(session)
    # Either island of its own is a mark's home, though no mark lies there.
    islands = list(layout.container.outline.region.geoms)[-2:]
    for island in islands:
        session.do("move", item=6, x=island.centroid.x, y=island.centroid.y)
        session.settle()
        assert not any("belongs" in one for one in session.advice)
        x, y = (float(value[6]) for value in (session.document.poses.x, session.document.poses.y))
        assert island.contains(shapely.Point(x, y))


def test_the_map_of_a_session_is_charted_again_where_its_file_is_gone(tmp_path: Path) -> None:
    land, table, kept = (tmp_path / name for name in ("land.geojson", "t.csv", "c.packwork"))
    bounds = {"Nord": (8, 52, 14, 54), "Süd": (8, 48, 14, 52)}
    features = [
        {"type": "Feature", "properties": {"name": name}, "geometry": shapely.box(*box)}
        for name, box in bounds.items()
    ]
    whole = {"type": "FeatureCollection", "features": features}
    land.write_text(json.dumps(whole, default=shapely.geometry.mapping), encoding="utf-8")
    table.write_text("hof,land\nA,Nord\nB,Süd\n", encoding="utf-8")
    asked = {"by": "land", "in_regions": True, "effort": "draft", "levels": "50,100", "seed": 1}
    pw.chart(land, table, **asked).save(kept)
    filled = Document.from_layout(pw.fill(land, ["star"], count=2, effort="draft", levels="50"))
    land.unlink()
    container = pw.Session.open(kept).layout.container
    found = columns_of(str(table), container)["columns"]
    assert [one["name"] for one in found if one["regions"]] == ["land"]
    again = pw.chart(read_again(container), table, **asked)
    assert {note.says for note in again.notes} >= set(bounds)
    # What is moved has no parts where its file says.
    assert filled.container.file is not None
    assert PlaceContainer(x=5.0).applied(filled, Library()).container.file is None

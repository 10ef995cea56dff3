"""Nests under the hand: true sizes, allowed angles, lines for machines; laid anew."""

from __future__ import annotations

import json
import math
import tracemalloc
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely

import packwork as pw
from packwork.errors import ReadError, RecipeError
from packwork.geometry.arcs import ArcLine
from packwork.geometry.outline import Outline
from packwork.live import edits
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.placing import Move
from packwork.live.document import PROPERTIES, Document
from packwork.live.face.exporting import kept_bytes, layout_bytes
from packwork.live.file.parts import packed, part_of
from packwork.live.file.session_file import read_session, unpacked
from packwork.live.file.values import text_of
from packwork.live.nested_again import nested_again
from packwork.live.session import Session
from packwork.readers.items import read_items
from packwork.readers.layouts.line_room import LineRoom
from packwork.scene.line_art import LineArt
from packwork.separation.strip import WorkBound

TILE = [(0, 0), (40, 0), (40, 20), (0, 20)]
HOOK = [(0, 0), (40, 0), (40, 10), (10, 10), (10, 30), (0, 30)]


def nested(**options: Any) -> pw.Layout:
    asked = {"kerf": 2, "passes": 60, **options}
    (sheet,) = pw.nest("160x100mm", [(TILE, 3), (HOOK, 4)], **asked).layouts
    return sheet


def session_of(layout: pw.Layout) -> Session:
    return Session(Document.from_layout(layout))


def test_a_nest_keeps_its_gap_its_sizes_and_its_angles() -> None:
    assert session_of(nested(rotate="22,5")).document.options.rotate == "22,5"
    session = session_of(nested(rotate="0,180"))
    options = session.document.options
    assert (options.padding, options.sizes, options.rotate) == (2.0, "fixed", "0,180")
    edits.turn(session, 0, 130)
    assert math.degrees(session.document.poses.angle[0]) == pytest.approx(180)
    for edit in (
        lambda: edits.scale(session, 0, 2.0),
        lambda: edits.weigh(session, 0, 2.0),
        lambda: edits.cover(session, 0.9),
        lambda: edits.set(session, sizes="free"),
    ):
        with pytest.raises(RecipeError, match="true size"):
            edit()
    before = session.document.areas
    assert session.settle().certified
    assert np.array_equal(session.document.areas, before)


def test_what_is_brought_has_the_size_of_its_drawing(tmp_path: Path) -> None:
    session = session_of(nested())
    file = tmp_path / "tag.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="10mm" viewBox="0 0 2 1">'
        '<path d="M0 0h2v1h-2z"/></svg>',
        encoding="utf-8",
    )
    (number,) = edits.add(session, _items(file))
    row = session.document.index(number)
    assert session.document.areas[row] == pytest.approx(200, rel=1e-6)
    edits.replace(session, 0, _items(file)[0])
    assert session.document.areas[0] == pytest.approx(200, rel=1e-6)


def _items(file: Path) -> Any:
    return read_items([file]).items


@pytest.mark.parametrize("seed", range(3))
def test_a_part_that_is_dragged_over_others_to_free_ground_moves_none_of_them(seed: int) -> None:
    layout = pw.nest("400x100mm*1", [(TILE, 3), (HOOK, 4)], kerf=2, passes=60, seed=seed).layouts[0]
    session = session_of(layout)
    before = session.document.poses
    first = int(np.argmin(before.x))
    session.apply(Grab(items=(first,)))
    for x in np.linspace(before.x[first], 350.0, 9):
        session.apply(Move(item=first, x=float(x), y=50.0))
        session.flow(2)
    session.apply(Drop())
    assert session.settle().certified
    off = np.hypot(session.document.poses.x - before.x, session.document.poses.y - before.y)
    assert np.flatnonzero(off > 1e-9).tolist() == [first]


def test_the_margin_is_the_ground_and_is_taken_off_once() -> None:
    layout = nested(margin=8)
    session = session_of(layout)
    bounds = session.document.container.outline.bounds
    assert bounds == pytest.approx((6, 6, 154, 94))
    assert session.settle().certified
    again = Document.from_layout(session.layout)
    assert again.container.outline.bounds == pytest.approx(bounds)


def test_parts_of_other_angles_are_held_at_theirs_and_rows_follow_what_is_removed() -> None:
    layout = nested()
    said: Mapping[str, Any] = {**layout.manifest["nest"], "own_angles": [2, 5], "mirrored": [5]}
    rules = {**layout.manifest, "nest": said}
    made = pw.Layout(layout.container, layout.items, layout.poses, layout.weights, rules)
    session = session_of(made)
    held = session.document.held[:, PROPERTIES.index("angle")]
    assert np.flatnonzero(held).tolist() == [1, 4]
    angle = session.document.poses.angle[1]
    edits.turn(session, 1, 77)
    assert session.document.poses.angle[1] == angle
    edits.remove(session, 0)
    assert session.layout.manifest["nest"]["mirrored"] == [4]
    assert session.layout.manifest["nest"]["own_angles"] == [1, 4]


@pytest.mark.parametrize("said", [3, {"rotate": "up", "own_angles": "x", "margin": "y"}, {}])
def test_a_manifest_may_say_anything(said: object) -> None:
    layout = nested()
    made = pw.Layout(
        layout.container, layout.items, layout.poses, layout.weights, {"nest": said, "seed": 0}
    )
    assert len(Document.from_layout(made)) == len(layout.items)


def test_a_nest_is_laid_anew_about_what_is_held() -> None:
    session = session_of(nested())
    edits.move(session, 0, 120, 80)
    session.settle()
    edits.hold(session, 0)
    before = session.document
    shares: list[float] = []
    command = nested_again(before, 3, shares.append, work=WorkBound(passes=40))
    session.apply(command)
    after = session.document
    assert len(command.items) == len(before) - 1
    assert after.poses.x[0] == before.poses.x[0]
    assert not np.array_equal(after.poses.x, before.poses.x)
    assert np.array_equal(np.sort(after.areas), np.sort(before.areas))
    assert session.is_certified
    assert shares
    edits.hold(session, "*")
    with pytest.raises(RecipeError, match="are held"):
        nested_again(session.document, 3)


def _round_part(folder: Path) -> Path:
    drawing = ezdxf.new(units=4)
    drawing.modelspace().add_circle((0, 0), 15)
    drawing.modelspace().add_circle((4, 3), 2, dxfattribs={"layer": "engrave"})
    drawing.saveas(folder / "ring.dxf")
    return folder / "ring.dxf"


def test_arcs_go_through_a_session_into_a_dxf(tmp_path: Path) -> None:
    found = pw.nest("100x80mm", [str(_round_part(tmp_path)) + "*3"], kerf=1, passes=30)
    state = session_of(found.layouts[0]).kept()
    read, _ = read_session(kept_bytes(state), "a.packwork")
    arts = [item.art for item in read.document.items]
    assert all(isinstance(art, LineArt) and len(art.engraved) == 1 for art in arts)
    (tmp_path / "out.dxf").write_bytes(layout_bytes(Session(read.document).layout, "dxf", {}))
    circles = ezdxf.readfile(tmp_path / "out.dxf").modelspace().query("CIRCLE")
    radii = sorted(round(one.dxf.radius, 6) for one in circles)
    assert radii == [2.0] * 3 + [15.0] * 3


def test_lines_that_leave_their_part_are_refused(tmp_path: Path) -> None:
    found = pw.nest("100x80mm", [str(_round_part(tmp_path))], kerf=1, passes=10)
    data = kept_bytes(session_of(found.layouts[0]).kept())
    parts = dict(unpacked(data))
    (name,) = (one for one in parts if one.startswith("items/"))
    record = json.loads(parts[name])
    for points, bulges in (
        ([[0.0, 0.0], [900.0, 0.0]], [0.0, 0.0]),
        ([[-5.0, 0.0], [5.0, 0.0]], [400.0, 0.0]),
        ([[-5.0, 0.0], [5.0, 0.0]], [0.0]),
    ):
        record["art"]["cut"] = [
            {"points": text_of(np.array(points)), "bulges": bulges, "is_closed": False}
        ]
        changed = {**parts, name: json.dumps(record).encode()}
        spoilt = packed({name: part_of(data) for name, data in changed.items()})
        with pytest.raises(ReadError):
            read_session(spoilt, "a.packwork")


def test_arcs_are_bounded_before_a_map_stretches_them() -> None:
    drawn = np.column_stack([np.linspace(0.0, 1e11, 100), np.zeros(100)])
    line = ArcLine(drawn, np.full(100, 0.5))
    outline = Outline.from_region(shapely.box(-1, -1, 1, 1))
    tracemalloc.start()
    room = LineRoom(outline.region, outline.extent)
    assert not room.holds(line, matrix=np.array([[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]))
    # Arcs that lie in the part, too many to be looked at closely.
    many = ArcLine(np.tile([[-0.4, 0.0], [0.4, 0.0]], (30_000, 1)), np.ones(60_000), True)
    assert not room.holds(many)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 100e6


SHAPE = """<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<linearGradient id="g"/>{}</svg>"""
CURVES = '<path d="M2 2h20c9 3 9 16 0 20H2z"/>'
SCORED = """<g fill="none" stroke="#000" stroke-width=".1"><path d="M2 2h20v20H2z"/>
<path d="M4 4h9" stroke="url(#g)" stroke-dasharray="1"/></g>"""


def through_a_session(part: Path) -> tuple[LineArt, LineArt]:
    """Lines of a part, and as a session of its nest has them."""
    layout = pw.nest("1200x800mm", [str(part)], passes=2).layouts[0]
    return of_session(layout)


def of_session(layout: pw.Layout) -> tuple[LineArt, LineArt]:
    read, _ = read_session(kept_bytes(session_of(layout).kept()), "a.packwork")
    art, kept = layout.items[-1].art, read.document.items[-1].art
    assert isinstance(art, LineArt)
    assert isinstance(kept, LineArt)
    return art, kept


def test_a_straight_line_over_a_notch_leaves_its_part() -> None:
    horseshoe = shapely.box(0, 0, 9, 9) - shapely.box(3, 0, 6, 6)
    room = LineRoom(horseshoe, 9.0)
    ends = np.array([[1.0, 1.0], [8.0, 1.0]])
    inside = ArcLine(ends + np.array([0.0, 6.5]), np.zeros(2))
    assert room.holds(inside)
    assert not room.holds(inside, ArcLine(ends, np.zeros(2)))
    assert room.holds_path("M1 8H8M1 1V8")
    assert not room.holds_path("M1 8H8M1 1H8")
    # The line that closes a path is cut, too.
    assert room.holds_path("M1 1V8H8V1")
    assert not room.holds_path("M1 1V8H8V1Z")
    assert not room.holds(ArcLine(np.array([[1.0, 1.0], [1.0, 8.0], [8.0, 8.0], [8.0, 1.0]]),
                                  np.zeros(4), is_closed=True))  # fmt: skip


def test_curves_stay_what_they_are_in_a_session(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(SHAPE.format(CURVES), encoding="utf-8")
    art, kept = through_a_session(tmp_path / "a.svg")
    assert "C" in art.path
    assert kept.path == art.path


def test_a_mark_with_a_gradient_goes_into_a_session_without_it(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(SHAPE.format(SCORED), encoding="utf-8")
    _, kept = through_a_session(tmp_path / "a.svg")
    assert [one.colour for one in kept.engraved] == [""]


def test_marks_of_a_small_part_keep_to_it_beside_a_large_one(tmp_path: Path) -> None:
    drawing = ezdxf.new(units=4)
    space = drawing.modelspace()
    for x, side in ((0, 1000), (1100, 20)):
        space.add_lwpolyline([(x, 0), (x + side, 0), (x + side, side / 2), (x, side / 2)],
                             close=True)  # fmt: skip
        end = x + side + (0.03 if x else -10)
        space.add_line((x + 5, 5), (end, 5), dxfattribs={"layer": "engrave"})
    drawing.saveas(tmp_path / "a.dxf")
    _, kept = through_a_session(tmp_path / "a.dxf")
    (line,) = kept.engraved
    assert np.ptp(line.points[:, 0]) == pytest.approx(15 * 96 / 25.4, abs=0.01)


def test_marks_that_left_their_part_are_left_out_of_a_session_and_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    layout = pw.nest("100x80mm", [str(_round_part(tmp_path))], passes=2).layouts[0]
    (item,) = layout.items
    assert isinstance(item.art, LineArt)
    (mark,) = item.art.engraved
    away = (mark, replace(mark, points=mark.points + 80.0))
    for art, left, told in (
        (replace(item.art, engraved=away), 1, "without 1 engraved line"),
        (replace(item.art, path="M0 0C900 0 900 9 9 9Z"), 1, ""),
    ):
        moved = replace(layout, items=(replace(item, art=art),))
        _, kept = of_session(moved)
        assert (len(kept.engraved), kept.path) == (left, "")
        assert told in caplog.text
    moved = replace(layout, items=(replace(item, art=replace(item.art, cut=away)),))
    read, _ = read_session(kept_bytes(session_of(moved).kept()), "a.packwork")
    assert not isinstance(read.document.items[0].art, LineArt)
    assert "keeps the outline" in caplog.text


def test_no_two_parts_of_a_moved_nest_are_nearer_than_the_tool() -> None:
    session = session_of(nested())
    edits.move(session, 2, 80, 50)
    session.flow(epochs=60)
    assert session.settle().certified
    regions = [outline.region for outline in session.layout.outlines]
    near = [shapely.distance(a, b) for k, a in enumerate(regions) for b in regions[:k]]
    assert min(near) > 2 - 1e-9


def test_a_part_that_is_turned_over_is_named_as_such() -> None:
    session = session_of(nested(rotate="0,180"))
    hook = session.document.items[6]
    edits.flip(session, [6])
    assert session.layout.manifest["nest"]["mirrored"] == [7]
    assert session.document.items[6].outline.area == pytest.approx(hook.outline.area)
    assert session.settle().certified
    edits.flip(session, [6])
    assert session.layout.manifest["nest"]["mirrored"] == []


def test_parts_that_were_in_the_way_stay_near_where_they_can() -> None:
    corner = [(0, 0), (60, 0), (60, 15), (15, 15), (15, 45), (0, 45)]
    disc = [(15 * math.cos(k / 9), 15 * math.sin(k / 9)) for k in range(56)]
    (sheet,) = pw.nest("300x200mm", [(corner, 9), (disc, 6)], kerf=2, passes=80).layouts
    farthest = []
    for dragged, onto in ((2, 7), (9, 10), (10, 2)):
        session = session_of(sheet)
        before = session.document.poses
        session.apply(Grab(items=(dragged,)))
        x, y = (float(each[[dragged, onto]].mean()) for each in (before.x, before.y))
        session.apply(Move(item=dragged, x=x, y=y))
        session.flow(epochs=6)
        session.apply(Drop())
        assert session.settle().certified
        after = session.document.poses
        moved = np.hypot(after.x - before.x, after.y - before.y)
        farthest.append(np.delete(moved, dragged).max())
    # Where room was looked for anywhere at once, it was 150 mm.
    assert 0.0 < np.median(farthest) < 120.0

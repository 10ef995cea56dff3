"""Sessions: what moves, what does not, what is certified, what is gone back to."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
import shapely
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.commands.gestures import Cancel, Drop, Grab
from packwork.live.commands.placing import Move, Turn
from packwork.live.log import Log, read_entries
from packwork.live.session import Session
from packwork.metrics.violations import violations
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photos
from packwork.scene.item import PhotoArt
from packwork.scene.mapped import mirrored

Same = Callable[[pw.Poses, pw.Poses], bool]


def drag(session: Session, item: int, x: float, y: float, events: int = 6) -> None:
    poses = session.document.poses
    k = session.document.index(item)
    assert k is not None
    begin = np.array([poses.x[k], poses.y[k]])
    session.apply(Grab(items=(item,)))
    for share in np.linspace(0, 1, events + 1)[1:]:
        at = begin + share * (np.array([x, y]) - begin)
        session.apply(Move(item=item, x=float(at[0]), y=float(at[1])))
        session.flow(epochs=6)
    session.apply(Drop())


def test_what_is_dropped_stays_and_the_others_make_room(session: pw.Session) -> None:
    drag(session, 0, 300.0, 300.0)
    assert not session.is_certified or session.is_at_rest
    found = session.settle()
    assert found.certified
    assert found.in_the_way == ()
    assert (session.document.poses.x[0], session.document.poses.y[0]) == (300.0, 300.0)
    assert found.moved > 1


def test_a_drag_that_is_cancelled_leaves_what_was_before_it_and_no_more(
    session: pw.Session, same: Same
) -> None:
    first = session.document
    drag(session, 0, 300.0, 300.0)
    before, marks = session.document, session.marks.copy()
    session.apply(Grab(items=(3,)))
    session.apply(Move(item=3, x=250.0, y=380.0))
    session.flow(epochs=12)
    assert not same(session.document.poses, before.poses)
    session.apply(Cancel())
    assert same(session.document.poses, before.poses)
    assert session.marks == marks
    assert session.settle().certified
    assert session.undo()
    assert same(session.document.poses, first.poses)
    assert not session.undo()


def test_what_is_certified_is_clean_by_measures_that_know_nothing_of_sessions(
    session: pw.Session,
) -> None:
    drag(session, 3, 250.0, 380.0)
    session.settle()
    layout = session.layout
    assert layout.certified
    assert violations(layout.outlines, layout.container.outline, 0.0) == ()
    assert pw.measure(layout)["exact"]["overlap_area"] == 0


def test_a_layout_in_conflict_is_not_certified_and_says_why(session: pw.Session) -> None:
    poses = session.document.poses
    session.move(0, float(poses.x[1]), float(poses.y[1]))
    assert not session.is_certified
    assert not session.layout.certified
    assert any("overlaps" in line for line in session.in_the_way)
    session.move(0, -500.0, 0.0)
    assert session.in_the_way == ("star sticks out of the container by " + _area(session),)


def _area(session: pw.Session) -> str:
    outline = session.layout.outlines[0]
    return f"{outline.area:.3g} px²"


def test_the_far_side_does_not_move() -> None:
    layout = pw.fill("square", "hexagon", count=60, epochs=60, levels="50,100")
    session, before = layout.edit(), layout.poses
    corner = int(np.argmin(before.x + before.y))
    session.move(corner, float(before.x[corner]) + 3, float(before.y[corner]))
    session.settle()
    after = session.document.poses
    far = np.hypot(before.x - before.x[corner], before.y - before.y[corner]) > 350
    assert far.sum() > 20
    for name in ("x", "y", "angle", "scale"):
        assert getattr(after, name)[far].tobytes() == getattr(before, name)[far].tobytes()


@pytest.mark.parametrize("ends", [("place",), ("angle",), ("size",), ("place", "angle", "size")])
def test_what_is_held_does_not_change_by_a_bit(session: pw.Session, ends: tuple[str, ...]) -> None:
    columns = {"place": ("x", "y"), "angle": ("angle",), "size": ("scale",)}
    before = session.document.poses
    session.hold("*", *ends)  # type: ignore[arg-type]
    session.release(0, "place")
    drag(session, 0, 300.0, 300.0)
    session.settle()
    session.polish(8)
    after = session.document.poses
    for name in (column for end in ends for column in columns[end]):
        assert getattr(after, name)[1:].tobytes() == getattr(before, name)[1:].tobytes()


def test_two_that_are_held_on_each_other_are_named_and_the_rest_is_clean(
    session: pw.Session,
) -> None:
    poses = session.document.poses
    session.move(0, float(poses.x[1]), float(poses.y[1]))
    session.hold(0)
    session.hold(1)
    found = session.settle()
    assert not found.certified
    assert (0, 1) in {(one.item, one.other) for one in session.violations}
    assert {one.item for one in session.violations} == {0}


def test_undo_and_redo_restore_every_bit(session: pw.Session, same: Same) -> None:
    seen = [session.document.poses]
    for item, x in ((0, 300.0), (5, 200.0), (7, 400.0)):
        drag(session, item, x, 300.0)
        session.settle()
        seen.append(session.document.poses)
    for poses in reversed(seen[:-1]):
        session.undo()
        assert same(session.document.poses, poses)
        assert session.is_at_rest
    session.undo()
    assert same(session.document.poses, seen[0])
    for poses in seen[1:]:
        session.redo()
        assert same(session.document.poses, poses)


def test_a_title_stays_whatever_is_undone(session: pw.Session) -> None:
    session.apply(Turn(item=3, angle=40.0))
    session.do("entitle", title="Für Ada")
    assert session.undo()
    assert session.document.title == "Für Ada"
    session.do("entitle", title="For Ada")
    assert session.redo()
    assert session.document.title == "For Ada"


def test_a_drag_is_one_entry_however_many_events_it_has(session: pw.Session) -> None:
    drag(session, 0, 300.0, 300.0, events=50)
    assert len(session.history) == 1
    session.apply(Grab(items=(0,)))
    session.apply(Drop())
    assert len(session.history) == 1


def test_a_replay_gives_the_same_bytes(dozen: pw.Layout, same: Same) -> None:
    stream = io.StringIO()
    session = Session(dozen.edit().document, log=Log(stream))
    start = session.document
    for item, x in ((0, 300.0), (5, 200.0)):
        drag(session, item, x, 280.0)
        session.settle()
        session.polish(6)
    session.undo()
    drag(session, 2, 310.0, 300.0)
    session.settle()
    entries = list(read_entries(iter(stream.getvalue().splitlines()), "log"))
    again = Session.replay(start, entries)
    assert same(again.document.poses, session.document.poses)
    while session.history.can_undo:
        session.undo()
        again.undo()
        assert same(again.document.poses, session.document.poses)


def test_polish_wins_back_what_far_drags_cost(dozen: pw.Layout) -> None:
    won = []
    for seed in range(3):
        session, rng = dozen.edit(), np.random.default_rng(seed)
        for _ in range(4):
            first, second = rng.choice(len(dozen.items), 2, replace=False).tolist()
            poses = session.document.poses
            drag(session, first, float(poses.x[second]), float(poses.y[second]))
            session.settle()
        before = session.document.areas.sum()
        while session.is_rough:
            session.polish(60)
        won.append(session.document.areas.sum() - before)
        assert session.is_certified
    assert sum(won) > 0.01 * dozen.container.outline.area * len(won)


def test_polish_leaves_what_was_put_last_and_the_angle_of_what_was_put_before(
    session: pw.Session,
) -> None:
    session.turn(3, 77.0)
    session.move(3, 300.0, 280.0)
    session.settle()
    before = session.document.poses
    session.polish(30)
    after = session.document.poses
    assert (before.x[3], before.angle[3]) == (after.x[3], after.angle[3])
    session.move(7, 200.0, 300.0)
    session.settle()
    before = session.document.poses
    session.polish(60)
    after = session.document.poses
    assert after.angle[3] == before.angle[3]
    assert after.x[7] == before.x[7]
    assert session.is_certified


def far(session: pw.Session, number: int, place: tuple[float, float]) -> float:
    """How far an item lies from a place, in sides of the canvas."""
    row, poses = session.document.index(number), session.document.poses
    at = (float(poses.x[row]), float(poses.y[row]))
    return math.dist(at, place) / session.document.container.side


def test_copies_and_what_they_are_of_stay_where_they_were_put_while_gaps_are_closed() -> None:
    few = pw.fill("circle", ["star", "heart", "hexagon"], count=7, epochs=120, levels="50,100")
    moved: dict[str, list[float]] = {"left": [], "beside": [], "pasted": []}
    for seed in range(3):
        rng = np.random.default_rng(seed)
        for what, distances in moved.items():
            session = few.edit()
            first, second = rng.choice(len(few.items), 2, replace=False).tolist()
            poses, new = session.document.poses, session.document.next_id
            at, there = [(float(poses.x[k]), float(poses.y[k])) for k in (first, second)]
            if what == "left":
                session.apply(Grab(items=(first,)))
                session.do("duplicate", item=first, beside=0.0)
                session.move(first, *there)
                session.apply(Drop())
            elif what == "beside":
                session.duplicate(first)
                new = first
            else:
                at = there
                session.paste(session.copy(first), *there)
            session.flow(epochs=40)
            assert session.settle().certified
            distances.append(far(session, new, at))
            while session.is_rough:
                session.polish(48)
            assert far(session, new, at) == distances[-1]
    # Some are too large for the places that they were given.
    assert all(sorted(distances)[1] < 0.01 for distances in moved.values()), moved
    assert max(moved["left"] + moved["beside"]) < 0.1


@pytest.mark.parametrize("item", [0, 4, 9])
def test_what_the_hand_has_turned_stays_turned(session: pw.Session, item: int) -> None:
    began = session.document.poses.angle[item]
    session.apply(Grab(items=(item,)))
    for quarter in np.linspace(0, np.pi / 2, 9)[1:]:
        session.apply(Turn(item=item, angle=float(np.degrees(began + quarter))))
        session.flow(epochs=3)
    turned = session.document.poses.angle[item]
    session.apply(Drop())
    session.flow(epochs=100)
    assert session.document.poses.angle[item] == turned
    assert session.settle().certified
    session.polish(30)
    assert session.document.poses.angle[item] == turned


def test_a_log_that_was_cut_off_loses_its_last_line_only() -> None:
    lines = ['{"flow": [100, 3]}', '{"settle": null}', '{"do": {"kind": "mo']
    assert list(read_entries(iter(lines), "log")) == [("flow", (100, 3)), ("settle", None)]


@pytest.mark.parametrize(
    "line",
    [
        '{"flow": [100, -3]}', '{"flow": [1e9, 3]}', '{"flow": true}', '{"do": {"kind": "x"}}',
        '{"do": {"kind": "move", "item": 0, "x": NaN, "y": 1}}', "[" * 5_000, '{"polish": 0}',
        '{"settle": null, "undo": null}', "null",
    ],
)  # fmt: skip
def test_a_line_that_is_no_entry_is_refused_by_its_number(line: str) -> None:
    with pytest.raises(pw.ReadError, match="line 1 is no entry of a log"):
        list(read_entries(iter([line, '{"undo": null}']), "log"))


def test_one_item_more_moves_no_one_across_the_picture(session: pw.Session) -> None:
    before = session.document.poses
    (new,) = session.add("circle")
    found = session.settle()
    after = session.document
    assert found.certified
    assert new == 12
    assert len(after) == 13
    way = np.hypot(after.poses.x[:12] - before.x, after.poses.y[:12] - before.y)
    assert way.max() < 100


def test_neighbours_grow_into_the_room_of_one_that_is_gone(session: pw.Session) -> None:
    areas = session.document.areas
    session.remove(0)
    session.settle()
    left = session.document
    assert 0 not in left.ids
    assert left.areas.sum() > areas[1:].sum()
    with pytest.raises(RecipeError, match="there is no item 0"):
        session.move(0, 1, 1)


def test_another_container_is_filled_again(session: pw.Session) -> None:
    before = session.document.container.outline
    session.place_container(factor=0.8, degrees=30)
    assert not session.is_certified
    now = session.document.container.outline
    assert now.area == pytest.approx(0.64 * before.area)
    assert now.region.centroid.distance(before.region.centroid) < 0.05 * before.extent
    assert session.settle().certified


def test_a_wider_gap_is_kept(session: pw.Session) -> None:
    session.set(padding=4)
    found = session.settle()
    assert found.certified, found.in_the_way
    assert session.layout.metrics["exact"]["min_gap"] >= 4


def test_sizes_in_proportion_stay_so() -> None:
    layout = pw.fill(
        "circle", ["star", "hexagon"], count=8, sizes="shared", epochs=80, levels="50,100"
    )
    session = layout.edit()
    session.move(0, 300, 300)
    assert session.settle().certified
    assert np.ptp(session.document.poses.scale / layout.poses.scale) < 1e-9


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: s.move("owl", 1, 1), r"item: there is no item 'owl'; there are star, heart"),
        (lambda s: s.move("star", 1, 1), r"4 items are called star; say star#1 to star#4"),
        (lambda s: s.move("star#9", 1, 1), r"there is no item 'star#9'"),
        (lambda s: s.move(0, "far", 1), r"x: "),
        (lambda s: s.move(0, 1e12, 1), r"nowhere near the canvas"),
        (lambda s: s.scale(0, 0), r"factor: "),
        (lambda s: s.weigh(0, -1), r"weight: "),
        (lambda s: s.hold(0, "colour"), r"properties"),
        (lambda s: s.recolor(0, "mud"), r"'mud' is no colour"),
        (lambda s: s.exchange(0, 0), r"two different items"),
        (lambda s: s.remove("*"), r"nothing would be left"),
        (lambda s: s.reshape([[(0, 0), (1, 1)]]), r"three vertices"),
        (lambda s: s.set(colour=3), r"is no option of a session"),
        (lambda s: s.set(padding=-3), r"padding"),
        (lambda s: s.set(rotate="sideways"), r"rotate"),
        (lambda s: s.weigh(0, 1e300), r"nearer to it"),
        (lambda s: s.move(0, float("nan"), 0), r"x: "),
        (lambda s: s.turn(0, "up"), r"angle: "),
        (lambda s: s.reshape("abc"), r"rings"),
        (lambda s: s.recolor(0, None), r"colour"),
        (lambda s: s.set(padding=5, rotate="zzz"), r"rotate"),
        (lambda s: s.flow(), r"give epochs or milliseconds"),
        (lambda s: s.rename(0, ""), r"name"),
        (lambda s: s.turn(77, 5), r"there is no item 77"),
        (lambda s: s.hold(np.array(77)), r"there is no item 77"),
        (lambda s: s.hold(b"ab"), r"list of these, not a bytes"),
        (lambda s: s.hold({"star": 1}), r"list of these, not a dict"),
        (lambda s: s.hold(np.array([True, False])), r"list of these, not a bool"),
    ],
)
def test_what_has_no_meaning_is_one_line_and_changes_nothing(
    session: pw.Session, call: Callable[[pw.Session], object], message: str
) -> None:
    before = session.document
    with pytest.raises(RecipeError, match=message) as caught:
        call(session)
    assert "\n" not in str(caught.value)
    assert session.document is before
    assert not session.history.can_undo


def test_nothing_is_settled_under_the_hand(session: pw.Session) -> None:
    session.apply(Grab(items=(0,)))
    for call in (session.settle, session.undo, session.redo):
        with pytest.raises(RecipeError, match="drop it first"):
            call()
    with pytest.raises(RecipeError, match="drop it first"):
        session.apply(Grab(items=(1,)))
    assert session.polish(5) == 0


def test_what_was_in_conflict_can_be_settled_later(session: pw.Session) -> None:
    poses = session.document.poses
    session.hold(0)
    session.hold(1)
    session.move(0, float(poses.x[1]), float(poses.y[1]))
    assert not session.settle().certified
    session.release("*")
    assert session.settle().certified


def test_undo_and_redo_leave_nothing_that_cannot_be_settled(session: pw.Session) -> None:
    session.move(0, "50%", "50%")
    session.move(1, "40%", "50%")
    session.undo()
    assert session.settle().certified
    session.move(2, "45%", "50%")
    session.undo()
    session.redo()
    assert session.settle().certified


@pytest.mark.parametrize("place", [(-1000.0, 300.0), (700.0, -90.0)])
def test_what_is_dropped_outside_comes_to_the_nearest_place(
    session: pw.Session, place: tuple[float, float]
) -> None:
    before = session.document.poses.scale[0]
    session.move(0, *place)
    assert session.settle().certified
    assert session.document.poses.scale[0] < 2 * before


def test_neighbours_keep_to_their_turns_whatever_the_hand_does() -> None:
    layout = pw.fill("circle", "star", count=8, rotate="10", epochs=60, levels="50")
    session = layout.edit()
    session.turn(0, 90)
    session.settle()
    turns = np.degrees(np.abs(session.document.poses.angle[1:]))
    assert turns.max() <= 10.001


def test_options_that_all_keep_already_move_nothing(session: pw.Session, same: Same) -> None:
    before = session.document.poses
    session.set(sizes="fixed", size_ratio=3, rotate="free")
    assert session.settle().certified
    assert same(session.document.poses, before)


def test_what_lies_where_it_was_put_stays_there_while_more_comes(session: pw.Session) -> None:
    session.move(0, 300, 300)
    session.add("circle")
    session.flow(epochs=10)
    assert session.document.poses.x[0] == 300


def test_what_is_in_the_hand_is_not_pushed(session: pw.Session) -> None:
    poses = session.document.poses
    session.apply(Grab(items=(1,)))
    session.apply(Move(item=0, x=float(poses.x[1]) + 2, y=float(poses.y[1])))
    session.flow(epochs=10)
    assert session.document.poses.x[1] == poses.x[1]


def test_a_film_ends_with_the_layout_whatever_came_and_went(
    dozen: pw.Layout, tmp_path: Path
) -> None:
    session = dozen.edit(record=True)
    session.move(0, 300, 300)
    session.remove(1)
    session.settle()
    session.undo()
    layout = session.layout
    assert layout.track is not None
    assert layout.track.at(1.0).x.tolist() == layout.poses.x.tolist()
    layout.save_film(tmp_path / "film.svg", seconds=0.5)


def test_options_of_a_session_are_those_of_its_layout(session: pw.Session) -> None:
    session.set(rotate="none", size_ratio=1.5)
    again = session.layout.edit().document.options
    assert (again.rotate, again.size_ratio) == ("none", 1.5)


@pytest.mark.parametrize("said", [{"size_ratio": "abc"}, {"rotate": "zzz"}, {"sizes": [1]}])
def test_a_manifest_without_meaning_is_passed_over(
    dozen: pw.Layout, said: dict[str, object]
) -> None:
    manifest = {**dozen.manifest, "recipe": said}
    assert replace(dozen, manifest=manifest).edit().document.options.size_ratio == 2.0


def test_names_colours_and_weights_move_nothing(session: pw.Session, same: Same) -> None:
    before = session.document.poses
    session.rename(0, "sun")
    session.recolor("heart", "teal")
    assert same(session.document.poses, before)
    assert session.layout.items[0].name == "sun"
    assert session.is_certified


def test_an_exception_in_the_block_is_not_hidden(dozen: pw.Layout) -> None:
    with pytest.raises(RecipeError, match="owl"), dozen.edit() as session:
        session.move("owl", 1, 1)


def test_several_items_are_one_list_and_one_step(session: pw.Session) -> None:
    session.recolor([0, "star#2", (3, 4)], "red")
    session.hold([0, 1])
    assert len(session.history) == 2
    assert np.flatnonzero(session.document.held[:, 0]).tolist() == [0, 1]


def test_a_smaller_ratio_of_sizes_brings_them_together(session: pw.Session) -> None:
    session.set(size_ratio=1)
    areas = session.layout.areas
    assert areas.max() / areas.min() == pytest.approx(1)
    session.finish()
    assert session.is_certified


def test_evenness_stirs_what_it_is_asked_of(session: pw.Session) -> None:
    session.set(evenness=3)
    assert session.flow(epochs=4) == 4


def test_a_polish_longer_than_a_log_takes_is_cut(
    tmp_path: Path, session: pw.Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.live.session.MOST_TRIALS", 20)
    monkeypatch.setattr("packwork.live.log.MOST_TRIALS", 20)
    session.save(tmp_path / "a.packwork", journal=True)
    session.move(0, "50%", "50%")
    session.settle()
    session.polish(21, lambda: False)
    session.close()
    assert '{"polish": 20}' in (tmp_path / "a.packwork.log").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda s: s.rename(0, "a\x07b"), "control characters"),
        (lambda s: s.set(padding=500), "padding"),
        (lambda s: s.reshape(None), "list of rings"),
        (lambda s: s.reshape([(0, 0), (500, 0), (500, 500)]), "three vertices"),
        (lambda s: s.reshape([]), "one ring at least"),
        (lambda s: s.replace(0, "builtin:icons"), "takes one item, not"),
        (lambda s: s.add("star", x=100), "both x and y"),
        (lambda s: s.add("star", y=100), "both x and y"),
        (lambda s: s.flow(-1), "whole number from 0"),
        (lambda s: s.flow("8"), "whole number from 0"),
        (lambda s: s.flow(milliseconds=float("nan")), "0 or more"),
        (lambda s: s.count(10**9), "from 1 to"),
        (lambda s: s.find(99), "numbers go from 0 to"),
        (lambda s: s.weigh(0, 1e9), "nearer"),
    ],
)
def test_what_has_no_meaning_is_told_with_what_would_do(
    session: pw.Session, call: Callable[[pw.Session], object], said: str
) -> None:
    before = session.document
    with pytest.raises(RecipeError, match=said) as caught:
        call(session)
    assert "\n" not in str(caught.value)
    assert session.document is before


def test_a_session_is_saved_under_its_own_ending(tmp_path: Path, session: pw.Session) -> None:
    with pytest.raises(pw.WriteError, match=r"end it in \.packwork"):
        session.save(tmp_path / "a.svg")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("direction", ["horizontal", "vertical"])
def test_what_is_flipped_is_seen_mirrored_where_it_is(
    session: pw.Session, direction: Literal["horizontal", "vertical"]
) -> None:
    before = session.document.layout
    session.flip(0, direction)
    session.settle()
    after = session.document
    sign = np.array([-1.0, 1.0] if direction == "horizontal" else [1.0, -1.0])
    was, now = (
        layout.items[0].outline.mapped(layout.poses.matrix(0)) for layout in (before, after)
    )
    scale = after.poses.scale[0] / before.poses.scale[0]
    mirrored = shapely.transform(
        was.region, lambda points: (points - was.centroid) * sign * scale + now.centroid
    )
    assert mirrored.symmetric_difference(now.region).area < 1e-6 * now.area
    assert session.is_certified
    session.undo()
    assert session.document.items[0] is before.items[0]


def test_a_flipped_photograph_is_printed_as_it_is_shown(tmp_path: Path) -> None:
    Image.new("RGB", (40, 20), "teal").save(tmp_path / "teal.png")
    (photo,) = read_photos(PhotoOptions(sources=(str(tmp_path / "teal.png"),))).items
    was, now = photo.art, mirrored(photo).art
    assert isinstance(was, PhotoArt)
    assert isinstance(now, PhotoArt)
    for before, after in (
        (was.preview, now.preview), (was.original.printed(1.0), now.original.printed(1.0))
    ):  # fmt: skip
        assert after.matrix.tolist() == [(-before.matrix[0]).tolist(), before.matrix[1].tolist()]


def test_a_line_that_crosses_itself_is_filled_and_a_hole_may_reach_outside(
    session: pw.Session,
) -> None:
    container = session.document.container
    middle, radius = np.array([container.width, container.height]) / 2, container.side / 2
    angles = np.linspace(0, 2.2 * np.pi, 80)
    ring = middle + 0.8 * radius * np.column_stack([np.cos(-angles), np.sin(-angles)])
    session.draw_container(ring.tolist())
    outline = session.document.container.outline
    assert len(outline.rings) == 1
    assert outline.area == pytest.approx(np.pi * (0.8 * radius) ** 2, rel=0.01)
    half = [(middle[0], -radius), (9 * radius, -radius), (9 * radius, 9 * radius)]
    session.draw_container([*half, (middle[0], 9 * radius)], is_hole=True)
    assert session.document.container.outline.area == pytest.approx(outline.area / 2, rel=0.01)
    assert session.finish().certified
    with pytest.raises(RecipeError, match="nothing of it would be left"):
        session.draw_container(ring.tolist(), is_hole=True)
    with pytest.raises(RecipeError, match="nowhere near"):
        session.draw_container([(0, 0), (1, 0), (1e9, 1)])


def test_what_is_moved_and_then_removed_leaves_no_mark(session: pw.Session) -> None:
    move = {"kind": "move", "item": 3, "x": 300.0, "y": 300.0}
    session.do("together", commands=[move, {"kind": "remove", "items": [3]}])
    assert 3 not in session.marks.placed_by_user

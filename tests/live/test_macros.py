"""Gestures of several commands: counts, shares, words, forces; one entry each, certified."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.commands.command import made, named_container
from packwork.live.commands.container import SetContainer
from packwork.live.commands.items import Duplicate
from packwork.live.commands.placing import Move
from packwork.live.commands.together import COMMANDS, Together
from packwork.live.document import counted_weight
from packwork.live.face.offers import container_of, labels_of, told_of_map
from packwork.live.macros import brought, labelled, labels_in
from packwork.live.relayout import poured_again
from packwork.pipeline.region_labels import PartLabel
from packwork.scene.container import Container, on_canvas
from packwork.units import canvas_size

QUICK = {"effort": "draft", "levels": "50", "epochs": 60}


@pytest.fixture(scope="module")
def icons() -> pw.Layout:
    return pw.fill("circle", ["star", "heart", "hexagon"], count=9, padding="0", **QUICK)


@pytest.fixture(scope="module")
def cloud() -> pw.Layout:
    weights = {"bear": 4, "fox": 3, "owl": 2, "snail": 1, "ant": 1}
    return pw.words("heart", weights, sizes="shared", **QUICK)


def covered(session: pw.Session) -> float:
    document = session.document
    areas = document.areas
    return float(areas.sum() / document.container.outline.area)


@pytest.mark.parametrize("count", [4, 12])
def test_another_number_of_items_is_one_entry(icons: pw.Layout, count: int) -> None:
    session = icons.edit()
    session.count(count)
    assert session.settle().certified
    names = [item.name for item in session.document.items]
    assert len(names) == count
    shares = [names.count(name) for name in set(names)]
    assert max(shares) - min(shares) <= 1
    session.undo()
    assert session.document.poses.x.tobytes() == icons.poses.x.tobytes()


def test_what_is_held_is_not_what_goes(icons: pw.Layout) -> None:
    session = icons.edit()
    session.hold("star")
    held = session.find("star")
    session.count(3)
    assert set(session.document.ids.tolist()) == set(held)
    with pytest.raises(RecipeError, match="items are held"):
        session.count(2)
    with pytest.raises(RecipeError, match="must be a whole number"):
        session.count(0)


@pytest.mark.parametrize("share", ["40%", 0.3])
def test_so_much_is_covered_and_no_more(icons: pw.Layout, share: str | float) -> None:
    session = icons.edit()
    session.cover(share)
    assert session.settle().certified
    asked = 0.4 if share == "40%" else 0.3
    assert covered(session) == pytest.approx(asked, rel=1e-6)


def test_a_share_that_is_none_is_refused(icons: pw.Layout) -> None:
    session = icons.edit()
    for share in (0, 1, 40, "x", "-3%"):
        with pytest.raises(RecipeError, match="cover: must be a share such as 70%"):
            session.cover(share)
    session.hold("*", "size")
    with pytest.raises(RecipeError, match="items whose size is held"):
        session.cover(0.2)


def test_several_items_are_added_as_one(icons: pw.Layout) -> None:
    session = icons.edit()
    new = session.add(["square", "circle"])
    assert [session.document.items[-2].name, session.document.items[-1].name] == [
        "square", "circle",
    ]  # fmt: skip
    assert new == (9, 10)
    places = session.document.poses
    assert np.hypot(places.x[-1] - places.x[-2], places.y[-1] - places.y[-2]) > 1
    session.undo()
    assert len(session.document) == 9


def test_all_commands_of_a_gesture_have_a_meaning_or_none_is_done(icons: pw.Layout) -> None:
    session = icons.edit()
    gesture = Together(commands=(Move(item=0, x=300, y=300), Duplicate(item=99)))
    before = session.document
    with pytest.raises(RecipeError, match="no item 99"):
        session.apply(gesture)
    assert session.document is before
    assert COMMANDS.validate_json(gesture.model_dump_json()) == gesture
    with pytest.raises(ValueError, match="together"):
        COMMANDS.validate_python({"kind": "together", "commands": [{"kind": "together"}]})


def test_a_gesture_of_several_touches_what_each_of_them_does(icons: pw.Layout) -> None:
    session = icons.edit()
    session.apply(Together(commands=(Move(item=0, x=300, y=300), Duplicate(item=3))))
    assert {0, 9} <= session.marks.touched
    assert session.marks.placed_by_user == {0, 3}
    assert session.settle().certified


def test_other_words_with_other_weights(cloud: pw.Layout) -> None:
    session = cloud.edit()
    numbers = {item.name: k for item, k in zip(cloud.items, session.document.ids, strict=True)}
    session.words({"bear": 1, "fox": 3, "owl": 2, "whale": 2})
    found = session.finish()
    assert found.certified, found.in_the_way
    document = session.document
    names = [item.name for item in document.items]
    assert sorted(names) == ["bear", "fox", "owl", "whale"]
    assert [document.ids[names.index(name)] for name in ("bear", "fox", "owl")] == [
        numbers[name] for name in ("bear", "fox", "owl")
    ]
    # Sizes are heights of letters: of one weight one size.
    scale = dict(zip(names, document.poses.scale, strict=True))
    assert scale["whale"] == pytest.approx(scale["owl"], rel=1e-6)
    assert scale["fox"] == pytest.approx(3 * scale["bear"], rel=1e-6)
    session.undo()
    assert sorted(item.name for item in session.document.items) == sorted(numbers)


def test_words_tell_how_often_they_were_counted_last(cloud: pw.Layout) -> None:
    session = cloud.edit()
    colours = {item.name: item.art for item in session.document.items}
    session.words({"bear": 4, "fox": 3, "owl": 5, "ant": 1.5, "wren": 2})
    found = {item.name: counted_weight(item) for item in session.document.items}
    assert found == {"bear": 4, "fox": 3, "owl": 5, "ant": 1.5, "wren": 2}
    assert all(colours.get(item.name, item.art) is item.art for item in session.document.items)
    session.rename("fox", "vixen")
    assert (
        counted_weight(next(item for item in session.document.items if item.name == "vixen"))
        is None
    )


def test_words_that_leave_are_kept_as_left_out_until_they_come_back(cloud: pw.Layout) -> None:
    session = cloud.edit()
    session.words({"fox": 3, "owl": 2, "snail": 1})
    assert session.document.left_out == {"bear": 4, "ant": 1}
    session.words({"fox": 3, "owl": 2, "bear": 4})
    assert session.document.left_out == {"ant": 1, "snail": 1}
    session.undo()
    assert session.document.left_out == {"bear": 4, "ant": 1}
    # Another text has left out nothing.
    session.words({"fox": 3, "whale": 2})
    assert session.document.left_out == {}


def test_in_shares_all_become_smaller_where_one_finds_no_room(cloud: pw.Layout) -> None:
    session = cloud.edit()
    (k,) = session.positions("bear")
    session.weigh("bear", 2.5 * float(session.document.weights[k]))
    before = session.document.poses.scale
    found = session.finish()
    assert found.certified, found.in_the_way
    after = session.document.poses.scale
    assert np.ptp(after / before) < 1e-9
    assert after[0] < before[0]


def test_words_that_are_none_are_refused(cloud: pw.Layout) -> None:
    session = cloud.edit()
    with pytest.raises(RecipeError):
        session.words({"bear": -1})
    with pytest.raises(RecipeError, match="no such option"):
        session.words({"bear": 1}, colour="red")


def test_what_forces_pull_at_falls_to_rest_at_its_size(icons: pw.Layout) -> None:
    session = icons.edit()
    session.cover(0.3)
    session.hold("star#1")
    assert session.settle().certified
    before = session.document
    session.set(force="down")
    assert session.settle().certified
    after = session.document.poses
    assert np.array_equal(after.scale, before.poses.scale)
    assert after.y.mean() > before.poses.y.mean() + 5
    (held,) = session.find("star#1")
    assert after.y[held] == before.poses.y[held]
    # At rest: a gesture elsewhere finds it there.
    session.rename("star#1", "still")
    session.settle()
    assert np.abs(session.document.poses.y - after.y).max() < 1
    lifted = session.find("heart#1")[0]
    session.move(lifted, "50%", "25%")
    assert session.settle().certified
    assert session.unmet == ()
    assert session.document.poses.scale.max() <= before.poses.scale.max()
    session.undo()
    session.set(force=())
    session.cover(0.5)
    assert session.settle().certified


def test_a_force_leaves_a_full_container_as_it_is(icons: pw.Layout) -> None:
    session = icons.edit()
    session.set(force="down")
    assert session.settle().certified
    assert np.array_equal(session.document.poses.scale, icons.poses.scale)


def test_a_force_on_some_items_leaves_the_others_and_their_absence_alone(icons: pw.Layout) -> None:
    session = icons.edit()
    session.cover(0.3)
    session.set(force=("down", "right items=star"))
    assert session.settle().certified
    # Others fall first, and alone; then nothing is left that it pulls at.
    session.move(session.find("heart#1")[0], "50%", "25%")
    assert session.settle().certified
    session.remove("star")
    assert session.settle().certified
    with pytest.raises(RecipeError, match="no item is called 'dragon'"):
        session.set(force="down items=dragon")


def test_no_force_of_a_session_reads_a_file(icons: pw.Layout) -> None:
    session = icons.edit()
    with pytest.raises(RecipeError, match="takes no file in a session"):
        session.set(force="towards curve.svg")


def test_a_narrower_turn_turns_what_is_beyond_it(icons: pw.Layout) -> None:
    session = icons.edit()
    session.hold("star#1", "angle")
    (held,) = session.find("star#1")
    kept = session.document.poses.angle[held]
    session.set(rotate="20")
    assert session.settle().certified
    angles = np.delete(session.document.poses.angle, held)
    assert np.abs(np.remainder(angles + np.pi, 2 * np.pi) - np.pi).max() <= np.radians(20) + 1e-9
    assert session.document.poses.angle[held] == kept


def areas_by_name(session: pw.Session) -> dict[str, list[float]]:
    found: dict[str, list[float]] = {}
    for item, area in zip(session.document.items, session.layout.areas.tolist(), strict=True):
        found.setdefault(item.name, []).append(area)
    return found


@pytest.fixture(scope="module")
def spoken() -> pw.Layout:
    counts = {"alpha": 5, "beta": 3, "gamma": 2, "delta": 1}
    return pw.words("circle", counts, effort="draft", seed=1, epochs=40, levels="50")


def test_copies_and_guests_of_words_can_be_seen(spoken: pw.Layout) -> None:
    session = spoken.edit()
    session.count(6)
    session.add("star")
    session.settle()
    areas = areas_by_name(session)
    assert min(areas["alpha"]) == pytest.approx(max(areas["alpha"]), rel=0.01)
    assert areas["star"][0] > 0.1 * max(areas["alpha"])
    assert session.is_certified


def test_other_words_weigh_what_they_are_asked_to_and_no_copy_is_left(cloud: pw.Layout) -> None:
    session = cloud.edit()
    session.count(8)
    session.words({"bear": 1, "omega": 4})
    session.settle()
    areas = areas_by_name(session)
    assert {name: len(found) for name, found in areas.items()} == {"bear": 1, "omega": 1}
    # Letters four times as high.
    scales = dict(zip(areas, session.document.poses.scale.tolist(), strict=True))
    assert scales["omega"] / scales["bear"] == pytest.approx(4, rel=0.02)


def test_no_held_word_is_taken_away(spoken: pw.Layout) -> None:
    session = spoken.edit()
    session.hold("beta")
    before = session.document
    with pytest.raises(pw.RecipeError, match="beta: held, and not among these words"):
        session.words({"alpha": 1})
    assert session.document is before


def test_words_of_a_file_of_shapes_are_replaced(spoken: pw.Layout, tmp_path: Path) -> None:
    spoken.save(tmp_path / "cloud.geojson")
    session = pw.Layout.load(tmp_path / "cloud.geojson").edit()
    session.words({"alpha": 2, "omega": 1})
    session.settle()
    assert sorted(areas_by_name(session)) == ["alpha", "omega"]


@pytest.mark.parametrize("seed", [0, 1])
def test_a_cloud_fills_as_before_when_a_word_weighs_otherwise(seed: int) -> None:
    names = ["bear", "fox", "owl", "snail", "ant", "tiger", "panther", "crow", "elk", "bee"]
    weights = {f"{name}{end}": 1 / (k + 2) for k, name in enumerate(names) for end in ("", "s")}
    session = pw.words(
        "heart", weights, sizes="shared", padding=0, seed=seed, effort="draft"
    ).edit()
    before = covered(session)
    session.weigh("bees", 2 * float(session.document.weights.max()))
    assert session.settle().certified
    assert covered(session) > before - 0.05
    said = " ".join(session.advice)
    where = session.document.poses.x
    session.undo()
    assert covered(session) == before
    assert "poured anew" in said or np.median(np.abs(where - session.document.poses.x)) < 20


def test_other_letters_are_set_at_once_and_kept_for_the_next_words() -> None:
    weights = {"bear": 4, "fox": 3, "owl": 2, "snail": 1, "ant": 1}
    session = pw.words("heart", weights, sizes="shared", padding=0).edit()
    session.words(weights, font="DejaVu Serif")
    assert session.settle().certified
    session.words({**weights, "elk": 2})
    names = {run.font.name for item in session.document.items for run in item.text.runs}
    assert len(names) == 1
    assert "Serif" in names.pop()
    assert len({item.name for item in session.document.items}) == len(session.document) == 6


def test_recoloured_words_stay_where_they_are(cloud: pw.Layout) -> None:
    session = cloud.edit()
    session.recolor("*", "teal")
    assert session.settle().moved == 0
    assert not any("poured" in line for line in session.advice)


def test_what_is_poor_is_told_as_of_a_run() -> None:
    session = pw.fill("heart", "star", count=6, sizes="free", **QUICK).edit()
    session.cover("10%")
    session.settle()
    assert any("would show it" in line for line in session.advice)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_words_come_among_icons_with_their_share_of_what_is_covered(
    icons: pw.Layout, seed: int, tmp_path: Path
) -> None:
    session = icons.edit()
    session.mix({"bear": 4, "fox": 3, "owl": 2}, "40%", seed=seed)
    for share in (0.4, 0.7):
        assert session.settle().certified
        document = session.document
        is_word = np.array([item.text is not None for item in document.items])
        assert (len(document), int(is_word.sum())) == (12, 3)
        areas = document.areas
        assert areas[is_word].sum() / areas.sum() == pytest.approx(share, rel=1e-6)
        assert document.poses.angle[is_word] == pytest.approx(0.0, abs=1e-9)
        if share == 0.4:
            # What a hand has put somewhere stays there, once all is poured anew.
            poses, side = document.poses, document.container.side
            session.move(0, x=float(poses.x[0]) + 0.03 * side, y=float(poses.y[0]))
            session.settle()
            # What is moved and put back is not put there, and undo and redo keep what was.
            session.move(1, x=float(poses.x[1]) + 0.03 * side, y=float(poses.y[1]))
            session.undo()
            session.undo()
            assert not session.document.put
            session.redo()
            session.save(tmp_path / "put.packwork")
            session = pw.Session.open(tmp_path / "put.packwork")
            before = session.document.poses
            session.mix(None, 0.7, seed=seed)
            after = session.document.poses
            stay = np.hypot(after.x - before.x, after.y - before.y)[:9] < 1e-6 * side
            assert stay.tolist() == [True] + 8 * [False]
    for _ in range(3):
        session.undo()
    assert session.document.poses.x.tobytes() == icons.poses.x.tobytes()


def test_of_what_is_held_only_what_has_no_room_gives_way(icons: pw.Layout) -> None:
    poses = icons.poses
    x, y = poses.x.copy(), poses.y.copy()
    x[5], y[5] = x[3], y[3]
    x[7], x[8], y[8] = -icons.container.side, 0.0, 0.0
    document = replace(
        icons.edit().document, poses=replace(poses, x=x, y=y), put=frozenset({0, 3, 5, 7, 8})
    )
    put = poured_again(document.with_held_hand(), 0)
    there = dict(zip(put.items, np.array(put.poses)[:, :2].tolist(), strict=True))
    # What finds no place in a run is left where it is.
    places = {k: (x[k], y[k]) for k in sorted(document.put)}
    moved = [k for k, at in places.items() if there.get(k, at) != pytest.approx(at, rel=1e-9)]
    assert moved == [5, 7, 8]


@pytest.mark.parametrize("weightless", [2, 9])
def test_fillers_count_in_the_share_of_words(icons: pw.Layout, weightless: int) -> None:
    weights = np.where(np.arange(9) < weightless, 0.0, 1.0)
    session = replace(icons, weights=weights).edit()
    session.mix({"bear": 4, "fox": 3}, "40%")
    areas = session.document.areas
    assert areas[9:].sum() / areas.sum() == pytest.approx(0.4, rel=1e-6)


def test_a_share_is_of_words_among_others(icons: pw.Layout, cloud: pw.Layout) -> None:
    for layout, source in ((icons, None), (cloud, None), (cloud, {"elk": 1})):
        with pytest.raises(RecipeError, match="one kind only"):
            layout.edit().mix(source, 0.5)
    with pytest.raises(RecipeError, match="must be a share such as 70%"):
        icons.edit().mix({"elk": 1}, 2)


def test_names_of_parts_follow_the_sheet_and_are_there_once(tmp_path: Path) -> None:
    source = tmp_path / "map.svg"
    shapes = (
        '<rect id="Peru" width="50" height="60"/>',
        '<rect id="Chile" x="50" width="50" height="60"/>',
    )
    page = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 60">{"".join(shapes)}</svg>'
    source.write_text(page, encoding="utf-8")
    land = container_of(str(source), None)
    labels, told = labels_of(land)
    assert not told
    # Shapes of a drawing are named for other ends.
    assert told_of_map(land) == ""
    session = pw.fill("circle", ["star"], count=3, **QUICK).edit()
    of_group = replace(labels[0].item, name="warm", source="label:warm")
    session.apply(next(brought(session, [of_group])))

    def fill(container: Container, names: list[PartLabel]) -> list[str]:
        asset = named_container(session.library, container)
        session.do_together([made(SetContainer, asset=asset), *labelled(session, names)])
        return [item.name for item in session.document.items]

    assert fill(land, labels) == [*3 * ["star"], "warm", "Peru", "Chile"]
    before = session.document.poses.subset([4, 5])
    half = on_canvas(land, canvas_size("300px"))
    names = labels_in(session.document, half)
    assert fill(half, names) == [*3 * ["star"], "warm", "Peru", "Chile"]
    after, factor = session.document.poses.subset([4, 5]), half.side / land.side
    for column in ("x", "y", "scale"):
        assert getattr(after, column) == pytest.approx(factor * getattr(before, column))
    assert session.document.held.all(axis=1).tolist() == 4 * [False] + 2 * [True]
    session.remove(["star", "warm"])
    assert fill(land, labels) == ["Peru", "Chile"]
    # A collage has one item at least.
    assert fill(half, []) == ["Peru", "Chile"]
    assert not session.document.held.any()

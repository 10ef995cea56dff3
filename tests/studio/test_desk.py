"""The desk and the pages that look at it: frames, commands, history, several pages."""

from __future__ import annotations

import asyncio
import importlib.util
import threading
import zipfile
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import PackworkError
from packwork.live import edits
from packwork.live.face import exporting
from packwork.live.face.opening import Opening, opening_of
from packwork.live.session import Session
from packwork.scene.item import FlatArt
from packwork.studio import wire
from packwork.studio.files import Exporter
from packwork.studio.tab import MOST_AHEAD
from packwork.studio.view import Scenes, View
from packwork.studio.workspace import Workspace


def poses_of(frame: bytes) -> np.ndarray:
    return np.frombuffer(frame[16:], "<f4").reshape(-1, 4)


def test_a_page_hears_shapes_then_the_scene_then_frames(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        kinds = [message["type"] for message in page.messages]
        assert kinds.index("shapes") < kinds.index("scene") < kinds.index("state")
        assert len(page.last("scene")["items"]) == 12
        assert len(page.last("shapes")["shapes"]) == 3
        assert poses_of(page.frames[-1]).shape == (12, 4)

    play(scenario)


def test_a_page_that_is_slow_gets_a_few_frames_and_then_the_newest(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page, other = open_page(), open_page()
        page.acknowledges = False
        await page.until(lambda: page.frames)
        await other.until(lambda: other.is_certified)
        for n, x in enumerate((290.0, 295.0, 305.0, 300.0), 1):
            other.tell(type="do", n=n, command={"kind": "move", "item": 0, "x": x, "y": 300.0})
            await other.until(lambda n=n: other.done == n and other.is_certified)
        assert len(page.frames) == MOST_AHEAD
        page.acknowledge()
        await page.until(lambda: len(page.frames) == MOST_AHEAD + 1)
        assert poses_of(page.frames[-1])[0, 0] == pytest.approx(300.0)

    play(scenario)


def test_a_drag_moves_neighbours_settles_and_is_one_step_back(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        before = poses_of(page.frames[-1])
        x, y = map(float, before[0, :2])
        page.tell(type="do", n=1, command={"kind": "grab", "items": [0]})
        for step in range(20):
            move = {"kind": "move", "item": 0, "x": x + (300 - x) * step / 19, "y": y}
            page.tell(type="do", n=2 + step, command=move)
            await asyncio.sleep(0.005)
        await page.until(lambda: page.done == 21)
        assert not page.last("state")["certified"]
        page.tell(type="do", n=22, command={"kind": "drop"})
        await page.until(lambda: page.done == 22 and page.is_certified)
        after = poses_of(page.frames[-1])
        assert (np.abs(after - before)[1:] > 1e-3).any()
        assert page.last("state")["can_undo"]
        page.tell(type="leap", n=99, to="undo")
        await page.until(lambda: page.last("state")["can_redo"] and page.is_certified)
        await page.until(lambda: np.array_equal(poses_of(page.frames[-1]), before))
        assert not page.last("state")["can_undo"]

    play(scenario)


def test_work_is_told_at_once_until_it_is_done(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.messages.clear()
        page.tell(type="count", count=14)
        await page.until(lambda: page.said("state"))
        assert len(desk.shown.view.items) == 12
        assert page.last("state")["busy"] == "Changing the count"
        await page.until(lambda: not page.last("state")["busy"])
        works = [state["busy"] for state in page.said("state")]
        assert all(works[: works.index("")])
        assert not any(works[works.index("") :])
        assert not any(state["can_stop"] for state in page.said("state"))
        assert len(page.last("scene")["items"]) == 14

    play(scenario)


def test_a_drop_is_certified_exported_and_undone_before_gaps_are_closed(
    play, monkeypatch: pytest.MonkeyPatch
) -> None:
    polish, may_end, turns = Session.polish, threading.Event(), list[int]()

    def polished(session: Session, trials: int, stop: Callable[[], bool]) -> int:
        turns.append(trials)
        return polish(session, trials, stop) if may_end.wait(0.01) else 0

    monkeypatch.setattr(Session, "polish", polished)
    monkeypatch.setattr("packwork.live.session.advice_of", lambda _: (f"after turn {len(turns)}",))

    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        before = poses_of(page.frames[-1])
        for n in (1, 5):
            page.tell(type="do", n=n, command={"kind": "grab", "items": [0]})
            page.tell(type="do", n=n + 1, command={"kind": "move", "item": 0, "x": 300, "y": 300})
            page.tell(type="do", n=n + 2, command={"kind": "drop"})
            await page.until(lambda n=n: page.done == n + 2 and page.last("state")["certified"])
            assert page.last("state")["polishing"]
            assert not page.last("state")["busy"]
            assert page.last("state")["can_undo"]
            assert (await Exporter(desk, Path).file({"format": "svg"}))[0].startswith(b"<")
            if n == 1:
                page.tell(type="leap", n=4, to="undo")
                await page.until(lambda: page.done == 4)
                assert np.array_equal(poses_of(page.frames[-1]), before)
        assert page.last("state")["polishing"]
        page.messages[:-1] = []
        may_end.set()
        await page.until(lambda: page.is_certified)
        # All the while nothing is called work, or not certified, and the same is said of it.
        assert all(one["certified"] and not one["busy"] for one in page.said("state"))
        assert len({tuple(one["advice"]) for one in page.said("state")}) == 1
        assert turns

    play(scenario)


def test_what_a_page_drags_is_let_go_when_it_is_gone(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page, other = open_page(), open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="do", n=1, command={"kind": "grab", "items": [0]})
        other.tell(type="do", n=1, command={"kind": "grab", "items": [1]})
        await other.until(lambda: other.said("line"))
        assert "another page" in other.last("line")["text"]
        page.tell(type="do", n=2, command={"kind": "move", "item": 0, "x": 300.0, "y": 300.0})
        desk.forget(page.tab)
        other.tell(type="do", n=2, command={"kind": "grab", "items": [1]})
        other.tell(type="do", n=3, command={"kind": "drop"})
        other.tell(type="leap", n=4, to="undo")
        await other.until(lambda: other.done == 4 and other.is_certified)
        assert len(other.said("line")) == 1

    play(scenario)


def test_two_pages_see_one_session(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        one, other = open_page(), open_page()
        await one.until(lambda: one.is_certified)
        await other.until(lambda: other.is_certified)
        one.tell(type="do", n=1, command={"kind": "hold", "items": [3]})
        await other.until(lambda: any(thing["held"][0] for thing in other.last("scene")["items"]))
        held = [thing["id"] for thing in other.last("scene")["items"] if all(thing["held"])]
        assert held == [3]
        await one.until(lambda: one.done == 1)
        assert other.done == 0

    play(scenario)


def test_what_has_no_meaning_is_a_line_and_nothing_else(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="do", n=1, command={"kind": "remove", "items": [99]})
        page.tell(type="bring", sources=["/etc/passwd"])
        page.tell(type="bring", sources=["file:../../etc"])
        page.tell(type="room", source="builtin:nothing")
        page.tell(type="room", source="text:A", font="/etc/hosts.ttf")
        page.tell(type="set", options={"padding": "wide"})
        page.tell(type="nonsense")
        await page.until(lambda: len(page.said("line")) == 7)
        for line in page.said("line"):
            assert line["is_error"]
            assert "\n" not in line["text"]
            assert "Traceback" not in line["text"]
            assert "packwork-studio" not in line["text"]
        await page.until(lambda: page.is_certified)
        assert len(page.last("scene")["items"]) == 12

    play(scenario)


def test_items_come_go_and_are_exchanged(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="bring", sources=["builtin:star", "builtin:moon"])
        await page.until(lambda: len(page.last("scene")["items"]) == 14 and page.is_certified)
        page.tell(type="swap", items=[0, 1], source="builtin:moon")
        await page.until(
            lambda: [t["name"] for t in page.last("scene")["items"]].count("moon") == 3
        )
        page.tell(type="count", count=9)
        await page.until(lambda: len(page.last("scene")["items"]) == 9 and page.is_certified)

    play(scenario)


def test_another_container_is_filled_anew_in_one_step(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="room", source="builtin:bear")
        await page.until(lambda: page.last("scene")["name"] == "bear" and page.is_certified)
        page.tell(type="leap", n=99, to="undo")
        await page.until(lambda: page.last("scene")["name"] == "circle" and page.is_certified)
        assert not page.last("state")["can_undo"]

    play(scenario)


def test_no_scene_is_said_to_be_certified_by_what_was_said_of_another(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        for name in ("bear", "cat"):
            page.tell(type="room", source=f"builtin:{name}")
            await page.until(
                lambda name=name: page.last("scene")["name"] == name and page.is_certified
            )
        said = [one for one in page.messages if one["type"] in {"scene", "state"}]
        followed = [k for k, one in enumerate(said) if k and one["type"] == "scene"]
        assert len(followed) >= 2
        assert all(
            said[k - 1]["type"] == "state" and not said[k - 1]["certified"] for k in followed
        )

    play(scenario)


def test_undo_is_counted_as_commands_are(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="do", n=1, command={"kind": "hold", "items": [3]})
        page.tell(type="leap", n=2, to="undo")
        await page.until(lambda: page.done == 2)
        assert not any(any(thing["held"]) for thing in page.last("scene")["items"])

    play(scenario)


def test_pouring_anew_keeps_what_is_held(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        before = poses_of(page.frames[-1])
        page.tell(type="do", n=1, command={"kind": "hold", "items": [5]})
        page.tell(type="pour", seed=4)

        def is_elsewhere() -> bool:
            return not np.array_equal(poses_of(page.frames[-1])[0], before[0])

        await page.until(lambda: page.done == 1 and page.is_certified and is_elsewhere())
        assert poses_of(page.frames[-1])[5] == pytest.approx(before[5])

    play(scenario)


def test_a_count_asked_for_while_other_items_pour_is_had_of_them(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)

        def names() -> list[str]:
            return [thing["name"] for thing in page.last("scene")["items"]]

        page.tell(type="fill", use="items", source="builtin:cat", count=9)
        await page.until(lambda: set(names()) == {"cat"})
        assert page.last("state")["busy"] == "Pouring"
        page.tell(type="count", count=5)
        await page.until(lambda: page.is_certified and names() == ["cat"] * 5)

    play(scenario)


def test_items_are_put_in_an_order_or_like_beside_like(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        names = np.array([thing["name"] for thing in page.last("scene")["items"]])
        one, *_, other = sorted(set(names))

        def far(axis: int) -> float:
            places = poses_of(page.frames[-1])[:, axis]
            return float(places[names == other].mean() - places[names == one].mean())

        def is_told(text: str) -> bool:
            return any(text in line["text"] for line in page.said("line"))

        page.tell(type="order", way="right", by="name")
        await page.until(lambda: page.is_certified and far(0) > 100)
        page.tell(type="order", way="up", by="name")
        await page.until(lambda: page.is_certified and far(1) < -100)
        page.tell(type="alike", source="auto")
        await page.until(lambda: is_told("for words of a text"))
        page.tell(type="alike", source="file:0123456789abcdef")
        await page.until(lambda: is_told("no such files"))
        page.tell(type="leap", n=1, to="undo")
        await page.until(lambda: page.is_certified and far(0) > 100)

    play(scenario)


KINDS = ["svg", "pdf", "png", "dxf", "geojson", "packwork", "recipe", "film.svg", "film.gif"]


def test_all_formats_are_exported(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        found = {
            kind: await Exporter(desk, Path).file({"format": kind, "options": {}}) for kind in KINDS
        }
        assert [kind for kind, (data, media) in found.items() if not (data and media)] == []

    async def waiting(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        await scenario(desk, open_page)

    play(waiting)


def test_an_exported_recipe_runs(play, tmp_path: Path) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        data, _ = await Exporter(desk, Path).file({"format": "recipe"})
        zipfile.ZipFile(BytesIO(data)).extractall(tmp_path)

    play(scenario)
    (recipe,) = tmp_path.glob("*/recipe.toml")
    assert "packwork run recipe.toml" in recipe.with_name("README.txt").read_text(encoding="utf-8")
    assert len(pw.run(recipe).items) == 12


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"format": "exe"}, "'exe'"),
        ({"format": "film.gif", "options": {"fps": 0}}, "fps"),
        ({"format": "film.gif", "options": {"background": 3}}, "background"),
        ({"format": "svg", "options": {"nothing": 1}}, "nothing"),
    ],
)
def test_what_cannot_be_exported_is_refused_in_a_line(play, asked: dict, said: str) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        with pytest.raises(PackworkError, match=said) as refusal:
            await Exporter(desk, Path).file(asked)
        assert "\n" not in str(refusal.value)

    play(scenario)


def test_options_that_mean_nothing_are_refused_before_it_is_waited_for_what_moves(
    play, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        exporter = Exporter(desk, Path)
        monkeypatch.setattr(exporter, "_at_rest", pytest.fail)
        with pytest.raises(PackworkError, match="no colour"):
            await exporter.file({"format": "png", "options": {"background": "notacolour"}})

    play(scenario)


def test_formats_whose_packages_are_missing_are_offered_with_the_reason(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert exporting.missing() == {}
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "typst" else find(name)
    )
    assert exporting.missing() == {
        "pdf": 'needs the package typst; install it: pip install "packwork[pdf]"'
    }


def test_a_desk_begins_with_a_run_that_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    recipe = opening_of(["circle", "star"], 5, levels="50", epochs=60).recipe
    opening = Opening(recipe=recipe)
    desk = Workspace(opening)
    counts: list[int] = []
    see = desk._see
    monkeypatch.setattr(
        desk, "_see", lambda view, moment: (counts.append(len(view.items)), see(view, moment))
    )
    desk._open(opening, lambda: None)
    desk.close()
    assert counts[0] == 0
    assert counts.count(5) > 3
    assert desk.owner is not None
    assert desk.owner.frame.in_the_way == ()


def test_a_view_is_like_another_but_for_poses(opening: Opening) -> None:
    document = opening.document
    assert document is not None
    one, other = View.of_document(document), View.of_document(document, document.poses)
    assert one.is_like(other)
    data = wire.frame_bytes(7, 1, 3, True, one.numbers)
    assert wire.HEAD.unpack(data[:16]) == (7, 1, 3, wire.MOVING)


def test_drawings_of_long_ago_are_forgotten(opening: Opening) -> None:
    session, scenes = Session(opening.document), Scenes()
    for k in range(20):
        session.do("recolour", items=tuple(session.document.ids.tolist()), colour=f"#0000{k:02x}")
        scene = scenes.of(View.of_document(session.document))
        assert set(scene.shapes) <= set(scenes.shapes)
    assert len(scenes.shapes) <= 2 * len(session.document)
    session.undo()
    view = View.of_document(session.document)
    assert set(scenes.of(view).shapes) <= set(scenes.shapes)
    # Where nothing is shown nothing is kept, once the scene before must have come.
    bare = replace(view, items=(), ids=view.ids[:0], weights=view.weights[:0], poses=None)
    for title in ("one", "two"):
        scenes.of(replace(bare, title=title))
    assert scenes.shapes == {}


def test_a_page_forgets_looks_of_long_ago(play, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("packwork.studio.tab.MOST_KEPT", 4)

    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        ids = [item["id"] for item in page.last("scene")["items"]]

        def known() -> set[str]:
            keys: dict[str, None] = {}
            for said in page.messages:
                if said["type"] == "shapes":
                    keys |= dict.fromkeys(one["key"] for one in said["shapes"])
                    for gone in said["gone"]:
                        del keys[gone]
                if said["type"] == "scene":
                    assert {item["shape"] for item in said["items"]} <= set(keys)
            return set(keys)

        for k in range(1, 6):
            command = {"kind": "recolour", "items": ids, "colour": f"#0000{k:02x}"}
            page.tell(type="do", n=k, command=command)
            await page.until(lambda k=k: page.done == k and page.is_certified)
        assert 4 <= len(known()) <= 4 + len(page.last("scene")["items"])
        for k in range(6, 11):
            page.tell(type="leap", n=k, to="undo")
            await page.until(lambda k=k: page.done == k and page.is_certified)
        assert known() >= {item["shape"] for item in page.last("scene")["items"]}

    play(scenario)


def test_a_page_on_a_slow_line_passes_over_a_scene_of_which_nothing_is_kept(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        draw, later = desk.scene, [f"#0000{k:02x}" for k in range(10)]

        async def overtaken(view: View) -> wire.Scene:
            scene = await draw(view)
            while scene.version > 1 and later:
                art = FlatArt(later.pop())
                items = {one: replace(one, art=art) for one in view.items}
                desk.shapes.of(replace(view, items=tuple(items[one] for one in view.items)))
            return scene

        desk.scene = overtaken
        ids = [item["id"] for item in page.last("scene")["items"]]
        command = {"kind": "recolour", "items": ids, "colour": "#1f6f78"}
        page.tell(type="do", n=1, command=command)
        await page.until(lambda: page.done == 1 and page.is_certified)
        assert later == []
        shapes = {one["key"]: one for said in page.said("shapes") for one in said["shapes"]}
        fills = {shapes[item["shape"]]["fill"] for item in page.last("scene")["items"]}
        assert fills == {"#1f6f78ff"}

    play(scenario)


def test_nothing_is_called_certified_that_the_page_does_not_show(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page, other = open_page(), open_page()
        page.acknowledges = False
        await other.until(lambda: other.is_certified)
        await page.until(lambda: page.frames)
        other.tell(type="do", n=1, command={"kind": "move", "item": 0, "x": 300.0, "y": 300.0})
        await other.until(lambda: other.done == 1 and other.is_certified)
        await page.until(lambda: page.last("state")["moving"])
        assert not page.last("state")["certified"]
        while not page.is_certified:
            page.acknowledge()
            await asyncio.sleep(0.01)
        assert poses_of(page.frames[-1])[0, 0] == pytest.approx(300.0)

    play(scenario)


def test_pages_are_told_what_is_poor_though_it_is_certified(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        desk.change(lambda session: edits.cover(session, "8%"), "Covering")
        await page.until(lambda: page.is_certified and page.last("state")["advice"])
        assert "would show it" in page.last("state")["advice"][0]

    play(scenario)

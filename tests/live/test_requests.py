"""What was asked of items is had, or said; numbers and positions; whether a step was undone."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import packwork as pw
from packwork.live.certificate import Requests
from packwork.live.commands.gestures import Cancel, Grab
from packwork.live.document import Document
from packwork.live.names import called
from packwork.live.relayout import poured_again


@pytest.mark.parametrize("which", ["star#1", "heart#2", "hexagon#3"])
def test_what_is_scaled_keeps_its_angle(session: pw.Session, dozen: pw.Layout, which: str) -> None:
    (k,) = session.positions(which)
    session.scale(which, 1.6)
    session.settle()
    assert session.layout.poses.angle[k] == dozen.poses.angle[k]


def test_a_size_for_which_there_is_no_room_is_said(session: pw.Session, dozen: pw.Layout) -> None:
    (k,) = session.positions("star#1")
    session.hold([n for n in session.find("*") if n != session.one("star#1")])
    session.scale("star#1", 2.5)
    assert session.unmet == ()
    assert session.settle().certified
    (said,) = session.unmet
    factor = session.layout.poses.scale[k] / dozen.poses.scale[k]
    assert said == (
        f"star#1 is {factor:.3g} times as large as it was, not 2.5 times: there is no room for more"
    )
    assert session.undo()
    assert session.unmet == ()


def test_a_size_that_is_had_is_not_spoken_of(session: pw.Session) -> None:
    session.scale("star#1", 0.7)
    session.scale("star#1", 1.1)
    session.settle()
    assert session.unmet == ()


def test_a_place_outside_is_said(session: pw.Session) -> None:
    session.move("heart#1", 0, 0)
    session.move("star#1", "50%", "50%")
    session.settle()
    (said,) = session.unmet
    assert said.startswith("heart#1 is at ")
    assert "not at 0, 0: there is no room for it" in said


def test_what_was_not_had_is_said_until_it_is_had_or_asked_otherwise(session: pw.Session) -> None:
    session.move("heart#1", 0, 0)
    session.settle()
    session.move("star#1", "50%", "50%")
    session.settle()
    session.apply(Grab(items=(session.one("heart#1"),)))
    session.move("heart#1", 300, 300)
    session.apply(Cancel())
    session.settle()
    (said,) = session.unmet
    assert said.startswith("heart#1 is at ")
    session.move("heart#1", "40%", "50%")
    session.settle()
    assert not any(line.startswith("heart#1") for line in session.unmet)


def test_undo_takes_back_what_was_asked_last_and_redo_asks_it_again(session: pw.Session) -> None:
    session.move("heart#1", 0, 0)
    session.settle()
    (first,) = session.unmet
    session.move("star#1", 600, 0)
    session.settle()
    both = session.unmet
    assert len(both) == 2
    session.undo()
    assert session.unmet == (first,)
    session.redo()
    assert session.unmet == both
    session.undo()
    session.undo()
    assert session.unmet == ()


def test_positions_are_of_the_layout_and_numbers_for_ever(session: pw.Session) -> None:
    (number,) = session.find("hexagon#4")
    session.remove("star#1")
    session.move("hexagon#4", 300, 300)
    (position,) = session.positions("hexagon#4")
    assert session.find("hexagon#4") == (number,)
    assert position == number - 1
    layout = session.layout
    assert layout.items[position].name == "hexagon"
    assert layout.poses.x[session.positions("hexagon#4")].tolist() == [300.0]
    assert session.positions(number) == [position]
    names = np.array([item.name for item in layout.items])
    assert set(names[session.positions("heart")].tolist()) == {"heart"}


def test_undo_and_redo_say_whether_they_did_anything(session: pw.Session) -> None:
    assert not session.undo()
    assert not session.redo()
    session.move("star#1", 300, 300)
    assert session.undo()
    assert not session.undo()
    assert session.redo()
    assert not session.redo()


def test_the_place_of_what_is_added_is_said_where_it_is_not_had(session: pw.Session) -> None:
    session.add("star", 0, 0)
    session.add("star")
    session.settle()
    (said,) = session.unmet
    assert said.startswith("star#5 is at ")
    assert said.endswith("not at 0, 0: there is no room for it")


@pytest.mark.parametrize(("first", "second"), [(0, 5), (3, 7), (8, 1)])
def test_what_was_put_by_hand_and_made_way_is_said_until_the_next_gesture(
    session: pw.Session, first: int, second: int
) -> None:
    session.move(first, "50%", "50%")
    session.finish()
    before = session.document
    session.move(second, "50%", "50%")
    session.finish()
    poses, row = session.document.poses, before.index(first)
    assert math.dist((300, 300), (poses.x[row], poses.y[row])) > 3
    (said,) = session.unmet
    assert said.startswith(f"{called(before, row)} is at ")
    assert said.endswith("not at 300, 300 as put by hand: it made way")
    session.settle()
    assert session.unmet == (said,)
    session.turn(second, 20)
    session.settle()
    assert not any("made way" in line and "not at 300, 300" in line for line in session.unmet)
    session.undo()
    session.undo()
    assert session.unmet == ()


def placed(document: Document, x: float, y: float) -> Document:
    """A document whose first item lies there, as put by hand."""
    columns = {name: getattr(document.poses, name).copy() for name in ("x", "y")}
    columns["x"][0], columns["y"][0] = x, y
    return replace(document, poses=replace(document.poses, **columns), put=frozenset({0}))


def test_what_makes_way_bit_by_bit_is_said_once(session: pw.Session) -> None:
    document, requests, lines = session.document, Requests(), list[int]()
    ways = [placed(document, 300.0 + way, 300.0) for way in (0.0, 0.0, 5.0, 10.0, 15.0, 20.0, 40.0)]
    for before, now in pairwise(ways):
        requests.settled(before, now, set())
        lines.append(len(requests.unmet(now)))
    assert lines == [0, 0, 0, 1, 0, 0]
    again = placed(document, 340.0, 301.0)
    requests.settled(ways[-1], again, {0})
    requests.settled(again, placed(document, 300.0, 300.0), set())
    (said,) = requests.unmet(placed(document, 300.0, 300.0)).values()
    assert "not at 340, 301 as put by hand" in said


def test_on_a_tile_the_nearest_image_of_the_place_is_named() -> None:
    tile = pw.fill("page", ["star", "heart"], count=6, tile="square", levels="50", epochs=40)
    put = placed(tile.edit().document, 2.0, 1.0)
    now, requests = placed(put, 570.0, 590.0), Requests()
    requests.settled(put, now, set())
    (said,) = requests.unmet(now).values()
    assert "is at 570, 590, not at 602, 601 as put by hand" in said


def test_what_is_put_elsewhere_by_a_run_has_not_made_way(session: pw.Session) -> None:
    session.move(0, "50%", "50%")
    session.settle()
    session.apply(poured_again(session.document, 3))
    session.settle()
    assert session.unmet == ()

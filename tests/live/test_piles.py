"""A pile under the hand: what is added falls, what has no room is taken back, heaped anew."""

from __future__ import annotations

import io

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live import edits
from packwork.live.document import Document
from packwork.live.log import Log, read_entries
from packwork.live.relayout import Moment, poured_again
from packwork.live.session import Session


@pytest.fixture(scope="module")
def heap() -> pw.Layout:
    """Twenty icons in the lower half of a square."""
    return pw.pile("square", ["star", "hexagon"], count=20, size="14%", effort="draft")


@pytest.fixture
def session(heap: pw.Layout) -> pw.Session:
    """A session that begins with the heap."""
    return heap.edit()


def test_what_is_added_falls_on_the_heap_as_one_watches(session: pw.Session) -> None:
    before, seen = session.document, list[Document]()
    session.watch(seen.append)
    session.add("heart")
    added = session.document.next_id - 1
    side = before.container.side
    session.move(added, side / 2, side / 8)
    assert session.settle().certified
    heights = [one.poses.y[one.index(added)] for one in seen]
    assert len(heights) > 3
    assert heights[-1] > heights[0] + side / 20
    # Upon something: where it is at rest it touches what lies below.
    assert session.document.poses.y[-1] < before.poses.y.max()


def test_what_was_caught_in_its_fall_falls_on_among_many_at_rest() -> None:
    session = pw.pile("square", ["star", "hexagon"], count=40, size="8%", effort="draft").edit()
    session.add("heart")
    added, side, seen = session.document.next_id - 1, session.document.container.side, []
    session.watch(seen.append)
    session.move(added, side / 2, side / 8)
    assert session.settle_unless(lambda: len(seen) > 3) is None
    session.do("grab", items=[added])
    session.move(added, side / 2, side / 6)
    session.do("drop")
    assert session.settle().certified
    lies = session.document
    k = lies.index(added)
    assert lies.poses.y[k] > lies.poses.y[:-1].min() - side / 8
    session.move(added, float(lies.poses.x[k]), float(lies.poses.y[k]))
    session.settle()
    assert session.document.poses.y[k] == pytest.approx(lies.poses.y[k], abs=side / 100)


def test_what_has_no_room_is_taken_back(session: pw.Session) -> None:
    before = session.document
    session.hold(list(range(1, 20)))
    session.move(0, float(before.poses.x[1]), float(before.poses.y[1]))
    session.hold(0)
    assert session.settle().certified
    assert session.document.poses.x[0] == before.poses.x[0]
    assert any("taken back" in line for line in session.advice)


def test_a_pile_is_heaped_anew_at_its_sizes_about_what_is_held(session: pw.Session) -> None:
    session.hold(3)
    before, seen = session.document, list[Moment]()
    command = poured_again(before, 5, seen.append)
    assert seen[0].poses is not None
    assert len(seen[0].poses) == len(before)
    session.apply(command)
    assert session.settle().certified
    now = session.document
    assert now.poses.scale == pytest.approx(before.poses.scale)
    assert now.poses.x[3] == before.poses.x[3]
    assert not np.array_equal(now.poses.x, before.poses.x)
    with pytest.raises(RecipeError, match="in no order"):
        poured_again(before, 5, arrange="up by=hue")


def test_a_pile_replays_to_the_same_places(session: pw.Session) -> None:
    before, stream = session.document, io.StringIO()
    session = Session(before, log=Log(stream))
    edits.remove(session, 2)
    edits.turn(session, 5, 90)
    session.settle()
    entries = list(read_entries(iter(stream.getvalue().splitlines()), "log"))
    again = Session.replay(before, entries)
    assert np.array_equal(again.document.poses.y, session.document.poses.y)

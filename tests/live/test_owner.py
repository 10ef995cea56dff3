"""The thread that owns a session: bounded, in order, the last state wins."""

from __future__ import annotations

import threading
import time

import pytest

import packwork as pw
from packwork.live import owner as module
from packwork.live.commands.command import Command, Library
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.items import Rename
from packwork.live.commands.placing import Move
from packwork.live.document import Document
from packwork.live.owner import Leap, Owner
from packwork.live.session import Session


def test_a_sender_that_is_faster_sees_a_bounded_queue_and_the_last_state(
    dozen: pw.Layout,
) -> None:
    with Owner(Session(Document.of(dozen))) as owner:
        owner.post(Grab(items=(0,)))
        most = 0
        for step in range(3_000):
            assert owner.post(Move(item=0, x=250 + step / 60, y=300.0))
            most = max(most, owner.waiting)
        owner.post(Drop())
    assert most <= 2
    assert owner.frame.document.poses.x[0] == pytest.approx(250 + 2_999 / 60)
    assert owner.frame.in_the_way == ()


def test_more_than_wait_are_not_taken(dozen: pw.Layout, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_WAITING", 5)
    owner = Owner(Session(Document.of(dozen)))
    taken = [owner.post(Rename(item=0, name=f"n{k}")) for k in range(9)]
    assert taken == [True] * 5 + [False] * 4
    with owner:
        pass
    assert owner.frame.document.items[0].name == "n4"


def test_what_has_no_meaning_is_told_with_a_frame_and_the_rest_is_done(dozen: pw.Layout) -> None:
    with Owner(Session(Document.of(dozen))) as owner:
        owner.post(Move(item=77, x=1.0, y=1.0))
        told = wait_for(owner)
        owner.post(Rename(item=0, name="sun"))
    assert told == ("move: there is no item 77; numbers go from 0 to 11",)
    assert owner.frame.document.items[0].name == "sun"


def wait_for(owner: Owner) -> tuple[str, ...]:
    """Refusals of the first frame that has some."""
    for _ in range(2_000):
        if owner.frame.refused:
            return owner.frame.refused
        time.sleep(0.005)
    return ()


def test_a_fault_in_the_thread_is_raised_at_the_end_of_the_block(dozen: pw.Layout) -> None:
    class Broken(Command):
        kind: str = "broken"

        def applied(self, document: Document, library: Library) -> Document:
            raise RuntimeError("broken")

    with pytest.raises(RuntimeError, match="broken"), Owner(Session(Document.of(dozen))) as owner:
        owner.post(Broken())
    assert not any(thread.name == "session" for thread in threading.enumerate())


def test_leaps_are_posted_as_commands_are(dozen: pw.Layout) -> None:
    session = Session(Document.of(dozen))
    with Owner(session) as owner:
        for step in (Rename(item=0, name="a"), Rename(item=0, name="b"), Leap.UNDO):
            assert owner.post(step)
        assert owner.post(Leap.UNDO)
        assert owner.post(Leap.REDO)
        # Where there is nothing more to go to, nothing happens.
        for _ in range(3):
            assert owner.post(Leap.REDO)
    assert owner.frame.document.items[0].name == "b"

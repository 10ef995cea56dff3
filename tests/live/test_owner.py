"""The thread that owns a session: bounded, in order, the last state wins."""

from __future__ import annotations

import io
import threading
import time
from itertools import pairwise

import pytest

import packwork as pw
from packwork.live import owner as module
from packwork.live.commands.command import Command, Library
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.items import Remove, Rename
from packwork.live.commands.placing import Move
from packwork.live.commands.together import Together
from packwork.live.document import Document
from packwork.live.log import Log, read_entries
from packwork.live.owner import Leap, Owner
from packwork.live.session import Session


def test_a_sender_that_is_faster_sees_a_bounded_queue_and_the_last_state(
    dozen: pw.Layout,
) -> None:
    with Owner(Session(Document.from_layout(dozen))) as owner:
        owner.post(Grab(items=(0,)))
        most = 0
        for step in range(3_000):
            assert owner.post(Move(item=0, x=250 + step / 60, y=300.0))
            most = max(most, owner.waiting)
        owner.post(Drop())
    assert most <= 2
    assert owner.frame.document.poses.x[0] == pytest.approx(250 + 2_999 / 60)
    assert owner.frame.in_the_way == ()


def test_between_frames_of_a_drag_the_thread_waits_for_what_comes(
    dozen: pw.Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    done, wait, flow = list[str](), threading.Condition.wait, Session.flow

    def waited(condition: threading.Condition, timeout: float | None = None) -> bool:
        if threading.current_thread().name == "session":
            done.append("wait")
        return wait(condition, timeout)

    def flowed(session: Session, milliseconds: float) -> int:
        done.append("flow")
        # Two epochs of many, so that it goes on.
        return flow(session, epochs=2)

    monkeypatch.setattr(threading.Condition, "wait", waited)
    monkeypatch.setattr(Session, "flow", flowed)
    owner = Owner(Session(Document.from_layout(dozen)))
    owner.post(Grab(items=(0,)))
    owner.post(Move(item=0, x=300.0, y=300.0))
    with owner:
        while done.count("flow") < 8:
            time.sleep(0.005)
        held = done[:]
    flows = [k for k, what in enumerate(held) if what == "flow"]
    assert all("wait" in held[k:n] for k, n in pairwise(flows))


def test_more_than_wait_are_not_taken(dozen: pw.Layout, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_WAITING", 5)
    owner = Owner(Session(Document.from_layout(dozen)))
    taken = [owner.post(Rename(item=0, name=f"n{k}")) for k in range(9)]
    assert taken == [True] * 5 + [False] * 4
    with owner:
        pass
    assert owner.frame.document.items[0].name == "n4"


def test_what_has_no_meaning_is_told_with_a_frame_and_the_rest_is_done(dozen: pw.Layout) -> None:
    with Owner(Session(Document.from_layout(dozen))) as owner:
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


def test_a_full_disk_is_told_and_nothing_that_is_done_meanwhile_is_lost(dozen: pw.Layout) -> None:
    class Stream(io.StringIO):
        is_full = True

        def write(self, text: str, /) -> int:
            if self.is_full:
                raise pw.WriteError("a.log", "is full")
            return super().write(text)

    disk = Stream()
    session = Session(Document.from_layout(dozen), log=Log(disk))
    owner = Owner(session, lambda: told.extend(owner.frame.refused), polishes=True)
    told = list[str]()
    with owner:
        owner.post(Move(item=0, x=300.0, y=300.0))
        for _ in range(2_000):
            if told and owner.frame.in_the_way == ():
                break
            time.sleep(0.005)
        disk.is_full = False
        owner.post(Move(item=1, x=200.0, y=200.0))
    assert told == ["a.log: is full"]
    session.log.flush()
    entries = read_entries(iter(disk.getvalue().splitlines()), "log")
    again = Session.replay(Document.from_layout(dozen), entries)
    assert (again.document.poses.x == session.document.poses.x).all()


def test_a_fault_in_the_thread_is_raised_at_the_end_of_the_block(dozen: pw.Layout) -> None:
    class Broken(Command):
        kind: str = "broken"

        def applied(self, document: Document, library: Library) -> Document:
            raise RuntimeError("broken")

    with (
        pytest.raises(RuntimeError, match="broken"),
        Owner(Session(Document.from_layout(dozen))) as owner,
    ):
        owner.post(Broken())
    assert not any(thread.name == "session" for thread in threading.enumerate())


def test_leaps_are_posted_as_commands_are(dozen: pw.Layout) -> None:
    session = Session(Document.from_layout(dozen))
    with Owner(session) as owner:
        for step in (Rename(item=0, name="a"), Rename(item=0, name="b"), Leap.UNDO):
            assert owner.post(step)
        assert owner.post(Leap.UNDO)
        assert owner.post(Leap.REDO)
        # Where there is nothing more to go to, nothing happens.
        for _ in range(3):
            assert owner.post(Leap.REDO)
    assert owner.frame.document.items[0].name == "b"


def test_a_settle_gives_way_to_what_is_posted_and_is_as_if_never_begun(dozen: pw.Layout) -> None:
    session = Session(Document.from_layout(dozen))
    session.apply(Move(item=0, x=300.0, y=300.0))
    before, touched = session.document, set(session.marks.touched)
    asked = iter(range(1_000))
    assert session.settle_unless(lambda: next(asked) > 3) is None
    assert session.document is before
    assert session.marks.touched == touched
    found = session.settle_unless(lambda: False)
    assert found is not None
    assert found.certified


def test_calls_are_made_in_their_turn_and_answered(dozen: pw.Layout) -> None:
    def fail(session: Session) -> None:
        raise RuntimeError("of the caller")

    with Owner(Session(Document.from_layout(dozen))) as owner:
        owner.post(Rename(item=0, name="first"))
        name = owner.call(lambda session: session.document.items[0].name)
        failed = owner.call(fail)
        assert name.result(10) == "first"
        with pytest.raises(RuntimeError, match="of the caller"):
            failed.result(10)
        owner.post(Rename(item=0, name="second"))
    assert owner.frame.document.items[0].name == "second"
    assert owner.frame.done == owner.posted == 4
    assert owner.frame.can_undo
    assert not owner.frame.can_redo
    with pytest.raises(pw.PackworkError, match="too much is waiting"):
        owner.call(lambda session: None).result(1)


def test_moves_of_the_same_items_together_replace_each_other(dozen: pw.Layout) -> None:
    def both(x: float) -> Together:
        return Together(commands=(Move(item=0, x=x, y=200.0), Move(item=1, x=x + 90, y=200.0)))

    owner = Owner(Session(Document.from_layout(dozen)))
    assert all(owner.post(both(200.0 + step)) for step in range(600))
    assert owner.waiting == 1
    with owner:
        pass
    assert owner.frame.document.poses.x[0] == pytest.approx(799.0, abs=400)


def test_whoever_listens_is_told_of_every_frame(dozen: pw.Layout) -> None:
    told: list[int] = []
    owner = Owner(
        Session(Document.from_layout(dozen)), lambda: told.append(owner.frame.number), polishes=True
    )
    with owner:
        owner.post(Move(item=0, x=300.0, y=300.0))
    assert told == list(range(1, owner.frame.number + 1))
    assert owner.frame.entangled == ()


def test_a_frame_tells_that_gaps_are_being_closed_until_they_are(dozen: pw.Layout) -> None:
    told: list[tuple[bool, tuple[str, ...] | None]] = []
    session = Session(Document.from_layout(dozen))
    owner = Owner(
        session, lambda: told.append((owner.frame.is_rough, owner.frame.in_the_way)), polishes=True
    )
    with owner:
        owner.post(Move(item=0, x=300.0, y=300.0))
        while not told or told[-1] != (False, ()):
            time.sleep(0.02)
    assert all(in_the_way == () for is_rough, in_the_way in told if is_rough)
    assert (True, ()) in told
    assert session.document.poses.x[0] == 300.0


def test_what_was_not_settled_when_it_was_left_is_settled(dozen: pw.Layout) -> None:
    session = Session(Document.from_layout(dozen))
    session.apply(Move(item=0, x=300.0, y=300.0))
    with Owner(session) as owner:
        pass
    assert owner.frame.in_the_way == ()
    assert not session.marks.touched


def test_whoever_has_an_answer_sees_what_the_call_has_changed(dozen: pw.Layout) -> None:
    def remove(session: Session) -> None:
        session.apply(Remove(items=(0,)))

    with Owner(Session(Document.from_layout(dozen))) as owner:
        owner.call(remove).result(10)
        seen = owner.frame
    assert len(seen.document) == 11
    assert seen.in_the_way is None


def test_what_was_broken_off_is_done_again_byte_for_byte(dozen: pw.Layout) -> None:
    stream = io.StringIO()
    session = Session(Document.from_layout(dozen), log=Log(stream))
    with Owner(session, polishes=True) as owner:
        for step in range(12):
            x, wait = 200.0 + 9 * step, 0.02 * (step % 4)
            assert owner.post(Move(item=step % 3, x=x, y=300.0))
            time.sleep(wait)
        for leap in (Leap.UNDO, Leap.REDO, Leap.UNDO):
            assert owner.post(leap)
            time.sleep(0.1)
    # As when a hand comes in the middle of a settle, and of a polish.
    session.apply(Move(item=4, x=250.0, y=250.0))
    session.flow(epochs=20)
    for asked in (2, 5, 9):
        counted = iter(range(1_000))
        assert session.settle_unless(lambda: next(counted) > asked) is None  # noqa: B023
    session.settle()
    assert session.polish(8, lambda: True) == 0
    session.polish(8)
    session.log.flush()
    assert stream.getvalue().count("broken_off") >= 3
    entries = read_entries(iter(stream.getvalue().splitlines(keepends=True)), "log")
    again = Session.replay(Document.from_layout(dozen), entries)
    for column in ("x", "y", "angle", "scale"):
        made, remade = (getattr(one.document.poses, column) for one in (session, again))
        assert (made == remade).all()
    assert again.marks == session.marks

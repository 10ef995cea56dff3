"""A session: one document under the hand, and all that follows it."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from dataclasses import asdict, replace
from itertools import groupby, pairwise
from numbers import Integral

from packwork.errors import RecipeError
from packwork.live.certificate import Certificate, Settlement, promise_of
from packwork.live.change import Change, Stale, differing
from packwork.live.commands.command import Command, Library
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.placing import Scale
from packwork.live.document import PROPERTIES, Document
from packwork.live.following import Following, beyond
from packwork.live.history import UndoHistory
from packwork.live.kept import Kept
from packwork.live.log import MOST_TRIALS, Entry, Log
from packwork.live.neighbourhood.flow import Flow
from packwork.live.neighbourhood.settle import made_smaller, polish, sizes_are_common
from packwork.live.neighbourhood.shapes import ShapeCache
from packwork.live.refilling import advice_of, is_other_cloud, refilled, taken_back
from packwork.live.requests import Requests
from packwork.progress import Stop, never
from packwork.scene.layout import Layout

ENOUGH = 6
"""Turns for each item that gestures have touched after which no more are tried. Chosen."""

AT_ONCE = 2
"""Epochs between two looks at the clock. Chosen."""

OF_PLACES = ("metrics", "certified", "changed", "filling", "beside", "pile")
"""What a manifest says of poses that are no more."""


class Session(Following):
    """A layout that is changed by commands, flows, and settles into an exact one.

    One thread owns a session. The same calls on the same document give the same bytes.

    Examples
    --------
    >>> import packwork as pw
    >>> from packwork.live.commands.placing import Move
    >>> layout = pw.fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> session = Session(Document.of(layout))
    >>> change = session.apply(Move(item=0, x=300.0, y=300.0))
    >>> session.settle().certified, session.document.poses.x[0]
    (True, np.float64(300.0))
    >>> session.undo(), session.undo()
    (True, False)
    >>> bool((session.document.poses.x == layout.poses.x).all())
    True
    """

    def __init__(
        self,
        document: Document,
        library: Library | None = None,
        log: Log | None = None,
        *,
        record: bool = False,
    ) -> None:
        super().__init__(document, record=record)
        self.library = library or Library()
        self.log = log or Log()
        self.history = UndoHistory()
        self._before: Document | None = None
        self._poured: tuple[str, ...] = ()
        self._requests = Requests()

    @property
    def is_grabbed(self) -> bool:
        """Whether something is held by the hand."""
        return bool(self._grabbed)

    def apply(self, command: Command) -> Change:
        """Do what a command says.

        Raises
        ------
        RecipeError
            If it has no meaning here; nothing is changed then.
        """
        if isinstance(command, Grab) and self._grabbed:
            raise RecipeError("grab", "something is held already; drop it first")
        before = self._document
        documents = [before]
        # What follows a change takes as long for one item as for all that change alike.
        for _, steps in groupby(command.steps, type):
            documents.append(documents[-1])
            for step in steps:
                documents[-1] = step.applied(documents[-1], self.library)
        change = Change.between(before, documents[-1])
        self.log.bring(command.assets, self.library)
        self.log.note("do", command)
        self._requests.note(command.steps, before, documents[-1])
        self._keep_angles(step.item for step in command.steps if isinstance(step, Scale))
        for one, other in pairwise(documents):
            self._take(Change.between(one, other), one, other)
        if isinstance(command, Grab):
            self._flow = self._flow or Flow(before, self._sights)
            self._grabbed, self._before = command.items, before
            self._hold()
        elif isinstance(command, Drop):
            self._drop()
        elif not self._grabbed and change.stale > Stale.NOTHING:
            self.history.note(before)
            self.log.flush()
        return change

    def flow(self, epochs: int | None = None, milliseconds: float | None = None) -> int:
        """Let items make room: so many epochs, or as many as the time allows; how many they were.

        Nothing moves but what a gesture has reached.

        Raises
        ------
        RecipeError
            If neither is given, or what is given is no number of them.
        """
        if epochs is None and milliseconds is None:
            raise RecipeError("flow", "give epochs or milliseconds")
        if epochs is not None and (not isinstance(epochs, Integral) or epochs < 0):
            raise RecipeError("flow", f"epochs must be a whole number from 0, not {epochs!r}")
        if milliseconds is not None and not 0 <= milliseconds < math.inf:
            raise RecipeError("flow", f"milliseconds must be 0 or more, not {milliseconds!r}")
        until = None if milliseconds is None else time.perf_counter() + milliseconds / 1e3
        done = 0
        while not self.is_at_rest and (epochs is None or done < epochs):
            count = AT_ONCE if epochs is None else min(AT_ONCE, epochs - done)
            self._run(count)
            done += count
            if until is not None and time.perf_counter() >= until:
                break
        return done

    def settle(self) -> Settlement:
        """Finish what was touched exactly, and certify the whole.

        Raises
        ------
        RecipeError
            If something is grabbed.
        """
        found = self._finish(never)
        self._settled()
        return found

    def settle_unless(self, stop: Stop) -> Settlement | None:
        """Settle, or, where ``stop`` comes true meanwhile, leave all as it was: None then.

        For sessions that somebody works on: what is asked for next need not wait.

        Raises
        ------
        RecipeError
            If something is grabbed.
        """
        before, marks = self._document, self.marks.copy()
        found = self._finish(stop)
        if not stop():
            self._settled()
            return found
        self._document, self.marks = before, marks
        self.log.note("broken_off")
        self._begin_anew()
        return None

    def _finish(self, stop: Stop) -> Settlement:
        """Finish what was touched, and certify the whole."""
        if self._grabbed:
            raise RecipeError("settle", "something is held by the hand; drop it first")
        before = self._document
        near = self._put_back()
        wrong = self.violations
        # What is in conflict is touched, whenever that came about.
        self.marks.touched |= beyond(wrong, near)
        if self.marks.touched and not stop():
            flow = self._flow = self._flow or Flow(self._document, self._sights)
            self._poured = ()
            self._fill_again(flow, near, len(wrong), stop)
        moved = differing(before.poses, self._document.poses)
        self.marks.rough |= set(self._document.ids[moved].tolist())
        return Settlement(self.is_certified, self.in_the_way, int(moved.sum()))

    def _fill_again(self, flow: Flow, near: set[int], wrong: int, stop: Stop) -> None:
        """Finish what was touched near where it is; else pour all anew, or make all smaller.

        A gesture that would ruin the rest is taken back.
        """
        self._bring_inside()
        asked = self._document
        if not (is_other_cloud(self._base, asked) and self._refill(asked, stop)):
            strict = self._make_room(flow, near)
            is_clean = self._settle(flow, strict, stop)
            if not self._refill(asked, stop):
                if not is_clean and sizes_are_common(strict):
                    smaller = made_smaller(strict, self.shapes, stop).document
                    self._turn_to(self._document.with_poses(smaller.poses))
                if len(self.violations) > wrong:
                    # Nothing is better than something worse.
                    self._turn_to(asked)
        if (back := taken_back(self._base, self._document)) is not None:
            self._poured = (back.said,)
            self._turn_to(back.document)

    def _refill(self, asked: Document, stop: Stop) -> bool:
        """Pour a cloud anew that a gesture, new words or weights have left emptier; if it was."""
        by_hand = self._rows(self.marks.given | self.marks.turned)
        found = None if stop() else refilled(self._base, asked, self._document, by_hand, stop)
        if found is not None:
            self._poured = (found.said,)
            self._turn_to(found.document)
        return found is not None

    @property
    def advice(self) -> tuple[str, ...]:
        """Advice on the layout as it lies: what is poor and would do; news of words poured anew."""
        return (*self._poured, *advice_of(self._document))

    def _settled(self) -> None:
        """Note that all that was touched is finished."""
        self._base = self._document
        self.marks.settled()
        self.log.note("settle")
        self._film()
        self.log.flush()

    def polish(self, trials: int, stop: Stop = never) -> int:
        """Win back coverage where gestures have cost some; the number of items that have moved.

        By at most so many trials, 10,000 in one call, of 2 ms each, of turns of the items there.
        None while something is grabbed or not settled, or once ``stop`` is true, which leaves all
        as it was. The layout is as certified after it as before.
        """
        if trials < 1 or self._grabbed or self.marks.touched or not self.marks.rough:
            return 0
        trials = min(trials, MOST_TRIALS)
        before = self._document
        # What was put somewhere last stays there; what was before keeps its angle.
        rows = self._rows(self.marks.rough - self.marks.lately)
        held = before.held.copy()
        held[self._rows(self.marks.by_hand), PROPERTIES.index("angle")] = True
        strict = replace(before, held=held)
        done = polish(strict, rows, trials, self.marks.polished + 1, self.shapes, stop)
        if stop():
            return 0
        self.log.note("polish", trials)
        self.marks.polished += 1
        if done.is_clean:
            self._document = self._base = before.with_poses(done.document.poses)
        self._turn_to(self._document)
        self.marks.tried += trials
        if self.marks.tried >= ENOUGH * len(rows):
            self.marks.rough, self.marks.tried = set(), 0
        self._film()
        self.log.flush()
        return int(differing(before.poses, self._document.poses).sum())

    def undo(self) -> bool:
        """Go back to the document before the last gesture, exactly; the flow pauses.

        Returns
        -------
        bool
            Whether there was one; nothing changes where there was none.
        """
        return self._leap("undo")

    def redo(self) -> bool:
        """Go forward again; whether there was anything to go forward to."""
        return self._leap("redo")

    @property
    def unmet(self) -> tuple[str, ...]:
        """Places and sizes that items were given and have not got, a sentence each."""
        return self._requests.unmet(self._document)

    @property
    def layout(self) -> Layout:
        """The layout as it is now, and whether it is certified."""
        kept = {k: v for k, v in self._document.manifest.items() if k not in OF_PLACES}
        said = {"promised": asdict(promise_of(self._document)), "certified": self.is_certified}
        track = None if self._frames is None else self._frames.track
        # What was asked of the run is not what holds now.
        manifest = {**kept, **said, "edited": self._document.options.model_dump()}
        return replace(self._document.layout, manifest=manifest, track=track)

    @classmethod
    def replay(
        cls, document: Document, entries: Iterable[Entry], library: Library | None = None
    ) -> Session:
        """A session in which all entries of a log are done again."""
        session = cls(document, library)
        session.repeat(entries)
        return session

    def repeat(self, entries: Iterable[Entry]) -> int:
        """Do all entries of a log again; how many gestures that were.

        Raises
        ------
        RecipeError
            If one has no meaning here.
        """
        gestures = 0
        for kind, value in entries:
            if kind in {"item", "container"}:
                name, found = value
                getattr(self.library, f"{kind}s")[name] = found
            elif kind == "do":
                gestures += not self._grabbed
                self.apply(value)
            elif kind == "flow":
                self._run(value[1], value[0])
            elif kind == "settle":
                self.settle()
            elif kind == "polish":
                self.polish(value)
            elif kind == "kept":
                self.kept()
            elif kind == "broken_off":
                self._begin_anew()
            else:
                self._leap(kind)
        return gestures

    def kept(self) -> Kept:
        """Contents of the session's file; it then goes on as one that was opened does.

        Raises
        ------
        RecipeError
            If something is grabbed.
        """
        if self._grabbed:
            raise RecipeError("save", "something is held by the hand; drop it first")
        self.log.note("kept")
        found = Kept(self._document, self._base, self.history, self.marks)
        self.go_on_from(found)
        return found

    def go_on_from(self, kept: Kept) -> None:
        """Take over what a file holds, nothing else: so that the same follows wherever it is."""
        self._document, self._base = kept.document, kept.base
        self.history, self.marks = kept.history, kept.marks
        self.shapes, self._certificate = ShapeCache(), Certificate()
        self._grabbed, self._before, self._flow = (), None, None
        self._requests.forget()
        if self.marks.touched:
            self._begin_anew()
            self._flow_again()

    def _run(self, epochs: int, resolution: int | None = None) -> None:
        """Run epochs, and note it."""
        if self._flow is None:
            return
        resolution = resolution or self._flow.resolution
        self._flow.run(epochs, resolution)
        self.log.note("flow", (resolution, epochs))
        self._follow(self._flow)

    def _drop(self) -> None:
        before, self._before = self._before, None
        if before is not None and self._document is not before:
            self.history.note(before)
        self._grabbed = ()
        self._hold()
        self.log.flush()

    def _leap(self, kind: str) -> bool:
        if self._grabbed:
            raise RecipeError(kind, "something is held by the hand; drop it first")
        if not getattr(self.history, f"can_{kind}"):
            return False
        document = getattr(self.history, kind)(self._document)
        self.log.note(kind)
        self._base = document
        self._turn_to(document)
        self.marks.leapt()
        self._requests.forget()
        self._film()
        self.log.flush()
        return True

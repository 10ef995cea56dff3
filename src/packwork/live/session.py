"""A session: one document under the hand, and all that follows it."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import asdict, replace
from itertools import pairwise

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.live.certificate import Certificate, Settlement, promise_of
from packwork.live.change import Change, Stale, differing
from packwork.live.commands.command import Command, Library
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.document import PROPERTIES, Document
from packwork.live.frames import Frames
from packwork.live.history import History
from packwork.live.kept import Kept
from packwork.live.log import Entry, Log
from packwork.live.marks import Marks
from packwork.live.neighbourhood.flow import Flow
from packwork.live.neighbourhood.settle import polish, settle
from packwork.live.neighbourhood.shapes import Shapes
from packwork.metrics.violations import Violation
from packwork.progress import Stop, never
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses

NEAR = 2
"""Rings about what was touched that stay where they have flowed; all others go back to where they
were. More lose more coverage, fewer leave less room for what was dropped. Tried."""

LEFT = 3
"""The same about where something was taken from: these grow into the room. Tried."""

RELAX = 60
"""Epochs before a settle: what lies under what was dropped has to get out of its way first. More
take longer, fewer leave more to be shrunk. Tried."""

ENOUGH = 6
"""Turns for each item that gestures have touched after which no more are tried. Chosen."""

AT_ONCE = 2
"""Epochs between two looks at the clock. Chosen."""

OF_PLACES = ("metrics", "certified", "filling", "beside", "pile")
"""What a manifest says of poses that are no more."""


class Session:
    """A layout that is changed by commands, flows, and settles into an exact one.

    One thread owns a session. The same calls on the same document give the same bytes.

    Parameters
    ----------
    document
        Where it begins.
    library
        Items and containers that commands may bring in.
    log
        Where all that is done is noted.
    record
        Whether the way of the items is kept, for films of the layout.

    Examples
    --------
    >>> import packwork as pw
    >>> from packwork.live.commands.placing import Move
    >>> layout = pw.fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> session = Session(Document.of(layout))
    >>> change = session.apply(Move(item=0, x=300.0, y=300.0))
    >>> session.settle().certified, session.document.poses.x[0]
    (True, np.float64(300.0))
    >>> session.undo()
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
        self.library = library or Library()
        self.log = log or Log()
        self.history = History()
        self._document = document
        self.shapes = Shapes()
        """Covers of the outlines."""
        self._base = document
        self._grabbed: tuple[int, ...] = ()
        self._before: Document | None = None
        self.marks = Marks()
        """What has been done to which items."""
        self._flow: Flow | None = None
        self._certificate = Certificate()
        self._frames = Frames(document) if record else None

    @property
    def document(self) -> Document:
        """What there is now."""
        return self._document

    @property
    def is_grabbed(self) -> bool:
        """Whether something is held by the hand."""
        return bool(self._grabbed)

    @property
    def is_at_rest(self) -> bool:
        """Whether the flow has nothing to move."""
        return self._flow is None or self._flow.is_at_rest

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
        for step in command.steps:
            documents.append(step.applied(documents[-1], self.library))
        change = Change.between(before, documents[-1])
        self.log.bring(command.assets, self.library)
        self.log.note("do", command)
        for one, other in pairwise(documents):
            self._take(Change.between(one, other), one, other)
        if isinstance(command, Grab):
            self._flow = self._flow or Flow(before)
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
            If neither is given.
        """
        if epochs is None and milliseconds is None:
            raise RecipeError("flow", "give epochs or milliseconds")
        until = None if milliseconds is None else time.perf_counter() + milliseconds / 1e3
        done = 0
        while not self.is_at_rest and (epochs is None or done < epochs):
            count = AT_ONCE if epochs is None else min(AT_ONCE, epochs - done)
            self._run(count)
            done += count
            if until is not None and time.perf_counter() >= until:
                break
        return done

    def settle(self, stop: Stop = never) -> Settlement:
        """Finish what was touched exactly, and certify the whole.

        Raises
        ------
        RecipeError
            If something is grabbed.
        """
        if self._grabbed:
            raise RecipeError("settle", "something is held by the hand; drop it first")
        before = self._document
        self.log.note("settle")
        near = self._put_back()
        wrong = self.violations
        # What is in conflict is touched, whenever that came about.
        self.marks.touched |= _beyond(wrong, near)
        if self.marks.touched:
            self._flow = self._flow or Flow(self._document)
            flowed = self._document
            self._settle(self._flow, near, stop)
            if len(self.violations) > len(wrong):
                # Nothing is better than something worse.
                self._document = flowed
                self._flow.turn_to(flowed)
        self._base = self._document
        self.marks.settled()
        moved = differing(before.poses, self._document.poses)
        self.marks.rough |= set(self._document.ids[moved].tolist())
        self._film()
        self.log.flush()
        return Settlement(self.is_certified, self.in_the_way, int(moved.sum()))

    def _put_back(self) -> set[int]:
        """Put back what flowed and lies far from what was touched; numbers of what is near.

        It lay well before, and where the hand only passed by, it does so again.
        """
        flow, base, now = self._flow, self._base, self._document
        if flow is None:
            return set()
        flow.review()
        near = flow.touching.rings(self._rows(self.marks.touched), NEAR) >= 0
        near[self._rows(self.marks.left)] = True
        _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
        back = ~near[rows] & differing(now.poses.some(rows), base.poses.some(theirs))
        rows, theirs = rows[back], theirs[back]
        flow.put_back(rows, now.poses.with_some(rows, base.poses.some(theirs)))
        self._follow(flow)
        return set(now.ids[near].tolist())

    def _settle(self, flow: Flow, near: set[int], stop: Stop) -> None:
        """Let what was touched make room, then finish it."""
        self.marks.given = self._fitting(self.marks.given)
        flow.bring_in(self._rows(self.marks.touched - self.marks.given))
        held = self._document.held.copy()
        held[self._rows(self.marks.turned), PROPERTIES.index("angle")] = True
        flow.rule(replace(self._document, held=held))
        flow.hold(self._rows(self.marks.given))
        flow.harden(RELAX, self._rows(near | self.marks.touched))
        self._follow(flow)
        touched = np.union1d(self._rows(self.marks.touched), np.flatnonzero(flow.moved))
        flow.review()
        strict = replace(self._document, held=held)
        given = self._rows(self.marks.given)
        done = settle(strict, touched.astype(np.int64), given, flow.touching, self.shapes, stop)
        self._document = self._document.with_poses(done.document.poses)
        flow.turn_to(self._document)

    def polish(self, trials: int, stop: Stop = never) -> int:
        """Win back coverage where gestures have cost some, by turns of the items there.

        For moments in which nobody touches anything: 2 ms a trial. Nothing is tried while something
        is grabbed or not settled. The layout is as certified after it as before.

        Parameters
        ----------
        trials
            How many at most.
        stop
            Asked before each batch; True ends with what there is.

        Returns
        -------
        int
            How many items have moved.
        """
        if trials < 1 or self._grabbed or self.marks.touched or not self.marks.rough:
            return 0
        before = self._document
        self.log.note("polish", trials)
        self.marks.polished += 1
        # What was put somewhere by hand stays as it was put.
        rows = self._rows(self.marks.rough - self.marks.by_hand)
        done = polish(before, rows, trials, self.marks.polished, self.shapes, stop)
        if done.is_clean:
            self._document = self._base = done.document
        if self._flow is not None:
            self._flow.turn_to(self._document)
        self.marks.tried += trials
        if self.marks.tried >= ENOUGH * len(rows):
            self.marks.rough, self.marks.tried = set(), 0
        self._film()
        self.log.flush()
        return int(differing(before.poses, self._document.poses).sum())

    def undo(self) -> None:
        """Go back to the document before the last gesture, exactly; the flow pauses."""
        self._leap("undo")

    def redo(self) -> None:
        """Go forward again."""
        self._leap("redo")

    @property
    def violations(self) -> tuple[Violation, ...]:
        """What is in conflict now, items by their numbers."""
        return self._certificate.violations(self._document)

    @property
    def is_certified(self) -> bool:
        """Whether exact geometry finds no overlap, nothing outside, and gaps as promised."""
        return len(self._document) > 0 and not self.in_the_way

    @property
    def in_the_way(self) -> tuple[str, ...]:
        """What keeps the layout from its certificate, a sentence each."""
        return self._certificate.in_the_way(self._document)

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
            else:
                self._leap(kind)
        return gestures

    def kept(self) -> Kept:
        """What a file holds of the session; it then goes on as one that was opened does.

        Raises
        ------
        RecipeError
            If something is grabbed.
        """
        if self._grabbed:
            raise RecipeError("save", "something is held by the hand; drop it first")
        found = Kept(self._document, self.history, self.marks)
        self.go_on_from(found)
        return found

    def go_on_from(self, kept: Kept) -> None:
        """Take over what a file holds, nothing else: so that the same follows wherever it is."""
        self._document, self.history, self.marks = kept.document, kept.history, kept.marks
        self.shapes, self._certificate = Shapes(), Certificate()
        self._grabbed, self._before, self._flow = (), None, None
        self._base = self._document
        if self.marks.touched:
            self._flow = Flow(self._document)
            self._flow.stir(self._rows(self.marks.touched))
            self._hold()

    def _run(self, epochs: int, resolution: int | None = None) -> None:
        """Run epochs, and note it."""
        if self._flow is None:
            return
        resolution = resolution or self._flow.resolution
        self._flow.run(epochs, resolution)
        self.log.note("flow", (resolution, epochs))
        self._follow(self._flow)

    def _follow(self, flow: Flow) -> None:
        """Take over where the flow has brought the items."""
        self._document = self._document.with_poses(flow.poses)
        self._film()

    def _film(self) -> None:
        if self._frames is not None:
            self._frames.keep(self._document)

    def _take(self, change: Change, before: Document, after: Document) -> None:
        """Bring the flow to a changed document."""
        self._document = after
        if change.stale == Stale.NOTHING:
            return
        flow = self._flow = self._flow or Flow(before)
        if change.stale <= Stale.RULES:
            flow.rule(after)
            return
        if change.stale == Stale.POSES:
            self._give(flow, before.poses, after)
            return
        gone = np.array([k for k in change.items if before.index(k) is not None], dtype=np.int64)
        beside: set[int] = set()
        if len(gone) and change.stale == Stale.ITEMS:
            rows = np.array([before.index(int(k)) for k in gone], dtype=np.int64)
            beside = set(before.ids[flow.touching.beside(rows)].tolist())
        flow.turn_to(after)
        present = set(after.ids.tolist())
        self.marks.given &= present
        self.marks.touched = (self.marks.touched | beside | set(change.items.tolist())) & present
        flow.stir(self._rows(self.marks.touched))
        self._hold()
        self._film()

    def _give(self, flow: Flow, before: Poses, after: Document) -> None:
        """Note which items the hand has moved or turned; others make room for all it changed."""
        now, numbers = after.poses, after.ids
        moved = (now.x != before.x) | (now.y != before.y)
        turned, changed = now.angle != before.angle, differing(before, now)
        self.marks.given |= set(numbers[moved].tolist())
        self.marks.turned |= set(numbers[turned].tolist())
        self.marks.by_hand |= set(numbers[moved | turned].tolist())
        new = np.flatnonzero(changed & ~np.isin(numbers, list(self.marks.touched)))
        if len(new):
            self.marks.left |= set(numbers[flow.touching.rings(new, LEFT) >= 0].tolist())
        self.marks.touched |= set(numbers[changed].tolist())
        flow.rule(after)
        kept = self.marks.given | set(numbers[changed].tolist()) | set(self._grabbed)
        flow.give(self._rows(kept), now)

    def _drop(self) -> None:
        before, self._before = self._before, None
        if before is not None and self._document is not before:
            self.history.note(before)
        self._grabbed = ()
        self._hold()
        self.log.flush()

    def _hold(self) -> None:
        """Have the flow hold what lies where the hand has put it, or is in the hand."""
        if self._flow is not None:
            self._flow.hold(self._rows(self.marks.given | set(self._grabbed)))

    def _leap(self, kind: str) -> None:
        if self._grabbed:
            raise RecipeError(kind, "something is held by the hand; drop it first")
        document = getattr(self.history, kind)(self._document)
        self.log.note(kind)
        self._document = self._base = document
        self.marks.leapt()
        if self._flow is not None:
            self._flow.turn_to(document)
        self._film()
        self.log.flush()

    def _rows(self, numbers: set[int]) -> IntArray:
        return np.flatnonzero(np.isin(self._document.ids, list(numbers)))

    def _fitting(self, numbers: set[int]) -> set[int]:
        """Those items that can stay where they are: in the container, and clear of what is held."""
        document = self._document
        fixed = set(document.ids[document.held[:, 0]].tolist()) | numbers
        bad = set()
        for one in self._certificate.violations(document):
            if one.other is None or {one.item, one.other} <= fixed:
                bad |= {one.item, one.other} & numbers
        return numbers - bad


def _beyond(wrong: Iterable[Violation], near: set[int]) -> set[int]:
    """Numbers of items in conflicts that what is near has no part in."""
    found: set[int] = set()
    for one in wrong:
        pair = {one.item} if one.other is None else {one.item, one.other}
        if not pair & near:
            found |= pair
    return found

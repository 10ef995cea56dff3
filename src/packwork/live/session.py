"""A session: one document under the hand, a log of what is done to it, and all that follows it."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, replace
from itertools import groupby
from numbers import Integral
from typing import Any, Self, cast

from packwork.errors import RecipeError
from packwork.live.certificate import Requests, Settlement, promise_of
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.gestures import Cancel, Drop, Grab
from packwork.live.commands.look import with_halos
from packwork.live.commands.together import KINDS, Together, check_places
from packwork.live.document import Change, Document, Invalidation
from packwork.live.history import Marks, SessionState, UndoHistory
from packwork.live.local_solver import LocalSolver
from packwork.live.log import MOST_TRIALS, Entry, Log
from packwork.live.names import Which, find_items, one_item
from packwork.live.neighbourhood.caches import ShapeCache
from packwork.live.refilling import advice_of
from packwork.metrics.violations import Violation
from packwork.progress import Stop, never
from packwork.scene.layout import Layout

AT_ONCE = 2
"""Epochs between two looks at the clock. Chosen."""

TRIALS, MOST_TURNS = 96, 2_000
"""Turns tried at once when a block ends, and in all, unless more items have moved. Chosen."""

OF_PLACES = ("metrics", "certified", "changed", "filling", "beside", "pile")
"""What a manifest says of poses that are no more."""


class Session:
    """A layout that is changed by commands, flows, and settles into an exact one.

    One thread owns a session. The same calls on the same document give the same bytes.

    Examples
    --------
    >>> import packwork as pw
    >>> from packwork.live.commands.placing import Move
    >>> layout = pw.fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> session = Session(Document.from_layout(layout))
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
        self.library = library or Library()
        self.log = log or Log()
        self.history = UndoHistory()
        self.letters: Mapping[str, Any] = {}
        """How words were asked to be set, last."""
        self._solver = LocalSolver(document, record=record)
        self.requests = Requests()
        """Notes of what was asked for."""
        self._before_grab: tuple[Document, Marks, Requests] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is None:
            self.finish()

    @property
    def document(self) -> Document:
        """Document as it is now."""
        return self._solver.document

    @property
    def marks(self) -> Marks:
        """Marks of the items that gestures have done something to."""
        return self._solver.marks

    @property
    def shapes(self) -> ShapeCache:
        """Covers of the outlines."""
        return self._solver.shapes

    @property
    def is_grabbed(self) -> bool:
        """Whether something is held by the hand."""
        return bool(self._solver.grabbed)

    @property
    def is_at_rest(self) -> bool:
        """Whether the flow has nothing to move."""
        return self._solver.is_at_rest

    @property
    def is_rough(self) -> bool:
        """Whether :meth:`polish` may win back coverage."""
        return self._solver.is_rough

    @property
    def violations(self) -> tuple[Violation, ...]:
        """Conflicts as of now, items by their numbers."""
        return self._solver.violations

    @property
    def is_certified(self) -> bool:
        """Whether exact geometry finds no overlap, nothing outside, and gaps as promised."""
        return self._solver.is_certified

    @property
    def in_the_way(self) -> tuple[str, ...]:
        """Reasons that keep the layout from its certificate, a sentence each."""
        return self._solver.in_the_way

    @property
    def unmet(self) -> tuple[str, ...]:
        """Places and sizes that items were given and have not got, a sentence each."""
        return tuple(self.requests.unmet(self.document).values())

    @property
    def advice(self) -> tuple[str, ...]:
        """Advice on the layout as it lies: what is poor and would do; news of words poured anew."""
        return (*self._solver.news, *advice_of(self.document))

    @property
    def canvas(self) -> str:
        """Longer side of the canvas as options say it."""
        return f"{self.document.container.side:.17g}{self.document.container.unit}"

    @property
    def layout(self) -> Layout:
        """The layout as it is now, and whether it is certified."""
        document, layout = self.document, self.document.layout
        kept = {k: v for k, v in layout.manifest.items() if k not in OF_PLACES}
        stated = {"promised": asdict(promise_of(document)), "certified": self.is_certified}
        manifest = {**kept, **stated, "edited": document.options.model_dump()}
        return replace(layout, manifest=manifest, track=self._solver.track)

    def find(self, which: Which) -> tuple[int, ...]:
        """Numbers of the items that a name means, in their order; :meth:`positions` are others.

        Raises
        ------
        RecipeError
            If there is none.
        """
        return find_items(self.document, which)

    def positions(self, which: Which) -> list[int]:
        """Places of items in :attr:`layout`, for such as ``layout.poses.x[positions]``.

        Numbers that :meth:`find` gives are for ever; positions are others once items are removed.

        Raises
        ------
        RecipeError
            If there is no such item.
        """
        rows = {int(number): k for k, number in enumerate(self.document.ids)}
        return [rows[number] for number in self.find(which)]

    def one(self, which: Which) -> int:
        """Number of the one item that a name means.

        Raises
        ------
        RecipeError
            If there is none, or more than one.
        """
        return one_item(self.document, which)

    def apply(self, command: Command) -> Change:
        """Do what a command says.

        Raises
        ------
        RecipeError
            If it has no meaning here; nothing is changed then.
        """
        check_places(command, self.document.kind)
        return self._apply(command)

    def _apply(self, command: Command) -> Change:
        if isinstance(command, Grab) and self.is_grabbed:
            raise RecipeError("grab", "something is held already; drop it first")
        before = self.document
        documents, placed = list[Document](), set[int]()
        # What follows a change takes as long for one item as for all that change alike.
        for _, steps in groupby(command.steps, type):
            earlier = now = documents[-1] if documents else before
            for step in steps:
                placed.update(step.places(now))
                now = step.applied(now, self.library)
            documents.append(with_halos(now, earlier))
        change = Change.between(before, documents[-1])
        self.log.bring(command.assets, self.library)
        self.log.note("do", command)
        self.requests.note(command.steps, before, documents[-1])
        documents[-1] = self.marks.note_hand(command.steps, before, documents[-1])
        for document in documents:
            self._solver.take(document)
        self._solver.place(placed & set(self.document.ids.tolist()))
        if isinstance(command, Grab):
            self._before_grab = before, self.marks.copy(), self.requests.copy()
            self._solver.grab(command.items)
        elif isinstance(command, Drop | Cancel):
            self._let_go(is_cancelled=isinstance(command, Cancel))
        elif not self.is_grabbed and change.stale > Invalidation.NOTHING:
            self.history.note(before)
            self.log.flush()
        return change

    def do(self, kind: str, **values: object) -> Change:
        """Do a command of a kind, of plain values; what has no meaning is refused by its name."""
        return self.apply(made(KINDS[kind], **values))

    def do_together(self, commands: Iterable[Command]) -> None:
        """Do commands as one gesture."""
        if listed := tuple(commands):
            self.apply(Together(commands=listed))  # type: ignore[arg-type]

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
        return cast(Settlement, self.settle_unless(never))

    def settle_unless(self, stop: Stop) -> Settlement | None:
        """Settle, or, where ``stop`` comes true meanwhile, leave all as it was: None then.

        For sessions that somebody works on: what is asked for next need not wait.
        """
        self._check_dropped("settle")
        before, marks, base = self.document, self.marks.copy(), self._solver.base
        found = self._solver.finish(stop)
        if not stop():
            self._settled(base)
            return found
        self._solver.restart(before, marks)
        self.log.note("broken_off")
        return None

    def polish(self, trials: int, stop: Stop = never) -> int:
        """Win back coverage where gestures have cost some; the number of items that have moved.

        By at most so many trials, 10,000 in one call, of 2 ms each, of turns of the items there;
        none unless :attr:`is_rough`, or once ``stop`` is true, which leaves all as it was.
        """
        if (moved := self._solver.polish(trials := min(trials, MOST_TRIALS), stop)) is None:
            return 0
        self.log.note("polish", trials)
        self.log.try_flush()
        return moved

    def finish(self) -> Settlement:
        """Settle, and win back coverage where something was touched; what it came to."""
        turns = max(TRIALS, (found := self.settle()).moved)
        for _ in range(0, max(MOST_TURNS, 4 * turns), turns):
            self.polish(turns)
        return Settlement(self.is_certified, self.in_the_way, found.moved)

    def undo(self) -> bool:
        """Go back to the document before the last gesture, exactly; whether there was one."""
        return self._leap("undo")

    def redo(self) -> bool:
        """Go forward again; whether there was anything to go forward to."""
        return self._leap("redo")

    def watch(self, on_fall: Callable[[Document], object]) -> None:
        """Have somebody told of items that fall, on their way."""
        self._solver.on_fall = on_fall

    def begin_film(self) -> None:
        """Keep the way of the items from now on."""
        self._solver.begin_film()

    def make_ready(self) -> None:
        """Do what takes long the first time before the hand comes; nothing changes."""
        self._solver.make_ready()

    @classmethod
    def replay(
        cls, document: Document, entries: Iterable[Entry], library: Library | None = None
    ) -> Self:
        """A session in which all entries of a log are done again."""
        session = cls(document, library)
        session.repeat(entries)
        return session

    def repeat(self, entries: Iterable[Entry]) -> int:
        """Do all entries of a log again; how many gestures that were."""
        gestures = 0
        for kind, value in entries:
            if kind in {"item", "container"}:
                getattr(self.library, f"{kind}s")[value[0]] = value[1]
            elif kind == "do":
                gestures += not self.is_grabbed
                self._apply(value)
            elif kind == "flow":
                self._run(value[1], value[0])
            elif kind == "polish":
                self.polish(value)
            elif kind == "broken_off":
                self._solver.begin_anew()
            else:
                getattr(self, kind)()  # settle, kept, undo, redo
        return gestures

    def kept(self) -> SessionState:
        """Contents of the session's file; it then goes on as one that was opened does."""
        self._check_dropped("save")
        self.log.note("kept")
        found = SessionState(self.document, self._solver.base, self.history, self.marks)
        self.go_on_from(found)
        return found

    def go_on_from(self, state: SessionState) -> None:
        """Take over what a file holds, nothing else: so that the same follows wherever it is."""
        self.history, self._before_grab = state.history, None
        self._solver.go_on_from(state)

    def _check_dropped(self, key: str) -> None:
        if self.is_grabbed:
            raise RecipeError(key, "something is held by the hand; drop it first")

    def _settled(self, before: Document) -> None:
        self._solver.settled()
        self.requests.settled(before, self.document, self.marks.recent)
        self.log.note("settle")
        self.log.try_flush()

    def _run(self, epochs: int, resolution: int | None = None) -> None:
        if (seen := self._solver.run(epochs, resolution)) is not None:
            self.log.note("flow", (seen, epochs))

    def _let_go(self, *, is_cancelled: bool) -> None:
        before, self._before_grab = self._before_grab, None
        self._solver.grab(())
        if before is not None and is_cancelled:
            document, marks, self.requests = before
            self._solver.restart(document, marks)
        elif before and self.document is not before[0]:
            self.history.note(before[0])
        self.log.flush()

    def _leap(self, kind: str) -> bool:
        self._check_dropped(kind)
        before, now = self.document, getattr(self.history, kind)(self.document)
        if now is not before:
            self.log.note(kind)
            self._solver.leap_to(now)
            self.requests.leapt(before, now)
            self.log.flush()
        return now is not before

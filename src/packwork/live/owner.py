"""The one thread that owns a session: others post commands to it and read its newest frame."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any, TypeAlias, TypeVar

from packwork import threads
from packwork.errors import PackworkError
from packwork.live.commands.command import Command
from packwork.live.commands.placing import Move, Turn
from packwork.live.commands.together import Together
from packwork.live.document import Document
from packwork.live.session import Session

Answer = TypeVar("Answer")

MOST_WAITING = 256
"""Commands that wait at most. Chosen."""

MOST_REFUSED = 16
"""Refusals that are kept for the next frame at most. Chosen."""

FRAME_MS = 3.0
"""Time for the flow between two frames. Longer moves more, shorter answers faster. Tried."""

PAUSE_SECONDS = 0.004
"""How long the thread waits for commands between two frames while something is in the hand: whoever
draws has the cores meanwhile, and what comes is done at once. Longer moves less. Tried."""

SPARED = 1
"""Cores that are left to whoever draws the frames. None, on two cores: neighbours are redrawn half
as late again, and twice as late in the worst of 20 cases. Tried."""

IDLE_SECONDS = 0.05
"""How long the thread waits for commands when nothing moves. Chosen."""


POLISHED_AT_ONCE = 48
"""Trials of one polish while nobody touches anything, which is lost if a command breaks it off.
Fewer spend more on the rounds that each begins with. Chosen."""


QUIET_SECONDS = 0.4
"""How long nobody has touched anything until coverage is won back. Shorter holds up the next of
several gestures, longer leaves gaps open for longer. Chosen."""


MOST_TRIES = 3
"""Settles in turn where one does not certify the whole. More take longer until what is in the way
is told. Chosen."""


MAKING_ROOM = "Making room"
"""Work of commands and leaps, and of what follows them."""


class Leap(Enum):
    """Request beside commands: a way through the history."""

    UNDO = "undo"
    REDO = "redo"


@dataclass(frozen=True, eq=False)
class _Call:
    """Function to call in the thread, and where its answer goes."""

    function: Callable[[Any], Any]
    answer: Future[Any]
    work: str = ""


Posted: TypeAlias = Command | Leap | _Call


@dataclass(frozen=True, eq=False)
class Frame:
    """Frame of a session: how it looks at a moment.

    Parameters
    ----------
    number
        How many frames there were before.
    in_the_way
        What keeps it from its certificate; None while something moves.
    refused
        Commands that had no meaning since the frame before, a sentence each.
    done
        How many of what was posted have been done, in :attr:`Owner.posted`'s count.
    entangled
        Numbers of the items that are in conflict, where ``in_the_way`` is known.
    advice
        What is poor, and what would do, where it is certified; as of the last change, not of turns
        by which coverage is won back.
    unmet
        Places and sizes that were asked for and not had, by the count of what was asked.
    is_rough
        Whether coverage that gestures have cost is about to be won back.
    """

    number: int
    document: Document
    in_the_way: tuple[str, ...] | None
    refused: tuple[str, ...] = ()
    done: int = 0
    entangled: tuple[int, ...] = ()
    can_undo: bool = False
    can_redo: bool = False
    advice: tuple[str, ...] = ()
    unmet: Mapping[int, str] = field(default_factory=dict)
    is_rough: bool = False


class Owner:
    """Runs a session in a thread of its own.

    Commands are done in their order. A move of an item that waits behind another move of the same
    item takes its place, so that a sender faster than the session never waits long; the newest
    frame overwrites the one before. Use it in a ``with`` block: its end waits for what was posted.

    Parameters
    ----------
    session
        Nobody else may touch it meanwhile.
    on_frame
        Called in the thread after each frame; must not take long.
    polishes
        Whether coverage is won back, turn by turn, while nobody touches anything.

    Examples
    --------
    >>> import packwork as pw
    >>> layout = pw.fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> with Owner(Session(Document.from_layout(layout))) as owner:
    ...     posted = [owner.post(Move(item=0, x=x, y=300.0)) for x in range(250, 301)]
    >>> all(posted), float(owner.frame.document.poses.x[0]), owner.frame.in_the_way
    (True, 300.0, ())
    """

    def __init__(
        self,
        session: Session,
        on_frame: Callable[[], object] = lambda: None,
        *,
        polishes: bool = False,
    ) -> None:
        self._session = session
        self._on_frame, self._polishes = on_frame, polishes
        self._waiting: deque[tuple[int, Posted]] = deque()
        self._changed = threading.Condition()
        self._is_over = False
        self._owed: deque[tuple[int, str]] = deque()
        self._refused: deque[str] = deque(maxlen=MOST_REFUSED)
        # A session that goes on after a crash may not have been settled.
        self._is_touched = bool(session.marks.touched) or not session.is_at_rest
        self._failure: Exception | None = None
        self._done = self._tries = 0
        self._advice = session.advice if session.in_the_way == () else ()
        self._asked_at = time.monotonic()
        self.posted = 0
        """How many commands, leaps and calls were taken."""
        self.frame = self._framed(0, session.in_the_way)
        """The newest; replaced as a whole, so that it may be read at any time."""
        session.watch(self._show_fall)
        self._thread = threading.Thread(target=self._run, name="session", daemon=True)

    def __enter__(self) -> Owner:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        with self._changed:
            self._is_over = True
            self._changed.notify()
        self._thread.join()
        if self._failure is not None:
            raise self._failure

    def post(self, command: Command | Leap) -> bool:
        """Have a command or a leap done; False if too many wait already, or it is over."""
        return self._take(command)

    def call(self, function: Callable[[Session], Answer], work: str = "") -> Future[Answer]:
        """Have a function of the session called in the thread, in its turn; what it answers.

        ``work``: name of a change that it makes; empty where it only looks. What it raises is
        raised by the future, also where too many wait or it is over.
        """
        answer: Future[Answer] = Future()
        if not self._take(_Call(function, answer, work)):
            answer.set_exception(PackworkError("too much is waiting to be done; try it again"))
        return answer

    @property
    def waiting(self) -> int:
        """Number of commands that wait."""
        return len(self._waiting)

    def work(self, frame: Frame) -> str:
        """Work that a frame does not show finished, in words; empty if there is none."""
        with self._changed:
            while self._owed and self._owed[0][0] <= frame.done:
                self._owed.popleft()
            owed = self._owed[0][1] if self._owed else ""
        return owed or (MAKING_ROOM if frame.in_the_way is None else "")

    @property
    def failure(self) -> Exception | None:
        """Exception that has ended the thread before its time; None while all is well."""
        return self._failure

    def _take(self, posted: Posted) -> bool:
        with self._changed:
            if self._is_over or self._failure is not None:
                return False
            if self._waiting and _replaces(posted, self._waiting[-1][1]):
                self._waiting.pop()
            elif len(self._waiting) >= MOST_WAITING:
                return False
            self.posted += 1
            if work := posted.work if isinstance(posted, _Call) else MAKING_ROOM:
                self._owed.append((self.posted, work))
            self._waiting.append((self.posted, posted))
            self._changed.notify()
        return True

    def _run(self) -> None:
        try:
            with threads.using(max(threads.available() - SPARED, 1)):
                while self._turn():
                    pass
        except Exception as error:  # noqa: BLE001
            # Told to whoever leaves the block: nobody else would hear of it.
            self._failure = error
            for _, posted in self._waiting:
                if isinstance(posted, _Call):
                    posted.answer.set_exception(error)
            self._on_frame()

    def _turn(self) -> bool:
        """Do what waits, flow, show; False when all is done and no more comes."""
        with self._changed:
            is_waiting = self._session.is_grabbed or not self._is_touched
            is_idle = self._session.is_at_rest and is_waiting
            is_idle &= not (self._is_polishing and self._is_quiet)
            if not self._waiting and is_idle and not self._is_over:
                self._changed.wait(IDLE_SECONDS)
            elif not self._waiting and self._session.is_grabbed and not self._is_over:
                self._changed.wait(PAUSE_SECONDS)
            taken = [self._waiting.popleft() for _ in range(len(self._waiting))]
            is_over = self._is_over
        if taken:
            self._tries, self._asked_at = 0, time.monotonic()
        for number, posted in taken:
            self._do(posted)
            self._done = number
        if not self._session.is_at_rest:
            self._session.flow(milliseconds=FRAME_MS)
            self._show(None)
        elif self._is_touched and not self._session.is_grabbed:
            self._settle()
        elif taken:
            self._show(None if self._is_touched else self._session.in_the_way)
        elif self._is_polishing and not is_over and self._is_quiet:
            self._polish()
        is_done = not self._waiting and (not self._is_touched or self._session.is_grabbed)
        return not (is_over and is_done)

    def _settle(self) -> None:
        """Finish what was touched, unless something is posted meanwhile: then it is not begun."""
        found = self._session.settle_unless(self._is_wanted)
        if found is None:
            return
        self._tries += 1
        # What is in conflict after one settle is where the next one begins.
        self._is_touched = bool(found.in_the_way) and self._tries < MOST_TRIES
        # Until the next change: turns that nobody asked for say nothing new.
        self._advice = () if found.in_the_way else self._session.advice
        self._show(None if self._is_touched else found.in_the_way)

    def _polish(self) -> None:
        """Try a few turns; shown only where they have moved something."""
        moved = self._session.polish(POLISHED_AT_ONCE, self._is_wanted)
        if moved or not self._session.is_rough:
            self._show(self._session.in_the_way)

    @property
    def _is_polishing(self) -> bool:
        return self._polishes and self._session.is_rough

    @property
    def _is_quiet(self) -> bool:
        return time.monotonic() - self._asked_at >= QUIET_SECONDS

    def _is_wanted(self) -> bool:
        """Whether a command waits to be done; calls have time."""
        with self._changed:
            return any(not isinstance(posted, _Call) for _, posted in self._waiting)

    def _do(self, posted: Posted) -> None:
        before = self._session.document
        try:
            if isinstance(posted, _Call):
                self._answer(posted)
            elif isinstance(posted, Leap):
                getattr(self._session, posted.value)()
            else:
                self._session.apply(posted)
        except PackworkError as error:
            self._refused.append(str(error))
        if self._session.document is not before or not isinstance(posted, _Call):
            self._is_touched = True

    def _answer(self, call: _Call) -> None:
        """Make a call; what it raises goes to whoever waits for its answer."""
        before = self._session.document
        try:
            found = call.function(self._session)
        except Exception as error:  # noqa: BLE001
            call.answer.set_exception(error)
        else:
            if self._session.document is not before:
                # Whoever waits for the answer may look at once.
                self._show(None)
            call.answer.set_result(found)

    def _show(self, in_the_way: tuple[str, ...] | None) -> None:
        self.frame = self._framed(self.frame.number + 1, in_the_way)
        self._on_frame()

    def _show_fall(self, document: Document) -> None:
        """Show items on their way, of a settle that has not ended."""
        number = self.frame.number + 1
        self.frame = replace(
            self.frame, number=number, document=document, in_the_way=None, refused=()
        )
        self._on_frame()

    def _framed(self, number: int, in_the_way: tuple[str, ...] | None) -> Frame:
        """The session as it is now, and what was refused since the frame before."""
        session, refused = self._session, tuple(self._refused)
        self._refused.clear()
        wrong = session.violations if in_the_way else ()
        return Frame(
            number,
            session.document,
            in_the_way,
            refused,
            self._done,
            tuple(sorted({k for one in wrong for k in (one.item, one.other) if k is not None})),
            session.history.can_undo,
            session.history.can_redo,
            self._advice if in_the_way == () else (),
            session.requests.unmet(session.document) if in_the_way == () else {},
            in_the_way is not None and self._is_polishing,
        )


def _replaces(posted: Posted, before: Posted) -> bool:
    """Whether a command makes the one before it pointless.

    Examples
    --------
    >>> _replaces(Move(item=1, x=5, y=5), Move(item=1, x=4, y=5))
    True
    >>> _replaces(Move(item=1, x=5, y=5), Turn(item=1, angle=30))
    False
    """
    if isinstance(posted, Move | Turn) and type(posted) is type(before):
        return posted.item == before.item
    if isinstance(posted, Together) and isinstance(before, Together):
        pairs = zip(posted.commands, before.commands, strict=False)
        is_same_length = len(posted.commands) == len(before.commands)
        return is_same_length and all(_replaces(one, other) for one, other in pairs)
    return False

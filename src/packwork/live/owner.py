"""The one thread that owns a session: others post commands to it and read its newest frame."""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass
from enum import Enum

from packwork.errors import PackworkError
from packwork.live.commands.command import Command
from packwork.live.commands.placing import Move, Turn
from packwork.live.document import Document
from packwork.live.session import Session

MOST_WAITING = 256
"""Commands that wait at most. Chosen."""

MOST_REFUSED = 16
"""Refusals that are kept for the next frame at most. Chosen."""

FRAME_MS = 12.0
"""Time for the flow between two frames. Longer moves more, shorter answers faster. Chosen."""

IDLE_SECONDS = 0.05
"""How long the thread waits for commands when nothing moves. Chosen."""


class Leap(Enum):
    """What is posted beside commands: a way through the history."""

    UNDO = "undo"
    REDO = "redo"


@dataclass(frozen=True, eq=False)
class Frame:
    """What a session looks like at a moment.

    Parameters
    ----------
    number
        How many frames there were before.
    document
        All there is.
    in_the_way
        What keeps it from its certificate; None while something moves.
    refused
        Commands that had no meaning since the frame before, a sentence each.
    """

    number: int
    document: Document
    in_the_way: tuple[str, ...] | None
    refused: tuple[str, ...] = ()


class Owner:
    """Runs a session in a thread of its own.

    Commands are done in their order. A move of an item that waits behind another move of the same
    item takes its place, so that a sender faster than the session never waits long; the newest
    frame overwrites the one before. Use it in a ``with`` block: its end waits for what was posted.

    Parameters
    ----------
    session
        Nobody else may touch it meanwhile.

    Examples
    --------
    >>> import packwork as pw
    >>> layout = pw.fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> with Owner(Session(Document.of(layout))) as owner:
    ...     posted = [owner.post(Move(item=0, x=x, y=300.0)) for x in range(250, 301)]
    >>> all(posted), float(owner.frame.document.poses.x[0]), owner.frame.in_the_way
    (True, 300.0, ())
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._waiting: deque[Command | Leap] = deque()
        self._changed = threading.Condition()
        self._is_over = False
        self._refused: deque[str] = deque(maxlen=MOST_REFUSED)
        self._is_touched = False
        self._failure: Exception | None = None
        self.frame = Frame(0, session.document, session.in_the_way)
        """The newest; replaced as a whole, so that it may be read at any time."""
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
        with self._changed:
            if self._is_over or self._failure is not None:
                return False
            if self._waiting and _replaces(command, self._waiting[-1]):
                self._waiting[-1] = command
            elif len(self._waiting) < MOST_WAITING:
                self._waiting.append(command)
            else:
                return False
            self._changed.notify()
        return True

    @property
    def waiting(self) -> int:
        """How many commands wait."""
        return len(self._waiting)

    def _run(self) -> None:
        try:
            while self._turn():
                pass
        except Exception as error:  # noqa: BLE001
            # Told to whoever leaves the block: nobody else would hear of it.
            self._failure = error

    def _turn(self) -> bool:
        """Do what waits, flow, show; False when all is done and no more comes."""
        with self._changed:
            is_waiting = self._session.is_grabbed or not self._is_touched
            is_idle = self._session.is_at_rest and is_waiting
            if not self._waiting and is_idle and not self._is_over:
                self._changed.wait(IDLE_SECONDS)
            taken = [self._waiting.popleft() for _ in range(len(self._waiting))]
            is_over = self._is_over
        for command in taken:
            self._do(command)
        if not self._session.is_at_rest:
            self._session.flow(milliseconds=FRAME_MS)
            self._show(None)
        elif self._is_touched and not self._session.is_grabbed:
            self._is_touched = False
            self._show(self._session.settle().in_the_way)
        elif taken:
            self._show(None if self._is_touched else self._session.in_the_way)
        is_done = not self._waiting and (not self._is_touched or self._session.is_grabbed)
        return not (is_over and is_done)

    def _do(self, command: Command | Leap) -> None:
        try:
            if isinstance(command, Leap):
                getattr(self._session, command.value)()
            else:
                self._session.apply(command)
            self._is_touched = True
        except PackworkError as error:
            self._refused.append(str(error))

    def _show(self, in_the_way: tuple[str, ...] | None) -> None:
        refused = tuple(self._refused)
        self._refused.clear()
        self.frame = Frame(self.frame.number + 1, self._session.document, in_the_way, refused)


def _replaces(command: Command | Leap, before: Command | Leap) -> bool:
    """Whether a command makes the one before it pointless.

    Examples
    --------
    >>> _replaces(Move(item=1, x=5, y=5), Move(item=1, x=4, y=5))
    True
    >>> _replaces(Move(item=1, x=5, y=5), Turn(item=1, angle=30))
    False
    """
    if isinstance(command, Move) and isinstance(before, Move):
        return command.item == before.item
    if isinstance(command, Turn) and isinstance(before, Turn):
        return command.item == before.item
    return False

"""Ctrl-C that takes effect soon, whatever the program is doing.

Python hears of a signal only between two steps of its own: inside a long call of a library it
does not. A thread hears of it at once, and answers where the program has not.
"""

from __future__ import annotations

import os
import signal
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from packwork.cli.terminal import say

PATIENCE_SECONDS = 1.5
"""Time in which the program may answer by itself. Larger leaves people waiting, smaller cuts off
what would have ended cleanly. Chosen."""

STOPPING = "stopping with the best so far; Ctrl-C again ends it at once"
ENDED = "stopped; nothing was written"
INTERRUPTED = 130
"""Exit code after Ctrl-C."""


class Watch:
    """How often Ctrl-C was pressed, and how often the program has heard of it."""

    def __init__(self) -> None:
        self.keeps_results = False
        """Whether a run goes on whose first Ctrl-C only asks it to stop."""
        self.is_over = False
        """Whether all is written, so that nothing is left to stop."""
        self._pressed, self._answered = 0, 0
        self._changed = threading.Condition()

    def answer(self) -> None:
        """Note that the program has heard of a Ctrl-C."""
        # A handler runs between any two steps: it must not wait for a lock.
        self._answered += 1

    def press(self) -> None:
        """Wait for the program's answer to one Ctrl-C; give it if none comes."""
        self._pressed += 1
        number = self._pressed
        with self._changed:
            self._changed.wait_for(lambda: self.is_over, PATIENCE_SECONDS)
        if self.is_over:
            return
        if self.keeps_results and number == 1:
            say(STOPPING)
        elif self._answered < number:
            say(ENDED)
            self.end()

    def end(self) -> None:
        """End the process; what is half written lies under a name of its own."""
        os._exit(INTERRUPTED)

    def finish(self) -> None:
        """All is written."""
        self.is_over = True
        with self._changed:
            self._changed.notify_all()

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Hear every Ctrl-C while the block runs, in a thread."""

        def interrupt(number: int, frame: FrameType | None) -> None:
            self.answer()
            raise KeyboardInterrupt

        here, there = socket.socketpair()
        there.setblocking(False)
        wakeup = signal.set_wakeup_fd(there.fileno(), warn_on_full_buffer=False)
        before = signal.signal(signal.SIGINT, interrupt)
        threading.Thread(target=self._hear, args=(here,), daemon=True).start()
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)
            signal.set_wakeup_fd(wakeup)
            self.finish()
            there.close()

    def _hear(self, here: socket.socket) -> None:
        with suppress(OSError), here:
            while numbers := here.recv(1):
                if numbers[0] == signal.SIGINT:
                    threading.Thread(target=self.press, daemon=True).start()


WATCH = Watch()
"""That of this process; it listens where the program was started by a person."""

"""Ctrl-C that takes effect soon, whatever the program is doing.

Python hears of a signal only between two steps of its own: inside a long call of a library it
does not. A thread hears of it at once, and answers where the program has not.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
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


class InterruptListener:
    """Counter of presses of Ctrl-C, which asks a run to stop or ends the program."""

    def __init__(self) -> None:
        self.keeps_results = False
        """Whether a run goes on whose first Ctrl-C only asks it to stop."""
        self.is_over = False
        """Whether all is written, so that nothing is left to stop."""
        self._pressed, self._is_ending = 0, False
        self._changed = threading.Condition()

    def press(self) -> None:
        """Wait for the program to end; end it if it does not and is not to keep what it has."""
        self._pressed += 1
        number = self._pressed
        with self._changed:
            self._changed.wait_for(lambda: self.is_over, PATIENCE_SECONDS)
        if self.is_over:
            return
        if self.keeps_results and number == 1 and not self._is_ending:
            say(STOPPING)
        else:
            # What is raised while Python collects garbage is dropped: the program may go on.
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
            self._is_ending = True
            raise KeyboardInterrupt

        def unraisable(dropped: sys.UnraisableHookArgs) -> None:
            # What is raised inside a callback of a library is dropped there, and :meth:`press` ends
            # the program: nobody who pressed Ctrl-C is to read a traceback.
            if not isinstance(dropped.exc_value, KeyboardInterrupt):
                hook(dropped)

        hook, sys.unraisablehook = sys.unraisablehook, unraisable
        here, there = socket.socketpair()
        there.setblocking(False)
        wakeup = signal.set_wakeup_fd(there.fileno(), warn_on_full_buffer=False)
        before = signal.signal(signal.SIGINT, interrupt)
        threading.Thread(target=self._hear, args=(here,), daemon=True).start()
        try:
            yield
        finally:
            sys.unraisablehook = hook
            signal.signal(signal.SIGINT, before)
            signal.set_wakeup_fd(wakeup)
            self.finish()
            there.close()

    def _hear(self, here: socket.socket) -> None:
        with suppress(OSError), here:
            while numbers := here.recv(1):
                if numbers[0] == signal.SIGINT:
                    threading.Thread(target=self.press, daemon=True).start()


WATCH = InterruptListener()
"""That of this process; it listens where the program was started by a person."""

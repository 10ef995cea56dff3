"""Errors to one line and an exit code; Ctrl-C to a stop that keeps what there is.

Python hears of a signal only between two steps of its own: inside a long call of a library it
does not. A thread hears of it at once, and answers where the program has not.
"""

from __future__ import annotations

import os
import re
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType

import typer

from packwork.cli.terminal import say
from packwork.errors import PackworkError, RecipeError

SHORTFALL = 1
"""Ran and wrote what it has, but something asked was not met."""
BAD_INPUT = 2
"""One clear line was printed; nothing was written."""
_NO_FLAGS = ("container", "items", "rules", "sheet")
"""Keys of what is named on the command line without a flag."""


@contextmanager
def clear_errors(recipe: Path | None = None) -> Iterator[None]:
    """Turn the package's errors into one line on standard error and exit code 2.

    ``recipe`` is the file that options come from; None if they were typed.
    """
    try:
        yield
    except PackworkError as error:
        line = " ".join(str(error).split())
        if isinstance(error, RecipeError) and recipe is not None:
            line = f"{recipe}: {line}"
        elif isinstance(error, RecipeError) and error.key not in _NO_FLAGS:
            line = _flag(error.key) + line.removeprefix(error.key)
        say(line + comma_hint(line))
        raise typer.Exit(BAD_INPUT) from None
    except MemoryError:
        say(
            "there is not enough memory for this; try fewer or smaller files, "
            "fewer items or fewer pixels"
        )
        raise typer.Exit(BAD_INPUT) from None
    except KeyboardInterrupt as stop:
        said = str(stop) or "stopped before there was anything to write"
        say(said)
        raise typer.Exit(INTERRUPTED) from None


_COMMA = re.compile(
    r"'((?:\w+=)?-?\d+,\d+ ?(?:[a-z]{1,3}|%)?(?: ?x ?\d+(?:,\d+)? ?[a-z]{0,3})?)'", re.IGNORECASE
)
"""A number with a decimal comma, a length or a sheet, in the words of an error."""


def comma_hint(line: str) -> str:
    """Advice, where an error names a number with a decimal comma; else nothing.

    Examples
    --------
    >>> comma_hint("--unit: must be a number, not '0,5'")
    '; write 0.5'
    >>> comma_hint("--pixels: must be a whole number, not '1,000'"), comma_hint("no 'a,1.svg'")
    ('; write 1000', '')
    >>> comma_hint("--unit: must be a number, not '1,000'"), comma_hint("a level, not '5,5'")
    ('', '')
    """
    met = _COMMA.search(line)
    # Levels are a list, in which a comma stands between two numbers.
    if met is None or "level" in line:
        return ""
    groups = "whole number" in line
    # A comma before three digits may group thousands.
    if groups != (re.search(r"(?<!\d)\d{1,3},\d{3}(?!\d)", met[1]) is not None):
        return ""
    return f"; write {met[1].replace(',', '' if groups else '.')}"


def _flag(key: str) -> str:
    """Flag of an option, or its key in recipe files if it has none."""
    from packwork.recipe.verbs import VERBS, options_of

    known = {option.name: option for verb in VERBS for option in options_of(verb)}
    if key not in known:
        return f"--{key.replace('_', '-')}"
    return known[key].flag if known[key].offer.is_flag else key


class Interrupt:
    """Tells the solver, which asks before every epoch, whether Ctrl-C was pressed.

    The first Ctrl-C ends the run with what it has; a second one ends it at once. Once all is
    written, which the writer says by ``is_over``, there is nothing left to stop.
    """

    def __init__(self) -> None:
        self.pressed = False
        self.is_over = False

    def __call__(self) -> bool:
        """Whether to stop."""
        return self.pressed

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Catch Ctrl-C while the block runs."""
        before = signal.signal(signal.SIGINT, self._press)
        WATCH.keeps_results = True
        try:
            yield
        finally:
            WATCH.keeps_results = False
            signal.signal(signal.SIGINT, before)

    def _press(self, number: int, frame: FrameType | None) -> None:
        if self.is_over:
            return
        if self.pressed:
            raise KeyboardInterrupt("stopped by a second Ctrl-C; nothing was written")
        self.pressed = True


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

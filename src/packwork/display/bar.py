"""Progress of a run, in a notebook or on a terminal."""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from html import escape
from typing import TYPE_CHECKING, Any, Protocol

from packwork.phrasing import number_of
from packwork.progress import Audience, Observer, Step

if TYPE_CHECKING:
    from rich.console import Console

EPOCHS_BETWEEN = 20
"""Epochs between two moves of the bar at least: each costs about one epoch. Chosen."""

SECONDS_BETWEEN = 0.1
"""Least time between two moves of the bar: more flood a notebook's page, and are as often as a
terminal is drawn. Chosen."""

SECONDS_BEFORE_LINE = 4.0
"""Time before the first line where there is no terminal to draw a bar on; every further one takes
twice as long to come, so most runs leave none in a log and an hour leaves ten. Smaller fills logs,
larger looks dead. Chosen."""

BEFORE = "starting"


class Bar(Observer, Protocol):
    """Observer that is on show while a run goes on."""

    def showing(self) -> AbstractContextManager[None]:
        """Be seen while the block runs."""
        ...

    def tell(self, share: float, text: str) -> None:
        """Show how much is done, 0 to 1, and of what."""
        ...


def bar_for(wanted: bool | None, observer: Observer | None = None) -> Bar | None:
    """Bar where one is to be shown, which tells the observer too; else None.

    ``wanted``: None: in a notebook only.

    >>> bar_for(None) is None
    True
    """
    notebook = in_notebook()
    if not (notebook if wanted is None else wanted):
        return None
    bar: Bar = NotebookBar() if notebook else TerminalBar()
    return bar if observer is None else BarAndObserver(bar, observer)


def in_notebook() -> bool:
    """Whether a Jupyter kernel runs this; loads nothing to find out.

    >>> in_notebook()
    False
    """
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    # A kernel's shell knows its kernel; that of a terminal has none.
    return getattr(shell, "kernel", None) is not None


class BarAndObserver(Audience):
    """A bar and an observer of one's own, each told as often as it wants to be."""

    def __init__(self, bar: Bar, observer: Observer) -> None:
        super().__init__([bar, observer])
        self.tell, self.showing = bar.tell, bar.showing


class NotebookBar:
    """One line of a cell's output, replaced as the run goes on; it needs no widgets."""

    every = EPOCHS_BETWEEN

    def __init__(self) -> None:
        self._share, self._text = 0.0, BEFORE
        self._is_over = False
        self._handle: Any = None
        self._sent = 0.0

    def on_step(self, step: Step) -> None:
        """Move the bar, unless it has just been moved: to measure the shares takes an epoch."""
        if time.monotonic() - self._sent >= SECONDS_BETWEEN:
            self.tell(step.progress, f"{_level(step)}, {_shares(step)}")

    def tell(self, share: float, text: str) -> None:
        """Move the bar, unless it has just been moved."""
        self._share, self._text = max(self._share, share), text
        if time.monotonic() - self._sent >= SECONDS_BETWEEN:
            self._send()

    @contextmanager
    def showing(self) -> Iterator[None]:
        """Show the bar while the block runs; nothing of it stays."""
        self._handle = importlib.import_module("IPython.display").display(self, display_id=True)
        self._sent = time.monotonic()
        try:
            yield
        finally:
            self._is_over = True
            self._send()

    def _send(self) -> None:
        self._handle.update(self)
        self._sent = time.monotonic()

    def _repr_html_(self) -> str:
        if self._is_over:
            return ""
        bar = f'<progress value="{self._share:.3f}" max="1"></progress>'
        return f"{bar} <small>{escape(self._text)}</small>"

    def __repr__(self) -> str:
        return "" if self._is_over else f"{100 * self._share:.0f} %: {self._text}"


class TerminalBar:
    """A line on a terminal that is gone when the run is over; elsewhere a line now and then.

    ``console``: where the bar is drawn; if that is none or no terminal, standard error is asked.
    """

    every = EPOCHS_BETWEEN

    def __init__(self, console: Console | None = None, is_quiet: bool = False) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        if console is None or not console.is_terminal:
            console = Console(stderr=True)
        self._lines = None if is_quiet or console.is_terminal else console
        self._share, self._told = 0.0, time.monotonic()
        self._wait = SECONDS_BETWEEN if self._lines is None else SECONDS_BEFORE_LINE
        self._progress = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TextColumn("{task.percentage:.0f} %"),
            TimeElapsedColumn(),
            console=console,
            transient=True,
            disable=is_quiet or not console.is_terminal,
        )
        self._task = self._progress.add_task(BEFORE, total=1.0)

    def on_step(self, step: Step) -> None:
        """Move the bar, unless it has just been moved: to measure the shares takes an epoch."""
        if time.monotonic() - self._told >= self._wait:
            self.tell(step.progress, f"{_level(step)}, {_shares(step)}")

    def tell(self, share: float, text: str) -> None:
        """Move the bar, never backwards."""
        self._share = max(self._share, share)
        self._progress.update(self._task, completed=self._share, description=text)
        now, before = time.monotonic(), self._told
        if self._lines is None:
            self._told = now
        if self._lines is None or now - before < self._wait:
            return
        self._told, self._wait = now, 2 * self._wait
        # A closed pipe is no reason to fail.
        with suppress(OSError, ValueError):
            line = f"packwork: {100 * self._share:.0f} %: {text}"
            self._lines.print(line, soft_wrap=True, markup=False, highlight=False)

    @contextmanager
    def showing(self) -> Iterator[None]:
        """Draw the bar while the block runs."""
        with self._progress:
            yield


def shown(bar: Bar | None) -> AbstractContextManager[None]:
    """Block in which the bar, if there is one, is on show."""
    return nullcontext() if bar is None else bar.showing()


def _level(step: Step) -> str:
    if step.is_finish:
        return f"exact finish of {number_of(len(step.poses), 'item')}"
    if step.stage == "done":
        return number_of(len(step.poses), "item")
    return f"level {step.level + 1}/{step.levels} ({step.resolution} px)"


def _shares(step: Step) -> str:
    return f"covered {100 * step.coverage:.1f} %, overlap {100 * step.overlap:.2f} %"

"""What a person sees: a progress bar, notices, closing tables."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from packwork.progress import Step

STEPS_SHOWN = 40
"""Times the bar is refreshed in a run: each costs about one epoch. Chosen."""

SLOW_SECONDS = 1.5
"""Patience before a notice explains a wait. Chosen."""


class Bar:
    """Progress of a run on the terminal: level, epoch, coverage, overlap."""

    def __init__(self, epochs: int, console: Console) -> None:
        self.every = max(1, epochs // STEPS_SHOWN)
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.completed:.0f}/{task.total:.0f}"),
            TextColumn("{task.fields[shares]}"),
            TimeElapsedColumn(),
            console=console,
            transient=True,
            disable=not console.is_terminal,
        )
        self._task = self._progress.add_task("starting", total=epochs, shares="")

    def on_step(self, step: Step) -> None:
        """Move the bar."""
        self._progress.update(
            self._task,
            completed=step.epoch,
            description=f"level {step.level + 1}/{step.levels} ({step.resolution} px)",
            shares=f"covered {100 * step.coverage:.1f} %  overlap {100 * step.overlap:.2f} %",
        )

    @contextmanager
    def showing(self) -> Iterator[None]:
        """Draw the bar while the block runs."""
        with self._progress:
            yield


@contextmanager
def notice_if_slow(console: Console, text: str) -> Iterator[None]:
    """Print ``text`` once if the block takes longer than a person waits unasked."""
    timer = threading.Timer(SLOW_SECONDS, lambda: console.print(text))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def metrics_table(metrics: Mapping[str, Any]) -> Table:
    """Measures, one a row: by pixels beside exact ones, with what they mean."""
    exact = metrics.get("exact", {})
    table = Table(box=None, pad_edge=False, header_style="dim")
    for heading in ("measure", "pixels", "exact"):
        table.add_column(heading, justify="left" if heading == "measure" else "right")
    table.add_column("meaning", style="dim")
    table.add_row("LC", _percent(metrics["LC"]), _percent(exact.get("LC")), "covered")
    table.add_row("LC ink", "", _percent(metrics.get("LC_ink")), "covered by what is drawn")
    table.add_row("OO", _small(metrics["OO"]), _small(exact.get("OO")), "covered twice")
    table.add_row("EA", _small(metrics["EA"]), _small(exact.get("EA")), "outside the container")
    table.add_row("L-nU", f"{metrics['LnU']:.1f}", "", "unevenness of the gaps, px²")
    gap = exact.get("min_gap")
    table.add_row("gap", "", "" if gap is None else f"{gap:.3g}", "smallest, canvas units")
    return table


def seconds_line(seconds: Mapping[str, float]) -> str:
    """Time per part on one line.

    Examples
    --------
    >>> seconds_line({"read": 0.1, "levels": 0.25, "total": 0.35})
    'read 0.10 s, levels 0.25 s, total 0.35 s'
    """
    return ", ".join(f"{part} {value:.2f} s" for part, value in seconds.items())


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.2f} %"


def _small(share: float | None) -> str:
    return "" if share is None else f"{share:.2e}" if share else "0"

"""Medians with their spread, and what machine they were measured on."""

from __future__ import annotations

import importlib.metadata
import platform
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Timing:
    """Milliseconds: median, and the quartiles as spread."""

    median: float
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.median:.3g} ({self.low:.3g}-{self.high:.3g})"


def timed(call: Callable[[], object], seconds: float = 1.0, least: int = 7) -> Timing:
    """Repeat ``call`` for about ``seconds``, at least ``least`` times, after one warm-up."""
    call()
    samples: list[float] = []
    began = time.perf_counter()
    while len(samples) < least or time.perf_counter() - began < seconds:
        start = time.perf_counter()
        call()
        samples.append(1e3 * (time.perf_counter() - start))
        if len(samples) >= 2_000:
            break
    low, median, high = np.percentile(samples, [25, 50, 75])
    return Timing(float(median), float(low), float(high))


def timed_in_turn(calls: dict[str, Callable[[], object]], rounds: int = 60) -> dict[str, Timing]:
    """Time several calls in turn, A B A B ..., so that a drifting machine hits all alike."""
    samples: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds + 1):
        for name, call in calls.items():
            start = time.perf_counter()
            call()
            samples[name].append(1e3 * (time.perf_counter() - start))
    return {
        name: Timing(*(float(v) for v in np.percentile(taken[1:], [50, 25, 75])))
        for name, taken in samples.items()
    }


def machine() -> str:
    """Processor and versions, one line."""
    versions = ", ".join(
        f"{name} {importlib.metadata.version(name)}"
        for name in ("packwork", "numpy", "numba", "llvmlite", "scipy", "shapely")
    )
    return f"{_processor()}; Python {platform.python_version()}; {versions}; one thread"


def _processor() -> str:
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def markdown_table(header: list[str], rows: list[list[str]]) -> str:
    """Rows as a Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)

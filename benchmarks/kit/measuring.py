"""Medians with their spread, and what machine they were measured on.

Times are the processor's, so that other programs on a busy machine do not count; on a quiet
one they are those of a clock, since nothing here runs in more than one thread.
"""

from __future__ import annotations

import importlib.metadata
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray

DOCS = Path(__file__).resolve().parents[2] / "docs"


@dataclass(frozen=True)
class Timing:
    """Milliseconds: median, and the quartiles as spread."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, samples: Sequence[float] | FloatArray) -> Timing:
        """Median and quartiles of samples."""
        return cls(*(float(v) for v in np.percentile(samples, [50, 25, 75])))

    def __str__(self) -> str:
        return f"{self.median:.3g} ({self.low:.3g}-{self.high:.3g})"


def timed(call: Callable[[], object], seconds: float = 1.0, least: int = 7) -> Timing:
    """Repeat ``call`` for about ``seconds``, at least ``least`` times, after one warm-up."""
    call()
    samples: list[float] = []
    began = time.perf_counter()
    while len(samples) < least or time.perf_counter() - began < seconds:
        start = time.process_time()
        call()
        samples.append(1e3 * (time.process_time() - start))
        if len(samples) >= 2_000:
            break
    return Timing.of(samples)


def timed_in_turn(calls: dict[str, Callable[[], object]], rounds: int = 60) -> dict[str, Timing]:
    """Time several calls in turn, A B A B ..., so that a drifting machine hits all alike."""
    samples: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds + 1):
        for name, call in calls.items():
            start = time.process_time()
            call()
            samples[name].append(1e3 * (time.process_time() - start))
    return {name: Timing.of(taken[1:]) for name, taken in samples.items()}


def running_sum(shape: tuple[int, int]) -> Callable[[], object]:
    """What the engine is compared with: one running sum along an image's rows."""
    image = np.random.default_rng(0).random(shape, dtype=np.float32)
    buffer = np.empty_like(image)
    return lambda: np.cumsum(image, axis=1, out=buffer)


def ranged(samples: Sequence[float], form: str) -> str:
    """Median, and the least and the most, each in a format as ``.3f``."""
    middle, low, high = (f"{v:{form}}" for v in (np.median(samples), min(samples), max(samples)))
    return f"{middle} ({low} to {high})" if low != high else middle


def lasting(samples: Sequence[float]) -> str:
    """Median seconds, and the least and the most, in milliseconds where they are short.

    >>> lasting([0.004, 0.0052, 0.0061]), lasting([21.34])
    ('5.2 (4 to 6.1) ms', '21.3 s')
    """
    if np.median(samples) < 0.1:
        return ranged([1e3 * one for one in samples], ".3g") + " ms"
    return ranged(samples, ".3g") + " s"


def plainly(value: float) -> str:
    """Two digits that count, without an exponent.

    >>> plainly(2134.0), plainly(0.000181), plainly(1.25)
    ('2,100', '0.00018', '1.2')
    """
    return f"{float(f'{value:.2g}'):,.10f}".rstrip("0").rstrip(".")


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
        for line in info.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def markdown_table(header: list[str], rows: list[list[str]]) -> str:
    """Rows as a Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)

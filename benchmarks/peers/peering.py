"""What a program made of a task beside others, as the manifest of ``bench peers`` has it."""

from __future__ import annotations

import importlib.metadata
import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from benchmarks.kit.manifests import Manifest

RUNS = 5
LONG_SECONDS = 10.0
"""A run that takes longer is made once: a median of five would take minutes."""


def version(distribution: str) -> str | None:
    """Of a Python package; None if it is not there."""
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return None


def entry(
    program: str,
    version: str,
    task: str,
    count: int,
    seconds: Sequence[float],
    figures: Mapping[str, Sequence[float]],
) -> Manifest:
    """A program's work: its task, how many items, seconds and figures of each run."""
    found: Manifest = {
        "program": program, "version": version, "task": task, "count": count,
        "seconds": list(seconds), **figures,
    }  # fmt: skip
    print(found, flush=True)
    return found


def missing(program: str, how: str) -> Manifest:
    """A program that is not there, and what would bring it."""
    return {"program": program, "missing": how}


def timed_out(program: str, version: str, task: str, count: int, limit: float) -> Manifest:
    """A program that did not come to an end."""
    found = {
        "program": program, "version": version, "task": task, "count": count, "limit": limit,
    }  # fmt: skip
    print(found, flush=True)
    return found


def repeated(
    call: Callable[[int], tuple[Any, float]], runs: int = RUNS
) -> tuple[list[Any], list[float]]:
    """Results of ``call(seed)``, and the seconds of each; of one seed alone if it is long."""
    done = [call(0)]
    if done[0][1] <= LONG_SECONDS:
        done += [call(seed) for seed in range(1, runs)]
    return [result for result, _ in done], [spent for _, spent in done]


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise ``TimeoutError`` in code that takes more time of the processor."""

    def stop(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)

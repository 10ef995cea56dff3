"""Inputs shared out to processes that may die; what came of each."""

from __future__ import annotations

import contextlib
import multiprocessing as mp
import os
import resource
import tempfile
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from benchmarks.robustness.hostile.inputs import Input
from benchmarks.robustness.hostile.trying import CRASH, HANG, SECONDS_AT_MOST, Tried, attempt, hush

CLOCK_SECONDS = 15 * SECONDS_AT_MOST
"""By the clock, for one input: past it the process is ended and the input counts as a hang.
That is what native code, which no alarm of Python's reaches, runs into."""

MEMORY_BYTES = 4 << 30
"""Address space that a process may have beyond what it has when it begins: an input that
asks for more fails, which counts as a crash."""


@dataclass
class Found:
    """All that came of a lot.

    Parameters
    ----------
    tried
        What came of each input, by its number.
    peak_bytes
        The most memory that any process had at a time.
    """

    tried: dict[int, Tried] = field(default_factory=dict)
    peak_bytes: int = 0


def try_all(lot: Iterable[Input], processes: int) -> Iterator[tuple[Input, Tried, int]]:
    """Each input with what came of it, and its process' most bytes, as they are done."""
    waiting = iter(lot)
    crew = [_Worker() for _ in range(processes)]
    try:
        busy = [worker for worker in crew if worker.take(waiting)]
        while busy:
            wait([worker.end for worker in busy], timeout=1.0)
            for worker in list(busy):
                came = worker.answer()
                if came is None:
                    continue
                yield came
                if not worker.take(waiting):
                    busy.remove(worker)
    finally:
        for worker in crew:
            worker.stop()


class _Worker:
    """One process, started anew when it has died."""

    def __init__(self) -> None:
        self._input: Input | None = None
        self._deadline = 0.0
        self._start()

    def _start(self) -> None:
        self.end, other = mp.get_context("spawn").Pipe()
        self._process = mp.get_context("spawn").Process(target=_work, args=(other,), daemon=True)
        self._process.start()
        other.close()

    def take(self, waiting: Iterator[Input]) -> bool:
        """Begin the next input, if there is one."""
        self._input = next(waiting, None)
        if self._input is None:
            return False
        self.end.send(self._input)
        self._deadline = time.monotonic() + CLOCK_SECONDS
        return True

    def answer(self) -> tuple[Input, Tried, int] | None:
        """What came of the input; None as long as nothing did."""
        assert self._input is not None
        one = self._input
        try:
            if self.end.poll():
                tried, peak = self.end.recv()
                return one, tried, peak
        except (EOFError, ConnectionError):
            self._process.join()
            code = self._process.exitcode
            self._start()
            return one, Tried(one.number, CRASH, 0.0, f"the process died: {code}"), 0
        if time.monotonic() > self._deadline:
            self.stop()
            self._start()
            return one, Tried(one.number, HANG, CLOCK_SECONDS, "past the clock"), 0
        return None

    def stop(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.join()
        self.end.close()


def _work(end: Connection) -> None:
    hush()
    _bound_memory()
    # Whoever gave the inputs may be gone before the last answer.
    with tempfile.TemporaryDirectory() as folder, contextlib.suppress(BrokenPipeError):
        while (one := _next(end)) is not None:
            tried = attempt(one, Path(folder))
            end.send((tried, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024))


def _next(end: Connection) -> Any:
    try:
        return end.recv()
    except EOFError:
        return None


def _bound_memory() -> None:
    pages = (
        int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[0])
        if os.name == "posix"
        else 0
    )
    most = pages * resource.getpagesize() + MEMORY_BYTES
    resource.setrlimit(resource.RLIMIT_AS, (most, most))

"""Start of a process before its first stage: Python, imports, compiled kernels."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

# No system tells alike when a process began; until here it has done little but use its processor.
_BEGAN = time.perf_counter() - time.process_time()


class StartUp:
    """Seconds by the clock from a process' beginning, told once."""

    def __init__(self) -> None:
        self._seconds = 0.0
        self._is_over = False

    def end(self) -> None:
        """Say that all is loaded and the first stage begins; of no account when said again."""
        if not self._is_over:
            self._seconds = time.perf_counter() - _BEGAN
            self._is_over = True

    @contextmanager
    def more(self) -> Iterator[None]:
        """Count what the block takes as well: kernels are loaded once files are read."""
        began = time.perf_counter()
        try:
            yield
        finally:
            self._seconds += time.perf_counter() - began

    def told(self) -> float:
        """All that was counted since this was asked for before: 0 of a second run."""
        seconds, self._seconds = self._seconds, 0.0
        return seconds


START_UP = StartUp()

"""Runs as they are kept while they are made: a line of JSON each, so that nothing is lost.

What stands there and was no fault is not run again; what was one is, with the program as it is by
then, and both stay in the file.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from pathlib import Path

from benchmarks.robustness.hostile.parts import state
from benchmarks.robustness.hostile.running import Line, Ran, run_line, typed


class Kept:
    """What came of runs so far, by their keys.

    Parameters
    ----------
    path
        The file; it grows by a line a run.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.ran: dict[str, tuple[Ran, str]] = {}
        self.faults: dict[str, int] = {}
        if path.exists():
            for text in path.read_text(encoding="utf-8").splitlines():
                self._take(json.loads(text))

    def _take(self, record: dict[str, object]) -> None:
        ran = Ran(**record["ran"])  # type: ignore[arg-type]
        key = str(record["key"])
        self.ran[key] = ran, str(record["commit"])
        self.faults[key] = self.faults.get(key, 0) + ran.is_fault

    def of(self, line: Line) -> Ran | None:
        """What came of it when it was run, if that was no fault."""
        ran, _ = self.ran.get(line.key, (None, ""))
        return None if ran is None or ran.is_fault else ran

    def add(self, line: Line, ran: Ran, commit: str) -> None:
        """Write it down, and to the disk."""
        record = {"key": line.key, "number": line.number, "commit": commit, "ran": asdict(ran)}
        if ran.is_fault:
            record["typed"] = typed(line)
        self._take(record)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(record) + "\n")


def run_all(lines: Iterable[Line], kept: Kept) -> Iterator[tuple[Line, Ran]]:
    """Run what has not been run yet, or was a fault; tell what came of all."""
    commit = state()
    for line in lines:
        ran = kept.of(line)
        if ran is None:
            ran = run_line(line)
            kept.add(line, ran, commit)
        yield line, ran

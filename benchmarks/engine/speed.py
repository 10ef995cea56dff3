"""Two checkouts in turn: ``packwork bench speed [--against PATH] [ROW...] [runs=N]``.

Each row is one process, here and, with ``--against``, by the code of another checkout, A B A B ...;
what is printed is the medians, by the clock and of the processor, and the seconds of each stage as
the run's report has them. Kernels are compiled before. Rows: draft, normal, one, best, 1000,
10000, round, round1000; all but the slow ones without a word.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import packwork as pw
from benchmarks.kit.circles import circle, lognormal
from benchmarks.kit.measuring import DOCS, machine, markdown_table

HERE = DOCS.parent

_BEAR = ("fill", "builtin:bear", "-n")

ROWS: dict[str, tuple[str, ...]] = {
    "draft": (*_BEAR, "100", "--effort", "draft"),
    "normal": (*_BEAR, "100"),
    "one": (*_BEAR, "100", "--threads", "1"),
    "best": (*_BEAR, "100", "--effort", "best"),
    "1000": (*_BEAR, "1000"),
    "10000": (*_BEAR, "10000"),
    "round": ("round", "200"),
    "round1000": ("round", "1000"),
}
"""Commands by name; ``round`` packs so many circles of lognormal sizes, in Python."""

SLOW = frozenset({"best", "10000", "round1000"})
"""Rows that take minutes, and are run only where they are named."""

RUNS = 5
"""Runs of each row by each checkout."""

Taken = dict[str, float]
"""Seconds of one run: ``clock``, ``processor``, and those of each stage."""


def one_run(checkout: Path, command: Sequence[str], folder: Path) -> Taken:
    """Seconds of one command by the code of a checkout."""
    report = folder / "report.json"
    began, before = time.perf_counter(), _processor()
    if command[0] == "round":
        done = _called(checkout, "benchmarks.engine.speed", "round", command[1], str(report))
    else:
        written = ["-q", "-o", str(folder / "a.svg"), "--report", str(report)]
        done = _called(checkout, "packwork", *command, *written)
    clock, processor = time.perf_counter() - began, _processor() - before
    if done.returncode > 1:
        raise SystemExit(f"{checkout}: {done.stderr.strip()}")
    told: dict[str, Any] = json.loads(report.read_text(encoding="utf-8"))
    stages = {name: one for name, one in told["seconds"].items() if name != "total"}
    return {"clock": clock, "processor": processor, **stages, "LC": told["metrics"]["LC"]}


def _processor() -> float:
    """Processor's seconds of all processes that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _called(checkout: Path, module: str, *words: str) -> subprocess.CompletedProcess[str]:
    """A module run with the package of a checkout, and the benchmarks of this one."""
    paths = os.pathsep.join([str(checkout / "src"), str(HERE)])
    # An installed package has its bytecode, without which half a second goes into making it.
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    return subprocess.run(  # noqa: S603
        [sys.executable, "-m", module, *words],
        env={**kept, "PYTHONPATH": paths, "COLUMNS": "200"},
        check=False, capture_output=True, text=True,
    )  # fmt: skip


def round_pack(count: int, report: Path) -> None:
    """Pack circles round each other, and write what a report would say."""
    items = [circle(k, radius) for k, radius in enumerate(lognormal(0, count))]
    began = time.perf_counter()
    layout = pw.pile("none", items, rotate="none", compact=True)
    seconds = {"finish": time.perf_counter() - began}
    text = json.dumps({"seconds": seconds, "metrics": {"LC": layout.metrics["LC"]}})
    report.write_text(text, encoding="utf-8")


def knows(checkout: Path, command: Sequence[str]) -> bool:
    """Whether a checkout has all options of a command."""
    asked = [word for word in command if word.startswith("--")]
    return not asked or all(
        word in _called(checkout, "packwork", command[0], "--help").stdout for word in asked
    )


def measured(
    checkouts: Sequence[Path], names: Sequence[str], runs: int
) -> dict[str, list[list[Taken]]]:
    """Runs by row and checkout; none where a checkout does not know the command."""
    found = {}
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        for checkout in checkouts:
            one_run(checkout, ROWS["draft"], folder)
        for name in names:
            command = ROWS[name]
            does = [knows(checkout, command) for checkout in checkouts]
            taken: list[list[Taken]] = [[] for _ in checkouts]
            for _ in range(runs):
                for checkout, known, samples in zip(checkouts, does, taken, strict=True):
                    if known:
                        samples.append(one_run(checkout, command, folder))
            found[name] = taken
            print("\n".join(" ".join(cells) for cells in cells_of(name, taken)), flush=True)
    return found


HEADER = [
    "row", "code", "clock", "processor", "start-up", "read", "start", "levels", "finish", "measure",
    "LC",
]  # fmt: skip


def cells_of(name: str, taken: Sequence[Sequence[Taken]]) -> list[list[str]]:
    """Lines of the table for one row: this checkout's, and the other's."""
    lines = []
    for label, samples in zip(("here", "against"), taken, strict=False):
        if not samples:
            lines.append([name, label, *["-"] * (len(HEADER) - 2)])
            continue
        middle = {
            key: float(np.median([one.get(key, 0.0) for one in samples])) for key in HEADER[2:]
        }
        lines.append(
            [name, label, *(f"{middle[k]:.2f}" for k in HEADER[2:-1]), f"{middle['LC']:.4f}"]
        )
    return lines


def main(words: list[str]) -> None:
    """Measure and print."""
    if words[:1] == ["round"] and len(words) == 3:
        round_pack(int(words[1]), Path(words[2]))
        return
    checkouts = [HERE]
    if "--against" in words:
        at = words.index("--against")
        checkouts.append(Path(words[at + 1]).resolve())
        words = words[:at] + words[at + 2 :]
    runs = [int(word.split("=")[1]) for word in words if word.startswith("runs=")]
    names = [name for name in ROWS if name in words]
    names = names or [name for name in ROWS if name not in SLOW]
    print(machine(), f"load {os.getloadavg()[0]:.1f}", flush=True)
    found = measured(checkouts, names, runs[0] if runs else RUNS)
    rows = [line for name, taken in found.items() for line in cells_of(name, taken)]
    print("\n" + markdown_table(HEADER, rows))


if __name__ == "__main__":
    main(sys.argv[1:])

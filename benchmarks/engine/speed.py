"""Two checkouts in turn: ``packwork bench speed [--against PATH] [ROW...] [runs=N] [print]``.

Each row is one process, here and, with ``--against``, by the code of another checkout, in turn:
seconds by the clock and of the processor, peak of memory, and seconds of each stage as the run
tells them. Kernels are compiled before, but for the row ``first``. Rows that take minutes are
run only where they are named. With ``--against`` each row goes to docs/manifests/speed.json as soon
as it is measured, and the page is made anew; rows of the same sources stay, others are dropped.
``profile`` says in which functions a fill of each spends its time; ``print`` writes nothing.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import packwork as pw
from benchmarks.engine.profiled import FILL
from benchmarks.engine.speed_page import HEADER, cells_of, page
from benchmarks.kit.circles import circle, lognormal
from benchmarks.kit.manifests import known, stamp, write_manifest, write_text
from benchmarks.kit.measuring import DOCS, machine, markdown_table, timed_in_turn
from benchmarks.pages import overview

HERE = DOCS.parent

_BEAR = ("fill", "builtin:bear", "-n")

_LEVELS = ("--epochs", "200", "--levels", "50,200,600", "--finish", "none")

ROWS: dict[str, tuple[str, ...]] = {
    "draft": (*_BEAR, "100", "--effort", "draft"),
    "normal": (*_BEAR, "100"),
    "one": (*_BEAR, "100", "--threads", "1"),
    "1000": (*_BEAR, "1000"),
    "epochs": (*_BEAR, "100", *_LEVELS),
    "floor": ("floor",),
    "round": ("round", "200"),
    "round1000": ("round", "1000"),
    "best": (*_BEAR, "100", "--effort", "best"),
    "first": (*_BEAR, "100"),
    "10000": (*_BEAR, "10000"),
}
"""Commands by name; ``round`` packs so many circles of lognormal sizes, in Python; ``floor`` is an
epoch beside the bytes that it has to move; ``first`` begins with an empty cache."""

SLOW = frozenset({"best", "10000", "round1000", "first"})
"""Rows that take minutes, and are run only where they are named."""

RUNS = 5
"""Runs of each row by each checkout."""

FLOOR_PX = 600

FLOOR_BYTES = 4 * 4
"""What an epoch without evenness has to move a pixel: as on the page of scaling."""

FLOOR_WEIGHTS = {"containment": 5.0, "overlap": 5.0, "filling": 1.0, "evenness": 0.0}

Taken = dict[str, float]
"""Seconds of one run: ``clock``, ``processor``, and those of each stage; MiB: ``peak``."""


def one_run(checkout: Path, name: str, folder: Path) -> Taken:
    """Seconds of one row's command by the code of a checkout."""
    command, report = ROWS[name], folder / "report.json"
    is_ours = command[0] in ("round", "floor")
    words = list(command)
    if is_ours:
        words = [*command, str(report)]
    else:
        words += ["-q", "-o", str(folder / "a.svg"), "--report", str(report)]
    with tempfile.TemporaryDirectory() as empty:
        cache = {"PACKWORK_CACHE_DIR": empty} if name == "first" else {}
        module = "benchmarks.engine.speed" if is_ours else "packwork"
        taken = _timed(checkout, module, words, cache)
    told: dict[str, Any] = json.loads(report.read_text(encoding="utf-8"))
    stages = {name: one for name, one in told["seconds"].items() if name != "total"}
    return {**taken, **stages, "LC": told["metrics"]["LC"], "LnU": told["metrics"]["LnU"]}


def _timed(checkout: Path, module: str, words: Sequence[str], more: dict[str, str]) -> Taken:
    """Clock, processor and memory of one process and those that it waits for."""
    began = time.perf_counter()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(  # noqa: S603
            [sys.executable, "-m", module, *words], env=_environment(checkout) | more,
            stdout=subprocess.DEVNULL, stderr=said,
        )  # fmt: skip
        _, status, used = os.wait4(process.pid, 0)
        clock = time.perf_counter() - began
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in (0, 1):
            said.seek(0)
            raise SystemExit(f"{checkout}: {said.read().decode().strip()}")
    return {
        "clock": clock, "processor": used.ru_utime + used.ru_stime, "peak": used.ru_maxrss / 1024,
    }  # fmt: skip


def _environment(checkout: Path) -> dict[str, str]:
    """Of a process with the package of a checkout, and the benchmarks of this one."""
    paths = os.pathsep.join([str(checkout / "src"), str(HERE)])
    # An installed package has its bytecode, without which half a second goes into making it.
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONPATH": paths, "COLUMNS": "200"}


def round_pack(count: int, report: Path) -> None:
    """Pack circles round each other, and write what a report would say."""
    items = [circle(k, radius) for k, radius in enumerate(lognormal(0, count))]
    began = time.perf_counter()
    layout = pw.pile("none", items, rotate="none", compact=True)
    _write(report, {"finish": time.perf_counter() - began}, layout.metrics["LC"])


def floor(report: Path) -> None:
    """Milliseconds of an epoch of 100 icons, and of a copy of the bytes that it has to move."""
    from benchmarks.kit.epochs import epoch_of

    source = np.ones((FLOOR_PX, FLOOR_PX), dtype=np.float32)
    target = np.empty_like(source)
    calls = {
        "epoch": epoch_of(FLOOR_WEIGHTS, 100, FLOOR_PX),
        "copy": lambda: np.copyto(target, source),
    }
    found = timed_in_turn(calls, 200)
    bare = found["copy"].median * FLOOR_BYTES * source.size / (2 * source.nbytes)
    _write(report, {"epoch_ms": found["epoch"].median, "floor_ms": bare}, 0.0)


def _write(report: Path, seconds: Taken, covered: float) -> None:
    text = json.dumps({"seconds": seconds, "metrics": {"LC": covered, "LnU": 0.0}})
    report.write_text(text, encoding="utf-8")


def knows(checkout: Path, command: Sequence[str]) -> bool:
    """Whether a checkout has all options of a command."""
    asked = [word for word in command if word.startswith("--")]
    if not asked:
        return True
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-m", "packwork", command[0], "--help", "all"], env=_environment(checkout),
        check=False, capture_output=True, text=True,
    )  # fmt: skip
    return all(word in done.stdout for word in asked)


def measured(checkouts: Sequence[Path], name: str, runs: int, folder: Path) -> list[list[Taken]]:
    """Runs of one row by checkout; none where a checkout does not know the command."""
    does = [knows(checkout, ROWS[name]) for checkout in checkouts]
    taken: list[list[Taken]] = [[] for _ in checkouts]
    for _ in range(runs):
        for checkout, known_there, samples in zip(checkouts, does, taken, strict=True):
            if known_there:
                samples.append(one_run(checkout, name, folder))
    return taken


def source_of(checkout: Path) -> str:
    """Last commit that changed the package, as Git names it; ``+`` if it was changed since."""

    def git(*words: str) -> str:
        done = subprocess.run(  # noqa: S603
            ["git", "-C", str(checkout), *words],  # noqa: S607
            check=True, capture_output=True, text=True,
        )  # fmt: skip
        return done.stdout.strip()

    is_changed = bool(git("status", "--porcelain", "src"))
    return git("log", "-1", "--format=%h (%cs)", "--", "src") + ("+" if is_changed else "")


def keep(name: str, taken: list[list[Taken]], sources: list[str], at: dict[str, Any]) -> None:
    """Write a row beside those of the same sources, and the page."""
    before = known().get("speed", {"sources": [], "sections": {}})
    is_same = before["sources"] == sources
    rows = before["sections"] if is_same else {}
    # Where the other checkout lies is of no interest to anybody else.
    command = re.sub(r"--against \S+", "--against PATH", at["command"])
    rows[name] = {**at, "command": command, "runs": taken}
    sections = {row: rows[row] for row in ROWS if row in rows}
    profile = before.get("profile", {}) if is_same else {}
    written({"sources": sources, "profile": profile, "sections": sections})


def keep_profiles(checkouts: Sequence[Path], sources: list[str]) -> None:
    """Write in which functions a fill of each checkout spends its time, beside rows of the same."""
    before = known().get("speed", {"sources": [], "sections": {}})
    sections = before["sections"] if before["sources"] == sources else {}
    profiles = [profile_of(checkout) for checkout in checkouts]
    written(
        {
            "sources": sources,
            "profile": {"load": list(os.getloadavg()), "runs": profiles},
            "sections": sections,
        }
    )


def profile_of(checkout: Path) -> list[list[str]]:
    """Functions and their seconds in a fill by one thread."""
    words = [*FILL, "--threads", "1"] if knows(checkout, ROWS["one"]) else list(FILL)
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "profile.json"
        _timed(checkout, "benchmarks.engine.profiled", [str(report), *words], {})
        return list(json.loads(report.read_text(encoding="utf-8")))


def written(manifest: dict[str, Any]) -> None:
    """Write the manifest and its pages."""
    manifest = write_manifest("speed", manifest)
    write_text("speed.md", page(manifest))
    overview.write()


def main(words: list[str]) -> None:
    """Measure and print."""
    if words[:1] == ["round"] and len(words) == 3:
        round_pack(int(words[1]), Path(words[2]))
        return
    if words[:1] == ["floor"] and len(words) == 2:
        floor(Path(words[1]))
        return
    checkouts = [HERE]
    if "--against" in words:
        at = words.index("--against")
        checkouts.append(Path(words[at + 1]).resolve())
        words = words[:at] + words[at + 2 :]
    runs = [int(word.split("=")[1]) for word in words if word.startswith("runs=")]
    names = [name for name in ROWS if name in words]
    if "profile" in words and len(checkouts) > 1:
        keep_profiles(checkouts, [source_of(checkout) for checkout in checkouts])
        return
    names = names or [name for name in ROWS if name not in SLOW]
    is_kept = len(checkouts) > 1 and "print" not in words
    sources = [source_of(checkout) for checkout in checkouts] if is_kept else []
    print(machine(), f"load {os.getloadavg()[0]:.1f}", flush=True)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for checkout in checkouts:
            one_run(checkout, "draft", Path(folder))
        for name in names:
            at_begin = stamp()
            taken = measured(checkouts, name, runs[0] if runs else RUNS, Path(folder))
            rows += cells_of(name, taken)
            print("\n".join(" ".join(cells) for cells in cells_of(name, taken)), flush=True)
            if is_kept:
                keep(name, taken, sources, at_begin)
    print("\n" + markdown_table(HEADER, rows))


if __name__ == "__main__":
    main(sys.argv[1:])

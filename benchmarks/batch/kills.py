"""Processes killed with -9 at random moments, and what the same command makes of it then."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from benchmarks.batch.wall import line, tiny, workers

Row = list[str]

ROWS = 60

LONGEST_SECONDS = 300.0


def kills(home: Path, times: int) -> Row:
    """Kill the command, a worker of its own, a worker of a cluster, the scheduler, in turn."""
    rng = random.Random(3)
    folder = tiny(home / "kills", ROWS)
    began = time.perf_counter()
    subprocess.run(line(folder, "calm", "--workers", "2", "-q"), check=True)
    seconds = time.perf_counter() - began
    calm = _contents(folder / "calm")
    ways = {"the command": _command, "a worker": _worker, "a worker of a cluster": _far,
            "the scheduler": _scheduler}  # fmt: skip
    wrong = halves = fell = 0
    for number in range(times):
        out = f"run{number}"
        way = ways[list(ways)[number % len(ways)]]
        fell += way(folder, out, rng.uniform(0.1, 1.0) * seconds)
        halves += not _is_part(folder / out, calm)
        done = subprocess.run(line(folder, out, "--workers", "2", "-q"), check=False)
        left = [path for path in (folder / out).iterdir() if path.name.startswith(".")]
        wrong += done.returncode != 0 or _contents(folder / out) != calm or bool(left)
        shutil.rmtree(folder / out)
    return [
        f"kill -9 of {', '.join(ways)}, in turn, at {times} random moments among {ROWS} rows",
        f"{fell} fell among the work; {halves} half files; {wrong} runs whose end, by the same"
        " command, differs from an undisturbed one",
        "the same bytes, no half files",
    ]


def _contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.glob("*.svg")}


def _is_part(folder: Path, calm: dict[str, bytes]) -> bool:
    """Whether all drawings that are there are whole."""
    return all(calm.get(name) == data for name, data in _contents(folder).items())


def _started(command: list[str]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def _ended(process: subprocess.Popen[bytes]) -> None:
    """Wait; a command that never ends is a fault."""
    try:
        process.wait(LONGEST_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        sys.exit("a batch hung after a kill")


def _command(folder: Path, out: str, after: float) -> bool:
    process = _started(line(folder, out, "--workers", "2", "-q"))
    time.sleep(after)
    fell = process.poll() is None
    process.kill()
    _ended(process)
    return fell


def _worker(folder: Path, out: str, after: float) -> bool:
    process = _started(line(folder, out, "--workers", "2", "-q"))
    time.sleep(after)
    found = workers(process.pid)
    for one in found[:1]:
        try:
            os.kill(one, signal.SIGKILL)
        except ProcessLookupError:
            found = []
    _ended(process)
    return bool(found)


def _far(folder: Path, out: str, after: float) -> bool:
    return _clustered(folder, out, after, lambda cluster: cluster.workers[0])


def _scheduler(folder: Path, out: str, after: float) -> bool:
    return _clustered(folder, out, after, lambda cluster: cluster.scheduler)


def _clustered(
    folder: Path, out: str, after: float, of: Callable[..., subprocess.Popen[bytes]]
) -> bool:
    from batches.by_hand import Cluster

    place = folder / f"{out}-cluster"
    place.mkdir()
    cluster = Cluster(place)
    try:
        process = _started(line(folder, out, "--scheduler", cluster.address, "-q"))
        time.sleep(after)
        fell = process.poll() is None
        of(cluster).kill()
        _ended(process)
    finally:
        cluster.close()
        shutil.rmtree(place, ignore_errors=True)
    return fell

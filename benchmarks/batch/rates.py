"""How many rows a minute: one process, one for each core, a cluster, and many by simulation."""

from __future__ import annotations

import csv
import heapq
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks.batch.wall import Made, line, made, processor, wall

Row = list[str]

MANY = 64
"""Workers that are simulated."""

LONG = 1_000
"""Tasks that are simulated."""

WARM = 4
"""Rows of a run before, in which kernels are loaded; what it takes beside work is no row's."""

ALONE = 12
"""Fills one after another, and two at a time, by which the machine itself is judged."""


def rates(home: Path, rows: int) -> list[Row]:
    """Rows of the table: one worker, two, a cluster of two, sixty-four by simulation."""
    from batches.by_hand import Cluster

    folder = wall(home / "rates", rows)
    made(line(wall(home / "warm", WARM), "warm", "--workers", "1", "-q"))
    one = made(line(folder, "one", "--workers", "1", "-q"))
    two = made(line(folder, "two", "--workers", "2", "-q", "--report", str(folder / "two.csv")))
    _check(one, two)
    (folder / "cluster").mkdir()
    cluster = Cluster(folder / "cluster")
    others = [one.pid for one in (cluster.scheduler, *cluster.workers)]
    try:
        marks = [processor(cluster.scheduler.pid)]
        few = made(line(home / "warm", "again", "--scheduler", cluster.address, "-q"))
        marks.append(processor(cluster.scheduler.pid))
        by_hand = made(line(folder, "far", "--scheduler", cluster.address, "-q"), others)
        marks.append(processor(cluster.scheduler.pid))
        _check(few, by_hand)
    finally:
        cluster.close()
    more = rows - WARM
    sender = (by_hand.processor - few.processor) / more
    scheduler = (marks[2] - marks[1] - (marks[1] - marks[0])) / more
    alike = {
        (folder / "one" / path.name).read_bytes()
        == path.read_bytes()
        == (folder / "far" / path.name).read_bytes()
        for path in (folder / "two").glob("*.svg")
    }
    assert alike == {True}
    ratio, far = one.seconds / two.seconds, two.seconds / by_hand.seconds
    return [
        [
            f"{rows:,} recipes of 60 icons, two workers over one",
            f"{ratio:.2f} x: {_rate(rows, one)} and {_rate(rows, two)}; the same bytes",
            "1.9 x",
        ],
        _side_by_side(home / "alone"),
        ["memory of a worker, by quarters of its time", _memory(two), "flat, under 400 MB"],
        [
            "the same by a scheduler and two workers started by hand",
            f"{far:.2f} of that rate: {_rate(rows, by_hand)}; the same bytes",
            ".9",
        ],
        _simulated(folder / "two.csv", sender, scheduler),
    ]


def _check(*runs: Made) -> None:
    for run in runs:
        if run.code != 0:
            sys.exit(run.said)


def _rate(rows: int, run: Made) -> str:
    return f"{60 * rows / run.seconds:.0f} a minute"


def _memory(run: Made) -> str:
    """Of each worker the mean of each quarter of its way; the command itself is the first."""
    _, *ways = run.ways.values()
    told = []
    for way in ways:
        if len(way) >= 8 and max(way) > 100:
            quarters = np.array_split(np.array(way), 4)
            told.append(", ".join(f"{part.mean():.0f}" for part in quarters) + " MB")
    return "; ".join(told)


def _simulated(report: Path, sender: float, scheduler: float) -> Row:
    """Sixty-four workers, by what rows take and what is done for each in one place."""
    with report.open(newline="") as stream:
        seconds = [float(row["seconds"]) for row in csv.DictReader(stream)]
    dealt = max(sender, scheduler, 0.0)
    share = efficiency(np.resize(np.array(seconds), LONG), MANY, dealt)
    return [
        f"{MANY} workers, {LONG:,} recipes, by simulation",
        f"efficiency {share:.2f}; a row takes {np.mean(seconds):.2f} s of a worker,"
        f" {1e3 * sender:.0f} ms of the sender and {1e3 * scheduler:.0f} ms of the scheduler",
        ".9",
    ]


def _side_by_side(home: Path) -> Row:
    """What two processes that know nothing of each other gain on this machine."""
    home.mkdir(parents=True, exist_ok=True)
    fill = [sys.executable, "-m", "packwork", "fill", "builtin:bear", "-n", "60", "-q"]
    lines = [[*fill, "--threads", "1", "-o", str(home / f"{k}.svg")] for k in range(2)]
    seconds = []
    for many in (1, 2):
        began = time.perf_counter()
        for _ in range(ALONE // many):
            processes = [subprocess.Popen(one) for one in lines[:many]]
            for process in processes:
                process.wait()
        seconds.append(time.perf_counter() - began)
    return [
        f"for comparison: {ALONE} fills by processes that know nothing of each other, two at a time"
        " over one at a time",
        f"{seconds[0] / seconds[1]:.2f} x",
        "",
    ]


def efficiency(seconds: Sequence[float] | np.ndarray, workers: int, dealt: float) -> float:
    """Share of the workers' time that is work, if one sender deals tasks one after the other.

    Examples
    --------
    >>> efficiency([1.0] * 8, 4, 0.0), efficiency([1.0] * 2, 2, 0.5)
    (1.0, 0.5)
    """
    free = [0.0] * workers
    sender = 0.0
    for one in seconds:
        sender = max(sender + dealt, heapq.heappop(free))
        heapq.heappush(free, sender + one)
    return float(np.sum(seconds) / (workers * max(free)))

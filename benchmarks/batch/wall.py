"""A wall of small posters: its recipe, its table, and the command that makes it."""

from __future__ import annotations

import csv
import os
import resource
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

CONTAINERS = ("heart", "circle", "bear", "cat")

POSTER = """container = "builtin:{shape}"
items = ["builtin:icons"]
count = %d
seed = "{seed}"
"""

TINY = """container = "{shape}"
items = ["star", "leaf"]
count = "{n}"
epochs = 4
levels = "50"
effort = "draft"
"""

LOOK_SECONDS = 0.25


@dataclass
class Made:
    """What a command took.

    Parameters
    ----------
    seconds
        By the clock.
    code
        Its exit code.
    said
        What it wrote.
    processor
        Seconds of the command itself and of what it has begun.
    ways
        Megabytes of each process over time.
    """

    seconds: float = 0.0
    processor: float = 0.0
    code: int = 0
    said: str = ""
    ways: dict[int, list[float]] = field(default_factory=dict)

    @property
    def peaks(self) -> list[float]:
        """Megabytes of each process at its fullest, the fullest first."""
        return sorted((max(way) for way in self.ways.values()), reverse=True)


def wall(folder: Path, rows: int, count: int = 60) -> Path:
    """Recipe ``poster.toml`` and table ``wall.csv`` in a folder; the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "poster.toml").write_text(POSTER % count, encoding="utf-8")
    with (folder / "wall.csv").open("w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(["name", "shape", "seed"])
        table.writerows([f"p{k:05}", CONTAINERS[k % 4], k] for k in range(rows))
    return folder


def tiny(folder: Path, rows: int, bad_every: int = 0) -> Path:
    """The same with posters that take no time; every so many rows one that cannot be made."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "poster.toml").write_text(TINY, encoding="utf-8")
    with (folder / "wall.csv").open("w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(["name", "shape", "n"])
        for k in range(rows):
            is_bad = bad_every and k % bad_every == bad_every - 1
            table.writerow([f"t{k:05}", CONTAINERS[k % 4], "many" if is_bad else 2 + k % 4])
    return folder


def line(folder: Path, out: str, *options: str) -> list[str]:
    """The command that makes it."""
    return [
        sys.executable, "-m", "packwork", "batch", str(folder / "poster.toml"),
        "--table", str(folder / "wall.csv"), "-o", f"{folder / out}/{{name}}.svg", *options,
    ]  # fmt: skip


def made(command: Sequence[str], others: Sequence[int] = ()) -> Made:
    """Run a command, and look at the memory of it, of its workers and of other processes."""
    found, before = Made(), _of_children()
    began = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    heard: list[str] = []
    assert process.stdout is not None
    reader = threading.Thread(target=lambda: heard.append(process.stdout.read()))
    reader.start()
    while process.poll() is None:
        for number in {process.pid, *children(process.pid), *others}:
            if (size := resident(number)) > 0:
                found.ways.setdefault(number, []).append(size)
        time.sleep(LOOK_SECONDS)
    reader.join()
    found.seconds, found.code = time.perf_counter() - began, process.returncode
    found.said, found.processor = "".join(heard), _of_children() - before
    return found


def children(process: int) -> list[int]:
    """Processes that a process has begun, and those that these have."""
    try:
        text = Path(f"/proc/{process}/task/{process}/children").read_text(encoding="utf-8")
    except OSError:
        return []
    found = [int(word) for word in text.split()]
    return found + [one for child in found for one in children(child)]


def workers(process: int) -> list[int]:
    """Children that make rows: those that are spawned, and not the one that tracks resources."""
    found = []
    for child in children(process):
        try:
            said = Path(f"/proc/{child}/cmdline").read_bytes().decode(errors="replace")
        except OSError:
            continue
        if "spawn_main" in said:
            found.append(child)
    return found


def resident(process: int) -> float:
    """Megabytes that a process has in memory; 0 once it has ended."""
    try:
        text = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    except OSError:
        return 0.0
    sizes = [row.split()[1] for row in text.splitlines() if row.startswith("VmRSS")]
    return int(sizes[0]) / 1e3 if sizes else 0.0


def processor(process: int) -> float:
    """Seconds of the processor that a process has had."""
    words = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def _of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime

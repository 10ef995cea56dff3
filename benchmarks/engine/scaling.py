"""Time and memory by items and pixels: ``packwork bench scaling [SECTION...] [most=N] [short]``.

Whole runs of 10 to 10,000 items, and of 50 to 4,000 px, each in a process of its own, whose peak
of memory is the system's; the share of each stage; what an epoch costs beside the floor, the bytes
that it has to move; all cores; what it takes to begin. Sections: bear, begin, floor, cores, items,
px; all without a word; ``most=N`` leaves out more items than that. After each,
docs/manifests/scaling.json is written, whose other sections stay as they were, the page and the
plots (matplotlib, of ``packwork[bench]``). ``short`` only prints, with fewer items.
"""

from __future__ import annotations

import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")

import json
import resource
import subprocess
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle, islice
from typing import Any

import numpy as np

from benchmarks.engine.scaling_page import draw, page
from benchmarks.kit import frozen
from benchmarks.kit.epochs import epoch_of
from benchmarks.kit.manifests import Manifest, known, stamp, write_manifest, write_text
from benchmarks.kit.measuring import DOCS, machine, timed_in_turn
from benchmarks.pages import overview
from packwork import precompile, uses
from packwork.readers.container import read_container
from packwork.recipe import make_recipe

COUNTS = {10: 5, 30: 5, 100: 5, 300: 5, 1_000: 3, 3_000: 1, 10_000: 1}
"""Items of a whole run, and how many runs."""

SIDES = {50: 5, 100: 5, 200: 5, 400: 5, 800: 5, 1_600: 5, 4_000: 3}
"""Pixels of all epochs of a run of 100 items, and how many runs."""

EPOCHS = 200
FLOORS = (50, 200, 600, 1_200, 2_400, 4_000)
SHORT_COUNTS, SHORT_SIDES = {10: 2, 100: 2}, {50: 2, 400: 2}
WEIGHTS = {"containment": 5.0, "overlap": 5.0, "filling": 1.0, "evenness": 2.0}

BYTES_A_PIXEL = 4 * 4
"""What an epoch without evenness cannot but move, in float32: the buffer that edges deposit in is
read and cleared, the container read, the adjoint written. What edges touch comes on top."""


def child(count: int, side: int, seed: int) -> Manifest:
    """One whole run: seconds of the processor and by stage, the peak of memory, what came out.

    ``side`` 0 takes the default levels and the finish, else all epochs are at that many pixels.
    """
    container = frozen.round_container()
    items = list(islice(cycle(frozen.items()[: len(frozen.ICONS)]), count))
    options = {"levels": str(side), "epochs": EPOCHS, "finish": "none"} if side else {}
    recipe = make_recipe(container="round", items=["-"], seed=seed, **options)
    precompile.warm_up()
    before = _peak()
    began = time.process_time()
    run = uses.fill(recipe, items, container)
    return {
        "seconds": time.process_time() - began,
        "stages": run.seconds,
        "peak_mib": _peak(),
        "before_mib": before,
        "LC": run.metrics.pixel.LC,
        "certified": run.certified,
    }


def _peak() -> float:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)


def in_child(count: int, side: int, seed: int) -> Manifest:
    """The same in a process of its own."""
    words = ["child", str(count), str(side), str(seed)]
    done = subprocess.run(  # noqa: S603
        [sys.executable, "-m", "benchmarks.engine.scaling", *words],
        cwd=DOCS.parent,
        check=True,
        capture_output=True,
        text=True,
    )
    found = dict(json.loads(done.stdout.splitlines()[-1]))
    print(count, side or "default levels", f"{found['seconds']:.2f} s", flush=True)
    return found


def by_cores(count: int = 100) -> Manifest:
    """Runs a minute of one process, and of as many at once as there are cores."""
    cores = os.cpu_count() or 1
    found = {}
    for workers in sorted({1, cores}):
        began = time.perf_counter()
        with ThreadPoolExecutor(workers) as pool:
            done = list(pool.map(lambda seed: in_child(count, 0, seed), range(4 * workers)))
        minutes = (time.perf_counter() - began) / 60
        found[str(workers)] = {
            "runs_a_minute": len(done) / minutes,
            "seconds": [one["seconds"] for one in done],
        }
    return found


def floor(sides: Sequence[int]) -> list[Manifest]:
    """An epoch of 100 icons, the bytes it has to move, and what moving them alone takes."""
    rows = []
    for side in sides:
        source = np.ones((side, side), dtype=np.float32)
        target = np.empty_like(source)
        calls = {
            "epoch": epoch_of({**WEIGHTS, "evenness": 0.0}, 100, side),
            "evenness": epoch_of(WEIGHTS, 100, side),
            "copy": lambda source=source, target=target: np.copyto(target, source),
        }
        times = timed_in_turn(calls, 60 if side < 2_000 else 12)
        # A copy reads and writes: twice the image's bytes.
        rate = 2 * source.nbytes / times["copy"].median
        rows.append(
            {
                "px": side,
                "epoch_ms": times["epoch"].median,
                "evenness_ms": times["evenness"].median,
                "copy_ms": times["copy"].median,
                "floor_ms": BYTES_A_PIXEL * side**2 / rate,
            }
        )
        print(rows[-1], flush=True)
    return rows


def bear(runs: int) -> list[float]:
    """Seconds of what the README promises: a bear of a hundred icons."""
    container = read_container("bear")
    seconds = []
    for seed in range(runs):
        recipe = make_recipe(container="bear", items=["icons"], count=100, seed=seed)
        began = time.process_time()
        uses.fill(recipe, container=container)
        seconds.append(time.process_time() - began)
    return seconds


def begin(runs: int) -> dict[str, list[float]]:
    """Seconds by the clock from a command to its end, of those that place nothing."""
    packwork = [sys.executable, "-m", "packwork"]
    commands = {
        "packwork --version": [*packwork, "--version"],
        "packwork --help": [*packwork, "--help"],
        "packwork fill --help": [*packwork, "fill", "--help"],
        "import packwork": [sys.executable, "-c", "import packwork"],
        "an empty program in Python": [sys.executable, "-c", ""],
    }
    seconds: dict[str, list[float]] = {name: [] for name in commands}
    for _ in range(runs + 1):
        for name, command in commands.items():
            began = time.perf_counter()
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)  # noqa: S603
            seconds[name].append(time.perf_counter() - began)
    return {name: taken[1:] for name, taken in seconds.items()}


def by_items(counts: dict[int, int]) -> Manifest:
    """Whole runs by their number of items."""
    return {str(n): [in_child(n, 0, seed) for seed in range(runs)] for n, runs in counts.items()}


def by_px(sides: dict[int, int]) -> Manifest:
    """Runs of 100 items at one resolution each."""
    return {
        str(side): [in_child(100, side, seed) for seed in range(runs)]
        for side, runs in sides.items()
    }


def sections(is_short: bool, most: int) -> dict[str, Callable[[], Any]]:
    """What there is to be measured, by the word that asks for it."""
    counts = SHORT_COUNTS if is_short else COUNTS
    return {
        "bear": lambda: bear(2 if is_short else 5),
        "begin": lambda: begin(2 if is_short else 15),
        "floor": lambda: floor(FLOORS[:3] if is_short else FLOORS),
        "cores": by_cores,
        "px": lambda: by_px(SHORT_SIDES if is_short else SIDES),
        "items": lambda: by_items({n: runs for n, runs in counts.items() if n <= most}),
    }


def main(words: list[str]) -> None:
    """Measure, print, write the manifest, the plots and the page."""
    if words[:1] == ["child"]:
        print(json.dumps(child(*map(int, words[1:]))))
        return
    print(machine(), flush=True)
    precompile.warm_up()
    given = [int(word.split("=")[1]) for word in words if word.startswith("most=")]
    is_short = "short" in words
    chosen = sections(is_short, given[0] if given else max(COUNTS))
    measured: Manifest = {}
    for name in [name for name in chosen if name in words] or list(chosen):
        measured[name] = {**stamp(), "found": chosen[name]()}
        if not is_short:
            earlier = known().get("scaling", {"sections": {}})["sections"]
            about = {"bytes_a_pixel": BYTES_A_PIXEL, "epochs": EPOCHS}
            manifest = write_manifest("scaling", {**about, "sections": {**earlier, **measured}})
            draw(manifest)
            write_text("scaling.md", page(manifest))
    if is_short:
        print(measured)
    else:
        overview.write()


if __name__ == "__main__":
    main(sys.argv[1:])

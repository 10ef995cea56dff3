"""SVGs as people have them: ``packwork bench files [FOLDER...] [sample=N] [seed=S]``.

Reads every SVG in each folder (and in the folders inside), or N of them drawn by lot, and
prints one row for each: how many were computed from their shapes, traced because of what
they use, traced because their shapes disagreed with the picture or were too many, or
refused; how the ink agrees with resvg's rendering of the file as the gate let it in, both
drawn 500 px long; and how long reading took, in time of the processor, so that a busy
machine does not show. Without folders: the bundled drawings, and a made-up set that uses
every feature. Fetches and writes nothing.
"""

from __future__ import annotations

import logging
import sys
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import numpy as np

from measuring import machine, markdown_table
from packwork.errors import PackworkError
from packwork.readers.regions import clean_union
from packwork.readers.svg.compare import LEAST_AGREEMENT, iou, side_by_side
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import TracedInk
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.solid import solid_twin
from packwork.readers.svg.trace import needs_tracing
from packwork.readers.unfit import naming
from wild import wild_files

SIDE_PX = 500
MIXTURES = 200
SLOWEST = 5

HEADER = [
    "drawings", "files", "by shapes", "traced", "disagreed", "refused",
    f"IoU >= {LEAST_AGREEMENT}", "worst IoU", "median IoU", "median ms", "slowest s",
]  # fmt: skip


@dataclass(frozen=True)
class Reading:
    """What came of one file: how it was read, and why not if it was not."""

    name: str
    how: str
    seconds: float
    agreement: float = np.nan
    problem: str = ""


def read(name: str, data: bytes) -> Reading:
    start = time.process_time()
    try:
        item_of_svg(data, name, name, is_compared=True)
        seconds = time.process_time() - start
        with naming(name):
            how, agreement = judged(data)
    except PackworkError as error:
        return Reading(name, "refused", time.process_time() - start, problem=str(error))
    return Reading(name, how, seconds, agreement)


def judged(data: bytes) -> tuple[str, float]:
    """How the drawing was read, and its ink's agreement with the picture."""
    drawing = read_drawing(data, is_compared=True)
    ink = clean_union(drawing.ink.whole)
    pictures = side_by_side(ink, solid_twin(drawing.root), drawing.page, SIDE_PX)
    if not isinstance(drawing.ink, TracedInk):
        return "by shapes", iou(*pictures)
    return "traced" if needs_tracing(drawing.root) else "disagreed", iou(*pictures)


def row(title: str, readings: list[Reading]) -> list[str]:
    ways = Counter(reading.how for reading in readings)
    shares = np.array([r.agreement for r in readings if r.how != "refused"] or [np.nan])
    times = np.array([reading.seconds for reading in readings])
    return [
        title, str(len(readings)),
        *(str(ways[how]) for how in ("by shapes", "traced", "disagreed", "refused")),
        f"{np.mean(shares >= LEAST_AGREEMENT):.1%}", f"{shares.min():.4f}",
        f"{np.median(shares):.4f}", f"{1e3 * np.median(times):.0f}", f"{times.max():.2f}",
    ]  # fmt: skip


def files_of(folder: Path, sample: int | None, seed: int) -> Iterable[tuple[str, bytes]]:
    found = sorted(file for file in folder.rglob("*.svg") if file.is_file())
    if sample is not None and sample < len(found):
        chosen = np.random.default_rng(seed).choice(len(found), sample, replace=False)
        found = [found[k] for k in sorted(chosen)]
    return ((str(file.relative_to(folder)), file.read_bytes()) for file in found)


def bundled(folder: str) -> Iterable[tuple[str, bytes]]:
    place = resources.files("packwork.bundled").joinpath(folder)
    drawings = sorted((f for f in place.iterdir() if f.name.endswith(".svg")), key=str)
    return ((file.name, file.read_bytes()) for file in drawings)


def groups(folders: list[Path], sample: int | None, seed: int) -> dict[str, list[Reading]]:
    if folders:
        return {
            folder.name: [read(*file) for file in files_of(folder, sample, seed)]
            for folder in folders
        }
    made_up = ((name, text.encode()) for name, text in wild_files(MIXTURES, seed))
    return {
        "bundled icons": [read(*file) for file in bundled("icons")],
        "bundled containers": [read(*file) for file in bundled("containers")],
        "made up": [read(*file) for file in made_up],
    }


def main(arguments: list[str]) -> None:
    """Read, print the table, then what was refused, disagreed or slow."""
    settings = dict(a.split("=") for a in arguments if a.startswith(("sample=", "seed=")))
    folders = [Path(a) for a in arguments if a.partition("=")[0] not in settings]
    sample = int(settings["sample"]) if "sample" in settings else None
    logging.getLogger("packwork").setLevel(logging.ERROR)
    print(machine(), flush=True)
    read_by = groups(folders, sample, int(settings.get("seed", 0)))
    every = [reading for readings in read_by.values() for reading in readings]
    rows = [row(title, readings) for title, readings in read_by.items() if readings]
    print(markdown_table(HEADER, [*rows, row("all", every)] if every else []))
    for reading in every:
        if reading.problem or reading.how == "disagreed" or reading.agreement < LEAST_AGREEMENT:
            print(f"{reading.how}  {reading.agreement:.4f}  {reading.problem or reading.name}")
    for reading in sorted(every, key=lambda r: -r.seconds)[:SLOWEST]:
        print(f"{reading.seconds:.2f} s  {reading.name}")


if __name__ == "__main__":
    main(sys.argv[1:])

"""SVGs as people have them: ``packwork bench files [FOLDER...] [sample=N] [seed=S]``.

Reads every SVG in each folder (and in the folders inside), or N of them drawn by lot, and
prints one row for each: how many show nothing at all, were refused, were computed from
their shapes, traced because of what they use, or traced because their shapes disagreed with
the picture or were too many; how the ink agrees with resvg's rendering of the file as the
gate let it in, both drawn 1,000 px long, as when they are traced; and how long reading took,
in time of the processor, so that a busy machine does not show. Without folders: the bundled
drawings, and a made-up set that uses every feature. Then the table of ``outputs.py``:
twenty icons from those folders, or bundled ones, as they are written. Fetches nothing. With
folders it writes docs/benchmarks/files.md; one that ``npm pack NAME`` gave goes by the name and
version in its package.json.
"""

from __future__ import annotations

import contextlib
import json
import logging
import math
import sys
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

import numpy as np

import packwork as pw
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import machine, markdown_table
from benchmarks.robustness.files_page import PAGE
from benchmarks.robustness.outputs import ICONS, outputs_table
from benchmarks.robustness.wild import wild_files
from packwork.errors import PackworkError
from packwork.raster.drawing import drawn_png
from packwork.readers.gate.door import document, parse_untrusted
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.reading import reading_file
from packwork.readers.regions import clean_union
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import TracedInk
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.resvg import LEAST_AGREEMENT, iou, side_by_side, solid_twin
from packwork.readers.svg.trace import needs_tracing
from packwork.scene.item import Item

SIDE_PX = 1_000
MIXTURES = 200
SLOWEST = 5

WAYS = ("empty", "refused", "by shapes", "traced", "disagreed")

HEADER = [
    "drawings", "files", *WAYS,
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
        with reading_file(name):
            how, agreement = judged(data)
    except PackworkError as error:
        seconds = time.process_time() - start
        how = "refused" if shows_anything(data) else "empty"
        return Reading(name, how, seconds, problem=str(error))
    return Reading(name, how, seconds, agreement)


def judged(data: bytes) -> tuple[str, float]:
    """How the drawing was read, and its ink's agreement with the picture."""
    drawing = read_drawing(data, is_compared=True)
    ink = clean_union(drawing.ink.whole)
    pictures = side_by_side(ink, solid_twin(drawing.root), drawing.page, SIDE_PX)
    if not isinstance(drawing.ink, TracedInk):
        return "by shapes", iou(*pictures)
    return "traced" if needs_tracing(drawing.root) else "disagreed", iou(*pictures)


def shows_anything(data: bytes) -> bool:
    """Whether resvg draws anything of a file; not if it, too, refuses."""
    try:
        with reading_file("file"):
            picture = decode_picture(drawn_png(document(parse_untrusted(data))), SIDE_PX)
    except (PackworkError, ValueError):
        return False
    return bool(picture.pixels[:, :, 3].any())


def row(title: str, readings: list[Reading]) -> list[str]:
    ways = Counter(reading.how for reading in readings)
    shares = np.array([r.agreement for r in readings if not r.problem] or [np.nan])
    times = np.array([reading.seconds for reading in readings])
    return [
        title, str(len(readings)),
        *(str(ways[how]) for how in WAYS),
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


def title_of(folder: Path) -> str:
    """Name and version of a package, else the folder's own name."""
    described = next(iter(sorted(folder.glob("**/package.json"), key=lambda p: len(p.parts))), None)
    if described is None:
        return folder.name
    told = json.loads(described.read_text(encoding="utf-8"))
    return f"{told.get('name', folder.name)} {told.get('version', '')}".strip()


def groups(folders: list[Path], sample: int | None, seed: int) -> dict[str, list[Reading]]:
    if folders:
        return {
            title_of(folder): [read(*file) for file in files_of(folder, sample, seed)]
            for folder in folders
        }
    made_up = ((name, text.encode()) for name, text in wild_files(MIXTURES, seed))
    return {
        "bundled icons": [read(*file) for file in bundled("icons")],
        "bundled containers": [read(*file) for file in bundled("containers")],
        "made up": [read(*file) for file in made_up],
    }


def some_icons(folders: list[Path], seed: int) -> list[Item]:
    """Icons from all folders alike, by lot; without folders, the bundled ones."""
    if not folders:
        return pw.read_items("builtin:icons")[:ICONS]
    icons = []
    for folder in folders:
        for name, data in files_of(folder, math.ceil(ICONS / len(folders)), seed):
            with contextlib.suppress(PackworkError):
                icons.append(item_of_svg(data, Path(name).stem, name, is_compared=True))
    return icons[:ICONS]


def main(arguments: list[str]) -> None:
    """Read, print the table, then what was refused, disagreed or slow; then outputs."""
    settings = dict(a.split("=") for a in arguments if a.startswith(("sample=", "seed=")))
    folders = [Path(a) for a in arguments if a.partition("=")[0] not in settings]
    sample = int(settings["sample"]) if "sample" in settings else None
    seed = int(settings.get("seed", 0))
    logging.getLogger("packwork").setLevel(logging.ERROR)
    print(machine(), flush=True)
    read_by = groups(folders, sample, seed)
    every = [reading for readings in read_by.values() for reading in readings]
    rows = [row(title, readings) for title, readings in read_by.items() if readings]
    drawings = markdown_table(HEADER, [*rows, row("all", every)] if every else [])
    print(drawings)
    for reading in every:
        if reading.problem or reading.how == "disagreed" or reading.agreement < LEAST_AGREEMENT:
            print(f"{reading.how}  {reading.agreement:.4f}  {reading.problem or reading.name}")
    for reading in sorted(every, key=lambda r: -r.seconds)[:SLOWEST]:
        print(f"{reading.seconds:.2f} s  {reading.name}")
    print(flush=True)
    outputs = outputs_table(some_icons(folders, seed))
    print(outputs)
    if folders:
        told = " ".join(word for word in arguments if word.partition("=")[0] in settings)
        write_page("files.md", PAGE, settings=told, drawings=drawings, outputs=outputs)


if __name__ == "__main__":
    main(sys.argv[1:])

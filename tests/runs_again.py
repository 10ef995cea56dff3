"""Runs verbs again and again, and prints how much memory the later runs have added, in MB.

A program of its own: what other tests leave in a process would blur it.
"""

from __future__ import annotations

import gc
import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import shapely
from PIL import Image

import packwork as pw
from packwork.fonts import bundled_file
from packwork.metrics import pixel

PAGE = 4096
SMALL = {"effort": "draft", "levels": "24", "epochs": 2}
WORDS = {"bear": 3, "fox": 2, "owl": 1}
ROWS = {"kg": [4, 1, 2], "name": ["fig", "kiwi", "plum"]}
LARGE_FONT = 16_000_000


def verbs(folder: Path) -> dict[str, Callable[[int], object]]:
    """A small run of each verb, by its seed."""
    for name in ("sea", "sky"):
        Image.new("RGB", (300, 200), "teal").save(folder / f"{name}.jpg")
    # As large as fonts of Chinese: bytes behind its tables are passed over.
    font = folder / "large.ttf"
    font.write_bytes(Path(bundled_file()).read_bytes() + bytes(LARGE_FONT))
    return {
        "fill": lambda k: pw.fill("heart", ["star", "circle"], count=6, seed=k, **SMALL),
        "words": lambda k: pw.words("heart", WORDS, seed=k, **SMALL),
        "words in a large font": lambda k: pw.words(
            "heart", WORDS, seed=k, fonts=(str(font),), **SMALL
        ),
        "fill letters of a large font": lambda k: pw.fill(
            "text:HI", "star", count=6, seed=k, font=str(font), **SMALL
        ),
        "photos": lambda k: pw.photos("heart", folder, seed=k, **SMALL),
        "chart": lambda k: pw.chart("heart", ROWS, size_by="kg", label_by="name", seed=k, **SMALL),
        "pile": lambda k: pw.pile("square", "circle", count=3, size="30%", seed=k),
        "finish": lambda k: pw.finish(pw.fill("heart", "star", count=3, seed=k, **SMALL)),
        "run": lambda k: pw.run({"container": "heart", "items": ["star"], "seed": k, **SMALL}),
        "history": lambda k: pw.fill("heart", "star", count=3, seed=k, history=True, **SMALL),
        "in memory": lambda k: pw.fill(
            shapely.box(0, 0, 30, 20), np.tri(40) > 0, count=3, seed=k, **SMALL
        ).to_dataframe(),
        "save": lambda k: pw.fill("heart", "star", count=3, seed=k, **SMALL).save(
            folder / "a.png", pixels=90
        ),
    }


def resident_mb() -> float:
    """What the process holds in memory, MB."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * PAGE / 1e6


def main(runs: int) -> None:
    """Print MB by verb that the later half of the runs have added."""
    added = {}
    # What is measured by fewer pixels takes as much memory in every run, too.
    pixel.RESOLUTION = 300
    with tempfile.TemporaryDirectory() as folder:
        for name, run in verbs(Path(folder)).items():
            for seed in range(runs - runs // 2):
                run(seed)
            before = resident_mb()
            for seed in range(runs - runs // 2, runs):
                run(seed)
            added[name] = resident_mb() - before
    sys.stdout.write(json.dumps(added))


if __name__ == "__main__":
    main(int(sys.argv[1]))

"""Collages of photographs: ``packwork bench photos [SEED...]``, and ``... poster`` for memory.

Photos are made for the purpose: aspects between 2:3 and 3:2, drawn from a seed. With ``poster`` a
hundred of 24 megapixels are laid out and printed in a process of its own, which needs 0.6 GB of
disk and two minutes; without arguments all is run and docs/benchmarks/photos.md is written.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from PIL import Image

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table, ranged
from packwork import pipeline, precompile, uses

CONTAINERS = ("moon", "fish", "heart")
RATIOS = (2.0, 2**0.5)
SEEDS = (0, 1, 2)
COUNT = 60
GRAIN = 12.0
HEADER = ["container", "largest to smallest", "covered", "overlap", "outside", "turned by",
          "certified", "seconds"]  # fmt: skip
POSTER = ["--canvas", "60x40cm", "--dpi", "300"]

PAGE = """# Photographs

Made by `packwork bench photos` on {date}.
{machine}.

{count} photos of half a megapixel with aspects from 2:3 to 3:2, turned by 15 degrees at most, sizes
free. `--size-ratio 2` lets a photo be half to twice as long as the typical one; 1.41 lets the
largest be twice as long as the smallest. Covered, overlap and outside are exact, shares of the
container; seconds are all but writing (reading, layout, measuring), on a machine that others use
too; median and range of the seeds {seeds}.

{table}

## Memory

A hundred photos of 24 megapixels ({size}), `packwork photos heart ALBUM {poster} -o poster.jpg`:

{memory}
"""


def album(folder: Path, count: int, megapixels: float) -> None:
    """Photos of smooth colours and some grain, as sensors have it."""
    rng = np.random.default_rng(0)
    for k in range(count):
        aspect = np.exp(rng.uniform(np.log(2 / 3), np.log(3 / 2)))
        width, height = (round((megapixels * 1e6 * a) ** 0.5) for a in (aspect, 1 / aspect))
        coarse = rng.integers(30, 226, (7, 7, 3), dtype=np.uint8)
        smooth = Image.fromarray(coarse).resize((width, height), Image.Resampling.BICUBIC)
        tile = rng.normal(0.0, GRAIN, (512, 512)).astype(np.int16)
        grain = np.tile(tile, (height // 512 + 1, width // 512 + 1))[:height, :width, None]
        pixels = np.clip(np.asarray(smooth, dtype=np.int16) + grain, 0, 255).astype(np.uint8)
        Image.fromarray(pixels).save(folder / f"photo-{k:03}.jpg", quality=90)


def rows(folder: Path, seeds: tuple[int, ...]) -> list[list[str]]:
    found = []
    for container in CONTAINERS:
        for ratio in RATIOS:
            runs = [
                uses.fill(uses.photos_recipe(container, str(folder), size_ratio=ratio, seed=seed))
                for seed in seeds
            ]
            found.append(row(container, ratio, runs))
            print("  ".join(found[-1]), flush=True)
    return found


def row(container: str, ratio: float, runs: list[pipeline.Run]) -> list[str]:
    exact = [run.metrics.exact for run in runs]
    turns = [np.degrees(np.abs(run.layout.poses.angle)).max() for run in runs]
    return [
        container,
        f"{ratio**2:.3g}",
        ranged([run.metrics.as_dict()["LC"] for run in runs], ".3f"),
        f"{max(one.overlap for one in exact):.0e}",
        f"{max(one.exceeding for one in exact):.0e}",
        f"{max(turns):.1f}°",
        f"{sum(run.certified for run in runs)} of {len(runs)}",
        ranged([sum(run.seconds.values()) for run in runs], ".1f"),
    ]


def poster(folder: Path) -> list[str]:
    """Coverage, seconds before and while writing, and peak memory of one whole run."""
    out, report = folder / "poster.jpg", folder / "poster.json"
    command = [sys.executable, "-m", "packwork", "photos", "heart", str(folder), *POSTER, "-q",
               "-o", str(out), "--report", str(report)]  # fmt: skip
    subprocess.run(command, check=True)  # noqa: S603 - a command of our own
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 2**20
    results = json.loads(report.read_text(encoding="utf-8"))
    seconds = results["seconds"]
    with Image.open(out) as image:
        size = "{} x {} px".format(*image.size)
    before = seconds["total"] - seconds["write"]
    return [size, f"{results['metrics']['LC']:.3f}", f"{before:.1f}", f"{seconds['write']:.1f}",
            f"{peak:.2f} GiB"]  # fmt: skip


def memory() -> tuple[str, str]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        album(folder, 100, 24.0)
        size = f"{sum(file.stat().st_size for file in folder.iterdir()) / 1e6:.0f} MB of JPEG"
        header = ["poster", "covered", "seconds before writing", "seconds of writing", "peak"]
        return size, markdown_table(header, [poster(folder)])


def main() -> None:
    arguments = sys.argv[1:]
    if arguments == ["poster"]:
        print("\n\n".join(memory()))
        return
    seeds = tuple(map(int, arguments)) or SEEDS
    precompile.warm_up()
    with tempfile.TemporaryDirectory() as name:
        album(Path(name), COUNT, 0.5)
        found = markdown_table(HEADER, rows(Path(name), seeds))
    print(found)
    if not arguments:
        size, used = memory()
        write_page(
            "photos.md", PAGE, count=str(COUNT), seeds=", ".join(map(str, seeds)),
            table=found, size=size, memory=used, poster=" ".join(POSTER),
        )  # fmt: skip


if __name__ == "__main__":
    main()

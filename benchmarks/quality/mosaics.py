"""Mosaics of photographs on a grid: ``packwork bench mosaics [photos=N] [big=PHOTOSxTILES]``.

A face (a sample image of scikit-image) by pieces of other sample images: structural similarity of
lightness at 64 px with the face, beside the same tiles in any order, and mosaicraft where it is
installed. ``big`` measures the time and the memory of one large mosaic
instead.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from benchmarks.quality.meaning import sample_images

PHOTOS = 1_000
TILES = (300, 1_500)
TINT = 0.2
THUMB_PX = 64
TILE_PX = 32

NAMES = (
    "chelsea.png", "coffee.png", "rocket.jpg", "hubble_deep_field.jpg", "motorcycle_left.png",
    "motorcycle_right.png", "ihc.png", "brick.png", "grass.png", "gravel.png", "moon.png",
    "coins.png",
)  # fmt: skip

HEADER = ["tiles", "shown by", "similarity", "in any order"]

PAGE = """# Mosaics of photographs

Made by `packwork bench mosaics` on {date}.
{machine}.

A face of 260 px, from the astronaut of scikit-image {skimage}, by {photos} photographs: pieces
of twelve of its other sample images, some darker, some brighter. "Similarity": structural
similarity of the lightness of mosaic and face, both {thumb} px wide; "in any order" the same of the
same tiles, shuffled. mosaicraft {peer} recolours each tile towards the picture in each of its
presets; ours are as they were taken, unless a tint is named.

{table}
"""


def album(folder: Path, count: int) -> Path:
    """Pieces of sample images, of several exposures."""
    whole = [Image.open(sample_images() / name).convert("RGB") for name in NAMES]
    rng = np.random.default_rng(3)
    folder.mkdir()
    for k in range(count):
        picture = whole[rng.integers(len(whole))]
        side = int(min(picture.size) * rng.uniform(0.25, 0.9))
        left, top = (int(rng.integers(0, s - side + 1)) for s in picture.size)
        piece = picture.crop((left, top, left + side, top + side)).resize((400, 300))
        light = np.asarray(piece, dtype=np.float64) / 255
        light = light ** rng.uniform(0.6, 1.7) * rng.uniform(0.6, 1.25) * rng.uniform(0.85, 1.15, 3)
        pixels = (np.clip(light, 0, 1) * 255).astype(np.uint8)
        Image.fromarray(pixels).save(folder / f"p{k:05}.jpg", quality=88)
    return folder


def thumb(picture: Image.Image) -> np.ndarray:
    small = picture.convert("RGB").resize((THUMB_PX, THUMB_PX), Image.Resampling.BOX)
    return np.asarray(small.convert("L"), dtype=np.float64) / 255


def similarity(picture: Image.Image, face: Path) -> float:
    from skimage.metrics import structural_similarity

    with Image.open(face) as wanted:
        return float(structural_similarity(thumb(picture), thumb(wanted), data_range=1.0))


def shuffled(picture: Image.Image, columns: int) -> Image.Image:
    side = picture.width / columns
    corners = [(round(x * side), round(y * side)) for y in range(columns) for x in range(columns)]
    order = np.random.default_rng(0).permutation(len(corners))
    mixed = Image.new("RGB", picture.size)
    for (left, top), k in zip(corners, order.tolist(), strict=True):
        x, y = corners[k]
        mixed.paste(picture.crop((x, y, x + round(side), y + round(side))), (left, top))
    return mixed


def row(count: int, how: str, file: Path, face: Path, columns: int) -> list[str]:
    with Image.open(file) as picture:
        shown = picture.convert("RGB")
    found = (similarity(shown, face), similarity(shuffled(shown, columns), face))
    told = [f"{count:,}", how, *(f"{one:.3f}" for one in found)]
    print("  ".join(told), flush=True)
    return told


def of_ours(folder: Path, face: Path, photos: Path, count: int, *flags: str) -> Path:
    file = folder / f"ours-{count}{''.join(flags)}.png".replace("%", "")
    subprocess.run(  # noqa: S603
        [sys.executable, "-m", "packwork", "photos", "square", str(photos), "--picture", str(face),
         "-n", str(count), "-q", "--background", "#111", "-o", str(file), "--pixels",
         str(round(count**0.5) * TILE_PX), *flags],
        check=True,
    )  # fmt: skip
    return file


def of_mosaicraft(folder: Path, face: Path, photos: Path, count: int, preset: str) -> Path:
    file = folder / f"peer-{count}-{preset}.jpg"
    subprocess.run(  # noqa: S603
        [sys.executable, "-m", "mosaicraft", "generate", str(face), "-t", str(photos), "-n",
         str(count), "-s", str(TILE_PX), "-p", preset, "-o", str(file)],
        check=True, capture_output=True,
    )  # fmt: skip
    return file


def measured(folder: Path, photos: int) -> list[list[str]]:
    face = folder / "face.png"
    with Image.open(sample_images() / "astronaut.png") as picture:
        picture.convert("RGB").crop((100, 0, 360, 260)).save(face)
    taken, rows = album(folder / "album", photos), []
    has_peer = find_spec("mosaicraft") is not None
    for most in TILES:
        columns = int(most**0.5)
        count = columns**2
        for how, flags in {
            "grid": ("--grid",),
            f"grid, tint {TINT:.0%}": ("--grid", "--tint", f"{TINT:.0%}"),
        }.items():
            file = of_ours(folder, face, taken, count, *flags)
            rows.append(row(count, how, file, face, columns))
        for preset in ("natural", "vivid") if has_peer else ():
            file = of_mosaicraft(folder, face, taken, count, preset)
            rows.append(row(count, f"mosaicraft, {preset}", file, face, columns))
    return rows


def large(folder: Path, photos: int, tiles: int) -> None:
    """Time and memory of one mosaic, printed."""
    face = folder / "face.png"
    with Image.open(sample_images() / "astronaut.png") as picture:
        picture.convert("RGB").crop((100, 0, 360, 260)).save(face)
    taken = album(folder / "album", photos)
    began = time.perf_counter()
    of_ours(folder, face, taken, tiles, "--grid")
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(
        f"{photos:,} photos, {tiles:,} tiles: {time.perf_counter() - began:.0f} s, "
        f"{usage.ru_utime + usage.ru_stime:.0f} s of the processor, {usage.ru_maxrss / 1024:.0f} MB"
    )


def main() -> None:
    asked = dict(word.split("=", 1) for word in sys.argv[1:])
    with tempfile.TemporaryDirectory() as name:
        if "big" in asked:
            photos, tiles = (int(part) for part in asked["big"].split("x"))
            large(Path(name), photos, tiles)
            return
        photos = int(asked.get("photos", PHOTOS))
        rows = measured(Path(name), photos)
    write_page(
        "mosaics.md", PAGE, photos=f"{photos:,}", thumb=str(THUMB_PX),
        skimage=version("scikit-image"),
        peer=version("mosaicraft") if find_spec("mosaicraft") else "is not installed here; it",
        table=markdown_table(HEADER, rows),
    )  # fmt: skip


if __name__ == "__main__":
    main()

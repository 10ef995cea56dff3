"""Pictures that layouts show from afar: ``packwork bench meaning [items=N]``.

Four pictures, shown by icons that take on their colours and by photographs that keep theirs, of as
many as there are places or of four times as many, or take on a part of them. How far the blurred
layout is from the blurred picture, in CIEDE2000, beside the same with colours or photographs in any
order; what is covered and how long it takes, beside the same run without.
"""

from __future__ import annotations

import math
import os
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from importlib.metadata import version
from io import BytesIO
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from PIL import Image

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from packwork import precompile, uses, writers
from packwork.arrays import FloatArray, IntArray
from packwork.assignment.orders import GRID, order_by_colour
from packwork.raster.coverage import coverage
from packwork.readers.target import read_target
from packwork.recipe import Recipe, make_recipe
from packwork.scene.contrast import channels_of, light_of, oklabs_of_light
from packwork.scene.layout import Layout
from packwork.scene.recolour import recoloured
from packwork.scene.swatch import patch_of
from packwork.scene.target import blurred

ITEMS = 400
SIZE_RATIO = 1.5
POOL = 4
"""Photographs for each place, where those are taken that suit."""

TINT = 0.3
"""Of photographs that are tinted."""

CELL = 2
"""Pixels of a part of a photograph on a grid of squares."""

AFAR = 1.0
"""Side of the squares over which is blurred, thrice, over that of an item's share of the canvas."""

HEADER = ["picture", "shown by", "distance", "in any order", "ratio", "of squares", "similarity",
          "covered", "without", "seconds over those without"]  # fmt: skip

PAGE = """# Layouts that mean something

Made by `packwork bench meaning` on {date}.
{machine}.

{items} items in a square, `--size-ratio {ratio}`. "distance": mean CIEDE2000 of the layout's light,
blurred by squares of an item's share of the canvas thrice over, from the picture blurred likewise;
"in any order" the same with the same colours given to icons by chance, or the same photos placed
without the picture (of more than there are places the first), on the same ground. "Of squares": the
ratio of the same photos as squares of one size that fill a grid without gaps, assigned to it and
exchanged. "Similarity": structural similarity of their lightnesses.
Covered is exact; seconds are of the whole run but writing, on a machine that others use too.
Portrait and gradient are drawn by formula, logo and rocket are sample images of scikit-image
{skimage}; photographs are square pieces of other such images, drawn by chance.

{table}
"""


def portrait(size: int = 400) -> FloatArray:
    """A face of ellipses, lit from the left, on a ground from blue to gold; channels 0..1."""
    y, x = np.mgrid[0:size, 0:size] / size
    image = np.stack([0.20 + 0.6 * y, 0.42 + 0.3 * y, 0.70 - 0.4 * y], axis=2)
    shade = (1.12 - 0.7 * np.clip(x - 0.3, 0, 0.5))[..., None]

    def put(cx: float, cy: float, a: float, b: float, colour: tuple[float, float, float]) -> None:
        inside = ((x - cx) / a) ** 2 + ((y - cy) / b) ** 2 < 1
        image[inside] = (np.array(colour) * shade)[inside]

    put(0.5, 1.05, 0.46, 0.30, (0.50, 0.08, 0.22))
    put(0.5, 0.42, 0.31, 0.37, (0.16, 0.08, 0.06))
    put(0.5, 0.75, 0.10, 0.16, (0.72, 0.50, 0.40))
    put(0.5, 0.47, 0.22, 0.29, (0.93, 0.69, 0.54))
    put(0.5, 0.20, 0.24, 0.12, (0.16, 0.08, 0.06))
    for side in (-1, 1):
        put(0.5 + side * 0.1, 0.385, 0.07, 0.02, (0.2, 0.1, 0.08))
        put(0.5 + side * 0.1, 0.45, 0.065, 0.04, (1.0, 1.0, 1.0))
        put(0.5 + side * 0.1, 0.45, 0.033, 0.038, (0.1, 0.25, 0.35))
        put(0.5 + side * 0.13, 0.56, 0.045, 0.03, (0.95, 0.58, 0.48))
    put(0.5, 0.54, 0.022, 0.05, (0.82, 0.55, 0.42))
    put(0.5, 0.645, 0.095, 0.036, (0.78, 0.16, 0.20))
    return np.clip(image, 0, 1)


def gradient(size: int = 400) -> FloatArray:
    """From dark blue at the top left over red to yellow at the bottom right."""
    y, x = np.mgrid[0:size, 0:size] / size
    along = (x + y) / 2
    stops = np.array([[0.05, 0.1, 0.4], [0.8, 0.2, 0.3], [1.0, 0.9, 0.3]])
    return np.stack([np.interp(along, [0, 0.5, 1], stops[:, k]) for k in range(3)], axis=2)


def sample_images() -> Path:
    """The folder of scikit-image's sample images."""
    import skimage

    return Path(skimage.__file__).parent / "data"


def pictures(folder: Path) -> dict[str, Path]:
    """The four, as files."""
    samples = sample_images()
    made: dict[str, Callable[[], FloatArray]] = {"portrait": portrait, "gradient": gradient}
    for name, draw in made.items():
        pixels = np.rint(255 * draw()).astype(np.uint8)
        Image.fromarray(pixels).save(folder / f"{name}.png")
    return {
        **{name: folder / f"{name}.png" for name in made},
        "logo": samples / "logo.png",
        "rocket": samples / "rocket.jpg",
    }


def album(folder: Path, count: int) -> Path:
    """Square pieces of sample images."""
    samples = sample_images()
    names = ["astronaut.png", "coffee.png", "chelsea.png", "hubble_deep_field.jpg", "ihc.png",
             "motorcycle_left.png", "retina.jpg", "color.png", "moon.png", "camera.png",
             "cell.png", "page.png", "grass.png", "horse.png"]  # fmt: skip
    whole = [Image.open(samples / name).convert("RGB") for name in names]
    rng = np.random.default_rng(0)
    folder.mkdir()
    for k in range(count):
        image = whole[k % len(whole)]
        side = int(rng.integers(40, 160))
        left, top = (int(rng.integers(0, max(s - side, 1))) for s in image.size)
        piece = image.crop((left, top, left + side, top + side)).resize((96, 96))
        piece.save(folder / f"piece-{k:03}.png")
    return folder


def afar(light: FloatArray, count: int) -> FloatArray:
    for _ in range(3):
        light = blurred(light, AFAR, count)
    return light


def seen(layout: Layout, shape: tuple[int, ...], ground: str) -> FloatArray:
    """Light of a layout on a ground, in as many pixels as the target has."""
    options = writers.write_options(background=ground, pixels=4 * max(shape))
    with Image.open(BytesIO(writers.encoded(layout, "a.png", options))) as picture:
        pixels = np.asarray(picture.convert("RGB"), dtype=np.float64) / 255
    light = light_of(pixels)
    channels = [
        np.asarray(Image.fromarray(light[..., k].astype(np.float32)).resize(
            shape[1::-1], Image.Resampling.BOX)) for k in range(3)
    ]  # fmt: skip
    return np.stack(channels, axis=2).astype(np.float64)


def compared(layout: Layout, file: Path, ground: str) -> tuple[float, float]:
    """Mean colour distance and structural similarity of a layout and a picture, seen from afar."""
    from skimage.color import deltaE_ciede2000, rgb2lab
    from skimage.metrics import structural_similarity

    target = read_target(file, layout.container)
    outline = layout.container.outline
    room = coverage(outline.points * target.px_per_cu, outline.starts, target.light.shape[:2])
    count = len(layout.items)
    wanted, shown = (
        channels_of(afar(light, count))
        for light in (target.light, seen(layout, target.light.shape, ground))
    )
    first, second = rgb2lab(wanted), rgb2lab(shown)
    inside = room > 0.5
    away = float(deltaE_ciede2000(first, second)[inside].mean())
    return away, float(structural_similarity(first[..., 0], second[..., 0], data_range=100.0))


def of_squares(layout: Layout, file: Path) -> float:
    """Ratio of the photos of a layout on a grid of squares, none of which has a form to heed."""
    from scipy.optimize import linear_sum_assignment
    from skimage.color import deltaE_ciede2000, rgb2lab

    many = math.isqrt(len(layout.items))
    items = layout.items[: many**2]
    px, target = GRID * CELL, read_target(file, layout.container)
    wanted = np.stack([
        np.asarray(Image.fromarray(target.light[..., k].astype(np.float32)).resize(
            (many * px, many * px), Image.Resampling.BOX)) for k in range(3)
    ], axis=2).astype(np.float64)  # fmt: skip
    patches = np.array([patch_of(item, GRID) for item in items])

    def shown(order: IntArray) -> FloatArray:
        parts = patches[order].reshape(many, many, GRID, GRID, 3).transpose(0, 2, 1, 3, 4)
        fine = parts.reshape(many * GRID, many * GRID, 3)
        return np.repeat(np.repeat(fine, CELL, axis=0), CELL, axis=1)

    def away(order: IntArray) -> float:
        first, second = (
            rgb2lab(channels_of(np.clip(afar(one, many**2), 0, 1)))
            for one in (wanted, shown(order))
        )
        return float(deltaE_ciede2000(first, second).mean())

    def at_cells(light: FloatArray) -> FloatArray:
        return light.reshape(many, px, many, px, 3).mean(axis=(1, 3)).reshape(-1, 3)

    own, asked = oklabs_of_light(patches.mean(axis=1)), oklabs_of_light(at_cells(wanted))
    order = linear_sum_assignment(((own[None] - asked[:, None]) ** 2).sum(axis=2))[1]
    steps = np.arange(many) + 0.5
    x, y = (one.ravel() for one in np.meshgrid(steps, steps))
    rng = np.random.default_rng(0)
    blurs = 3
    order = order_by_colour(
        order, np.column_stack([x, y, np.zeros(many**2)]), np.ones((many**2, 2)), patches,
        at_cells(afar(wanted, many**2)), np.zeros((many**2, 0)),
        AFAR * math.sqrt(blurs / 12), rng,
    )  # fmt: skip
    chance = np.mean([away(rng.permutation(many**2)) for _ in range(5)])
    return away(order) / float(chance)


def row(name: str, file: Path, how: str, recipe: Recipe) -> list[str]:
    plain = uses.fill(recipe.model_copy(update={"tint": None}))
    run = uses.fill(recipe.model_copy(update={"picture": str(file)}))
    layout = run.layout
    distance, similarity = compared(layout, file, layout.ground)
    by_chance = _shuffled(layout) if how == "icons" else plain.layout
    chance, _ = compared(by_chance, file, layout.ground)
    seconds = [sum(one.seconds.values()) for one in (run, plain)]
    covered = [one.metrics.exact.coverage for one in (run, plain)]
    assert run.certified
    squares = "" if how == "icons" or "tint" in how else f"{of_squares(layout, file):.2f}"
    return [name, how, f"{distance:.1f}", f"{chance:.1f}", f"{distance / chance:.2f}", squares,
            f"{similarity:.2f}", *(f"{one:.3f}" for one in covered),
            f"{seconds[0] / seconds[1]:.2f}"]  # fmt: skip


def _shuffled(layout: Layout) -> Layout:
    """The same layout, its items' colours given to them by chance."""
    from packwork.scene.swatch import mean_light

    order = np.random.default_rng(0).permutation(len(layout.items))
    hexes = ["#{:02x}{:02x}{:02x}".format(*np.rint(255 * channels_of(mean_light(one))).astype(int))
             for one in layout.items]  # fmt: skip
    items = [recoloured(one, hexes[k]) for one, k in zip(layout.items, order, strict=True)]
    return replace(layout, items=tuple(items))


def main() -> None:
    asked = dict(word.split("=", 1) for word in sys.argv[1:])
    count = int(asked.get("items", ITEMS))
    precompile.warm_up()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files, photos = pictures(folder), album(folder / "album", count)
        icons = make_recipe(container="square", count=count, size_ratio=SIZE_RATIO)
        pieces = uses.photos_recipe("square", str(photos), size_ratio=SIZE_RATIO)
        tinted = pieces.model_copy(update={"tint": TINT})
        many = album(folder / "many", POOL * count)
        best = uses.photos_recipe("square", str(many), size_ratio=SIZE_RATIO, count=count)
        shown = {
            "icons": icons, "photos": pieces, f"photos, the best of {POOL} times as many": best,
            f"photos, tint {TINT:.0%}": tinted,
        }  # fmt: skip
        for how, recipe in shown.items():
            if how not in asked.get("by", how):
                continue
            for picture, file in files.items():
                rows.append(row(picture, file, how, recipe))
                print("  ".join(rows[-1]), flush=True)
    table = markdown_table(HEADER, rows)
    write_page(
        "meaning.md", PAGE, items=str(count), ratio=f"{SIZE_RATIO:g}",
        skimage=version("scikit-image"), table=table,
    )  # fmt: skip


if __name__ == "__main__":
    main()

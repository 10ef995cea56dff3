"""The colour image beside the density: ``packwork bench colour``.

Prints the tables and writes them to docs/benchmarks/colour.md. One process, one thread. Times are
medians with quartiles of blocks of calls, which are made in turn with what they are compared with.
"""

from __future__ import annotations

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from collections.abc import Callable
from itertools import cycle, islice

import numpy as np

import packwork as pw
from benchmarks.kit import frozen
from benchmarks.kit.epochs import EDGES, spread_out
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import Timing, markdown_table, timed
from packwork import precompile, threads
from packwork.arrays import FloatArray, Image
from packwork.raster.colour import ColourImage
from packwork.raster.coverage import Rasteriser
from packwork.scene.contrast import channels_of
from packwork.scene.item import FlatArt
from packwork.scene.swatch import mean_lights
from packwork.solve.outlines import Ensemble, simplify_at_scales

COUNTS = (10, 100, 1_000)
RESOLUTIONS = (200, 600, 1_200)
BLOCKS, BLOCK_S = 9, 0.1
"""Blocks of calls that are timed, and seconds of each."""

TARGET = 3.0
"""Largest ratio that was aimed at, of 100 items at 600 px."""

HEADER = ["items", "px", "edges", "density", "colour", "ratio", "by colours too", "ratio"]
PULLED_HEADER = ["seed", "score without", "with", "covered without", "with", "certified"]
SEEDS = (0, 1, 2)
RUN = {"count": 60, "effort": "draft"}
WEIGHT = 5.0

PAGE = """# The colour image

Made by `packwork bench colour` on {date}.
{machine}.

## What it costs

Milliseconds, medians with quartiles of blocks of calls in turn, float32, one thread, on a machine
that others use too; ratios are the medians of those in each block. "Density" is the raster part of
an epoch: the sweep, the image, the pullback to the points. "Colour" is what a loss of colours adds
to it: the image of three channels, from the record of the same sweep, and its pullback to the
points. "By colours too" has the derivatives by the items' colours besides, which a run does not
need. Outlines are as coarse as each level needs, as in a run. Aimed at: {target} times the
density's at most, of 100 items at 600 px. Few items on a large image cost most beside the density:
there all time goes into writing pixels, which are three numbers each.

{cost}

## What it does

A loss by hand that wants red on the left and blue on the right (its adjoint is a ramp), at a weight
of {weight}: {count} stars, every other one red or blue, in a square. "Score" is the loss of the
finished layout, less is better; covered is exact.

{pulled}
"""


def cost_row(count: int, resolution: int) -> list[str]:
    """Density and colours of so many icons at one resolution."""
    container = frozen.round_container()
    outlines = list(islice(cycle(frozen.outlines_of(EDGES)), count))
    poses = spread_out(outlines, container)
    px_per_cu = resolution / container.side
    ensemble = Ensemble(simplify_at_scales(outlines, poses.scale, px_per_cu))
    points = ensemble.place(poses, px_per_cu)
    rasteriser = Rasteriser((resolution, resolution))
    image = ColourImage(rasteriser)
    rng = np.random.default_rng(0)
    colours, background = ensemble.per_ring(rng.random((count, 3))), np.ones(3)
    pull = rng.normal(size=(resolution, resolution)).astype(np.float32)
    pulls = rng.normal(size=(resolution, resolution, 3)).astype(np.float32)
    seen: Image = np.empty_like(pull)
    coloured: Image = np.empty_like(pulls)
    by_points = np.zeros_like(points)

    def density() -> None:
        rasteriser.sweep(points, ensemble.ring_starts)
        rasteriser.density(seen)
        rasteriser.pullback(pull)

    def colour() -> None:
        image.render(colours, background, coloured)
        image.pullback(pulls, by_points)

    def by_colours() -> None:
        colour()
        image.by_colours(pulls)

    calls: dict[str, Callable[[], object]] = {
        "density": density, "colour": colour, "by colours": by_colours,
    }  # fmt: skip
    # In blocks, as epochs follow each other in a run; blocks in turn, as machines drift.
    blocks = [{name: timed(call, BLOCK_S).median for name, call in calls.items()}
              for _ in range(BLOCKS)]  # fmt: skip
    times = {name: Timing.of([block[name] for block in blocks]) for name in calls}
    ratios = [
        float(np.median([block[name] / block["density"] for block in blocks]))
        for name in ("colour", "by colours")
    ]
    return [
        f"{count:,}", f"{resolution:,}", f"{len(points):,}", str(times["density"]),
        str(times["colour"]), f"{ratios[0]:.2f}", str(times["by colours"]), f"{ratios[1]:.2f}",
    ]  # fmt: skip


def warm_left(density: Image, colour: Image, container: Image) -> pw.Term:
    """Red wanted on the left, blue on the right."""
    side = np.linspace(-1, 1, density.shape[1], dtype=density.dtype)
    adjoint = np.zeros_like(colour)
    adjoint[..., 0], adjoint[..., 2] = side / density.size, -side / density.size
    return pw.Term(float(np.sum(adjoint * colour)), np.zeros_like(density), adjoint)


def score(layout: pw.Layout) -> float:
    """Loss of a finished layout, of its true outlines at 600 px, white behind."""
    px_per_cu = 600 / layout.container.side
    points = np.vstack([outline.points for outline in layout.outlines]) * px_per_cu
    sizes = [len(ring) for outline in layout.outlines for ring in outline.rings]
    own: FloatArray = channels_of(mean_lights(layout.items))
    per_ring = np.repeat(own, [len(outline.rings) for outline in layout.outlines], axis=0)
    image = pw.render_colour(points, np.cumsum([0, *sizes]), per_ring, (600, 600), 1.0)
    return warm_left(image[..., 0], image, image[..., 0]).value


def pulled_row(seed: int) -> list[str]:
    """The same run without the loss and with it."""
    (star,) = pw.read_items("star")
    items = [pw.Item(star.name, "", star.outline, star.ink, FlatArt(c)) for c in ("red", "blue")]
    plain = pw.fill("square", items, seed=seed, **RUN)  # type: ignore[arg-type]
    pulled = pw.fill("square", items, seed=seed, losses={warm_left: WEIGHT}, **RUN)  # type: ignore[arg-type]
    covered = [f"{layout.metrics['exact']['LC']:.3f}" for layout in (plain, pulled)]
    certified = "both" if plain.certified and pulled.certified else "no"
    return [str(seed), f"{score(plain):.3f}", f"{score(pulled):.3f}", *covered, certified]


def main() -> None:
    precompile.warm_up()
    cost = []
    with threads.using(1):
        for count in COUNTS:
            for resolution in RESOLUTIONS:
                cost.append(cost_row(count, resolution))
                print("  ".join(cost[-1]), flush=True)
    pulled = []
    for seed in SEEDS:
        pulled.append(pulled_row(seed))
        print("  ".join(pulled[-1]), flush=True)
    write_page(
        "colour.md", PAGE, target=f"{TARGET:g}", weight=f"{WEIGHT:g}",
        count=str(RUN["count"]), cost=markdown_table(HEADER, cost),
        pulled=markdown_table(PULLED_HEADER, pulled),
    )  # fmt: skip


if __name__ == "__main__":
    main()

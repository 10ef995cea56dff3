"""The engine's figures: ``packwork bench engine``.

Prints the tables and writes them to docs/benchmarks.md. One process, one thread. Times
are medians with quartiles; the running sum they are compared with is
``np.cumsum(image, axis=1, out=buffer)`` on a float32 image of the same size.
"""

from __future__ import annotations

import datetime
import resource
import sys
from itertools import cycle, islice
from pathlib import Path

import numpy as np

import frozen
from measuring import Timing, machine, markdown_table, timed, timed_in_turn
from packwork import pipeline
from packwork.geometry.outline import Outline
from packwork.losses.linear import LinearAdjoint, LinearWeights
from packwork.raster.coverage import Rasteriser
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_at
from packwork.solve.level import Level
from packwork.solve.motion import Motion
from packwork.solve.options import SolveOptions
from packwork.start.first_poses import first_poses
from packwork.start.options import StartOptions
from packwork.start.sizes import nominal_scales

WEIGHTS = LinearWeights(5.0, 5.0, 1.0)
RESOLUTIONS = (50, 200, 600, 1_200, 2_400)
COUNTS = (10, 100, 1_000, 10_000)
EDGES = 6_000


QUALITY_HEADER = ["container", "LC", "OO", "EA", "exact OO", "L-nU", "s"]
STAGE_HEADER = [
    "items", "px", "edges", "forward", "losses", "backward", "epoch", "running sum", "ratio",
]  # fmt: skip

PAGE = """# Benchmarks

Made by `packwork bench engine` on {date}.
{machine}.

Times are medians with their quartiles in milliseconds. "Running sum" is
`np.cumsum(image, axis=1, out=buffer)` on a float32 image of the same size, in the same
process, in turn with what it is compared with.

## Targets

{targets}

## The frozen set at 200 epochs (`--effort draft`)

100 items from the 32 bundled icons, eight of them thin hand-drawn strokes; mean of seeds
0 to 2 and half the range of LC. OO and EA by pixels at 1,200 px, "exact OO" by polygons.

{draft}

## The frozen set at 800 epochs (`--effort normal`)

{normal}

## Milliseconds per stage

Outlines are as coarse as each level needs, as in a run.

{stages}
"""


def spread_out(outlines: list[Outline], container: Container) -> Poses:
    """Items of equal area, covering 0.7 of the container, placed by the start."""
    areas = np.array([o.area for o in outlines])
    scales = nominal_scales(areas, np.ones(len(outlines)), 0.7 * container.outline.area)
    rng = np.random.default_rng(0)
    angles = rng.uniform(-np.pi, np.pi, len(outlines))
    return first_poses(container, outlines, scales, angles, StartOptions(), rng).poses


def running_sum(shape: tuple[int, int]):
    image = np.random.default_rng(0).random(shape, dtype=np.float32)
    buffer = np.empty_like(image)
    return lambda: np.cumsum(image, axis=1, out=buffer)


def stage_rows() -> list[list[str]]:
    """Forward, losses, backward per resolution and count."""
    base = frozen.outlines_of(EDGES)
    container = frozen.round_container()
    rows = []
    for count in COUNTS:
        outlines = list(islice(cycle(base), count))
        poses = spread_out(outlines, container)
        for resolution in RESOLUTIONS:
            seen = seen_at(outlines, poses.scale, resolution / container.side)
            level = Level(container, seen, resolution)
            rows.append(_stages(level, poses, count, sum(len(o.points) for o in seen)))
            print("  ".join(rows[-1]), flush=True)
    return rows


def _stages(level: Level, poses: Poses, count: int, edges: int) -> list[str]:
    rasteriser = level.rasteriser
    linear = LinearAdjoint(level.container_image)
    adjoint = linear(rasteriser.accumulation, WEIGHTS)

    def forward() -> None:
        points = level.ensemble.place(poses, level.px_per_cu)
        rasteriser.sweep(points, level.ensemble.ring_starts)

    def losses() -> None:
        linear(rasteriser.accumulation, WEIGHTS)

    def backward() -> None:
        by_points = rasteriser.pullback(adjoint, WEIGHTS.containment)
        level.ensemble.gather(by_points, poses, level.px_per_cu)

    rounds = 60 if count * level.resolution < 2_000_000 else 12
    times = timed_in_turn(
        {
            "forward": forward,
            "losses": losses,
            "backward": backward,
            "sum": running_sum(rasteriser.shape),
        },
        rounds,
    )
    total = sum(times[part].median for part in ("forward", "losses", "backward"))
    return [
        f"{count:,}", f"{level.resolution:,}", f"{edges:,}",
        str(times["forward"]), str(times["losses"]), str(times["backward"]),
        f"{total:.3g}", str(times["sum"]), f"{total / times['sum'].median:.2f}",
    ]  # fmt: skip


def whole_epoch() -> tuple[Timing, Timing, float, int]:
    """One epoch of the solver, poses to poses, on 100 icons of about 6,000 edges."""
    outlines = frozen.outlines_of(EDGES)
    container = frozen.round_container()
    poses = spread_out(outlines, container)
    level = Level(container, outlines, 600)
    motion = Motion(poses, poses.scale, container.side, SolveOptions())
    summing = running_sum(level.rasteriser.shape)

    def epoch() -> None:
        motion.follow(level.gradient(motion.poses, WEIGHTS), 1e-4)

    ratios, epochs, sums = [], [], []
    for _ in range(15):
        # In blocks, as epochs follow each other in a run; blocks in turn, as machines drift.
        epochs.append(timed(epoch, seconds=0.15).median)
        sums.append(timed(summing, seconds=0.1).median)
        ratios.append(epochs[-1] / sums[-1])
    edges = sum(len(o.points) for o in outlines)
    return _of(epochs), _of(sums), float(np.median(ratios)), edges


def _of(samples: list[float]) -> Timing:
    return Timing(*(float(v) for v in np.percentile(samples, [50, 25, 75])))


def closed_curves() -> Timing:
    """2,048 closed curves of 32 edges, radius 30 px, on 2,040 x 1,344 px, both ways."""
    rng = np.random.default_rng(0)
    t = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    wobble = 30 * (1 + 0.15 * np.sin(5 * t[None, :] + rng.uniform(0, 6, (2_048, 1))))
    centres = rng.uniform([40, 40], [2_000, 1_304], (2_048, 2))
    unit = np.column_stack([np.cos(t), np.sin(t)])
    points = (centres[:, None, :] + wobble[:, :, None] * unit).reshape(-1, 2)
    starts = np.arange(0, 2_048 * 32 + 1, 32)
    rasteriser = Rasteriser((1_344, 2_040))
    density = np.empty(rasteriser.shape, dtype=np.float32)
    adjoint = rng.random(rasteriser.shape, dtype=np.float32)

    def both() -> None:
        rasteriser.sweep(points, starts)
        rasteriser.density(density)
        rasteriser.pullback(adjoint)

    return timed(both, seconds=4.0)


def budget_rows(epochs: int) -> tuple[list[list[str]], list[float]]:
    """Quality and time of 50+200+600 on the frozen set, start included."""
    items = frozen.items()
    rows, means = [], []
    pipeline.warm_up()
    for make in frozen.CONTAINERS:
        container = make()
        taken = []
        for seed in frozen.SEEDS:
            recipe = make_recipe(
                container="frozen", items=["icons"], seed=seed, sizes="free", epochs=epochs
            )
            run = pipeline.fill(recipe, items, container)
            seconds = run.seconds["start"] + run.seconds["levels"]
            m = run.metrics
            taken.append(
                [m.pixel.LC, m.pixel.OO, m.pixel.EA, m.pixel.LnU, seconds, m.exact.overlap]
            )
        middle = np.mean(taken, axis=0)
        means.append(middle)
        rows.append(_quality_row(container.name, middle, np.ptp(taken, axis=0)))
        print("  ".join(rows[-1]), flush=True)
    mean = np.mean(means, axis=0)
    rows.append(_quality_row("mean", mean, np.zeros(6)))
    print("  ".join(rows[-1]), flush=True)
    return rows, [float(v) for v in mean]


def _quality_row(name: str, m: np.ndarray, spread: np.ndarray) -> list[str]:
    return [
        name, f"{m[0]:.3f} ± {spread[0] / 2:.3f}", f"{m[1]:.1e}", f"{m[2]:.1e}",
        f"{m[5]:.1e}", f"{m[3]:.1f}", f"{m[4]:.2f}",
    ]  # fmt: skip


def main() -> None:
    """Measure, print, write docs/benchmarks.md."""
    print(machine(), flush=True)
    epoch, summed, ratio, edges = whole_epoch()
    print(f"epoch {epoch} ms, running sum {summed} ms, ratio {ratio:.2f}, {edges} edges")
    curves = closed_curves()
    print(f"2,048 curves: {curves} ms", flush=True)
    draft, draft_mean = budget_rows(200)
    normal, _ = budget_rows(800)
    stages = stage_rows()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    peak_mib = peak / (1024**2 if sys.platform == "darwin" else 1024)
    targets = [
        [
            f"one whole epoch, poses to poses, 100 icons of {edges:,} edges, 600 px",
            f"{epoch} ms, {ratio:.2f} x the running sum ({summed} ms)",
            "0.6 x",
        ],
        [
            "2,048 closed curves of 32 edges, radius 30 px, 2,040 x 1,344 px, both ways",
            f"{curves} ms",
            "15 ms",
        ],
        [
            "200 epochs, 50+200+600 px, 100 items, start included",
            f"{draft_mean[4]:.2f} s",
            "0.4 s",
        ],
        [
            "quality at that budget, sizes free",
            f"LC {draft_mean[0]:.3f}, OO {draft_mean[1]:.1e}, EA {draft_mean[2]:.1e}",
            "LC 0.77, OO 3e-4, EA 1.5e-4",
        ],
        [
            "peak memory of this benchmark, 10,000 items at 2,400 px included",
            f"{peak_mib:.0f} MiB",
            "1,024 MiB",
        ],
    ]
    text = PAGE.format(
        date=datetime.date.today().isoformat(),
        machine=machine(),
        targets=markdown_table(["what", "measured", "target"], targets),
        draft=markdown_table(QUALITY_HEADER, draft),
        normal=markdown_table(QUALITY_HEADER, normal),
        stages=markdown_table(STAGE_HEADER, stages),
    )
    target = Path(__file__).resolve().parent.parent / "docs" / "benchmarks.md"
    target.write_text(text, encoding="utf-8")
    print(f"wrote {target}")


if __name__ == "__main__":
    main()

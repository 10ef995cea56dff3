"""The engine's figures: ``packwork bench engine``.

Prints the tables and writes them to docs/benchmarks/engine.md. One process, one thread. Times
are medians with quartiles, of the processor; the running sum they are compared with is
``np.cumsum(image, axis=1, out=buffer)`` on a float32 image of the same size.
"""

from __future__ import annotations

import resource
import sys
from itertools import cycle, islice

import numpy as np

from benchmarks.kit import frozen
from benchmarks.kit.epochs import EDGES, RECALL, EpochTiming, frozen_edges, spread_out, timed_epochs
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import (
    Timing,
    machine,
    markdown_table,
    running_sum,
    timed,
    timed_in_turn,
)
from benchmarks.kit.runs import EA, EXACT_OO, LC, LNU, OO, SECONDS, on_frozen_set
from packwork import precompile
from packwork.arrays import FloatArray
from packwork.losses.image import FusedAdjoint, FusedWeights
from packwork.raster.coverage import Rasteriser
from packwork.scene.pose import Poses
from packwork.solve.level import Level
from packwork.solve.outlines import simplify_at_scales

WEIGHTS = {"containment": 5.0, "overlap": 5.0, "filling": 1.0, "evenness": 2.0}
RESOLUTIONS = (50, 200, 600, 1_200, 2_400)
COUNTS = (10, 100, 1_000, 10_000)

QUALITY_HEADER = ["container", "LC", "OO", "EA", "exact OO", "L-nU", "s"]
STAGE_HEADER = [
    "items", "px", "edges", "forward", "losses", "backward", "epoch", "running sum", "ratio",
]  # fmt: skip

PAGE = """# The engine

Made by `packwork bench engine` on {date}.
{machine}.

Times are medians with their quartiles in milliseconds of the processor. "Running sum" is
`np.cumsum(image, axis=1, out=buffer)` on a float32 image of the same size, in the same
process, in turn with what it is compared with.

## Targets

{targets}

## The frozen set at 200 epochs (`--effort draft`)

100 items from 32 bundled icons, eight of them thin hand-drawn strokes; mean of seeds 0 to
2 and half the range of LC, median of the processor's seconds. OO and EA by pixels at 1,200 px,
"exact OO" by polygons.

{draft}

## The frozen set at 800 epochs (`--effort normal`)

{normal}

## Milliseconds per stage

Outlines are as coarse as each level needs, as in a run; losses with evenness.

{stages}
"""


def stage_rows() -> list[list[str]]:
    """Forward, losses, backward per resolution and count."""
    base = frozen.outlines_of(EDGES)
    container = frozen.round_container()
    rows = []
    for count in COUNTS:
        outlines = list(islice(cycle(base), count))
        poses = spread_out(outlines, container)
        for resolution in RESOLUTIONS:
            seen = simplify_at_scales(outlines, poses.scale, resolution / container.side)
            level = Level(container, seen, resolution)
            rows.append(_stages(level, poses, count, sum(len(o.points) for o in seen)))
            print("  ".join(rows[-1]), flush=True)
    return rows


def _stages(level: Level, poses: Poses, count: int, edges: int) -> list[str]:
    rasteriser = level.rasteriser
    fused, weights = FusedAdjoint(level.container_image, count), FusedWeights(**WEIGHTS)
    adjoint = fused(rasteriser.accumulation, weights)

    def forward() -> None:
        points = level.ensemble.place(poses, level.px_per_cu)
        rasteriser.sweep(points, level.ensemble.ring_starts)

    def losses() -> None:
        fused(rasteriser.accumulation, weights)

    def backward() -> None:
        by_points = rasteriser.pullback(adjoint, RECALL)
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


def budget_rows(epochs: int) -> tuple[list[list[str]], FloatArray]:
    """Quality and time of 50+200+600 on the frozen set, start included; and their means."""
    taken = on_frozen_set(frozen.SEEDS, epochs=epochs)
    names = [*(make().name for make in frozen.CONTAINERS), "mean"]
    every = np.concatenate([taken, taken.mean(axis=0, keepdims=True)])
    rows = [_quality_row(name, one) for name, one in zip(names, every, strict=True)]
    print("\n".join("  ".join(row) for row in rows), flush=True)
    return rows, every[-1].mean(axis=0)


def _quality_row(name: str, taken: FloatArray) -> list[str]:
    m = taken.mean(axis=0)
    return [
        name, f"{m[LC]:.3f} ± {np.ptp(taken[:, LC]) / 2:.3f}", f"{m[OO]:.1e}", f"{m[EA]:.1e}",
        f"{m[EXACT_OO]:.1e}", f"{m[LNU]:.1f}", f"{np.median(taken[:, SECONDS]):.2f}",
    ]  # fmt: skip


def target_rows(
    epochs: dict[str, EpochTiming], curves: Timing, draft: FloatArray
) -> list[list[str]]:
    """What was measured beside what was asked for; call it last, for the memory."""
    edges, peak = frozen_edges(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    peak_mib = peak / (1024**2 if sys.platform == "darwin" else 1024)
    rows = [
        [
            f"one whole epoch, poses to poses, 100 icons of {edges:,} edges, 600 px, {name}",
            f"{t.epoch} ms, {t.ratio} x the running sum ({t.running_sum} ms)",
            target,
        ]
        for (name, t), target in zip(epochs.items(), ("0.6 x", "1.0 x"), strict=True)
    ]
    return [
        *rows,
        [
            "2,048 closed curves of 32 edges, radius 30 px, 2,040 x 1,344 px, both ways",
            f"{curves} ms",
            "15 ms",
        ],
        [
            "200 epochs, 50+200+600 px, 100 items, start included",
            f"{draft[SECONDS]:.2f} s",
            "0.4 s",
        ],
        [
            "quality at that budget, sizes free",
            f"LC {draft[LC]:.3f}, OO {draft[OO]:.1e}, EA {draft[EA]:.1e}",
            "LC 0.77, OO 3e-4, EA 1.5e-4",
        ],
        [
            "peak memory of this benchmark, 10,000 items at 2,400 px included",
            f"{peak_mib:.0f} MiB",
            "1,024 MiB",
        ],
    ]


def main() -> None:
    """Measure, print, write docs/benchmarks/engine.md."""
    print(machine(), flush=True)
    precompile.warm_up()
    epochs = timed_epochs(
        {"without evenness": {**WEIGHTS, "evenness": 0.0}, "with evenness": WEIGHTS}
    )
    for name, timing in epochs.items():
        print(f"epoch {name}: {timing.epoch} ms, ratio {timing.ratio}", flush=True)
    curves = closed_curves()
    print(f"2,048 curves: {curves} ms", flush=True)
    draft, draft_mean = budget_rows(200)
    normal, _ = budget_rows(800)
    stages = stage_rows()
    write_page(
        "engine.md",
        PAGE,
        targets=markdown_table(
            ["what", "measured", "target"], target_rows(epochs, curves, draft_mean)
        ),
        draft=markdown_table(QUALITY_HEADER, draft),
        normal=markdown_table(QUALITY_HEADER, normal),
        stages=markdown_table(STAGE_HEADER, stages),
    )


if __name__ == "__main__":
    main()

"""What evenness is worth and what it costs: ``packwork bench evenness [short]``.

Both presets on the frozen set with their losses against large gaps and without, and one
epoch against a running sum. Prints the tables and writes them to
docs/benchmarks/evenness.md. ``short`` takes one seed in place of five, and only prints.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit import frozen
from benchmarks.kit.epochs import BLOCKS, EpochTiming, frozen_edges, timed_epochs
from benchmarks.kit.manifests import Manifest, stamp, write_manifest, write_text
from benchmarks.kit.measuring import Timing, machine, markdown_table
from benchmarks.kit.runs import EA, LC, LNU, MEASURES, OO, on_frozen_set
from packwork import precompile
from packwork.arrays import FloatArray
from packwork.recipe.presets import PRESETS

SEEDS = (0, 1, 2, 3, 4)
NAMES = [*(make().name for make in frozen.CONTAINERS), "mean"]


@dataclass(frozen=True)
class Setting:
    """A preset, a number of epochs and a finish, with a loss that is switched off in turn."""

    preset: str
    epochs: int
    loss: str
    finish: str = "none"

    @property
    def title(self) -> str:
        finish = "" if self.finish == "none" else ", then the exact finish"
        return f"preset {self.preset}, {self.epochs} epochs{finish}"


SETTINGS = (
    Setting("default", 800, "evenness"),
    Setting("default", 200, "evenness"),
    Setting("paper", 200, "paper-evenness"),
    Setting("default", 800, "evenness", "exact"),
)

HEADER = [
    "container", "LC without", "LC with", "change, points", "L-nU without", "L-nU with", "falls by",
    "OO without", "OO with", "EA without", "EA with",
]  # fmt: skip

PAGE = """# Evenness

Made by `packwork bench evenness` on {date}.
{machine}.

## Targets

{targets}

## With and without the loss

The frozen set, {seeds} seeds: medians for each container, and in the last row the medians of
the containers' mean; "falls by" is the median over the seeds of the share by which L-nU falls,
in brackets its least and most. "Without" is `--loss evenness=0` (preset `paper`:
`--loss paper-evenness=0`), all else alike. Measures by pixels at 1,200 px, before the exact finish
(`--finish none`); the last table is of runs with it.

{settings}

## One epoch

Poses to poses, {edges} edges, 600 px, 100 icons in the round container; blocks of epochs in
turn with blocks of `np.cumsum(image, axis=1, out=buffer)` on a float32 image of the same size.
Medians and quartiles of {blocks} blocks, in milliseconds of the processor; the ratios are those of
neighbouring blocks. Other programs on the machine take caches from an epoch, not from the sum.

{epoch}
"""


def measure(seeds: Sequence[int]) -> Manifest:
    """An epoch, and runs of all settings, without the loss and with it."""
    timings = {name: asdict(timing) for name, timing in epoch_timings().items()}
    settings: Manifest = {}
    for setting in SETTINGS:
        without, including = pair(setting, seeds)
        settings[setting.title] = {"without": without, "with": including}
        print(setting.title, flush=True)
        print(markdown_table(HEADER, setting_rows(without, including)), flush=True)
    return {
        "seeds": len(seeds),
        "measures": MEASURES,
        "containers": NAMES,
        "settings": settings,
        "edges": frozen_edges(),
        "blocks": BLOCKS,
        "epoch": timings,
    }


def pair(setting: Setting, seeds: Sequence[int]) -> tuple[FloatArray, FloatArray]:
    """Measures without and with the loss, ``(5, seeds, 6)``: the containers, their mean."""
    options = {
        "preset": setting.preset, "epochs": setting.epochs, "finish": setting.finish,
    }  # fmt: skip
    without = on_frozen_set(seeds, losses={setting.loss: 0.0}, **options)
    both = without, on_frozen_set(seeds, **options)
    return tuple(np.concatenate([m, m.mean(axis=0, keepdims=True)]) for m in both)


def setting_rows(without: FloatArray, including: FloatArray) -> list[list[str]]:
    """One row a container, and one for their mean."""
    falls = 1 - including[:, :, LNU] / without[:, :, LNU]
    without, including = np.median(without, axis=1), np.median(including, axis=1)
    return [
        [
            name, f"{w[LC]:.3f}", f"{i[LC]:.3f}", f"{100 * (i[LC] - w[LC]):+.1f}",
            f"{w[LNU]:.1f}", f"{i[LNU]:.1f}",
            f"{np.median(fall):.0%} ({fall.min():.0%} to {fall.max():.0%})",
            f"{w[OO]:.1e}", f"{i[OO]:.1e}", f"{w[EA]:.1e}", f"{i[EA]:.1e}",
        ]
        for name, w, i, fall in zip(NAMES, without, including, falls, strict=True)
    ]  # fmt: skip


def epoch_timings() -> dict[str, EpochTiming]:
    """One epoch of the default preset without and with evenness."""
    losses = {str(name): weight for name, weight in PRESETS["default"].solve.losses.items()}
    return timed_epochs({"without evenness": {**losses, "evenness": 0.0}, "with evenness": losses})


def target_rows(tables: dict[str, list[list[str]]], epoch: dict[str, Timing]) -> list[list[str]]:
    """The means of each setting, and the epoch, beside what was asked for."""
    rows = []
    for title, table in tables.items():
        mean = dict(zip(HEADER, table[-1], strict=True))
        rows.append([f"L-nU falls, {title}", mean["falls by"], "25 %"])
        rows.append([f"LC changes, {title}", f"{mean['change, points']} points", "+-0.5 points"])
    cost = f"{epoch['ratio']} x the running sum ({epoch['epoch']} ms)"
    return [*rows, ["one epoch with evenness, 600 px", cost, "1.0 x"]]


def tables_of(manifest: Manifest) -> dict[str, list[list[str]]]:
    """Rows of each setting."""
    return {
        title: setting_rows(np.array(taken["without"]), np.array(taken["with"]))
        for title, taken in manifest["settings"].items()
    }


def page(manifest: Manifest) -> str:
    """docs/benchmarks/evenness.md."""
    tables = tables_of(manifest)
    timings = {
        name: {key: Timing(**timing) for key, timing in one.items()}
        for name, one in manifest["epoch"].items()
    }
    rows = [
        [name, *(str(one[key]) for key in ("epoch", "running_sum", "ratio"))]
        for name, one in timings.items()
    ]
    return PAGE.format(
        date=manifest["date"],
        machine=manifest["machine"],
        targets=markdown_table(
            ["what", "measured", "target"], target_rows(tables, timings["with evenness"])
        ),
        seeds=manifest["seeds"],
        settings="\n\n".join(
            f"### {title[0].upper()}{title[1:]}\n\n{markdown_table(HEADER, table)}"
            for title, table in tables.items()
        ),
        edges=f"{manifest['edges']:,}",
        blocks=manifest["blocks"],
        epoch=markdown_table(["epoch", "ms", "running sum, ms", "ratio"], rows),
    )


def main(words: list[str]) -> None:
    """Measure, print, write the manifest and docs/benchmarks/evenness.md."""
    seeds = SEEDS[:1] if "short" in words else SEEDS
    print(machine(), flush=True)
    precompile.warm_up()
    manifest = {**stamp(), **measure(seeds)}
    if seeds == SEEDS:
        write_text("evenness.md", page(write_manifest("evenness", manifest)))
    else:
        print(page(manifest))


if __name__ == "__main__":
    main(sys.argv[1:])

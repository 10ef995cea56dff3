"""What a run is worth, before the exact finish and after: ``packwork bench quality [WORD...]``.

Two sets, three size modes, two efforts. Words restrict the rows (``frozen``, ``others``,
``free``, ``shared``, ``shared-1..4``, ``normal``, ``best``, a container's name), ``seeds=2``
takes that many seeds; ``gaps`` and ``many`` are the tables of filled voids and of many items,
and nothing else. Without words all rows are run, and the tables are written to
docs/benchmarks/quality.md; ``write`` does so for some rows.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit import frozen, others
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import machine, markdown_table, ranged
from benchmarks.quality import many
from packwork import precompile, uses
from packwork.metrics.exact import exact_metrics
from packwork.pipeline.job import Clock
from packwork.pipeline.state import RunContext, RunState, run_steps
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.steps.finish import Finish
from packwork.steps.starts import fits_first
from packwork.uses.collage import placing

MODES = ("free", "shared", "shared-1..4")
EFFORTS = ("normal", "best")
DEFAULT_SEEDS = {"normal": 2, "best": 1}

HEADER = [
    "container", "LC before", "LC", "overlap", "outside", "least gap", "shares off by", "clean",
    "s before", "s finish",
]  # fmt: skip

PAGE = """# Quality

Made by `packwork bench {words}` on {date}.
{machine}.

"LC before" is what start and levels reach, less what overlaps or sticks out; "LC" what the exact
finish makes of it; both from exact geometry. Overlap and what is outside are shares of the
container, the gap is in canvas units (the canvas has 600), all of the true outlines and the worst
of all seeds. "Shares off by" is the worst item's area against its share; "clean" the runs in which
the finish itself found nothing to name. Seconds are the processor's on a machine that others use
too, without reading, measuring and writing. {seeds}: medians, least and most in
brackets.
"free" is within a factor of 2; in "shared-1..4" items are worth 1 to 4 in turn.

{tables}
"""


@dataclass(frozen=True)
class Kit:
    """Containers and the items that go into each."""

    name: str
    containers: Callable[[], list[Container]]
    items: Callable[[], list[Item]]


@dataclass(frozen=True)
class Result:
    """One run."""

    before: float
    coverage: float
    overlap: float
    outside: float
    gap: float
    off: float
    clean: bool
    levels: float
    finish: float


KITS = (
    Kit("frozen", lambda: [make() for make in frozen.CONTAINERS], frozen.items),
    Kit("others", others.containers, others.items),
)


@dataclass(frozen=True)
class Asked:
    """Words of the command line."""

    words: tuple[str, ...]

    def wants(self, choices: Sequence[str]) -> list[str]:
        """Those of the choices that are named; all if none is."""
        return [choice for choice in choices if choice in self.words] or list(choices)

    def kits(self) -> list[Kit]:
        """Sets that are named, or that hold a container that is; all if there is none."""

        def is_named(kit: Kit) -> bool:
            return any(container.name in self.words for container in kit.containers())

        chosen = self.wants([kit.name for kit in KITS])
        kits = [kit for kit in KITS if kit.name in chosen]
        return list(filter(is_named, kits)) or kits

    def seeds(self, effort: str) -> range:
        """How many seeds, from 0."""
        given = [word.split("=")[1] for word in self.words if word.startswith("seeds=")]
        return range(int(given[0]) if given else DEFAULT_SEEDS[effort])


def weighted(items: Sequence[Item], mode: str) -> dict[str, Any]:
    """Options of a size mode."""
    if mode == "free":
        return {"sizes": "free"}
    if mode == "shared":
        return {"sizes": "shared"}
    names = list(dict.fromkeys(item.name for item in items))
    return {"sizes": "shared", "weights": {name: 1.0 + k % 4 for k, name in enumerate(names)}}


def measured(kit: Kit, container: Container, mode: str, effort: str, seed: int) -> Result:
    """One run, without reading and writing."""
    items = kit.items()
    options = weighted(items, mode)
    recipe = make_recipe(container=kit.name, items=["-"], seed=seed, effort=effort, **options)
    clock = Clock(now=time.process_time)
    job = replace(uses.read(recipe, items, container), clock=clock)
    steps = placing(job, suits_first_fit=fits_first(job))
    finish = next(k for k, step in enumerate(steps) if isinstance(step, Finish))
    levels = run_steps(steps[:finish], RunState.of(job), RunContext())
    result = run_steps(steps[finish:], levels, RunContext())
    rough, exact = (
        exact_metrics(
            Layout(job.container, job.items, poses, job.weights).outlines, job.container.outline
        )
        for poses in (levels.poses, result.poses)
    )
    outlines = [item.outline for item in job.items]
    areas = np.array([outline.area for outline in outlines]) * result.poses.scale**2
    shares = areas / areas.sum() / (job.weights / job.weights.sum())
    return Result(
        rough.coverage - rough.overlap - rough.exceeding, exact.coverage, exact.overlap,
        exact.exceeding, exact.min_gap, 0.0 if mode == "free" else float(np.abs(shares - 1).max()),
        result.is_clean and not result.undersized,
        clock.seconds["start"] + clock.seconds["levels"], clock.seconds["finish"],
    )  # fmt: skip


def row(name: str, runs: Sequence[Result]) -> list[str]:
    """A line of a table."""
    return [
        name,
        ranged([run.before for run in runs], ".3f"),
        ranged([run.coverage for run in runs], ".3f"),
        f"{max(run.overlap for run in runs):.1e}",
        f"{max(run.outside for run in runs):.1e}",
        f"{min(run.gap for run in runs):.4f}",
        f"{max(run.off for run in runs):.1e}",
        f"{sum(run.clean for run in runs)} of {len(runs)}",
        f"{np.median([run.levels for run in runs]):.1f}",
        f"{np.median([run.finish for run in runs]):.1f}",
    ]


def tables(asked: Asked) -> Iterator[str]:
    """All tables that are asked for, as soon as they are done."""
    named = [name for name in many.TABLES if name in asked.words]
    if not named:
        yield from run_tables(asked)
    for name in named or ([] if asked.words else many.TABLES):
        yield many.TABLES[name]()


def run_tables(asked: Asked) -> Iterator[str]:
    """One table for each effort, set and mode."""
    kits = asked.kits()
    for effort, kit, mode in product(asked.wants(EFFORTS), kits, asked.wants(MODES)):
        containers = {container.name: container for container in kit.containers()}
        rows, of_all = [], []
        for name in asked.wants(list(containers)):
            runs = [measured(kit, containers[name], mode, effort, s) for s in asked.seeds(effort)]
            rows.append(row(name, runs))
            of_all.append(runs)
        rows.append(mean_row(of_all))
        title = f"## {kit.name}, {mode}, `--effort {effort}`"
        yield f"{title}\n\n{markdown_table(HEADER, rows)}\n"


def mean_row(of_all: Sequence[Sequence[Result]]) -> list[str]:
    """Means over the containers, seed by seed."""
    before = [float(np.mean([run.before for run in runs])) for runs in zip(*of_all, strict=True)]
    after = [float(np.mean([run.coverage for run in runs])) for runs in zip(*of_all, strict=True)]
    runs = [run for some in of_all for run in some]
    spent = [
        f"{np.mean([getattr(run, name) for run in runs]):.1f}" for name in ("levels", "finish")
    ]
    return ["mean", ranged(before, ".3f"), ranged(after, ".3f"), *row("", runs)[3:8], *spent]


def said_seeds(asked: Asked) -> str:
    """Seeds by effort, for the page."""
    return ", ".join(f"{len(asked.seeds(effort))} seeds at `{effort}`" for effort in EFFORTS)


def main(words: list[str]) -> None:
    """Measure, print, write docs/benchmarks/quality.md."""
    asked = Asked(tuple(words))
    print(machine(), flush=True)
    precompile.warm_up()
    told, made = " ".join(["quality", *words]), []
    for table in tables(asked):
        print(table, flush=True)
        made.append(table)
        if not words or "write" in words:
            # After each table: what a stopped run has measured is not lost.
            write_page(
                "quality.md", PAGE, words=told, seeds=said_seeds(asked),
                tables="\n".join(made),
            )  # fmt: skip


if __name__ == "__main__":
    main(sys.argv[1:])

"""The one place that knows every stage: from a recipe to a measured layout."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from importlib import metadata
from itertools import cycle, islice
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import PackworkError, RecipeError
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.losses.registry import find_loss
from packwork.metrics.measure import LayoutMetrics, measure
from packwork.metrics.pixel import pixel_metrics
from packwork.progress import Observer, Stop, never
from packwork.readers.container import read_container
from packwork.readers.items import read_items
from packwork.readers.layout import read_layout
from packwork.readers.weights import read_weights
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.detail import seen_at
from packwork.solve.herd import wronged_shares
from packwork.solve.level import Level
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, Outcome, scale_bounds, solve
from packwork.start.angles import nearest_allowed, start_angles
from packwork.start.first_poses import first_poses
from packwork.start.relocate import relocated
from packwork.start.sizes import hull_areas, nominal_scales, yielding_scales

NOMINAL_COVERAGE = 0.82
"""With free sizes: area of all items' hulls at their nominal sizes over the container's.
Smaller lets the largest stand out more. Tried."""

CHECK_RESOLUTION = 600
"""Pixels on the longer side of the image on which unplaced items are found. Chosen."""

WIDEST_WEIGHTS = 1e6
"""Largest weight over the smallest: beyond it the small ones could not be seen. Chosen."""

ROUGH_SHARE = 0.03
"""Share of the container that may be overlapped or outside before a run counts as rough.
A run that went well stays a hundred times below. Chosen."""

BURIED_RESOLUTION = 200
"""Pixels on the longer side of the image on which buried items are found. Chosen."""

BURIED_SHARE = 0.5
"""Share of an item under others or outside from which it is moved before a run that did
not choose its own start. Smaller undoes more of that start. Chosen."""

UNPLACED_SHARE = 0.5
"""Share of an item that is overlapped or outside from which it counts as not placed."""


@dataclass(frozen=True)
class Unplaced:
    """An item that found no place of its own, and why."""

    item: str
    index: int
    reason: str


@dataclass(frozen=True, eq=False)
class Run:
    """What a run gave.

    Parameters
    ----------
    layout
        The result, its manifest filled in.
    metrics
        What it is worth.
    seconds
        Time per part.
    ending
        Whether all epochs were run.
    unplaced
        Items without a place of their own.
    skipped
        Files that were left out, with the reason.
    """

    layout: Layout
    metrics: LayoutMetrics
    seconds: Mapping[str, float]
    ending: Ending
    unplaced: tuple[Unplaced, ...]
    skipped: tuple[PackworkError, ...]

    @property
    def is_rough(self) -> bool:
        """Whether far more is overlapped or outside than a run that went well leaves."""
        exact = self.metrics.exact
        return exact.overlap + exact.exceeding > ROUGH_SHARE

    def report(self, write_seconds: float = 0.0) -> dict[str, Any]:
        """Plain values for ``--report``."""
        seconds = {**self.seconds, "finish": 0.0, "write": write_seconds}
        seconds["total"] = sum(seconds.values())
        return {
            "metrics": self.metrics.as_dict(),
            "seconds": seconds,
            "items": len(self.layout.items),
            "placed": len(self.layout.items) - len(self.unplaced),
            "unplaced": [asdict(u) for u in self.unplaced],
            "skipped": [str(error) for error in self.skipped],
            "certified": False,
            "ending": self.ending.value,
            "seed": self.layout.manifest["seed"],
        }


@dataclass
class Clock:
    """Seconds per part of a run."""

    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def time(self, part: str) -> Iterator[None]:
        """Add what the block takes to ``part``."""
        began = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[part] = self.seconds.get(part, 0.0) + time.perf_counter() - began


def fill(
    recipe: Recipe,
    items: Sequence[Item] | None = None,
    container: Container | None = None,
    observer: Observer | None = None,
    stop: Stop = never,
) -> Run:
    """Fill a container with items.

    Parameters
    ----------
    recipe
        What to do.
    items, container
        Already read, in place of the recipe's names of files.
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run with what it has.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning for these files.
    """
    return run(read(recipe, items, container), observer, stop)


@dataclass(frozen=True, eq=False)
class Job:
    """A recipe and all that it names, read and found usable."""

    recipe: Recipe
    container: Container
    items: tuple[Item, ...]
    weights: FloatArray
    skipped: tuple[PackworkError, ...]
    clock: Clock
    earlier: Layout | None = None


def read(
    recipe: Recipe, items: Sequence[Item] | None = None, container: Container | None = None
) -> Job:
    """Read what a recipe names; the first half of :func:`fill`."""
    clock = Clock()
    skipped: tuple[PackworkError, ...] = ()
    with clock.time("read"):
        region = container or read_container(recipe.container, recipe.canvas, recipe.font)
        if items is None:
            found = read_items(recipe.items, holes=recipe.holes, strict=recipe.strict)
            items, skipped = found.items, found.skipped
        chosen = tuple(islice(cycle(items), recipe.count or len(items)))
        weights = item_weights(chosen, recipe.weights)
        earlier = read_layout(recipe.start) if recipe.starts_from_layout else None
        recipe.start_options()
        for loss in recipe.losses:
            find_loss(loss)
    return Job(recipe, region, chosen, weights, skipped, clock, earlier)


def run(job: Job, observer: Observer | None = None, stop: Stop = never) -> Run:
    """Solve and measure what was read; the second half of :func:`fill`."""
    recipe, clock = job.recipe, job.clock
    outlines = [item.outline for item in job.items]
    with clock.time("start"):
        region = padded(job.container, recipe.padding_cu)
        start, nominal, method = _start(job, region, outlines)
    with clock.time("levels"):
        options = recipe.solve_options()
        outcome = solve(region, outlines, start, nominal, options, observer, stop)
    layout = Layout(job.container, job.items, outcome.poses, job.weights)
    with clock.time("measure"):
        metrics = measure(layout)
        unplaced = find_unplaced(layout)
    manifest = _manifest(job, method, outcome, metrics, unplaced)
    return Run(
        layout=replace(layout, manifest=manifest),
        metrics=metrics,
        seconds=clock.seconds,
        ending=outcome.ending,
        unplaced=unplaced,
        skipped=job.skipped,
    )


def padded(container: Container, padding: float) -> Container:
    """Container drawn in by half the padding; the items' own margins are the other half.

    Raises
    ------
    RecipeError
        If nothing of the container is left.
    """
    outline = grown(container.outline, -padding / 2)
    if padding > 0 and outline is container.outline:
        raise RecipeError(
            "padding", f"{padding:g} px leaves nothing of the container; use a smaller one"
        )
    return replace(container, outline=outline)


def warm_up() -> None:
    """Load the compiled kernels, or compile them on the first run ever on a machine."""
    square = Outline.from_rings([np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])])
    container = Container("warm-up", "", square.mapped(similarity(4.0, 4.0, 0.0, 3.0)), 8.0, 8.0)
    poses = Poses(*(np.full(1, value) for value in (4.0, 4.0, 0.0, 1.0)))
    solve(container, [square], poses, np.ones(1), SolveOptions(levels=(8,), epochs=1))
    item = Item("warm-up", "", square, square, FlatArt())
    layout = Layout(container, (item,), poses, np.ones(1))
    find_unplaced(layout)
    pixel_metrics(layout.outlines, container)


def item_weights(items: Sequence[Item], weights: str | Mapping[str, float] | None) -> FloatArray:
    """``(n,)`` share of area of each item, by its name; 1 where none is given.

    Raises
    ------
    RecipeError
        If a weight names no item, or is not a positive number.
    """
    if weights is None:
        return np.ones(len(items))
    table = read_weights(weights) if isinstance(weights, str) else weights
    names = {item.name for item in items}
    for name, weight in table.items():
        if name not in names:
            raise RecipeError(
                "weights", f"no item is called {name!r}; there are {', '.join(sorted(names)[:12])}"
            )
        if not (np.isfinite(weight) and weight > 0):
            raise RecipeError("weights", f"the weight of {name} must be positive, not {weight}")
    found = np.array([float(table.get(item.name, 1.0)) for item in items])
    if found.max() / found.min() > WIDEST_WEIGHTS:
        raise RecipeError(
            "weights",
            f"the largest may be {WIDEST_WEIGHTS:g} times the smallest, "
            f"not {found.max():g} to {found.min():g}",
        )
    return found


def find_unplaced(layout: Layout) -> tuple[Unplaced, ...]:
    """Items of which most is overlapped or outside the container."""
    outlines = [item.outline for item in layout.items]
    px_per_cu = CHECK_RESOLUTION / layout.container.side
    seen = seen_at(outlines, layout.poses.scale, px_per_cu)
    level = Level(layout.container, seen, CHECK_RESOLUTION)
    shares = wronged_shares(level, layout.poses, level.density(layout.poses))
    return tuple(
        Unplaced(
            layout.items[k].name,
            int(k),
            f"{100 * shares[k]:.0f} % of it is overlapped or outside the container",
        )
        for k in np.flatnonzero(shares > UNPLACED_SHARE)
    )


def _start(
    job: Job, container: Container, outlines: Sequence[Outline]
) -> tuple[Poses, FloatArray, str]:
    """First poses, nominal scales and how places were found, in the padded container."""
    recipe, weights = job.recipe, job.weights
    rng = np.random.default_rng(recipe.seed)
    options = recipe.start_options()
    areas = np.array([o.area for o in outlines])
    total = options.coverage * container.outline.area
    if recipe.sizes == "fixed":
        nominal = scales = np.ones(len(outlines))
    elif recipe.sizes == "shared":
        nominal = scales = nominal_scales(areas, weights, total)
    else:
        hulls = hull_areas(outlines)
        nominal = nominal_scales(hulls, weights, NOMINAL_COVERAGE * container.outline.area)
        scales = yielding_scales(areas, hulls, nominal, recipe.size_ratio, total)
    if job.earlier is not None:
        poses = _earlier_poses(recipe, job.earlier, container, nominal)
        return _unburied(container, outlines, poses, rng), nominal, "layout"
    rotation = recipe.rotation
    angles = start_angles(len(outlines), rotation.limit, rotation.choices, rng)
    first = first_poses(container, outlines, scales, angles, options, rng)
    if first.method == "scatter":
        return _unburied(container, outlines, first.poses, rng), nominal, first.method
    return first.poses, nominal, first.method


def _unburied(
    container: Container, outlines: Sequence[Outline], poses: Poses, rng: np.random.Generator
) -> Poses:
    """Poses in which items that lie mostly under others or outside have been moved."""
    seen = seen_at(outlines, poses.scale, BURIED_RESOLUTION / container.side)
    level = Level(container, seen, BURIED_RESOLUTION)
    buried = np.flatnonzero(wronged_shares(level, poses, level.density(poses)) > BURIED_SHARE)
    return relocated(container, outlines, poses, buried, rng) if len(buried) else poses


def _earlier_poses(
    recipe: Recipe, earlier: Layout, container: Container, nominal: FloatArray
) -> Poses:
    """Poses of an earlier layout, sizes and angles within the recipe's bounds.

    They are stretched to this run's canvas.
    """
    ratio = container.side / earlier.container.side
    poses = Poses(
        earlier.poses.x * ratio,
        earlier.poses.y * ratio,
        earlier.poses.angle,
        earlier.poses.scale * ratio,
    )
    if len(poses) != len(nominal):
        raise RecipeError(
            "start",
            f"{recipe.start} has {len(poses)} items, this run {len(nominal)}; give as many",
        )
    if recipe.sizes == "shared":
        scale = nominal * np.sqrt(np.mean((poses.scale / nominal) ** 2))
    elif recipe.sizes == "fixed":
        scale = nominal
    else:
        scale = np.clip(poses.scale, *scale_bounds(nominal, nominal, recipe.solve_options()))
    angle = nearest_allowed(poses.angle, recipe.rotation.limit, recipe.rotation.choices)
    return Poses(poses.x, poses.y, angle, np.asarray(scale))


def _manifest(
    job: Job,
    method: str,
    outcome: Outcome,
    metrics: LayoutMetrics,
    unplaced: Sequence[Unplaced],
) -> dict[str, Any]:
    return {
        "packwork": metadata.version("packwork"),
        "recipe": job.recipe.plain(),
        "seed": job.recipe.seed,
        "start": method,
        "ending": outcome.ending.value,
        "levels": [asdict(level) for level in outcome.levels],
        "metrics": metrics.as_dict(),
        "seconds": dict(job.clock.seconds),
        "unplaced": [asdict(u) for u in unplaced],
        "skipped": [str(error) for error in job.skipped],
        "certified": False,
    }

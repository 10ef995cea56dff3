"""One run: read, begin, solve, dress, measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from itertools import count

import numpy as np

from packwork.errors import RecipeError
from packwork.finish.finish import Finished, finish
from packwork.finish.options import FinishOptions
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.levels import refined_levels
from packwork.metrics.certificate import Promise, broken
from packwork.metrics.measure import measure
from packwork.metrics.pixel import pixel_metrics
from packwork.pipeline.beginning import Beginning, begin
from packwork.pipeline.beside import same_kind_beside
from packwork.pipeline.dressing import dressed
from packwork.pipeline.finishing import finished, unfinished
from packwork.pipeline.gaps import fill_gaps
from packwork.pipeline.job import Job, read
from packwork.pipeline.legend import legend_notes
from packwork.pipeline.letters import held_down, with_readable, without_hopeless
from packwork.pipeline.outcome import Filling, Run, find_unplaced, manifest, undrawn, words_found
from packwork.progress import Observer, Stop, never
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Outcome, solve
from packwork.solve.stand_ins import stand_ins

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


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


def run(job: Job, observer: Observer | None = None, stop: Stop = never) -> Run:
    """Solve and measure what was read; the second half of :func:`fill`.

    Where words would come out smaller than they may be, those are left out and the others
    are placed anew.
    """
    job = without_hopeless(job)
    for attempt in count(1):
        placed = _placed(job, observer, stop)
        fewer = job if stop() else with_readable(job, placed.poses, attempt)
        if fewer is job:
            break
        job = fewer
    if placed.exact is None or not job.recipe.fills_gaps:
        return _judged(job, placed.start, placed.outcome, placed.exact, placed.poses, None)
    with job.clock.time("gaps"):
        filled = fill_gaps(job, placed.start, placed.exact, observer, stop)
    return _judged(
        filled.job, filled.start, placed.outcome, filled.exact, filled.exact.poses, filled.filling
    )


@dataclass(frozen=True, eq=False)
class _Placed:
    """What the levels gave, and the finish if one was asked for."""

    start: Beginning
    outcome: Outcome
    exact: Finished | None

    @property
    def poses(self) -> Poses:
        return self.outcome.poses if self.exact is None else self.exact.poses


def _placed(job: Job, observer: Observer | None, stop: Stop) -> _Placed:
    """Poses of all items, before voids are filled."""
    recipe, clock = job.recipe, job.clock
    with clock.time("start"):
        outlines = stand_ins([item.outline for item in job.items], recipe.outline)
        padding = recipe.padding_cu(job.container)
        region = padded(job.container, padding)
        start = begin(job, region, outlines)
    with clock.time("levels"):
        options = _solve_options(job, padding)
        outcome = solve(
            region, outlines, start.poses, start.nominal, options, observer, stop, start.limits
        )
    if recipe.finish != "exact":
        return _Placed(start, outcome, None)
    with clock.time("finish"):
        exact = finished(job, start, outcome.poses, observer, stop)
        exact = held_down(job, start, exact, observer, stop)
    return _Placed(start, outcome, exact)


def _judged(
    job: Job,
    start: Beginning,
    outcome: Outcome,
    exact: Finished | None,
    poses: Poses,
    filling: Filling | None,
) -> Run:
    """The result, measured and compared with what was promised."""
    recipe, clock = job.recipe, job.clock
    layout = Layout(job.container, job.items, poses, job.weights)
    with clock.time("measure"):
        metrics = measure(layout)
        unplaced = () if exact is None else unfinished(job, exact)
        if not unplaced and (exact is None or not metrics.exact.is_clean):
            unplaced = find_unplaced(layout, start.limits)
        unplaced += undrawn(job)
        shares = recipe.sizes == "shared" and start.limits is None
        promise = Promise(recipe.padding_cu(job.container), shares) if exact is not None else None
        faults = () if promise is None else broken(promise, layout, metrics.exact)
        beside = None if start.limits is None else same_kind_beside(layout, start.limits.kinds)
    words = words_found(job)
    certified = promise is not None and not faults and not unplaced
    said = manifest(job, start.method, outcome, metrics, unplaced, beside)
    said |= {
        "certified": certified,
        "promised": None if promise is None else asdict(promise),
        "filling": None if filling is None else asdict(filling),
        "words": None if words is None else asdict(words),
    }
    return Run(
        layout=replace(dressed(job, layout), manifest=said, notes=legend_notes(job, layout)),
        metrics=metrics,
        seconds=clock.seconds,
        ending=outcome.ending,
        unplaced=unplaced,
        skipped=job.skipped,
        beside=beside,
        certified=certified,
        broken=faults,
        filling=filling,
        words=words,
    )


def _solve_options(job: Job, padding: float) -> SolveOptions:
    """Options of the solve, with levels fine enough for the items unless they were given."""
    recipe, container = job.recipe, job.container
    options = recipe.solve_options(padding, job.seconds_left(LEVELS_SHARE))
    if recipe.levels is not None or recipe.preset != "default":
        return options
    levels = refined_levels(options.levels, container.side, container.outline.area, len(job.items))
    return options.model_copy(update={"levels": levels})


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
            "padding",
            f"{padding:g} {container.unit} leaves nothing of the container; use a smaller one",
        )
    return replace(container, outline=outline)


def warm_up() -> None:
    """Load the compiled kernels, or compile them on the first run ever on a machine."""
    square = Outline.from_rings([np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])])
    container = Container("warm-up", "", square.mapped(similarity(4.0, 4.0, 0.0, 3.0)), 8.0, 8.0)
    poses = Poses(*(np.full(1, value) for value in (4.0, 4.0, 0.0, 1.0)))
    for evenness in (0.0, 1.0):
        options = SolveOptions(levels=(8,), epochs=1, losses={"evenness": evenness})
        solve(container, [square], poses, np.ones(1), options)
    finish(container, [square], poses, FinishOptions(rounds=1))
    item = Item("warm-up", "", square, square, FlatArt())
    layout = Layout(container, (item,), poses, np.ones(1))
    find_unplaced(layout)
    pixel_metrics(layout.outlines, container)

"""One run: read, begin, solve, dress, measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.finish.finish import Finished, finish
from packwork.finish.options import FinishOptions
from packwork.forces.forces import Forces
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.levels import refined_levels
from packwork.metrics.pixel import pixel_metrics
from packwork.piles import PileOptions
from packwork.pipeline.beginning import Beginning, begin
from packwork.pipeline.finishing import finished, unfinished
from packwork.pipeline.forcing import forces_of
from packwork.pipeline.gaps import fill_gaps
from packwork.pipeline.job import Job, read
from packwork.pipeline.judging import Judged, judged
from packwork.pipeline.letters import held_down, with_readable, without_hopeless
from packwork.pipeline.outcome import Filling, Run, find_unplaced
from packwork.pipeline.piling import run_pile
from packwork.pipeline.recording import Recorder
from packwork.pipeline.staying import calmed, needs_no_levels, with_homes
from packwork.progress import Observer, Stop, never, together
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, Outcome, solve
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
    record: bool = False,
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
    record
        Keep the way of the items, in the layout's ``track``.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning for these files.
    """
    return run(read(recipe, items, container), observer, stop, record)


def run(
    job: Job, observer: Observer | None = None, stop: Stop = never, record: bool = False
) -> Run:
    """Solve and measure what was read; the second half of :func:`fill`."""
    if job.recipe.pile is not None:
        return _heaped(job, job.recipe.pile, observer, stop, record)
    placed = _placed_readably(job, observer, stop, record)
    job, exact, recorder = placed.job, placed.exact, placed.recorder
    start, poses = placed.start, placed.poses
    ids: IntArray | None = None
    filling: Filling | None = None
    if exact is not None and job.recipe.fills_gaps:
        with job.clock.time("gaps"):
            filled = fill_gaps(job, start, exact, together(observer, recorder), stop)
        job, start, exact = filled.job, filled.start, filled.exact
        poses, filling, ids = exact.poses, filled.filling, filled.ids
    unplaced = None if exact is None else unfinished(job, exact)
    found = Judged(poses, start.method, start.limits, placed.outcome, unplaced, filling)
    return _with_track(judged(job, found), recorder, ids)


def _heaped(
    job: Job, asked: PileOptions, observer: Observer | None, stop: Stop, record: bool
) -> Run:
    """A pile, and the way of those that found room."""
    recorder = Recorder() if record else None
    done = run_pile(job, asked, together(observer, recorder), stop)
    left = [one.index for one in done.unplaced]
    return _with_track(done, recorder, np.setdiff1d(np.arange(len(job.items)), left))


def _with_track(done: Run, recorder: Recorder | None, ids: IntArray | None) -> Run:
    if recorder is None:
        return done
    layout = done.layout
    return replace(
        done, layout=replace(layout, track=recorder.track(layout.poses, ids, layout.items))
    )


@dataclass(frozen=True, eq=False)
class _Placed:
    """What the levels gave, and the finish if one was asked for."""

    job: Job
    start: Beginning
    outcome: Outcome
    exact: Finished | None
    recorder: Recorder | None

    @property
    def poses(self) -> Poses:
        return self.outcome.poses if self.exact is None else self.exact.poses


def _placed_readably(job: Job, observer: Observer | None, stop: Stop, record: bool) -> _Placed:
    """Poses of all items, before voids are filled.

    Where words would come out smaller than they may be, those are left out and the others
    are placed anew.
    """
    job = without_hopeless(job)
    for attempt in count(1):
        placed = _placed(job, observer, stop, record)
        fewer = job if stop() else with_readable(job, placed.poses, attempt)
        if fewer is job:
            break
        job = fewer
    return placed


def _placed(job: Job, observer: Observer | None, stop: Stop, record: bool) -> _Placed:
    """Poses of all items, whatever their sizes."""
    recipe, clock = job.recipe, job.clock
    recorder = Recorder() if record else None
    observer = together(observer, recorder)
    with clock.time("start"):
        outlines = stand_ins([item.outline for item in job.items], recipe.outline)
        region = padded(job.container, recipe.padding_cu(job.container))
        forces = _forces(job)
        start = begin(job, region, outlines, forces, stop)
    if recorder is not None:
        recorder.keep(start.poses)
    with clock.time("levels"):
        outcome = _levels(job, region, outlines, start, forces, observer, stop)
    if recipe.finish != "exact":
        return _Placed(job, start, outcome, None, recorder)
    with clock.time("finish"):
        # What is to stay where it was is not pushed on.
        kept = None if recipe.stay else forces
        exact = finished(job, start, outcome.poses, observer, stop, kept)
        exact = held_down(job, start, exact, observer, stop, kept)
    return _Placed(job, start, outcome, exact, recorder)


def _levels(
    job: Job,
    region: Container,
    outlines: Sequence[Outline],
    start: Beginning,
    forces: Forces | None,
    observer: Observer | None,
    stop: Stop,
) -> Outcome:
    """What the levels make of the first poses; those themselves, where they are as good."""
    if needs_no_levels(job) or start.method == "first-fit":
        return Outcome(start.poses, Ending.DONE)
    options = _solve_options(job, job.recipe.padding_cu(job.container))
    if job.recipe.stay:
        options = calmed(options)
        forces = with_homes(job, forces, start.poses, job.container)
    return solve(
        region, outlines, start.poses, start.nominal, options, observer, stop, start.limits, forces
    )


def _forces(job: Job) -> Forces | None:
    """What pulls items about, if anything."""
    texts = job.recipe.force
    if not texts:
        return None
    return forces_of(texts, job.items, job.weights, job.container).buoyant(job.weights)


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

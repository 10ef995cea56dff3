"""Items to their places in one container: begin, levels, finish."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

from packwork.errors import RecipeError
from packwork.finish.finish import Finished
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.levels import refined_levels
from packwork.pipeline.beginning import Beginning, begin
from packwork.pipeline.finishing import finished
from packwork.pipeline.forcing import forces_of
from packwork.pipeline.job import Job
from packwork.pipeline.leaning import job_leanings
from packwork.pipeline.letters import held_down, with_readable, without_hopeless
from packwork.pipeline.line_weights import evened
from packwork.pipeline.onward import BEFORE_VOIDS, LEVELS, stretch
from packwork.pipeline.padding import check_found, check_padding, padded
from packwork.pipeline.recording import Recorder
from packwork.pipeline.staying import as_it_was, calmed, needs_no_levels, with_homes
from packwork.pipeline.trying import Turn, jobs_tried, worth
from packwork.pipeline.upright import is_as_good, upright_job
from packwork.progress import Observer, Stop, together
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import Ending, Outcome, solve
from packwork.solve.stand_ins import stand_ins

LEVELS_SHARE = 0.6
"""Share of the time left after the start that the levels may take; the finish, measuring
and writing need the rest. Chosen."""


@dataclass(frozen=True, eq=False)
class Placed:
    """What the levels gave, and the finish if one was asked for.

    Parameters
    ----------
    job
        Its items are those that were placed.
    start
        What it began from.
    outcome
        Of the levels.
    exact
        Of the finish; None without one.
    recorder
        Who kept the way; None if nobody.
    """

    job: Job
    start: Beginning
    outcome: Outcome
    exact: Finished | None
    recorder: Recorder | None

    @property
    def poses(self) -> Poses:
        """Where all items are now."""
        return self.outcome.poses if self.exact is None else self.exact.poses


def placed_readably(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items, before voids are filled.

    Where words would come out smaller than they may be, those are left out and the others
    are placed anew.
    """
    job = without_hopeless(job)
    for attempt in count(1):
        placed = _upright_if_as_good(job, observer, stop, record)
        fewer = job if stop() else with_readable(job, placed.poses, attempt)
        if fewer is job:
            break
        job = fewer
    return placed


def _upright_if_as_good(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items; of one by itself, its own pose if it is about as large so."""
    plain = upright_job(job)
    if plain is None:
        return _placed(job, observer, stop, record)
    first, second = (None if observer is None else Turn(observer, k, 2) for k in range(2))
    turned = _placed(job, first, stop, record)
    if stop() or turned.exact is None:
        return turned
    try:
        upright = _placed(plain, second, stop, record)
    except RecipeError:
        return turned
    if upright.exact is None or not is_as_good(upright.exact, turned.exact):
        return turned
    return replace(upright, job=job)


@dataclass(frozen=True, eq=False)
class _Solved:
    """What the levels made of one start; ``recorder`` kept the way."""

    start: Beginning
    outcome: Outcome
    forces: Forces | None
    recorder: Recorder | None


def _placed(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items, whatever their sizes."""
    recipe, clock = job.recipe, job.clock
    # What follows the levels takes its share of the way.
    whole = BEFORE_VOIDS if recipe.fills_gaps else 1.0
    until = whole * (LEVELS if recipe.finish == "exact" else 1.0)
    solved = _best_solved(job, stretch(observer, 0.0, until), stop, record)
    start, outcome, recorder = solved.start, solved.outcome, solved.recorder
    if recipe.finish != "exact":
        return Placed(job, start, outcome, None, recorder)
    observer = together(stretch(observer, until, whole), recorder)
    with clock.time("finish"):
        # What is to stay where it was is not pushed on.
        kept = None if recipe.stay else solved.forces
        exact = finished(job, start, outcome.poses, observer, stop, kept)
        if not (recipe.stay or stop()):
            check_found(job.container, recipe.padding_cu(job.container), exact)
        thinner = job if stop() else evened(job, exact.poses, tells=False)
        if thinner is not job:
            # Thinner lines leave room to grow into.
            job = thinner
            exact = finished(job, start, exact.poses, observer, stop, kept, grows=True)
        exact = held_down(job, start, exact, observer, stop, kept)
    return Placed(job, start, outcome, exact, recorder)


def _best_solved(job: Job, observer: Observer | None, stop: Stop, record: bool) -> _Solved:
    """The levels' outcome; of several starts, that from which most comes to be covered."""
    tried = jobs_tried(job)
    found: list[_Solved] = []
    for number, one in enumerate(tried):
        turn = None if observer is None else Turn(observer, number, len(tried))
        found.append(_solved(one, turn, stop, record))
        if len(tried) == 1 or stop():
            return found[0]
    with job.clock.time("finish"):
        worths = [worth(job, s.start, s.outcome.poses, stop, s.forces) for s in found]
    return found[worths.index(max(worths))]


def _solved(job: Job, observer: Observer | None, stop: Stop, record: bool) -> _Solved:
    """Start and levels."""
    recipe, clock = job.recipe, job.clock
    recorder = Recorder() if record else None
    observer = together(observer, recorder)
    with clock.time("start"):
        outlines = stand_ins([item.outline for item in job.items], recipe.outline)
        padding = recipe.padding_cu(job.container)
        check_padding(job.container, padding, len(job.items))
        region = padded(job.container, padding)
        forces = _forces(job)
        start = begin(job, region, outlines, forces, stop)
    if recorder is not None:
        _keep_start(recorder, job, start, outlines)
    with clock.time("levels"):
        outcome = _levels(job, region, outlines, start, forces, observer, stop)
    return _Solved(start, outcome, forces, recorder)


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
    if needs_no_levels(job) or start.is_tight:
        return Outcome(start.poses, Ending.DONE)
    options = _solve_options(job, job.recipe.padding_cu(job.container))
    if job.recipe.stay:
        options = calmed(options)
        forces = with_homes(job, forces, start.poses, job.container)
    return solve(
        region, outlines, start.poses, start.nominal, options, observer, stop, start.limits, forces
    )


def _keep_start(
    recorder: Recorder, job: Job, start: Beginning, outlines: Sequence[Outline]
) -> None:
    """Keep the first poses; before them, of what was put one by one, the largest first."""
    poses = start.poses
    if start.method == "first-fit":
        order = np.argsort([-o.area * s**2 for o, s in zip(outlines, poses.scale, strict=True)])
        for put in range(len(order)):
            recorder.keep(poses.some(order[:put]), order[:put])
    recorder.keep(as_it_was(job, poses))


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
    leans = job_leanings(job)
    if leans is not None:
        options = options.model_copy(update={"leans": tuple(leans.tolist())})
    if recipe.levels is not None or recipe.preset != "default":
        return options
    levels = refined_levels(options.levels, container.side, container.outline.area, len(job.items))
    return options.model_copy(update={"levels": levels})

"""Lists of steps that icons, words, photographs and charts share.

Whoever asks what happens in a run reads :func:`placing` and :func:`reporting`. A new start, a new
assignment or a new finish is one class in :mod:`packwork.steps` and a line here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.readers.svg.thinner import are_lines
from packwork.recipe.rules import Rotation
from packwork.steps.appearance import CountBeside, Dress, StandOut
from packwork.steps.assign_by_colour import AssignByColour
from packwork.steps.assign_by_embedding import AssignByEmbedding
from packwork.steps.assign_in_order import AssignInOrder
from packwork.steps.control import BestOf, Replan, UnlessTight
from packwork.steps.exchanges import ExchangeByForces, KindsApart
from packwork.steps.finish import Finish, finished
from packwork.steps.levels import Levels
from packwork.steps.line_weights import EvenLines, FinishThinner, TellLineWeights
from packwork.steps.measure import Measure, RemarkCount, TellCoarse
from packwork.steps.mosaic import Judge, ShowPicture, unrecognised
from packwork.steps.place import Place
from packwork.steps.shortfalls import Advise, TellLooseWeights, TellOneColour, TellShortfalls
from packwork.steps.starts import new_starts
from packwork.steps.track import KeepTrack, StartRecording
from packwork.steps.voids import FillerScales, FillVoids, as_planned
from packwork.steps.warm_start import FromLayout, needs_no_levels

AS_LARGE = 0.97
"""Area that an item has upright, as a share of what it has turned, from which it is left upright.
Larger turns it for a gain too small to be seen, smaller wastes room. Chosen."""

_STILL = Rotation(limit=0.0)


def solving(job: Job, *, suits_first_fit: bool, place: RunStep | None = None) -> list[RunStep]:
    """Steps from no place at all to the poses of the levels.

    Parameters
    ----------
    suits_first_fit
        Whether first fit does these items good where all have one size.
    place
        What finds first places, where a use has its own way.
    """
    steps = list[RunStep]()
    if place is not None:
        steps.append(place)
    elif job.earlier is not None:
        steps.append(Place([FromLayout(job.earlier)]))
    else:
        steps.append(Place(new_starts(job, suits_first_fit=suits_first_fit)))
    exchanges = list[RunStep]()
    if job.forces.acts:
        exchanges.append(ExchangeByForces())
    if job.vectors is not None:
        exchanges.append(AssignByEmbedding())
    elif job.plan.keeps_order:
        exchanges.append(AssignInOrder())
    if exchanges and job.earlier is None:
        steps.append(UnlessTight(*exchanges))
    if job.plan.keeps_apart:
        steps.append(KindsApart())
    if job.is_recorded:
        steps.append(StartRecording())
    if not (job.plan.stays and needs_no_levels(job)):
        steps.append(Levels())
    return steps


def jamming(job: Job) -> list[RunStep]:
    """Steps of many discs of one common scale, in place of :func:`placing`; nothing of all else."""
    if job.plan.sizes != "shared":
        return []
    from packwork.steps.jam_discs import JamDiscs, jams_discs

    if not jams_discs(job):
        return []
    return [*([StartRecording()] if job.is_recorded else []), JamDiscs()]


def placing(
    job: Job,
    *,
    suits_first_fit: bool,
    methods: Sequence[str] = (),
    bounds: Sequence[RunStep] = (),
    place: RunStep | None = None,
) -> list[RunStep]:
    """Steps from no place at all to exact poses.

    Parameters
    ----------
    methods
        Starts that are tried, of which the run goes on with the most promising.
    bounds
        What a use does to sizes after the exact finish.
    """

    def once(job: Job, *, may_fail: bool = False) -> list[RunStep]:
        steps = solving(job, suits_first_fit=suits_first_fit, place=place)
        if methods:
            tried = [
                [
                    Replan(method=method),
                    *solving(job.replanned(method=method), suits_first_fit=suits_first_fit),
                ]
                for method in methods
            ]
            steps = [BestOf(tried, most_promising)]
        if job.target is not None and len(job.seated) and not job.plan.stays:
            steps.append(AssignByColour(job.target))
        if job.plan.is_exact:
            steps.append(Finish(may_fail=may_fail))
            if job.plan.has_even_lines:
                steps.append(FinishThinner())
            steps += bounds
        return steps

    steps = once(job)
    if may_stand_upright(job):
        still = [Replan(rotation=_STILL), *once(job.replanned(rotation=_STILL), may_fail=True)]
        steps = [BestOf([steps, still], as_good_upright)]
    return steps


def filling(job: Job, scales: FillerScales = as_planned) -> list[RunStep]:
    """Steps after an exact finish: smaller copies in voids, findings of what came out small."""
    if not job.plan.is_exact:
        return []
    return [FillVoids(scales), TellShortfalls()] if job.plan.voids.fills else [TellShortfalls()]


def reporting(
    job: Job,
    *,
    is_dressed: bool,
    shows_shape: bool = True,
    found: Sequence[RunStep] = (),
    judge: Judge = unrecognised,
) -> list[RunStep]:
    """Steps after the last move: measures, what a use finds in them, colours, film, advice."""
    steps: list[RunStep] = [Measure(), *found]
    if job.plan.has_even_lines:
        steps.insert(0, EvenLines())
    elif job.plan.sizes == "free" and are_lines(job.items):
        steps.append(TellLineWeights())
    if job.plan.sizes == "free" and job.recipe.weights is not None and job.target is None:
        steps.append(TellLooseWeights())
    if job.plan.least_dpi is not None:
        steps.append(TellCoarse())
    if job.plan.keeps_apart:
        steps.append(CountBeside())
    if shows_shape:
        steps.append(Advise())
    if is_dressed or job.plan.palette or any(one.values for one in job.asked):
        steps.append(Dress())
    if shows_shape and not job.plan.gap and job.target is None:
        steps.append(TellOneColour())
    if job.target is not None:
        steps.append(ShowPicture(job.target, judge))
    if job.container.backdrop is not None:
        steps.append(StandOut())
    if job.is_counted:
        steps.append(RemarkCount())
    if job.is_recorded:
        steps.append(KeepTrack())
    return steps


def may_stand_upright(job: Job) -> bool:
    """Whether a job's one item is tried upright besides.

    Not where there are more items, or an angle, a force, an earlier layout or a time was asked for.
    """
    plan = job.plan
    if len(job.items) != 1 or plan.rotation.is_still or plan.rotation.choices:
        return False
    asked = job.asked[0]
    is_told = "rotate" in asked.values or "angle_deg" in asked.pin or plan.is_from_layout
    if is_told or plan.forces or plan.seconds is not None:
        return False
    return plan.is_exact and not plan.voids.fills


def as_good_upright(tried: Sequence[RunState], context: RunContext) -> RunState:
    """Upright layout if it is clean and about as large as the turned one; else that."""
    turned = tried[0]
    for upright in tried[1:]:
        sizes = float(upright.poses.scale[0] ** 2), float(turned.poses.scale[0] ** 2)
        is_as_large = bool(turned.conflicts) or sizes[0] >= AS_LARGE * sizes[1]
        if not upright.conflicts and is_as_large:
            job = replace(upright.job, plan=turned.job.plan)
            return replace(upright, job=job, asked_for=job)
    return turned


def most_promising(tried: Sequence[RunState], context: RunContext) -> RunState:
    """Of what levels made of several starts, that from which most comes to be covered."""
    if len(tried) == 1 or context.stop():
        return tried[0]

    def worth(state: RunState) -> tuple[bool, float]:
        """Rank of a result: a clean finish without trials, then the area that is covered."""
        job = state.job.replanned(effort="draft")
        quick = replace(state, job=job, recorder=None)
        exact = finished(quick, RunContext(stop=context.stop))
        own = np.array([item.outline.area for item in state.job.items])
        return not exact.conflicts, float(own @ exact.poses.scale**2)

    with tried[0].job.clock.time("finish"):
        return max(tried, key=worth)

"""Words of one common scale with room between them that goes by their letters."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.compaction.options import HAIR
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered
from packwork.pipeline.job import Job
from packwork.pipeline.plan.limits import check_padding, padded
from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps
from packwork.progress import Step, until_over
from packwork.readers.words.shaping import EM_PX
from packwork.recipe import AUTO
from packwork.scene.item import Item, VectorArt, bulge_between
from packwork.scene.pose import Poses
from packwork.solve.solver import Ending
from packwork.start.first_fit.tiled import tiled_fit
from packwork.start.stacked_lines import stacked_lines
from packwork.steps.place import first_angles
from packwork.steps.starts import ATTEMPTS, may_rearrange

BESIDE, ABOVE = 0.15, 0.015
"""Room between two words, ems of the smaller, along and across them. Larger draws less ink, 0.05
more beside 2 % of it; smaller lets two words of a line read as one. By eye."""

OF_ONE_COLOUR = 2.0
"""Factor on the room beside words that all have one colour, which nothing else tells apart. Larger
covers less, smaller reads "Anna" and "Maria" as one name. By eye."""

FEW_BETWEEN = 0.06
"""Gap between fewer words, ems. Larger covers less, smaller runs two of a line together. By eye."""

FEWEST = 30
"""Words from which it is so: with 12 the usual finish fills some shapes better. Measured."""

LINES_APART = 0.012
"""Room between two lines of few words, as a share of the canvas' longer side. By eye."""

ABREAST = 0.3
"""Room between words of a line, ems. Larger covers less, smaller runs them together. By eye."""

COVERED = 0.5
"""Share of the container that words come to cover, by which the least gap goes. Chosen."""


def goes_by_letters(job: Job) -> bool:
    """Whether a job is of many words and of nothing else, at one common scale and kept angles."""
    plan, are_words = job.plan, len(job.use.words) == len(job.items) >= FEWEST
    is_still = plan.rotation.is_still or bool(plan.rotation.choices)
    is_plain = not plan.method and not plan.share and may_rearrange(job)
    return plan.sizes == "shared" and are_words and is_still and is_plain


def least_gap(job: Job) -> float:
    """Gap that all words keep, canvas units: what was asked for, or the least room above.

    Unless a gap was asked for: the usual one is far more than small letters need.
    """
    return job.plan.gap if job.recipe.padding != AUTO else min(job.plan.gap, ABOVE * min(_ems(job)))


def gap_of_few(job: Job) -> float:
    """Gap between so few words at one common scale that the usual one runs them together.

    On thin pages the usual one is wider than such letters need, and less.
    """
    if job.recipe.padding != AUTO or job.plan.sizes != "shared" or len(job.items) >= FEWEST:
        return job.plan.gap
    smallest, largest = (FEW_BETWEEN * em for em in _ems(job))
    return max(min(job.plan.gap, largest), beside(job) / BESIDE * smallest)


def beside(job: Job) -> float:
    """Room beside words, ems of the smaller: more where all have one colour."""
    is_one = len(set(job.plan.palette)) == 1
    has_own = job.recipe.words is not None and job.recipe.words.color_by is not None
    return BESIDE * (OF_ONE_COLOUR if is_one and not has_own else 1.0)


def _ems(job: Job) -> tuple[float, float]:
    """Ems of the smallest and the largest word, canvas units, that cover as much as they come to.

    No larger than the container has room for each word by itself: on thin ones letters are small.
    """
    region = job.container.outline.region
    scales = np.sqrt(job.weights / [item.outline.area for item in job.items])
    covered = math.sqrt(COVERED * region.area / job.weights.sum())
    x0, y0, x1, y1 = region.bounds
    boxes = np.array([item.outline.bounds for item in job.items])
    sides, room = boxes[:, 2:] - boxes[:, :2], np.array([x1 - x0, y1 - y0])
    if job.plan.rotation.limit != 0.0:
        sides, room = np.sort(sides, axis=1), np.sort(room)
    # Limbs are about as wide as twice the area over the edge's length.
    limb = 2.0 * region.area / region.length
    most = np.minimum((room / sides).min(axis=1), limb / sides.min(axis=1)) / scales
    ems = EM_PX * min(covered, float(most.min())) * scales
    return float(ems.min()), float(ems.max())


@final
class FitWords(RunStep):
    """Places and common scale of words by tiled first fit, exact.

    Parameters
    ----------
    then
        Steps once there are some.
    otherwise
        Steps for a container in which no size is found so.
    """

    share = 1.0

    def __init__(self, then: Sequence[RunStep], otherwise: Sequence[RunStep]) -> None:
        self._then, self._otherwise = then, otherwise

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State in which no word comes nearer than the gap to another or to the edge."""
        job, heard = state.job, context.heard_by(state.recorder)
        plan, outlines = job.plan, job.solid_outlines
        check_padding(job.container, plan.gap, len(job.items))
        unit = np.sqrt(job.weights / [item.outline.area for item in job.items])
        ink = float(job.weights.sum()) / job.container.outline.area

        def tell(poses: Poses) -> None:
            covered = ink * float(poses.scale[0] / unit[0]) ** 2
            shares = (covered, 0.0, 0.0)
            heard.observer.on_step(
                Step(0, 1, 0, 0, covered, poses, lambda: shares, is_finish=True, stage="finish")
            )

        with job.clock.time("start"):
            rng = np.random.default_rng(plan.seed)
            # Were all of it covered: no scale is larger.
            largest = unit * math.sqrt(job.container.outline.area / job.weights.sum())
            spare = bulge_between(job.items, largest) + 2 * HAIR * job.container.side
            region = padded(job.container, plan.gap) if plan.gap else job.container
            poses = tiled_fit(
                region, outlines, unit, first_angles(job, rng), rng,
                apart=(beside(job) * EM_PX, ABOVE * EM_PX) if plan.gap else (0.0, 0.0),
                margin_cu=plan.gap + spare, attempts=ATTEMPTS[plan.effort],
                tell=tell, stop=until_over(context.stop, job.seconds_left(0.9)),
            )  # fmt: skip
        if poses is None:
            return run_steps(self._otherwise, state, context)
        ending = Ending.STOPPED if context.stop() else Ending.DONE
        found = replace(
            state, poses=poses, nominal=poses.scale, method="first-fit", is_tight=True,
            ending=ending,
        )  # fmt: skip
        return run_steps(self._then, found, context)


@final
class StackWords(RunStep):
    """Few words, in the lines, in the order and at the sizes that cover most.

    Parameters
    ----------
    otherwise
        Steps for a container that has no room for such lines.
    """

    share = 1.0

    def __init__(self, otherwise: Sequence[RunStep]) -> None:
        self._otherwise = otherwise

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of upright words, each in a box of its own."""
        job = state.job
        with job.clock.time("start"):
            base = np.array([_base_line(item) for item in job.items])
            boxes = np.array([outline.bounds for outline in job.solid_outlines])
            boxes[:, 1::2] -= base[:, None]
            gap = job.plan.gap + 2 * HAIR * job.container.side
            inner = buffered(job.container.outline.region, -gap)
            line_gap = max(gap, LINES_APART * job.container.side)
            room = None if inner.is_empty else Outline.from_region(inner)
            beside = ABREAST * EM_PX
            found = None if room is None else stacked_lines(room, boxes, line_gap, beside)
        if found is None:
            return run_steps(self._otherwise, state, context)
        scale, (x, y) = found[0], found[1].T
        poses = Poses(x.copy(), y - scale * base, np.zeros(len(x)), scale)
        return replace(
            state, poses=poses, nominal=scale, method="lines", is_tight=True, ending=Ending.DONE
        )


def _base_line(item: Item) -> float:
    """Height of a word's base line, item units; the bottom of what has several, or none."""
    if item.text is None or len({run.y for run in item.text.runs}) != 1:
        return item.outline.bounds[3]
    assert isinstance(item.art, VectorArt)  # noqa: S101 - what has text is drawn
    return float(item.art.matrix[1, 1] * item.text.runs[0].y + item.art.matrix[1, 2])

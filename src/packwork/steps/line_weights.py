"""Line drawings of all sizes with lines of one width, once sizes are known."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.phrasing import enumerated
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.readers.svg.thinner import (
    MOST_LOOKED,
    LineDrawing,
    has_traced_lines,
    line_drawing,
)
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.steps.finish import finished

_LOG = logging.getLogger("packwork")

THIN_ONES = 0.1
"""Share of the line drawings whose lines may stay thinner than the common width. Smaller lets a
single small copy make all lines hairs, larger leaves more lines that are thinner. By eye."""

ALIKE = 0.98
"""Factor on a line's width above which it is left as it is. Larger rewrites drawings for
changes that cannot be seen, and comes near what curves are followed to; smaller leaves steps.
Chosen."""


def evened(job: Job, poses: Poses, *, tells: bool = True) -> Job:
    """Job whose line drawings have lines of one width, as they lie.

    Lines only get thinner, so what was free stays free.
    """
    if not job.plan.has_even_lines:
        return job
    known: dict[Item, LineDrawing | None] = {}
    for item in job.items:
        if item not in known:
            known[item] = line_drawing(item)
    lines = [known[item] for item in job.items]
    widths = np.array([np.nan if line is None else line.width for line in lines]) * poses.scale
    if tells:
        _tell_of_traced(job.items)
    # What fills voids is small, and would make the lines of all others hairs.
    counted = widths[~np.isnan(widths) & (job.weights > 0)]
    if len(counted) == 0:
        if tells:
            _LOG.warning("stroke_width: even changes nothing, for no item is drawn in lines")
        return job
    common = float(np.quantile(counted, THIN_ONES, method="lower"))
    thinner: dict[tuple[Item, float], Item] = {}
    items = []
    for item, line, width in zip(job.items, lines, widths.tolist(), strict=True):
        if line is None or common > ALIKE * width:
            items.append(item)
            continue
        key = (item, common / width)
        if key not in thinner:
            thinner[key] = line.thinner(common / width, job.plan.holes) or item
            if tells and thinner[key] is item:
                _LOG.warning(
                    "%s: one copy keeps its wide lines; thinner ones cannot be followed",
                    item.source,
                )
        items.append(thinner[key])
    return replace(job, items=tuple(items))


UNLIKE = 3.0
"""Times as wide as others that lines have to be to be told. Larger passes pictures that look as if
several hands had drawn them, smaller blames free sizes that differ little. By eye."""


@final
class TellLineWeights(RunStep):
    """Advice on line drawings of free sizes, whose lines grow with them."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice."""
        job = state.job
        known: dict[Item, float] = {}
        widths = []
        for item, scale, weight in zip(job.items, state.poses.scale, job.weights, strict=True):
            if item not in known and len(known) < MOST_LOOKED:
                line = line_drawing(item)
                known[item] = np.nan if line is None else line.width
            widths.append(known.get(item, np.nan) * scale if weight > 0 else np.nan)
        found = np.array(widths)[~np.isnan(widths)]
        if len(found) < 2:
            return state
        thin, wide = np.quantile(found, [THIN_ONES, 1 - THIN_ONES])
        if wide < UNLIKE * thin:
            return state
        return state.with_finding(Sentence.UNLIKE_LINES, times=float(wide / thin))


def _tell_of_traced(items: Sequence[Item]) -> None:
    """A notice of drawings with lines whose outlines only their pictures tell."""
    names = dict.fromkeys(item.source for item in items if has_traced_lines(item))
    if names:
        _LOG.warning(
            "stroke_width: drawings that are traced from their pictures keep their lines as wide "
            "as they are: %s", enumerated(list(names)),
        )  # fmt: skip


@final
class EvenLines(RunStep):
    """Line drawings of all sizes with lines of one width, and notices of those that keep theirs."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose drawings are thinner."""
        with state.job.clock.time("finish"):
            job = evened(state.job, state.poses)
        return replace(state, job=job, has_thinner_lines=job.items is not state.job.items)


@final
class FinishThinner(RunStep):
    """Line drawings with lines of one width, which leave room for all to grow into."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose drawings are thinner, grown; as it is where no line gets thinner."""
        job = state.job
        with job.clock.time("finish"):
            thinner = job if context.stop() else evened(job, state.poses, tells=False)
            if thinner is job:
                return state
            state = replace(state, job=thinner, asked_for=thinner)
            return finished(state, context, grows=True)

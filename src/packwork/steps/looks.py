"""Looks of a layout in its places: colours, names, a picture from afar, and the film of its way."""

from __future__ import annotations

from dataclasses import replace
from typing import final

import numpy as np

from packwork.phrasing import number_of
from packwork.pipeline.earlier import new_items
from packwork.pipeline.plan.counts import items_needed
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.watch import RunContext
from packwork.scene.leaving import grown_in
from packwork.scene.target import TargetPicture
from packwork.steps.dress.colours import as_asked
from packwork.steps.dress.legible import legible
from packwork.steps.dress.likeness import in_picture
from packwork.steps.dress.recognised import unrecognised
from packwork.steps.left_behind import left_behind


@final
class Dress(RunStep):
    """Colours, names and links as rules, palette and data ask."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose layout is dressed."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            return replace(state, layout=as_asked(state.job, layout))


@final
class ShowPicture(RunStep):
    """Colours by which the items show a picture from afar, and advice where they do not."""

    def __init__(self, target: TargetPicture) -> None:
        self._target = target

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose layout is recoloured."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            layout = in_picture(state.job, self._target, layout)
        said = unrecognised(state.job, self._target, layout)
        return replace(state, layout=layout, advice=(*state.advice, *said))


@final
class StandOut(RunStep):
    """Colours and halos by which items stand out from a picture behind them."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose layout can be told from what is behind it."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            return replace(state, layout=legible(state.job, layout))


@final
class KeepTrack(RunStep):
    """The way of the items, as a recorder kept it."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose layout has a track; as it is where nothing was recorded."""
        if not state.recorder.is_on:
            return state
        (layout, _), asked = state.measured, state.asked_for
        track = state.recorder.track(layout.poses, state.numbers, layout.items)
        if asked.plan.stays:
            track = grown_in(track, np.flatnonzero(np.isin(state.numbers, new_items(asked))))
        placed = state.numbers[state.numbers < len(asked.items)]
        return replace(
            state, layout=replace(layout, track=track, leaving=left_behind(asked, placed))
        )


@final
class RemarkCount(RunStep):
    """A sentence about the number of items that the run chose."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the remark."""
        job = state.job
        width = items_needed(job.container, job.plan.sizes, job.plan.size_ratio).width_cu
        chosen = f"auto chose {number_of(len(job.items), 'item')}"
        said = f"{chosen}, to reach into parts {width:.3g} {job.container.unit} wide"
        return replace(state, remarks=(*state.remarks, said))

"""Film of a run: the way of its items as a recorder kept it, and those that are no more."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import IntArray
from packwork.pipeline.job import Job
from packwork.pipeline.recorder import Recorder
from packwork.pipeline.registration import SAME_AREA, match_items, new_items
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.container import brought_over
from packwork.scene.item import FlatArt, Item
from packwork.scene.recolour import has_one_colour, recoloured
from packwork.scene.track import Leaving, grown_in
from packwork.steps.warm_start import as_it_was


def left_behind(job: Job, placed: IntArray) -> Leaving | None:
    """Items of the earlier layout that are no more, where they were.

    Returns
    -------
    Leaving or None
        None without an earlier layout whose items are told by their names, or if none left.
    """
    before = job.earlier
    if before is None or not (job.plan.stays or job.use.matches_by_name):
        return None
    found = match_items(job, before)[placed]
    gone = np.setdiff1d(np.arange(len(before.items)), found)
    if len(gone) == 0:
        return None
    poses = brought_over(before.poses.subset(gone), before.container, job.container)
    items = [before.items[k] for k in gone]
    drawings = {item.name: item for item in (*job.use.redrawn(job, items), *job.items)}
    return Leaving(tuple(_drawn(item, drawings) for item in items), poses)


def _drawn(gone: Item, drawings: Mapping[str, Item]) -> Item:
    """An item of a layout file with the drawing of its name, if that is of its form."""
    drawing = drawings.get(gone.name)
    if drawing is None or abs(drawing.outline.area / gone.outline.area - 1) > SAME_AREA:
        return gone
    if isinstance(gone.art, FlatArt) and has_one_colour(drawing.art):
        drawing = recoloured(drawing, gone.art.fill)
    return replace(drawing, label=gone.label, text=None)


@final
class StartRecording(RunStep):
    """A recorder of the way of the items, which keeps the first poses.

    Of what was put one by one it keeps the largest first.
    """

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with a recorder."""
        recorder, poses = Recorder(), state.poses
        if state.method == "first-fit":
            areas = np.array([outline.area for outline in state.job.solid_outlines])
            order = np.argsort(-areas * poses.scale**2)
            for put in range(len(order)):
                recorder.keep(poses.subset(order[:put]), order[:put])
        recorder.keep(as_it_was(state.job, poses))
        return replace(state, recorder=recorder)


@final
class KeepTrack(RunStep):
    """The way of the items, as a recorder kept it."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose layout has a track; as it is where nothing was recorded."""
        if state.recorder is None:
            return state
        (layout, _), asked = state.measured, state.asked_for
        track = state.recorder.track(layout.poses, state.numbers, layout.items)
        if asked.plan.stays:
            track = grown_in(track, np.flatnonzero(np.isin(state.numbers, new_items(asked))))
        placed = state.numbers[state.numbers < len(asked.items)]
        return replace(
            state, layout=replace(layout, track=track, leaving=left_behind(asked, placed))
        )

"""The layout of a run with the way of its items, as a recorder kept it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.pipeline.earlier import new_items
from packwork.pipeline.film.left_behind import left_behind
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.job import Job
from packwork.scene.layout import Layout
from packwork.scene.leaving import grown_in


def with_track(layout: Layout, recorder: Recorder, ids: IntArray, job: Job) -> Layout:
    """The layout with its track; as it is where nothing was recorded.

    Parameters
    ----------
    ids
        ``(n,)`` what its items are called by in steps, as ``job`` numbers those asked for.
    """
    if not recorder.is_on:
        return layout
    track = recorder.track(layout.poses, ids, layout.items)
    if job.plan.stays:
        track = grown_in(track, np.flatnonzero(np.isin(ids, new_items(job))))
    placed = ids[ids < len(job.items)]
    return replace(layout, track=track, leaving=left_behind(job, placed))

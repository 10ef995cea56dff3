"""Items of an earlier layout that a run no longer has, for its film."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.pipeline.earlier import match_items
from packwork.pipeline.job import Job
from packwork.scene.canvas import brought_over
from packwork.scene.item import FlatArt, Item
from packwork.scene.leaving import Leaving
from packwork.scene.recolour import has_one_colour, recoloured

ALIKE = 1e-3
"""Share of an item's area by which its drawing may differ and still be taken for it. Larger
takes another drawing of the same name, smaller none where digits of a file are few. Chosen."""


def left_behind(job: Job, placed: IntArray) -> Leaving | None:
    """Items of the earlier layout that are no more, where they were.

    Returns
    -------
    Leaving or None
        None without an earlier layout whose items are told by their names, or if none left.
    """
    before = job.earlier
    if before is None or not (job.plan.stays or job.use.goes_on):
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
    if drawing is None or abs(drawing.outline.area / gone.outline.area - 1) > ALIKE:
        return gone
    if isinstance(gone.art, FlatArt) and has_one_colour(drawing.art):
        drawing = recoloured(drawing, gone.art.fill)
    return replace(drawing, label=gone.label, text=None)

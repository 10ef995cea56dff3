"""Words that grow together from where they lie, and keep the room beside them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import FloatArray
from packwork.finish.finish import finish
from packwork.finish.options import FinishOptions
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection, union
from packwork.geometry.polygon import Region
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import until_over
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.steps.finish import gap_with_bulge

MOST_GROWN = 300
"""Words that grow so at most: 100 cover 2 % more in a second, 1,000 in four. Measured."""

MOST_LARGER = 1.2
"""How much larger words become, at most. Derived from what curves reach beyond their polygons."""

BAND = (0.35, 0.65)
"""Part of a word's height at which bars keep others off. Wider keeps small words out of bays."""


Regions: TypeAlias = npt.NDArray[np.object_]


@final
class GrowWords(RunStep):
    """Exact finish of words that nothing turns, by outlines with a bar at either end.

    A bar is half of the room that there is beside a word, and no longer than half of what it is
    to keep: so bars never meet, and none asks for more than first fit has given.

    Parameters
    ----------
    beside
        Room that words keep beside them, item units.
    """

    def __init__(self, beside: float) -> None:
        self._beside = beside

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with larger words; as it is where some are turned, or none can grow."""
        job, poses = state.job, state.poses
        if len(poses) > MOST_GROWN or np.any(poses.angle):
            return state
        gap = gap_with_bulge(job, np.arange(len(poses)), MOST_LARGER * poses.scale)
        with job.clock.time("finish"):
            found = finish(
                job.container,
                barred(job.solid_outlines, poses, self._beside, gap, job.container),
                poses,
                FinishOptions(gap_cu=gap, sizes="shared", turning=False, refining=True),
                stop=until_over(context.stop, job.seconds_left(1.0)),
            )
        if not found.clean or found.poses.scale[0] <= poses.scale[0]:
            return state
        return replace(state, poses=found.poses, nominal=found.poses.scale)


def barred(
    outlines: Sequence[Outline], poses: Poses, beside: float, gap: float, container: Container
) -> list[Outline]:
    """Outlines of upright words with a bar at either end where there is room for it.

    ``beside``: twice the length of a bar at most, item units; ``gap``: that bars keep from each
    other, canvas units.
    """
    regions = np.array([o.mapped(poses.matrix(k)).region for k, o in enumerate(outlines)])
    left, top, right, bottom = shapely.bounds(regions).T
    high, low = (top + share * (bottom - top) for share in BAND)
    found = [[outline.region] for outline in outlines]
    for end, side in ((left, -1.0), (right, 1.0)):
        far = end + side * (beside * poses.scale + gap)
        bars = shapely.box(np.minimum(end, far), high, np.maximum(end, far), low)
        room = _free(bars, regions, container.outline.region, end, side, np.abs(far - end))
        lengths = np.minimum(beside * poses.scale, room - 2 * gap) / 2
        for k in np.flatnonzero(lengths > 0):
            own = np.array([end[k], end[k] + side * lengths[k]])
            x = (own - poses.x[k]) / poses.scale[k]
            y = (np.array([high[k], low[k]]) - poses.y[k]) / poses.scale[k]
            found[k].append(shapely.box(x.min(), y.min(), x.max(), y.max()))
    return [Outline.from_region(union(parts)) for parts in found]


def _free(
    bars: Regions,
    regions: Regions,
    container: Region,
    end: FloatArray,
    side: float,
    most: FloatArray,
) -> FloatArray:
    """``(n,)`` how far nothing lies beside each word in its bar; 0 where the edge does."""
    room = np.where(shapely.covers(container, bars), most, 0.0)
    first, second = shapely.STRtree(regions).query(bars, predicate="intersects")
    is_other = first != second
    first, second = first[is_other], second[is_other]
    near = shapely.bounds(intersection(bars[first], regions[second]))
    off = np.abs(near[:, 0 if side > 0 else 2] - end[first])
    np.minimum.at(room, first, off)
    return room

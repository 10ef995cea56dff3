"""Items that leave: those of an earlier layout that a new one lacks, and those that it adds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.scene.track import SCALE, Track, numbers_of, poses_of

GONE = 1 / 3
"""Time of a track by which items that leave have shrunk to nothing, and from which on new ones
grow. Larger lets the others run into them, smaller lets them vanish at a blow. Chosen by eye."""

GROWN = 2 / 3
"""Time of a track by which new items are as large as they were recorded. Larger hides how they
find their places, smaller lets them burst in among the others. Chosen by eye."""


@dataclass(frozen=True, eq=False, repr=False)
class Leaving:
    """Items that a layout has no more: they shrink away where they are, in a film's first third.

    Parameters
    ----------
    poses
        Where they were, as large as they ever are: as many as items.
    track
        Their way, in place of that: as of words that come and go within a series.

    Raises
    ------
    ShapeError
        If there are not as many poses as items.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> one = np.ones(1)
    >>> leaving = Leaving((Item("tri", "", ink, ink, FlatArt()),), Poses(one, one, one, 6 * one))
    >>> leaving
    <Leaving: 1 items>
    >>> [float(leaving.at(time).scale[0]) for time in (0, 1 / 6, 1)]
    [6.0, 3.0, 0.0]
    """

    items: tuple[Item, ...]
    poses: Poses
    track: Track | None = None

    def __post_init__(self) -> None:
        if len(self.items) != len(self.poses):
            raise ShapeError(
                f"there are {len(self.items)} items that leave, but {len(self.poses)} poses"
            )

    def __repr__(self) -> str:
        return f"<Leaving: {len(self)} items>"

    def __len__(self) -> int:
        return len(self.items)

    def at(self, time: float) -> Poses:
        """Poses at a time of 0 to 1."""
        return poses_of(self.sampled([time])[0])

    def sampled(self, times: npt.ArrayLike) -> FloatArray:
        """``(k, m, 5)`` numbers, as a track's, at k times."""
        if self.track is not None:
            return self.track.sampled(times)
        left = np.clip(1 - np.asarray(times, dtype=np.float64) / GONE, 0.0, 1.0)
        numbers = np.repeat(numbers_of(self.poses)[None], len(left), axis=0)
        numbers[:, :, SCALE] *= left[:, None]
        return numbers


def grown_in(track: Track, new: IntArray) -> Track:
    """The track with new items that grow where they come in, once those that leave are gone.

    Parameters
    ----------
    track
        Of all items; those that are new are in it at full size from the beginning.
    new
        ``(k,)`` indices of these.

    Examples
    --------
    >>> from packwork.scene.track import track_of
    >>> one = np.ones(1)
    >>> track = grown_in(track_of([Poses(one, one, one, one)] * 2), np.array([0]))
    >>> [round(float(track.at(time).scale[0]), 3) for time in (0, 1 / 3, 1 / 2, 2 / 3, 1)]
    [0.0, 0.0, 0.5, 1.0, 1.0]
    """
    if len(new) == 0:
        return track
    times = np.unique(np.concatenate([[0.0, GONE, GROWN, 1.0], track.times]))
    numbers = track.sampled(times)
    numbers[:, new, SCALE] *= np.clip((times - GONE) / (GROWN - GONE), 0.0, 1.0)[:, None]
    return Track(times, numbers)

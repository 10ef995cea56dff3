"""Keyframes of all items through a run, poses between them, and items that come and go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.scene.item import Item
from packwork.scene.pose import Poses

COLUMNS = tuple(field.name for field in fields(Poses))
"""What the last axis of a track's numbers holds."""

TURN = COLUMNS.index("angle")
SCALE = COLUMNS.index("scale")

EVEN = 0.35
"""Share of the time that goes to all steps alike; the rest goes to those in which items move.
Larger shows how long the last refinements take, smaller lets nothing stand still. Chosen by
eye."""

ARRIVAL = 0.1
"""Way, as a share of the whole, for which an item counts that was not there before. Larger
gives fillers more of the time, smaller lets all of them come at once. Chosen by eye."""


@dataclass(frozen=True, eq=False, repr=False)
class Track:
    """Keyframes of a run.

    Parameters
    ----------
    times
        ``(t,)`` when each is passed, rising from 0 to 1.
    numbers
        ``(t, n, 5)``: x, y, angle, scale and stretch, as in :class:`Poses`. An item that is
        not there yet has the scale 0. Angles go the short way from one to the next.

    Raises
    ------
    ShapeError
        If there are no keyframes, or not as many as times.

    Examples
    --------
    >>> x, one = np.array([5.0]), np.ones(1)
    >>> track = track_of([Poses(x, x, x, one), Poses(x + 2, x, x, one)])
    >>> track
    <Track: 2 keyframes of 1 items>
    >>> track.at(0.25).x.tolist()
    [5.5]
    """

    times: FloatArray
    numbers: FloatArray

    def __post_init__(self) -> None:
        if len(self.times) == 0 or len(self.times) != len(self.numbers):
            raise ShapeError(
                f"a track needs a time for each keyframe, not {len(self.times)} "
                f"for {len(self.numbers)}"
            )

    def __len__(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        return f"<Track: {len(self)} keyframes of {self.count} items>"

    @property
    def count(self) -> int:
        """Number of items."""
        return int(self.numbers.shape[1])

    def moved(self, x: float, y: float) -> Track:
        """The track moved by so much."""
        return Track(self.times, self.numbers + np.array([x, y, 0.0, 0.0, 0.0]))

    def at(self, time: float) -> Poses:
        """Poses at a time of 0 to 1; straight on between two keyframes.

        Examples
        --------
        >>> one = np.ones(1)
        >>> track_of([Poses(one, one, one, 0 * one), Poses(one, one, one, one)]).at(0.5).scale
        array([0.5])
        """
        return poses_of(self.sampled([time])[0])

    def sampled(self, times: npt.ArrayLike) -> FloatArray:
        """``(k, n, 5)`` numbers at k times."""
        wanted = np.clip(np.asarray(times, dtype=np.float64), self.times[0], self.times[-1])
        after = np.clip(np.searchsorted(self.times, wanted), 1, max(len(self) - 1, 1))
        before = after - 1
        after = np.minimum(after, len(self) - 1)
        span = self.times[after] - self.times[before]
        share = np.divide(wanted - self.times[before], span, out=np.ones_like(span), where=span > 0)
        mix = share[:, None, None]
        return np.asarray((1 - mix) * self.numbers[before] + mix * self.numbers[after])


def poses_of(numbers: FloatArray) -> Poses:
    """Poses from the ``(n, 5)`` numbers of one moment.

    Examples
    --------
    >>> poses_of(np.array([[1.0, 2.0, 0.5, 3.0, 1.0]])).scale.tolist()
    [3.0]
    """
    return Poses(*(numbers[:, k].copy() for k in range(len(COLUMNS))))


def numbers_of(poses: Poses) -> FloatArray:
    """``(n, 5)`` numbers of poses: the inverse of :func:`poses_of`.

    Examples
    --------
    >>> one = np.ones(1)
    >>> numbers_of(Poses(one, 2 * one, 0 * one, one)).tolist()
    [[1.0, 2.0, 0.0, 1.0, 1.0]]
    """
    return np.column_stack([getattr(poses, name) for name in COLUMNS])


def track_of(keyframes: Sequence[Poses], radii: FloatArray | None = None) -> Track:
    """Track of poses of the same items, one after another.

    ``keyframes``: at least one.
    ``radii``: ``(n,)`` radius of each item, its own units: how far a turn or a change of size moves
    its edge, by which steps in which much happens take longer. None: all take as long.
    """
    numbers = np.stack([numbers_of(poses) for poses in keyframes])
    numbers[:, :, TURN] = np.unwrap(numbers[:, :, TURN], axis=0)
    if radii is None:
        return Track(np.linspace(0.0, 1.0, len(numbers)), numbers)
    return Track(_paced(numbers, radii), numbers)


def _paced(numbers: FloatArray, radii: FloatArray) -> FloatArray:
    """Times at which items move about as fast all the time, without standing still."""
    if len(numbers) == 1 or numbers.shape[1] == 0:
        return np.linspace(0.0, 1.0, len(numbers))
    step = np.abs(np.diff(numbers, axis=0))
    size = radii * np.maximum(numbers[1:, :, SCALE], numbers[:-1, :, SCALE])
    moved = np.hypot(step[:, :, 0], step[:, :, 1])
    moved += size * step[:, :, TURN] + radii * step[:, :, SCALE]
    arriving = (numbers[:-1, :, SCALE] == 0) & (numbers[1:, :, SCALE] > 0)
    moved[arriving] = ARRIVAL * float(np.ptp(numbers[:, :, :2], axis=(0, 1)).max(initial=0.0))
    # The root: what moves ten times as far may well go three times as fast.
    lengths = np.sqrt(moved.mean(axis=1))
    even = np.full(len(lengths), 1 / len(lengths))
    total = float(lengths.sum())
    shares = EVEN * even + (1 - EVEN) * lengths / total if total > 0 else even
    times = np.concatenate([[0.0], np.cumsum(shares)])
    return np.asarray(times / times[-1])


GONE, GROWN = 1 / 3, 2 / 3
"""Times of a track by which items that leave have shrunk to nothing, new ones begin to grow, and by
which these are as large as recorded. Farther apart hides how new ones find their places, nearer
lets items vanish and burst in. Chosen by eye: a third each."""


@dataclass(frozen=True, eq=False, repr=False)
class Leaving:
    """Items that a layout has no more: they shrink away where they are, in a film's first third.

    ``poses``: where they were, as large as they ever are: as many as items.
    ``track``: their way, in place of that: as of words that come and go within a series.

    Raises ``ShapeError`` if there are not as many poses as items.

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

    ``track``: of all items; those that are new are in it at full size from the beginning.
    ``new``: ``(k,)`` indices of these.

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

"""An observer that keeps the way of the items, in bounded memory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.progress import Step
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.scene.track import COLUMNS, SCALE, Track, numbers_of, poses_of, track_of

EPOCHS_BETWEEN = 4
"""Epochs between two keyframes. Fewer cost time and show nothing more: items move by a few
thousandths of the canvas in each. Chosen."""

MOST_KEYFRAMES = 400
"""Keyframes kept at most; from then on every second is dropped, and every second that comes.
Each takes 40 bytes an item: 16 MB for 1,000 items. Fewer show quick moves as straight ones,
more take memory; films of ten seconds at 30 pictures a second have 300. Chosen."""

NEARER = 2.0
"""How many times nearer to the end than the last keyframe an earlier one has to be for what
came after it to count as undone. Larger shows detours, smaller cuts what was no detour.
Chosen."""


class Recorder:
    """Keeps keyframes of a run, fewer and fewer as it goes on.

    Examples
    --------
    >>> one = np.ones(1)
    >>> recorder = Recorder(most=4)
    >>> for k in range(9):
    ...     recorder.keep(Poses(k * one, one, one, one))
    >>> track = recorder.track(Poses(9 * one, one, one, one))
    >>> track.numbers[:, 0, 0].tolist()
    [0.0, 4.0, 8.0, 9.0]
    """

    every = EPOCHS_BETWEEN

    def __init__(self, most: int = MOST_KEYFRAMES) -> None:
        self._most = most
        self._frames: list[tuple[FloatArray, IntArray]] = []
        self._told, self._stride = 0, 1
        self._has_levels_behind = False

    def on_step(self, step: Step) -> None:
        """Keep where the items are, if it is the turn of this step."""
        if step.is_finish and not self._has_levels_behind:
            # However long the levels were, the finish's few rounds are all seen.
            self._has_levels_behind, self._told, self._stride = True, 0, 1
        self.keep(step.poses, step.ids)

    def keep(self, poses: Poses, ids: IntArray | None = None) -> None:
        """Keep poses, if it is their turn; ``ids`` as in :class:`packwork.progress.Step`."""
        if self._told % self._stride == 0:
            if len(self._frames) == self._most:
                del self._frames[1::2]
                self._stride *= 2
            if self._told % self._stride == 0:
                self._frames.append((numbers_of(poses), _called(poses, ids)))
        self._told += 1

    def track(
        self, poses: Poses, ids: IntArray | None = None, items: Sequence[Item] | None = None
    ) -> Track:
        """All that was kept, of the items that are there at the end.

        Parameters
        ----------
        poses
            Where they are at the end: the last keyframe.
        items
            By whose sizes the time is given out; None gives all steps as much.
        """
        called = _called(poses, ids)
        frames = [_of(called, numbers, before) for numbers, before in self._frames]
        frames = _without_detour([*frames, numbers_of(poses)])
        radii = None if items is None else np.array([item.ink.radius for item in items])
        return track_of([poses_of(numbers) for numbers in _arriving(frames)], radii)


def _called(poses: Poses, ids: IntArray | None) -> IntArray:
    return np.arange(len(poses)) if ids is None else ids


def _of(called: IntArray, numbers: FloatArray, ids: IntArray) -> FloatArray:
    """Numbers of the items ``called`` so, not a number for those that are not there."""
    found = np.full((len(called), len(COLUMNS)), np.nan)
    rows = {int(one): row for row, one in enumerate(ids)}
    here = [(k, rows[int(one)]) for k, one in enumerate(called) if int(one) in rows]
    if here:
        into, out_of = np.array(here).T
        found[into] = numbers[out_of]
    return found


def _without_detour(frames: list[FloatArray]) -> list[FloatArray]:
    """Keyframes without those after which a run went back to where it had been before."""
    end = frames[-1]
    away = np.array([_distance(frame, end) for frame in frames[:-1]])
    if len(away) == 0 or not np.isfinite(away).any():
        return frames
    nearest = int(len(away) - 1 - np.argmin(away[::-1]))
    if away[-1] > NEARER * away[nearest]:
        return [*frames[: nearest + 1], end]
    return frames


def _distance(frame: FloatArray, end: FloatArray) -> float:
    """Mean distance of items and end; infinite where some are missing."""
    away = float(np.hypot(*(frame - end)[:, :2].T).mean()) if len(end) else 0.0
    return np.inf if np.isnan(away) else away


def _arriving(frames: list[FloatArray]) -> list[FloatArray]:
    """Keyframes in which items that are not there yet wait where they will first be seen."""
    arrived = frames[-1]
    shown = []
    for frame in reversed(frames):
        absent = np.isnan(frame[:, SCALE])
        waiting = arrived.copy()
        waiting[:, SCALE] = 0.0
        frame = np.where(absent[:, None], waiting, frame)
        arrived = np.where(absent[:, None], arrived, frame)
        shown.append(frame)
    return shown[::-1]

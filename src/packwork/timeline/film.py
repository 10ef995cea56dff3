"""A film of a series: the layout of its last step, and the way of all words through the steps."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.item import Item
from packwork.scene.layout import Layout, Note
from packwork.scene.track import GONE, GROWN, SCALE, TURN, Leaving, Track, numbers_of, poses_of
from packwork.timeline.solve import Solved
from packwork.timeline.step import SeriesStep

NEARLY = 1e-6
"""Part of a length by which a key of one step may differ from that of another by rounding."""

STILL = 0.5
"""Share of each step's time in which nothing moves. Larger leaves more time to read and less to
follow. Chosen."""


def filmed(series: Solved) -> Layout:
    """Layout of the last step, with the track of its words and of all that steps before it had.

    Between two steps words that go shrink away first, then those that stay move and take on their
    new sizes, then new ones grow where they come in.
    """
    layout = series.runs[-1].layout
    seen = _seen(series)
    names = list(dict.fromkeys([*series.steps[-1].names, *seen]))
    pairs = zip(series.steps, series.runs, strict=True)
    numbers = np.stack([_numbers(step, run.layout, names) for step, run in pairs])
    times, keyframes = _keyframes(_waiting(numbers))
    count = len(layout.items)
    gone = tuple(seen[name] for name in names[count:])
    leaving = None
    if gone:
        track = Track(times, keyframes[:, count:])
        largest = poses_of(keyframes[:, count:].max(axis=0))
        leaving = Leaving(gone, largest, track)
    track = Track(times, keyframes[:, :count])
    return replace(layout, track=track, leaving=leaving, notes=_lasting(series))


def _lasting(series: Solved) -> tuple[Note, ...]:
    """Notes that are the same at all steps: keys are, a title with the step is not."""
    last = series.runs[-1].layout.notes
    others = [run.layout.notes for run in series.runs[:-1]]
    return tuple(
        note for note in last if all(any(_alike(note, one) for one in notes) for notes in others)
    )


def _alike(one: Note, other: Note) -> bool:
    same = (one.path, one.fill, one.says) == (other.path, other.fill, other.says)
    return same and np.allclose(one.matrix, other.matrix, rtol=NEARLY, atol=NEARLY)


def _seen(series: Solved) -> dict[str, Item]:
    """Each word as the first step that has it draws it."""
    pairs = reversed([*zip(series.steps, series.runs, strict=True)])
    return {
        name: item
        for step, run in pairs
        for name, item in zip(step.names, run.layout.items, strict=True)
    }


def _numbers(step: SeriesStep, layout: Layout, names: list[str]) -> FloatArray:
    """``(n, 5)`` numbers of all words at a step, not a number of those that it has not."""
    rows = {name: row for row, name in enumerate(step.names)}
    own = numbers_of(layout.poses)
    found = np.full((len(names), own.shape[1]), np.nan)
    for k, name in enumerate(names):
        if name in rows:
            found[k] = own[rows[name]]
    return found


def _waiting(numbers: FloatArray) -> FloatArray:
    """The same where words that a step has not lie, at no size, where they were or will be."""
    shown = numbers.copy()
    for steps in (range(1, len(shown)), range(len(shown) - 2, -1, -1)):
        by = 1 if steps.step > 0 else -1
        for step in steps:
            absent = np.isnan(shown[step, :, 0])
            shown[step, absent] = shown[step - by, absent]
    shown[:, :, SCALE] = np.where(np.isnan(numbers[:, :, 0]), 0.0, shown[:, :, SCALE])
    shown[:, :, TURN] = np.unwrap(shown[:, :, TURN], axis=0)
    return shown


def _keyframes(shown: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Times and keyframes of steps: still, then gone, moved, grown."""
    moments, keyframes = [0.0], [shown[0]]
    for step, (before, after) in enumerate(pairwise(shown)):
        goes = (before[:, SCALE] > 0) & (after[:, SCALE] == 0)
        comes = (before[:, SCALE] == 0) & (after[:, SCALE] > 0)
        gone = before.copy()
        gone[goes, SCALE] = 0.0
        # What comes waits where it is to come.
        gone[comes] = after[comes]
        gone[comes, SCALE] = 0.0
        moved = np.where(goes[:, None], gone, after)
        moved[comes, SCALE] = 0.0
        waits = before.copy()
        waits[comes] = gone[comes]
        for share, frame in ((0.0, waits), (GONE, gone), (GROWN, moved), (1.0, after)):
            moments.append(step + STILL + (1 - STILL) * share)
            keyframes.append(frame)
    # The last step stands still as long as the others.
    times = np.array([*moments, len(shown) - 1 + STILL])
    return times / times[-1], np.stack([*keyframes, shown[-1]])

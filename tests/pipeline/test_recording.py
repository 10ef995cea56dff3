"""Recordings: what is kept of a run, of whom, and what the result is not changed by."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork import uses
from packwork.pipeline.recorder import MOST_KEYFRAMES, Recorder
from packwork.recipe import make_recipe
from packwork.scene.pose import Poses
from packwork.scene.track import SCALE
from scenes import as_array, poses

QUICK = {"count": 8, "effort": "draft", "epochs": 40, "levels": "32,64", "seed": 2}


def recorded(**options: object) -> pw.Layout:
    return pw.fill("circle", ["star", "square"], record=True, **QUICK | options)


def test_a_track_leads_from_the_start_to_the_layout() -> None:
    layout = recorded()
    assert layout.track is not None
    assert len(layout.track) > 10
    np.testing.assert_array_equal(layout.track.at(1.0).x, layout.poses.x)
    np.testing.assert_array_equal(layout.track.at(1.0).scale, layout.poses.scale)
    assert np.hypot(*(layout.track.numbers[0] - layout.track.numbers[-1])[:, :2].T).max() > 1.0


def test_recording_changes_nothing_else() -> None:
    plain = pw.fill("circle", ["star", "square"], **QUICK)
    assert plain.track is None
    np.testing.assert_array_equal(as_array(plain.poses), as_array(recorded().poses))


def test_without_a_finish_there_is_a_track_too() -> None:
    layout = recorded(finish="none")
    assert layout.track is not None
    np.testing.assert_array_equal(layout.track.at(1.0).angle, layout.poses.angle)


def test_an_observer_is_told_as_often_as_without_a_recording() -> None:
    class Diary:
        every = 7

        def __init__(self) -> None:
            self.epochs: list[int] = []

        def on_step(self, step: pw.Step) -> None:
            self.epochs.append(step.epoch)

    alone, beside = Diary(), Diary()
    pw.fill("circle", "star", observer=alone, **QUICK)
    pw.fill("circle", "star", observer=beside, record=True, **QUICK)
    assert alone.epochs == beside.epochs
    assert len(alone.epochs) > 3


def test_fillers_grow_from_nothing_where_they_are_first_seen() -> None:
    run = uses.fill(make_recipe(container="circle", **QUICK, max_items=25), record=True)
    track, added = run.layout.track, len(run.layout.items) - 8
    assert track is not None
    assert added > 4
    late = track.numbers[:, 8:]
    assert (late[0, :, SCALE] == 0).all()
    assert (late[-1, :, SCALE] > 0).all()
    gone = (late[:-1, :, SCALE] > 0) & (late[1:, :, SCALE] == 0)
    assert not gone.any()
    first = np.argmax(late[:, :, SCALE] > 0, axis=0)
    for k, when in enumerate(first):
        np.testing.assert_array_equal(late[when - 1, k, :2], late[when, k, :2])


def test_the_last_step_is_no_jump() -> None:
    track = recorded(effort="normal").track
    assert track is not None
    steps = np.hypot(*np.diff(track.numbers[:, :, :2], axis=0).T)
    assert steps[:, -1].max() < 6.0


@pytest.mark.parametrize("told", [1, 7, 400, 401, 5_000])
def test_memory_is_bounded_and_the_end_is_kept(told: int) -> None:
    recorder, one = Recorder(), np.ones(3)
    for k in range(told):
        recorder.keep(Poses(k * one, one, one, one))
    track = recorder.track(Poses(told * one, one, one, one))
    assert min(told + 1, MOST_KEYFRAMES // 2) <= len(track) <= MOST_KEYFRAMES + 1
    assert track.numbers[0, 0, 0] == 0
    assert track.numbers[-1, 0, 0] == told
    assert np.ptp(np.diff(track.numbers[:-1, 0, 0])) == 0 if told > 1 else True


def test_items_are_followed_by_what_they_are_called() -> None:
    recorder = Recorder()
    recorder.keep(poses([1.0, 2.0], 0.0))
    recorder.keep(poses([1.0, 2.0, 30.0, 40.0], 0.0), np.array([0, 1, 2, 3]))
    recorder.keep(poses([1.0, 2.0, 40.0, 50.0], 0.0), np.array([0, 1, 3, 4]))
    track = recorder.track(poses([1.0, 2.0, 40.0, 50.0], 0.0), np.array([0, 1, 3, 4]))
    assert track.numbers[:, 2, 0].tolist() == [40.0] * 4
    assert track.numbers[:, 3, 0].tolist() == [50.0] * 4
    assert track.numbers[:, 3, SCALE].tolist() == [0.0, 0.0, 1.0, 1.0]


def test_what_was_undone_is_not_shown() -> None:
    recorder = Recorder()
    for x in (0.0, 4.0, 8.0, 30.0, 60.0):
        recorder.keep(poses([x], 0.0))
    assert recorder.track(poses([8.5], 0.0)).numbers[:, 0, 0].tolist() == [0.0, 4.0, 8.0, 8.5]

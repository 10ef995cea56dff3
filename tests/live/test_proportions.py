"""Layouts whose sizes are in proportion: an edit leaves them full, or is taken back and said."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import packwork as pw
from packwork.compaction import separate
from packwork.errors import RecipeError
from packwork.live import refilling
from packwork.live.refilling import MOST_RUINED
from packwork.progress import never

QUICK = {"effort": "draft"}
WEIGHTS = {f"word{k}": 30.0 / (k + 3) for k in range(16)}


def covered(layout: pw.Layout) -> float:
    return float(layout.metrics["LC"])


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("what", ["cloud", "icons"])
def test_a_move_of_the_largest_leaves_the_container_full_and_certified(
    what: str, seed: int
) -> None:
    if what == "cloud":
        layout = pw.words("heart", WEIGHTS, sizes="shared", seed=seed, **QUICK)
    else:
        layout = pw.fill("heart", "icons", count=10, sizes="shared", seed=seed, **QUICK)
    session = layout.edit()
    session.move(0, "50%", "60%")
    session.settle()
    assert session.layout.certified
    assert covered(session.layout) > covered(layout) - MOST_RUINED - 0.01


def test_marks_of_a_chart_keep_the_scale_that_its_keys_tell() -> None:
    rows = [{"land": f"land {k}", "kg": 5.0 * k} for k in range(1, 13)]
    layout = pw.chart("circle", rows, size_by="kg", **QUICK)
    session = layout.edit()
    for k, place in ((11, "20%"), (10, "75%"), (9, "50%")):
        session.move(k, place, "50%")
        session.settle()
    after = session.layout
    assert after.certified
    assert after.poses.scale == pytest.approx(layout.poses.scale, rel=2e-3)
    with pytest.raises(pw.RecipeError, match="as large as their numbers say"):
        session.scale(11, 2.0)


def test_numbers_of_a_chart_may_be_large(tmp_path) -> None:
    rows = [{"city": "Tokyo", "people": 3.7e7}, {"city": "Lagos", "people": 1.5e7}]
    layout = pw.chart("circle", rows, size_by="people", **QUICK)
    layout.save(tmp_path / "a.geojson")
    again = pw.Layout.load(tmp_path / "a.geojson")
    assert again.certified
    assert sorted(item.datum.value for item in again.items) == [1.5e7, 3.7e7]


def test_where_nothing_is_left_an_item_has_no_place(monkeypatch: pytest.MonkeyPatch) -> None:
    # What is left is so thin that its image would be as large as any.
    monkeypatch.setattr(separate, "MOST_SIDE", 256)
    session = pw.fill("square", "square", sizes="shared", rotate="none", **QUICK).edit()
    session.hold(0)
    session.add("star")
    session.move(1, "50%", "50%")
    assert not session.settle().certified


def test_of_several_runs_the_fullest_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    words = {"river": 30, "stone": 28, "moss": 27, "heron": 26, "otter": 24}
    session = pw.words("heart", words, sizes="shared", **QUICK).edit()
    before = session.document
    # As if the gesture had left all of them small.
    settled = before.with_poses(replace(before.poses, scale=before.poses.scale / 2))
    shares = iter((0.7, 0.9, 0.8, 0.9, 0.0))

    def poured(*_: object, **__: object) -> SimpleNamespace:
        if (share := next(shares)) == 0.0:
            raise RecipeError("items", "there is no room")
        scale = before.poses.scale * share
        smaller = before.with_poses(replace(before.poses, scale=scale))
        return SimpleNamespace(applied=lambda *_: smaller)

    monkeypatch.setattr(refilling, "poured_again", poured)
    found = refilling.refilled(before, before, settled, np.array([0]), never)
    assert found is not None
    assert found.document.covered == pytest.approx(0.81 * before.covered)
    # One that cannot be takes nothing from those before it.
    found = refilling.refilled(before, before, settled, np.array([0]), never)
    assert found is not None
    assert found.document.covered == pytest.approx(0.81 * before.covered)

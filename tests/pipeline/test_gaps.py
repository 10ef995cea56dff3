"""Voids filled: nothing overlaps, bounds hold, and the end is said."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork import pipeline, uses
from packwork.errors import RecipeError
from packwork.progress import Step
from packwork.recipe import make_recipe

QUICK = {"container": "circle", "items": ("star", "heart"), "count": 8, "epochs": 60,
         "levels": "40,120", "seed": 3, "effort": "draft"}  # fmt: skip


def run(**options: Any) -> pipeline.Run:
    return uses.fill(make_recipe(**QUICK | options))


def extents(layout: pw.Layout) -> np.ndarray:
    return np.array([item.outline.extent for item in layout.items]) * layout.poses.scale


def test_voids_are_filled_until_enough_is_covered() -> None:
    plain = run()
    assert plain.filling is None
    percent = int(100 * plain.metrics.exact.coverage) + 5
    full = run(target_coverage=percent / 100)
    assert full.filling is not None
    assert percent / 100 <= full.metrics.exact.coverage
    assert full.filling.covered == pytest.approx(full.metrics.exact.coverage, abs=1e-6)
    assert full.certified
    assert full.is_as_asked
    assert full.filling.ending == f"{percent} % are covered"
    assert len(full.layout.items) == 8 + full.filling.added
    assert full.layout.manifest["filling"]["added"] == full.filling.added


def test_the_count_and_the_smallest_size_end_it_too() -> None:
    few = run(target_coverage=0.99, max_items=20)
    assert few.filling is not None
    assert len(few.layout.items) == 20
    assert few.filling.ending == "20 items are the most that were asked for"
    coarse = run(target_coverage=0.99, smallest="8%")
    assert coarse.filling is not None
    assert coarse.filling.ending == "no void holds an item of 48 px"
    assert extents(coarse.layout)[8:].min(initial=99) >= 48 * (1 - 1e-3)
    for short in (few, coarse):
        assert short.certified
        assert short.filling is not None
        assert short.filling.is_short
        assert not short.is_as_asked


def test_without_a_target_as_much_as_goes_is_as_asked() -> None:
    full = run(max_items=15)
    assert full.is_as_asked
    assert len(full.layout.items) == 15


@pytest.mark.parametrize("sizes", ["shared", "fixed"])
def test_sizes_that_are_data_stay(sizes: str) -> None:
    options = {"sizes": sizes, "count": 6, "container": "circle"}
    plain, full = run(**options), run(**options, filler=("circle",), max_items=40)
    assert full.certified
    np.testing.assert_array_equal(full.layout.poses.scale[:6], plain.layout.poses.scale)
    np.testing.assert_array_equal(full.layout.poses.x[:6], plain.layout.poses.x)
    assert {item.name for item in full.layout.items[6:]} == {"circle"}
    assert full.layout.weights[6:].tolist() == [0.0] * (len(full.layout.items) - 6)
    with pytest.raises(
        RecipeError, match=f"max_items: adds smaller copies, though sizes are {sizes}; name "
    ):
        run(**options, max_items=40)


def test_padding_and_turns_hold_for_fillers() -> None:
    full = run(padding=4, rotate="0,90", max_items=40)
    assert full.certified
    assert full.metrics.exact.min_gap >= 4
    assert len(full.layout.items) > 12
    np.testing.assert_allclose(np.sin(2 * full.layout.poses.angle), 0, atol=1e-12)


def test_items_that_rules_hold_stay_and_fillers_look_like_them() -> None:
    rules = [{"items": "star", "color": "red", "pin": {"x": "50%", "y": "50%", "size": "20%"}}]
    full = run(rules=rules, count=6, max_items=30, palette="okabe-ito")
    assert full.certified
    assert len(full.layout.items) > 8
    pinned = next(k for k, item in enumerate(full.layout.items) if item.name == "star")
    assert full.layout.poses.x[pinned] == 300.0


def test_same_seed_same_layout() -> None:
    one, two = run(max_items=25), run(max_items=25)
    np.testing.assert_array_equal(one.layout.poses.x, two.layout.poses.x)
    np.testing.assert_array_equal(one.layout.poses.scale, two.layout.poses.scale)


def test_a_stop_ends_it() -> None:
    seen: list[Step] = []

    class Watcher:
        every = 1

        def on_step(self, step: Step) -> None:
            seen.append(step)

    def stop() -> bool:
        return len(seen) > 0 and len(seen[-1].poses) > 8

    recipe = make_recipe(**QUICK, max_items=900)
    ended = uses.fill(recipe, observer=Watcher(), stop=stop)
    assert ended.filling is not None
    assert ended.filling.ending == "the run was stopped"
    assert ended.certified
    assert 8 < len(ended.layout.items) < 900


def test_layouts_with_fillers_are_read_again(tmp_path) -> None:
    layout = pw.fill(**QUICK | {"sizes": "shared"}, filler=["circle"], max_items=30)
    layout.save(tmp_path / "a.geojson")
    layout.save(tmp_path / "a.svg")
    again = pw.Layout.load(tmp_path / "a.geojson")
    assert again.weights.tolist() == layout.weights.tolist()


def test_an_unfinished_layout_has_no_voids_to_fill() -> None:
    with pytest.raises(RecipeError, match="finish: none leaves overlaps"):
        run(max_items=20, finish="none")

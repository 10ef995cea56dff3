"""Runs that keep near an earlier layout: stable words, piles that change."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.pipeline.registration import matched

NAMES = ["owl", "fox", "bear", "wolf", "hare"]
WEIGHTS = {name: 40.0 / (k + 1) ** 0.5 for k, name in enumerate(NAMES)}
QUICK = {"epochs": 60, "levels": "50,150", "seed": 3, "effort": "draft"}


@pytest.fixture(scope="module")
def earlier(tmp_path_factory: pytest.TempPathFactory) -> tuple[pw.Layout, str]:
    layout = pw.words("circle", WEIGHTS, **QUICK)
    file = tmp_path_factory.mktemp("earlier") / "words.geojson"
    layout.save(file)
    return layout, str(file)


def _moved(before: pw.Layout, after: pw.Layout) -> dict[str, float]:
    """By name: how far each item that both have has moved, in canvases."""
    at = {i.name: p for i, p in zip(before.items, _centres(before), strict=True)}
    pairs = zip(after.items, _centres(after), strict=True)
    side = before.container.side
    return {i.name: float(np.hypot(*(p - at[i.name]))) / side for i, p in pairs if i.name in at}


def _centres(layout: pw.Layout) -> np.ndarray:
    return np.column_stack([layout.poses.x, layout.poses.y])


def test_one_weight_up_moves_few_words_and_keeps_sizes_true(
    earlier: tuple[pw.Layout, str],
) -> None:
    before, file = earlier
    weights = {**WEIGHTS, "bear": WEIGHTS["bear"] * 1.05}
    after = pw.words("circle", weights, start=file, stay=True, **QUICK)
    assert after.manifest["certified"]
    assert max(_moved(before, after).values()) < 1 / 30
    heights = {i.name: s for i, s in zip(after.items, after.poses.scale, strict=True)}
    for name, weight in weights.items():
        assert heights[name] / heights["owl"] == pytest.approx(weight / weights["owl"], rel=1e-3)


def test_a_fresh_run_of_other_weights_moves_them(earlier: tuple[pw.Layout, str]) -> None:
    """So that the test above can fail."""
    before, _ = earlier
    others = dict(zip(WEIGHTS, reversed(WEIGHTS.values()), strict=True))
    after = pw.words("circle", others, **QUICK)
    assert max(_moved(before, after).values()) > 1 / 30


def test_what_is_new_finds_a_place_and_what_is_gone_leaves(
    earlier: tuple[pw.Layout, str],
) -> None:
    weights = {k: v for k, v in WEIGHTS.items() if k != "fox"} | {"lynx": 15.0}
    after = pw.words("circle", weights, start=earlier[1], stay=True, **QUICK)
    assert {item.name for item in after.items} == set(weights)
    assert after.manifest["certified"]


def test_items_follow_to_another_container(earlier: tuple[pw.Layout, str]) -> None:
    before, file = earlier
    stayed = pw.words("square", WEIGHTS, start=file, stay=True, **QUICK)
    fresh = pw.words("square", WEIGHTS, **QUICK)
    assert stayed.manifest["certified"]
    assert np.mean([*_moved(before, stayed).values()]) < np.mean([*_moved(before, fresh).values()])


@pytest.mark.parametrize("container", ["circle", "square"])
def test_the_way_of_items_begins_at_the_earlier_layout(
    container: str, earlier: tuple[pw.Layout, str]
) -> None:
    before, file = earlier
    after = pw.words(container, WEIGHTS, start=file, stay=True, record=True, **QUICK)
    assert after.track is not None
    then = {item.name: k for k, item in enumerate(before.items)}
    order = [then[item.name] for item in after.items]
    first, last = after.track.at(0.0), after.track.at(1.0)
    np.testing.assert_allclose(first.x, before.poses.x[order], atol=1e-3)
    np.testing.assert_allclose(first.y, before.poses.y[order], atol=1e-3)
    np.testing.assert_allclose(first.scale, before.poses.scale[order], rtol=1e-3)
    np.testing.assert_array_equal(last.x, after.poses.x)


def test_a_pile_goes_on_from_where_it_was(tmp_path: Path) -> None:
    first = pw.pile("square", ["circle", "star"], count=8, size="12%", force="down")
    first.save(tmp_path / "pile.geojson")
    more = {"start": str(tmp_path / "pile.geojson"), "size": "12%"}
    same = pw.pile("square", ["circle", "star"], count=8, **more)
    # What leans may slide by a part of itself, as some do of any seed; most stay.
    moved = np.abs(_centres(same) - _centres(first)).max(axis=1)
    assert np.median(moved) < 6.0
    assert moved.max() < 30.0
    grown = pw.pile("square", ["circle", "star"], count=8, **(more | {"size": "14%"}))
    np.testing.assert_allclose(_centres(grown), _centres(first), atol=60.0)
    joined = pw.pile("square", ["circle", "star"], count=10, **more)
    assert len(joined.items) == 10
    assert all(layout.manifest["certified"] for layout in (same, grown, joined))


def test_copies_are_told_in_turn() -> None:
    assert matched(["a", "a", "b", "a"], ["a", "c", "a"]).tolist() == [0, 2, -1, -1]


def test_staying_needs_somewhere_to_stay(earlier: tuple[pw.Layout, str]) -> None:
    with pytest.raises(RecipeError, match="needs an earlier layout"):
        pw.words("circle", WEIGHTS, stay=True)
    with pytest.raises(RecipeError, match="has none of these items"):
        pw.words("circle", {"emu": 1, "yak": 2}, start=earlier[1], stay=True, **QUICK)

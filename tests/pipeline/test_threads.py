"""Whole runs in containers that are but lines."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import packwork as pw

ITEMS = ["star", "key", "tulip", "moon"]


def hairs() -> pw.Container:
    left = np.arange(100.0) * 6
    parts = list(shapely.box(left, 0, left + 1.0, 600.0))
    return pw.Container("hairs", outline=shapely.MultiPolygon(parts), width=600, height=600)


@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_items_in_hairs_are_spread_over_them(sizes: str) -> None:
    layout = pw.fill(hairs(), ITEMS, count=20, seed=1, sizes=sizes, padding=0, effort="draft")  # type: ignore[arg-type]
    assert layout.certified
    assert len(layout) == 20
    assert layout.manifest["start"] == "erosion"
    halves = np.column_stack([layout.poses.x > 300, layout.poses.y > 300]).mean(axis=0)
    assert (np.abs(halves - 0.5) <= 0.2).all()


def test_words_that_find_no_place_say_how_thin_the_lines_are() -> None:
    with pytest.raises(pw.RecipeError, match="it is lines 1 px wide"):
        pw.words(hairs(), {"one": 2.0, "two": 1.0}, sizes="graded")

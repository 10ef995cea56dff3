"""Runs that begin with an earlier layout: what is kept of it, and what is asked now."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from packwork import pipeline, uses
from packwork.errors import ReadError, RecipeError
from packwork.recipe import make_recipe
from packwork.writers import write

QUICK = {"container": "circle", "epochs": 25, "levels": "32,64", "effort": "draft"}


def run(**options: Any) -> pipeline.Run:
    return uses.fill(make_recipe(**(QUICK | options)))


@pytest.fixture(scope="module")
def three() -> pipeline.Run:
    """One run that all others begin with."""
    return run(items=["star", "circle", "heart"], count=7, seed=5, padding="0")


def test_an_earlier_layout_keeps_its_stretches_within_the_bounds_of_now(tmp_path: Path) -> None:
    options = {"items": ["square"], "count": 6}
    wide, file = run(**options, stretch=3, epochs=60), tmp_path / "earlier.geojson"
    before = wide.layout.poses.stretch
    write(wide.layout, file)
    for bound in (1.0, 1.2, 3.0):
        recipe = make_recipe(**(QUICK | options), start=str(file), stretch=bound, finish="none")
        after = uses.fill(recipe, stop=lambda: True).layout.poses.stretch
        np.testing.assert_allclose(after, np.clip(before, 1 / bound, bound), rtol=1e-12)
    assert before.max() > 1.2


def test_an_earlier_layout_is_where_the_next_run_begins(
    tmp_path: Path, three: pipeline.Run
) -> None:
    earlier = tmp_path / "earlier.geojson"
    write(three.layout, earlier)
    same = uses.fill(
        make_recipe(
            **QUICK, items=("star", "circle", "heart"), count=7, start=str(earlier), finish="none"
        ),
        stop=lambda: True,
    )
    np.testing.assert_array_equal(same.layout.poses.x, three.layout.poses.x)
    # The finish ends within a thousandth of the smallest size, the start does not go below it.
    np.testing.assert_allclose(same.layout.poses.scale, three.layout.poses.scale, rtol=1e-3)


@pytest.mark.parametrize("sizes", ["shared", "fixed"])
def test_an_earlier_layout_keeps_the_sizes_asked_for_now(
    sizes: str, tmp_path: Path, three: pipeline.Run
) -> None:
    earlier = tmp_path / "earlier.geojson"
    write(three.layout, earlier)
    layout = run(items=["star", "circle", "heart"], count=7, sizes=sizes, start=str(earlier)).layout
    if sizes == "shared":
        np.testing.assert_allclose(layout.areas / layout.areas.mean(), 1.0, rtol=1e-9)
    else:
        np.testing.assert_allclose(layout.poses.scale, 1.0, rtol=1e-12)


@pytest.mark.parametrize(("rotate", "allowed"), [("none", [0]), ("0,90", [0, 90])])
def test_an_earlier_layout_keeps_the_angles_asked_for_now(
    rotate: str, allowed: list[int], tmp_path: Path, three: pipeline.Run
) -> None:
    earlier = tmp_path / "earlier.geojson"
    write(three.layout, earlier)
    layout = run(
        items=["star", "circle", "heart"], count=7, rotate=rotate, start=str(earlier)
    ).layout
    assert {round(math.degrees(a), 9) for a in layout.poses.angle} <= set(allowed)


@pytest.mark.parametrize("canvas", ["200x150mm", "6in", "A5"])
def test_an_earlier_layout_follows_its_container_onto_another_canvas(
    canvas: str, tmp_path: Path, three: pipeline.Run
) -> None:
    earlier = tmp_path / "earlier.geojson"
    write(three.layout, earlier)
    options = {"items": ("star", "circle", "heart"), "count": 7, "start": str(earlier)}
    recipe = make_recipe(**QUICK, **options, canvas=canvas, finish="none")
    moved = uses.fill(recipe, stop=lambda: True).layout
    old, new = three.layout.container.outline, moved.container.outline
    scale = new.extent / old.extent
    for place, side in (("x", 0), ("y", 1)):
        before = getattr(three.layout.poses, place) - old.bounds[side]
        after = getattr(moved.poses, place) - new.bounds[side]
        np.testing.assert_allclose(after, before * scale, atol=1e-6 * new.extent)
    np.testing.assert_allclose(moved.poses.scale, three.layout.poses.scale * scale, rtol=1e-3)


def test_an_earlier_layout_of_another_number_of_items_is_refused(
    tmp_path: Path, three: pipeline.Run
) -> None:
    earlier = tmp_path / "earlier.geojson"
    write(three.layout, earlier)
    with pytest.raises(RecipeError, match=r"start: .* has 7 items, this run 2; give as many"):
        run(items=["star"], count=2, start=str(earlier))


def test_a_missing_earlier_layout_is_named() -> None:
    with pytest.raises(ReadError, match=r"nowhere\.geojson: there is no such file"):
        run(start="nowhere.geojson")

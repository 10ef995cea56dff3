"""Runs that begin from an earlier layout go on with it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw

ASKED: dict[str, Any] = {"count": 12, "effort": "draft", "seed": 4, "size_ratio": 2.0}
ITEMS = ["star", "heart", "owl", "circle"]


@pytest.fixture(scope="module")
def before() -> pw.Layout:
    return pw.fill("heart", ITEMS, **ASKED)


@pytest.fixture(scope="module")
def anew() -> pw.Layout:
    """The same from no layout, by another seed: what nothing holds in its place."""
    return pw.fill("heart", ITEMS, **(ASKED | {"seed": 9}))


def moved(before: pw.Layout, after: pw.Layout) -> float:
    """Longest way of an item, in canvases."""
    way = np.hypot(after.poses.x - before.poses.x, after.poses.y - before.poses.y)
    return float(way.max()) / before.container.side


def starts(layout: pw.Layout, folder: Path) -> dict[str, Any]:
    layout.save(folder / "layout.geojson")
    return {
        "layout": layout, "poses": layout.poses, "path": folder / "layout.geojson",
        "name": str(folder / "layout.geojson"),
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["layout", "poses", "path", "name"])
def test_a_finished_layout_stays_as_it_is(
    kind: str, before: pw.Layout, anew: pw.Layout, tmp_path: Path
) -> None:
    after = pw.fill("heart", ITEMS, start=starts(before, tmp_path)[kind], **ASKED)
    assert moved(before, after) < moved(before, anew) / 10
    assert after.metrics["LC"] > before.metrics["LC"] - 1e-3
    grown, otherwise = (
        np.abs(one.poses.scale / before.poses.scale - 1).max() for one in (after, anew)
    )
    assert grown < otherwise / 2
    assert after.certified


@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_other_seeds_change_nothing(sizes: str) -> None:
    shares = []
    for seed in range(4, 7):
        before = pw.fill("circle", ITEMS, sizes=sizes, **(ASKED | {"seed": seed}))
        after = pw.fill("circle", ITEMS, sizes=sizes, start=before, **(ASKED | {"seed": 9}))
        assert len(after) == len(before)
        anew = pw.fill("circle", ITEMS, sizes=sizes, **(ASKED | {"seed": 9}))
        shares.append(moved(before, after) / moved(before, anew))
    # A draft may be so poor that it is no start: which seed's that is differs among machines.
    assert np.median(shares) < 1 / 10


def test_a_little_disorder_is_put_right_where_it_is(before: pw.Layout, anew: pw.Layout) -> None:
    rng = np.random.default_rng(1)
    near = replace(before.poses, x=before.poses.x + rng.normal(0, 3, 12))
    after = pw.fill("heart", ITEMS, start=near, **ASKED)
    assert moved(before, after) < moved(before, anew) / 4
    assert after.certified


def test_a_heap_is_solved_anew(before: pw.Layout) -> None:
    heap = pw.Poses(np.full(12, 300.0), 300.0)
    after = pw.fill("heart", ITEMS, start=heap, **ASKED)
    assert after.certified
    assert len(np.unique(after.poses.x)) == 12


def test_poses_need_as_many_items() -> None:
    with pytest.raises(pw.RecipeError, match="start: has 2 poses, this run 12 items"):
        pw.fill("heart", ITEMS, start=pw.Poses([1, 2], 1), **ASKED)

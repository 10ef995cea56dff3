"""What a run promised, kept or broken."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from packwork.metrics.certificate import Promise, broken, off_shares, unclean
from packwork.metrics.exact import exact_metrics
from packwork.scene.layout import Layout
from scenes import flat_item, poses, square, square_container


def two_squares(gap: float, second: float = 10.0, weights: tuple[float, float] = (1, 1)) -> Layout:
    """Squares of half side 10 and ``second`` beside each other, inside the container."""
    item = flat_item("square", square())
    where = poses([30.0, 40.0 + gap + second], [50.0, 50.0], 0.0, [10.0, second])
    return Layout(square_container(), (item, item), where, np.array(weights, dtype=float))


def faults(layout: Layout, promise: Promise) -> tuple[str, ...]:
    return broken(promise, layout, exact_metrics(layout.outlines, layout.container.outline))


def test_a_clean_layout_keeps_its_promise() -> None:
    assert faults(two_squares(2.0), Promise(gap=1.9)) == ()


@pytest.mark.parametrize(
    ("gap", "promise", "said"),
    [
        (-1.0, Promise(), "items overlap by 20"),
        (0.0, Promise(), "the smallest gap is 0 instead of 0.0001 or more"),
        (2.0, Promise(gap=2.1), "the smallest gap is 2 instead of 2.1 or more"),
        (56.0, Promise(), "items stick out by 400"),
    ],
)
def test_what_is_broken_is_said(gap: float, promise: Promise, said: str) -> None:
    found = faults(two_squares(gap), promise)
    assert len(found) == 1
    assert found[0].startswith(said)


def test_shares_are_checked_to_a_thousandth() -> None:
    promise = Promise(areas_in_shares=True)
    assert faults(two_squares(2.0, 20.0, (1, 4)), promise) == ()
    assert "areas are off the shares" in faults(two_squares(2.0, 20.0, (1, 3.98)), promise)[0]


def test_of_specks_areas_are_checked_to_the_precision_of_files() -> None:
    promise = Promise(areas_in_shares=True)
    # Of a square of half side 1e-3, a grid of 1e-5 may take and give a fiftieth.
    assert faults(two_squares(2.0, 1e-3, (1e8, 1.01)), promise) == ()
    assert "areas are off the shares" in faults(two_squares(2.0, 1e-3, (1e8, 1.2)), promise)[0]


@pytest.mark.parametrize(
    ("manifest", "promise"),
    [
        ({}, None),
        ({"promised": None}, None),
        ({"promised": {"gap": "wide"}}, None),
        ({"promised": {"gap": -1}}, None),
        ({"promised": {"gap": float("nan")}}, None),
        ({"promised": {}}, Promise()),
        ({"promised": {"gap": 2, "areas_in_shares": True}}, Promise(2.0, True)),
    ],
)
def test_promises_are_read_from_manifests(manifest: dict[str, Any], promise: object) -> None:
    assert Promise.of(manifest) == promise


def test_shares_are_no_matter_of_the_certificate() -> None:
    layout = two_squares(2.0, 20.0, (1, 3.98))
    promise = Promise(0.0, areas_in_shares=True)
    exact = exact_metrics(layout.outlines, layout.container.outline)
    assert not unclean(promise, layout, exact)
    assert broken(promise, layout, exact) == off_shares(promise, layout) != ()

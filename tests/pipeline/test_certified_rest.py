"""What cannot be placed is not drawn, the rest is certified, and sizes not met are told."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork import pipeline, uses, writers
from packwork.geometry.outline import Outline
from packwork.metrics.certificate import Promise, broken
from packwork.metrics.exact import exact_metrics
from packwork.pipeline.plan.counts import widest_cu
from packwork.readers.layouts.read import read_written
from packwork.recipe import make_recipe
from packwork.steps import shortfalls
from scenes import flat_item, square, square_container

QUICK = {"epochs": 20, "levels": "32,64", "effort": "draft"}


def _crowded() -> pipeline.Run:
    """Nine tiles of a size of which four fit."""
    tile = flat_item("tile", square(24.0))
    recipe = make_recipe(container="square", items=["tile"], count=9, sizes="fixed", **QUICK)
    return uses.fill(recipe, [tile], square_container(100.0))


def test_what_is_not_placed_is_not_drawn(tmp_path: Path) -> None:
    met = _crowded()
    drawn, told = len(met.layout.items), met.report()
    assert 0 < drawn < 9
    assert (told["items"], told["placed"], len(told["unplaced"])) == (9, drawn, 9 - drawn)
    assert met.certified
    assert not met.is_as_asked
    assert sorted(one.index for one in met.unplaced) == sorted({o.index for o in met.unplaced})
    for ending in ("svg", "geojson"):
        writers.write(met.layout, tmp_path / f"rest.{ending}")
        found = read_written(tmp_path / f"rest.{ending}")
        assert len(found.items) == drawn
        exact = exact_metrics(found.outlines, found.container.outline)
        assert broken(Promise(), found, exact) == ()


def test_if_nothing_is_left_nothing_is_certified() -> None:
    giant = flat_item("giant", square(60.0))
    recipe = make_recipe(container="square", items=["giant"], sizes="fixed", **QUICK)
    met = uses.fill(recipe, [giant], square_container(100.0, 20.0))
    assert len(met.layout.items) == 0
    assert not met.certified
    assert met.report()["placed"] == 0
    json.dumps(met.report()["unplaced"])


def test_the_way_of_what_was_left_out_is_left_out() -> None:
    tile = flat_item("tile", square(24.0))
    recipe = make_recipe(container="square", items=["tile"], count=9, sizes="fixed", **QUICK)
    met = uses.fill(recipe, [tile], square_container(100.0), record=True)
    assert met.layout.track is not None
    np.testing.assert_allclose(met.layout.track.at(1.0).x, met.layout.poses.x)


def test_a_hero_that_found_no_room_says_what_came_of_it() -> None:
    bar, tile = flat_item("bar", square(9.0)), flat_item("tile", square(9.0))
    recipe = make_recipe(
        container="stripe:6", items=["bar", "tile"], count=2, hero="bar=30%", rotate="none", **QUICK
    )
    met = uses.fill(recipe, [bar, tile])
    (said,) = met.broken
    assert "30 % asked; it has no place at that size" in said
    assert "the container's widest place is 17 % across" in said
    assert said.startswith("bar (item ")
    assert met.certified
    assert not met.unplaced
    assert met.report()["placed"] == 2
    assert not met.is_as_asked


def test_the_widest_place_is_worked_out_once_for_all(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[float] = []

    def widest(outline: Outline, tolerance: float) -> float:
        asked.append(tolerance)
        return widest_cu(outline, tolerance)

    monkeypatch.setattr(shortfalls, "widest_cu", widest)
    # No two squares of half its width lie side by side in a circle.
    rules = [{"items": "tile", "pin": {"size": "49%"}}]
    recipe = make_recipe(container="circle", items=["tile"], count=3, rules=rules, **QUICK)
    met = uses.fill(recipe, [flat_item("tile", square(9.0))])
    assert len([said for said in met.broken if "widest place is 100 % across" in said]) >= 2
    assert len(asked) == 1


def test_a_size_of_a_rule_that_is_not_met_is_told() -> None:
    layout = pw.fill(
        "square", "star", count=3, rules=[{"items": "star", "scale": [0.9, 1.1]}], **QUICK
    )
    assert layout.manifest["unplaced"] == []


@pytest.mark.parametrize("size", ["1e308", "1e-300", "-1", "1e10%"])
def test_sizes_that_cannot_be_computed_with_are_refused(size: str) -> None:
    with pytest.raises(pw.PackworkError, match="use a length"):
        uses.pile_recipe("square", ["star"], size=size)


@pytest.mark.parametrize(
    "options",
    [
        {"hero": "star@1e308%,1%=1%"},
        {"force": ["balance 1e308,1"]},
        {"force": ["down reach=1e300"]},
        {"rules": [{"items": "star", "pin": {"x": "1e308%"}}]},
        {"padding": "1e308"},
    ],
)
def test_lengths_and_places_have_bounds(options: dict[str, object]) -> None:
    with pytest.raises(pw.PackworkError, match=r"length|balance"):
        make_recipe(container="square", items=["star"], **options)


def test_a_pile_in_which_nothing_fits_is_refused_in_one_line() -> None:
    recipe = uses.pile_recipe(
        "square", ["owl"], count=2, size="40%", open="left", compact=True, canvas="200x20mm",
        padding="20%",
    )  # fmt: skip
    with pytest.raises(pw.PackworkError, match="none of the 2 items fits"):
        uses.fill(recipe)

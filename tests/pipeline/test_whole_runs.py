"""Whole runs keep what they promise, or say that they do not, whatever they are asked."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from packwork import pipeline, uses
from packwork.errors import PackworkError
from packwork.metrics.certificate import SHARE_TOLERANCE, Promise, broken
from packwork.metrics.measure import measure
from packwork.readers.layouts.read import read_written
from packwork.recipe import make_recipe
from packwork.scene.layout import Layout
from packwork.writers import write
from scenarios import Scenario, any_scenario
from scenes import disc, flat_item, poses, square_container, star


def run_of(scenario: Scenario) -> pipeline.Run:
    recipe = make_recipe(container="made up", items=["-"], **scenario.options)
    return uses.fill(recipe, scenario.items, scenario.container)


def met(layout: Layout) -> list[str]:
    """What overlaps or sticks out, by geometry that no part of the package shares."""
    regions = [outline.region for outline in layout.outlines]
    whole = layout.container.outline.region
    found = [f"{k} is not inside" for k, one in enumerate(regions) if not whole.contains(one)]
    for i, j in shapely.STRtree(regions).query(regions, predicate="intersects").T:
        if i < j:
            found.append(f"{i} meets {j}")
    return found


def check(scenario: Scenario, folder: Path) -> pipeline.Run | None:
    """Run it, and see that it keeps its word; None if it was refused in so many words."""
    run = None
    with suppress(PackworkError):
        run = run_of(scenario)
    if run is None:
        return None
    check_accounts(scenario, run)
    check_certificate(run)
    if run.certified:
        check_file(run, folder / "run.geojson")
    return run


def check_accounts(scenario: Scenario, run: pipeline.Run) -> None:
    """Every item is there once, of a size and turn that were asked for."""
    layout, options = run.layout, scenario.options
    poses, count = layout.poses, options["count"]
    added = 0 if run.filling is None else run.filling.added
    assert len(layout.items) + run.left_out == count + added
    assert len(layout.items) <= options.get("max_items", count)
    gone = {one.index for one in run.unplaced} if run.left_out else set()
    asked = [scenario.items[k % len(scenario.items)].name for k in range(count) if k not in gone]
    assert [item.name for item in layout.items[: len(asked)]] == asked
    numbers = np.array([poses.x, poses.y, poses.angle, poses.scale, poses.stretch])
    assert np.isfinite(numbers).all()
    assert (poses.scale > 0).all()
    if options["sizes"] == "fixed":
        np.testing.assert_array_equal(poses.scale, 1.0)
    if options["sizes"] == "shared" and len(layout.items):
        assert np.ptp(layout.areas) <= SHARE_TOLERANCE * layout.areas.mean()
    upright = np.abs(np.remainder(poses.angle + np.pi, 2 * np.pi) - np.pi)
    if options["rotate"] == "none":
        assert (upright == 0).all()
    if options["rotate"] == "20":
        assert (upright <= np.radians(20) + 1e-9).all()
    if options["rotate"] == "0,90":
        np.testing.assert_allclose(np.sin(2 * upright), 0, atol=1e-9)


def check_certificate(run: pipeline.Run) -> None:
    """Nothing meets, or the run says what does."""
    if run.certified:
        assert met(run.layout) == []
    else:
        assert run.unplaced or run.broken


def check_file(run: pipeline.Run, path: Path) -> None:
    """What was written keeps the certificate."""
    write(run.layout, path)
    again = read_written(path)
    promise = Promise.of(again.manifest)
    assert promise is not None
    assert broken(promise, again, measure(again).exact) == ()
    assert met(again) == []


@settings(max_examples=12)
@given(scenario=any_scenario())
def test_runs_keep_their_word(tmp_path_factory: pytest.TempPathFactory, scenario: Scenario) -> None:
    check(scenario, tmp_path_factory.mktemp("runs"))


def test_most_plain_scenarios_end_certified(tmp_path: Path) -> None:
    plain = {"count": 8, "epochs": 20, "levels": "24,48", "effort": "draft", "rotate": "free"}
    container, items = square_container(), (flat_item("star", star(3.0)), flat_item("disc", disc()))
    for sizes in ("free", "shared", "fixed"):
        run = check(Scenario(container, items, plain | {"sizes": sizes}), tmp_path)
        assert run is not None
        assert run.certified


def test_the_checks_can_fail() -> None:
    container, item = square_container(), flat_item("disc", disc(10.0))
    good = Layout(container, (item, item), poses([30, 60], [50, 50]), np.ones(2))
    bad = Layout(container, (item, item), poses([10, 25], [50, 50]), np.ones(2))
    assert met(good) == []
    assert met(bad) == ["0 is not inside", "0 meets 1"]

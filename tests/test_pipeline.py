"""From a recipe to a measured layout: every stage together, on small images."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork import pipeline, precompile, uses
from packwork.errors import ReadError, RecipeError
from packwork.geometry.simplify import hull
from packwork.losses.term import Term
from packwork.metrics.measure import measure
from packwork.recipe import make_recipe
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.solve.solver import Ending
from packwork.writers import geojson_text, json_bytes
from scenes import disc, flat_item, overlap_area, square, square_container

QUICK = {"container": "circle", "epochs": 25, "levels": "32,64", "effort": "draft"}


def run(**options: Any) -> pipeline.Run:
    return uses.fill(make_recipe(**(QUICK | options)))


def features(layout: Layout) -> list[Any]:
    """Item features of the layout's file, as text is compared: bit for bit."""
    collection = json.loads(geojson_text(layout))
    return [f for f in collection["features"] if f["properties"]["role"] == "item"]


@pytest.fixture(scope="module")
def three() -> pipeline.Run:
    """One run for all tests that only look."""
    return run(items=["star", "circle", "heart"], count=7, seed=5)


def test_items_repeat_in_turn(three: pipeline.Run) -> None:
    names = [item.name for item in three.layout.items]
    assert names == ["star", "circle", "heart", "star", "circle", "heart", "star"]


def test_without_a_count_there_is_one_of_each() -> None:
    assert len(run(items=["star", "circle"]).layout.items) == 2


def test_fewer_than_given_takes_the_first() -> None:
    names = [item.name for item in run(items=["star", "circle"], count=1).layout.items]
    assert names == ["star"]


def test_the_manifest_says_what_was_done(three: pipeline.Run) -> None:
    manifest = three.layout.manifest
    assert manifest["seed"] == 5
    assert manifest["recipe"]["container"] == "circle"
    assert [level["resolution"] for level in manifest["levels"]] == [32, 64]
    assert sum(level["epochs"] for level in manifest["levels"]) == 25
    assert manifest["metrics"] == three.metrics.as_dict()
    assert json.loads(json_bytes(manifest))["packwork"]


def test_the_recipe_of_the_manifest_makes_the_same_layout(three: pipeline.Run) -> None:
    again = uses.fill(make_recipe(**three.layout.manifest["recipe"]))
    assert features(again.layout) == features(three.layout)


def test_the_metrics_are_those_of_the_layout(three: pipeline.Run) -> None:
    assert measure(three.layout) == three.metrics


def test_the_report_has_the_promised_keys(three: pipeline.Run) -> None:
    report = three.report({"write": 1.0}, start_up_seconds=2.0)
    assert report.keys() >= {
        "metrics", "seconds", "items", "placed", "unplaced", "certified", "seed",
    }  # fmt: skip
    assert report["metrics"].keys() >= {"LC", "LC_ratio", "OO", "EA", "LnU", "exact"}
    assert report["metrics"]["exact"].keys() >= {"overlap_area", "outside_area", "min_gap"}
    assert report["seconds"].keys() >= {"start-up", "read", "start", "levels", "write", "total"}
    parts = sum(v for part, v in report["seconds"].items() if part != "total")
    assert report["seconds"]["total"] == pytest.approx(parts)
    assert (report["items"], report["placed"], report["certified"]) == (7, 7, True)


def test_seeds_differ() -> None:
    first, again, other = (run(items=["star"], count=3, seed=seed).layout for seed in (1, 1, 2))
    assert features(first) == features(again)
    assert features(first) != features(other)


@pytest.mark.parametrize("start", ["distance-field", "scatter"])
def test_shared_sizes_keep_areas_in_the_shares_of_the_weights(start: str) -> None:
    weights = {"star": 3.0, "circle": 1.0, "heart": 0.5}
    met = run(items=list(weights), count=6, sizes="shared", weights=weights, start=start)
    layout = met.layout
    np.testing.assert_allclose(
        layout.areas / layout.areas.sum(), layout.weights / layout.weights.sum(), rtol=1e-9
    )
    assert layout.weights.tolist() == [3, 1, 0.5, 3, 1, 0.5]


def test_fixed_sizes_are_as_given() -> None:
    layout = run(items=["star", "circle"], sizes="fixed").layout
    np.testing.assert_allclose(layout.poses.scale, 1.0, rtol=1e-12)


def test_heavier_items_end_larger_where_sizes_are_free() -> None:
    layout = run(items=["circle", "square"], weights={"circle": 4, "square": 1}, count=8).layout
    areas = layout.areas
    assert areas[0::2].min() > areas[1::2].max()


@pytest.mark.parametrize(
    ("rotate", "allowed"), [("none", {0}), ("0,90", {0, 90}), ("-45,45", {-45, 45})]
)
def test_only_the_angles_asked_for(rotate: str, allowed: set[int]) -> None:
    layout = run(items=["star", "heart"], count=12, rotate=rotate).layout
    assert {round(math.degrees(a), 9) for a in layout.poses.angle} == allowed


def test_a_rotation_limit_holds() -> None:
    layout = run(items=["star", "heart"], count=8, rotate="20").layout
    turned = np.abs(np.degrees(layout.poses.angle))
    assert 1 < turned.max() <= 20 * (1 + 1e-12)


def test_weights_from_a_table(tmp_path: Path) -> None:
    table = tmp_path / "weights.csv"
    table.write_text("name,weight\nstar,2.5\n", encoding="utf-8")
    layout = run(items=["star", "circle"], weights=str(table)).layout
    assert layout.weights.tolist() == [2.5, 1.0]


def test_a_weight_for_nobody_names_who_is_there() -> None:
    with pytest.raises(RecipeError, match=r"weights: no item is called 'moon'.*circle, star"):
        run(items=["star", "circle"], weights={"moon": 2})


@pytest.mark.parametrize("weight", [0, -1, float("nan"), float("inf")])
def test_a_weight_must_be_positive(weight: float) -> None:
    with pytest.raises(RecipeError, match="weights: the weight of star must be positive"):
        run(items=["star"], weights={"star": weight})


def test_stopping_gives_what_there_is() -> None:
    stopped = uses.fill(make_recipe(**QUICK, items=("star",), count=4), stop=lambda: True)
    assert stopped.ending is Ending.STOPPED
    assert len(stopped.layout.items) == 4
    assert stopped.report()["ending"] == Ending.STOPPED.value


@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_items_are_stretched_as_far_as_asked_and_no_further(sizes: str) -> None:
    items, weights = ["square", "stripe:3"], {"square": 2.0}
    plain, free = (
        run(items=items, weights=weights, count=8, sizes=sizes, stretch=stretch, epochs=60).layout
        for stretch in (1.0, 1.5)
    )
    assert (plain.poses.stretch == 1.0).all()
    away = np.abs(np.log(free.poses.stretch))
    assert 0.1 < away.max() <= math.log(1.5) * (1 + 1e-12)
    np.testing.assert_allclose([o.area for o in free.outlines], free.areas, rtol=1e-9)
    if sizes == "shared":
        np.testing.assert_allclose(free.areas[0::2] / free.areas[1::2], 2.0, rtol=1e-9)


@pytest.mark.parametrize("sizes", ["free", "shared"])
def test_what_is_measured_is_the_true_outline_whatever_the_solver_saw(sizes: str) -> None:
    weights = {"star": 3.0}
    met = run(items=["star", "heart"], count=6, sizes=sizes, weights=weights, outline="hull")
    true = run(items=["star", "heart"], count=6, sizes=sizes, weights=weights)
    own = [item.outline.area for item in true.layout.items]
    assert [item.outline.area for item in met.layout.items] == own
    assert measure(met.layout) == met.metrics
    assert features(met.layout) != features(true.layout)
    if sizes == "shared":
        areas = met.layout.areas
        np.testing.assert_allclose(areas[0::2] / areas[1::2], 3.0, rtol=1e-9)


def test_hulls_do_not_reach_into_each_other() -> None:
    """Moons pack well into each other's bays; their hulls may not."""
    options = {"items": ["moon"], "count": 12, "epochs": 250, "levels": "64,128", "seed": 1}
    exact, hulls = (run(**options, outline=choice).layout for choice in ("exact", "hull"))
    shared = [overlap_area([hull(o) for o in layout.outlines]) for layout in (exact, hulls)]
    assert shared[1] < shared[0]


@pytest.mark.parametrize(
    ("canvas", "size"), [(600, 90.0), ("6in", 90 / 96), ("150mm", 90 * 25.4 / 96)]
)
def test_fixed_sizes_are_real_sizes(canvas: str | float, size: float) -> None:
    item = flat_item("tile", square(45.0))
    recipe = make_recipe(**QUICK, items=["tile"], sizes="fixed", canvas=canvas)
    (outline,) = uses.fill(recipe, [item]).layout.outlines
    assert outline.area == pytest.approx(size**2, rel=1e-9)


@pytest.mark.parametrize("canvas", ["8in", "20cm"])
def test_the_unit_of_the_canvas_changes_nothing_but_the_numbers(canvas: str) -> None:
    side_px = {"8in": 768, "20cm": 20 / 2.54 * 96}[canvas]
    in_px, in_unit = (
        # Few epochs: what rounding differs by grows with each.
        run(items=["star", "heart"], count=5, canvas=size, epochs=3, finish="none").layout
        for size in (side_px, canvas)
    )
    scale = in_unit.container.side / in_px.container.side
    np.testing.assert_allclose(in_unit.poses.x, in_px.poses.x * scale, rtol=1e-6)
    np.testing.assert_allclose(in_unit.areas, in_px.areas * scale**2, rtol=1e-6)


def test_a_container_that_was_read_is_fitted_onto_the_canvas_asked_for() -> None:
    item, given = flat_item("tile", square(9.0)), square_container(100.0)
    kept, moved = (
        uses.fill(make_recipe(**QUICK, items=["tile"], canvas=canvas), [item], given).layout
        for canvas in (None, "80x40mm")
    )
    assert kept.container is given
    assert moved.container.canvas == {"width": 80, "height": 40, "unit": "mm"}
    assert moved.container.outline.bounds == pytest.approx((22, 2, 58, 38))


@pytest.mark.parametrize(
    ("finish", "reason"),
    [("exact", "sticks out of the container by"), ("none", "overlapped or outside")],
)
def test_items_that_cannot_fit_are_named(finish: str, reason: str) -> None:
    giant = flat_item("giant", square(60.0))
    recipe = make_recipe(
        container="square", items=["giant"], sizes="fixed", epochs=20, levels="32,64",
        finish=finish,
    )  # fmt: skip
    met = uses.fill(recipe, [giant], square_container(100.0, 20.0))
    (unplaced,) = met.unplaced
    assert (unplaced.item, unplaced.index) == ("giant", 0)
    assert reason in unplaced.reason
    assert not met.certified
    assert met.report()["placed"] == 0
    assert met.layout.manifest["unplaced"] == met.report()["unplaced"]


def test_skipped_files_are_in_the_run_and_the_manifest(tmp_path: Path) -> None:
    (tmp_path / "good.svg").write_text(
        '<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>', encoding="utf-8"
    )
    (tmp_path / "bad.svg").write_text("<svg", encoding="utf-8")
    met = run(items=[str(tmp_path)])
    assert [item.name for item in met.layout.items] == ["good"]
    assert "bad.svg" in str(met.skipped[0])
    assert met.layout.manifest["skipped"] == met.report()["skipped"] == [str(met.skipped[0])]
    with pytest.raises(ReadError, match=r"bad\.svg"):
        run(items=[str(tmp_path)], strict=True)


def test_a_whole_run_hardly_overlaps_and_fills_the_container() -> None:
    options = {"items": ["circle", "square", "star"], "count": 24, "finish": "none"}
    begun = run(**options, epochs=1, levels="50").metrics
    met = run(**options, epochs=300, levels="50,150")
    assert met.metrics.pixel.LC > begun.pixel.LC
    # The start is half as wide again as all items together, or less.
    assert met.metrics.exact.overlap + met.metrics.exact.exceeding < 1 / 20
    assert not met.unplaced
    assert overlap_area(met.layout.outlines) == pytest.approx(
        met.metrics.exact.overlap_area, rel=0.05, abs=1.0
    )


def test_item_weights_follow_names_not_places() -> None:
    items: list[Item] = [flat_item(name, disc()) for name in ("a", "b", "a")]
    assert pipeline.item_weights(items, {"a": 3}).tolist() == [3, 1, 3]
    assert pipeline.item_weights(items, None).tolist() == [1, 1, 1]


def test_warming_up_changes_nothing_that_is_seen() -> None:
    precompile.warm_up()


def test_padding_keeps_items_apart_and_off_the_edge() -> None:
    options = {"count": 12, "effort": "draft", "levels": "64,300", "seed": 2}
    close = pw.fill("circle", ["star", "heart"], **options)
    padded = pw.fill("circle", ["star", "heart"], padding=10, **options)
    assert close.metrics["exact"]["min_gap"] < 10
    assert padded.metrics["exact"]["min_gap"] >= 10 * (1 - 1e-9)
    assert padded.metrics["LC"] > close.metrics["LC"] / 2


def test_padding_larger_than_the_container_is_refused() -> None:
    with pytest.raises(pw.RecipeError, match="leaves nothing of the container"):
        pw.fill("circle", ["star"], count=2, padding="200%")


def test_a_finished_layout_is_certified_and_says_so() -> None:
    met = run(items=["star", "heart"], count=9, padding=4)
    exact = met.metrics.exact
    assert met.certified
    assert (exact.overlap_area, exact.outside_area) == (0, 0)
    assert exact.min_gap >= 4
    assert met.layout.manifest["promised"] == {"gap": 4.0, "areas_in_shares": False}


def test_without_a_finish_nothing_is_promised() -> None:
    met = run(items=["star", "heart"], count=9, finish="none")
    assert not met.certified
    assert met.layout.manifest["promised"] is None


def test_shared_sizes_stay_in_their_shares_through_the_finish() -> None:
    met = run(items=["star", "heart"], count=8, sizes="shared", weights={"star": 1, "heart": 2})
    per_weight = met.layout.areas / met.layout.weights
    assert np.ptp(per_weight) < 1e-9 * per_weight.mean()


def test_room_that_a_loss_of_ones_own_keeps_free_is_not_grown_into() -> None:
    def none_wanted(density: Any, container: Any) -> Term:
        return Term(float(density.mean()), np.full_like(density, 1 / density.size))

    small = run(items=["star"], count=4, epochs=60, losses={none_wanted: 50.0})
    asked = run(items=["star"], count=4, epochs=60, losses={none_wanted: 50.0}, finish="none")
    assert small.layout.areas.sum() <= asked.layout.areas.sum() * (1 + 1e-5)

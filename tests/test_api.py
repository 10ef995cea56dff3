"""The Python face: plain values in, a layout out that saves, measures and shows itself."""

from __future__ import annotations

import copy
import importlib
import json
import pickle
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from typer.testing import CliRunner

import packwork as pw
from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.cli import app
from scenes import box, disc, flat_item, round_container, square

EXAMPLE = Path(__file__).parents[1] / "examples" / "own_loss"
QUICK: dict[str, Any] = {"epochs": 25, "levels": "32,64", "effort": "draft"}


def item_features(path: Path) -> list[Any]:
    collection = json.loads(path.read_text(encoding="utf-8"))
    return [f for f in collection["features"] if f["properties"]["role"] == "item"]


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    """One layout for all tests that only look."""
    return pw.fill("heart", ["star", "circle"], count=5, seed=2, **QUICK)


def test_the_same_run_as_on_the_command_line_bit_for_bit(tmp_path: Path) -> None:
    typed, called = tmp_path / "typed.geojson", tmp_path / "called.geojson"
    command = "fill bear star heart -n 9 --seed 4 --rotate 30 --sizes free --epochs 40 --levels 40"
    assert CliRunner().invoke(app, [*command.split(), "-q", "-o", str(typed)]).exit_code == 0
    pw.fill(
        "bear", ["star", "heart"], count=9, seed=4, rotate="30", sizes="free", epochs=40,
        levels="40",
    ).save(called)  # fmt: skip
    assert item_features(typed) == item_features(called)


def test_items_that_were_read_are_as_good_as_names(tmp_path: Path) -> None:
    by_name, by_item = tmp_path / "name.geojson", tmp_path / "item.geojson"
    pw.fill("circle", ["star", "heart"], count=4, **QUICK).save(by_name)
    items = pw.read_items(["star", "heart"])
    pw.fill(pw.read_container("circle"), items, count=4, **QUICK).save(by_item)
    assert item_features(by_name) == item_features(by_item)


def test_items_and_names_may_be_mixed() -> None:
    mine = flat_item("mine", disc(40.0))
    layout = pw.fill("circle", ["star", mine], **QUICK)
    assert [item.name for item in layout.items] == ["star", "mine"]


def test_one_item_needs_no_list(tmp_path: Path) -> None:
    file = tmp_path / "tile.svg"
    file.write_text('<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>', encoding="utf-8")
    for one in ("star", file, flat_item("mine", square(9.0))):
        assert len(pw.fill("circle", one, count=2, **QUICK).items) == 2


def test_a_container_of_ones_own() -> None:
    layout = pw.fill(round_container(), "star", count=3, **QUICK)
    assert (layout.container.width, layout.container.name) == (100.0, "disc")


def test_metrics_are_there(layout: pw.Layout) -> None:
    assert 0 < layout.metrics["LC"] <= 1
    assert layout.metrics.keys() >= {"LC", "LC_ratio", "OO", "EA", "LnU", "LC_ink", "exact"}


def test_a_layout_shows_itself(layout: pw.Layout) -> None:
    root = ET.fromstring(layout._repr_svg_())  # noqa: S314
    assert root.tag.endswith("svg")


@pytest.mark.parametrize(
    "copied",
    [copy.copy, copy.deepcopy, lambda layout: pickle.loads(pickle.dumps(layout))],  # noqa: S301
)
def test_a_layout_is_copied_and_pickled_whole(copied: Any, tmp_path: Path) -> None:
    layout = pw.fill("circle", ["star", "owl"], count=6, **QUICK)
    layout.save(tmp_path / "before.svg")
    again = copied(layout)
    again.save(tmp_path / "after.svg")
    assert type(again) is pw.Layout
    assert (tmp_path / "after.svg").read_bytes() == (tmp_path / "before.svg").read_bytes()
    assert again.manifest == layout.manifest
    assert again.metrics == layout.metrics
    assert again._repr_svg_() == layout._repr_svg_()


def test_a_layout_with_other_poses_is_measured_anew(layout: pw.Layout) -> None:
    away = replace(layout, poses=replace(layout.poses, x=layout.poses.x + 1e4))
    assert type(away) is pw.Layout
    assert away.metrics["LC"] == 0 < layout.metrics["LC"]


def test_a_layout_comes_back_from_its_file(layout: pw.Layout, tmp_path: Path) -> None:
    file = tmp_path / "layout.geojson"
    layout.save(file)
    again = pw.Layout.load(file)
    assert [item.name for item in again.items] == [item.name for item in layout.items]
    np.testing.assert_array_equal(again.poses.x, layout.poses.x)
    np.testing.assert_array_equal(again.poses.scale, layout.poses.scale)
    np.testing.assert_array_equal(again.weights, layout.weights)
    np.testing.assert_allclose(again.areas, layout.areas, rtol=1e-6)
    assert again.metrics["LC"] == pytest.approx(layout.metrics["LC"])
    assert again.manifest["seed"] == 2


def test_a_layout_without_manifest_is_measured_anew(layout: pw.Layout, tmp_path: Path) -> None:
    file = tmp_path / "layout.geojson"
    layout.save(file)
    collection = json.loads(file.read_text(encoding="utf-8"))
    del collection["manifest"]
    file.write_text(json.dumps(collection), encoding="utf-8")
    assert pw.Layout.load(file).metrics["LC"] == pytest.approx(layout.metrics["LC"], rel=1e-6)


def test_a_saved_layout_saves_the_same_features_again(layout: pw.Layout, tmp_path: Path) -> None:
    first, second = tmp_path / "first.geojson", tmp_path / "second.geojson"
    layout.save(first)
    pw.Layout.load(first).save(second)
    for before, after in zip(item_features(first), item_features(second), strict=True):
        assert before["properties"] == pytest.approx(after["properties"])


@pytest.mark.parametrize("ending", [".svg", ".png", ".geojson"])
def test_the_ending_picks_the_format(ending: str, layout: pw.Layout, tmp_path: Path) -> None:
    layout.save(tmp_path / f"out{ending}", pixels=60)
    start = (tmp_path / f"out{ending}").read_bytes()[:5]
    assert start.startswith({".svg": b"<", ".png": b"\x89PNG", ".geojson": b"{"}[ending])


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"pixels": 0}, "pixels: "),
        ({"pixels": 10**9}, "pixels: "),
        ({"background": "puce"}, "background: 'puce' is no colour"),
    ],
)
def test_saving_refuses_what_has_no_meaning(
    options: dict[str, Any], problem: str, layout: pw.Layout, tmp_path: Path
) -> None:
    with pytest.raises(pw.RecipeError, match=f"^{problem}"):
        layout.save(tmp_path / "out.svg", **options)
    assert not list(tmp_path.iterdir())


def test_unknown_endings_and_options_are_refused(layout: pw.Layout, tmp_path: Path) -> None:
    with pytest.raises(pw.WriteError, match=r"'\.bmp' is not known"):
        layout.save(tmp_path / "out.bmp")
    with pytest.raises(pw.WriteError, match=r"is a film; give it to --film"):
        layout.save(tmp_path / "out.gif")
    with pytest.raises(pw.RecipeError, match="colour: no such option"):
        pw.fill("heart", "star", colour="red")


def test_a_layout_that_was_recorded_saves_films(tmp_path: Path) -> None:
    layout = pw.fill("circle", "star", count=3, record=True, **QUICK)
    for ending in (".gif", ".svg"):
        layout.save_film(tmp_path / f"a{ending}", fps=8, seconds=0.5, film_pixels=40)
        assert (tmp_path / f"a{ending}").stat().st_size > 100
    with pytest.raises(pw.RecipeError, match="speed: no such option"):
        layout.save_film(tmp_path / "b.gif", speed=2)
    with pytest.raises(pw.WriteError, match="is none of a film"):
        layout.save_film(tmp_path / "b.png")


def test_a_layout_that_was_not_recorded_has_no_film(layout: pw.Layout, tmp_path: Path) -> None:
    with pytest.raises(pw.WriteError, match="give record=True"):
        layout.save_film(tmp_path / "a.gif")
    assert not list(tmp_path.iterdir())


def test_all_errors_share_a_root() -> None:
    for error in (pw.ReadError, pw.WriteError, pw.RecipeError, pw.ShapeError):
        assert issubclass(error, pw.PackworkError)
    with pytest.raises(pw.PackworkError, match=r"nothing\.png: there is no such file"):
        pw.fill("nothing.png")


def test_an_observer_may_stop_the_run() -> None:
    class Impatient:
        every = 5

        def __init__(self) -> None:
            self.steps: list[pw.Step] = []

        def on_step(self, step: pw.Step) -> None:
            self.steps.append(step)

    watcher = Impatient()
    layout = pw.fill(
        "circle", "star", count=3, observer=watcher, stop=lambda: len(watcher.steps) > 2, **QUICK
    )
    # The last says that the run is over.
    assert len([step for step in watcher.steps if step.stage != "done"]) == 3
    assert "stopped" in layout.manifest["ending"]


@pytest.fixture
def own_loss(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The example's module, as a script in its folder would import it."""
    monkeypatch.syspath_prepend(str(EXAMPLE))
    yield importlib.import_module("own_loss")
    sys.modules.pop("own_loss", None)


def test_the_example_loss_has_the_derivative_it_claims(
    own_loss: Any, rng: np.random.Generator
) -> None:
    container = np.ones((9, 7))
    density = rng.uniform(0, 2, (9, 7))

    def value(image: FloatArray) -> float:
        return float(own_loss.headroom(image, container).value)

    assert_gradient(value, own_loss.headroom(density, container).adjoint, density)


@pytest.mark.usefixtures("own_loss")
def test_a_loss_of_ones_own_moves_items() -> None:
    def covered_title(losses: dict[str, float]) -> float:
        layout = pw.fill("circle", "circle", count=12, epochs=150, levels="60", losses=losses)
        title = box(0, 0, layout.container.width, layout.container.height / 3).region
        return sum(float(o.region.intersection(title).area) for o in layout.outlines)

    assert covered_title({"own_loss:headroom": 20.0}) < covered_title({}) / 2


def test_a_loss_that_cannot_be_found_is_named() -> None:
    for name, problem in [
        ("charm", "no loss is called 'charm'"),
        ("no_such_module:loss", "module 'no_such_module' cannot be imported"),
        ("math:no_such_loss", "has no function 'no_such_loss'"),
        ("math:pi", "is not a function"),
    ]:
        with pytest.raises(pw.RecipeError, match=problem):
            pw.fill("circle", "star", losses={name: 1.0}, **QUICK)


@pytest.mark.parametrize(
    "command",
    [
        "own_loss.py",
        # As the installed script runs: without the working folder on the module path.
        "-P -m packwork fill circle star --loss own_loss:headroom=10 --epochs 5 --levels 16"
        " -o headroom.svg",
    ],
    ids=["as a script", "on the command line"],
)
def test_the_example_runs(command: str, tmp_path: Path) -> None:
    example = (EXAMPLE / "own_loss.py").read_text(encoding="utf-8")
    quick = example.replace("count=60", "count=3, epochs=5")
    assert quick != example
    (tmp_path / "own_loss.py").write_text(quick, encoding="utf-8")
    subprocess.run([sys.executable, *command.split()], cwd=tmp_path, check=True)
    assert (tmp_path / "headroom.svg").exists()

"""The page about Python: its blocks run as they stand, one after another."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork
from packwork.api.verbs import fill

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "guide" / "python.md"


def blocks(*kinds: str) -> str:
    """Blocks that are headed ``python``, and whatever else the kinds say, in order."""
    found = re.findall(r"```(python[^\n]*)\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return "\n".join(block for kind, block in found if kind in kinds)


def short_runs(patch: pytest.MonkeyPatch, folder: Path) -> dict[str, Any]:
    """Where a page's names end up; runs are short and files go to a folder of the test."""
    patch.chdir(folder)
    patch.setattr(packwork, "fill", partial(fill, epochs=60, levels="32"), raising=False)
    return {}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("page")


@pytest.fixture(scope="module")
def names(folder: Path) -> dict[str, Any]:
    """Names of the page, run once without the blocks of extras."""
    with pytest.MonkeyPatch.context() as patch:
        found = short_runs(patch, folder)
        exec(blocks("python"), found)  # noqa: S102
    return found


def test_every_block_is_one_that_a_test_runs() -> None:
    fences = re.findall(r"^```(.*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert set(fences) == {
        "python", "python geopandas", "python torch", "python widget", "python types", "",
    }  # fmt: skip


def test_the_page_runs(names: dict[str, Any], folder: Path) -> None:
    assert {path.name for path in folder.iterdir()} == {
        "heart.svg", "heart.png", "heart.geojson",
    }  # fmt: skip
    assert names["label"].startswith("circle at (")
    assert names["higher"].metrics["EA"] > 0
    assert names["layout"].manifest["ending"]
    assert 0 < names["watch"].covered < 1


def test_mypy_says_what_the_page_says(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    head = 'import packwork as pw\nlayout = pw.fill("heart")\n'
    lines = (head + blocks("python types")).strip().splitlines()
    (tmp_path / "page.py").write_text("\n".join(lines), encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--strict", str(tmp_path / "page.py")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    errors = re.findall(r"page\.py:(\d+): error: (.*)", done.stdout)
    assert [int(number) for number, _ in errors] == list(range(3, len(lines) + 1)), done.stdout
    for number, said in errors:
        assert lines[int(number) - 1].partition("  # ")[2] in said


EXTRAS = {"geopandas": "geopandas", "widget": "anywidget", "torch": "torch"}
"""Module that blocks of a kind need."""


@pytest.fixture(scope="module")
def with_extras(names: dict[str, Any], tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Names of the page, gone on with by the blocks of all extras that are installed."""
    kinds = [f"python {kind}" for kind, module in EXTRAS.items() if find_spec(module)]
    with pytest.MonkeyPatch.context() as patch:
        found = names | short_runs(patch, tmp_path_factory.mktemp("extras"))
        exec(blocks(*kinds), found)  # noqa: S102
    return found


def test_the_page_runs_with_geopandas(with_extras: dict[str, Any]) -> None:
    pytest.importorskip("geopandas")
    assert len(with_extras["placed"]) == 3


def test_the_page_runs_with_anywidget(with_extras: dict[str, Any]) -> None:
    widget = pytest.importorskip("anywidget")
    assert isinstance(with_extras["hand"], widget.AnyWidget)


def test_the_page_runs_with_pytorch(with_extras: dict[str, Any]) -> None:
    pytest.importorskip("torch")
    assert with_extras["points"].grad.shape == (4, 2)
    assert with_extras["image"].requires_grad


def _to_left(layout: packwork.Layout) -> float:
    """How far items lie to the left of the canvas' middle, in the mean."""
    return layout.container.width / 2 - float(layout.poses.x.mean())


def _to_top(layout: packwork.Layout) -> float:
    return layout.container.height / 2 - float(layout.poses.y.mean())


def _parted(layout: packwork.Layout) -> float:
    """How far hearts lie to the left of stars, in the mean."""
    is_heart = np.array([item.name == "heart" for item in layout.items])
    return float(layout.poses.x[~is_heart].mean() - layout.poses.x[is_heart].mean())


@pytest.mark.parametrize(
    ("page", "loss", "moved"),
    [
        ("README.md", "lean_left", _to_left),
        ("docs/guide/python.md", "top_heavy", _to_top),
        ("docs/guide/python.md", "part_ways", _parted),
        ("docs/guide/python.md", "warm_left", _parted),
    ],
)
def test_losses_of_the_pages_move_items_where_they_say(
    page: str, loss: str, moved: Callable[[packwork.Layout], float], monkeypatch: Any
) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    found = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    (block,) = (block for block in found if f"def {loss}(" in block)
    made: list[float] = []
    plain: list[float] = []

    def drawn(*given: Any, seed: int, losses: Any, **options: Any) -> packwork.Layout:
        asked = {**options, "effort": "draft", "levels": "32,64", "seed": seed}
        plain.append(moved(fill(*given, **asked)))
        layout = fill(*given, losses=losses, **asked)
        made.append(moved(layout))
        return layout

    for seed in range(3):
        monkeypatch.setattr(packwork, "fill", partial(drawn, seed=seed), raising=False)
        exec(block, {"np": np, "pw": packwork})  # noqa: S102
    assert len(made) == 3
    assert np.median(made) > max(np.median(plain), 0.0)

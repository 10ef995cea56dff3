"""Photos that are coarser than paper shows."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

from packwork import uses
from packwork.errors import RecipeError
from packwork.pipeline.plan.resolution import photo_pixels

QUICK = {"effort": "draft", "levels": "50", "canvas": "60mm"}


@pytest.fixture(scope="module")
def album(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("album")
    for k in range(5):
        size = (40, 30) if k == 0 else (900, 600)
        Image.new("RGB", size, "teal").save(folder / f"photo-{k}.jpg")
    return folder


@pytest.fixture
def packwork(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    from typer.testing import CliRunner

    from packwork.cli import app

    def run(*words: str) -> Result:
        return CliRunner().invoke(app, list(words))

    return run


def test_a_photo_has_its_pixels_over_the_inches_it_covers(album: Path) -> None:
    run = uses.fill(uses.photos_recipe("square", [str(album)], **QUICK))
    photos = photo_pixels(run.layout)
    scale = float(run.layout.poses.scale[0])
    assert photos[0].photo == "photo-0"
    assert photos[0].ppi == pytest.approx(25.4 / scale, abs=0.01)
    assert photos[0].ppi < 90 < photos[1].ppi
    assert run.report()["photos"][0] == {"photo": "photo-0", "ppi": photos[0].ppi}


def test_the_line_and_the_bound(
    album: Path, tmp_path: Path, packwork: Callable[..., Result]
) -> None:
    words = ["photos", "square", str(album), "--effort", "draft", "--levels", "50"]
    words += ["--canvas", "60mm", "-o", str(tmp_path / "a.svg")]
    coarse = packwork(*words)
    assert coarse.exit_code == 0
    said = " ".join(coarse.stdout.split())
    assert "1 of 5 photos have fewer than 300 pixels to the inch: photo-0 (" in said
    report = tmp_path / "r.json"
    fine = packwork(*words, "--least-dpi", "250", "--dpi", "250", "--report", str(report))
    assert fine.exit_code == 0
    assert "fewer than" not in fine.stdout
    found = json.loads(report.read_text(encoding="utf-8"))
    assert found["certified"]
    assert min(photo["ppi"] for photo in found["photos"]) >= 249.7


def test_sizes_that_are_shared_cannot_be_bounded_so(album: Path) -> None:
    recipe = uses.photos_recipe("square", [str(album)], least_dpi=200, sizes="shared", **QUICK)
    with pytest.raises(RecipeError, match="least_dpi: bounds free sizes, not shared ones"):
        uses.fill(recipe)

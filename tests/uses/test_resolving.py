"""Photos that are coarser than paper shows."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from typer.testing import Result

import packwork as pw
from packwork import uses
from packwork.errors import RecipeError
from packwork.pipeline.plan.resolution import coarse_photos, photo_pixels

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
    assert "1 of 5 pictures have fewer than 300 pixels to the inch: photo-0 (" in said
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


COARSE = "fewer than 300 pixels to the inch: speck ("


@pytest.mark.parametrize(
    "words",
    [
        "fill square {file} -n 4",
        "fill square {drawing} -n 4",
        "fill square {file} -n 4 --picture {file}",
        "words square table.csv --add {file}",
        "pile square {file} -n 4",
        "pile none {file} -n 4",
        "chart square table.csv --mark {file}",
        "run recipe.toml",
        "batch recipe.toml -o b.svg",
    ],
)
def test_each_verb_that_places_rasters_tells_how_coarse_they_are(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, packwork: Callable[..., Result]
) -> None:
    monkeypatch.chdir(tmp_path)
    Image.linear_gradient("L").resize((25, 25)).save("speck.png")
    data = base64.b64encode(Path("speck.png").read_bytes()).decode()
    Path("speck.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 40"><g transform="scale(4)">'
        f'<image width="10" height="10" href="data:image/png;base64,{data}"/></g></svg>',
        encoding="utf-8",
    )
    Path("table.csv").write_text("name,size\noak,3\nelm,2\nash,1\n", encoding="utf-8")
    Path("recipe.toml").write_text(
        'container = "square"\nitems = ["speck.png"]\ncount = 3\ncanvas = "A3"\neffort = "draft"\n',
        encoding="utf-8",
    )
    made = words.format(file="speck.png", drawing="speck.svg").split()
    if made[0] not in {"run", "batch"}:
        made += ["--canvas", "A3"]
        made += [] if made[0] == "pile" else ["--effort", "draft"]
    ran = packwork(*made) if made[0] == "batch" else packwork(*made, "-o", "a.svg")
    assert ran.exit_code == 0, ran.output
    assert COARSE in " ".join(ran.output.split())


def test_an_edit_and_saving_in_python_tell_it_too(
    tmp_path: Path, packwork: Callable[..., Result], caplog: pytest.LogCaptureFixture
) -> None:
    Image.linear_gradient("L").resize((25, 25)).save(tmp_path / "speck.png")
    layout = pw.fill("square", tmp_path / "speck.png", count=3, canvas="A3", effort="draft")
    assert COARSE not in caplog.text
    file = tmp_path / "a.geojson"
    layout.save(file)
    assert COARSE in caplog.text
    caplog.clear()
    edit = ["edit", str(file), "--items", str(tmp_path / "speck.png"), "--turn", "speck#1=9"]
    edited = packwork(*edit, "-o", str(tmp_path / "b.svg"))
    assert edited.exit_code == 0, edited.output
    assert COARSE in caplog.text


def test_drawings_without_pictures_and_canvases_in_px_are_not_told_of(tmp_path: Path) -> None:
    Image.linear_gradient("L").resize((25, 25)).save(tmp_path / "speck.png")
    quick: Any = {"count": 3, "effort": "draft"}
    assert not coarse_photos(pw.fill("square", "star", canvas="A3", **quick), 300)
    on_screen = pw.fill("square", tmp_path / "speck.png", canvas=400, **quick)
    assert not coarse_photos(on_screen, None)
    assert coarse_photos(on_screen, 300)


def test_pictures_of_fill_are_bounded_as_photos_are(tmp_path: Path) -> None:
    Image.linear_gradient("L").resize((25, 25)).save(tmp_path / "speck.png")
    layout = pw.fill(
        "square", tmp_path / "speck.png", count=3, canvas="A4", effort="draft", least_dpi=50
    )
    assert all(one.ppi >= 49.9 for one in photo_pixels(layout))

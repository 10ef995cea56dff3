"""``packwork photos`` from the command line."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--effort draft --levels 50 -q"


@pytest.fixture
def album(tmp_path: Path) -> Path:
    folder = tmp_path / "album"
    folder.mkdir()
    for k, colour in enumerate(("teal", "coral", "gold", "navy")):
        Image.new("RGB", (120, 90 + 20 * k), colour).save(folder / f"{colour}.jpg")
    return folder


def test_a_poster_has_the_size_asked_for(tmp_path: Path, album: Path, packwork: Command) -> None:
    out = tmp_path / "poster.jpg"
    result = packwork(f"photos heart {album} --canvas 6x4cm --dpi 100 -o {out} {QUICK}")
    assert result.exit_code == 0, result.output
    with Image.open(out) as image:
        assert image.size == (236, 158)


def test_photos_stay_within_15_degrees_unless_asked(
    tmp_path: Path, album: Path, packwork: Command
) -> None:
    out = tmp_path / "a.geojson"
    assert packwork(f"photos circle {album} -o {out} {QUICK}").exit_code == 0
    features = json.loads(out.read_text(encoding="utf-8"))["features"]
    angles = [f["properties"]["angle"] for f in features if f["properties"]["role"] == "item"]
    assert len(angles) == 4
    assert max(abs((a + 180) % 360 - 180) for a in angles) <= 15.001


def test_a_written_svg_measures_as_it_was_certified(
    tmp_path: Path, album: Path, packwork: Command
) -> None:
    out = tmp_path / "a.svg"
    line = f"photos heart {album} --shape rounded --border 5% -o {out} --effort draft -q"
    assert packwork(line).exit_code == 0
    assert packwork(f"measure {out} -q").exit_code == 0


def test_weights_may_name_the_files(tmp_path: Path, album: Path, packwork: Command) -> None:
    (tmp_path / "w.csv").write_text("teal.jpg,4\ncoral,1\n", encoding="utf-8")
    out = tmp_path / "a.geojson"
    line = f"photos circle {album} --sizes shared --weights {tmp_path}/w.csv -o {out} {QUICK}"
    assert packwork(line).exit_code in (0, 1)
    items = {
        f["properties"]["item"]: f["properties"]["weight"]
        for f in json.loads(out.read_text(encoding="utf-8"))["features"]
        if f["properties"]["role"] == "item"
    }
    assert items == {"teal": 4, "coral": 1, "gold": 1, "navy": 1}


def test_icons_are_mixed_in(tmp_path: Path, album: Path, packwork: Command) -> None:
    out = tmp_path / "a.png"
    assert packwork(f"photos circle {album} --add star -o {out} {QUICK}").exit_code == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("{album}/none.jpg", "there is no such file"),
        ("{album} --border 3", "--border: use a share"),
        ("{album} --shape hart", "did you mean heart"),
        ("{album} --dpi 0", "--dpi: use 1 to 2400"),
        ("{album} --dpi 600 --canvas 200cm -o {album}/../a.jpg", "20,000 are the most"),
        ("{album}/teal.jpg -o {album}/teal.jpg", "is read by this run too"),
    ],
)
def test_bad_input_is_one_line(arguments: str, words: str, album: Path, packwork: Command) -> None:
    result = packwork(f"photos heart {arguments.format(album=album)} --effort draft -q")
    assert result.exit_code == 2
    assert words in " ".join(result.output.split())
    assert result.output.strip().count("\n") == 0


def test_a_recipe_that_was_saved_repeats_the_run(
    tmp_path: Path, album: Path, packwork: Command
) -> None:
    recipe, out, again = (tmp_path / name for name in ("r.toml", "a.png", "b.png"))
    line = f"photos heart {album} --border 3% -o {out} --save-recipe {recipe} {QUICK}"
    assert packwork(line).exit_code == 0
    assert packwork(f"run {recipe} -o {again} -q").exit_code == 0
    first, second = (Image.open(io.BytesIO(path.read_bytes())) for path in (out, again))
    assert first.tobytes() == second.tobytes()

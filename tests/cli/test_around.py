"""``around:IMAGE`` from the command line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--effort draft --levels 50 -q"


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    pixels = np.full((80, 120, 3), 40, dtype=np.uint8)
    pixels[30:60, 60:100] = np.random.default_rng(0).integers(0, 256, (30, 40, 3))
    file = tmp_path / "scene.png"
    Image.fromarray(pixels).save(file)
    return file


@pytest.mark.parametrize("command", ["fill around:{0} star -n 5", "photos around:{0} {0} -n 3"])
def test_layouts_lie_over_the_picture(
    command: str, scene: Path, tmp_path: Path, packwork: Command
) -> None:
    out, shown = tmp_path / "out.svg", tmp_path / "saliency.png"
    line = f"{command.format(scene)} -o {out} --show-saliency {shown} {QUICK}"
    assert packwork(line).exit_code == 0
    assert 'id="backdrop"' in out.read_text(encoding="utf-8")
    with Image.open(shown) as image:
        assert image.size == (1_000, 667)
    assert packwork(f"measure {out} -q").exit_code == 0


def test_a_saved_recipe_finds_the_picture_from_its_own_folder(
    scene: Path, tmp_path: Path, packwork: Command
) -> None:
    recipe, first, second = (tmp_path / name for name in ("r.toml", "a.svg", "b.svg"))
    line = f"fill around:{scene} star -n 3 --quiet-share 0.5 --keep-clear 0,0,50,50"
    assert packwork(f"{line} -o {first} --save-recipe {recipe} {QUICK}").exit_code == 0
    assert 'container = "around:scene.png"' in recipe.read_text(encoding="utf-8")
    assert packwork(f"run {recipe} -o {second} -q").exit_code == 0
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("fill heart star --show-saliency {1}/a.png", "--show-saliency: needs a container around:"),
        ("fill around:{0} star -o {0}", "is read by this run too"),
        ("fill around:{0} star --quiet-share 2", "--quiet-share: must be at most 0.98"),
        ("fill around:{1}/none.png star", "there is no such file"),
        ("fill around:{0} star --keep-clear 1,1,a,1", "is no box"),
    ],
)
def test_bad_input_is_one_line(
    line: str, words: str, scene: Path, tmp_path: Path, packwork: Command
) -> None:
    result = packwork(f"{line.format(scene, tmp_path)} -q")
    assert result.exit_code == 2
    assert words in " ".join(result.output.split())
    assert result.output.strip().count("\n") == 0

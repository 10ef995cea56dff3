"""Flags about files reach the readers, from every command."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

from packwork.cli import running
from packwork.readers.options import ReadOptions
from packwork.recipe import Recipe

Command = Callable[..., Result]

FLAGS = "--no-trim --drop-page --close-gaps 2mm --alpha-threshold 0.2"
LINES = {
    "fill": "fill heart star",
    "words": "words heart words.csv",
    "photos": "photos heart photo.jpg",
    "chart": "chart heart data.csv",
    "pile": "pile heart star",
}


@pytest.fixture
def recipes(monkeypatch: pytest.MonkeyPatch) -> list[Recipe]:
    """Recipes that would have been run."""
    kept: list[Recipe] = []

    def keep(recipe: Recipe, *rest: object) -> int:
        kept.append(recipe)
        return 0

    monkeypatch.setattr(running, "run_and_write", keep)
    return kept


@pytest.mark.parametrize("command", LINES)
def test_flags_reach_the_readers(command: str, packwork: Command, recipes: list[Recipe]) -> None:
    plain = packwork(LINES[command])
    asked = packwork(f"{LINES[command]} {FLAGS}")
    assert (plain.exit_code, asked.exit_code) == (0, 0)
    assert recipes[0].read_options == ReadOptions()
    assert recipes[1].read_options == ReadOptions(False, "2mm", False, 0.2)


def test_a_small_drawing_is_told_on_the_terminal(tmp_path: Path, packwork: Command) -> None:
    drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 900 900">{}</svg>'
    (tmp_path / "small.svg").write_text(
        drawing.format('<path d="M9 9h50v40h-50z"/>'), encoding="utf-8"
    )
    line = f"fill {tmp_path}/small.svg circle -n 2 --epochs 1 --finish none -o {tmp_path}/a.svg"
    assert "takes 6% of its page, which is left out; --no-trim keeps it" in packwork(line).output
    assert "of its page" not in packwork(f"{line} --trim").output

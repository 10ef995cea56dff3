"""Files far larger than what is read are refused by their size, before memory is taken for them."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest
from typer.testing import CliRunner

from packwork.cli import app

FAR_TOO_LARGE = 240_000_000


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("chart circle {}", "rows.json"),
        ("chart circle {}", "rows.csv"),
        ("words circle {}", "text.txt"),
        ("measure {}", "layout.geojson"),
        ("measure {}", "layout.svg"),
        ("measure {}", "layout.dxf"),
        ("fill {} star", "container.svg"),
        ("run {}", "recipe.toml"),
    ],
)
def test_a_quarter_of_a_gigabyte_is_one_line(line: str, name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    with path.open("wb") as file:
        # No room on the disk: a hole.
        file.truncate(FAR_TOO_LARGE)
    tracemalloc.start()
    try:
        result = CliRunner().invoke(app, line.format(path).split())
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert "MB" in result.stderr
    # What is imported by the first takes up to 32 MB.
    assert peak < FAR_TOO_LARGE / 5

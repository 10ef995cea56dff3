"""Help answers at once, and shows how."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable

import pytest
from typer.testing import Result

Command = Callable[..., Result]

PHRASES = {
    "": ["fill", "measure", "demo", "bench", "--version", "packwork demo"],
    "fill": [
        "packwork fill heart", "packwork fill bear.png icons/ -n 100", "--rotate none",
        "packwork fill text:HELLO",
        "What is placed", "How it is solved", "What is written", "all built-in icons",
    ],
    "words": ["packwork words heart speech.txt", "SOURCE", "How words are set", "--weight-is"],
    "chart": ["packwork chart circle coffee.csv", "DATA", "What marks say", "--size-by"],
    "photos": ["packwork photos heart holidays/", "PHOTO", "What becomes of edges", "--dpi 300"],
    "pile": ["packwork pile square icons", "--open", "--size", "open path"],
    "measure": ["packwork measure bear.geojson", "LAYOUT", "--diagnose"],
    "demo": ["packwork demo", "bear", "dragon", "teaser", "--folder"],
    "bench": ["packwork bench engine", "NAME"],
}  # fmt: skip


@pytest.mark.parametrize("flag", ["--help", "-h"])
@pytest.mark.parametrize("command", PHRASES)
def test_help_shows_examples(command: str, flag: str, packwork: Command) -> None:
    result = packwork(f"{command} {flag}")
    assert result.exit_code == 0
    text = " ".join(result.stdout.split())
    for phrase in PHRASES[command]:
        assert phrase in text


def test_the_bare_name_shows_the_help(packwork: Command) -> None:
    result = packwork("")
    assert "Usage: packwork" in result.output


def test_the_version_is_one_line(packwork: Command) -> None:
    result = packwork("--version")
    assert result.exit_code == 0
    assert result.stdout.startswith("packwork ")
    assert result.stdout.count("\n") == 1


@pytest.mark.parametrize("line", ["--help", "fill --help", "--version"])
def test_help_loads_nothing_heavy(line: str) -> None:
    script = (
        "import sys, packwork.cli\n"
        f"sys.argv = ['packwork', *{line.split()!r}]\n"
        "try:\n    packwork.cli.app()\n"
        "except SystemExit:\n    pass\n"
        "heavy = {'numpy', 'numba', 'scipy', 'shapely', 'skimage', 'PIL'} & set(sys.modules)\n"
        "sys.exit(', '.join(heavy) or 0)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr

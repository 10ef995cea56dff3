"""The script as Inkscape runs it, where Inkscape's own packages are there."""

from __future__ import annotations

import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from typer.testing import CliRunner

import packwork
from packwork.cli import app

THEIRS = Path("/usr/share/inkscape/extensions")
PYTHON = Path("/usr/bin/python3")
TEXT = "{http://www.w3.org/2000/svg}text"
DRAWING = """
<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80">
 <path id="ground" d="M0 0H60V50H0Z" fill="#fec"/>
 <g id="layer" transform="scale(2)"><path id="star" d="M5 0L6 4 10 5 6 6 5 10 4 6 0 5 4 4Z"/>
 <rect id="bar" x="2" y="1" width="5" height="3"/>
 <text id="word" y="20" font-size="8">Ink</text></g>
</svg>
"""

has_inkex = (
    subprocess.run(
        [str(PYTHON), "-c", "import inkex.command"], capture_output=True, check=False,
        env={"PYTHONPATH": str(THEIRS)},
    ).returncode == 0
    if PYTHON.is_file() and THEIRS.is_dir() else False
)  # fmt: skip
pytestmark = pytest.mark.skipif(not has_inkex, reason="no Inkscape with its packages")


def run(tmp_path: Path, *flags: str) -> subprocess.CompletedProcess[str]:
    assert CliRunner().invoke(app, ["inkscape", "install", "--into", str(tmp_path)]).exit_code == 0
    if os.name == "posix":  # this checkout, wherever another one may be installed
        python = tmp_path / "python"
        source = Path(packwork.__file__).parents[1]
        python.write_text(f'#!/bin/sh\nPYTHONPATH={source} exec {sys.executable} "$@"\n', "utf-8")
        python.chmod(0o700)
        (tmp_path / "packwork_python.txt").write_text(f"{python}\n", "utf-8")
    drawing = tmp_path / "drawing.svg"
    drawing.write_text(DRAWING, encoding="utf-8")
    environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
    return subprocess.run(
        [str(PYTHON), str(tmp_path / "packwork_extension.py"), *flags, str(drawing)],
        capture_output=True, text=True, check=False, timeout=200,
        env=environment | {"PYTHONPATH": str(THEIRS)},
    )  # fmt: skip


def chosen(*names: str) -> list[str]:
    return [f"--id={name}" for name in names]


def test_only_transforms_change(tmp_path: Path) -> None:
    flags = ["--verb=fill", "--effort=draft", "--sizes=free", "--rotate=free", "--gap=1"]
    done = run(tmp_path, *flags, *chosen("ground", "star", "bar", "word"))
    assert done.stderr == ""
    before, after = ET.fromstring(DRAWING), ET.fromstring(done.stdout)  # noqa: S314
    for old, new in zip(before.iter(), after.iter(), strict=True):
        plain = {key: value for key, value in new.attrib.items() if key != "transform"}
        assert plain == {key: value for key, value in old.attrib.items() if key != "transform"}
        is_moved = old.get("id") in {"star", "bar", "word"}
        assert (old.get("transform") != new.get("transform")) == is_moved
    assert [text.text for text in after.iter(TEXT)] == ["Ink"]


def test_words_come_as_labelled_paths(tmp_path: Path) -> None:
    flags = ["--verb=words", "--effort=draft", "--text=bear fox fox", "--count=5", "--gap=1"]
    done = run(tmp_path, *flags, *chosen("ground"))
    assert done.stderr == ""
    for word in ("fox", "bear"):
        assert f':label="{word}"' in done.stdout


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        ([], "Nothing is chosen"),
        (["--container=nobody", "--id=star"], "No object is called nobody"),
        (["--id=ground"], "Choose a shape and the objects"),
    ],
)
def test_what_is_missing_is_said(flags: list[str], said: str, tmp_path: Path) -> None:
    done = run(tmp_path, "--verb=fill", "--gap=1", *flags)
    assert said in done.stderr
    assert "Traceback" not in done.stderr

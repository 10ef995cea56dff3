"""``packwork inkscape``: what it puts where, and that it can be taken away."""

from __future__ import annotations

import ast
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from typer.testing import CliRunner

from packwork.cli import app

RUNNER = CliRunner()
INX = "{http://www.inkscape.org/namespace/inkscape/extension}"


def test_extensions_are_put_into_a_folder_and_taken_away(tmp_path: Path) -> None:
    folder = tmp_path / "extensions"
    (tmp_path / "extensions").mkdir()
    (folder / "other.inx").write_text("mine", encoding="utf-8")
    assert RUNNER.invoke(app, ["inkscape", "install", "--into", str(folder)]).exit_code == 0
    assert (folder / "packwork_python.txt").read_text(encoding="utf-8").strip() == sys.executable
    for file in folder.glob("packwork_*.inx"):
        command = ET.parse(file).find(f"{INX}script/{INX}command")  # noqa: S314 - ours
        assert command is not None
        assert (folder / (command.text or "")).is_file()
    assert RUNNER.invoke(app, ["inkscape", "remove", "--into", str(folder)]).exit_code == 0
    assert [file.name for file in folder.iterdir()] == ["other.inx"]


@pytest.mark.parametrize("verb", ["fill", "words", "nest"])
def test_whatever_a_dialogue_asks_is_known_to_the_script(verb: str, tmp_path: Path) -> None:
    RUNNER.invoke(app, ["inkscape", "install", "--into", str(tmp_path)])
    script = ast.parse((tmp_path / "packwork_extension.py").read_text(encoding="utf-8"))
    texts = {node.value for node in ast.walk(script) if isinstance(node, ast.Constant)}
    dialogue = ET.parse(tmp_path / f"packwork_{verb}.inx").getroot()  # noqa: S314 - ours
    asked = [str(param.get("name")) for param in dialogue.iter(f"{INX}param")]
    assert asked[0] == "verb"
    assert {name for name in asked if name not in texts and f"--{name}" not in texts} == set()


def test_a_folder_that_cannot_be_written_is_said_in_one_line(tmp_path: Path) -> None:
    taken = tmp_path / "file"
    taken.write_text("", encoding="utf-8")
    found = RUNNER.invoke(app, ["inkscape", "install", "--into", str(taken)])
    assert found.exit_code != 0
    assert "cannot be written" in found.output

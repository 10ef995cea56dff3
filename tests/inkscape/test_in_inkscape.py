"""The script as Inkscape runs it, where Inkscape's own packages are there."""

from __future__ import annotations

import copy
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
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

NESTED = """
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
     width="210mm" height="297mm" viewBox="-10 5 105 148.5">
 <defs><linearGradient id="fade"><stop stop-color="#c30"/><stop offset="1" stop-color="#fc0"/>
  </linearGradient><clipPath id="cut"><circle cx="4" cy="3" r="3"/></clipPath></defs>
 <g id="back" transform="translate(4 12) rotate(3)"><path id="ground" fill="#dde"
   d="M0 0H70V60H30L0 80Z"/></g>
 <g id="layer" transform="translate(3 3) scale(2 1.5)">
  <g id="deep" transform="skewX(12) rotate(-20)">
   <path id="star" fill="url(#fade)" transform="rotate(10)"
    d="M5 0L6 4 10 5 6 6 5 10 4 6 0 5 4 4Z"/>
   <text id="word" transform="matrix(.8 .1 -.1 .9 3 2)" x="2" y="18" font-size="7">Ink<tspan
    fill="red">well</tspan></text></g>
  <g id="group" transform="translate(15 30)" stroke="#036" stroke-width="0.5">
   <circle r="3" fill="#9cf"/><rect x="2" y="1" width="5" height="3" fill="none"/></g>
  <use id="clone" xlink:href="#star" x="2" y="-1px" transform="translate(20 20) scale(.7)"/>
  <use id="bystander" xlink:href="#star" x="3" transform="translate(30 40)"/>
  <rect id="clipped" clip-path="url(#cut)" width="8" height="6" transform="rotate(30 4 3)"/></g>
 <text id="loose" x="20" y="140" font-size="9">Loose</text>
</svg>
"""
MOVED = ["star", "word", "group", "clone", "clipped", "loose"]

RECORDED = """
import json, sys
from pathlib import Path
from packwork.inkscape.__main__ import main
from packwork.readers.svg.objects import OpenDrawing

moved = OpenDrawing.moved

def kept(drawing, moves):
    said = {name: move.T.ravel().tolist() for name, move in moves.items()}
    Path(__file__).with_name("moves.json").write_text(json.dumps(said))
    return moved(drawing, moves)

OpenDrawing.moved = kept
main()
"""
"""What is asked, with the layout's own moves, in units of the drawing's root, kept beside it."""

has_inkex = (
    subprocess.run(
        [str(PYTHON), "-c", "import inkex.command"], capture_output=True, check=False,
        env={"PYTHONPATH": str(THEIRS)},
    ).returncode == 0
    if PYTHON.is_file() and THEIRS.is_dir() else False
)  # fmt: skip
pytestmark = pytest.mark.skipif(not has_inkex, reason="no Inkscape with its packages")


def run(tmp_path: Path, *flags: str, text: str = DRAWING) -> subprocess.CompletedProcess[str]:
    assert CliRunner().invoke(app, ["inkscape", "install", "--into", str(tmp_path)]).exit_code == 0
    if os.name == "posix":  # this checkout, wherever another one may be installed
        python, asked = tmp_path / "python", tmp_path / "asked.py"
        asked.write_text(RECORDED, encoding="utf-8")
        source = Path(packwork.__file__).parents[1]
        python.write_text(
            f"#!/bin/sh\nPYTHONPATH={source} exec {sys.executable} {asked}\n", "utf-8"
        )
        python.chmod(0o700)
        (tmp_path / "packwork_python.txt").write_text(f"{python}\n", "utf-8")
    drawing = tmp_path / "drawing.svg"
    drawing.write_text(text, encoding="utf-8")
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


def boxes(file: Path) -> dict[str, list[float]]:
    """Box of each object on the page, px, as Inkscape says it."""
    told = subprocess.run(
        ["inkscape", "--query-all", str(file)],
        capture_output=True, text=True, check=True, timeout=60,
    ).stdout  # fmt: skip
    rows = [line.split(",") for line in told.splitlines()]
    return {name: [float(value) for value in box] for name, *box in rows}


@pytest.mark.parametrize(
    "verb", [["--verb=fill", "--sizes=free", "--effort=draft"], ["--verb=nest", "--time=1"]]
)
def test_all_objects_lie_in_inkscape_where_the_layout_has_them(
    verb: list[str], tmp_path: Path
) -> None:
    at = ["--container=ground"] if verb[0] == "--verb=nest" else chosen("ground")
    flags = [*verb, "--rotate=free", "--gap=.5", "--margin=.5", *at, *chosen(*MOVED)]
    done = run(tmp_path, *flags, text=NESTED)
    lost = [name for name in MOVED if name in done.stderr]
    assert "Traceback" not in done.stderr, done.stderr
    after = tmp_path / "after.svg"
    after.write_text(done.stdout, encoding="utf-8")
    # Each object again, in a group that moves all that it stands in as the layout does.
    there = ET.fromstring(NESTED)  # noqa: S314
    parents = {child: parent for parent in there.iter() for child in parent}
    by_id = {element.get("id"): element for element in there.iter()}
    moves = json.loads((tmp_path / "moves.json").read_text(encoding="utf-8"))
    assert set(moves) == set(MOVED) - set(lost), done.stderr
    for name, move in moves.items():
        inner = copy.deepcopy(by_id[name])
        inner.set("id", f"{name}-there")
        group = parents[by_id[name]]
        while group is not there:
            outer = ET.Element(group.tag, {k: v for k, v in group.attrib.items() if k != "id"})
            outer.append(inner)
            inner, group = outer, parents[group]
        numbers = " ".join(map(repr, move))
        ET.SubElement(
            there, "{http://www.w3.org/2000/svg}g", transform=f"matrix({numbers})"
        ).append(inner)
    expected = tmp_path / "expected.svg"
    expected.write_bytes(ET.tostring(there))
    found, right = boxes(after), boxes(expected)
    for name in moves:
        np.testing.assert_allclose(found[name], right[f"{name}-there"], atol=1e-3, rtol=0)
        assert not np.allclose(found[name], right[name], atol=1.0)
    for name in {*MOVED, "bystander", "ground"} - set(moves):
        np.testing.assert_allclose(found[name], right[name], atol=1e-3, rtol=0)


def test_lengths_are_of_the_page_whatever_its_units(tmp_path: Path) -> None:
    flags = ["--verb=nest", "--time=1", "--gap=1", "--margin=0", *chosen("star")]
    done = run(tmp_path, *flags, text=NESTED)
    assert "less than 0.5, the distance of parts" in done.stderr


def test_parts_lie_on_the_page_of_a_drawing_that_names_no_user_units(tmp_path: Path) -> None:
    text = DRAWING.replace('viewBox="0 0 100 80"', "")
    flags = ["--verb=nest", "--time=1", "--rotate=none", "--gap=1", "--margin=1"]
    done = run(tmp_path, *flags, *chosen("star", "bar"), text=text)
    assert done.stderr == ""
    assert set(json.loads((tmp_path / "moves.json").read_text("utf-8"))) == {"star", "bar"}


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

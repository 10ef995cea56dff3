"""``packwork words``: what it writes, and what it says of bad input."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--epochs 10 --levels 50 --effort draft -q"
TEXT = "The bear likes honey. A bear and a bee make honey, and the bear eats honey in the wood."


@pytest.fixture
def text(folder: Path) -> Path:
    """A text of a few words."""
    file = folder / "bears.txt"
    file.write_text(TEXT, encoding="utf-8")
    return file


def test_a_cloud_is_written_with_names_and_tooltips(packwork: Command, text: Path) -> None:
    result = packwork(f"words circle bears.txt -n 4 {QUICK} -o c.svg -o c.geojson --report r.json")
    assert result.exit_code == 0, result.output
    svg = Path("c.svg").read_text(encoding="utf-8")
    assert "<title>honey: 3</title>" in svg
    assert 'id="honey"' in svg
    report = json.loads(Path("r.json").read_text(encoding="utf-8"))
    assert (report["items"], report["placed"], report["certified"]) == (4, 4, True)
    assert packwork("measure c.svg").exit_code == 0


def test_words_without_a_font_are_named_and_the_rest_is_written(
    packwork: Command, folder: Path
) -> None:
    (folder / "t.csv").write_text("bear,2\nfox,1\n中,1\n", encoding="utf-8")
    result = packwork(f"words circle t.csv {QUICK} -o c.svg", "--font", "Inter Display")
    assert result.exit_code == 1
    assert "not placed: 中 (item 3): no font given has '中'" in result.stderr
    assert Path("c.svg").exists()


def test_how_many_words_there_were_is_said(packwork: Command, text: Path) -> None:
    line = QUICK.replace("-q", "")
    result = packwork(f"words circle bears.txt -n 3 {line} -o c.svg --report r.json")
    assert "the 3 largest of 6 different words; -n takes more" in result.stdout
    report = json.loads(Path("r.json").read_text(encoding="utf-8"))
    assert report["words"] == {"found": 6, "asked": 3, "of_true": {}}
    assert "different words" not in packwork(f"words circle bears.txt {line} -o c.svg").stdout


def test_function_words_that_are_left_out_are_told_and_can_be_kept(
    packwork: Command, folder: Path
) -> None:
    (folder / "t.txt").write_text("To be or not to be: that is the question.", encoding="utf-8")
    line = QUICK.replace("-q", "")
    told = (
        "7 function words are left out (to, be, or and 4 more); --keep-words keeps those that it "
        "names, --language none all"
    )
    assert told in packwork(f"words circle t.txt {line} -o c.svg --report r.json").stdout
    assert told in json.loads(Path("r.json").read_text(encoding="utf-8"))["remarks"]
    kept = packwork(f"words circle t.txt {line} -o c.svg --language none").stdout
    assert "function word" not in kept
    assert "8 of 8 items placed" in kept
    assert "function word" not in packwork(f"words circle t.txt {QUICK} -o c.svg").output


def test_words_are_written_as_text(packwork: Command, text: Path) -> None:
    result = packwork(f"words circle bears.txt -n 3 {QUICK} --text live -o c.svg -o c.png")
    assert result.exit_code == 0, result.output
    assert ">honey</text>" in Path("c.svg").read_text(encoding="utf-8")
    assert packwork("measure c.svg").exit_code == 0


def test_standard_input_is_read(packwork: Command) -> None:
    from typer.testing import CliRunner

    from packwork.cli import app

    line = f"words circle - {QUICK} -n 3 -o c.svg"
    result = CliRunner().invoke(app, line.split(), input=TEXT)
    assert result.exit_code == 0, result.output


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("circle missing.txt", "missing.txt: there is no such file"),
        ("circle bears.txt --font missing.ttf", "missing.ttf: there is no such file"),
        ("circle bears.txt --font bears.txt", "bears.txt: is not a font"),
        ("circle bears.txt --font NoSuchFamily", "is no font file and no installed family"),
        ("circle bears.txt --language klingon", "--language: there is no list for 'klingon'"),
        (
            "circle bears.txt --min-count 50",
            "has no word 50 times; the most frequent, 'bear', is there 3 times",
        ),
        ("circle bears.txt --stopwords missing.txt", "missing.txt: there is no such file"),
        ("circle bears.txt --color-by kind", "--color-by: there is no column 'kind'"),
        ("circle bears.txt --color-by missing.png", "missing.png: there is no such file"),
        ("circle bears.txt -n 0", "--count: must be at least 1, not 0"),
        ("circle bears.txt -o bears.txt", ""),
        ("circle bears.txt --background nocolour", "--background"),
    ],
)
def test_bad_input_is_one_line_and_nothing_is_written(
    line: str, problem: str, packwork: Command, text: Path, folder: Path
) -> None:
    result = packwork(f"words {line} {QUICK}")
    assert result.exit_code == 2
    assert problem in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1
    assert [file.name for file in folder.iterdir()] == ["bears.txt"]

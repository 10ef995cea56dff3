"""Every example: its command runs, small and short, and its picture is there to compare."""

from __future__ import annotations

import importlib.util
import re
import runpy
import shlex
import shutil
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

from each import for_each

Command = Callable[..., Result]

EXAMPLES = Path(__file__).parents[2] / "examples"
PAGES = sorted(EXAMPLES.glob("*/README.md"))
VERBS = {"fill", "words", "chart", "photos", "pile"}
QUICK = "--epochs 3 --levels 16,32 --effort draft --pixels 64 -q"
QUICK_PILE = "--pixels 64 -q"
"""A pile has no levels."""
FEW = "--max-items 9"
"""Where voids are filled: that many are enough."""
COUNT = "-n 6"
"""Charts count for themselves."""
FILM = "--fps 5 --seconds 0.5"
ROWS = 12
"""Of a chart's table."""
DRAWN = 12
"""Of pictures that a script draws."""
MOST_BYTES = 150_000
MOST_FILM_BYTES = 1_000_000


def commands(page: Path) -> list[list[str]]:
    """Arguments of each ``packwork`` command in the fenced blocks of a page."""
    text = page.read_text(encoding="utf-8").replace("\\\n", " ")
    blocks = re.findall(r"```sh\n(.*?)```", text, flags=re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    return [shlex.split(line, comments=True)[1:] for line in lines if line.startswith("packwork ")]


def draw_inputs(example: Path) -> None:
    """Run the script that draws what the first command reads, where its block begins with one.

    Of hundreds of pictures it draws a few.
    """
    script = re.search(
        r"```sh\npython (\S+)\npackwork", (example / "README.md").read_text(encoding="utf-8")
    )
    if script is not None:
        file = example / script[1]
        text = file.read_text(encoding="utf-8")
        few = re.sub(r"^(COUNT\b.*? = )\d+", rf"\g<1>{DRAWN}", text, flags=re.MULTILINE)
        file.write_text(few, encoding="utf-8")
        runpy.run_path(str(file), run_name="__main__")


def shorten_tables(example: Path) -> None:
    """Keep the first rows of tables, the labels of which take far longer than all else."""
    for table in example.glob("*.csv"):
        lines = table.read_text(encoding="utf-8").splitlines(keepends=True)
        table.write_text("".join(lines[: 1 + ROWS]), encoding="utf-8")


FILLS = [
    pytest.param(page.parent, number, id=f"{page.parent.name}-{number}")
    for page in PAGES
    for number, arguments in enumerate(commands(page))
    if arguments[0] in VERBS
]


def files_named_in(arguments: list[str]) -> list[str]:
    """What a command writes."""
    flags = ("-o", "--output", "--diagnose", "--report", "--show-saliency", "--film")
    return [value for flag, value in pairwise(arguments) if flag in flags]


def test_the_gallery_is_found() -> None:
    assert {
        "collage",
        "letter-s",
        "letter-i",
        "letter-r",
        "australia",
        "usa-axis",
        "jar",
        "round-pack",
        "morph",
    } <= {page.parent.name for page in PAGES}
    assert len(FILLS) >= 6


def quickly(arguments: list[str]) -> list[str]:
    """A command with few items, small."""
    few = FEW.split() if "--target-coverage" in arguments else []
    count = [] if arguments[0] == "chart" else COUNT.split()
    quick = QUICK_PILE if arguments[0] == "pile" else QUICK
    if {"--along", "--ring"} & set(arguments):
        quick = "--effort draft --pixels 64 -q"  # no levels: words are laid along lines
    return [*arguments, *quick.split(), *count, *FILM.split(), *few]


@pytest.mark.parametrize(("example", "number"), FILLS)
def test_the_command_of_an_example_writes_what_it_names(
    example: Path, number: int, folder: Path, packwork: Command, monkeypatch
) -> None:
    if "[torch]" in (example / "README.md").read_text(encoding="utf-8"):
        pytest.importorskip("torch")
    copy = shutil.copytree(example, folder / example.name)
    monkeypatch.chdir(copy)
    monkeypatch.syspath_prepend(str(copy))
    draw_inputs(copy)
    *earlier, arguments = commands(example / "README.md")[: number + 1]
    if arguments[0] == "chart":
        shorten_tables(copy)
    for one in earlier:
        if set(files_named_in(one)) & set(arguments):
            # This command goes on from what that one wrote.
            packwork("", *quickly(one))
    result = packwork("", *quickly(arguments))
    assert result.exit_code in {0, 1}, result.output
    written = files_named_in(arguments)
    assert written
    # Of a series each step has a file.
    files = {name: list(copy.glob(re.sub(r"\{\w+\}", "*", name))) for name in written}
    assert all(files.values())
    assert [one for found in files.values() for one in found if not one.stat().st_size] == []


@for_each(PAGES, name=lambda page: page.parent.name)
def test_pictures_of_an_example_are_small_and_shown(page: Path) -> None:
    for picture in page.parent.glob("*.png"):
        assert picture.stat().st_size <= MOST_BYTES
        with Image.open(picture) as image:
            assert max(image.size) <= 1_000
        assert picture.name in page.read_text(encoding="utf-8")


@for_each(PAGES, name=lambda page: page.parent.name)
def test_films_of_an_example_are_there_small_and_shown(page: Path) -> None:
    for arguments in commands(page):
        for flag, name in pairwise(arguments):
            if flag == "--film":
                assert 1_000 < (page.parent / name).stat().st_size <= MOST_FILM_BYTES
                assert f"]({name})" in page.read_text(encoding="utf-8")


def test_drawing_the_gallery_runs_the_same_commands() -> None:
    spec = importlib.util.spec_from_file_location("draw", EXAMPLES / "draw.py")
    assert spec is not None
    assert spec.loader is not None
    draw = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(draw)
    for page in PAGES:
        ours = [c for c in commands(page) if c[0] in VERBS | {"run", "nest"}]
        assert draw.commands(page.parent) == ours

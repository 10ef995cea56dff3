"""The gallery: the committed page is what its script writes, and shows all examples."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from each import for_each

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
FOLDERS = sorted(page.parent for page in ROOT.glob("examples/*/README.md"))


@pytest.fixture
def gallery(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    monkeypatch.syspath_prepend(str(ROOT / "examples"))
    yield importlib.import_module("gallery")
    sys.modules.pop("gallery", None)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """An example with a film and a still, both shown."""
    (tmp_path / "README.md").write_text(
        "# A pie\n\n```sh\npackwork chart pie.csv -o pie.png --film pie.gif\n```\n\n"
        "![still](expected.png) ![moving](pie.gif)\n\n```sh\nls\n```\n",
        encoding="utf-8",
    )
    Image.new("L", (100, 50)).save(tmp_path / "pie.gif")
    Image.new("L", (1680, 840)).save(tmp_path / "expected.png")
    return tmp_path


def test_the_page_is_what_the_script_writes_now(gallery: Any) -> None:
    assert gallery.written() == PAGE, "run: make gallery"


@for_each(FOLDERS, name=lambda folder: folder.name)
def test_every_example_is_on_the_page_once(folder: Path) -> None:
    assert PAGE.count(f"](../examples/{folder.name}/README.md)") == 1


def test_a_film_goes_before_the_still_and_keeps_its_size(gallery: Any, folder: Path) -> None:
    example = gallery.read_example(folder)
    assert (example.title, example.group) == ("A pie", "Charts")
    assert (example.picture, example.alt) == ("pie.gif", "moving")
    assert example.commands == "packwork chart pie.csv -o pie.png --film pie.gif\n"
    assert gallery.shown_size(folder / "pie.gif") == 'width="100"'


def test_large_pictures_are_shown_smaller(gallery: Any, folder: Path) -> None:
    assert gallery.shown_size(folder / "expected.png") == f'width="{gallery.LONGEST_PX}"'


@pytest.mark.parametrize(
    ("command", "heading"),
    [
        ("packwork run a.toml", "Collages"),
        ("pip install torch\npython galaxy.py", "In Python"),
        ("packwork knit a.csv", "Knit"),
    ],
)
def test_examples_are_grouped_by_what_they_call(gallery: Any, command: str, heading: str) -> None:
    example = gallery.Example(ROOT, "title", f"{command}\n", "expected.png", "alt")
    assert example.group == heading


@pytest.mark.parametrize(
    "page",
    [
        "no title\n\n```sh\nls\n```\n\n![a](expected.png)\n",
        "# Title\n\n![a](expected.png)\n",
        "# Title\n\n```sh\nls\n```\n",
    ],
    ids=["no title", "no commands", "no picture"],
)
def test_what_an_example_lacks_is_said(gallery: Any, page: str, tmp_path: Path) -> None:
    (tmp_path / "README.md").write_text(page, encoding="utf-8")
    with pytest.raises(ValueError, match=r"needs a title and, below its commands"):
        gallery.read_example(tmp_path)

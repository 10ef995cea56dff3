"""Pages of figures against the manifests that they are made of."""

from __future__ import annotations

import copy
import hashlib
import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1]))

from benchmarks.kit import manifests
from benchmarks.kit.published import COMPARISONS
from benchmarks.pages import overview, pages
from benchmarks.peers import peer_pages, peering
from each import for_each

ROOT = Path(__file__).parents[1]
MANIFESTS = manifests.known()
RENDERED = pages.rendered()


@for_each(RENDERED)
def test_a_page_is_what_its_manifest_says(name: str) -> None:
    assert (ROOT / "docs" / "benchmarks" / name).read_text(encoding="utf-8") == RENDERED[name]


def empty_places(text: str) -> list[str]:
    """Tables without a figure, parts without a line, and punctuation alone on its line."""
    found = []
    for block in manifests.blocks_of(text):
        if isinstance(block, dict) and "<img" not in block["columns"][0]:
            figures = {cell for row in block["rows"] for cell in row[1:]}
            found += [f"table of {block['columns']}"] * (figures <= {"", "-"})
    lines = [line for line in text.split("\n") if line]
    for line, after in pairwise([*lines, "# end"]):
        depth, next_depth = (len(one) - len(one.lstrip("#")) for one in (line, after))
        found += [line] * (line in ".,:;" or 0 < next_depth <= depth)
    return found


@pytest.mark.parametrize(
    "text",
    ["# a\n\n.\n", "# a\n\n## b\n\n## c\n\ntext\n", "text\n\n## b\n"]
    + [manifests.markdown_table(["a", "b"], rows) for rows in ([], [["here", "-"], ["there", ""]])],
)
def test_what_is_empty_on_a_page_is_found(text: str) -> None:
    assert empty_places(text)


@for_each(RENDERED)
def test_no_part_of_a_page_is_empty(name: str) -> None:
    assert empty_places(RENDERED[name]) == []


def test_every_page_of_figures_has_its_manifest() -> None:
    pages_there = {path.name for path in (ROOT / "docs" / "benchmarks").glob("*.md")}
    assert pages_there == set(RENDERED)


@for_each(MANIFESTS)
def test_a_manifest_says_by_what_command_it_came_about(name: str) -> None:
    stamps = MANIFESTS[name].get("sections", {"": MANIFESTS[name]}).values()
    for stamp in stamps:
        assert stamp["command"].startswith("packwork bench ")
        assert re.fullmatch(r"\d{4}-\d\d-\d\d", stamp["date"])
        assert "numpy" in stamp["machine"]


def pictures_in(value: Any) -> list[dict[str, str]]:
    if isinstance(value, dict):
        own = [value] if "sha256" in value else []
        return own + [one for child in value.values() for one in pictures_in(child)]
    return [one for child in value for one in pictures_in(child)] if isinstance(value, list) else []


PICTURES = [one for manifest in MANIFESTS.values() for one in pictures_in(manifest)]


@for_each(PICTURES, name=lambda picture: picture["file"])
def test_a_picture_is_that_of_the_run(picture: dict[str, str]) -> None:
    data = (ROOT / "docs" / picture["file"]).read_bytes()
    assert hashlib.sha256(data).hexdigest() == picture["sha256"]


def test_the_readme_says_of_the_bear_what_was_measured() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (said,) = re.findall(r"hundred\s+icons\s+takes\s+less\s+than\s+(\d+)\s+seconds", readme)
    measured = max(MANIFESTS["scaling"]["sections"]["bear"]["found"])
    assert measured < int(said) < 2 * measured


@pytest.mark.parametrize(
    "text",
    [
        "",
        "one\ntwo",
        manifests.markdown_table(["a", "b"], [["1", ""], ["", "x (2 to 3)"]]),
        "## title\n\n| a |\n| --- |\n| 1 |\n\nand so on\n",
    ],
)
def test_parts_of_a_page_come_back(text: str) -> None:
    assert manifests.text_of(manifests.blocks_of(text)) == text


def test_numbers_keep_their_digits_and_none_is_made_of_what_is_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(manifests, "FOLDER", tmp_path / "new")
    kept = manifests.write_manifest(
        "x", {1: [0.123456789, float("nan")], "names": ["a [b]", "c"], "deep": [[1], []]}
    )
    assert kept == {"1": [0.123457, None], "names": ["a [b]", "c"], "deep": [[1], []]}
    assert "[0.123457, null]" in (tmp_path / "new" / "x.json").read_text(encoding="utf-8")


def test_another_figure_makes_another_page() -> None:
    manifest = copy.deepcopy(MANIFESTS["paper"])
    manifest["cases"]["moon"]["runs"]["packwork"][0]["LC"] = 0.111
    assert "0.111" in pages.PAGES["paper"](manifest)
    assert pages.PAGES["paper"](manifest) != RENDERED["paper.md"]


STAMP = {"machine": "m", "date": "2000-01-01", "command": "packwork bench peers"}


def peers_of(*runs: dict[str, Any]) -> dict[str, Any]:
    return {"sections": {"circles": {**STAMP, "runs": list(runs)}}}


def test_a_peer_that_is_not_there_has_a_line_and_no_figure() -> None:
    manifest = peers_of(peering.missing("circlify", "pip install circlify"))
    assert "circlify: not installed (`pip install circlify`)." in peer_pages.page(manifest)
    assert "Not installed: circlify." in overview.page({"peers": manifest})


def test_a_peer_that_came_to_no_end_says_so() -> None:
    late = peering.timed_out("circlify", "1", "equal", 1_000, 60.0)
    assert "| circlify 1 | equal | 1,000 | - | - | stopped after 60 s |" in peer_pages.page(
        peers_of(late)
    )


def test_the_overview_divides_ours_by_theirs() -> None:
    ours = peering.entry("packwork", "1", "equal", 100, [2.0, 3.0, 4.0], {"density": [0.6]})
    theirs = peering.entry("d3", "3", "equal", 100, [1.5], {"density": [0.8]})
    text = overview.page({"peers": peers_of(ours, theirs)})
    assert "| circles: equal, 100 | d3 3 | density 0.600 | 0.800 | 0.75 | 3 s | 1.5 s | 2 |" in text
    assert "d3 in circles, equal, 100 items (density 0.800, ours 0.600)" in text


def test_what_is_published_is_never_a_measurement_of_ours() -> None:
    assert COMPARISONS["icons"].coverage is None
    text = overview.page({})
    assert "ShapeWordle (published)" not in text

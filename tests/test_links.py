"""Links between pages: every anchor is a heading of the page that it leads to."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [*ROOT.glob("*.md"), *sorted((ROOT / "docs").rglob("*.md")), *ROOT.glob("examples/*/*.md")]


def anchors(page: Path) -> set[str]:
    """What the headings of a page are called in links, as forges and the site make it."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    found: set[str] = set()
    for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        shown = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        found.add(re.sub(r"[^\w\- ]", "", shown).strip().lower().replace(" ", "-"))
    return found


def test_headings_become_anchors(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    text = "# A `b`, [c](d.md)\n```sh\n# no heading\n```\n## Errors and exit codes\n"
    page.write_text(text, encoding="utf-8")
    assert anchors(page) == {"a-b-c", "errors-and-exit-codes"}


def test_every_anchor_is_a_heading() -> None:
    lost = [
        f"{page}: {target}#{anchor}"
        for page in PAGES
        for text in [page.read_text(encoding="utf-8")]
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", text)
        if "://" not in target and anchor not in anchors(page.parent / target if target else page)
    ]
    assert lost == []


@pytest.mark.parametrize("name", ["README", "guide/tutorial", "guide/users", "how-it-works"])
def test_the_site_and_the_readme_lead_to_what_a_newcomer_needs(name: str) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"](docs/{name}.md)" in readme


def test_every_decision_is_in_the_index_by_its_title() -> None:
    folder = ROOT / "docs" / "decisions"
    index = (folder / "README.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| \[\d+\]\((\S+)\) \| (.+?) \|", index, flags=re.MULTILINE))
    titles = {
        page.name: re.sub(r"^# (\d+\. )?", "", page.read_text(encoding="utf-8").splitlines()[0])
        for page in folder.glob("0*.md")
    }
    assert rows == titles


def links_of(page: Path) -> list[str]:
    """What a page links to and shows, code left out, anchors cut off."""
    text = re.sub(r"```.*?```|`[^`]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return re.findall(r"\]\(([^)#\s]+)", text) + re.findall(r'src="([^"]+)"', text)


def test_every_link_leads_to_a_file() -> None:
    lost = [
        f"{page}: {target}"
        for page in PAGES
        for target in links_of(page)
        if "://" not in target and not (page.parent / target).is_file()
    ]
    assert lost == []

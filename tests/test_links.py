"""Links between pages: every anchor is a heading of the page that it leads to."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")), *ROOT.glob("examples/*/*.md")]


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


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_every_anchor_is_a_heading(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    lost = [
        f"{target}#{anchor}"
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", text)
        if "://" not in target and anchor not in anchors(page.parent / target if target else page)
    ]
    assert lost == []


@pytest.mark.parametrize("name", ["tutorial", "users", "how-it-works"])
def test_the_site_and_the_readme_lead_to_what_a_newcomer_needs(name: str) -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"](docs/{name}.md)" in readme


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_every_link_leads_to_a_file(page: Path) -> None:
    text = re.sub(r"```.*?```|`[^`]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    targets = re.findall(r"\]\(([^)#\s]+)", text) + re.findall(r'src="([^"]+)"', text)
    lost = [
        target
        for target in targets
        if "://" not in target
        and not (page.parent / target).is_file()
        and target != "docs/decisions/"
    ]
    assert lost == []

"""The site without building it: which pages it has, and what the reference says."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer.main

import packwork
from packwork.cli import app

ROOT = Path(__file__).parents[1]


@pytest.fixture
def tools(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The modules that write the site."""
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import build_site
    import reference

    yield build_site, reference
    for name in ("build_site", "check_site", "reference"):
        sys.modules.pop(name, None)


def test_every_page_is_in_the_sidebar(tools: Any) -> None:
    site, reference = tools
    listed = [name for names in site.PAGES.values() for name in names]
    written = {f"reference/{name}" for name in reference.REFERENCE}
    docs = ROOT / "docs"
    paths = [path.relative_to(docs).with_suffix("") for path in docs.rglob("*.md")]
    pages = {path.as_posix() for path in paths if path.parts[0] not in site.LISTED}
    assert sorted(listed) == sorted(pages | written)


def test_the_first_page_leads_to_files(tools: Any) -> None:
    text = (tools[0].FIRST / "index.md").read_text(encoding="utf-8")
    named = re.findall(r"\]\((\S+?)\)|src=\"(\S+?)\"", text)
    assert len(named) > 15
    assert [name for pair in named for name in pair if name and not (ROOT / name).is_file()] == []


def test_a_link_that_leads_nowhere_is_found(
    tools: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import check_site

    monkeypatch.setattr(check_site, "SITE", tmp_path)
    (tmp_path / "b.html").write_text('<p id="here">', encoding="utf-8")
    links = ["b.html#here", "b.html#there", "c.html", "https://example.org", "#self"]
    page = '<p id="self">' + "".join(f'<a href="{link}">' for link in links)
    (tmp_path / "a.html").write_text(page, encoding="utf-8")
    assert list(check_site.dead_links()) == [
        "a.html: b.html#there is no heading", "a.html: c.html is no file",
    ]  # fmt: skip


def test_the_reference_has_every_command_and_option(tools: Any) -> None:
    page = tools[1].commands_page()
    commands: Any = typer.main.get_command(app)
    for name, command in commands.commands.items():
        assert f"## `packwork {name}`" in page
        for option in (p for p in command.params if p.param_type_name == "option"):
            assert f"`{option.opts[-1]}`" in page
    assert "None" not in page


def test_the_reference_has_every_key_of_a_recipe(tools: Any) -> None:
    reference = tools[1]
    page = reference.recipes_page()
    assert page.index("| `container` |") < page.index("| `force` |")
    for title, model in reference.TABLES.items():
        part = page.split(f"## {title}\n")[1].split("\n## ")[0]
        rows = [line.split(" | ") for line in part.splitlines() if line.startswith("| `")]
        assert {row[0].strip("| `") for row in rows} == set(model.model_fields)
        assert all(len(row) == 3 and row[2].strip(" |") for row in rows), title


def test_the_reference_has_every_public_name(tools: Any) -> None:
    page = tools[1].python_page()
    assert all(f":: packwork.{name}\n" in page for name in packwork.__all__)

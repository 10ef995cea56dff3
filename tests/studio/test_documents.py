"""The document of a desk: its name, templates to begin with, and what was kept."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from packwork.live.commands.container import Entitle
from packwork.live.face.opening import Opening
from packwork.live.face.templates import TEMPLATES, template
from packwork.live.session import Session
from packwork.studio import kept_workspaces
from packwork.studio.workspace import Workspace

NAMES = ["icons", "letters", "words", "names", "badge", "jar", "photos", "mosaic", "paper", "nest"]


@pytest.fixture
def private(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(kept_workspaces, "_folder", lambda: tmp_path)
    return tmp_path


def test_each_template_has_a_picture_and_begins() -> None:
    pictures = resources.files("packwork.studio").joinpath("static/templates")
    # A chart begins with a table, in a dialog of its own.
    named = sorted(f"{name}.webp" for name in (*TEMPLATES, "chart"))
    assert sorted(one.name for one in pictures.iterdir()) == named
    assert sorted(TEMPLATES) == sorted(NAMES)
    nested = template("nest").document
    assert nested is not None
    assert Session(nested).is_certified
    assert nested.kind.has_parts


def test_a_title_is_in_the_file_and_no_step_of_the_history(play: Callable) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        assert page.last("scene")["title"] == page.last("scene")["name"]
        page.tell(type="do", n=1, command={"kind": "entitle", "title": "Für Ada"})
        await page.until(lambda: page.last("scene")["title"] == "Für Ada")
        assert not page.last("state")["can_undo"]
        assert desk.owner is not None
        assert desk.owner.frame.document.title == "Für Ada"

    play(scenario)


def test_what_is_kept_is_listed_and_gone_on_with(
    opening: Any, private: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shelf = kept_workspaces.Shelf(4711, "0" * 64)
    file = shelf.new_file()
    assert file is not None

    async def work() -> None:
        desk = Workspace(Opening(document=opening.document, kept_in=file), shelf)
        await desk.begin()
        while desk.owner is None:
            await asyncio.sleep(0.01)
        desk.owner.post(Entitle(title="first"))
        # What somebody works at is not listed.
        assert shelf.recent() == []
        await asyncio.to_thread(desk.open_another, template("nest"))
        (kept,) = shelf.recent()
        assert (kept.title, kept.count) == ("first", 12)
        assert kept.png.startswith(b"\x89PNG")
        again = Opening(file=shelf.file(kept.name))
        await asyncio.to_thread(desk.open_another, again)
        assert desk.owner.frame.document.title == "first"
        assert [one.count for one in shelf.recent()] == [20]
        await asyncio.to_thread(desk.close)

    asyncio.run(work())
    assert {one.title for one in shelf.recent()} == {"first", "sheet"}
    # What has not changed is neither read nor drawn at the next start.
    monkeypatch.delattr(kept_workspaces, "read_once")
    again = kept_workspaces.Shelf(4712, "1" * 64).recent()
    assert again == shelf.recent()
    assert kept_workspaces.last().address == (4711, "0" * 64)


@pytest.mark.parametrize("asked", [{}, {"kept": "desk-9"}, {"template": "photos"}])
def test_what_cannot_be_begun_is_a_line(play: Callable, asked: dict[str, str]) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        page.tell(type="begin", **asked)
        await page.until(lambda: page.said("line"))
        assert len(page.last("scene")["items"]) == 12

    play(scenario)

"""Files of every kind that a person gives to the page, in a browser."""

from __future__ import annotations

from collections.abc import Callable
from importlib import resources
from pathlib import Path

import pytest

import packwork as pw
from studio.browsing import Desk, in_browser

pytestmark = in_browser

TABLE = "word,count\nriver,9\nstone,6\nmoss,4\nheron,3\nreed,2\n"


def give(desk: Desk, *files: Path) -> None:
    """Choose files, as the button does."""
    desk.page.locator("input[type=file]").first.set_input_files(files)


def names(desk: Desk) -> list[str]:
    return desk.look("studio.collage.items.map(item => item.name)")


@pytest.mark.parametrize(("ending", "container"), [("svg", "cat"), ("packwork", "bear")])
def test_a_document_opens(
    open_desk: Callable[..., Desk], tmp_path: Path, ending: str, container: str
) -> None:
    layout = pw.fill(container, ["bird", "fish"], count=8, epochs=60, levels="50")
    layout.save(tmp_path / f"kept.{ending}")
    desk = open_desk()
    give(desk, tmp_path / f"kept.{ending}")
    desk.until(f"studio.collage.scene?.name === '{container}'")
    desk.settled()
    assert sorted(set(names(desk))) == ["bird", "fish"]
    assert not desk.look("studio.collage.state.can_undo")
    desk.page.mouse.click(*desk.place(0))
    desk.page.keyboard.press("h")
    desk.until("studio.areHeld")


def test_a_table_is_asked_about_and_a_font_sets_its_words(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    (tmp_path / "river.csv").write_text(TABLE, encoding="utf-8")
    give(desk, tmp_path / "river.csv")
    asked = desk.page.locator("dialog.asking[open]")
    asked.wait_for()
    assert asked.locator("tr").count() == 5
    desk.picture("table")
    asked.get_by_role("button", name="Words").click()
    desk.until("studio.collage.items.length === 5 && studio.collage.items[0].is_word")
    desk.settled()
    assert sorted(names(desk)) == ["heron", "moss", "reed", "river", "stone"]
    before = desk.look("studio.collage.items.map(item => item.shape).sort().join()")
    fonts = resources.files("packwork.bundled").joinpath("fonts")
    font = next(one for one in fonts.iterdir() if one.name.endswith((".ttf", ".otf")))
    own = tmp_path / f"own{Path(font.name).suffix}"
    own.write_bytes(font.read_bytes())
    give(desk, own)
    desk.page.locator(".toast", has_text="Setting the words in own").wait_for()
    desk.until(
        "document.querySelector('#panel select[aria-label=Font]')?.value.startsWith('file:')"
    )
    desk.settled()
    assert before.count(",") == 4
    desk.picture("font")


def test_a_text_fills_with_its_words(open_desk: Callable[..., Desk], tmp_path: Path) -> None:
    desk = open_desk()
    text = "the sea the sea the wide grey sea, and over the sea gulls, gulls and wind"
    (tmp_path / "sea.txt").write_text(text, encoding="utf-8")
    give(desk, tmp_path / "sea.txt")
    desk.until("studio.collage.items.some(item => item.is_word && item.name === 'gulls')")
    desk.settled()

"""How a document begins on the page: templates, what was kept, a name; in a browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PIL import Image

from studio.browsing import PHONE, Desk, Server, in_browser

pytestmark = in_browser


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    made = Server().start()
    yield made
    made.stop()


def test_a_desk_without_inputs_offers_templates(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    dialog = desk.page.locator("dialog.start[open]")
    dialog.wait_for()
    assert dialog.locator("img[src*=templates]").count() == 11
    desk.until("[...document.querySelectorAll('dialog.start img')].every(one => one.naturalWidth)")
    desk.picture("start")
    dialog.get_by_role("button", name="Parts on a sheet").click()
    desk.until("studio.collage.scene?.kind === 'nest'")
    desk.settled()
    desk.picture("template-nest")
    # It is kept apart: what was there before can be gone on with.
    desk.page.keyboard.press("Shift+N")
    dialog.get_by_role("button", name="heart 60 items").first.click()
    desk.until("studio.collage.scene?.title === 'heart'")
    desk.settled()


def test_a_chart_is_begun_with_a_table_of_ones_own(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    table = tmp_path / "pets.csv"
    table.write_text("name;kg\nRex;30,5\nTom;4,2\nIda;3,9\n", encoding="utf-8")
    desk = open_desk()
    if not desk.look("studio.start.dialog.open"):
        desk.page.keyboard.press("Shift+N")
    with desk.page.expect_file_chooser() as waiting:
        desk.page.locator("dialog.start").get_by_role("button", name="A chart").click()
    waiting.value.set_files(table)
    desk.page.get_by_role("button", name="Draw the chart").click()
    desk.until("studio.collage.scene?.kind === 'chart' && studio.collage.items.length === 3")
    desk.settled()


def test_a_template_begins_a_document(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    if not desk.look("studio.start.dialog.open"):
        desk.page.keyboard.press("Shift+N")
    desk.look("studio.choice.set([studio.collage.items[0].id])")
    desk.page.locator("dialog.start").get_by_role("button", name="A wall").click()
    desk.until("studio.collage.scene?.kind === 'collage' && studio.collage.items.length === 39")
    desk.settled()
    # What has the same number there is another item.
    assert desk.look("studio.choice.ids.size") == 0
    desk.picture("template-collage")


def test_a_jar_is_heaped_anew_and_what_comes_falls(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    if not desk.look("studio.start.dialog.open"):
        desk.page.keyboard.press("Shift+N")
    desk.page.locator("dialog.start").get_by_role("button", name="A jar").click()
    desk.until("studio.collage.scene?.kind === 'pile' && studio.collage.items.length === 64")
    desk.settled()
    desk.picture("template-pile")
    # A handful is heaped as the jarful is.
    most = "studio.collage.items.slice(9).map(one => one.id)"
    desk.look(f"studio.connection.do({{kind: 'remove', items: {most}}})")
    desk.until("studio.collage.items.length === 9")
    desk.settled()
    assert desk.page.get_by_text("Put them in an order").is_hidden()
    desk.page.locator("summary:has-text('Add bundled ones')").click()
    desk.page.get_by_role("button", name="Add donut").click()
    desk.until("studio.collage.items.length === 10")
    desk.settled()
    # Nothing hangs in the air: below the newest one there is another, or the ground.
    newest = desk.look("studio.collage.items[9].id")
    tops = "studio.collage.items.map(one => studio.collage.pose(one.id).y)"
    assert desk.look(f"Math.min(...{tops})") > desk.look("studio.collage.scene.height") / 5
    before = desk.look(f"studio.collage.pose({newest}).x")
    desk.pour(desk.page.get_by_role("button", name="Heap anew").click)
    assert desk.look(f"studio.collage.pose({newest}).x") != before
    desk.picture("jar-anew")


def test_photographs_of_ones_own_fill_a_heart(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    files = []
    for k, colour in enumerate(("tan", "teal", "navy", "plum")):
        files.append(tmp_path / f"{colour}.png")
        Image.new("RGB", (60 + 20 * k, 50), colour).save(files[-1])
    desk = open_desk()
    desk.page.keyboard.press("Shift+N")
    with desk.page.expect_file_chooser() as waiting:
        desk.page.locator("dialog.start").get_by_role("button", name="Your photographs").click()
    waiting.value.set_files(files)
    desk.until(
        "studio.collage.items.length === 4 && studio.collage.items.some(x => x.name === 'plum')"
    )
    desk.settled()


def test_a_document_is_renamed_and_begun_by_the_menu(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.keyboard.press("Escape")
    title = desk.page.locator("#title")
    title.fill("For Ada")
    title.press("Enter")
    desk.until("studio.collage.scene.title === 'For Ada'")
    assert desk.page.title().startswith("For Ada")
    desk.page.locator("#files").click()
    desk.picture("files")
    with desk.page.expect_download() as waiting:
        desk.page.get_by_role("menuitem", name="Save a copy").click()
    assert waiting.value.suggested_filename == "For Ada.packwork"


def tab_to(desk: Desk, what: str, key: str = "Tab") -> None:
    """Tab until an element of a selector has the focus."""
    for _ in range(80):
        if desk.look(f"document.activeElement.matches({what!r})"):
            return
        desk.page.keyboard.press(key)
    raise AssertionError(f"no Tab leads to {what}")


def test_tab_arrows_and_enter_lead_from_the_start_to_a_pdf(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    keys = desk.page.keyboard
    if not desk.look("studio.start.dialog.open"):
        tab_to(desk, "#files")
        keys.press("Enter")
        tab_to(desk, "[role=menuitem]")
        keys.press("Enter")
    tab_to(desk, "dialog.start button:has(img[src*=names])")
    keys.press("Enter")
    desk.until("studio.collage.items.length === 39 && studio.collage.items[0].is_word")
    desk.settled()
    tab_to(desk, "#panel *", "F6")
    tab_to(desk, "#panel button.item")
    keys.press("Enter")
    desk.until("studio.choice.ids.size === 1")
    before = desk.look("studio.collage.pose([...studio.choice.ids][0]).x")
    for _ in range(3):
        keys.press("ArrowRight")
    desk.until(f"studio.collage.pose([...studio.choice.ids][0]).x !== {before}")
    desk.settled()
    tab_to(desk, "#bar *", "Shift+F6")
    tab_to(desk, "#panel *", "F6")
    tab_to(desk, "#find")
    keys.press("Control+e")
    tab_to(desk, "dialog.export input[name=format]")
    keys.press("ArrowDown")
    tab_to(desk, "dialog.export button.primary")
    with desk.page.expect_download() as waiting:
        keys.press("Enter")
    assert waiting.value.suggested_filename.endswith(".pdf")
    assert Path(waiting.value.path()).read_bytes().startswith(b"%PDF")


def test_the_start_fits_a_phone(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk(PHONE)
    if not desk.look("studio.start.dialog.open"):
        desk.page.locator("#files").click()
        desk.page.get_by_role("menuitem", name="New").click()
    desk.page.locator("dialog.start[open]").wait_for()
    desk.until("[...document.querySelectorAll('dialog.start img')].every(one => one.naturalWidth)")
    desk.picture("start-phone")
    box = desk.page.locator("dialog.start").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= PHONE["width"]

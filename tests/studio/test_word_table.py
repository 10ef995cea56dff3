"""The table of words on the page: counts as counted, left out and brought back, upright."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import pytest

from studio.browsing import PHONE, Desk, in_browser

pytestmark = in_browser

TABLE = "word,count\n" + "\n".join(
    f"{word},{count}"
    for word, count in (
        ("river", 30), ("stone", 28), ("moss", 27), ("heron", 26), ("otter", 24), ("fern", 12),
    )
)  # fmt: skip


def with_words(
    open_desk: Callable[..., Desk], folder: Path, *size: dict[str, int], **more: bool
) -> Desk:
    desk = open_desk(*size, **more)
    (folder / "river.csv").write_text(TABLE, encoding="utf-8")
    ids = "studio.collage.items.map(item => item.id).join()"
    before = desk.look(ids)
    desk.page.locator("input[type=file]").first.set_input_files(folder / "river.csv")
    desk.page.locator("dialog.asking[open]").get_by_role("button", name="Words").click()
    desk.until(f"studio.collage.items.length === 6 && {ids} !== '{before}'")
    desk.settled()
    if not desk.page.locator(".words").count():
        desk.page.locator("#tab-words").click()
    return desk


def names(desk: Desk) -> list[str]:
    return desk.look("studio.collage.items.map(item => item.name)")


def test_words_are_counted_left_out_and_brought_back(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = with_words(open_desk, tmp_path)
    counts = desk.page.get_by_label("How often: ")
    assert [one.input_value() for one in counts.all()][:4] == ["30", "28", "27", "26"]
    scales = (
        "Object.fromEntries(studio.collage.items.map("
        "item => [item.name, studio.collage.pose(item.id).scale]))"
    )
    before = desk.look(scales)
    desk.page.get_by_role("button", name="Leave stone out").press("Enter")
    desk.until("studio.collage.items.every(item => item.name !== 'stone')")
    desk.settled()
    # Keys go on where they were, at the word that has come in its place.
    label = "document.activeElement.getAttribute('aria-label')"
    assert desk.look(label) == "Leave moss out"
    # What is left is as large as before, in the room of what has gone.
    assert all(scale > 0.95 * before[name] for name, scale in desk.look(scales).items())
    desk.picture("words-table")
    # The document keeps it, whoever opens it.
    desk.page.reload()
    desk.until("studio.collage?.items.length === 5")
    desk.page.locator("#tab-words").click()
    desk.page.get_by_role("button", name="stone ×").click()
    desk.until("studio.collage.items.some(item => item.name === 'stone')")
    desk.settled()
    assert desk.page.get_by_label("How often: stone").input_value() == "28"
    size = "(id => studio.collage.item(id).weight)"
    fern = desk.look("studio.collage.items.find(item => item.name === 'fern').id")
    before = desk.look(f"{size}({fern})")
    desk.page.get_by_label("How often: fern").fill("24")
    desk.page.get_by_label("How often: fern").press("Enter")
    desk.until(f"{size}({fern}) > 1.5 * {before}")
    desk.settled()
    assert desk.page.get_by_label("How often: fern").input_value() == "24"
    # What would make all others tiny is taken back, which is said where it was asked.
    desk.page.get_by_label("How often: fern").fill("4000")
    desk.page.get_by_label("How often: fern").press("Enter")
    desk.page.locator(".toast", has_text="taken back, for all would become smaller").wait_for()
    assert desk.page.get_by_label("How often: fern").input_value() == "24"


def test_a_word_stays_upright_and_has_its_colour(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = with_words(open_desk, tmp_path)
    item = desk.look("studio.collage.items.find(item => item.name === 'moss').id")
    desk.page.get_by_role("button", name="moss stays upright").click()
    desk.until(f"studio.collage.item({item}).held[1]")
    desk.settled()
    assert desk.look(f"studio.collage.pose({item}).angle") == pytest.approx(0, abs=1e-6)
    desk.page.get_by_label("Colour of moss").fill("#ff0000")
    desk.until(f"studio.collage.colour({item}) === '#ff0000'")
    desk.settled()


def test_words_left_out_of_a_text_do_not_come(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = with_words(open_desk, tmp_path)
    field = desk.page.get_by_label("Leave out another word")
    field.fill("gulls")
    field.press("Enter")
    desk.page.locator("#text").fill("sea gulls and sea wind, gulls over the grey sea and the wind")
    desk.page.get_by_text("Fill with words").click()
    desk.until("studio.collage.items.some(item => item.name === 'wind')")
    desk.settled()
    assert "gulls" not in names(desk)


def test_the_table_fits_a_phone(open_desk: Callable[..., Desk], tmp_path: Path) -> None:
    desk = with_words(open_desk, tmp_path, PHONE, has_touch=True, is_mobile=True)
    desk.page.locator(".words li").first.wait_for()
    desk.picture("words-phone")
    # Large enough for a finger, each beside the next.
    boxes = desk.look(
        "[...document.querySelector('.words li').children].map(e => e.getBoundingClientRect())"
        ".filter(box => box.width)"
    )
    assert min(box["height"] for box in boxes) >= 44
    assert all(one["right"] <= two["left"] for one, two in pairwise(boxes))
    assert boxes[-1]["right"] <= PHONE["width"]

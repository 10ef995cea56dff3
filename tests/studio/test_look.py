"""Colours of all items and what is behind them, chosen on the page."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image

from studio.browsing import Desk, in_browser

pytestmark = in_browser

FILLS = (
    "studio.collage.items.filter((item) => item.name !== 'moon')"
    ".map((item) => studio.collage.colour(item.id))"
)
MUTED = 9


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Desk:
    return open_desk()


def test_a_palette_is_put_on_by_mouse_and_by_keys_and_undone(desk: Desk) -> None:
    before, places = desk.look(FILLS), desk.look("[...studio.collage.poses]")
    desk.page.keyboard.press("6")
    desk.page.get_by_role("button", name="tol-muted", exact=True).click()
    desk.until(f"studio.collage.scene.palette.length === {MUTED}")
    muted = set(desk.look("studio.collage.scene.palette"))
    assert set(desk.look(FILLS)) <= muted
    assert len(set(desk.look(FILLS))) > 4
    desk.picture("look-muted")
    strip = desk.page.get_by_role("button", name="ink", exact=True)
    strip.focus()
    desk.page.keyboard.press("Enter")
    desk.until("studio.collage.scene.palette[0] === '#22304f'")
    assert strip.get_attribute("aria-pressed") == "true"
    desk.page.get_by_label("Colour 1 of the palette").fill("#ff0000")
    desk.until("studio.collage.scene.palette[0] === '#ff0000'")
    assert "#ff0000" in desk.look(FILLS)
    for _ in range(2):
        desk.page.locator("#bar [data-do=undo]").click()
    desk.until(f"studio.collage.scene.palette.length === {MUTED}")
    desk.page.get_by_role("button", name="their own").click()
    desk.until("!studio.collage.scene.palette.length")
    assert desk.look(FILLS) == before
    assert desk.look("[...studio.collage.poses]") == places


def test_the_background_on_the_page_is_that_of_the_file(desk: Desk) -> None:
    desk.page.locator("#tab-look").click()
    desk.page.locator("#panel [data-ground='#171717']").click()
    desk.until("studio.collage.scene.ground === '#171717'")
    desk.page.locator("#export").click()
    desk.page.locator("dialog.export input[value=png]").check()
    with desk.page.expect_download() as waited:
        desk.page.locator("dialog.export button.primary").click()
    with Image.open(BytesIO(Path(waited.value.path()).read_bytes())) as picture:
        assert picture.convert("RGB").getpixel((1, 1)) == (0x17, 0x17, 0x17)


CONTRAST = """(() => {
  const light = (colour) => colour.match(/[\\d.]+/g).slice(0, 3).map(Number)
    .map((one) => (one / 255 <= 0.04045 ? one / 255 / 12.92 : ((one / 255 + 0.055) / 1.055) ** 2.4))
    .reduce((sum, one, k) => sum + one * [0.2126, 0.7152, 0.0722][k], 0);
  const panel = light(getComputedStyle(document.querySelector("dialog.export")).backgroundColor);
  return [...document.querySelectorAll("#panel button.ground")].map((one) => {
    const edge = light(getComputedStyle(one).borderTopColor);
    return (Math.max(edge, panel) + 0.05) / (Math.min(edge, panel) + 0.05);
  });
})()"""


def test_backgrounds_are_told_from_the_page_in_light_and_dark(desk: Desk) -> None:
    desk.page.locator("#tab-look").click()
    desk.page.locator("#badge").click()
    for scheme in ("light", "dark"):
        desk.page.emulate_media(color_scheme=scheme)
        desk.until(f"getComputedStyle(document.documentElement).colorScheme === '{scheme}'")
        # As WCAG asks of what is no text.
        assert min(desk.look(CONTRAST)) > 3
        desk.picture(f"look-{scheme}")
    # What tells how things stand is closed by Escape, as a menu is.
    assert desk.page.locator("#why").is_visible()
    desk.page.keyboard.press("Escape")
    assert desk.page.locator("#why").is_hidden()


def test_halos_are_on_the_page(desk: Desk) -> None:
    if not desk.page.get_by_label("Halos").is_visible():
        desk.page.locator("#tab-look").click()
    desk.page.locator("#panel [data-ground='#171717']").click()
    halos = desk.page.get_by_label("Halos")
    halos.select_option("all")
    desk.until("studio.collage.items.every((item) => item.halo)")
    # Their colour is seen.
    is_seen = desk.look("""(() => {
      const { collage, stage } = studio;
      stage.draw();
      const seen = new Set();
      const { width, height } = stage.canvas;
      const { data } = stage.pen.getImageData(0, 0, width, height);
      for (let k = 0; k < data.length; k += 4) seen.add(data.slice(k, k + 3).join());
      const channels = collage.items[0].halo.slice(1).match(/../g);
      const rim = channels.map((one) => parseInt(one, 16)).join();
      return seen.has(rim);
    })()""")
    assert is_seen
    desk.picture("halos")
    # Fields and buttons say what there is, whoever has asked for it.
    desk.look("studio.connection.do({ kind: 'background', colour: 'radial-gradient(red, blue)' })")
    desk.until("studio.collage.scene.gradient")
    fields = [one.input_value() for one in desk.page.get_by_label("of the gradient").all()]
    assert fields == ["#ff0000", "#0000ff", "radial-gradient("]
    black = desk.page.locator("#panel [data-ground='#171717']")
    assert black.get_attribute("aria-pressed") == "false"
    for _ in range(2):
        desk.page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.items.every((item) => !item.halo)")
    assert halos.input_value() == "none"
    assert black.get_attribute("aria-pressed") == "true"


def test_a_pipette_is_there_where_the_browser_has_one(open_desk: Callable[..., Desk]) -> None:
    # No other test is to have that program: a page of its own.
    desk = open_desk(color_scheme="light")
    taken = "class { open() { return Promise.resolve({ sRGBHex: '#123456' }); } }"
    for pipette, count in ((taken, 1), ("undefined", 0)):
        desk.page.add_init_script(f"globalThis.EyeDropper = {pipette};")
        desk.page.reload()
        desk.settled()
        desk.page.locator("#tab-look").click()
        found = desk.page.get_by_role("button", name="Colour behind all, from the screen")
        assert found.count() == count
        if count:
            found.click()
            desk.until("studio.collage.scene.ground === '#123456'")
    desk.undo_all()

"""What five tasks of a first-time user need, once in Firefox."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

from studio.browsing import Server
from studio.firefox import Firefox, firefox, firefox_path

TEXT = "moss " * 9 + "rain " * 7 + "the rain on stone and fern, moss and stone"

PLACE = """((id, r = studio.canvas.getBoundingClientRect()) => {
  const { x, y } = studio.collage.pose(id), s = studio.view.toScreen(x, y);
  return [s.x + r.left, s.y + r.top];
})"""


def place(page: Firefox, item: int) -> tuple[float, float]:
    x, y = page.look(f"{PLACE}({item})")
    return x, y


@pytest.fixture
def server(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """A studio of its own."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    made = Server("heart", "star", "moon", "-n", "8").start()
    yield made
    made.stop()


@pytest.mark.skipif(firefox_path() is None, reason="no Firefox on this machine")
@pytest.mark.xdist_group("browser")
def test_five_tasks_in_firefox(server: Server, tmp_path: Path) -> None:
    (profile := tmp_path / "profile").mkdir()
    field = "input[type=file]:not([webkitdirectory])"
    noise = [Image.effect_noise((90, 60), 60 + k) for k in range(3)]
    Image.merge("RGB", noise).save(tmp_path / "sky.jpg")
    with firefox(profile) as page:
        page.goto(server.address)
        page.settled()
        # A hero among icons: dragged, enlarged and held.
        x, y = place(page, 0)
        page.drag((x, y), (x - 30, y - 20), (x - 60, y - 40))
        page.settled()
        assert math.dist(place(page, 0), (x, y)) > 5
        page.type("++")
        page.settled()
        page.type("h")
        page.until("studio.collage.item(0).held.every(Boolean)")
        page.settled()
        page.picture("firefox-hero")
        # A photograph, moved in its frame.
        page.look("studio.dropping.as = 'photos'")
        page.send_file(field, tmp_path / "sky.jpg")
        page.until("studio.collage.items.some(item => item.crop)")
        page.settled()
        photo = page.look("studio.collage.items.find(item => item.crop).id")
        page.look(f"studio.choice.set([{photo}])")
        page.look("studio.canvas.focus()")
        page.type("\ue007++\ue007")
        page.until(f"studio.collage.item({photo}).crop[0] > 1")
        page.settled()
        # A cloud, one word left out and one weight changed.
        page.type("3")
        page.look(f"studio.words.text.value = {TEXT!r}")
        page.click("#panel form button.primary")
        page.until("studio.collage.items.some(item => item.name === 'stone')")
        page.settled()
        page.click("[aria-label='Leave stone out']")
        page.until("!studio.collage.items.some(item => item.name === 'stone')")
        page.settled()
        page.click("[aria-label='How often: fern']")
        page.look("document.activeElement.select()")
        page.type("9\ue007")
        page.until("studio.words.list.countOf('fern', studio.words.list.things) === 9")
        page.settled()
        page.picture("firefox-words")
        page.click("#export")
        page.click("dialog.export input[value=packwork]")
        kept = page.downloaded("dialog.export button[type=submit]", profile / "heart.packwork")
        (yesterday := tmp_path / "yesterday.packwork").write_bytes(kept)
        # A jar.
        page.look("studio.start.open()")
        page.click("dialog.start button:has(img[src*=jar])")
        page.until("studio.collage.scene.kind === 'pile'")
        page.settled()
        # Yesterday's file is opened, recoloured and exported to PDF.
        page.send_file(field, yesterday)
        page.until("studio.collage.items.some(item => item.name === 'moss')")
        page.settled()
        assert page.look("studio.collage.scene.title") == "yesterday"
        page.type("6")
        page.until("document.querySelector('[aria-label=tol-muted]')")
        page.click("[aria-label=tol-muted]")
        page.until("studio.collage.scene.palette.length > 0")
        page.settled()
        page.picture("firefox-recoloured")
        page.click("#export")
        page.until("studio.exporting.preview.complete && studio.exporting.preview.naturalWidth")
        page.click("dialog.export input[value=pdf]")
        page.picture("firefox-export")
        pdf = page.downloaded("dialog.export button[type=submit]", profile / "yesterday.pdf")
        assert pdf.startswith(b"%PDF-")
        assert page.faults == []

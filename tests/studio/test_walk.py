"""The way of a new user: her own drawing and pictures to a PDF, by mouse and by keys alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image, ImageDraw

from studio.browsing import AS_IT_IS, Desk, Server, in_browser

pytestmark = in_browser

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 120 100"><path fill="#333" d="M10 60'
    'C0 20 40 5 60 20 80 5 120 20 110 60 100 95 80 95 60 95 40 95 20 95 10 60z"/></svg>'
)
COLOURS = ("#d1495b", "#edae49", "#00798c", "#30638e", "#003d5b")

DROP = """([files, place]) => {
  const data = new DataTransfer();
  for (const [name, bytes] of files) data.items.add(new File([new Uint8Array(bytes)], name));
  const event = (kind) => new DragEvent(kind, { dataTransfer: data, bubbles: true });
  document.body.dispatchEvent(event("dragenter"));
  const target = document.querySelector(`#drop [data-drops=${place}]`);
  target.dispatchEvent(event("dragover"));
  return new Promise((done) => requestAnimationFrame(() => {
    globalThis.veiled = !target.parentElement.hidden && target.className === "over";
    done();
  })).then(() => target.dispatchEvent(event("drop")));
}"""


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    """The program as it is: here all is won back and measured as people have it."""
    made = Server("circle", "star", "-n", "5", program=AS_IT_IS).start()
    yield made
    made.stop()


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Iterator[Desk]:
    made = open_desk()
    yield made
    made.undo_all()


@pytest.fixture
def drawing(tmp_path: Path) -> Path:
    path = tmp_path / "cloud of mine.svg"
    path.write_text(DRAWING, encoding="utf-8")
    return path


@pytest.fixture
def pictures(tmp_path: Path) -> list[Path]:
    """Round and square pictures on clear ground."""
    folder = tmp_path / "pictures"
    folder.mkdir()
    paths = []
    for k, colour in enumerate(COLOURS):
        image = Image.new("RGBA", (80, 60 + 10 * k))
        draw = ImageDraw.Draw(image)
        (draw.ellipse if k % 2 else draw.rectangle)((4, 4, 75, 55 + 10 * k), fill=colour)
        paths.append(folder / f"{'hero' if k == 0 else f'other {k}'}.png")
        image.save(paths[-1])
    return paths


def drop(desk: Desk, paths: list[Path], place: str) -> None:
    """Drop files on one of the places that show while they are over the page."""
    files = [[path.name, list(path.read_bytes())] for path in paths]
    desk.page.evaluate(DROP, [files, place])
    assert desk.look("veiled")


def hero(desk: Desk) -> int:
    return desk.look("studio.collage.items.find(item => item.name === 'hero').id")


def is_certified_pdf(desk: Desk, data: bytes) -> None:
    assert data.startswith(b"%PDF")
    assert data.rstrip().endswith(b"%%EOF")
    assert desk.look("studio.collage.state.certified")


def middle(desk: Desk) -> tuple[float, float]:
    x, y = desk.look(
        "(() => { const { width, height } = studio.view.whole;"
        " const at = studio.view.toScreen(width / 2, height / 2);"
        " return [at.x, at.y + studio.canvas.getBoundingClientRect().top]; })()"
    )
    return x, y


def test_by_mouse(desk: Desk, drawing: Path, pictures: list[Path]) -> None:
    drop(desk, [drawing], "room")
    desk.until("studio.collage.scene.name === 'cloud of mine'")
    desk.settled()
    desk.page.get_by_label("What files do").select_option("items")
    drop(desk, pictures, "items")
    desk.until("studio.collage.items.some(item => item.name === 'hero')")
    desk.settled()
    number = hero(desk)
    desk.drag(desk.place(number), middle(desk))
    desk.settled()
    desk.page.locator("#choice [data-do=hold]").click()
    desk.until("studio.areHeld")
    desk.picture("walk-held")
    other = desk.look(f"studio.collage.items.find(item => item.id !== {number}).id")
    x, y = desk.place(other)
    desk.drag((x, y), (x + 60, y + 40))
    desk.settled()
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.state.can_redo")
    desk.settled()
    assert abs(desk.place(other)[0] - x) < 20
    desk.page.locator("#export").click()
    desk.page.locator("dialog.export input[value=pdf]").check()
    desk.picture("walk-export")
    data = downloaded(desk, lambda: desk.page.locator("dialog.export button[type=submit]").click())
    is_certified_pdf(desk, data)


def test_by_keys_alone(desk: Desk, drawing: Path, pictures: list[Path]) -> None:
    keys = desk.page.keyboard
    with desk.page.expect_file_chooser() as waiting:
        keys.press("Shift+O")
    waiting.value.set_files(drawing)
    desk.until("studio.collage.scene.name === 'cloud of mine'")
    desk.settled()
    # The panel of items: what files do, then the files.
    keys.press("2")
    desk.until("document.activeElement.textContent === 'Choose files'")
    for _ in range(2):
        keys.press("Tab")
    keys.press("ArrowDown")
    assert desk.look("studio.dropping.as") == "items"
    with desk.page.expect_file_chooser() as waiting:
        keys.press("Shift+Tab")
        keys.press("Enter")
    waiting.value.set_files(pictures[0].parent)
    desk.until("studio.collage.items.some(item => item.name === 'hero')")
    desk.settled()
    keys.press("Escape")
    number = hero(desk)
    while desk.look("[...studio.choice.ids][0]") != number:
        keys.press("n")
    keys.press("m")
    at = f"studio.collage.poses[4 * studio.collage.rows.get({number})]"
    desk.until(f"Math.abs({at} - studio.view.whole.width / 2) < 40")
    desk.settled()
    keys.press("h")
    desk.until("studio.areHeld")
    count = desk.look("studio.collage.items.length")
    keys.press("n")
    keys.press("Delete")
    desk.until(f"studio.collage.items.length === {count - 1}")
    keys.press("Control+z")
    desk.until(f"studio.collage.items.length === {count}")
    desk.settled()
    keys.press("Control+e")
    keys.press("ArrowDown")
    assert desk.look("studio.exporting.kind") == "pdf"
    is_certified_pdf(desk, downloaded(desk, lambda: keys.press("Enter")))


def test_yesterdays_file_is_recoloured_on_a_new_ground_and_exported(
    desk: Desk, tmp_path: Path
) -> None:
    yesterday = tmp_path / "yesterday.packwork"
    yesterday.write_bytes(downloaded(desk, lambda: desk.page.keyboard.press("Control+s")))
    page, document = desk.page, desk.look("studio.document")
    page.keyboard.press("Shift+N")
    with page.expect_file_chooser() as waiting:
        page.get_by_role("button", name="Open a file …").click()
    waiting.value.set_files(yesterday)
    desk.until(f"studio.document !== {document}")
    desk.settled()
    page.locator("#tab-look").click()
    page.get_by_label("tol-muted").click()
    desk.answered()
    palette = desk.look("studio.collage.scene.palette")
    shown = desk.look("studio.collage.items.map(({ id }) => studio.collage.colour(id))")
    assert len(palette) > 1
    assert set(shown) <= set(palette)
    desk.page.locator("#panel [data-ground='#faf7f0']").click()
    desk.answered()
    assert desk.look("studio.collage.scene.ground") == "#faf7f0"
    desk.picture("walk-recoloured")
    page.locator("#export").click()
    page.locator("dialog.export input[value=pdf]").check()
    data = downloaded(desk, lambda: page.locator("dialog.export button[type=submit]").click())
    is_certified_pdf(desk, data)
    # The same by keys: a field of the panel is left by Escape.
    keys = page.keyboard
    keys.press("6")
    keys.press("6")
    page.locator("#panel select").first.focus()
    keys.press("Escape")
    assert desk.look("document.activeElement.id") == "canvas"


def downloaded(desk: Desk, ask: Any) -> bytes:
    """Bytes of what is handed to the person."""
    with desk.page.expect_download() as waiting:
        ask()
    return Path(waiting.value.path()).read_bytes()

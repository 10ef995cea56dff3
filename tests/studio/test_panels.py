"""Panels: what they change is changed on the desk."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PIL import Image

from studio.browsing import Desk, in_browser

ROOT = Path(__file__).parents[2]

pytestmark = in_browser


def test_name_weight_colour_and_drawing_are_changed_in_place(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    desk.page.locator("button.item", has_text="moon").click()
    editor = desk.page.locator(".editor")
    ids = desk.look("[...studio.choice.ids]")
    first = f"studio.collage.item({ids[0]})"
    editor.get_by_label("Weight").fill("3")
    editor.get_by_label("Weight").press("Enter")
    desk.until(f"{first}.weight === 3")
    editor.get_by_label("Name").fill("crescent")
    editor.get_by_label("Name").press("Enter")
    desk.until(f"{first}.name === 'crescent'")
    editor.get_by_label("Colour").fill("#aa2244")
    desk.until(f"JSON.stringify(studio.collage.look({first})).includes('#aa2244')")
    desk.settled()
    desk.picture("edited")
    editor.get_by_role("button", name="Replace").click()
    desk.page.locator("dialog.replacing [aria-label=apple]").click()
    desk.until(f"{first}.name === 'apple'")
    assert desk.look("[...studio.choice.ids]") == ids
    for _ in range(4):
        desk.page.locator("#bar [data-do=undo]").click()
    desk.until(f"{first}.name === 'moon' && {first}.weight === 1")
    desk.settled()


def test_a_folder_of_photos_comes_whole(open_desk: Callable[..., Desk], tmp_path: Path) -> None:
    desk = open_desk()
    count = desk.look("studio.collage.items.length")
    for k in range(3):
        picture = Image.effect_noise((90, 60), 60 + k).convert("RGB")
        picture.save(tmp_path / f"photo {k}.jpg")
    desk.page.get_by_label("What files do").select_option("photos")
    with desk.page.expect_file_chooser() as waiting:
        desk.page.get_by_role("button", name="A folder").click()
    waiting.value.set_files(tmp_path)
    desk.until("studio.collage.items.some(item => item.name === 'photo 1')")
    desk.settled()
    desk.picture("photos")
    assert desk.look("studio.collage.items.every(item => item.name.startsWith('photo'))")
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until(f"studio.collage.items.length === {count}")
    desk.settled()


def test_words_are_changed_in_place_in_a_font_of_the_machine(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    desk.page.locator("#tab-words").click()
    desk.until("studio.panels.words.palette.options.length > 3")
    desk.page.locator("#text").fill("hope, 12\njoy, 7\nlove, 5\nGlück, 3")
    desk.page.get_by_label("Colours").select_option("tol-bright")
    desk.page.get_by_text("Fill with words").click()
    desk.until("studio.collage.items.some(item => item.name === 'Glück')")
    desk.settled()
    fills = desk.look("studio.collage.items.map(item => studio.collage.colour(item.id))")
    assert "#4477aa" in fills
    joy = desk.look("studio.collage.items.find(item => item.name === 'joy').id")
    desk.page.locator("#text").fill("hope, 12\njoy, 10\nGlück, 3\npeace, 4")
    desk.page.get_by_text("Change these, keep their places").click()
    desk.until("studio.collage.items.some(item => item.name === 'peace')")
    desk.settled()
    desk.picture("words-changed")
    assert desk.look(f"studio.collage.item({joy}).name") == "joy"
    names = desk.look("studio.collage.items.map(item => item.name)")
    assert sorted(names) == ["Glück", "hope", "joy", "peace"]
    # What the words have now is asked for by its family, also in a page that did not choose it.
    font = desk.page.get_by_label("Font", exact=True)
    family = desk.look("studio.words.font.families.find(one => one.style.fontFamily).value")
    # Letters are the browser's, which finds by them.
    letter = "new KeyboardEvent('keydown', { key: 'd', cancelable: true })"
    assert desk.look(f"studio.words.font.field.dispatchEvent({letter})")
    # By keys: the list opens, and nothing is set until one of it is taken.
    asked = desk.look("studio.connection.count")
    font.focus()
    row = desk.look(f"studio.words.font.families.findIndex(one => one.value === '{family}')")
    for _ in range(row + 2):
        desk.page.keyboard.press("ArrowDown")
    assert desk.look("studio.connection.count") == asked
    desk.page.keyboard.press("Enter")
    desk.until(f"studio.collage.scene.font === '{family}'")
    desk.settled()
    # Families without letters of a text come last, unless none has them.
    assert desk.look(
        "studio.words.font.fill('\u0639 a').then(() => (({ families, lacking }, fonts) => {"
        " const has = (one) => fonts[one].includes('Arabic') && fonts[one].includes('Latin');"
        " return families.every(({ value, parentElement }) => (parentElement === lacking)"
        " === (Object.keys(fonts).some(has) && !has(value))); })"
        "(studio.words.font, studio.panels.choices.fonts))"
    )
    desk.page.reload()
    desk.settled()
    desk.page.locator("#tab-words").click()
    desk.until(f"studio.words.font.field.value === '{family}'")
    assert desk.look("studio.words.font.value") == family
    assert not desk.look(
        "[...studio.words.font.field.options].some(one => /[/]/.test(one.value + one.text))"
    )
    # A font of a file is shown, and asked for by its name: the studio has it from the words.
    desk.look("studio.words.font.show('Own.otf')")
    assert desk.look(
        "[studio.words.font.value, studio.words.font.field.selectedOptions[0].text]"
    ) == ["Own.otf", "Own.otf"]
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until(f"studio.collage.scene.font !== '{family}'")
    desk.settled()
    for _ in range(2):
        desk.page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.items.some(item => item.name === 'moon')")
    desk.settled()


def test_a_word_in_a_font_file_is_the_container(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-room").click()
    font = next((ROOT / "src/packwork/bundled/fonts").glob("*.otf"))
    with desk.page.expect_file_chooser() as waiting:
        desk.page.get_by_label("Font", exact=True).select_option("own")
    waiting.value.set_files(font)
    desk.until("(studio.panels.roomFont.value ?? '').startsWith('file:')")
    desk.page.locator("#word").fill("Ol")
    desk.page.locator("#word").press("Enter")
    desk.until("studio.collage.scene.name === 'Ol'")
    desk.settled()
    desk.picture("word-container")
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.scene.name === 'circle'")
    desk.settled()


def test_words_that_no_font_has_are_listed_on_the_badge(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-words").click()
    desk.page.locator("textarea").fill("hello, 3\n\U0010fffd, 2\nworld, 2")
    desk.page.get_by_text("Fill with words").click()
    desk.until("studio.collage.state.unplaced.length === 1")
    desk.settled()
    desk.page.locator("#badge").click()
    assert "no font installed" in desk.page.locator("#why").inner_text()
    desk.picture("left-out")
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until("!studio.collage.state.unplaced.length")
    desk.settled()


def test_a_folder_with_folders_is_dropped(open_desk: Callable[..., Desk], tmp_path: Path) -> None:
    desk = open_desk()
    count = desk.look("studio.collage.items.length")
    folder = tmp_path / "drawings"
    (folder / "more of them").mkdir(parents=True)
    icons = (ROOT / "src/packwork/bundled/icons").glob("*.svg")
    for name in ("one", "more of them/two"):
        (folder / f"{name}.svg").write_bytes(next(icons).read_bytes())
    data = {"items": [], "files": [str(folder)], "dragOperationsMask": 1}
    session = desk.page.context.new_cdp_session(desk.page)
    x, y = desk.place(desk.look("studio.collage.items[0].id"))
    for kind in ("dragEnter", "dragOver"):
        session.send("Input.dispatchDragEvent", {"type": kind, "x": x, "y": y, "data": data})
    desk.until("!document.getElementById('drop').hidden")
    box = desk.page.locator("#drop [data-drops=items]").bounding_box()
    at = {"x": box["x"] + box["width"] / 2, "y": box["y"] + box["height"] / 2}
    for kind in ("dragOver", "drop"):
        session.send("Input.dispatchDragEvent", {"type": kind, **at, "data": data})
    desk.until(f"studio.collage.items.length === {count + 2}")
    names = desk.look("studio.collage.items.map(item => item.name)")
    assert {"one", "two"} <= set(names)
    desk.settled()
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until(f"studio.collage.items.length === {count}")

"""Files that a page sends: under safe names, with limits."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from importlib import resources
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image, ImageDraw

import packwork as pw
from packwork.errors import ReadError
from packwork.live.document import Document
from packwork.live.face.offers import items_of
from packwork.live.face.opening import Opening
from packwork.scene.item import PhotoArt
from packwork.studio import files as module
from packwork.studio.files import Importer, Uploads, safe_name
from packwork.studio.workspace import Workspace


@pytest.fixture
def uploads() -> Iterator[Uploads]:
    made = Uploads()
    yield made
    made.close()


def test_files_of_one_name_do_not_meet(uploads: Uploads) -> None:
    batch = uploads.new_batch()
    for data in (b"one", b"two"):
        uploads.add(batch, "a/b/cat.svg", data)
    assert sorted(p.name for p in uploads.folder(batch).iterdir()) == ["cat 2.svg", "cat.svg"]


@pytest.mark.parametrize("batch", ["", ".", "..", "0" * 16, "../" * 5, "0" * 15, "zz"])
def test_batches_that_were_not_made_are_refused(uploads: Uploads, batch: str) -> None:
    with pytest.raises(ReadError, match="drop them again"):
        uploads.add(batch, "cat.svg", b"")


def test_limits_are_kept(uploads: Uploads, monkeypatch: pytest.MonkeyPatch) -> None:
    batch = uploads.new_batch()
    monkeypatch.setattr(module, "MOST_BYTES", 4)
    monkeypatch.setattr(module, "MOST_FILES", 2)
    with pytest.raises(ReadError, match="larger than"):
        uploads.add(batch, "cat.svg", b"12345")
    for _ in range(2):
        uploads.add(batch, "cat.svg", b"1234")
    with pytest.raises(ReadError, match="one too many"):
        uploads.add(batch, "cat.svg", b"1")


@given(st.text())
def test_any_name_is_made_one_that_stays_in_its_folder(name: str) -> None:
    safe = safe_name(name)
    assert safe
    assert len(safe.encode()) <= module.LONGEST_NAME
    assert not set(safe) & set("/\\\0:")
    assert safe not in {".", ".."}


def test_the_font_of_words_is_asked_for_by_its_name_once_its_file_is_gone(
    uploads: Uploads, tmp_path: Path
) -> None:
    fonts = resources.files("packwork.bundled").joinpath("fonts")
    bundled = next(one for one in fonts.iterdir() if one.name.endswith((".ttf", ".otf")))
    own = tmp_path / f"Own{Path(bundled.name).suffix}"
    own.write_bytes(bundled.read_bytes())
    layout = pw.words("circle", {"moss": 2, "fern": 1}, font=own, effort="draft", levels="50")
    own.unlink()

    async def scenario() -> str | None:
        desk = Workspace(Opening(document=Document.from_layout(layout)))
        await desk.begin()
        try:
            importer = Importer(desk, uploads)
            while desk.owner is None:
                await asyncio.sleep(0.01)
            with pytest.raises(ReadError, match="neither an installed font nor a file"):
                importer.font("Other.ttf")
            assert importer.font(own.name) == importer.font(own.name)
            return importer.font(own.name)
        finally:
            await asyncio.to_thread(desk.close)

    found = Path(asyncio.run(scenario()) or "")
    assert found.is_relative_to(uploads.root)
    assert found.read_bytes() == bundled.read_bytes()


def test_a_picture_that_fills_its_rectangle_comes_as_a_photograph(tmp_path: Path) -> None:
    Image.effect_noise((90, 60), 80).convert("RGB").save(tmp_path / "pier.png")
    disc = Image.new("RGBA", (60, 60))
    ImageDraw.Draw(disc).ellipse((5, 5, 55, 55), fill="red")
    disc.save(tmp_path / "disc.png")
    found = items_of([str(tmp_path / "pier.png"), str(tmp_path / "disc.png"), "star"]).items
    assert [isinstance(item.art, PhotoArt) for item in found] == [True, False, False]

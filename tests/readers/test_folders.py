"""What a folder holds: every picture is read or named."""

from __future__ import annotations

import gzip

import pytest
from PIL import Image, ImageDraw

from packwork.errors import ReadError
from packwork.readers.container import read_container
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.items import read_items
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photos
from packwork.readers.pictures.decode import PICTURE_ENDINGS

SQUARE = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h6v6h-6z"/></svg>'
KINDS = {
    ".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".jfif": "JPEG", ".webp": "WEBP",
    ".avif": "AVIF", ".gif": "GIF", ".bmp": "BMP", ".tif": "TIFF", ".tiff": "TIFF",
}  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    """Icons, photos and things that are neither."""
    tile = Image.new("RGB", (60, 60), "white")
    ImageDraw.Draw(tile).rectangle([10, 10, 49, 49], fill="teal")
    for ending in PICTURE_ENDINGS:
        tile.save(tmp_path / f"picture{ending.replace('.', '-')}{ending}", KINDS[ending])
    (tmp_path / "drawn.svg").write_bytes(SQUARE)
    (tmp_path / "packed.svgz").write_bytes(gzip.compress(SQUARE))
    return tmp_path


@pytest.fixture
def odd(folder):
    (folder / "beach.HEIC").write_bytes(b"\0")
    (folder / "night.jxl").write_bytes(b"\0")
    (folder / "layers.psd").write_bytes(b"\0")
    (folder / "gone.png").symlink_to(folder / "nowhere.png")
    (folder / "README.md").write_text("icons", encoding="utf-8")
    (folder / ".hidden.heic").write_bytes(b"\0")
    (folder / "inside.jp2").mkdir()
    return folder


def test_every_kind_of_picture_is_an_item(folder, caplog):
    items = read_items(str(folder)).items
    assert len(items) == len(PICTURE_ENDINGS) + 2
    areas = {item.name: item.outline.area for item in items}
    assert areas["drawn"] == areas["packed"] == pytest.approx(36)
    for name, area in areas.items():
        if name.startswith("picture"):
            assert area == pytest.approx(1600, rel=0.05), name
    assert not caplog.messages


@pytest.mark.parametrize("ending", [*PICTURE_ENDINGS, ".svgz"])
def test_every_kind_of_picture_is_a_container(folder, ending):
    (file,) = folder.glob(f"*{ending}")
    assert read_container(str(file), 60.0).outline.area == pytest.approx(1600, rel=0.05)


@pytest.mark.parametrize("pattern", ["", "/*"])
def test_what_is_not_read_is_named_in_one_line(odd, caplog, pattern):
    read = read_items(f"{odd}{pattern}")
    assert len(read.items) == len(PICTURE_ENDINGS) + 2
    (told,) = caplog.messages
    assert "left out beach.HEIC (.heic is not read), gone.png (a link to nothing)" in told
    assert told.endswith("and 1 more; save such files as SVG, PNG or JPEG")
    assert sorted(refusal.file.rpartition("/")[2] for refusal in read.skipped) == [
        "beach.HEIC", "gone.png", "layers.psd", "night.jxl",
    ]  # fmt: skip
    with pytest.raises(ReadError, match=r"beach.HEIC: .heic is not read"):
        read_items(f"{odd}{pattern}", strict=True)


def test_photos_name_what_they_leave_out_too(odd, caplog):
    read = read_photos(PhotoOptions(sources=str(odd)))
    assert len(read.items) == len(PICTURE_ENDINGS)
    (told,) = caplog.messages
    assert "beach.HEIC" in told
    assert "svg" not in told.lower().partition("; save")[0].replace(".svg", "")
    assert len(read.skipped) == 4
    with pytest.raises(ReadError, match=r"photos that end in \.jxl are not read"):
        read_photos(PhotoOptions(sources=str(odd / "night.jxl")))


def test_a_folder_of_such_files_alone_says_so(tmp_path):
    (tmp_path / "beach.heic").write_bytes(b"\0")
    with pytest.raises(ReadError, match=r"its one file cannot be used.*\.heic is not read"):
        read_items(str(tmp_path))


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (gzip.compress(SQUARE)[:-20], "cut short"),
        (gzip.compress(SQUARE)[:-8] + bytes(8), "broken compressed SVG"),
        (gzip.compress(b" " * (MAX_BYTES + 10_000_000)), "20 MB are the most"),
        (gzip.compress(b"<svg"), "XML"),
    ],
    ids=["short", "broken", "bomb", "no SVG"],
)
def test_packed_drawings_go_through_the_gate(tmp_path, data, problem):
    (tmp_path / "a.svgz").write_bytes(data)
    with pytest.raises(ReadError, match=problem):
        read_items(str(tmp_path / "a.svgz"))


@pytest.mark.parametrize("read", [read_items, read_container])
def test_a_folder_that_is_not_there_is_called_so(read):
    with pytest.raises(ReadError, match=r"nowhere/: there is no such folder$"):
        read("nowhere/")

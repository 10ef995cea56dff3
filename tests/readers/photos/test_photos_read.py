"""Photographs: upright, in screen colours, cut to shapes, opened again for the print."""

from __future__ import annotations

import base64
import io
import logging
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from PIL import ExifTags, Image, ImageCms, ImageDraw

from packwork import uses
from packwork.errors import ReadError, RecipeError
from packwork.raster.drawing import drawn_png
from packwork.readers.container import read_container
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photo, read_photos, shape_of
from packwork.readers.pictures.developing import developed, inspected
from packwork.recipe.refusals import validated
from packwork.scene.item import Item, PhotoArt

SIZE = (90, 60)


def halves(size: tuple[int, int] = SIZE) -> Image.Image:
    """Red on the left, blue on the right."""
    image = Image.new("RGB", size, "blue")
    image.paste("red", (0, 0, size[0] // 2, size[1]))
    return image


def saved(
    folder: Path, name: str = "photo.png", image: Image.Image | None = None, **how: Any
) -> str:
    file = folder / name
    (image or halves()).save(file, **how)
    return str(file)


def read(file: str, **options: Any) -> Item:
    asked = PhotoOptions(sources=(file,), **options)
    return read_photo(file, asked, shape=shape_of(asked))


def shown(item: Item, px_per_unit: float = 1.0, margin: float = 2.0) -> np.ndarray[Any, Any]:
    """What is seen of an item, ``[row, col]`` RGBA, at one pixel per unit."""
    assert isinstance(item.art, PhotoArt)
    art = item.art.original.printed(px_per_unit)
    left, top, right, bottom = (round(v) for v in item.outline.bounds)
    width, height = right - left + 2 * margin, bottom - top + 2 * margin
    matrix = " ".join(f"{v}" for v in art.matrix.T.ravel())
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'width="{width}" height="{height}" viewBox="{left - margin} {top - margin} {width} '
        f'{height}"><g transform="matrix({matrix})">{art.markup}</g></svg>'
    )
    return np.asarray(Image.open(io.BytesIO(drawn_png(text))).convert("RGBA"))


def test_a_photo_is_its_rectangle_even_on_a_plain_ground(tmp_path: Path) -> None:
    image = Image.new("RGB", SIZE, "white")
    image.paste("black", (20, 20, 40, 40))
    item = read(saved(tmp_path, image=image))
    assert item.outline.area == SIZE[0] * SIZE[1]
    assert item.name == "photo"


@pytest.mark.parametrize("turn", range(1, 9))
def test_photos_stand_upright_whatever_the_camera_did(tmp_path: Path, turn: int) -> None:
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = turn
    undo = {
        2: "FLIP_LEFT_RIGHT", 3: "ROTATE_180", 4: "FLIP_TOP_BOTTOM", 5: "TRANSPOSE",
        6: "ROTATE_90", 7: "TRANSVERSE", 8: "ROTATE_270",
    }  # fmt: skip
    lying = halves().transpose(Image.Transpose[undo[turn]]) if turn > 1 else halves()
    item = read(saved(tmp_path, "photo.jpg", lying, exif=exif, quality=95))
    left, top, right, bottom = item.outline.bounds
    assert (right - left, bottom - top) == SIZE
    picture = shown(item)
    row = picture.shape[0] // 2
    assert picture[row, 10, 0] > 200 > 50 > picture[row, 10, 2]
    assert picture[row, -10, 2] > 200 > 50 > picture[row, -10, 0]


def test_prints_have_the_pixels_that_are_asked_for_and_no_more_than_there_are(
    tmp_path: Path,
) -> None:
    item = read(saved(tmp_path, "photo.jpg"))
    assert isinstance(item.art, PhotoArt)
    sizes = []
    for px_per_unit in (0.5, 7.0):
        markup = item.art.original.printed(px_per_unit).markup
        data = markup.partition("base64,")[2].partition('"')[0]
        with Image.open(io.BytesIO(base64.b64decode(data))) as image:
            sizes.append(image.size)
    assert sizes == [(45, 30), SIZE]


def test_a_window_is_cut_where_it_says_at_any_size() -> None:
    wide = np.zeros((400, 600, 3), dtype=np.uint8)
    wide[:, :, 0] = np.linspace(0, 255, 600).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(wide).save(file, "JPEG", quality=95)
    part = np.asarray(developed(file.getvalue(), (150.0, 0.0, 450.0, 400.0), (30, 40)))
    assert part.shape == (40, 30, 3)
    expected = 255 / 599 * (150 + 10 * (np.arange(30) + 0.5) - 0.5)
    assert np.abs(part[20, :, 0] - expected).max() < 4


def test_soft_shadows_count_from_the_threshold_asked(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    pixels = np.zeros((90, 120, 4), np.uint8)
    pixels[20:60, 20:60, 3] = 255
    pixels[30:80, 60:100, 3] = 90
    Image.fromarray(pixels).save(tmp_path / "cup.png")
    source = str(tmp_path / "cup.png")
    recipe = uses.photos_recipe("square", [source])
    (tight,) = uses.read(recipe).items
    assert "--alpha-threshold" in caplog.text
    (wide,) = uses.read(recipe.model_copy(update={"alpha_threshold": 0.2})).items
    assert tight.outline.area == pytest.approx(40 * 40, rel=0.02)
    assert wide.outline.area == pytest.approx(40 * 40 + 50 * 40, rel=0.02)


def test_cut_outs_keep_their_outline(tmp_path: Path) -> None:
    image = Image.new("RGBA", (200, 200), (0, 0, 0, 0))
    ImageDraw.Draw(image).ellipse((20, 20, 180, 180), fill="green")
    item = read(saved(tmp_path, image=image))
    assert item.outline.area == pytest.approx(np.pi * 80.5**2, rel=0.02)
    assert shown(item)[3, 3, 3] == 0


def test_a_photo_that_is_clear_all_over_is_refused(tmp_path: Path) -> None:
    image = Image.new("RGBA", (200, 200), (9, 9, 9, 0))
    with pytest.raises(ReadError, match="is clear all over: nothing of it would be seen"):
        read(saved(tmp_path, image=image))


def test_a_shape_cuts_the_middle_out_of_a_photo(tmp_path: Path) -> None:
    item = read(saved(tmp_path), shape="circle")
    assert item.outline.area == pytest.approx(np.pi * 30**2, rel=2e-3)
    picture = shown(item)
    assert picture[3, 3, 3] == 0
    assert picture[32, 20, 0] > 200
    assert picture[32, 44, 2] > 200


def test_the_shape_of_all_photos_is_read_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shapes = Mock(wraps=read_container)
    monkeypatch.setattr("packwork.readers.photos.read_container", shapes)
    photos = tuple(saved(tmp_path, f"{k}.png") for k in range(3))
    found = read_photos(PhotoOptions(sources=photos, shape="circle")).items
    assert [item.outline.area for item in found] == pytest.approx([np.pi * 30**2] * 3, rel=2e-3)
    assert shapes.call_count == 1


def test_rounded_corners_take_off_what_they_should(tmp_path: Path) -> None:
    item = read(saved(tmp_path), shape="rounded:50%")
    assert item.outline.area == pytest.approx(30 * 60 + np.pi * 30**2, rel=3e-3)
    assert read(saved(tmp_path), shape="rounded:0%").outline.area == SIZE[0] * SIZE[1]


def test_a_border_lies_outside_and_hides_nothing(tmp_path: Path) -> None:
    item = read(saved(tmp_path), border="10%", border_color="lime")
    assert item.outline.area == pytest.approx((SIZE[0] + 12) * (SIZE[1] + 12))
    picture = shown(item, margin=0)
    assert picture[3, 50].tolist() == [0, 255, 0, 255]
    assert picture[36, 10, 0] > 200
    assert picture[36, -10, 2] > 200


def test_colours_of_other_profiles_become_those_of_screens(tmp_path: Path) -> None:
    screen = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    # A screen whose red and blue have changed places: tags swap their names.
    other = screen.replace(b"rXYZ", b"????").replace(b"bXYZ", b"rXYZ").replace(b"????", b"bXYZ")
    file = io.BytesIO()
    Image.new("RGB", (40, 40), (200, 90, 30)).save(file, "PNG", icc_profile=other)
    print_ = developed(file.getvalue(), (0.0, 0.0, 40.0, 40.0), (4, 4))
    assert np.abs(np.subtract(print_.getpixel((1, 1)), (30, 90, 200))).max() <= 3


def test_a_profile_that_is_none_is_passed_over() -> None:
    file = io.BytesIO()
    Image.new("RGB", (40, 40), "teal").save(file, "PNG", icc_profile=b"no profile")
    assert developed(file.getvalue(), (0, 0, 40, 40), (4, 4)).getpixel((1, 1)) == (0, 128, 128)


@pytest.mark.parametrize("mode", ["1", "L", "P", "CMYK", "I;16", "LA"])
def test_photos_of_every_kind_are_read(tmp_path: Path, mode: str) -> None:
    kind = "TIFF" if mode == "CMYK" else "PNG"
    file = saved(tmp_path, f"photo.{kind.lower()}", Image.new(mode, SIZE, 1), format=kind)
    data = Path(file).read_bytes()
    assert inspected(data).width == SIZE[0]
    print_ = developed(data, (0, 0, *map(float, SIZE)), (9, 6))
    assert print_.mode == ("RGBA" if mode == "LA" else "RGB")


def broken(folder: Path, kind: str) -> str:
    file = folder / f"{kind}.jpg"
    whole = io.BytesIO()
    halves((400, 300)).save(whole, "JPEG")
    file.write_bytes(
        {
            "truncated": whole.getvalue()[: len(whole.getvalue()) // 2],
            "text": b"dear diary, today I was a picture",
            "empty": b"",
            "no-size": b"GIF89a" + bytes(20),
        }[kind]
    )
    return str(file)


@pytest.mark.parametrize(
    ("kind", "reason"),
    [
        ("truncated", "truncated"),
        ("text", "is not a picture that can be read; give PNG, JPEG or WebP"),
        ("empty", "is not a picture"),
        ("no-size", "is not a picture that can be read"),
    ],
)
def test_bad_photos_are_refused_in_one_line(tmp_path: Path, kind: str, reason: str) -> None:
    file = broken(tmp_path, kind)
    with pytest.raises(ReadError, match=reason) as raised:
        read_photos(PhotoOptions(sources=(file,)))
    assert str(raised.value).startswith(file)
    assert "\n" not in str(raised.value)


def test_a_photo_far_too_large_is_refused_before_it_is_decoded(tmp_path: Path) -> None:
    file = saved(tmp_path, "wide.png", Image.new("1", (30_000, 6_000)))
    with pytest.raises(ReadError, match=r"30000 x 6000 pixels|far more pixels"):
        read_photos(PhotoOptions(sources=(file,)))


def test_raw_and_heic_photos_are_named_as_such() -> None:
    with pytest.raises(ReadError, match=r"end in \.heic are not read; save it as JPEG first"):
        read_photos(PhotoOptions(sources=("sea.heic",)))


def test_folders_leave_out_what_is_broken_and_say_so(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    saved(tmp_path, "b.jpg")
    saved(tmp_path, "a.png")
    broken(tmp_path, "text")
    with caplog.at_level(logging.WARNING):
        found = read_photos(PhotoOptions(sources=(str(tmp_path),)))
    assert [item.name for item in found.items] == ["a", "b"]
    assert "text.jpg" in caplog.text
    with pytest.raises(ReadError, match=r"text\.jpg"):
        read_photos(PhotoOptions(sources=(str(tmp_path),)), strict=True)


def test_of_photos_named_one_by_one_those_that_are_broken_are_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    saved(tmp_path, "a.png")
    broken(tmp_path, "text")
    (tmp_path / "sea.heic").touch()
    files = tuple(str(tmp_path / name) for name in ("sea.heic", "text.jpg", "a.png"))
    found = read_photos(PhotoOptions(sources=files))
    assert [item.name for item in found.items] == ["a"]
    assert [one.file for one in found.skipped] == list(files[:2])
    assert all(f"left out {file}" in caplog.text for file in files[:2])
    for refused in (files[:2], (files[2], str(tmp_path / "gone.jpg"))):
        with pytest.raises(ReadError, match=r"sea\.heic|gone\.jpg"):
            read_photos(PhotoOptions(sources=refused))


def test_a_photo_that_is_gone_when_it_is_printed_is_named(tmp_path: Path) -> None:
    item = read(saved(tmp_path))
    Path(item.source).unlink()
    assert isinstance(item.art, PhotoArt)
    with pytest.raises(ReadError, match="there is no such file"):
        item.art.original.printed(1.0)


@pytest.mark.parametrize(
    ("option", "value", "reason"),
    [
        ("border", "3mm", "use a share of the photo's shorter side"),
        ("border_color", "sea", "is no colour"),
        ("shape", "rounded:60%", "rounded:1% to rounded:50%"),
    ],
)
def test_options_without_a_meaning_are_refused(option: str, value: str, reason: str) -> None:
    with pytest.raises(RecipeError, match=reason) as raised:
        validated(PhotoOptions, {"sources": ("a.jpg",), option: value})
    assert raised.value.key == option

"""Pictures to items and masks to containers."""

from __future__ import annotations

import struct
import tracemalloc
import zlib
from io import BytesIO

import numpy as np
import pytest
import shapely
from PIL import Image, ImageDraw

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.readers.container import read_container
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.pictures.mask import trace_mask
from packwork.readers.pictures.silhouette import item_of_picture, read_picture
from packwork.scene.item import PictureArt


def disc(mode: str, ground, ink, side: int = 200, fine: int = 4) -> Image.Image:
    """A soft-edged disc of 0.8 of the side on a ground."""
    image = Image.new(mode, (side * fine, side * fine), ground)
    ImageDraw.Draw(image).ellipse([side * fine * 0.1] * 2 + [side * fine * 0.9] * 2, fill=ink)
    return image.resize((side, side), Image.Resampling.BOX)


def saved(image: Image.Image, kind: str = "PNG") -> bytes:
    file = BytesIO()
    image.save(file, kind)
    return file.getvalue()


@pytest.mark.parametrize(
    ("image", "kind"),
    [
        (disc("RGBA", (0, 0, 0, 0), (200, 30, 30, 255)), "PNG"),
        (disc("RGBA", (0, 0, 0, 0), (200, 30, 30, 90)), "PNG"),
        (disc("RGB", "white", (200, 30, 30)), "PNG"),
        (disc("RGB", (20, 90, 20), (250, 220, 30)), "PNG"),
        (disc("RGB", "white", (60, 60, 90)), "JPEG"),
        (disc("RGB", "white", (60, 60, 90)), "WEBP"),
        (disc("L", 255, 40), "PNG"),
        (disc("RGB", "white", "black").quantize(8), "GIF"),
    ],
)
def test_silhouette_of_a_disc(image, kind):
    item = item_of_picture(saved(image, kind), "disc", "disc")
    assert item.outline.area == pytest.approx(np.pi * 80**2, rel=0.01)
    assert np.hypot(*item.outline.points.T) == pytest.approx(80, abs=1.0)


def test_hard_edged_alpha():
    mask = np.zeros((60, 80, 4), np.uint8)
    mask[10:50, 20:60] = 255
    item = item_of_picture(saved(Image.fromarray(mask)), "square", "square")
    assert item.outline.bounds == pytest.approx((-20, -20, 20, 20), abs=0.6)


def test_a_photo_is_its_rectangle():
    noise = np.random.default_rng(0).integers(0, 255, (40, 60, 3), dtype=np.uint8)
    item = item_of_picture(saved(Image.fromarray(noise)), "photo", "photo")
    assert item.outline.bounds == (-30, -20, 30, 20)


def test_enclosed_background_stays_inside():
    image = disc("RGB", "white", "black")
    ImageDraw.Draw(image).ellipse([80, 80, 120, 120], fill="white")
    item = item_of_picture(saved(image), "ring", "ring", "keep")
    assert item.ink.area == pytest.approx(np.pi * 80**2, rel=0.01)


def test_transparent_holes_are_kept_where_asked():
    image = disc("RGBA", (0, 0, 0, 0), (9, 9, 9, 255))
    ImageDraw.Draw(image).ellipse([80, 80, 120, 120], fill=(0, 0, 0, 0))
    filled = item_of_picture(saved(image), "ring", "ring")
    kept = item_of_picture(saved(image), "ring", "ring", "keep")
    assert filled.outline.area == pytest.approx(np.pi * 80**2, rel=0.01)
    assert kept.outline.area == pytest.approx(np.pi * (80**2 - 20**2), rel=0.01)


@pytest.mark.parametrize("side", [200, 2100])
def test_art_lies_on_the_outline(side):
    item = item_of_picture(saved(disc("RGB", "white", "red", side, 1)), "disc", "disc")
    assert isinstance(item.art, PictureArt)
    pixels = np.asarray(Image.open(BytesIO(item.art.png)))
    assert pixels.shape == (item.art.height, item.art.width, 4)
    assert max(pixels.shape) <= 2048
    corners = affine.apply(
        item.art.matrix, np.array([[0.0, 0.0], [item.art.width, item.art.height]])
    )
    assert corners.ravel() == pytest.approx(item.outline.bounds, abs=side / 100)
    assert pixels[0, 0, 3] == 0
    assert pixels[item.art.height // 2, item.art.width // 2].tolist() == [255, 0, 0, 255]


def test_upright_by_its_camera():
    image = Image.new("RGB", (40, 20), "red")
    exif = Image.Exif()
    exif[0x0112] = 6
    file = BytesIO()
    image.putpixel((3, 3), (0, 255, 0))
    image.putpixel((0, 0), (0, 0, 255))
    noise = np.random.default_rng(1).integers(0, 255, (20, 40, 3), dtype=np.uint8)
    Image.fromarray(noise).save(file, "JPEG", exif=exif)
    item = item_of_picture(file.getvalue(), "photo", "photo")
    assert item.outline.bounds == (-10, -20, 10, 20)


def png_header(width: int, height: int) -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + check

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"\0" * 100)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "not a picture"),
        (b"just text", "not a picture"),
        (saved(disc("RGB", "white", "red"))[:200], "broken picture"),
        (png_header(60_000, 60_000), "million are the most"),
        (png_header(10_000, 10_000), "million are the most"),
        (png_header(400, 400), "broken picture"),
        (saved(Image.new("RGBA", (9, 9))), "fully transparent"),
        (saved(Image.new("RGB", (9, 9), "red")), "one colour"),
    ],
)
def test_unusable_pictures(data, problem):
    with pytest.raises(ReadError, match=problem):
        item_of_picture(data, "a", "a.png")


@pytest.mark.parametrize(
    ("kind", "top"), [(np.uint16, 65_535), (np.float32, 1), (np.int32, 65_535)]
)
def test_deep_grey_is_brought_to_eight_bits(kind, top):
    grey = np.zeros((300, 200), kind)
    grey[70:200, 50:150] = top
    grey[200:230] = top // 2 if top > 1 else 0.5
    pixels = decode_picture(saved(Image.fromarray(grey), "TIFF"), 300).pixels
    assert pixels[[0, 100, 199, 200], [0, 60, 149, 0], 0].tolist() == [0, 255, 255, 127]
    small = decode_picture(saved(Image.fromarray(grey), "TIFF"), 30).pixels
    assert small.shape == (30, 20, 4)
    assert small[10, 10].tolist() == [255] * 4


def test_deep_grey_takes_no_more_than_its_own_size():
    data = saved(Image.fromarray(np.zeros((2_000, 2_000), np.float32)), "TIFF")
    tracemalloc.start()
    try:
        decode_picture(data, 200)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 2 * len(data)


def test_missing_picture():
    with pytest.raises(ReadError, match="no such file"):
        read_picture("nowhere.png")


@pytest.fixture
def mask_file(tmp_path):
    def save(image: Image.Image, name: str = "mask.png") -> str:
        image.save(tmp_path / name)
        return str(tmp_path / name)

    return save


def test_dark_is_inside(mask_file):
    mask = trace_mask(mask_file(disc("L", 255, 0)))
    assert (mask.width, mask.height) == (200, 200)
    assert mask.region.area == pytest.approx(np.pi * 80**2, rel=0.003)
    assert mask.region.bounds == pytest.approx((20, 20, 180, 180), abs=0.3)


def test_alpha_decides_where_it_is_not_uniform(mask_file):
    image = disc("RGBA", (0, 0, 0, 0), (255, 255, 255, 255))
    assert trace_mask(mask_file(image)).region.area == pytest.approx(np.pi * 80**2, rel=0.003)


def test_uniform_alpha_does_not_decide(mask_file):
    image = disc("RGBA", (255, 255, 255, 100), (0, 0, 0, 100))
    assert trace_mask(mask_file(image)).region.area == pytest.approx(np.pi * 80**2, rel=0.003)


def test_all_dark_is_the_whole_canvas(mask_file):
    container = read_container(mask_file(Image.new("L", (40, 20), 30)), canvas=600)
    assert container.outline.bounds == (0, 0, 600, 300)
    assert container.outline.area == 600 * 300


def test_square_keeps_its_corners(mask_file):
    image = Image.new("1", (100, 100), 1)
    ImageDraw.Draw(image).rectangle([20, 30, 79, 69], fill=0)
    region = trace_mask(mask_file(image)).region
    assert region.bounds == pytest.approx((20, 30, 80, 70))
    assert region.area == pytest.approx(60 * 40)


def test_hard_stairs_become_lines(mask_file):
    image = Image.new("1", (300, 300), 1)
    ImageDraw.Draw(image).polygon([(10, 20), (290, 60), (150, 280)], fill=0)
    region = trace_mask(mask_file(image)).region
    true = shapely.Polygon([(10.5, 20.5), (290.5, 60.5), (150.5, 280.5)])
    assert len(region.exterior.coords) < 12
    assert region.symmetric_difference(true).area < 0.5 * true.length


def test_hard_disc(mask_file):
    rows, columns = np.indices((200, 200)) + 0.5
    inside = np.hypot(rows - 100, columns - 100) < 80
    region = trace_mask(mask_file(Image.fromarray(np.uint8(~inside) * 255))).region
    assert region.area == pytest.approx(np.pi * 80**2, rel=0.005)
    assert np.hypot(*(np.array(region.exterior.coords) - 100).T) == pytest.approx(80, abs=1)


def test_masks_keep_holes_and_parts(mask_file):
    image = disc("L", 255, 0)
    ImageDraw.Draw(image).ellipse([80, 80, 120, 120], fill=255)
    ImageDraw.Draw(image).rectangle([0, 0, 15, 15], fill=0)
    container = read_container(mask_file(image), canvas=200)
    assert len(container.outline.rings) == 3


@pytest.mark.parametrize(
    ("image", "problem"),
    [
        (Image.new("L", (90, 90), 255), "all light"),
        (Image.new("L", (90, 90), 180), "all light"),
        (Image.new("L", (3, 1), 0), "3 x 1 pixels"),
        (Image.new("L", (100, 7), 0), "100 x 7 pixels"),
        (
            Image.fromarray(np.pad(np.zeros((1, 3), np.uint8), 30, constant_values=255)),
            "few pixels",
        ),
    ],
)
def test_unusable_masks(image, problem, mask_file):
    with pytest.raises(ReadError, match=problem):
        read_container(mask_file(image))


def test_noise_is_no_mask(mask_file):
    noise = np.random.default_rng(0).integers(0, 2, (600, 600), dtype=np.uint8) * 255
    with pytest.raises(ReadError, match="noise"):
        read_container(mask_file(Image.fromarray(noise)))

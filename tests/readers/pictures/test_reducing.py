"""Pictures made smaller in bands: what Pillow makes of them whole, and never much at a time."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from PIL import ExifTags, Image, ImageOps

from packwork.readers.pictures import decode
from packwork.readers.pictures.decode import averageable, decode_picture
from packwork.readers.pictures.developing import developed


def noise(mode: str, size: tuple[int, int]) -> Image.Image:
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 256, (size[1], size[0], 4), dtype=np.uint8)
    return Image.fromarray(pixels).convert(mode)


@pytest.mark.parametrize("mode", ["1", "L", "P", "RGB", "RGBA", "LA", "CMYK"])
@pytest.mark.parametrize("size", [(7, 5), (40, 30), (39, 1), (1, 61)])
def test_bands_make_what_the_whole_makes(monkeypatch, mode, size):
    image = noise(mode, (80, 61))
    monkeypatch.setattr(decode, "BAND_PIXELS", 700)
    found = decode.shrunk(image, size, averageable)
    whole = averageable(image).resize(size, Image.Resampling.BOX)
    assert found.mode == whole.mode
    away = np.abs(np.asarray(found, float) - np.asarray(whole, float))
    # Where the edge of a pixel is the middle of another, rounding decides who counts it.
    assert np.count_nonzero(away > 1) <= 0.1 * away.size


def test_no_band_is_larger_than_allowed(monkeypatch):
    monkeypatch.setattr(decode, "BAND_PIXELS", 5_000)
    seen: list[int] = []

    def watched(band: Image.Image) -> Image.Image:
        seen.append(band.width * band.height)
        return band

    decode.shrunk(noise("L", (100, 900)), (10, 90), watched)
    assert max(seen) <= 6_000
    assert sum(seen) < 1.3 * 90_000


@pytest.mark.parametrize("lies", range(1, 9))
def test_turned_pictures_are_upright(lies):
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = lies
    file = BytesIO()
    image = noise("RGB", (48, 32)).resize((96, 64), Image.Resampling.BICUBIC)
    image.save(file, "PNG", exif=exif)
    with Image.open(BytesIO(file.getvalue())) as again:
        expected = ImageOps.exif_transpose(again)
    whole = decode_picture(file.getvalue(), 500)
    assert (whole.pixels[:, :, :3] == np.asarray(expected)).all()
    small = decode_picture(file.getvalue(), 48)
    halved = expected.reduce(2)
    assert np.abs(small.pixels[:, :, :3].astype(int) - np.asarray(halved)).max() <= 2
    # The left third of the upright picture, however it lies in the file.
    width, height = expected.size
    part = developed(file.getvalue(), (0, 0, width // 4, height), (width // 4, height))
    assert (np.asarray(part) == np.asarray(expected)[:, : width // 4]).all()


def test_large_pictures_wait_for_each_other(monkeypatch):
    monkeypatch.setattr(decode, "LARGE_PIXELS", 100)
    file = BytesIO()
    noise("L", (20, 20)).save(file, "PNG")
    with decode.opened(file.getvalue()) as image:
        image.load()
        assert decode._ONE_AT_A_TIME._is_owned()  # type: ignore[attr-defined]
    assert not decode._ONE_AT_A_TIME._is_owned()  # type: ignore[attr-defined]


def test_a_jpeg_is_decoded_no_finer_than_needed(monkeypatch):
    sizes: list[tuple[int, int]] = []
    plain = decode.shrunk

    def watched(image, size, convert):
        sizes.append(image.size)
        return plain(image, size, convert)

    monkeypatch.setattr(decode, "shrunk", watched)
    file = BytesIO()
    noise("RGB", (1600, 800)).save(file, "JPEG")
    assert decode_picture(file.getvalue(), 200).pixels.shape[:2] == (100, 200)
    assert sizes == [(200, 100)]

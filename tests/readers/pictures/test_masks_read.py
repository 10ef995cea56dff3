"""What of a picture is inside: transparency or darkness, and what is told of odd masks."""

from __future__ import annotations

import re
from io import BytesIO

import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFilter

from packwork.errors import ReadError
from packwork.readers.container import read_container
from packwork.readers.pictures.decode import MAX_SIDE_PX
from packwork.readers.pictures.mask import trace_mask
from packwork.readers.pictures.silhouette import read_picture

SIDE = 120
DISC = np.pi * 48**2


def disc(mode: str = "L", ground="white", ink="black") -> Image.Image:
    image = Image.new(mode, (4 * SIDE, 4 * SIDE), ground)
    ImageDraw.Draw(image).ellipse([48, 48, 432, 432], fill=ink)
    return image.resize((SIDE, SIDE), Image.Resampling.BOX)


def with_opacity(alpha: np.ndarray) -> Image.Image:
    image = disc("RGBA")
    image.putalpha(Image.fromarray(alpha))
    return image


def rounded_corners() -> Image.Image:
    """A dark disc on white, three translucent pixels in each corner."""
    alpha = np.full((SIDE, SIDE), 255, np.uint8)
    for row, column in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        alpha[row, column] = 110
    alpha[[0, 0, -1, -1, 1, 1, -2, -2], [1, -2, 1, -2, 0, -1, 0, -1]] = 217
    return with_opacity(alpha)


def dithered_opacity() -> Image.Image:
    noise = np.random.default_rng(0).integers(225, 256, (SIDE, SIDE))
    return with_opacity(noise.astype(np.uint8))


def deep() -> Image.Image:
    return Image.fromarray(np.asarray(disc(), dtype=np.uint16) * 257)


def palette_with_a_clear_entry() -> Image.Image:
    """The paper is opaque; a few pixels have the clear entry of the palette."""
    image = disc().quantize(8)
    pixels = np.asarray(image).copy()
    pixels[:2, :2] = 9
    result = Image.fromarray(pixels, "P")
    result.putpalette(image.getpalette() or [])
    result.info["transparency"] = 9
    return result


@pytest.fixture
def saved(tmp_path):
    def save(image: Image.Image, name: str = "mask.png", **how) -> str:
        image.save(tmp_path / name, **how)
        return str(tmp_path / name)

    return save


MASKS = {
    "grey": disc(),
    "corners": rounded_corners(),
    "dithered": dithered_opacity(),
    "even opacity": with_opacity(np.full((SIDE, SIDE), 90, np.uint8)),
    "16 bits": deep(),
    "1 bit": disc().convert("1"),
    "palette": palette_with_a_clear_entry(),
    "clear ground": disc("RGBA", (255, 255, 255, 0), "black"),
    "faint": disc("RGBA", (0, 0, 0, 0), (255, 255, 255, 90)),
    "light on clear": disc("RGBA", (0, 0, 0, 0), "white"),
}


@pytest.mark.parametrize("name", MASKS)
def test_a_disc_is_a_disc_however_it_is_stored(saved, caplog, name):
    mask = trace_mask(saved(MASKS[name]))
    assert mask.region.area == pytest.approx(DISC, rel=0.02)
    assert not caplog.messages


@pytest.mark.parametrize("name", [n for n in MASKS if n != "even opacity"])
def test_an_item_of_the_same_picture_is_the_disc_too(saved, name):
    assert read_picture(saved(MASKS[name])).item.outline.area == pytest.approx(DISC, rel=0.02)


def test_an_evenly_translucent_item_stays_translucent(saved):
    item = read_picture(saved(MASKS["even opacity"])).item
    assert item.outline.area == pytest.approx(DISC, rel=0.02)
    with Image.open(BytesIO(item.art.png)) as drawn:
        assert drawn.getextrema()[3] == (0, 90)


def test_noise_of_a_poor_jpeg_is_no_mark(saved, caplog):
    mask = trace_mask(saved(disc(ground=250), "mask.jpg", quality=15))
    assert mask.region.area == pytest.approx(DISC, rel=0.02)
    assert not caplog.messages


def test_the_corners_of_a_card_are_its_outline(saved):
    card = Image.new("RGBA", (250, 350), (255, 255, 255, 0))
    draw = ImageDraw.Draw(card)
    draw.rounded_rectangle([0, 0, 249, 349], 15, fill="white")
    draw.ellipse([75, 125, 175, 225], fill="red")
    item = read_picture(saved(card)).item
    assert item.outline.area == pytest.approx(250 * 350 - (4 - np.pi) * 15**2, rel=0.01)


def test_a_small_window_in_a_dark_plate_stays_open(saved):
    plate = np.zeros((100, 100, 4), np.uint8)
    plate[:, :, 3] = 255
    plate[40:48, 40:48, 3] = 0
    assert trace_mask(saved(Image.fromarray(plate))).region.area == pytest.approx(10_000 - 64)


@pytest.mark.parametrize(
    ("image", "told"),
    [
        (Image.new("L", (40, 30)), r"fills 100.0% of its page.*paint what is to be filled black"),
        (
            with_opacity(np.where(np.arange(SIDE) < 2, 0, 255).astype(np.uint8) + np.zeros(
                (SIDE, 1), np.uint8)),
            r"fills 98.3% of its page, for its transparency",
        ),
        (disc(ground="black", ink="white"), "dark all along its edge.*invert"),
    ],
)  # fmt: skip
def test_a_mask_that_was_hardly_meant_so_is_told(saved, caplog, image, told):
    file = saved(image)
    trace_mask(file)
    assert len(caplog.messages) == 1
    assert caplog.messages[0].startswith(file)
    assert caplog.text.count("\n") == 1
    assert re.search(told, caplog.messages[0])


def photograph() -> Image.Image:
    """Light and shade of several sizes, as of anything that is photographed."""
    rng = np.random.default_rng(3)
    grey = np.zeros((300, 400))
    for cells, weight in ((4, 90), (16, 50), (80, 40)):
        coarse = Image.fromarray(rng.uniform(-1, 1, (cells, cells)).astype(np.float32))
        grey += weight * np.asarray(coarse.resize((400, 300), Image.Resampling.BICUBIC))
    return Image.fromarray(np.clip(128 + grey, 0, 255).astype(np.uint8))


def test_a_photograph_is_told(saved, caplog):
    read_container(saved(photograph(), "beach.jpg"))
    assert len(caplog.messages) == 1
    assert "looks like a photograph" in caplog.text
    assert "around:IMAGE" in caplog.text


def shaded() -> dict[str, Image.Image]:
    greys = Image.new("L", (400, 300), 255)
    draw = ImageDraw.Draw(greys)
    for number in range(12):
        draw.rectangle([33 * number, 30, 33 * number + 28, 270], fill=20 + 18 * number)
    return {
        "soft": disc().filter(ImageFilter.GaussianBlur(15)),
        "greys": greys,
        "gradient": Image.linear_gradient("L"),
    }


@pytest.mark.parametrize("name", ["soft", "greys", "gradient"])
@pytest.mark.parametrize("ending", ["png", "jpg"])
def test_soft_and_grey_masks_are_no_photographs(saved, caplog, name, ending):
    trace_mask(
        saved(shaded()[name], f"mask.{ending}", **({"quality": 40} if ending == "jpg" else {}))
    )
    assert "photograph" not in caplog.text


def test_absurdly_long_pictures_are_refused_before_they_are_decoded(saved):
    with pytest.raises(ReadError, match=r"has 1 x 100001 pixels; 100,000 on a side are the most"):
        trace_mask(saved(Image.new("1", (1, MAX_SIDE_PX + 1))))

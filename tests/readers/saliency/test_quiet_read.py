"""``around:IMAGE``: the quiet part of a picture as a container, the picture behind it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image, ImageDraw

from packwork.errors import ReadError
from packwork.readers.container import read_container
from packwork.readers.saliency import QuietOptions
from packwork.scene.container import Container

BUSY = (10, 60, 90, 140)


@pytest.fixture
def scene(tmp_path: Path) -> str:
    """A grey sky with something busy at the lower left."""
    rng = np.random.default_rng(0)
    pixels = np.clip(rng.normal(150, 2, (150, 240, 3)), 0, 255).astype(np.uint8)
    image = Image.fromarray(pixels)
    draw = ImageDraw.Draw(image)
    for _ in range(40):
        x, y = rng.integers(BUSY[0], BUSY[2] - 15), rng.integers(BUSY[1], BUSY[3] - 15)
        colour = tuple(int(v) for v in rng.integers(0, 256, 3))
        draw.rectangle((int(x), int(y), int(x) + 15, int(y) + 15), fill=colour)
    file = tmp_path / "scene.png"
    image.save(file)
    return f"around:{file}"


def read(source: str, share: float = 0.4, *clear: str, canvas: str | None = "240") -> Container:
    return read_container(source, canvas, quiet=QuietOptions(share, clear))


def test_what_is_busy_is_left_free(scene: str) -> None:
    container = read(scene)
    assert (container.width, container.height) == (240.0, 150.0)
    busy = shapely.box(*BUSY)
    assert shapely.intersection(container.outline.region, busy).area < 0.02 * busy.area


@pytest.mark.parametrize("share", [0.2, 0.4, 0.6])
def test_about_the_share_asked_for_is_filled(scene: str, share: float) -> None:
    container = read(scene, share)
    assert container.outline.area / (240 * 150) == pytest.approx(share, abs=0.1)


def test_a_box_is_kept_clear(scene: str) -> None:
    container = read(scene, 0.6, "50%,0%,50%,40%")
    box = shapely.box(120, 0, 240, 60)
    assert shapely.intersection(container.outline.region, box).area == pytest.approx(0, abs=1e-6)
    assert container.outline.area < read(scene, 0.6).outline.area


def test_a_mask_is_kept_clear(scene: str, tmp_path: Path) -> None:
    mask = Image.new("L", (24, 15), "white")
    mask.paste("black", (12, 0, 24, 15))
    mask.save(tmp_path / "mask.png")
    container = read(scene, 0.6, str(tmp_path / "mask.png"))
    assert container.outline.bounds[2] <= 120.5


def test_the_picture_lies_behind_on_any_sheet(scene: str) -> None:
    container = read(scene, canvas="300x300mm")
    behind = container.backdrop
    assert behind is not None
    corners = np.array([[0, 0], [240, 150]]) @ behind.matrix[:, :2].T + behind.matrix[:, 2]
    np.testing.assert_allclose(corners, [[0, 56.25], [300, 243.75]])


def test_a_blank_picture_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "blank.png"
    Image.new("RGB", (80, 60), "ivory").save(file)
    with pytest.raises(ReadError, match="is of one colour all over") as raised:
        read(f"around:{file}")
    assert str(raised.value).startswith(str(file))


@pytest.mark.parametrize(
    ("clear", "reason"),
    [
        ("0%,0%,100%,100%", "no quiet part"),
        ("1,2,3,wide", "is no box"),
        ("none.png", "no such file"),
    ],
)
def test_what_cannot_be_kept_clear_is_said(scene: str, clear: str, reason: str) -> None:
    with pytest.raises(ReadError, match=reason):
        read(scene, 0.4, clear)


def test_a_picture_of_a_few_pixels_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "tiny.png"
    Image.new("RGB", (9, 9)).save(file)
    with pytest.raises(ReadError, match="has only 9 x 9 pixels"):
        read(f"around:{file}")


def test_a_picture_that_is_not_there_is_named() -> None:
    with pytest.raises(ReadError, match=r"none\.jpg: there is no such file"):
        read("around:none.jpg")

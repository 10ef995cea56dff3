"""Small layouts and the comparison with goldens, for every writer's tests."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses

GOLDENS = Path(__file__).parent / "goldens"
TOLERANCE = 2

LayoutMaker = Callable[..., Layout]


@pytest.fixture
def ring_item() -> Item:
    """A square with a square hole that shows."""
    region = shapely.box(-10, -10, 10, 10) - shapely.box(-4, -4, 4, 4)
    ink = Outline.from_region(region)
    return Item("ring", "ring.svg", ink, ink, FlatArt("teal"))


@pytest.fixture
def star_item() -> Item:
    """A five-pointed star with colours of its own and a gradient."""
    turns = np.arange(10) * np.pi / 5
    radii = np.where(np.arange(10) % 2, 4.0, 10.0)
    outline = Outline.from_rings([np.column_stack([radii * np.cos(turns), radii * np.sin(turns)])])
    points = " ".join(f"{x:.3f},{y:.3f}" for x, y in outline.points * 2 + 20)
    markup = (
        '<linearGradient id="star-a"><stop offset="0" stop-color="#d62728"/>'
        '<stop offset="1" stop-color="#ffbf00"/></linearGradient>'
        f'<polygon fill="url(#star-a)" points="{points}"/>'
    )
    matrix = np.array([[0.5, 0.0, -10.0], [0.0, 0.5, -10.0]])
    return Item("star", "star.svg", outline, outline, VectorArt(markup, matrix))


@pytest.fixture
def photo_item() -> Item:
    """Four pixels, one of them clear."""
    pixels = np.array(
        [[[200, 0, 0, 255], [0, 160, 0, 255]], [[0, 0, 220, 255], [0, 0, 0, 0]]], np.uint8
    )
    target = io.BytesIO()
    Image.fromarray(pixels).save(target, format="PNG")
    outline = Outline.from_region(shapely.box(-8, -8, 8, 8))
    matrix = np.array([[8.0, 0.0, -8.0], [0.0, 8.0, -8.0]])
    art = PictureArt(target.getvalue(), 2, 2, matrix)
    return Item("photo", "photo.png", outline, outline, art)


@pytest.fixture
def make_layout() -> LayoutMaker:
    """Layouts of given items on an 80 x 60 canvas; copies stand in a row if not told."""

    def make(
        items: Sequence[Item],
        x: Sequence[float] | None = None,
        y: Sequence[float] | None = None,
        angle: Sequence[float] | None = None,
        scale: Sequence[float] | None = None,
        stretch: Sequence[float] | None = None,
        container: Container | None = None,
        **manifest: object,
    ) -> Layout:
        n = len(items)
        poses = Poses(
            np.asarray(x if x is not None else 10.0 + 20.0 * np.arange(n), dtype=np.float64),
            np.asarray(y if y is not None else np.full(n, 30.0), dtype=np.float64),
            np.asarray(angle if angle is not None else np.zeros(n), dtype=np.float64),
            np.asarray(scale if scale is not None else np.ones(n), dtype=np.float64),
            np.asarray(stretch if stretch is not None else np.ones(n), dtype=np.float64),
        )
        room = Outline.from_region(shapely.box(2, 2, 78, 58))
        return Layout(
            container or Container("room", "room.svg", room, 80.0, 60.0),
            tuple(items),
            poses,
            np.ones(n),
            manifest,
        )

    return make


@pytest.fixture
def three(make_layout: LayoutMaker, ring_item: Item, star_item: Item, photo_item: Item) -> Layout:
    """One item of each kind of art, turned and scaled."""
    return make_layout(
        [ring_item, star_item, photo_item],
        x=[15.0, 40.0, 62.5],
        y=[20.0, 35.0, 25.25],
        angle=[0.3, 0.0, -np.pi / 4],
        scale=[0.9, 1.5, 1.0],
        seed=7,
    )


@pytest.fixture
def crowd(make_layout: LayoutMaker, ring_item: Item) -> Layout:
    """1,000 copies of 20 icons of 300 points on a canvas of 1,000."""
    rng = np.random.default_rng(0)
    turns = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    icons = []
    for k in range(20):
        radii = 50 * (1 + 0.2 * np.sin(5 * turns + rng.uniform(0, 6)))
        ink = Outline.from_rings([np.column_stack([radii * np.cos(turns), radii * np.sin(turns)])])
        icons.append(replace(ring_item, name=f"icon {k}", outline=ink, ink=ink))
    room = Outline.from_region(shapely.box(0, 0, 1000, 1000))
    return make_layout(
        [icons[k % 20] for k in range(1000)],
        x=rng.uniform(0, 1000, 1000),
        y=rng.uniform(0, 1000, 1000),
        angle=rng.uniform(-9, 9, 1000),
        scale=rng.uniform(0.1, 0.4, 1000),
        container=Container("room", "room.svg", room, 1000.0, 1000.0),
    )


@pytest.fixture
def read_picture() -> Callable[[bytes], np.ndarray]:
    """PNG bytes to numbers ``[row, col, channel]``, RGBA."""

    def read(png: bytes) -> np.ndarray:
        with Image.open(io.BytesIO(png)) as picture:
            return np.asarray(picture.convert("RGBA"), dtype=np.int16)

    return read


@pytest.fixture
def assert_same_picture(
    tmp_path: Path, read_picture: Callable[[bytes], np.ndarray]
) -> Callable[[bytes, str], None]:
    """Compare with a golden; a failure leaves got, expected and difference."""

    def compare(png: bytes, name: str) -> None:
        golden = (GOLDENS / name).read_bytes()
        got, expected = read_picture(png), read_picture(golden)
        assert got.shape == expected.shape
        difference = np.abs(got - expected)
        if difference.max() <= TOLERANCE:
            return
        (tmp_path / "got.png").write_bytes(png)
        (tmp_path / "expected.png").write_bytes(golden)
        Image.fromarray(difference[..., :3].astype(np.uint8)).save(tmp_path / "difference.png")
        pytest.fail(f"{name} differs by {difference.max()}/255; see {tmp_path}")

    return compare


@pytest.fixture
def golden_text() -> Callable[[str], str]:
    """Text of a golden by name."""
    return lambda name: (GOLDENS / name).read_text(encoding="utf-8")

"""Prints: photos as fine as the paper needs, each developed once; sizes told in the file."""

from __future__ import annotations

import io
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from PIL import Image

from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.scene.track import Track
from packwork.writers.film.animated_svg import animated_svg_bytes
from packwork.writers.film.film import Film
from packwork.writers.film.options import FilmOptions
from packwork.writers.pictures import SPARE, with_fine_photos, with_photos_for_paper
from packwork.writers.registry import encoded, write_options
from packwork.writers.svg import svg_text

TILE = Outline.from_rings([np.array([[-10.0, -10], [10, -10], [10, 10], [-10, 10]])])
ART = VectorArt('<rect width="20" height="20" fill="red"/>', np.array([[1.0, 0, -10], [0, 1, -10]]))


@dataclass
class Original:
    """Notes how fine it was asked to be."""

    asked: list[float] = field(default_factory=list)

    def printed(self, px_per_unit: float) -> VectorArt:
        self.asked.append(px_per_unit)
        return ART


def two_copies(unit: str = "in") -> tuple[Layout, Original]:
    original = Original()
    item = Item("photo", "photo.jpg", TILE, TILE, PhotoArt(ART, original))
    other = replace(item, name="again")
    wall = Outline.from_rings([np.array([[0.0, 0], [8, 0], [8, 4], [0, 4]])])
    container = Container("wall", "wall", wall, 8.0, 4.0, unit)  # type: ignore[arg-type]
    poses = Poses(np.array([2.0, 6.0]), np.full(2, 2.0), np.zeros(2), np.array([0.1, 0.05]))
    return Layout(container, (item, other), poses, np.ones(2)), original


def test_a_photo_is_developed_once_for_its_largest_copy() -> None:
    layout, original = two_copies()
    again = with_fine_photos(layout, 300.0)
    assert original.asked == [pytest.approx(30.0)]
    assert all(item.art is ART for item in again.items)
    assert [item.name for item in again.items] == ["photo", "again"]


def test_paper_counts_in_inches() -> None:
    layout, original = two_copies("mm")
    with_photos_for_paper(layout, 254.0)
    assert original.asked == [pytest.approx(1.0)]


@pytest.mark.parametrize(("ending", "factor"), [("svg", 1.0), ("jpg", SPARE), ("png", SPARE)])
def test_every_format_gets_photos_of_the_resolution_asked_for(ending: str, factor: float) -> None:
    layout, original = two_copies()
    encoded(layout, f"out.{ending}", write_options(dpi=50))
    assert original.asked == [pytest.approx(5.0 * factor)]


@pytest.mark.parametrize("ending", ["jpg", "png"])
def test_pictures_know_their_size_on_paper(ending: str) -> None:
    layout, _ = two_copies()
    with Image.open(io.BytesIO(encoded(layout, f"out.{ending}", write_options(dpi=50)))) as image:
        image.load()
        assert image.size == (400, 200)
        assert image.info["dpi"] == pytest.approx((50, 50), rel=1e-3)
        pixel = image.convert("RGB").getpixel((100, 100))
    assert np.abs(np.subtract(pixel, (255, 0, 0))).max() < 4


def test_pictures_of_a_canvas_in_pixels_have_no_size_on_paper() -> None:
    layout, _ = two_copies("px")
    with Image.open(io.BytesIO(encoded(layout, "out.png", write_options(pixels=80)))) as image:
        assert "dpi" not in image.info


def test_a_jpeg_is_white_where_nothing_is_drawn() -> None:
    layout, _ = two_copies()
    data = encoded(layout, "out.jpeg", write_options(pixels=80, background="none"))
    with Image.open(io.BytesIO(data)) as image:
        assert image.mode == "RGB"
        assert image.getpixel((79, 0)) == (255, 255, 255)


@pytest.mark.parametrize("dpi", [0.0, 1e6, float("nan")])
def test_resolutions_without_a_meaning_are_refused(dpi: float) -> None:
    with pytest.raises(RecipeError, match="dpi"):
        write_options(dpi=dpi)


def test_a_resolution_that_makes_too_large_a_picture_says_which_would_do() -> None:
    layout, _ = two_copies()
    big = replace(layout, container=replace(layout.container, width=80.0))
    with pytest.raises(RecipeError, match="20,000 are the most; use 250 or less"):
        encoded(big, "out.png", write_options(dpi=300))


def test_films_show_no_halos_that_stay_behind() -> None:
    layout, _ = two_copies()
    haloed = replace(layout, items=tuple(replace(item, halo="white") for item in layout.items))
    assert 'id="halos"' in svg_text(haloed)
    poses = haloed.poses
    numbers = np.column_stack([poses.x, poses.y, poses.angle, poses.scale, poses.stretch])
    track = Track(np.array([0.0, 1.0]), np.stack([numbers, numbers]))
    film = Film(replace(haloed, track=track), FilmOptions(fps=2, seconds=1, hold=0))
    assert b'id="halos"' not in animated_svg_bytes(film)

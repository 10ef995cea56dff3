"""Photographs moved in their frames: never bare, printed from the original, kept in files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.scene.item import PhotoArt


@pytest.fixture(scope="module")
def album(tmp_path_factory: pytest.TempPathFactory) -> pw.Layout:
    """Two photographs, red on the left and blue on the right, and one more as a hexagon."""
    folder = tmp_path_factory.mktemp("album")
    for name in "ab":
        picture = Image.new("RGB", (400, 300), "#c02020")
        picture.paste("#2020c0", (200, 0, 400, 300))
        picture.save(folder / f"{name}.png")
    return pw.photos("square", [folder / "a.png", folder / "b.png"], effort="draft", levels="50")


def art(session: pw.Session, k: int = 0) -> PhotoArt:
    found = session.document.items[k].art
    assert isinstance(found, PhotoArt)
    return found


def test_a_photograph_moves_in_its_frame_and_back(album: pw.Layout) -> None:
    session = album.edit()
    before = art(session)
    outline = session.document.items[0].outline
    session.crop(0, 2.0, 0.5, 0.0)
    crop = art(session).crop
    assert (crop.zoom, crop.x, crop.y, crop.whole) == (2.0, 0.5, 0.0, before)
    assert session.document.items[0].outline is outline
    assert session.is_certified
    session.crop(0, 2.0, -9.0, 0.2)
    # It goes as far as the frame is filled, on the way that was asked for.
    moved = art(session).crop
    assert moved.x == pytest.approx(-0.5, abs=1e-3)
    assert moved.whole is before
    session.crop(0, 1.0)
    assert art(session) is before
    assert session.undo()
    assert art(session).crop is moved


def test_all_that_a_frame_shows_is_the_part_asked_for(album: pw.Layout, tmp_path: Path) -> None:
    session = album.edit()
    session.crop(0, 2.0, 0.5, 0.0)
    session.layout.save(tmp_path / "album.png", pixels=600)
    pixels = np.asarray(Image.open(tmp_path / "album.png").convert("RGB"), dtype=int)
    factor = pixels.shape[1] / session.document.container.width
    region = session.document.items[0].outline.mapped(session.document.poses.matrix(0)).region
    inner = region.buffer(-0.1 * np.sqrt(region.area))
    points = shapely.get_coordinates(inner)
    colours = pixels[(points[:, 1] * factor).astype(int), (points[:, 0] * factor).astype(int)]
    assert (colours[:, 0] > 150).all()
    assert (colours[:, 2] < 100).all()


def test_a_crop_is_kept_in_a_session_file_and_can_be_changed_there(
    album: pw.Layout, tmp_path: Path
) -> None:
    session = album.edit()
    session.crop(1, 1.5, 0.25, -0.1)
    session.save(tmp_path / "album.packwork")
    with pw.Session.open(tmp_path / "album.packwork") as again:
        crop = art(again, 1).crop
        assert (crop.zoom, crop.x, crop.y) == (1.5, 0.25, -0.1)
        assert art(again, 1).preview.markup == art(session, 1).preview.markup
        again.crop(1, 1.0)
        assert art(again, 1).preview.markup == crop.whole.preview.markup


def test_a_drawing_has_no_frame(session: pw.Session) -> None:
    with pytest.raises(RecipeError, match="photographs"):
        session.crop(0, 2.0)


def test_a_crop_is_turned_over_below_another_colour_too(album: pw.Layout) -> None:
    plain, painted = album.edit(), album.edit()
    for session in (plain, painted):
        session.crop(0, 2.0, 0.5, 0.0)
    painted.recolor(0, "black")
    for session in (plain, painted):
        session.flip(0)
    painted.palette(None)
    one, other = art(plain).crop, art(painted).crop
    assert (other.zoom, other.x, other.y) == (one.zoom, one.x, one.y)
    assert np.array_equal(other.whole.preview.matrix, one.whole.preview.matrix)

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from packwork.errors import RecipeError
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.writers import diagnose
from packwork.writers.diagnose import CONTAINER, ITEM, OUTSIDE, OVERLAP, PALETTE, diagnose_png

ReadPicture = Callable[[bytes], np.ndarray]


@pytest.fixture
def faulty(make_layout: Callable[..., Layout], photo_item: Item) -> Layout:
    """Squares of side 16 at the canvas's left edge and twice in its middle."""
    return make_layout([photo_item] * 3, x=[2.0, 40.0, 48.0], y=[30.0, 30.0, 30.0])


def test_each_fault_has_its_colour(faulty: Layout, read_picture: ReadPicture) -> None:
    picture = read_picture(diagnose_png(faulty, 80))[..., :3]
    assert picture[0, 0].tolist() == [255, 255, 255]
    assert picture[10, 40].tolist() == PALETTE[CONTAINER].tolist()
    assert picture[30, 35].tolist() == PALETTE[ITEM].tolist()
    assert picture[30, 45].tolist() == PALETTE[OVERLAP].tolist()
    assert picture[30, 0].tolist() == PALETTE[OUTSIDE].tolist()


def test_areas_are_those_of_the_layout(faulty: Layout, read_picture: ReadPicture) -> None:
    picture = read_picture(diagnose_png(faulty, 80))[..., :3]
    pixels = {c: (picture == PALETTE[c]).all(axis=2).sum() for c in (OVERLAP, OUTSIDE)}
    assert pixels == {OVERLAP: 8 * 16, OUTSIDE: 2 * 16}


def test_bands_join_without_a_seam(
    faulty: Layout, read_picture: ReadPicture, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = read_picture(diagnose_png(faulty, 170))
    monkeypatch.setattr(diagnose, "_BAND_ROWS", 7)
    assert (read_picture(diagnose_png(faulty, 170)) == whole).all()


def test_edges_are_smooth(
    make_layout: Callable[..., Layout], star_item: Item, read_picture: ReadPicture
) -> None:
    picture = read_picture(diagnose_png(make_layout([star_item]), 160))
    assert len(np.unique(picture.reshape(-1, 4), axis=0)) > 5


def test_size_out_of_bounds(faulty: Layout) -> None:
    with pytest.raises(RecipeError, match="longer side"):
        diagnose_png(faulty, 0)

"""Outlines of words that are drawn small: coarser, and of the same areas."""

from __future__ import annotations

import pytest

from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.fonts.itemise import Piece
from packwork.readers.fonts.lettering import TypeSetting, lettering_of


@pytest.mark.parametrize("text", ["o", "Weld", "bookkeeping", "$&8@"])
def test_the_coarsest_outline_has_the_area_that_is_certified(text: str) -> None:
    line = [[TypeSetting(Piece(text), bundled_typeface())]]
    fine, coarse = lettering_of(line), lettering_of(line, em=1e-9)
    assert coarse.region.area == pytest.approx(fine.region.area, rel=5e-4)
    assert len(coarse.path) == len(fine.path)

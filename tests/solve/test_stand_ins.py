"""Outlines that stand for the items while they are arranged."""

from __future__ import annotations

import pytest

from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.solve import outlines as module
from packwork.solve.outlines import stand_ins
from scenes import disc, square, star


def test_exact_gives_the_outlines_themselves() -> None:
    outlines = [star(), disc()]
    assert all(a is b for a, b in zip(stand_ins(outlines, "exact"), outlines, strict=True))


def test_a_hull_has_no_bays() -> None:
    (found,) = stand_ins([star()], "hull")
    assert found.area == pytest.approx(hull(star()).area)
    assert len(found.points) == 5


def test_hulls_of_copies_are_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Outline] = []
    monkeypatch.setattr(module, "hull", lambda outline: made.append(outline) or hull(outline))
    first, second = star(), square()
    found = stand_ins([first, second, first, first], "hull")
    assert made == [first, second]
    assert found[0] is found[2] is found[3]

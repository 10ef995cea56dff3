"""Outlines that stand for the items while they are arranged."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.solve import stand_ins as module
from packwork.solve.stand_ins import stand_ins
from scenes import disc, square, star


def test_exact_gives_the_outlines_themselves() -> None:
    outlines = [star(), disc()]
    assert all(a is b for a, b in zip(stand_ins(outlines, "exact"), outlines, strict=True))


def test_a_hull_has_no_bays() -> None:
    (found,) = stand_ins([star()], "hull")
    assert found.area == pytest.approx(hull(star()).area)
    assert len(found.points) == 5


def test_a_fit_is_near_and_of_few_curves() -> None:
    ring = disc(3.0, 256)
    (found,) = stand_ins([ring], "fitted")
    assert found is not ring
    shared = found.region.intersection(ring.region).area
    assert shared > 0.99 * max(found.area, ring.area)


@pytest.mark.parametrize("choice", ["fitted", "hull"])
def test_copies_are_made_once(choice: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Outline] = []
    for name in ("fit_outline", "hull"):
        kept = getattr(module, name)
        monkeypatch.setattr(
            module, name, lambda outline, kept=kept: made.append(outline) or kept(outline)
        )
    first, second = star(), square()
    found = stand_ins([first, second, first, first], choice)
    assert made == [first, second]
    assert found[0] is found[2] is found[3]


def test_equal_outlines_are_fitted_once_by_the_process() -> None:
    first, again = (stand_ins([star(2.5, 7)], "fitted")[0] for _ in range(2))
    assert first is again


def test_what_crosses_itself_stands_for_itself() -> None:
    bow_tie = Outline.from_rings([np.array([[0.0, 0], [2, 2], [2, 0], [0, 1]])])
    assert stand_ins([bow_tie], "fitted")[0] is bow_tie

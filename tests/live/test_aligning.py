"""Items lined up and spaced evenly, by the extents of their outlines as they lie."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError

EDGES = {
    "left": (0, lambda low, high: low), "center": (0, lambda low, high: low + high),
    "right": (0, lambda low, high: high), "top": (1, lambda low, high: low),
    "middle": (1, lambda low, high: low + high), "bottom": (1, lambda low, high: high),
}  # fmt: skip


def extents(session: pw.Session, axis: int) -> tuple[np.ndarray, np.ndarray]:
    document = session.document
    bounds = np.array(
        [
            item.outline.mapped(document.poses.matrix(k)).bounds
            for k, item in enumerate(document.items)
        ]
    )
    return bounds[:, axis], bounds[:, axis + 2]


@pytest.mark.parametrize("to", EDGES)
def test_items_come_to_one_line_and_what_is_held_leads(session: pw.Session, to: str) -> None:
    axis, at = EDGES[to]
    before = session.document.poses
    session.align([1, 4, 7], to)
    lines = at(*extents(session, axis))[[1, 4, 7]]
    assert np.ptp(lines) < 1e-9
    other = ("y", "x")[axis]
    assert (getattr(session.document.poses, other) == getattr(before, other)).all()
    session.undo()
    line = at(*extents(session, axis))[4]
    session.hold(4)
    session.align([1, 4, 7], to)
    assert at(*extents(session, axis))[[1, 4, 7]] == pytest.approx([line] * 3)
    assert session.document.poses.x[4] == before.x[4]


@pytest.mark.parametrize(("direction", "axis"), [("horizontal", 0), ("vertical", 1)])
def test_distances_become_even_between_the_ends(
    session: pw.Session, direction: str, axis: int
) -> None:
    rows = [0, 3, 5, 8]
    low, high = (one[rows] for one in extents(session, axis))
    order = np.argsort(low + high)
    session.distribute(rows, direction)
    after_low, after_high = (one[rows][order] for one in extents(session, axis))
    assert np.ptp(after_low[1:] - after_high[:-1]) < 1e-9
    assert (after_low[0], after_high[-1]) == pytest.approx((low[order[0]], high[order[-1]]))


def test_what_is_held_in_a_row_stays_and_others_are_spaced_about_it(session: pw.Session) -> None:
    rows = [0, 3, 5, 8, 10]
    low, high = (one[rows] for one in extents(session, 0))
    order = np.argsort(low + high)
    session.hold(rows[order[2]])
    session.distribute(rows, "horizontal")
    after_low, after_high = (one[rows][order] for one in extents(session, 0))
    gaps = after_low[1:] - after_high[:-1]
    assert after_low[2] == pytest.approx(low[order[2]])
    assert gaps[[0, 2]] == pytest.approx(gaps[[1, 3]])


def test_what_is_lined_up_settles_and_tells_what_it_has_not_got(session: pw.Session) -> None:
    session.align(list(range(12)), "left")
    found = session.settle()
    assert found.certified
    assert any("there is no room for it" in line for line in session.unmet)


def test_one_item_has_no_line(session: pw.Session) -> None:
    with pytest.raises(RecipeError):
        session.align(3, "left")
    with pytest.raises(RecipeError):
        session.align([1, 2], "slanted")

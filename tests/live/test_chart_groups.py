"""A chart in groups: its marks stay in their group's container, by hand and poured anew."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.relayout import poured_again
from packwork.live.session import Session

ROWS = [
    {"land": land, "cups": cups, "part": part}
    for land, cups, part in [
        ("Finland", 12, "Europe"), ("Iceland", 9, "Europe"), ("Norway", 8, "Europe"),
        ("Brazil", 5.8, "America"), ("Canada", 6.5, "America"),
        ("Japan", 3.4, "Asia"), ("Vietnam", 1.9, "Asia"),
    ]
]  # fmt: skip


@pytest.fixture(scope="module")
def chart() -> pw.Layout:
    return pw.chart(
        "circle", ROWS, size_by="cups", label_by="land", by="part",
        effort="draft", levels="50,100", seed=1,
    )  # fmt: skip


def spread(session: Session) -> dict[str, float]:
    """Distance of the marks of each group from their middle, at most."""
    poses, found = session.document.poses, {}
    for name, rows in session.document.chart_groups.items():
        places = np.column_stack([poses.x[rows], poses.y[rows]])
        found[name] = float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())
    return found


def test_groups_are_poured_anew_each_in_its_own(chart: pw.Layout) -> None:
    session = chart.edit()
    assert list(session.document.chart_groups) == ["Europe", "America", "Asia"]
    moments = []
    for seed in (1, 2):
        session.apply(poured_again(session.document, seed, moments.append))
        session.finish()
        assert session.is_certified
        assert max(spread(session).values()) < chart.container.width / 4
    assert session.layout.poses.scale == pytest.approx(chart.poses.scale)
    assert not np.array_equal(session.layout.poses.x, chart.poses.x)
    assert {len(one.poses) for one in moments if one.poses is not None} == {7}


def test_a_mark_that_is_dragged_into_another_group_goes_back(chart: pw.Layout) -> None:
    session = chart.edit()
    there = session.document.poses
    session.do("move", item=6, x=float(there.x[4]), y=float(there.y[4]) + 40)
    session.finish()
    assert session.is_certified
    assert any("taken back, for Vietnam belongs to Asia" in one for one in session.advice)
    assert np.array_equal(session.document.poses.x, there.x)
    session.do("move", item=6, x=float(there.x[6]) + 5, y=float(there.y[6]))
    session.finish()
    assert session.document.poses.x[6] != there.x[6]


def test_groups_keep_their_containers(chart: pw.Layout) -> None:
    session = chart.edit()
    with pytest.raises(RecipeError, match="each group of a chart has one of its own"):
        session.set_container("heart")
    with pytest.raises(RecipeError, match="container"):
        session.do("place_container", x=30)

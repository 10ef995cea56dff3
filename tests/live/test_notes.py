"""Labels on items follow them in sessions; titles and keys stay."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.face.opening import opening_of
from packwork.live.relayout import poured_again
from packwork.writers import svg_text

TABLE = {"name": ["fig", "kiwi", "plum", "pear"], "kg": [4, 2, 5, 3]}


@pytest.fixture(scope="module")
def chart() -> pw.Layout:
    """Four marks with their names on them, and a title."""
    return pw.chart(
        "circle", TABLE, size_by="kg", label_by="name", title="Fruit", effort="draft", levels="50"
    )


def test_a_label_follows_its_mark_and_all_else_stays(chart: pw.Layout, tmp_path: Path) -> None:
    session = chart.edit()
    fig = session.positions("fig")[0]
    session.turn("fig", 30)
    session.finish()
    made = session.layout
    assert [note.is_on_item for note in made.notes] == [note.is_on_item for note in chart.notes]
    moved = made.poses.x - chart.poses.x
    for before, after in zip(chart.notes, made.notes, strict=True):
        if not before.is_on_item:
            assert after is before
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork").layout
    assert again.to_svg() == made.to_svg()
    assert np.isfinite(moved[fig])


def test_a_label_goes_with_the_item_that_is_taken_away(chart: pw.Layout) -> None:
    session = chart.edit()
    labels = [note for note in chart.notes if note.is_on_item]
    session.remove("fig")
    assert len([note for note in session.layout.notes if note.is_on_item]) == len(labels) - 1
    assert session.undo()
    assert len([note for note in session.layout.notes if note.is_on_item]) == len(labels)


def test_marks_stay_in_proportion_to_their_numbers(chart: pw.Layout) -> None:
    session = chart.edit()
    for edit in (
        lambda: session.scale("fig", 2.0),
        lambda: session.weigh("fig", 2.0),
        lambda: session.set(sizes="free"),
    ):
        with pytest.raises(RecipeError, match="as large as their numbers say"):
            edit()


def test_an_svg_of_ours_is_opened_as_a_layout_and_no_other(tmp_path: Path) -> None:
    layout = pw.fill("circle", "owl", count=3, effort="draft", levels="50")
    ours, other = tmp_path / "ours.svg", tmp_path / "other.svg"
    layout.save(ours)
    other.write_text('<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="4"/></svg>', encoding="utf-8")
    document = opening_of([str(ours)]).document
    assert document is not None
    assert svg_text(document.layout) == layout.to_svg()
    recipe = opening_of([str(other)]).recipe
    assert recipe is not None
    assert recipe.container == str(other)


def test_marks_poured_anew_keep_their_sizes_and_what_has_no_room_is_taken_back(
    chart: pw.Layout,
) -> None:
    session = chart.edit()
    before = session.document
    session.apply(poured_again(before, 3))
    assert session.settle().certified
    assert session.document.poses.scale == pytest.approx(before.poses.scale)
    now = session.document
    session.move("plum", 0.0, 0.0)
    session.hold("plum")
    assert session.settle().certified
    assert np.array_equal(session.document.poses.x, now.poses.x)
    assert any("taken back" in line for line in session.advice)

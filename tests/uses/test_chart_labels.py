"""Labels on marks: inside them, large enough, to be read on their colour, and no items."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import pytest
import shapely

import packwork as pw
from packwork.readers.layouts.read import read_written
from packwork.scene.contrast import contrast
from packwork.scene.layout import Note
from packwork.scene.swatch import representative_colour
from packwork.uses.charts.mark_labels import LEAST_CONTRAST, SMALLEST_SHARE
from packwork.uses.charts.pen import lettering

QUICK: dict[str, Any] = {"epochs": 30, "levels": "32,64", "effort": "draft"}
ROWS = {
    "land": ["Brazil", "Papua New Guinea", "Peru", "Kenya", "Nowhere at all"],
    "kg": [90.0, 60.0, 30.0, 10.0, 0.02],
    "kind": ["a", "b", "c", "a", "b"],
}


def labels(layout: pw.Layout) -> list[Note]:
    return [note for note in layout.notes if note.is_on_item]


def colour_of(layout: pw.Layout, k: int) -> str:
    return representative_colour(layout.items[k])


def box(note: Note) -> Any:
    """Box of the letters of a note, in place."""
    left, top, right, bottom = lettering(note.says).region.bounds
    em = note.matrix[0, 0] * lettering(note.says).units
    x, y = note.matrix[:, 2]
    return shapely.box(x + left * em, y + top * em, x + right * em, y + bottom * em)


@pytest.mark.parametrize(("container", "mark"), [("circle", "builtin:ring"), ("none", "heart")])
def test_labels_lie_within_the_ink_of_their_marks_and_can_be_read(
    container: str, mark: str
) -> None:
    options = {"by": "kind"} if container == "none" else {}
    layout = pw.chart(
        container, ROWS, size_by="kg", label_by="land", color_by="kind", mark=mark,
        **options, **QUICK,
    )  # fmt: skip
    found = labels(layout)
    assert found
    whole = {item.name: k for k, item in enumerate(layout.items)}
    for note in found:
        k = next(k for name, k in whole.items() if note.says in name)
        assert layout.inks[k].region.contains(box(note))
        assert contrast(note.fill, colour_of(layout, k)) >= LEAST_CONTRAST
        em = note.matrix[0, 0] * lettering(note.says).units
        assert em >= SMALLEST_SHARE * layout.container.side * (1 - 1e-9)


def test_long_names_are_broken_into_lines() -> None:
    layout = pw.chart("circle", ROWS, size_by="kg", label_by="land", **QUICK)
    said = [note.says for note in labels(layout)]
    assert "Brazil" in said
    assert {"Papua New", "Guinea"} <= set(said) or "Papua New Guinea" in said


def test_those_that_do_not_fit_are_counted_and_stay_tooltips(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        layout = pw.chart("circle", ROWS, size_by="kg", label_by="land", **QUICK)
    assert "Nowhere at all" not in " ".join(note.says for note in labels(layout))
    assert "4 of 5 labels fit on their marks" in caplog.text
    layout.save(tmp_path / "chart.svg")
    text = (tmp_path / "chart.svg").read_text(encoding="utf-8")
    assert "<title>land: Nowhere at all; kg: 0.02; kind: b</title>" in text


def test_labels_are_no_items_and_let_pointers_through(tmp_path: Path) -> None:
    layout = pw.chart("circle", ROWS, size_by="kg", label_by="land", **QUICK)
    layout.save(tmp_path / "chart.svg")
    text = (tmp_path / "chart.svg").read_text(encoding="utf-8")
    assert '<g id="labels" pointer-events="none">' in text
    assert len(read_written(tmp_path / "chart.svg").items) == 5


def test_marks_of_one_row_have_one_label_where_their_colours_tell_them() -> None:
    rows = {"land": ["Peru", "Mali"], "kg": [5.0, 2.0]}
    asked = {"size_by": "kg", "unit": 1, "label_by": "land", **QUICK}
    layout = pw.chart("circle", rows, color_by="land", **asked)
    assert sorted(note.says for note in labels(layout)) == ["Mali", "Peru"]
    # One of five alike would say nothing of the others.
    layout = pw.chart("circle", rows, **asked)
    assert sorted(note.says for note in labels(layout)) == ["Mali"] * 2 + ["Peru"] * 5


def test_a_bar_has_one_part_of_a_mark_of_all_that_is_left_over() -> None:
    rows = {"year": [1, 1, 1, 2], "kind": ["a", "a", "b", "a"], "kg": [1.5, 1.75, 0.5, 2.25]}
    layout = pw.chart("none", rows, size_by="kg", unit=1, by="year", color_by="kind", **QUICK)
    values = [item.datum.value for item in layout.items if item.datum]
    assert sorted(values) == [0.25, 0.25, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0]
    assert sum(values) == 6.0


def test_rows_that_no_label_tells_may_be_joined_by_leaving_labels_out(
    caplog: pytest.LogCaptureFixture,
) -> None:
    names = ["Papua New Guinea and the islands around it"] * 3 + ["Peru"]
    names = [f"{name} {k}" * 2 for k, name in enumerate(names)]
    rows = {"year": [1, 1, 1, 2], "name": names, "kg": [1.5, 1.75, 0.5, 40.25]}
    asked: dict[str, Any] = {"size_by": "kg", "unit": 1, "by": "year", **QUICK}
    with caplog.at_level(logging.WARNING, "packwork"):
        layout = pw.chart("none", rows, label_by="name", **asked)
    assert labels(layout) == []
    assert "each row leaves a part of a mark over: without label_by" in caplog.text
    caplog.clear()
    whole = pw.chart("none", rows, **asked)
    assert len(whole.items) < len(layout.items)
    assert "label_by" not in caplog.text


def test_without_a_column_nothing_is_written_on_marks() -> None:
    assert labels(pw.chart("circle", ROWS, size_by="kg", **QUICK)) == []


def test_films_are_without_labels(tmp_path: Path) -> None:
    layout = pw.chart("circle", ROWS, size_by="kg", label_by="land", record=True, **QUICK)
    layout.save_film(tmp_path / "chart.svg", fps=5, seconds=1)
    assert 'id="labels"' not in (tmp_path / "chart.svg").read_text(encoding="utf-8")


def test_letters_that_no_font_has_are_told_and_stop_nothing(
    caplog: pytest.LogCaptureFixture,
) -> None:
    rows = {"land": ["x\U000105c0", " ", "Peru"], "kind": ["a\U000105c1", "b", "b"]}
    with caplog.at_level(logging.WARNING):
        layout = pw.chart("none", rows, by="kind", label_by="land", color_by="land", **QUICK)
    assert len(layout.items) == 3
    assert "no font installed has" in caplog.text

"""Charts from data to files: areas that are read back say what the data say."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork.readers.layouts.read import read_written
from packwork.uses.charts.colours import UNKNOWN
from packwork.uses.charts.framing import EM_SHARE
from packwork.uses.charts.pen import lettering

QUICK: dict[str, Any] = {"epochs": 30, "levels": "32,64", "effort": "draft"}
NUMBERS = [3.7, 12.0, 0.9, 5.5, 1.3]
ROWS = {"name": list("abcde"), "number": NUMBERS, "kind": ["x", "y", "x", "", "y"]}
MANY = {column: cells * 12 for column, cells in ROWS.items()}
TRUE = 1e-3


@pytest.mark.parametrize("mark", ["circle", "heart", "builtin:leaf"])
@pytest.mark.parametrize("ending", [".svg", ".geojson"])
def test_areas_in_the_file_are_in_the_proportion_of_the_numbers(
    mark: str, ending: str, tmp_path: Path
) -> None:
    layout = pw.chart("circle", ROWS, size_by="number", mark=mark, label_by="name", **QUICK)
    file = tmp_path / f"chart{ending}"
    layout.save(file)
    again = read_written(file)
    per_number = again.areas / np.array(NUMBERS)
    assert per_number / per_number.mean() == pytest.approx(np.ones(5), rel=TRUE)


def test_parts_of_marks_are_true_in_the_file(tmp_path: Path) -> None:
    layout = pw.chart("square", ROWS, size_by="number", unit=1, mark="builtin:fish", **QUICK)
    layout.save(tmp_path / "chart.svg")
    areas = read_written(tmp_path / "chart.svg").areas
    assert areas.sum() / areas.max() == pytest.approx(sum(NUMBERS), rel=TRUE)


def test_a_mark_of_a_file_tells_its_row_when_pointed_at(tmp_path: Path) -> None:
    layout = pw.chart("circle", ROWS, size_by="number", label_by="name", **QUICK)
    layout.save(tmp_path / "chart.svg")
    text = (tmp_path / "chart.svg").read_text(encoding="utf-8")
    assert "<title>name: a; number: 3.7; kind: x</title>" in text


def test_each_category_has_its_colour_and_nothing_is_grey() -> None:
    layout = pw.chart("circle", ROWS, color_by="kind", **QUICK)
    fills = [item.art.fill for item in layout.items]
    assert fills[0] == fills[2] != fills[1] == fills[4]
    assert fills[3] == "#9aa0a6"


def test_numbers_run_along_the_ramp() -> None:
    layout = pw.chart("circle", ROWS, color_by="number", palette="#000000,#ffffff", **QUICK)
    fills = [item.art.fill for item in layout.items]
    assert (fills[2], fills[1]) == ("#000000", "#ffffff")


def test_marks_of_one_drawing_share_it_in_each_colour(tmp_path: Path) -> None:
    rows = {"kind": ["x", "y"] * 4}
    pw.chart("circle", rows, color_by="kind", mark="builtin:anchor", **QUICK).save(
        tmp_path / "chart.svg"
    )
    text = (tmp_path / "chart.svg").read_text(encoding="utf-8")
    assert text.count('id="shape-') <= 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"weights": {"a": 1}}, "weights: is no option of a chart"),
        ({"rules": [{"items": "a", "weight": 2}], "label_by": "name"}, "the data say how large"),
        ({"rules": [{"items": "a", "count": 2}], "label_by": "name"}, "the data say how many"),
        ({"color_by": "name", "palette": "red,blue"}, "5 values, the palette 2 colours"),
        ({"sise_by": "number"}, "no such option; did you mean"),
    ],
)
def test_what_would_make_it_untrue_is_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(pw.PackworkError, match=message):
        pw.chart("circle", ROWS, **{**QUICK, **options})


def test_the_legend_shows_sizes_at_the_scale_of_the_chart() -> None:
    layout = pw.chart("circle", MANY, size_by="number", color_by="kind", title="Five", **QUICK)
    said = [note.says for note in layout.notes if note.says]
    assert said[:2] == ["Five", "number"]
    assert {"x", "y", "no value"} <= set(said)
    per_number = layout.areas[0] / NUMBERS[0]
    keys = zip(layout.notes, layout.notes[1:], strict=False)
    sizes = {b.says: a for a, b in keys if not a.says and b.says in {"10", "5", "2", "1", "0.5"}}
    assert 2 <= len(sizes) <= 3
    circle = layout.items[0].outline.area
    for number, note in sizes.items():
        area = circle * note.matrix[0, 0] ** 2
        assert area == pytest.approx(float(number) * per_number, rel=TRUE)


def test_numbers_of_a_key_stand_beside_the_middle_of_their_marks() -> None:
    layout = pw.chart("circle", MANY, size_by="number", **QUICK)
    keys = [
        (a, b)
        for a, b in zip(layout.notes, layout.notes[1:], strict=False)
        if not a.says and b.says in {"10", "5", "2", "1", "0.5"}
    ]
    circle = layout.items[0].outline.bounds
    middles = [m.matrix[1, 2] + m.matrix[0, 0] * (circle[1] + circle[3]) / 2 for m, _ in keys]
    lines = [number.matrix[1, 2] for _, number in keys]
    assert len(keys) > 1
    assert np.ptp(middles) == pytest.approx(0, abs=1e-6)
    # Digits are about 0.7 em high.
    tall = keys[-1][1].matrix[0, 0] * lettering("1").units * 0.35
    assert np.array(lines) - tall == pytest.approx(middles, abs=1e-6)


def test_the_ends_of_a_ramp_are_written_as_other_numbers() -> None:
    rows = [{"kg": "1.234,50"}, {"kg": "3.120,75"}, {"kg": "410,00"}]
    layout = pw.chart("circle", rows, size_by="kg", color_by="kg", **QUICK)
    said = [note.says for note in layout.notes]
    assert {"410", "3.120,75"} <= set(said)
    assert "3120,75" not in said


def test_title_and_legend_have_room_of_their_own_on_the_canvas() -> None:
    layout = pw.chart("square", ROWS, size_by="number", title="Five", canvas="A4", **QUICK)
    left, top, right, bottom = layout.container.outline.bounds
    assert (layout.container.width, layout.container.height) == (210.0, 297.0)
    title, heading = (n for n in layout.notes if n.says in {"Five", "number: 0.9 – 12"})
    assert title.matrix[1, 2] < top < bottom < heading.matrix[1, 2]
    assert left > 0
    assert right < 210


@pytest.mark.parametrize(
    ("container", "rows", "options"),
    [
        ("square", ROWS, {}),
        ("square", MANY, {}),
        ("square", ROWS, {"by": "kind"}),
        ("square", MANY, {"by": "kind"}),
        ("none", MANY, {"canvas": "600x600", "by": "kind"}),
    ],
)
def test_a_chart_ends_soon_below_its_legend(
    container: str, rows: Any, options: dict[str, Any]
) -> None:
    if container == "none":
        layout = pw.chart(container, rows, size_by="number", **options, effort="draft")
    else:
        layout = pw.chart(container, rows, size_by="number", color_by="kind", **options, **QUICK)
    marks = [note for note in layout.notes if note.fill == UNKNOWN]
    foot = max(mark.bounds[3] for mark in (item.outline for item in layout.items))
    low = [mark.matrix[1, 2] + foot * mark.matrix[0, 0] for mark in marks]
    last = max(note.matrix[1, 2] for note in layout.notes if note.says)
    last = max([last, *low])
    assert layout.container.height - last < 3.5 * EM_SHARE * layout.container.width


def test_paper_of_its_own_over_a_container_does_not_part_it_from_the_title(tmp_path: Path) -> None:
    far = tmp_path / "far.svg"
    far.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 300">'
        '<rect x="5" y="120" width="90" height="90"/></svg>',
        encoding="utf-8",
    )
    layout = pw.chart(far, ROWS, size_by="number", title="Far", **QUICK)
    em = EM_SHARE * layout.container.width
    _, top, _, bottom = layout.container.outline.bounds
    assert top < 3.5 * em
    assert layout.container.height - bottom < 6 * em


def test_ends_of_sizes_have_as_many_decimals_as_their_column() -> None:
    rows = [{"kg": cell} for cell in ("12,50", "9,25", "8")]
    layout = pw.chart("square", rows, size_by="kg", decimal=",", **QUICK)
    assert "kg: 8 – 12,50" in [note.says for note in layout.notes]


def test_without_legend_and_title_the_canvas_is_the_containers() -> None:
    layout = pw.chart("square", ROWS, size_by="number", legend=False, **QUICK)
    assert layout.notes == ()
    assert layout.container.height == layout.container.width


@pytest.mark.parametrize("options", [{"color_by": "number"}, {"unit": 1, "mark_by": "kind"}])
def test_every_sort_of_key_is_drawn_and_is_no_item(options: Any, tmp_path: Path) -> None:
    layout = pw.chart("square", ROWS, size_by="number", **options, **QUICK)
    for ending in (".svg", ".png"):
        layout.save(tmp_path / f"chart{ending}", pixels=100)
    assert 'id="legend"' in (tmp_path / "chart.svg").read_text(encoding="utf-8")
    assert len(read_written(tmp_path / "chart.svg").items) == len(layout.items)


LOGNORMAL = {"number": np.random.default_rng(0).lognormal(0.0, 1.0, 130).tolist()}
DRAFT: dict[str, Any] = {"size_by": "number", "effort": "draft"}


def test_many_circles_are_certified_in_proportion_and_cover_far_more_than_levels_do() -> None:
    jammed = [pw.chart("bear", LOGNORMAL, seed=seed, **DRAFT) for seed in range(3)]
    levels = [pw.chart("bear", LOGNORMAL, start="distance-field", **DRAFT)]
    assert all(layout.certified for layout in jammed)
    for layout in jammed:
        per_number = layout.areas / np.array(LOGNORMAL["number"])
        assert per_number / per_number[0] == pytest.approx(np.ones(130), rel=1e-9)
    covered = [np.median([one.metrics["LC"] for one in found]) for found in (jammed, levels)]
    assert covered[0] > covered[1] + 0.05


def test_one_seed_gives_one_chart_of_circles() -> None:
    first, again = (pw.chart("circle", LOGNORMAL, seed=3, **DRAFT) for _ in range(2))
    assert first.to_svg() == again.to_svg()


def test_many_circles_stand_closer_unless_a_padding_is_asked_for() -> None:
    gaps = [
        pw.chart("circle", LOGNORMAL, **DRAFT, **asked).metrics["exact"]["min_gap"]
        for asked in ({}, {"padding": "2"})
    ]
    assert 0 < gaps[0] < 1.2
    assert 2 <= gaps[1] < 2.1

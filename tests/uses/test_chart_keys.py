"""Colours and keys of charts: which value has which, whatever else the table holds."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import packwork as pw
from packwork.readers.layouts.read import read_written
from packwork.scene.palette import PALETTES
from packwork.scene.swatch import representative_colour
from packwork.uses.charts.framing import round_numbers

QUICK: dict[str, Any] = {"epochs": 10, "levels": "32", "effort": "draft"}
KINDS = {"pear": 2, "fig": 3, "apple": 1, "quince": 4}
ROWS = [{"kind": kind, "kg": 1.0} for kind, count in KINDS.items() for _ in range(count)]


def colours(layout: pw.Layout) -> dict[str, str]:
    """Colour of each category of a chart's marks."""
    there = {(i.datum.category, representative_colour(i)) for i in layout.items if i.datum}
    assert len(dict(there)) == len(there)
    return dict(there)


def chart(rows: Any, **options: Any) -> pw.Layout:
    return pw.chart("circle", rows, **{"color_by": "kind", **QUICK, **options})


def test_a_value_keeps_its_colour_whatever_the_order_and_how_often_it_is_there() -> None:
    whole = colours(chart(ROWS))
    mixed = random.Random(3).sample(ROWS, len(ROWS)) + [ROWS[-1]] * 5 + [ROWS[5]] * 4
    assert colours(chart(mixed)) == whole
    # Rows that are not shown count as well: their kg is 0.
    without = [row | {"kg": 0 if row["kind"] == "apple" else 1.0} for row in ROWS]
    some = colours(chart(without, size_by="kg"))
    assert some == {kind: colour for kind, colour in whole.items() if kind != "apple"}


def test_colours_are_given_out_by_the_alphabet() -> None:
    given = dict(zip(sorted(KINDS), ("#ff0000", "#00ff00", "#0000ff", "#123456"), strict=True))
    assert colours(chart(ROWS, palette=list(given.values()))) == given


@pytest.mark.parametrize("named", [{"fig": "red", "Pear": "#0000ff"}, "fig=red, pear=rgb(0,0,255)"])
def test_colours_are_set_by_name(named: Any, tmp_path: Path) -> None:
    plain, own = chart(ROWS), chart(ROWS, palette=named)
    found = colours(own)
    assert (found["fig"], found["pear"]) == ("#ff0000", "#0000ff")
    assert not {found["apple"], found["quince"]} & {"#ff0000", "#0000ff"}
    assert set(found.values()) - {"#ff0000", "#0000ff"} <= set(colours(plain).values())
    # Of fewer values they are the same.
    some = [row for row in ROWS if row["kind"] in {"fig", "pear"}]
    assert colours(chart(some, palette=named)) == {"fig": "#ff0000", "pear": "#0000ff"}
    own.save(tmp_path / "own.geojson")
    again = pw.run(own.manifest["recipe"])
    assert colours(again) == found


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"palette": {"plum": "red"}}, "palette: gives a colour to 'plum'; kind has apple, fig"),
        ({"palette": {"fig": "redd"}}, "palette: 'redd' is no colour"),
        ({"palette": "fig=red,blue"}, "palette: give each name its colour"),
        ({"palette": {"fig": "red"}, "color_by": "kg"}, "gives a colour to 'fig'; kg has"),
        ({"palette": {"fig": "red"}, "color_by": None}, "which column's"),
    ],
)
def test_names_without_a_meaning_are_refused(options: Any, said: str) -> None:
    with pytest.raises(pw.RecipeError, match=said):
        chart(ROWS, **options)


def test_names_are_for_columns_alone(caplog: pytest.LogCaptureFixture) -> None:
    said = "palette: gives colours to names, which the values of a column"
    for options in ({}, {"color_by": "weight"}):
        with pytest.raises(pw.RecipeError, match=said):
            pw.words("circle", {"star": 1}, palette="star=red", **options)
    with pytest.raises(pw.RecipeError, match=said):
        pw.fill("circle", "star", count=2, palette={"star": "red"})
    chart(ROWS, palette={"fig": "red", "plum": "blue"})
    assert "palette gives a colour to 'plum'; kind has apple, fig" in caplog.text


def test_steps_of_a_series_keep_colours_alone_too() -> None:
    rows = [row | {"year": 2000 + k % 2} for k, row in enumerate(ROWS * 2)]
    rows.append({"kind": "banana", "kg": 1.0, "year": 2001})
    made = pw.chart_series("circle", rows, "year", color_by="kind", **QUICK)
    first, last = (colours(layout) for layout in made)
    assert last.items() > first.items()
    assert colours(pw.run(next(iter(made)).manifest["recipe"])) == first


def test_marks_go_by_the_alphabet_too(tmp_path: Path) -> None:
    layouts = [pw.chart("circle", rows, mark_by="kind", **QUICK) for rows in (ROWS, ROWS[::-1])]
    marks = [
        {(i.datum.row["kind"], len(i.outline.points)) for i in layout.items if i.datum}
        for layout in layouts
    ]
    assert marks[0] == marks[1]


@pytest.mark.parametrize("background", ["white", "black"])
def test_a_ramp_runs_as_elsewhere_and_has_a_key_to_no_value(background: str) -> None:
    rows = [{"t": k} for k in range(12)] + [{"t": None}]
    layout = pw.chart("circle", rows, color_by="t", background=background, **QUICK)
    found = [representative_colour(item) for item in layout.items]
    assert (found[0], found[11]) == (PALETTES["viridis"][0], PALETTES["viridis"][-1])
    said = [note.says for note in layout.notes]
    grey = layout.notes[said.index("no value") - 1]
    assert grey.fill == found[12]
    full = pw.chart("circle", rows[:12], color_by="t", **QUICK)
    assert "no value" not in [note.says for note in full.notes]


@given(st.floats(1e-6, 1e9), st.floats(1.0, 1e5))
def test_numbers_of_size_keys_are_within_those_shown(smallest: float, ratio: float) -> None:
    largest = smallest * ratio
    numbers = round_numbers(smallest, largest)
    assert numbers == sorted(set(numbers), reverse=True)
    assert all(smallest * (1 - 1e-6) <= number <= largest * (1 + 1e-6) for number in numbers)
    assert len(numbers) > 1 or ratio < 1 + 1e-6


def test_size_keys_are_within_the_numbers_of_the_table(tmp_path: Path) -> None:
    rng = random.Random(1)
    rows = [{"lb": rng.randint(1_773, 5_140)} for _ in range(120)]
    layout = pw.chart("circle", rows, size_by="lb", **QUICK)
    assert [note.says for note in layout.notes if note.says] == ["lb", "5,000", "2,000"]
    layout.save(tmp_path / "cars.svg")
    assert len(read_written(tmp_path / "cars.svg").items) == len(rows)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({}, "took: 2:10 – 41:00"),
        ({"unit": 1.5}, "= 1:30 took"),
        ({"by": "who"}, "43:10"),
    ],
)
def test_sizes_that_are_lengths_of_time_are_said_as_such(asked: Any, said: str) -> None:
    times = [("Ann", "2:10"), ("Ann", "41:00"), ("Bo", "6:05")]
    rows = [{"who": who, "took": took} for who, took in times]
    layout = pw.chart("circle", rows, size_by="took", legend=True, **asked, **QUICK)
    assert said in [note.says for note in layout.notes]


def test_a_text_with_a_colon_makes_no_hours_of_numbers() -> None:
    rows = [{"n": "3"}, {"n": "1.5"}, {"n": "see: B"}]
    layout = pw.chart("circle", rows, size_by="n", legend=True, **QUICK)
    assert "n: 1.5 – 3" in [note.says for note in layout.notes]

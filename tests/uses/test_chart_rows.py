"""Rows in groups: their order, their names, what is in none, what is refused."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from packwork.errors import PackworkError, RecipeError
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.cells import is_missing
from packwork.uses.charts.marks import ChartRead, read_chart


def chart(cells: list[Any], **options: Any) -> ChartRead:
    rows = tuple({"g": cell, "n": k + 1} for k, cell in enumerate(cells))
    return read_chart(ChartOptions(data=rows, by="g", **options))


@pytest.mark.parametrize(
    ("cells", "names"),
    [
        (["b", "a", "b"], ("b", "a")),
        (["Red", "red", "blue", "Red"], ("Red", "blue")),
        ([10, 9.5, "2"], ("2", "9.5", "10")),
        (["1900", "1899.0"], ("1899", "1900")),
        (["2021-03", "2020-12", "2021-01"], ("2020-12", "2021-01", "2021-03")),
        (["2021-03-01 00:00:00", "2020-03-01 00:00:00"],
         ("2020-03-01 00:00:00", "2021-03-01 00:00:00")),
    ],
)  # fmt: skip
def test_numbers_and_dates_ascend_all_else_as_it_comes(cells: list[Any], names: Any) -> None:
    read = chart(cells)
    assert read.groups == names
    assert [item.datum.group for item in read.items if item.datum] == [
        names[k] for k in read.group_of
    ]


def test_steps_show_those_without_rows_between_others() -> None:
    read = chart([1901, 1999, 1975], by_step=10)
    assert len(read.groups) == 10
    assert (read.groups[0], read.groups[-1]) == ("1900s", "1990s")
    assert read.group_of.tolist() == [0, 9, 7]


@pytest.mark.parametrize(
    ("cells", "step", "names"),
    [
        ([0.3, 0.1], 0.1, ("0.1–0.2", "0.2–0.3", "0.3–0.4")),
        ([-1, 1], 2, ("-2–-1", "0–1")),
        ([3, 4], 1, ("3", "4")),
        ([1999, 3001], 1000, ("1000–1999", "2000–2999", "3000–3999")),
    ],
)
def test_steps_begin_at_their_multiples(cells: list[Any], step: float, names: Any) -> None:
    assert chart(cells, by_step=step).groups == names


def test_rows_in_no_group_are_named() -> None:
    read = chart(["a", "", None, "b"])
    assert len(read.items) == 2
    assert read.notices == ("left out 2 rows of 4 whose g is missing: row 2, row 3",)
    stepped = chart([1, "many", "", 12], by_step=10)
    assert stepped.notices == (
        "left out 1 row of 4 whose g is missing: row 3",
        "left out 1 row of 4 whose g is no number: row 2",
    )
    assert stepped.groups == ("0–9", "10–19")


def test_groups_of_which_no_row_has_a_size_are_not_shown_and_their_rows_named() -> None:
    rows = ({"g": "a", "n": 0}, {"g": "b", "n": 1})
    read = read_chart(ChartOptions(data=rows, by="g", size_by="n"))
    assert read.groups == ("b",)
    assert read.notices == ("left out 1 row of 2 whose n is 0: row 1",)


def test_rows_are_counted_within_their_group() -> None:
    read = chart(["a"] * 25 + ["b"] * 10, unit=10)
    assert read.group_of.tolist() == [0, 0, 0, 1]
    assert read.values.tolist() == [10, 10, 5, 10]
    assert read.rows[0] == {"rows": 25, "g": "a"}


def test_some_marks_of_a_chart_keep_what_they_say() -> None:
    read = chart(["a", "b", "a"], color_by="n", size_by="n")
    some = read.subset(read.group_of.argsort()[:2])
    assert [row["n"] for row in some.rows] == [1, 3]
    assert some.group_of.tolist() == [0, 0]


@pytest.mark.parametrize(
    ("cells", "options", "message"),
    [
        ([f"n{k}" for k in range(5_000)], {}, "5,000 groups; at most 60 .* column of fewer values"),
        (
            [f"n{k}" for k in range(96)],
            {},
            "96 groups; at most 60 .* a map of them by --in-regions",
        ),
        ([f"n{k}" for k in range(500)], {"in_regions": True}, "500 groups; at most 400 .* values$"),
        (list(range(3_000)), {}, "3,000 groups; .* use --by-step 100 or more"),
        ([0, 1e50], {"by_step": 1}, "by_step: 1 is too small for numbers up to 1e\\+50"),
        (
            [0, 1e10],
            {"by_step": 1},
            "1e\\+10 groups; .* use --by-step 200000000 or more",
        ),
        (["x", "y"], {"by_step": 10}, "by_step: needs numbers; column 'g' holds 'x'"),
        (["", None], {}, "column 'g' holds nothing"),
        (["", None], {"by_step": 10}, "column 'g' holds nothing"),
        (["", "x"], {"by_step": 10}, "holds 'x'"),
        (["a"], {"size_by": "g"}, "no numbers"),
    ],
)
def test_bad_groups_are_one_clear_line(cells: list[Any], options: Any, message: str) -> None:
    with pytest.raises(RecipeError, match=message) as caught:
        chart(cells, **options)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


def test_a_map_has_as_many_groups_as_a_country_has_districts() -> None:
    assert len(chart([f"n{k}" for k in range(96)], in_regions=True).groups) == 96


def test_the_step_that_is_offered_is_enough() -> None:
    assert 20 <= len(chart(list(range(3_000)), by_step=100).groups) <= 60


CELLS = st.one_of(
    st.none(),
    st.sampled_from(["", "NA", "a", "A", "b ", "2020-01", "1e400"]),
    st.integers(-(10**6), 10**6),
    st.floats(),
)


@example(cells=[1e308, -1e308], step=1e-10)
@example(cells=[1e308, -1e308], step=None)
@given(
    cells=st.lists(CELLS, min_size=1, max_size=30),
    step=st.none() | st.floats(min_value=1e-300, max_value=1e300),
)
def test_any_cells_are_parted_or_refused_in_one_line(cells: list[Any], step: float | None) -> None:
    message, read = "", None
    try:
        read = chart(cells, by_step=step)
    except PackworkError as error:
        message = str(error)
    assert "\n" not in message
    assert len(message) < 400
    if read is None:
        return
    assert 1 <= len(read.groups) <= 60
    assert len(set(read.groups)) == len(read.groups)
    assert (read.group_of >= 0).all()
    assert (read.group_of < len(read.groups)).all()
    assert len(read.items) + sum(is_missing(cell) or step is not None for cell in cells) >= len(
        cells
    )


@pytest.mark.parametrize("cell", ["k. A.", "k.A.", "n/a", "#NV", "–", "-", "…", "keine Angabe"])
def test_usual_marks_of_no_value_are_empty_cells(cell: str) -> None:
    rows = ({"a": "x", "kg": "1,5"}, {"a": "y", "kg": cell}, {"a": "z", "kg": "2"})
    read = read_chart(ChartOptions(data=rows, size_by="kg", label_by="a"))
    assert read.notices == ("left out 1 row of 3 whose kg is missing: y",)
    assert not read.lost


def test_dashes_are_categories_among_texts() -> None:
    rows = tuple({"rh": rh, "n": 1} for rh in ("+", "-", "n/a"))
    read = read_chart(ChartOptions(data=rows, size_by="n", color_by="rh"))
    assert read.colour_of == ("+", "-", "no value")


def test_a_total_without_a_group_is_left_out_once() -> None:
    rows = (
        *({"a": name, "land": land, "kg": 2} for name, land in ("xA", "yB", "zA")),
        {"a": "Summe", "land": "", "kg": 6},
        {"a": "w", "land": "", "kg": 0},
    )
    read = read_chart(ChartOptions(data=rows, size_by="kg", by="land", label_by="a"))
    assert [sum("Summe" in one for one in read.notices), len(read.notices)] == [1, 2]

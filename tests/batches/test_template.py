"""Cells in recipes: typed where they stand alone, text inside a text, left out where empty."""

from __future__ import annotations

from datetime import date

import numpy as np
import pytest

from packwork.batches.templates import columns_of, fill_template
from packwork.errors import RecipeError


@pytest.mark.parametrize(
    ("cell", "value"),
    [
        (" Ann ", "Ann"), ("7", "7"), (7, 7), (7.0, 7), (7.5, 7.5), (np.int64(7), 7),
        (np.float64(7), 7), (True, True), (None, None), ("", None), (float("nan"), None),
        (date(2026, 1, 2), "2026-01-02"),
    ],
)  # fmt: skip
def test_a_cell_that_stands_alone_is_itself(cell: object, value: object) -> None:
    assert fill_template("{a}", {"a": cell}) == value


def test_a_number_inside_a_text_is_as_people_write_it() -> None:
    assert fill_template("text:{a} of {b}", {"a": 7.0, "b": np.float64(2.5)}) == "text:7 of 2.5"


def test_doubled_braces_are_braces() -> None:
    assert fill_template("{{a}} {a}", {"a": 1}) == "{a} 1"
    assert list(columns_of("{{a}} {b}")) == ["b"]


def test_an_empty_cell_leaves_out_its_option_and_its_item() -> None:
    template = {"seed": "{a}", "items": ["star", "{a}"], "words": {"source": "{b}"}}
    assert fill_template(template, {"a": "", "b": "x"}) == {
        "items": ["star"],
        "words": {"source": "x"},
    }


def test_an_empty_cell_inside_a_text_is_named() -> None:
    with pytest.raises(RecipeError, match=r"^name: is empty in this row"):
        fill_template("text:{name}", {"name": None})


def test_a_cell_is_not_looked_through_for_columns() -> None:
    assert fill_template("text:{a}", {"a": "{b}", "b": "no"}) == "text:{b}"

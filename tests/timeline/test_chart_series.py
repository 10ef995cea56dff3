"""Charts step by step: areas at one scale, keys alike, marks of one name in their places."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.timeline.film import filmed
from packwork.timeline.solve import solved
from packwork.timeline.step import chart_steps

LANDS = {"Peru": "arabica", "Kenya": "arabica", "Togo": "robusta", "Laos": "robusta",
         "Cuba": "arabica", "Mali": "robusta", "Fiji": "arabica", "Oman": "excelsa"}  # fmt: skip


def harvests(steps: int = 4) -> list[dict[str, Any]]:
    """Lands of which some are missing in some years, and amounts that drift."""
    rng = np.random.default_rng(2)
    logs = np.linspace(1.4, 0.0, len(LANDS))
    rows = []
    for year in range(steps):
        logs = logs + 0.2 * rng.normal(size=len(LANDS))
        for k, (land, sort) in enumerate(LANDS.items()):
            if (k + year) % 5:
                t = round(float(np.exp(logs[k])), 3)
                rows.append({"year": 2000 + year, "land": land, "sort": sort, "t": t})
    return rows


ASKED = {"size_by": "t", "label_by": "land", "color_by": "sort", "seed": 1}


@pytest.fixture(scope="module")
def made() -> pw.Series:
    return pw.chart_series("circle", harvests(), "year", title="Harvest of {year}", **ASKED)


def test_areas_are_true_at_one_scale_and_each_step_is_certified(made: pw.Series) -> None:
    assert made.labels == ("2000", "2001", "2002", "2003")
    assert made.report["certified"]
    shares = [
        area / item.datum.row["t"]
        for layout in made
        for area, item in zip(layout.areas, layout.items, strict=True)
    ]
    assert np.ptp(shares) < 1e-9 * shares[0]
    assert all(pw.measure(layout)["exact"]["OO"] == 0 for layout in made)
    rows = [row for layout in made for row in [item.datum.row for item in layout.items]]
    assert sorted(map(str, rows)) == sorted(map(str, harvests()))


def test_marks_of_one_name_stay_and_keep_their_colours(made: pw.Series) -> None:
    # Two places of a disc are 0.45 of its width apart on average.
    assert made.report["moved"]["median"] < 0.45 / 3
    colours: dict[str, set[str]] = {}
    for layout in made:
        frame = layout.to_dataframe()
        for land, colour in zip(frame["land"], frame["color"], strict=True):
            colours.setdefault(LANDS[land], set()).add(colour)
    assert [len(found) for found in colours.values()] == [1, 1, 1]


def test_keys_are_alike_in_all_steps_and_a_title_names_its_own(made: pw.Series) -> None:
    said = [{note.says for note in layout.notes if not note.is_on_item} for layout in made]
    titles = [f"Harvest of {label}" for label in made.labels]
    assert all(title in one for title, one in zip(titles, said, strict=True))
    keys = [one - set(titles) for one in said]
    assert all(one == keys[0] for one in keys)
    assert {"arabica", "robusta", "excelsa"} <= keys[0]
    # A film shows all steps: no title holds for all.
    assert not {note.says for note in made.film.notes} & set(titles)
    assert keys[0] <= {note.says for note in made.film.notes}


def test_a_step_alone_is_what_its_recipe_says(made: pw.Series) -> None:
    recipe = made["2001"].manifest["recipe"]
    assert len(recipe["chart"]["data"]) == len(made["2001"].items)
    assert recipe["chart"]["by"] is None


def test_marks_without_names_are_told_apart_by_what_they_look_like() -> None:
    rows = [{"year": y, "kind": k} for y, kinds in ((1, "aab"), (2, "abb")) for k in kinds]
    steps = chart_steps("circle", rows, "year", color_by="kind")
    first, second = (set(step.names) for step in steps)
    assert len(first) == len(second) == 3
    assert len(first & second) == 2


def test_steps_of_numbers_go_together() -> None:
    rows = [{"year": year, "n": 1 + year % 3} for year in range(1990, 2010)]
    steps = chart_steps("circle", rows, "year", size_by="n", by_step=10)
    assert [(step.label, len(step.names)) for step in steps] == [("1990s", 10), ("2000s", 10)]


def test_a_film_shows_no_mark_where_it_is_not() -> None:
    steps = chart_steps("circle", harvests(2), "year", **ASKED)
    layout = filmed(solved(steps))
    gone = set(steps[0].names) - set(steps[1].names)
    assert gone
    assert layout.leaving is not None
    assert len(layout.leaving.items) == len(gone)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"series": "land"}, "series"),
        ({"finish": "none"}, "finish: has no meaning in a series"),
    ],
)
def test_what_a_series_cannot_keep_is_one_line(options: dict[str, Any], said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.chart_series("circle", harvests(2), "year", **options)


@pytest.mark.parametrize(
    ("container", "by", "said"),
    [
        ("none", "year", "container: none shows groups as bars; a series needs a container"),
        ("circle", "month", "month"),
        ("circle", "same", "says one step"),
    ],
)
def test_steps_that_cannot_be_are_one_line(container: str, by: str, said: str) -> None:
    rows = [{**row, "same": 1} for row in harvests(2)]
    with pytest.raises(RecipeError, match=said):
        pw.chart_series(container, rows, by, size_by="t")

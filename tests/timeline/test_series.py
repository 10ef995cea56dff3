"""Series: sizes true on one scale, each step certified, words where they were."""

from __future__ import annotations

import json
import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.readers.words.table import in_order, named_column, read_word_steps
from packwork.timeline.film import filmed
from packwork.timeline.solve import outwards, solved
from packwork.timeline.step import word_steps

ANIMALS = ["bear", "fox", "owl", "hare", "lynx", "stork", "badger", "otter", "toad", "wren", "mole"]


def years(steps: int = 4, words: int = 8) -> dict[str, dict[str, float]]:
    """Weights that drift, of words that come and go."""
    rng = np.random.default_rng(0)
    logs = np.linspace(1.5, 0, len(ANIMALS))
    found = {}
    for year in range(steps):
        logs = logs + 0.5 * rng.normal(size=len(logs))
        top = np.argsort(-logs)[:words]
        found[str(2000 + year)] = {ANIMALS[k]: float(np.exp(logs[k])) for k in top}
    return found


@pytest.fixture(scope="module")
def made() -> pw.Series:
    return pw.series("circle", years(), seed=1)


def test_each_step_is_certified_and_sizes_are_true_on_one_scale(made: pw.Series) -> None:
    assert made.labels == ("2000", "2001", "2002", "2003")
    assert made.report["certified"]
    scales = [
        layout.poses.scale[k] / words[item.name]
        for layout, words in zip(made, years().values(), strict=True)
        for k, item in enumerate(layout.items)
    ]
    assert np.ptp(scales) < 1e-9 * scales[0]
    assert all(pw.measure(layout)["exact"]["OO"] == 0 for layout in made)


def test_words_stay_about_where_they_are_and_keep_their_colour(made: pw.Series) -> None:
    # Two places of a disc are 0.45 of its width apart on average.
    assert made.report["moved"]["median"] < 0.45 / 3
    for before, after in pairwise(made):
        fills = [
            {item.name: re.findall(r'fill="(#\w+)"', item.art.markup) for item in one.items}
            for one in (before, after)
        ]
        shared = fills[0].keys() & fills[1].keys()
        assert len(shared) >= 5
        assert all(fills[0][name] == fills[1][name] for name in shared)


def test_the_same_table_gives_the_same_series(made: pw.Series) -> None:
    again = pw.series("circle", years(), seed=1)
    assert all((a.poses.x == b.poses.x).all() for a, b in zip(made, again, strict=True))


def test_a_film_shows_each_step_and_nothing_of_what_is_not_there(made: pw.Series) -> None:
    film = filmed(made._solved)
    assert film.track is not None
    assert film.leaving is not None
    last = {item.name for item in film.items}
    assert last == set(years()["2003"])
    assert {item.name for item in film.leaving.items} == {
        name for words in years().values() for name in words
    } - last
    first = {item.name: k for k, item in enumerate(film.items)}
    scales = film.track.at(0.0).scale
    assert {name for name, k in first.items() if scales[k] > 0} == last & set(years()["2000"])
    assert (film.leaving.at(1.0).scale == 0).all()
    assert film.leaving.at(0.0).scale.max() > 0


def test_files_of_steps_are_written_and_named_by_their_column(
    made: pw.Series, tmp_path: Path
) -> None:
    assert made.column == "step"
    files = made.save(tmp_path / "{step}.svg")
    assert [path.name for path in files] == ["2000.svg", "2001.svg", "2002.svg", "2003.svg"]
    made.save_sheet(tmp_path / "all.png")
    with Image.open(tmp_path / "all.png") as sheet:
        assert sheet.height > 250
    made.film.save_film(tmp_path / "film.svg", fps=2, seconds=2, film_pixels=64)
    assert (tmp_path / "film.svg").read_text(encoding="utf-8").count("@keyframes") >= 8
    with pytest.raises(RecipeError, match="names not each step's file"):
        made.save(tmp_path / "all.svg")


def test_both_orders_of_steps_give_a_series() -> None:
    steps = word_steps("circle", years(3, 5))
    assert solved(steps, "first").is_as_asked
    assert [pair for pair, _ in outwards(1, 3)] == [1, 2, 0]


def test_rows_and_tables_of_steps_are_read(tmp_path: Path) -> None:
    rows = [
        {"year": year, "word": word, "n": n} for year, words in years().items()
        for word, n in words.items()
    ]  # fmt: skip
    file = tmp_path / "t.json"
    file.write_text(json.dumps(rows), encoding="utf-8")
    read = read_word_steps(str(file), "year")
    assert read.weights == years()
    assert len(pw.series("circle", rows[:16], "year")) == 2
    assert in_order(["10", "9"]) == ["9", "10"]
    assert named_column("C:\\x.csv:year") == ("C:\\x.csv", "year")


@pytest.mark.parametrize(
    ("table", "options", "kind", "said"),
    [
        ({"1": {"a": 1}}, {}, RecipeError, "fewer than two"),
        ({"1": {}, "2": {"a": 1}}, {}, RecipeError, "no weights by word"),
        ({"1": {"a": 0}, "2": {"a": 1}}, {}, PackworkError, "no weights by word of the step '1'"),
        (years(), {"sizes": "graded"}, RecipeError, "sizes: has no meaning in a series"),
        (years(), {"repeat": "auto"}, RecipeError, "repeat: has no meaning"),
        ("none.csv", {}, ReadError, "none.csv"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(
    table: Any, options: dict[str, Any], kind: type, said: str
) -> None:
    with pytest.raises(kind, match=said) as caught:
        pw.series("circle", table, **options)
    assert "\n" not in str(caught.value)

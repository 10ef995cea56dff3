"""Data frames come back with the index that they had."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import shapely

import packwork as pw

pandas = pytest.importorskip("pandas")

QUICK: dict[str, Any] = {"size_by": "kg", "epochs": 25, "levels": "50"}
INDEXES: dict[str, Callable[[], Any]] = {
    "names": lambda: pandas.Index(["fig", "kiwi", "lime"], name="fruit"),
    "without a name": lambda: pandas.Index(["fig", "kiwi", "lime"]),
    "texts that are numbers": lambda: pandas.Index(["1", "2", "3"], name="code"),
    "numbers of rows": lambda: pandas.Index([5, 2, 9]),
    "fractions": lambda: pandas.Index([0.5, 1.5, 2.5], name="year"),
    "days": lambda: pandas.DatetimeIndex(["2024-01-01", "2024-01-05", "2025-01-01"], name="day"),
    "hours of a zone": lambda: pandas.DatetimeIndex(["2024-01-01"] * 3, tz="Europe/Zurich"),
    "several": lambda: pandas.MultiIndex.from_tuples(
        [("a", 1), ("a", 2), ("b", 1)], names=["land", "port"]
    ),
}


def frame_of(index: Any) -> Any:
    return pandas.DataFrame({"kg": [3.0, 1.0, 2.0]}, index=index)


@pytest.mark.parametrize("index", INDEXES.values(), ids=INDEXES)
def test_an_index_is_an_index_again(index: Callable[[], Any], tmp_path: Path) -> None:
    frame = frame_of(index())
    layout = pw.chart("circle", frame, **QUICK)
    layout.save(tmp_path / "chart.geojson")
    for one in (layout, pw.Layout.load(tmp_path / "chart.geojson")):
        made = one.to_dataframe()
        pandas.testing.assert_index_equal(made.index, frame.index)
        assert made["kg"].tolist() == frame["kg"].tolist()
        assert made.columns[0] == "kg"


def test_marks_are_joined_to_the_rows_they_stand_for() -> None:
    frame = frame_of(INDEXES["names"]())
    marks = pw.chart("circle", frame, unit=1, **QUICK).to_dataframe()
    assert marks.index.value_counts().to_dict() == {"fig": 3, "kiwi": 1, "lime": 2}
    assert frame.join(marks[["x", "y"]]).shape == (6, 3)


def test_rows_that_were_filtered_keep_their_numbers() -> None:
    frame = frame_of(None)
    made = pw.chart("circle", frame[frame["kg"] > 1], **QUICK).to_dataframe()
    assert made.index.tolist() == [0, 2]
    whole = pw.chart("circle", frame, **QUICK).to_dataframe()
    assert (whole.index.tolist(), whole.columns[0]) == ([0, 1, 2], "kg")


def test_words_are_no_numbers_of_rows() -> None:
    counts = pandas.DataFrame({"word": ["owl", "fox", "bear"], "n": [3, 9, 5]})
    for frame in (counts.sort_values("n"), counts[counts["n"] > 3]):
        layout = pw.words("circle", frame, min_count=1, epochs=25, levels="50")
        assert {item.name for item in layout.items} == set(frame["word"])


def test_an_index_of_an_unknown_type_is_one_of_texts() -> None:
    recipe = pw.chart("circle", frame_of(INDEXES["names"]()), **QUICK).manifest["recipe"]
    asked = {**recipe, "chart": {**recipe["chart"], "index": {"fruit": "no such type"}}}
    assert pw.run(asked).to_dataframe().index.tolist() == ["fig", "kiwi", "lime"]


class Rows:
    """As GeoPandas gives a frame to others: geometries, and an index."""

    def __init__(self, index: Any, bare: int = -1) -> None:
        self.index, self._bare = index, bare

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        shapes = [shapely.box(0, 0, 2 + k, 1) for k in range(len(self.index))]
        geometries = [None if k == self._bare else shape for k, shape in enumerate(shapes)]
        return {
            "type": "FeatureCollection",
            "features": [
                {"type": "Feature", "id": str(label), "properties": {}, "geometry": geometry}
                for label, geometry in zip(self.index, geometries, strict=True)
            ],
        }


@pytest.mark.parametrize("index", INDEXES.values(), ids=INDEXES)
def test_rows_of_geometries_keep_their_labels(index: Callable[[], Any]) -> None:
    labels = index()
    layout = pw.fill("circle", Rows(labels), count=4, epochs=25, levels="50")
    made = pickle.loads(pickle.dumps(layout)).to_dataframe()  # noqa: S301
    pandas.testing.assert_index_equal(made.index, labels[[0, 1, 2, 0]])


def test_rows_without_area_shift_no_labels() -> None:
    rows = Rows(pandas.Index(["Thun", "Zug", "Sils"]), bare=1)
    made = pw.fill("circle", [*pw.read_items(rows), "star"], epochs=25, levels="50").to_dataframe()
    assert made.index.tolist()[:2] == ["Thun", "Sils"]
    assert made.index.isna().tolist() == [False, False, True]


def test_rows_that_are_only_counted_have_no_labels() -> None:
    assert pw.read_items(Rows(pandas.RangeIndex(3)))[0].row is None


def test_rows_of_geopandas_keep_their_labels() -> None:
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame(
        geometry=[shapely.box(0, 0, 2, 1), shapely.box(0, 0, 3, 1)],
        index=pandas.Index(["Thun", "Zug"], name="lake"),
    )
    for items in (frame, [row for _, row in frame.iterrows()], list(frame.itertuples())):
        made = pw.fill("circle", items, epochs=25, levels="50").to_dataframe()
        assert made.index.tolist() == ["Thun", "Zug"]
    assert frame.join(pw.fill("circle", frame, epochs=25).to_dataframe()[["x"]]).shape == (2, 2)

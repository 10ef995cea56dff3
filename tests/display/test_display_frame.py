"""Layouts as data frames: rows go with their marks, whatever became of the others."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork.errors import PackworkError

QUICK: dict[str, Any] = {"epochs": 20, "levels": "32", "effort": "draft"}
ROWS = {
    "land": ["Peru", "Fiji", "Kenya", "Mali"],
    "kg": [25.0, 0.0, 10.0, 4.0],
    "kind": ["x", "x", "y", ""],
    "x": [1, 2, 3, 4],
}


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.chart("circle", ROWS, size_by="kg", color_by="kind", label_by="land", **QUICK)


def test_each_mark_has_its_row_and_its_pose(layout: pw.Layout) -> None:
    frame = layout.to_dataframe()
    assert frame["land"].tolist() == ["Peru", "Kenya", "Mali"]
    assert (frame["area"] / frame["kg"]).to_numpy() == pytest.approx(frame["area"][0] / 25.0)
    assert frame["x"].tolist() == [1, 3, 4]
    assert frame["mark_x"].tolist() == layout.poses.x.tolist()
    assert frame["category"].tolist() == ["x", "y", "no value"]
    assert len(set(frame["color"])) == 3


def test_parts_of_a_row_add_up_to_it() -> None:
    frame = pw.chart("circle", ROWS, size_by="kg", unit=10, **QUICK).to_dataframe()
    assert len(frame) == 5
    assert frame.groupby("land")["value"].sum().to_dict() == {"Peru": 25, "Kenya": 10, "Mali": 4}


def test_rows_stay_with_their_marks_when_some_are_taken_out(layout: pw.Layout) -> None:
    kept = np.array([2, 0])
    fewer = replace(
        layout,
        items=tuple(layout.items[k] for k in kept),
        poses=layout.poses.subset(kept),
        weights=layout.weights[kept],
    )
    assert fewer.to_dataframe()["land"].tolist() == ["Mali", "Peru"]


def test_a_file_brings_the_rows_back(layout: pw.Layout, tmp_path: Path) -> None:
    layout.save(tmp_path / "chart.geojson")
    frame, again = layout.to_dataframe(), pw.Layout.load(tmp_path / "chart.geojson").to_dataframe()
    assert list(again) == list(frame)
    for name in ("land", "kg", "kind", "value", "category"):
        assert again[name].equals(frame[name])
    assert again["mark_x"].to_numpy() == pytest.approx(frame["mark_x"].to_numpy())


def test_what_is_no_row_of_a_mark_is_refused(layout: pw.Layout, tmp_path: Path) -> None:
    file = tmp_path / "chart.geojson"
    layout.save(file)
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace('"datum":{"row":{', '"datum":{"raw":{', 1), encoding="utf-8")
    with pytest.raises(
        pw.ReadError, match=r"features\[1\].datum.row: must be an object with a row; there is none"
    ):
        pw.Layout.load(file)


def test_numbers_of_a_text_file_are_numbers(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("land,kg,code\nPeru,2,01\nKenya,,2\n", encoding="utf-8")
    frame = pw.chart("circle", str(file), **QUICK).to_dataframe()
    assert frame["kg"].tolist()[0] == 2.0
    assert np.isnan(frame["kg"].tolist()[1])
    assert frame["code"].tolist() == ["01", "2"]


def test_numbers_as_other_languages_write_them_are_numbers(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("land;t\nPeru;1.250,5\nKenya;2,5\nFiji;3\n", encoding="utf-8-sig")
    frame = pw.chart("circle", str(file), size_by="t", **QUICK).to_dataframe()
    assert dict(zip(frame["land"], frame["t"], strict=True)) == {
        "Peru": 1250.5,
        "Kenya": 2.5,
        "Fiji": 3,
    }


def test_a_layout_that_is_no_chart_has_poses_alone() -> None:
    layout = pw.fill("circle", ["star", "heart"], count=3, **QUICK)
    frame = layout.to_dataframe()
    assert list(frame) == [
        "item", "source", "x", "y", "angle_deg", "scale", "stretch", "area", "weight", "color",
    ]  # fmt: skip
    assert frame["item"].tolist() == ["star", "heart", "star"]
    assert np.radians(frame["angle_deg"].to_numpy()) == pytest.approx(layout.poses.angle)


@pytest.mark.parametrize(
    ("show", "message"),
    [
        ("to_dataframe", r'needs pandas.* pip install "packwork\[data\]"'),
        ("plot", r'needs matplotlib.* pip install "packwork\[plot\]"'),
    ],
)
def test_what_is_not_installed_is_named(
    show: str, message: str, layout: pw.Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(sys.modules, "matplotlib.patches", raising=False)
    for package in ("pandas", "matplotlib"):
        monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(PackworkError, match=message):
        getattr(layout, show)()

"""Containers of too many vertices are refused before any stage begins."""

from __future__ import annotations

import json
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

import packwork as pw

MANY = 501_000
"""Little more than the bounds of drawings and of outlines."""


@pytest.fixture(autouse=True)
def no_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is placed or measured."""

    def refused(*_: object, **__: object) -> None:
        pytest.fail("a stage began")

    monkeypatch.setattr(import_module("packwork.pipeline.run"), "run_steps", refused)
    monkeypatch.setattr(import_module("packwork.metrics.measure"), "exact_metrics", refused)


def ring() -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, MANY, endpoint=False)
    return 300 + 300 * np.column_stack([np.cos(angle), np.sin(angle)])


def test_given_in_python() -> None:
    container = pw.Container("ring", outline=ring(), width=600, height=600)
    with pytest.raises(pw.ReadError, match="ring: has 501,000 points, more than 400,000"):
        pw.fill(container, ["star"], count=3)


def test_drawn_in_an_svg(tmp_path: Path) -> None:
    file = tmp_path / "stairs.svg"
    path = "M0 0" + "h1v1" * (MANY // 2) + "z"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{path}"/></svg>', encoding="utf-8"
    )
    with pytest.raises(pw.ReadError, match="more than 500,000 segments"):
        pw.fill(str(file), ["star"], count=3)


def test_of_a_layout_that_is_measured(tmp_path: Path) -> None:
    corners = [*ring().round(3).tolist(), [600.0, 300.0]]
    geometry = {"type": "Polygon", "coordinates": [corners]}
    feature = {"type": "Feature", "properties": {"role": "container"}, "geometry": geometry}
    file = tmp_path / "ring.geojson"
    file.write_text(
        json.dumps({"type": "FeatureCollection", "features": [feature]}), encoding="utf-8"
    )
    with pytest.raises(pw.ReadError, match="has 501,001 points, more than 400,000"):
        pw.measure(file)

"""Layouts on Matplotlib axes: paths enclose what is drawn, holes and all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import packwork as pw

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
pyplot = pytest.importorskip("matplotlib.pyplot")

QUICK: dict[str, Any] = {"epochs": 20, "levels": "32", "effort": "draft"}


def area(patch: Any) -> float:
    """Signed shoelace area of all rings of a path."""
    vertices, codes = patch.get_path().vertices, patch.get_path().codes
    begins = np.flatnonzero(codes == patch.get_path().MOVETO)
    total = 0.0
    for ring in np.split(vertices, begins[1:]):
        x, y = ring.T
        total += 0.5 * float((x[:-1] * y[1:] - x[1:] * y[:-1]).sum())
    return total


def test_each_item_is_a_path_of_its_ink_in_its_colour() -> None:
    layout = pw.fill("circle", ["heart", "star"], count=4, palette="#ff0000", **QUICK)
    ax = layout.plot()
    assert [area(patch) for patch in ax.patches] == pytest.approx([ink.area for ink in layout.inks])
    assert {patch.get_facecolor() for patch in ax.patches} == {(1.0, 0.0, 0.0, 1.0)}
    assert (ax.get_aspect(), ax.yaxis_inverted()) == (1.0, True)
    assert ax.get_xlim() == (0.0, layout.container.width)
    pyplot.close("all")


def test_it_draws_on_axes_that_are_given_and_leaves_holes_free() -> None:
    figure, (left, right) = pyplot.subplots(1, 2)
    layout = pw.fill("circle", ["builtin:ring", "circle"], count=2, **QUICK)
    assert layout.plot(ax=right) is right
    assert len(left.patches) == 0
    ring = right.patches[0]
    assert area(ring) < layout.areas[0]
    figure.canvas.draw()
    middle = right.transData.transform((layout.poses.x[0], layout.poses.y[0]))
    column, row = np.floor(middle).astype(int)
    pixels = np.asarray(figure.canvas.buffer_rgba())
    assert pixels[len(pixels) - 1 - row, column].tolist() == [255, 255, 255, 255]
    pyplot.close("all")


def test_numbers_of_a_chart_have_a_colour_bar() -> None:
    rows = {"heat": [30, "", -10, 10]}
    ax = pw.chart("circle", rows, color_by="heat", palette=["#000000", "#c80000"], **QUICK).plot()
    bar = ax.figure.axes[1]
    assert bar.get_ylabel() == "heat"
    shades = bar.collections[-1]
    assert shades.get_clim() == (-10, 30)
    own = [patch.get_facecolor() for patch in ax.patches]
    assert np.allclose(shades.to_rgba([30, -10, 10]), [own[0], own[2], own[3]], atol=0.01)
    for same in ([5, 5], ["a", "b"]):
        assert (
            len(pw.chart("circle", {"heat": same}, color_by="heat", **QUICK).plot().figure.axes)
            == 1
        )
    pyplot.close("all")


def test_categories_of_a_chart_have_keys() -> None:
    rows = {"kind": ["a", "b", "a", "a"]}
    ax = pw.chart("circle", rows, color_by="kind", **QUICK).plot()
    assert ax.get_legend_handles_labels()[1] == ["a", "b"]
    assert pw.fill("circle", "star", count=2, **QUICK).plot().get_legend_handles_labels()[1] == []
    pyplot.close("all")

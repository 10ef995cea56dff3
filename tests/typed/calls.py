"""Calls as people write them; those marked ``wrong`` are what type checkers have to refuse.

Nothing here is run: ``test_types.py`` shows the file to mypy and to pyright.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, assert_type

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

import packwork as pw


def right(names: list[str], weights: dict[str, float], turns: list[int]) -> None:
    layout = pw.fill("heart", ["star", Path("a.svg")], count=40, sizes="shared", seed=3)
    pw.fill(np.ones((9, 9), dtype=bool), "star", count="auto", padding="1mm", rotate=(0, 90))
    pw.fill("heart", names, rotate=turns, weights=weights, palette=names, filler=names)
    pw.fill("heart", losses={"overlap": 2.0, far: 1.0}, target_coverage="94%", levels=(50, 200))
    pw.fill("heart", losses={"overlap": 2.0}, effort="best", time=9, canvas=300, record=True)
    pw.fill("heart", rules=[{"items": "star", "count": 3, "pin": {"x": "50%", "size": 30}}])
    pw.fill("heart", history=True)
    pw.photos("heart", "sea.jpg", record=True, history=10)
    pw.words("heart", weights, fonts="own.ttf", color_by=lambda word: None, background="ivory")
    pw.words("heart", "a text", fonts=names, stopwords={"a", "the"}, largest="48pt")
    pw.photos("heart", ["sea.jpg"], shape="rounded:20%", edge="crop", least_dpi=150)
    pw.chart("circle", {"kg": [3, 1]}, size_by="kg", mark=names, legend=False)
    pw.pile("square", "circle", count=3, size="30%", open="top", force=["down", "left"])
    pw.fill("heart", seed=None, palette=[(1.0, 0.0, 0.0)], weights=[1, 2], best_of=3)
    pw.fill("heart", seed=np.random.default_rng(), hero=pw.Hero("owl", x=0.5, y=0.4))
    pw.fill("heart", force=[pw.Force("down", strength=2), "left"], palette={"a": (1, 0, 0)})
    pw.chart("circle", {"kg": [3, 1]}, size_by=np.ones(2), color_by=["a", "b"])
    layout.save("a.png", pixels=300, background=None, halo="faint")
    layout.save_film("a.gif", fps=12, easing="linear", background="white")
    assert_type(layout, pw.Layout)
    assert_type(layout.metrics, pw.Metrics)
    assert_type(layout.metrics["LC"], float)
    assert_type(layout.metrics["exact"]["min_gap"], float)
    assert_type(layout.plot(), Axes)
    assert_type(pw.read_items("star"), list[pw.Item])
    assert_type(pw.read_container("heart"), pw.Container)
    assert_type(pw.__version__, str)
    assert_type(layout.history, pw.History | None)
    assert_type(pw.measure(layout), pw.Metrics)
    assert_type(pw.finish(layout), pw.Layout)
    assert_type([placed.name for placed in layout], list[str])
    assert_type(layout[0], pw.Placement)
    assert_type(layout[1:], pw.Layout)
    assert_type(layout.metrics["coverage"], float)


def far(density: npt.NDArray[Any], container: npt.NDArray[Any]) -> pw.Term:
    return pw.Term(0.0, density if density.any() else container)


def wrong(layout: pw.Layout) -> None:
    pw.fill("heart", cuont=3)  # wrong
    pw.fill("heart", count="many")  # wrong
    pw.fill("heart", sizes="equal")  # wrong
    pw.fill("heart", seed="1")  # wrong
    pw.fill("heart", filler=3)  # wrong
    pw.fill("heart", size_by="kg")  # wrong
    pw.fill("heart", rules=[{"items": "star", "cuont": 3}])  # wrong
    pw.fill("heart", rules=[{"count": 3}])  # wrong
    pw.fill("heart", 7)  # wrong
    pw.fill("heart", history="all")  # wrong
    pw.fill("heart", observer=3)  # wrong
    pw.finish("heart")  # wrong
    pw.fill(None)  # wrong
    pw.words("heart", "a text", stretch=1.5)  # wrong
    pw.words("heart", "a text", case="title")  # wrong
    pw.photos("heart", "sea.jpg", palette="ink")  # wrong
    pw.chart("circle", {"kg": [1]}, count=3)  # wrong
    pw.pile("square", "circle", effort="best")  # wrong
    pw.fil("heart")  # wrong
    layout.save("a.svg", pixls=300)  # wrong
    layout.save_film("a.gif", easing="bouncy")  # wrong
    layout.metrics["covered"]  # wrong
    layout.plot().no_such_method()  # wrong

"""The same words lead to the same layout, typed or called from Python."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from packwork.options import Verbs
from packwork.recipe.verbs import VERBS

TABLE = "name,n\nash,3\nelm,2\noak,1\n"

FEW: dict[str, Any] = {"levels": "40", "epochs": 10, "seed": 3}


def in_python(verb: str) -> pw.Layout:
    """Layout of each verb, from Python."""
    calls: dict[str, Callable[[], pw.Layout]] = {
        "fill": lambda: pw.fill("heart", "star", count=4, effort="draft", **FEW),
        "words": lambda: pw.words("heart", "words.csv", effort="draft"),
        "chart": lambda: pw.chart("heart", "table.csv", size_by="n", effort="draft"),
        "pile": lambda: pw.pile("square", "star", count=4, size="20%", seed=3),
    }
    return calls[verb]()


LINES = {
    "fill": "fill heart star -n 4 --levels 40 --epochs 10 --seed 3 --effort draft",
    "words": "words heart words.csv --effort draft",
    "chart": "chart heart table.csv --size-by n --effort draft",
    "pile": "pile square star -n 4 --size 20% --seed 3",
}


@pytest.mark.parametrize("verb", list(LINES))
def test_a_command_line_and_python_give_one_layout(verb: str, packwork: Callable[..., Any]) -> None:
    Path("table.csv").write_text(TABLE, encoding="utf-8")
    Path("words.csv").write_text("ash,3\nelm,2\n", encoding="utf-8")
    assert packwork(f"{LINES[verb]} -o typed.geojson -q").exit_code == 0
    typed, called = pw.Layout.load("typed.geojson"), in_python(verb)
    assert typed.manifest["start"] == called.manifest["start"]
    for name in ("x", "y", "angle", "scale"):
        np.testing.assert_allclose(getattr(typed.poses, name), getattr(called.poses, name))


def test_each_verb_is_compared() -> None:
    # Photographs need files, and have no defaults of their own but one of a rule of turns.
    assert {one.name.lower() for one in VERBS if one is not Verbs.PHOTOS} == set(LINES)

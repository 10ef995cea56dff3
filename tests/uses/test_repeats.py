"""Words set again in what is left: smaller, grey, clear of all others, which stay as they are."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import packwork as pw
from packwork.readers.words.items import EM_PX
from packwork.uses.words.graded import LEGIBLE
from packwork.uses.words.repeats import AT_LEAST, REPEATED

WEIGHTS = {"honey": 8.0, "bear": 5.0, "bee": 3.0, "wood": 2.0, "fox": 1.0}
RED = "#ff0000"
QUICK = {"effort": "draft", "rotate": "mixed", "seed": 1}


@cache
def repeated(sizes: str) -> pw.Layout:
    return pw.words(
        "heart",
        WEIGHTS,
        sizes=sizes,
        repeat="auto",
        palette=RED,
        **QUICK,  # type: ignore[arg-type]
    )


@pytest.mark.parametrize("sizes", ["graded", "shared"])
def test_words_are_repeated_smaller_where_nothing_else_fits(sizes: str) -> None:
    alone = pw.words("heart", WEIGHTS, sizes=sizes, palette=RED, **QUICK)  # type: ignore[arg-type]
    layout = repeated(sizes)
    if sizes == "graded":
        _tells_of_the_words_themselves(layout)
    count = len(WEIGHTS)
    assert layout.manifest["certified"]
    assert len(alone.items) == count < len(layout.items) <= count + AT_LEAST
    assert np.array_equal(layout.poses.scale[:count], alone.poses.scale)
    own = dict(zip(WEIGHTS, alone.poses.scale, strict=True))
    for item, scale in zip(layout.items[count:], layout.poses.scale[count:], strict=True):
        assert scale <= REPEATED * own[item.name] * (1 + 1e-9)
        assert scale * EM_PX >= LEGIBLE * layout.container.side * (1 - 1e-9)
    assert layout.metrics["LC"] > alone.metrics["LC"]


def test_the_words_keep_their_colours_and_copies_are_grey() -> None:
    layout = repeated("graded")
    fills = [item.art.markup.split('fill="')[1].split('"')[0] for item in layout.items]
    assert set(fills[: len(WEIGHTS)]) == {"#ff0000"}
    [grey] = set(fills[len(WEIGHTS) :])
    assert grey != "#ff0000"
    dark = pw.words("heart", WEIGHTS, repeat="auto", background="black", **QUICK)
    [light] = {item.art.markup.split('fill="')[1].split('"')[0] for item in dark.items[5:]}
    assert int(light[1:3], 16) > 64


def _tells_of_the_words_themselves(layout: pw.Layout) -> None:
    of_true = layout.manifest["words"]["of_true"]
    heights = np.array(list(WEIGHTS.values()))
    expected = layout.poses.scale[:5] / layout.poses.scale[0] / (heights / heights[0])
    assert list(of_true.values()) == pytest.approx(expected.tolist(), abs=1e-4)
    assert layout.manifest["filling"]["added"] == len(layout.items) - 5

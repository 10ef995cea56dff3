"""Words set again in what is left: smaller, grey, clear of all others, which stay as they are."""

from __future__ import annotations

from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork import uses
from packwork.readers.container import read_container
from packwork.readers.words.items import read_word_items
from packwork.readers.words.shaping import EM_PX
from packwork.uses.icons import KnownContainer
from packwork.uses.words.copies import for_letters
from packwork.uses.words.graded import LEGIBLE
from packwork.uses.words.recipe import words_recipe
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


NAMES = dict.fromkeys(("Anna", "Ben", "Clara", "David", "Emma", "Hugo"), 1.0)


def test_letters_can_be_read_of_few_words_of_one_weight() -> None:
    once = pw.words("text:GO", NAMES, repeat="none", **QUICK)  # type: ignore[arg-type]
    run = uses.fill(words_recipe("text:GO", NAMES, **QUICK))
    layout = run.layout
    count = Counter(item.name for item in layout.items)
    assert len(once.items) == len(count) == len(NAMES)
    assert min(count.values()) > 5
    assert layout.manifest["certified"]
    assert run.metrics.seen.bare < 0.05 < once.metrics["bare"]
    [said] = [one for one in run.remarks if "repeat" in one]
    assert said.startswith(f"6 words are repeated, {len(layout.items)} in all")


@pytest.mark.parametrize(
    ("container", "weights", "asked", "is_repeated"),
    [
        ("text:GO", NAMES, {}, True),
        ("circle", NAMES, {}, False),
        ("text:GO", WEIGHTS, {}, False),
        ("text:GO", NAMES, {"repeat": "none"}, False),
        ("text:GO", NAMES, {"max_items": 8}, False),
        ("text:GO", NAMES, {"hero": "Anna"}, False),
        ("text:GO", NAMES, {"add": ["star"]}, False),
    ],
)
def test_words_are_repeated_only_where_letters_need_it(
    container: str, weights: dict[str, float], asked: dict[str, Any], is_repeated: bool
) -> None:
    recipe = words_recipe(container, weights, **asked)
    assert recipe.words is not None
    read = read_word_items(recipe.words)
    found = for_letters(read, recipe, KnownContainer(read_container(container)))
    assert (len(found.items) > len(weights)) == is_repeated


def test_photos_without_a_number_show_letters(tmp_path: Path) -> None:
    files = [str(tmp_path / f"{k}.png") for k in range(3)]
    for k, file in enumerate(files):
        Image.new("RGB", (40, 30), (60 * k, 90, 160)).save(file)
    tried: list[tuple[str, dict[str, Any]]] = [
        ("text:GO", {}), ("text:GO", {"count": 3}), ("circle", {})
    ]  # fmt: skip
    counts = [
        len(pw.photos(container, files, finish="none", epochs=1, **asked).items)
        for container, asked in tried
    ]
    assert counts[0] > 20
    assert counts[1:] == [3, 3]

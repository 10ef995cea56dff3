"""Runs that put like items together: icons by vectors, words by their text, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import cKDTree

import packwork as pw
from packwork.arrays import IntArray
from packwork.errors import ReadError, RecipeError
from packwork.readers.words.cooccurrence import (
    cooccurrence_vectors,
    information,
    pairs_within,
    places_of,
    vectors_of,
)
from packwork.readers.words.word import Word
from packwork.scene.swatch import representative_colour

QUICK = {"levels": "60", "epochs": 60, "effort": "draft", "seed": 0}
QUICKEST = {**QUICK, "levels": "16", "epochs": 2, "finish": "none"}
"""Of runs that are held against each other."""
NAMES = ("star", "moon", "heart", "owl", "fish", "cloud")


@pytest.fixture
def kinds(tmp_path: Path) -> str:
    """A table that finds the first three of the icons alike, and the others."""
    rows = [f"{name},{int(k < 3)},{int(k >= 3)},{0.01 * k}" for k, name in enumerate(NAMES)]
    (tmp_path / "kinds.csv").write_text("name,a,b,c\n" + "\n".join(rows), encoding="utf-8")
    return str(tmp_path / "kinds.csv")


def _alike(layout: pw.Layout, kinds: IntArray, nearest: int = 4) -> float:
    """Share of the nearest items that are of an item's kind."""
    points = np.column_stack([layout.poses.x, layout.poses.y])
    found = cKDTree(points).query(points, nearest + 1)[1][:, 1:]
    return float((kinds[found] == kinds[:, None]).mean())


def _kinds(layout: pw.Layout) -> IntArray:
    return np.array([NAMES.index(item.name) // 3 for item in layout.items])


@pytest.mark.parametrize(("sizes", "seeds"), [("free", 3), ("shared", 1)])
def test_like_icons_lie_together(kinds: str, sizes: str, seeds: int) -> None:
    shares, covered = [], []
    for seed in range(seeds):
        plain, alike = (
            pw.fill(
                "circle", list(NAMES), count=24, sizes=sizes, embeddings=file,
                **{**QUICK, "seed": seed},
            )
            for file in (None, kinds)
        )  # fmt: skip
        assert alike.manifest["certified"]
        shares.append([_alike(one, _kinds(one)) for one in (plain, alike)])
        covered.append(alike.metrics["exact"]["LC"] / plain.metrics["exact"]["LC"])
    assert np.subtract(*np.median(shares, axis=0)) < 0
    # Likeness costs little of the room.
    assert np.median(covered) > 4 / 5


def test_planted_clusters_lie_together(tmp_path: Path) -> None:
    """By chance one neighbour in five is of an item's own."""
    kinds = np.arange(60) % 5
    rng = np.random.default_rng(0)
    vectors = rng.standard_normal((5, 20))[kinds] + 0.3 * rng.standard_normal((60, 20))
    square = "M0 0H{0}V9H0Z"
    for k in range(60):
        path = (
            f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{square.format(9 + k / 50)}"/></svg>'
        )
        (tmp_path / f"{k:03}.svg").write_text(path, encoding="utf-8")
    layout = pw.fill("circle", tmp_path, embeddings=vectors, **QUICK)
    assert layout.manifest["certified"]
    assert _alike(layout, kinds, 5) > 3 / 5


def test_a_run_repeats(kinds: str) -> None:
    first, second = (
        pw.fill("circle", list(NAMES), count=12, embeddings=kinds, **QUICK) for _ in range(2)
    )
    assert np.array_equal(first.poses.x, second.poses.x)


def test_a_palette_tells_clusters(kinds: str) -> None:
    layout = pw.fill(
        "circle", list(NAMES), count=24, embeddings=kinds, palette="#aa0000,#0000aa", shades="tint",
        **QUICK,
    )  # fmt: skip
    of_kind = [set(), set()]
    for item, kind in zip(layout.items, _kinds(layout), strict=True):
        of_kind[kind].add(representative_colour(item)[1:3] > representative_colour(item)[5:7])
    assert sorted(map(len, of_kind)) == [1, 1]
    assert of_kind[0] != of_kind[1]


def test_items_without_a_row_are_told_and_placed(tmp_path: Path) -> None:
    (tmp_path / "some.csv").write_text("name,a,b\nstar,1,0\nmoon,0,1\n", encoding="utf-8")
    layout = pw.fill(
        "circle", ["star", "moon", "owl"], count=9, embeddings=str(tmp_path / "some.csv"), **QUICK
    )
    assert len(layout.items) == 9
    assert "1 item has no row (owl)" in str(layout.manifest["skipped"])


def test_pinned_items_stay(kinds: str) -> None:
    rules = [{"items": "owl", "count": 1, "pin": {"x": "50%", "y": "50%"}}]
    layout = pw.fill("circle", list(NAMES), count=18, rules=rules, embeddings=kinds, **QUICK)
    owl = next(k for k, item in enumerate(layout.items) if item.name == "owl")
    assert layout.poses.x[owl] == pytest.approx(layout.container.width / 2)


SEA = ("sea", "ship", "sails", "wind", "waves", "harbour", "anchor", "captain")
BREAD = ("bread", "butter", "coffee", "breakfast", "honey", "kitchen", "table", "knife")


def test_words_that_stand_together_lie_together() -> None:
    rng = np.random.default_rng(0)
    said = [" ".join(rng.permutation(kind)) for _ in range(20) for kind in (SEA, BREAD)]
    # More words that say nothing than a window is wide.
    text = "\n".join(f"{line}. And it is as it was and so it is as it was and so." for line in said)
    near = []
    for asked in (None, "auto"):
        layout = pw.words("circle", text, embeddings=asked, effort="draft", seed=0)
        assert layout.manifest["certified"]
        at_sea = np.array([int(item.name in SEA) for item in layout.items])
        known = np.array([item.name in SEA + BREAD for item in layout.items])
        assert known.all()
        near.append(_alike(layout, at_sea, 3))
    assert near[1] > near[0]


@pytest.mark.parametrize(
    ("options", "error", "said"),
    [
        ({"embeddings": "auto"}, RecipeError, "auto is of words of a text"),
        ({"embeddings": "missing.npy"}, ReadError, "missing.npy"),
        ({"embeddings": ""}, RecipeError, "is an empty name"),
    ],
)
def test_icons_without_vectors(options: dict[str, str], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        pw.fill("circle", "star", count=3, **options, **QUICK)


def test_words_of_a_table_have_no_text() -> None:
    with pytest.raises(RecipeError, match="a table does not tell"):
        pw.words("circle", {"bear": 2, "fox": 1}, embeddings="auto", effort="draft")
    with pytest.raises(RecipeError, match="no two of these words together more than once"):
        pw.words("circle", "one owl saw two bears", embeddings="auto", effort="draft")


def test_photos_by_choice_lie_by_colour_alone(tmp_path: Path, kinds: str) -> None:
    for name in NAMES:
        Image.new("RGB", (20, 20), "teal").save(tmp_path / f"{name}.png")
    Image.fromarray(np.tile(np.arange(0, 255, 5, dtype=np.uint8), (51, 1))).save(tmp_path / "p.png")
    options = {"picture": str(tmp_path / "p.png"), "embeddings": kinds}
    with pytest.raises(RecipeError, match="picture puts them where their colours fit"):
        pw.photos("square", str(tmp_path / "*o*.png"), **options, **QUICK)


def test_charts_and_piles_are_refused(kinds: str) -> None:
    with pytest.raises(RecipeError, match="puts like items together in a collage"):
        pw.chart("circle", [{"kg": 1}, {"kg": 2}], size_by="kg", embeddings=kinds)


def test_pairs_against_a_slow_count() -> None:
    rng = np.random.default_rng(0)
    places = rng.integers(-1, 4, 60)
    slow = np.zeros((4, 4))
    for first in range(60):
        for second in range(first + 1, min(first + 6, 60)):
            a, b = places[first], places[second]
            if a >= 0 and b >= 0 and a != b:
                slow[a, b] += 1
                slow[b, a] += 1
    assert np.array_equal(pairs_within(places, 4, 5), slow)


def test_products_of_vectors_are_near_the_information() -> None:
    pairs = np.array([[0.0, 6, 2, 0], [6, 0, 2, 0], [2, 2, 0, 4], [0, 0, 4, 0]])
    shared = information(pairs)
    vectors = vectors_of(shared)
    off = ~np.eye(4, dtype=bool)
    assert np.corrcoef((vectors @ vectors.T)[off], shared[off])[0, 1] > 0.9


def test_phrases_and_plurals_are_found() -> None:
    words = [Word("White Rabbit", 2.0), Word("queen", 1.0)]
    text = [["the", "white", "rabbit", "and", "Queens"], ["White", "Rabbit", "queen"]]
    assert places_of(text, [word.text for word in words], 2).tolist() == [
        -1,
        0,
        -1,
        -1,
        1,
        0,
        -1,
        1,
    ]
    assert cooccurrence_vectors(text * 2, words, 2).shape[0] == 2


WEIGHTS = {"fox": 1, "bear": 5, "owl": 2, "Moose": 4, "hare": 3, "moose": 1}
"""Neither by weight nor by name, and two that become one in lower case."""


@pytest.mark.parametrize("options", [{}, {"count": 3}, {"case": "lower"}, {"stopwords": ["owl"]}])
def test_rows_without_names_are_those_of_the_words_as_given(
    tmp_path: Path, options: dict[str, Any]
) -> None:
    rows = np.random.default_rng(1).normal(size=(len(WEIGHTS), 3))
    lines = [f"{word},{weight}" for word, weight in WEIGHTS.items()]
    (tmp_path / "words.csv").write_text("word,weight\n" + "\n".join(lines), encoding="utf-8")
    by_name = dict(zip(WEIGHTS, rows, strict=True))
    if options.get("case") == "lower":
        # Of words that become one, the first has the row.
        del by_name["moose"]
    named = pw.words("circle", WEIGHTS, embeddings=by_name, **options, **QUICKEST)
    for source in (WEIGHTS, str(tmp_path / "words.csv")):
        given = pw.words("circle", source, embeddings=rows, **options, **QUICKEST)
        assert np.array_equal(given.poses.x, named.poses.x)


def test_rows_of_what_is_not_placed_are_passed_over() -> None:
    rows = np.random.default_rng(1).normal(size=(len(NAMES), 3))
    by_name = dict(zip(NAMES, rows, strict=True))
    named, given = (
        pw.fill("circle", list(NAMES), count=4, embeddings=one, **QUICKEST)
        for one in (by_name, rows)
    )
    assert np.array_equal(given.poses.x, named.poses.x)


def test_items_among_words_have_the_last_rows() -> None:
    rows = np.random.default_rng(1).normal(size=(len(WEIGHTS) + 1, 3))
    by_name = dict(zip([*WEIGHTS, "star"], rows, strict=True))
    named, given = (
        pw.words("circle", WEIGHTS, add="star", embeddings=one, **QUICKEST)
        for one in (by_name, rows)
    )
    assert np.array_equal(given.poses.x, named.poses.x)


def test_rows_without_names_and_words_without_an_order() -> None:
    with pytest.raises(ReadError, match="has 2 rows, and there are 6 items"):
        pw.words("circle", WEIGHTS, embeddings=np.eye(2), **QUICK)
    with pytest.raises(ReadError, match="rows without names, and words of a text"):
        pw.words("circle", "one owl saw one bear", embeddings=np.eye(4), **QUICK)
    session = pw.words("circle", WEIGHTS, **QUICK).edit()
    with pytest.raises(ReadError, match="rows without names, and words of a text or a session"):
        session.embeddings(np.eye(len(WEIGHTS)))

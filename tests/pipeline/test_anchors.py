"""Anchors: what is like a row, a column or a word lies in its direction."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError

QUICK = {"levels": "60", "epochs": 60, "effort": "draft", "seed": 0}
NAMES = ("star", "moon", "heart", "owl", "fish", "cloud")


@pytest.fixture
def kinds(tmp_path: Path) -> str:
    """Three icons that are warm and three that are cold; a row of what is none of them."""
    rows = [f"{name},{int(k < 3)},{int(k >= 3)}" for k, name in enumerate(NAMES)]
    (tmp_path / "kinds.csv").write_text(
        "\n".join(["name,warm,cold", *rows, "ice,0,1"]), encoding="utf-8"
    )
    return str(tmp_path / "kinds.csv")


def middles(layout: pw.Layout) -> tuple[np.ndarray, np.ndarray]:
    """Mean place of what is warm and of what is cold, from the container's middle."""
    points = np.column_stack([layout.poses.x, layout.poses.y]) - 0.5 * layout.container.width
    warm = np.array([NAMES.index(item.name) < 3 for item in layout.items])
    return points[warm].mean(axis=0), points[~warm].mean(axis=0)


@pytest.mark.parametrize(
    ("side", "axis", "sign"), [("left", 0, -1), ("right", 0, 1), ("up", 1, -1), ("90deg", 1, 1)]
)
def test_what_is_like_a_column_lies_there(kinds: str, side: str, axis: int, sign: int) -> None:
    layout = pw.fill(
        "circle", list(NAMES), count=24, embeddings=kinds, anchors=f"{side}=warm", **QUICK
    )
    assert layout.manifest["certified"]
    warm, cold = middles(layout)
    # Two halves of a disc are 0.42 apart, those of what is mixed about 0.
    assert sign * (warm - cold)[axis] > 0.15 * layout.container.width


def test_rows_that_are_no_items_may_be_named_and_the_middle(kinds: str) -> None:
    ratios = []
    for name in ("ICE", "warm"):
        layout = pw.fill(
            "circle", list(NAMES), count=60, embeddings=kinds, anchors=f"middle={name}", **QUICK
        )
        points = np.column_stack([layout.poses.x, layout.poses.y]) - 0.5 * layout.container.width
        away = np.hypot(*points.T)
        cold = np.array([NAMES.index(item.name) >= 3 for item in layout.items])
        ratios.append(away[cold].mean() / away[~cold].mean())
    assert ratios[0] < ratios[1]


def test_words_of_a_text_are_drawn_to_sides() -> None:
    rng = np.random.default_rng(0)
    kinds = (
        ("sea", "ship", "sails", "wind", "waves", "harbour", "anchor", "captain"),
        ("bread", "butter", "coffee", "breakfast", "honey", "kitchen", "table", "knife"),
    )
    said = [" ".join(rng.permutation(kind)) for _ in range(20) for kind in kinds]
    text = "\n".join(f"{line}. And it is as it was and so it is as it was and so." for line in said)
    asked = ("right=ship", "left=bread")
    layout = pw.words("circle", text, embeddings="auto", anchors=asked, effort="draft", seed=0)
    at_sea = np.array([item.name in kinds[0] for item in layout.items])
    assert layout.poses.x[at_sea].mean() > layout.poses.x[~at_sea].mean()


@pytest.mark.parametrize(
    ("anchors", "said"),
    [
        ("warm", "anchors: nothing lies 'warm'; use right, down, left, up, 45deg, middle, as in"),
        ("left=", "anchors: 'left=' names nothing; write it as left=warm"),
        ("left=hot", r"anchors: .*kinds\.csv has no 'hot'; there are warm, cold"),
    ],
)
def test_what_is_no_anchor_is_one_line(kinds: str, anchors: str, said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.fill("circle", list(NAMES), count=6, embeddings=kinds, anchors=anchors, **QUICK)


def test_anchors_without_vectors_are_refused() -> None:
    with pytest.raises(RecipeError, match="anchors: are of vectors"):
        pw.fill("circle", "star", count=3, anchors="left=warm", **QUICK)

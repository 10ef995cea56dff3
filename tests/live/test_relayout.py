"""All put anew: in an order, by likeness, under a picture; what is held stays where it is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork import PackworkError, RecipeError

SEA = [
    "ocean",
    "ship",
    "whale",
    "sail",
    "harpoon",
    "deck",
]
KITCHEN = [
    "bread",
    "butter",
    "cheese",
    "oven",
    "flour",
    "sugar",
]


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("square", ["star", "heart", "circle"], count=24, effort="draft", levels="60")


def covered(layout: pw.Layout) -> float:
    return float(layout.areas.sum() / layout.container.outline.area)


def test_items_are_put_in_an_order_and_undo_brings_the_old_one_back(layout: pw.Layout) -> None:
    session = layout.edit()
    session.arrange("right by=name")
    session.settle()
    now = session.layout
    assert session.is_certified
    middles = [
        now.poses.x[[item.name == name for item in now.items]].mean()
        for name in ("circle", "heart", "star")
    ]
    assert middles == sorted(middles)
    session.undo()
    np.testing.assert_array_equal(session.layout.poses.x, layout.poses.x)


def test_the_others_lie_about_what_is_held(layout: pw.Layout) -> None:
    held = layout.edit()
    held.hold("heart#2")
    free = layout.edit()
    for session in (held, free):
        session.arrange("outwards by=name")
        session.settle()
        assert session.is_certified
    (row,) = held.find("heart#2")
    for name in ("x", "y", "angle", "scale"):
        assert getattr(held.layout.poses, name)[row] == getattr(layout.poses, name)[row]
    # No room is kept where the run would have put it.
    assert covered(held.layout) > 0.8 * covered(free.layout)


def test_what_is_held_where_it_has_no_room_is_told_when_all_settle(layout: pw.Layout) -> None:
    session = layout.edit()
    (number,) = session.find("star#1")
    session.move(number, 3, 3)
    session.hold(number)
    session.arrange("down by=name")
    session.settle()
    assert any("star sticks out" in line for line in session.in_the_way)


def test_like_things_come_together(layout: pw.Layout) -> None:
    vectors = {"star": [1.0, 0.0], "heart": [0.98, 0.1], "circle": [0.0, 1.0]}
    session = layout.edit()
    session.embeddings(vectors, anchors="right=circle")
    session.settle()
    assert session.is_certified
    poses, is_disc = session.layout.poses, [i.name == "circle" for i in session.layout.items]
    assert poses.x[is_disc].mean() > poses.x[~np.array(is_disc)].mean() + 50


def apartness(layout: pw.Layout) -> float:
    """How far words of different kinds are from each other, over how far those of one are."""
    points = np.column_stack([layout.poses.x, layout.poses.y])
    far = np.linalg.norm(points[:, None] - points, axis=2)
    is_sea = np.array([item.name in SEA for item in layout.items])
    alike = is_sea[:, None] == is_sea
    return float(far[~alike].mean() / far[alike & (far > 0)].mean())


def test_words_come_together_by_their_text(tmp_path: Path) -> None:
    text = tmp_path / "text.txt"
    plain, together = [], []
    for seed in range(3):
        rng = np.random.default_rng(seed)
        told = [rng.choice(group, 200) for group in (SEA, KITCHEN)]
        text.write_text(" ".join(np.concatenate(told)), encoding="utf-8")
        session = pw.words("circle", text, seed=seed, effort="draft", levels="60").edit()
        plain.append(apartness(session.layout))
        session.embeddings("auto")
        session.settle()
        assert session.is_certified
        together.append(apartness(session.layout))
    # By chance they come nearer, too, but not by that.
    assert np.mean(together) > 1.05 * np.mean(plain)


def test_a_picture_is_shown_by_colours_alone(layout: pw.Layout) -> None:
    session = layout.edit()
    session.picture(np.linspace([0.1] * 3, [0.9] * 3, 64)[None].repeat(64, axis=0))
    colours = [item.art.fill for item in session.layout.items]  # type: ignore[union-attr]
    darkest = min(range(24), key=lambda k: colours[k])
    assert session.layout.poses.x[darkest] < layout.container.width / 2
    np.testing.assert_array_equal(session.layout.poses.x, layout.poses.x)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda s: s.arrange("right by=size"), "nothing is measured by 'size'"),
        (lambda s: s.embeddings("auto"), "auto is for words of a text; give a file of vectors"),
        (lambda s: s.embeddings({"owl": [1, 2]}), "embeddings"),
        (lambda s: s.embeddings("no-such.csv"), "no-such.csv"),
        (lambda s: s.embeddings({"star": [1, 2]}, anchors="over=star"), "nothing lies 'over'"),
        (lambda s: s.picture("no-such.png"), "no-such.png"),
    ],
)
def test_what_has_no_meaning_changes_nothing(layout: pw.Layout, ask, message: str) -> None:
    session = layout.edit()
    before = session.document
    with pytest.raises(PackworkError) as refused:
        ask(session)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)
    assert session.document is before


def test_an_order_by_files_or_unknown_ways_is_refused_as_in_a_run(layout: pw.Layout) -> None:
    with pytest.raises(RecipeError, match="there is no way 'sideways'"):
        layout.edit().arrange("sideways by=name")

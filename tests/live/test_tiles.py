"""Tiles under the hand: what is dragged over the edge comes in again, certified on the torus."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.geometry.lattice import Lattice
from packwork.live.commands.command import named_container
from packwork.live.document import Document
from packwork.live.relayout import poured_again
from packwork.metrics.torus import torus_metrics
from packwork.metrics.violations import ViolationSet, violations_on_torus
from packwork.scene.container import tiled

KINDS = ["square", "half-drop", "hexagon"]


@cache
def made(kind: str) -> pw.Layout:
    return pw.fill(
        "page",
        ["leaf", "flower", "bird"],
        count=14,
        tile=kind,
        effort="draft",
        levels="50,100",
        padding="0.7%",
    )


def lattice_of(document: Document) -> Lattice:
    assert document.container.lattice is not None
    return document.container.lattice


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_dragged_over_the_edge_comes_in_again_and_neighbours_there_make_room(
    kind: str, same: Callable[[pw.Poses, pw.Poses], bool]
) -> None:
    session = made(kind).edit()
    before, cell = session.document, lattice_of(session.document)
    k = int(before.poses.x.argmax())
    number, x, y = int(before.ids[k]), float(before.poses.x[k]), float(before.poses.y[k])
    session.do("grab", items=[number])
    for step in range(1, 5):
        session.move(number, x + step * cell.width / 12, y)
        session.flow(epochs=6)
    session.do("drop")
    assert session.settle().certified
    assert not session.unmet
    now = session.document
    asked = cell.wrapped(np.array([[x + cell.width / 3, y]]))[0]
    assert (now.poses.x[k], now.poses.y[k]) == pytest.approx(tuple(asked))
    assert (now.poses.x >= 0).all()
    assert (now.poses.x < cell.width).all()
    # Somebody on the other side has moved, and judges that share no code with what did it agree.
    others = np.flatnonzero(now.poses.x != before.poses.x)
    assert (before.poses.x[others] < cell.width / 2).any()
    assert not violations_on_torus(now.layout.outlines, cell, now.options.padding)
    assert torus_metrics(now.layout.outlines, cell).overlap_area == 0
    while session.is_rough:
        session.polish(48)
    assert session.is_certified
    assert session.document.areas.sum() > 0.95 * before.areas.sum()
    assert session.undo()
    assert same(session.document.poses, before.poses)


def test_conflicts_over_the_edge_are_found_as_items_move() -> None:
    layout = made("half-drop")
    cell = lattice_of(Document.from_layout(layout))
    standing = ViolationSet(layout.container.outline, 3.0, cell)
    rng = np.random.default_rng(0)
    outlines = list(layout.outlines)
    standing.change(dict(enumerate(outlines)))
    for _ in range(20):
        k = int(rng.integers(len(outlines)))
        shift = rng.uniform(-80, 80, 2)
        outlines[k] = outlines[k].mapped(np.array([[1.0, 0, shift[0]], [0, 1.0, shift[1]]]))
        standing.change({k: outlines[k]})
        expected = violations_on_torus(outlines, cell, 3.0)
        assert [(v.item, v.other) for v in standing.violations] == [
            (v.item, v.other) for v in expected
        ]
        for mine, theirs in zip(standing.violations, expected, strict=True):
            assert mine.overlap_cu2 == pytest.approx(theirs.overlap_cu2, abs=1e-6)
            assert mine.gap_cu == pytest.approx(theirs.gap_cu, abs=1e-6)


def test_a_tile_is_kept_poured_anew_and_goes_on_as_a_recipe(tmp_path: Path) -> None:
    session = made("hexagon").edit()
    session.add("star")
    assert session.finish().certified
    session.hold(2)
    before = session.document
    session.save(tmp_path / "paper.packwork")
    again = pw.Session.open(tmp_path / "paper.packwork")
    assert lattice_of(again.document) == lattice_of(before)
    assert again.is_certified
    again.apply(poured_again(again.document, 3))
    assert again.settle().certified
    now = again.document
    assert (now.poses.x[2], now.poses.y[2]) == (before.poses.x[2], before.poses.y[2])
    assert (now.poses.x != before.poses.x).any()
    layout = pw.run(session.recipe(tmp_path / "again").file)
    assert layout.certified
    assert layout.container.lattice == lattice_of(before)
    assert len(layout) == len(before)


def test_a_collage_becomes_a_tile_and_what_a_tile_has_not_is_said() -> None:
    session = pw.fill("heart", ["star", "bolt"], count=12, effort="draft").edit()
    page = session.document.container
    sheet = pw.fill("page", "star", count=1, effort="draft", canvas=f"{page.side}px").container
    tile = named_container(session.library, tiled(sheet, "square"))
    session.do("set_container", asset=tile)
    session.apply(poured_again(session.document, 0))
    assert session.settle().certified
    assert session.document.kind.name == "tile"
    refused = "a tile goes on over its edge: it has no"
    with pytest.raises(RecipeError, match=refused):
        session.do("place_container", x=3.0)
    with pytest.raises(RecipeError, match=refused):
        session.set(force=("down",))
    piled = pw.pile("square", ["star"], count=5, size="14%", effort="draft").edit()
    tile = named_container(piled.library, tiled(sheet, "square"))
    with pytest.raises(RecipeError, match="tile: has no edge, which a pile would need"):
        piled.do("set_container", asset=tile)

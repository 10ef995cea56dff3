from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from packwork.geometry.outline import Outline
from packwork.metrics.exact import exact_coverage
from packwork.metrics.measure import measure
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from scenes import box, square, square_container


def drilled(hole: float) -> Item:
    """Square of side 2 of which a smaller one in the middle is not drawn."""
    ink = shapely.difference(shapely.box(-1, -1, 1, 1), shapely.box(-hole, -hole, hole, hole))
    return Item("drilled", "drilled", square(), Outline.from_region(ink), FlatArt())


def layout_of(items: list[Item], *places: tuple[float, float, float]) -> Layout:
    x, y, scale = np.array(places).T
    poses = Poses(x, y, np.linspace(0.0, 1.0, len(items)), scale)
    return Layout(square_container(), tuple(items), poses, np.ones(len(items)))


@pytest.mark.parametrize(
    "places",
    [
        ((30.0, 30, 4), (60.0, 60, 9), (60.0, 20, 2)),
        ((30.0, 30, 4), (33.0, 33, 4), (60.0, 60, 9)),
        ((30.0, 30, 4), (60.0, 60, 9), (5.0, 50, 4)),
    ],
    ids=["clean", "overlapping", "outside"],
)
def test_ink_is_what_is_drawn_within_the_container(
    places: tuple[tuple[float, float, float], ...],
) -> None:
    layout = layout_of([drilled(0.5), drilled(0.5), drilled(0.2)], *places)
    expected = exact_coverage(layout.inks, layout.container.outline)
    assert measure(layout).ink == pytest.approx(expected, rel=1e-12)


def test_ink_with_its_holes_filled_needs_no_look(monkeypatch: pytest.MonkeyPatch) -> None:
    layout = layout_of([drilled(0.5)], (30.0, 30, 4))
    expected = measure(layout).ink
    item = layout.items[0]
    filled = replace(item, outline=Outline.from_rings(item.ink.solid_rings))
    monkeypatch.setattr(shapely.Polygon, "covers", lambda *_: pytest.fail("it looked"))
    assert measure(replace(layout, items=(filled,))).ink == pytest.approx(expected, rel=1e-12)


def test_ink_that_leaves_its_outline_counts_once_where_it_meets_other_ink() -> None:
    wide = Item("wide", "wide", square(), box(-3, -1, 3, 1), FlatArt())
    layout = layout_of([wide, wide], (30.0, 30, 3), (40.0, 30, 3))
    assert measure(layout).exact.is_clean
    expected = exact_coverage(layout.inks, layout.container.outline)
    assert measure(layout).ink == pytest.approx(expected, rel=1e-12)


def test_ink_in_a_container_that_crosses_itself_is_a_share_of_what_it_encloses() -> None:
    bow_tie = Outline.from_rings([np.array([[0.0, 0], [100, 100], [100, 0], [0, 100]])])
    layout = layout_of([drilled(0.5)], (20.0, 50.0, 2.0))
    crossing = replace(layout, container=replace(layout.container, outline=bow_tie))
    assert measure(crossing).ink == pytest.approx(exact_coverage(crossing.inks, bow_tie))

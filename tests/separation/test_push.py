"""Parts are pushed together: left and up until they meet, never over one another."""

import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import Polygon, box

from packwork.separation.push import pushed
from packwork.separation.shapes import Floats


def _moved(regions: list[Polygon], ways: Floats) -> list[Polygon]:
    return [shapely.transform(one, lambda at, by=by: at + by)
            for one, by in zip(regions, ways, strict=True)]  # fmt: skip


def test_rows_close_up_and_what_is_held_stays() -> None:
    parts = [box(3, 1, 7, 3), box(10, 1, 14, 3), box(3, 7, 7, 9), box(12, 7, 16, 9)]
    ways = pushed(parts, box(0, 0, 20, 10), [box(0, 0, 1, 2.5)])
    moved = [one.bounds for one in _moved(parts, ways)]
    assert moved == [(1, 0, 5, 2), (5, 0, 9, 2), (0, 2.5, 4, 4.5), (4, 2, 8, 4)]


def test_slants_and_holes_stop_what_meets_them() -> None:
    frame = box(0, 0, 10, 10).difference(box(2, 2, 8, 8))
    wedge, peg = Polygon([(12, 0), (16, 0), (16, 4)]), box(5, 5, 6, 6)
    ways = pushed([frame, peg, wedge], box(0, 0, 30, 10))
    assert ways.tolist() == [[0, 0], [-3, -3], [-2, 0]]
    hide = Polygon([(0, 10), (10, 0), (30, 0), (30, 10)])
    ((x, y),) = pushed([box(20, 4, 22, 6)], hide)
    assert (20 + x) + (4 + y) >= 10 - 1e-9
    assert y == 0 or x < 0


@settings(deadline=None, max_examples=40)
@given(st.data())
def test_nothing_overlaps_or_leaves_and_all_is_stopped(data: st.DataObject) -> None:
    parts = list[Polygon]()
    for column in range(3):
        for row in range(3):
            corners = st.tuples(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))
            a, b, c, d = data.draw(corners)
            x, y = 2.0 * column, 2.0 * row
            parts.append(Polygon([(x + a, y), (x + 1, y + b), (x + c, y + 1), (x, y + d)]))
    parts = [one for one in parts if one.is_valid and one.area > 0.05]
    ground = box(0, 0, 6, 6)
    ways = pushed(parts, ground)
    moved = _moved(parts, ways)
    assert (ways <= 0).all()
    for k, one in enumerate(moved):
        assert shapely.difference(one, ground).area < 1e-9
        assert all(shapely.intersection(one, other).area < 1e-9 for other in moved[:k])
    if parts:
        assert min(one.bounds[0] for one in moved) < 1e-9
        assert min(one.bounds[1] for one in moved) < 1e-9

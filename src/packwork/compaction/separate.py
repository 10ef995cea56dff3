"""Separation: layouts with conflicts to layouts without, by shrinking and relocating items.

Z. Li and V. Milenkovic (1995, see :mod:`packwork.compaction`) separate overlapping polygons of
fixed sizes by the least motion. Ours shrinks items in conflict a little at a time, so that none
has to move, and relocates those that would become too small to the largest voids; compaction lets
them grow again. The centre of a void is that of the largest empty circle (G. Toussaint, "Computing
largest empty circles with location constraints", International Journal of Computer and Information
Sciences 12 (1983), 347-358), read from a distance transform and not from a Voronoi diagram.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import BoolArray, FloatArray, Image, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels import trials
from packwork.compaction.kernels.steps import LEAST_GROWTH
from packwork.compaction.options import HOPELESS
from packwork.fields.voids import Clearance, largest_voids
from packwork.raster.coverage import TOUCHED, coverage

CUT = 0.004
"""Logarithm of size that an item in conflict loses at a time. Larger gives room away, smaller needs
more checks. Tried."""

HASTE = 1.03
"""Factor on that loss with each further check, once it has made items hopeless that often, so that
even hopeless layouts come to an end. Chosen."""

MOST_CHECKS = 400
"""Checks at most; what is in conflict after them is reported."""

RESCUES = 2
"""Times that items which are still in conflict then are moved to voids. Chosen."""

HOPELESS_SHARE = 0.1
"""Share of the items that may be in conflict all the same and the finish go on. Larger goes on
without hope, smaller gives up too early. Chosen."""

EVENINGS = 6
"""Times that all come down to the smallest; more gain nothing. Tried."""


def separate(
    arrangement: Arrangement,
    gap: float,
    hopeless_at: float = HOPELESS,
    hurries: Callable[[], bool] = bool,
) -> IntArray:
    """Make items in conflict smaller until none is; ``(m,)`` indices of the items that were moved.

    Only items in conflict change. Some conflicts may be left, if the container has no room at all.
    ``hopeless_at``: logarithm of size that an item loses before one is moved to a void;
    ``hurries``: asked before each check, once it is so, items lose more at a time.

    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
    >>> two = Arrangement([box] * 2, wall, np.array([[0.0, 0, 0, 0], [1.9, 0, 0, 0]]))
    >>> moved = separate(two, 0.01)
    >>> len(moved), len(two.conflicts(two.pairs(1.0), 0.01))
    (0, 0)
    """
    first = arrangement.places[:, 3].copy()
    moved: list[int] = []
    near = arrangement.pairs(gap)
    hurried, patience = 0, round(RESCUES * HOPELESS / CUT)
    for check in range(MOST_CHECKS):
        bad = arrangement.conflicts(near, gap)
        if len(bad) == 0:
            break
        items = _items(bad, arrangement.count)
        places = arrangement.places[items]
        if (places[:, 3] <= LEAST_GROWTH).all():
            break
        if hurries():
            places[:, 3] -= trials.CUT * 2.0**hurried
            hurried += 1
        else:
            places[:, 3] -= CUT * HASTE ** max(check - patience, 0)
        places[:, 3] = np.maximum(places[:, 3], LEAST_GROWTH)
        arrangement.put(items, places)
        worn = arrangement.places[:, 3] < first - hopeless_at
        if worn.any() and len(hopeless := _smaller_of(bad, worn, arrangement)):
            relocate(arrangement, hopeless, gap)
            first[hopeless] = arrangement.places[hopeless, 3]
            moved += hopeless.tolist()
        # All in conflict have changed: no other pair can be in one now.
        has_changed = np.zeros(arrangement.count + 1, dtype=bool)
        has_changed[items] = True
        changed = has_changed[arrangement.owners]
        near = arrangement.pairs(gap)
        near = near[changed[near].any(axis=1)]
    return np.unique(np.array(moved, dtype=np.int64))


def relocate_stuck(
    arrangement: Arrangement, gap: float, hurries: Callable[[], bool] = bool
) -> bool:
    """Relocate items still in conflict to voids and separate again; whether few are left."""
    for _ in range(RESCUES):
        left = _items(arrangement.conflicts(arrangement.pairs(gap), gap), arrangement.count)
        if len(left) <= HOPELESS_SHARE * arrangement.count:
            return True
        relocate(arrangement, left, gap)
        separate(arrangement, gap, hurries=hurries)
    return False


def separate_evenly(
    arrangement: Arrangement, gap: float, hurries: Callable[[], bool] = bool
) -> None:
    """Make all items smaller until none is in conflict and all have shrunk alike, nearly.

    Where one size is asked for in the end, the few that had to shrink by far would else have to
    grow back through neighbours that lie tight.

    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
    >>> places = np.array([[0.0, 0, 0, 0], [1.9, 0, 0, 0], [6, 6, 0, 0]])
    >>> three = Arrangement([box] * 3, wall, places)
    >>> separate_evenly(three, 0.01)
    >>> bool(np.ptp(three.places[:, 3]) < 0.001)
    True
    """
    separate(arrangement, gap, hurries=hurries)
    all_items = np.arange(arrangement.count)
    for _ in range(EVENINGS):
        places = arrangement.places.copy()
        least = places[:, 3].min()
        if np.ptp(places[:, 3]) == 0:
            return
        places[:, 3] = least
        arrangement.put(all_items, places)
        separate(arrangement, gap, hurries=hurries)


def _items(pairs: IntArray, count: int) -> IntArray:
    is_met = np.zeros(count + 1, dtype=bool)
    is_met[pairs] = True
    return np.flatnonzero(is_met[:count])


def _smaller_of(bad: IntArray, worn: BoolArray, arrangement: Arrangement) -> IntArray:
    """The smaller item of each pair in conflict of which one has shrunk too much."""
    radii = np.append(arrangement.radii, np.inf)
    worn = np.append(worn, False)
    bad = bad[worn[bad].any(axis=1)]
    smaller = np.where(radii[bad[:, 0]] <= radii[bad[:, 1]], bad[:, 0], bad[:, 1])
    return np.unique(smaller)


PIXELS_PER_ITEM = 24.0
"""Pixels of the image of voids along the side of an item's share of the container. More sees
smaller voids and takes longer. Tried."""

ACROSS = 4.0
"""Pixels of that image across the container's mean thickness, at least, or thin lines have no room
at all. Larger takes longer. Chosen."""

LEAST_SIDE, MOST_SIDE = 128, 2_048
"""Bounds of that image's longer side, px. Chosen."""

SNUG = 0.9
"""Radius of an item in a void over the void's. Larger may not fit, smaller has farther to
grow. Chosen."""

SMALLEST_VOID = 0.5
"""Radius of the smallest void that takes an item, px of that image, which is not exact. Chosen."""


def relocate(arrangement: Arrangement, items: IntArray, gap: float) -> None:
    """Move items ``(m,)``, the largest first, smaller but never larger, to the largest voids."""
    others = np.setdiff1d(np.arange(arrangement.count), items)
    room, px_per_cu, corner = free_room(arrangement, others)
    order = items[np.argsort(-arrangement.radii[items], kind="stable")]

    def fitting(radius: float) -> float:
        return max(SNUG * radius / px_per_cu - gap, SNUG * SMALLEST_VOID / px_per_cu)

    for k, x, y, radius in largest_voids(
        room, order, lambda _, radius: fitting(radius) * px_per_cu, least_px=SMALLEST_VOID
    ):
        _, _, turn, growth = arrangement.places[k]
        growth = min(growth, float(np.log(fitting(radius) / arrangement.board.arms[k])))
        place = [corner[0] + x / px_per_cu, corner[1] + y / px_per_cu, turn, growth]
        arrangement.put(np.array([k]), np.array([place]))


def free_room(
    arrangement: Arrangement, items: IntArray
) -> tuple[Clearance, float, tuple[float, float]]:
    """Free room beside ``items`` ``(m,)`` alone; px per canvas unit; the image's corner."""
    left, top, right, bottom = arrangement.container.bounds
    side = max(right - left, bottom - top)
    thickness = 2 * arrangement.container.area / arrangement.container.region.length
    wanted = max(PIXELS_PER_ITEM * np.sqrt(arrangement.count), ACROSS * side / thickness)
    px_per_cu = float(np.clip(wanted, LEAST_SIDE, MOST_SIDE)) / side
    lattice = arrangement.lattice
    margin = round(side * px_per_cu / 2) if arrangement.is_open else 0
    rows, columns = int((bottom - top) * px_per_cu) + 2, int((right - left) * px_per_cu) + 2
    shape = rows + 2 * margin, columns + 2 * margin
    corner = np.array([left, top]) - margin / px_per_cu

    def image(points: FloatArray, starts: IntArray) -> Image:
        return coverage((points - corner) * px_per_cu, starts, shape, np.float32)

    taken = image(*arrangement.rings(items)) if len(items) else np.zeros(shape)
    if lattice is not None and arrangement.is_open:
        room = Clearance(taken < TOUCHED, lattice.neighbours() * px_per_cu, margin)
    else:
        inside = image(arrangement.container.points, arrangement.container.starts)
        room = Clearance((inside > 1 - TOUCHED) & (taken < TOUCHED))
    return room, px_per_cu, (float(corner[0]), float(corner[1]))

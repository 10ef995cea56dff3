"""Omission of items that cannot be certified: they are named, the rest is certified."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.conflicts import Conflict
from packwork.metrics.violations import Violation, violations
from packwork.pipeline.findings import Unplaced
from packwork.scene.item import Item
from packwork.scene.layout import Layout


def left_out(layout: Layout, held: Sequence[bool], gap: float) -> dict[int, str]:
    """Items without which nothing meets or sticks out, and what was wrong with each.

    Of two that meet, the one that more others meet goes; of two alike, the smaller one, but
    none that is held in place.

    Parameters
    ----------
    held
        Whether each item has a place that was asked for.
    gap
        What the rest has to keep, canvas units.
    """
    wrong = violations(layout.outlines, layout.container.outline, gap)
    unit = layout.container.unit
    reasons = {one.item: reason(one, layout.items, unit) for one in wrong if one.other is None}
    areas = layout.areas
    pairs = [one for one in wrong if one.other is not None]
    while pairs := [one for one in pairs if not {one.item, one.other} & reasons.keys()]:
        ends = np.array([(one.item, one.other) for one in pairs], dtype=np.int64)
        met = np.bincount(ends.ravel(), minlength=len(areas))
        worst = min(np.unique(ends).tolist(), key=lambda k: (held[k], -met[k], areas[k], k))
        met_by = next(one for one in pairs if worst in (one.item, one.other))
        reasons[worst] = reason(met_by, layout.items, unit, worst)
    return reasons


def named(reasons: dict[int, str], layout: Layout, numbers: IntArray) -> tuple[Unplaced, ...]:
    """The items that were left out, ``numbers`` ``(n,)`` being those that they were asked under."""
    return tuple(
        Unplaced(layout.items[k].name, int(numbers[k]), reasons[k]) for k in sorted(reasons)
    )


def reason(
    one: Conflict | Violation, items: Sequence[Item], unit: str, item: int | None = None
) -> str:
    """Reason why an item and another one, or the container's edge, are in conflict.

    Parameters
    ----------
    item
        Of which of the two it is said; None for the first.
    """
    other = one.other if item in {None, one.item} else one.item
    if other is None:
        neighbour, how = "the container's edge", "sticks out of the container"
    else:
        neighbour = items[other].name
        how = f"overlaps {neighbour}"
    if one.overlap_cu2 > 0:
        return f"{how} by {one.overlap_cu2:.3g} {unit}²"
    return f"is {one.gap_cu:.3g} {unit} from {neighbour}, nearer than asked"

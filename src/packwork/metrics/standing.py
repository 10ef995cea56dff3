"""A certificate that stands while a layout changes: only what has changed is looked at again."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import valid
from packwork.metrics.violations import Violation, meeting, sticking_out


class Standing:
    """Violations among items that come, go and move, kept as a set; as ``violations`` finds them.

    Shares no code with the finish, nor with what moves the items.

    Parameters
    ----------
    container
        Canvas units.

    Examples
    --------
    >>> def square(x, side):
    ...     return Outline.from_rings([x + side * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])])
    >>> standing = Standing(square(0, 10), 0.5)
    >>> standing.change({7: square(1, 2), 8: square(2, 2), 9: square(6, 2)})
    >>> [(one.item, one.other) for one in standing.violations]
    [(7, 8)]
    >>> standing.change({8: square(9, 2)})
    >>> [(one.item, one.other) for one in standing.violations]
    [(8, None)]
    >>> standing.change({8: None})
    >>> standing.is_clean
    True
    """

    def __init__(self, container: Outline, gap: float) -> None:
        self._whole = valid(container.region)
        shapely.prepare(self._whole)
        self._edge = self._whole.boundary
        shapely.prepare(self._edge)
        self._gap = gap
        self._regions: dict[int, Any] = {}
        self._found: dict[tuple[int, int | None], Violation] = {}

    @property
    def violations(self) -> tuple[Violation, ...]:
        """Conflicts as of now, by the numbers of the items, in their order."""
        return tuple(self._found[key] for key in sorted(self._found, key=_in_order))

    @property
    def is_clean(self) -> bool:
        """Whether nothing is."""
        return not self._found

    def change(self, outlines: Mapping[int, Outline | None]) -> None:
        """Take over items in new places, by number, and forget those that are None."""
        self._found = {
            key: found for key, found in self._found.items()
            if key[0] not in outlines and key[1] not in outlines
        }  # fmt: skip
        changed = []
        for number, outline in outlines.items():
            if outline is None:
                self._regions.pop(number, None)
            else:
                self._regions[number] = valid(outline.region)
                changed.append(number)
        if changed:
            self._look(np.array(changed))

    def _look(self, changed: IntArray) -> None:
        """Note what changed items are in conflict with."""
        numbers = np.array(list(self._regions))
        everything = _array(self._regions.values())
        regions = _array(self._regions[int(k)] for k in changed)
        shapely.prepare(regions)
        tree = shapely.STRtree(everything)
        mine, theirs = tree.query(regions, predicate="dwithin", distance=self._gap)
        for one, other in zip(changed[mine].tolist(), numbers[theirs].tolist(), strict=True):
            i, j = min(one, other), max(one, other)
            if i != j and (i, j) not in self._found:
                self._note(meeting(i, j, self._regions[i], self._regions[j]))
        near = ~shapely.covers(self._whole, regions)
        near |= shapely.dwithin(self._edge, regions, self._gap)
        for k in changed[near].tolist():
            self._note(sticking_out(k, self._regions[k], self._whole, self._gap))

    def _note(self, found: Violation) -> None:
        if found.overlap_cu2 > 0 or found.gap_cu < self._gap:
            self._found[found.item, found.other] = found


def _array(regions: Iterable[Any]) -> npt.NDArray[Any]:
    listed = list(regions)
    array = np.empty(len(listed), dtype=object)
    array[:] = listed
    return array


def _in_order(key: tuple[int, int | None]) -> tuple[int, int]:
    return key[0], -1 if key[1] is None else key[1]

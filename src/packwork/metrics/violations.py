"""Violations: the pairs, by number, that keep a layout from its certificate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import IntArray
from packwork.geometry.distance import distance
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, difference, intersection, part_about, valid
from packwork.metrics.torus import images_about


@dataclass(frozen=True)
class Violation:
    """An item that meets another or is too near to it; the container's edge if ``other`` is None.

    ``overlap_cu2``: area that they share, or that lies outside the container.
    ``gap_cu``: their distance if they share none.
    """

    item: int
    other: int | None
    overlap_cu2: float
    gap_cu: float


def violations(
    outlines: Sequence[Outline], container: Outline, gap: float
) -> tuple[Violation, ...]:
    """Each pair nearer than ``gap``, and each item nearer than that to the edge or beyond it.

    Examples
    --------
    >>> def square(x, side):
    ...     return Outline.from_rings([x + side * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])])
    >>> found = violations([square(1, 2), square(2, 2), square(9, 2)], square(0, 10), 0.5)
    >>> [(one.item, one.other, one.overlap_cu2) for one in found]
    [(0, 1, 1.0), (2, None, 3.0)]
    """
    whole = valid(container.region)
    regions = np.empty(len(outlines), dtype=object)
    regions[:] = [valid(outline.region) for outline in outlines]
    first, second = shapely.STRtree(regions).query(regions, predicate="dwithin", distance=gap)
    pairs = [(int(i), int(j)) for i, j in zip(first, second, strict=True) if i < j]
    shapely.prepare(whole)
    edge = whole.boundary
    shapely.prepare(edge)
    near = ~shapely.covers(whole, regions) | shapely.dwithin(edge, regions, gap)
    found = [meeting(i, j, regions[i], regions[j]) for i, j in pairs]
    found += [sticking_out(int(k), regions[k], whole, gap) for k in np.flatnonzero(near)]
    return tuple(
        one for one in sorted(found, key=lambda one: one.item)
        if one.overlap_cu2 > 0 or one.gap_cu < gap
    )  # fmt: skip


def meeting(i: int, j: int, first: Region, second: Region) -> Violation:
    """Violation of the distance between two regions."""
    shared = float(intersection(first, second).area)
    return Violation(i, j, shared, 0.0 if shared > 0 else distance(first, second))


def sticking_out(k: int, one: Region, whole: Region, gap: float) -> Violation:
    """Violation of the distance of a region to the edge of another, inside it."""
    # What is nearer than asked lies within that gap.
    near = part_about(whole, one, gap)
    outside = float(difference(one, near).area)
    return Violation(k, None, outside, 0.0 if outside > 0 else distance(near.boundary, one))


def violations_on_torus(
    outlines: Sequence[Outline], lattice: Lattice, gap: float
) -> tuple[Violation, ...]:
    """Each pair nearer than ``gap`` where all repeats; an item and its own image are one too.

    Examples
    --------
    >>> bar = Outline.from_rings([[[0.0, 0], [9, 0], [9, 4], [0, 4]]])
    >>> [(one.item, one.other) for one in violations_on_torus([bar], Lattice(9.5, 9.0), 1.0)]
    [(0, 0)]
    """
    regions, owners = images_about(outlines, lattice, gap)
    count = len(outlines)
    first, second = shapely.STRtree(regions).query(
        regions[:count], predicate="dwithin", distance=gap
    )
    found: dict[tuple[int, int], Violation] = {}
    for i, q in zip(first.tolist(), second.tolist(), strict=True):
        pair = min(i, int(owners[q])), max(i, int(owners[q]))
        if i != q:
            one = meeting(*pair, regions[i], regions[q])
            found[pair] = min(found.get(pair, one), one, key=_by_depth)
    return tuple(
        found[pair] for pair in sorted(found)
        if found[pair].overlap_cu2 > 0 or found[pair].gap_cu < gap
    )  # fmt: skip


def _by_depth(one: Violation) -> tuple[float, float]:
    """Order of violations, the worst first."""
    return -one.overlap_cu2, one.gap_cu


class ViolationSet:
    """Violations among items that come, go and move, kept as a set; as ``violations`` finds them.

    Shares no code with the finish, nor with what moves the items.

    ``container``: canvas units.

    Examples
    --------
    >>> def square(x, side):
    ...     return Outline.from_rings([x + side * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])])
    >>> standing = ViolationSet(square(0, 10), 0.5)
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

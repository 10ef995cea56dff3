"""Violations: the pairs, by number, that keep a layout from its certificate."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import IntArray
from packwork.geometry.distance import distance
from packwork.geometry.lattice import Lattice, moved
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, difference, intersection, part_about, prepared, valid
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
    whole = prepared(valid(container.region))
    regions = np.empty(len(outlines), dtype=object)
    regions[:] = [valid(outline.region) for outline in outlines]
    first, second = shapely.STRtree(regions).query(regions, predicate="dwithin", distance=gap)
    pairs = [(int(i), int(j)) for i, j in zip(first, second, strict=True) if i < j]
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

    ``container``: canvas units; ``lattice``: by which all repeats, if it does.

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

    def __init__(self, container: Outline, gap: float, lattice: Lattice | None = None) -> None:
        self._edge = _Wall(container, gap) if lattice is None else _NoWall(lattice, gap)
        self._gap = gap
        self._regions: dict[int, list[Region]] = {}
        """Of each number what is looked at: the item, or its images about the cell."""
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
                self._regions[number] = self._edge.images(valid(outline.region))
                changed.append(number)
        if changed:
            self._look(changed)

    def _look(self, changed: list[int]) -> None:
        numbers = np.array([k for k, images in self._regions.items() for _ in images])
        everything = _array(one for images in self._regions.values() for one in images)
        rows = np.flatnonzero(np.isin(numbers, changed))
        regions, is_mine = prepared(everything[rows]), np.isin(np.arange(len(everything)), rows)
        tree = shapely.STRtree(everything)
        mine, theirs = tree.query(regions, predicate="dwithin", distance=self._gap)
        for one, other in zip(rows[mine].tolist(), theirs.tolist(), strict=True):
            # Of two that have both changed the first finds the other.
            if one != other and not (other < one and is_mine[other]):
                first, second = sorted((one, other), key=lambda row: int(numbers[row]))
                i, j = int(numbers[first]), int(numbers[second])
                self._note(meeting(i, j, everything[first], everything[second]))
        for found in self._edge.met(numbers[rows], regions):
            self._note(found)

    def _note(self, found: Violation) -> None:
        if found.overlap_cu2 > 0 or found.gap_cu < self._gap:
            key = found.item, found.other
            self._found[key] = min(self._found.get(key, found), found, key=_by_depth)


@final
class _Wall:
    """Edge of a container."""

    def __init__(self, container: Outline, gap: float) -> None:
        self._whole, self._gap = prepared(valid(container.region)), gap
        self._line = self._whole.boundary
        shapely.prepare(self._line)

    def images(self, region: Region) -> list[Region]:
        """The region itself."""
        return [region]

    def met(self, numbers: IntArray, regions: npt.NDArray[Any]) -> Iterator[Violation]:
        """Violations of the edge by regions ``(m,)`` of those numbers."""
        near = ~shapely.covers(self._whole, regions)
        near |= shapely.dwithin(self._line, regions, self._gap)
        for k in np.flatnonzero(near):
            yield sticking_out(int(numbers[k]), regions[k], self._whole, self._gap)


@final
class _NoWall:
    """Lattice by which all repeats: where two meet, one of them lies in the cell."""

    def __init__(self, lattice: Lattice, gap: float) -> None:
        left, top, right, bottom = lattice.cell
        self._about = left - gap, top - gap, right + gap, bottom + gap
        self._lattice = lattice

    def images(self, region: Region) -> list[Region]:
        """Images of a region that reach the cell, or nearly."""
        return [moved(region, s) for s in self._lattice.meeting(region.bounds, self._about)]

    def met(self, numbers: IntArray, regions: npt.NDArray[Any]) -> Iterator[Violation]:
        """Nothing is met."""
        return iter(())


def _array(regions: Iterable[Any]) -> npt.NDArray[Any]:
    listed = list(regions)
    array = np.empty(len(listed), dtype=object)
    array[:] = listed
    return array


def _in_order(key: tuple[int, int | None]) -> tuple[int, int]:
    return key[0], -1 if key[1] is None else key[1]

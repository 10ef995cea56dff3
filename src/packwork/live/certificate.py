"""Statements about a document: its certificate, and what was asked for and has not been got."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from copy import copy
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from packwork.geometry.rectangles import ROUNDING as EXACTLY
from packwork.live.chart_groups import stray
from packwork.live.commands.aligning import LineUp
from packwork.live.commands.command import Command
from packwork.live.commands.items import Replace
from packwork.live.commands.placing import NEARLY, Arrange, Cover, Exchange, Move, Scale
from packwork.live.document import Change, Document, Invalidation, differing
from packwork.live.names import called
from packwork.metrics.certificate import Promise, off_shares
from packwork.metrics.touching import StraightItems, straight_items
from packwork.metrics.violations import Violation, ViolationSet
from packwork.steps.measure import reason


@dataclass(frozen=True)
class Settlement:
    """Result of a settle.

    ``certified``: whether exact geometry finds nothing wrong with the layout now.
    """

    certified: bool
    in_the_way: tuple[str, ...]
    moved: int


class Certificate:
    """Exact certificate of one document after another.

    Examples
    --------
    >>> from packwork import fill
    >>> document = Document.from_layout(fill("circle", "star", count=3, levels="50"))
    >>> Certificate().in_the_way(document)
    ()
    """

    def __init__(self) -> None:
        self._seen: Document | None = None
        self._standing: ViolationSet | None = None

    def violations(self, document: Document) -> tuple[Violation, ...]:
        """Conflicts of a document, items by their numbers."""
        found = self._brought_to(document).violations
        straight = straight_items(document.layout) if found else None
        if straight is None:
            return found
        rows = {number: k for k, number in enumerate(document.ids.tolist())}
        return tuple(one for one in found if not _is_exactly(one, straight, rows, document))

    def in_the_way(self, document: Document) -> tuple[str, ...]:
        """Reasons that keep a document from its certificate, a sentence each."""
        place = {number: k for k, number in enumerate(document.ids.tolist())}
        reasons = []
        for one in self.violations(document):
            other = None if one.other is None else place[one.other]
            placed = replace(one, item=place[one.item], other=other)
            name = document.items[placed.item].name
            reasons.append(f"{name} {reason(placed, document.items, document.container.unit)}")
        return (*reasons, *off_shares(promise_of(document), document.layout))

    def _brought_to(self, now: Document) -> ViolationSet:
        """Look at what has changed since it was last looked at."""
        before, standing = self._seen, self._standing
        if now is before and standing is not None:
            return standing
        if standing is None or before is None or _is_all_stale(before, now):
            gap = promise_of(now).least_gap(now.container.side)
            container = now.container
            standing, before = ViolationSet(container.outline, gap, container.lattice), None
        gone, changed = _gone_and_changed(before, now)
        placed = {n: now.items[k].outline.mapped(now.poses.matrix(k)) for k, n in changed}
        standing.change({**gone, **placed})
        self._standing, self._seen = standing, now
        return standing


def _is_exactly(
    one: Violation, straight: StraightItems, rows: Mapping[int, int], document: Document
) -> bool:
    """Whether straight rectangles keep the gap but for rounding; of none they may touch.

    As what is measured of a whole layout does.
    """
    promise, side = promise_of(document), document.container.side
    if promise.gap > 0.0:
        is_apart = one.gap_cu + EXACTLY * side >= promise.least_gap(side)
        return one.overlap_cu2 == 0.0 and is_apart
    return straight.is_free(rows[one.item], None if one.other is None else rows[one.other])


def beyond(wrong: Iterable[Violation], near: set[int]) -> set[int]:
    """Numbers of items in conflicts that what is near has no part in."""
    found: set[int] = set()
    for one in wrong:
        pair = {one.item} if one.other is None else {one.item, one.other}
        if not pair & near:
            found |= pair
    return found


def promise_of(document: Document) -> Promise:
    """Smallest gap and shares of area that a document is to keep."""
    given = Promise.of(document.manifest) or Promise()
    shares = given.areas_in_shares and document.options.sizes == "shared"
    return Promise(document.options.padding, shares)


def _is_all_stale(before: Document, now: Document) -> bool:
    is_other = before.options.padding != now.options.padding
    return is_other or Change.between(before, now).stale == Invalidation.EVERYTHING


def _gone_and_changed(
    before: Document | None, now: Document
) -> tuple[dict[int, None], list[tuple[int, int]]]:
    """Numbers of items that are gone, and rows and numbers of those that are new or elsewhere."""
    if before is None:
        return {}, list(enumerate(now.ids.tolist()))
    _, rows, was = np.intersect1d(now.ids, before.ids, assume_unique=True, return_indices=True)
    is_same = np.zeros(len(now), dtype=bool)
    is_same[rows] = ~differing(before.poses.subset(was), now.poses.subset(rows))
    for row, k in zip(rows.tolist(), was.tolist(), strict=True):
        is_same[row] &= before.items[k].outline is now.items[row].outline
    changed = np.flatnonzero(~is_same)
    gone = np.setdiff1d(before.ids, now.ids, assume_unique=True)
    return dict.fromkeys(gone.tolist()), list(
        zip(changed.tolist(), now.ids[changed].tolist(), strict=True)
    )


NEAR = 0.005
"""Distance from the place asked for, in sides of the canvas, up to which an item is there. Larger
passes over what is seen, smaller tells of what is not. Chosen."""

AWAY = 0.02
"""The same from where a hand has put an item once, for which others have made it make way. Larger
passes over what is seen, smaller tells of what no eye finds. Chosen."""

ROUNDING = 1e-6
"""Share by which a size may miss its range and keep it. Derived: rounding of the finish."""


class Requests:
    """Places and sizes asked of items: each is kept until it is had or asked otherwise."""

    def __init__(self) -> None:
        self._asked: dict[tuple[str, int], _Request] = {}
        self._asked_of: WeakKeyDictionary[Document, dict[tuple[str, int], _Request]]
        self._asked_of = WeakKeyDictionary()
        self._count = self._settled = 0

    def note(self, commands: Iterable[Command], before: Document, after: Document) -> None:
        """Note what commands ask for that have made one document of another."""
        self._asked_of[before] = dict(self._asked)
        for one in commands:
            if isinstance(one, Move):
                self._ask("place", one.item, (one.x, one.y))
            elif isinstance(one, LineUp):
                for number, row in ((n, after.index(n)) for n in one.items):
                    if row is not None:
                        self._ask("place", number, (after.poses.x[row], after.poses.y[row]))
            elif isinstance(one, Scale):
                row, first = after.index(one.item), before.index(one.item)
                if row is not None and first is not None:
                    known = self._asked.get(("size", one.item))
                    is_one_gesture = known is not None and known.number > self._settled
                    began = known.value[1] if known and is_one_gesture else _size(before, first)
                    self._ask("size", one.item, (_size(after, row), began))
            elif isinstance(one, Arrange | Cover | Exchange | Replace):
                # Other places and sizes are asked for now.
                self.forget()

    def _ask(self, what: str, item: int, value: tuple[float, float]) -> None:
        self._count += 1
        self._asked[what, item] = _Request(self._count, value)

    def settled(self, before: Document, document: Document, recent: set[int]) -> None:
        """Forget what a document that is settled has: later gestures may take it away again.

        What hands put somewhere before, other than the numbers ``recent``, is to be where they put
        it, until it was said once that it is not.
        """
        if Change.between(before, document).stale == Invalidation.NOTHING:
            return
        told, unmet, put = self.unmet(before), self.unmet(document), document.put - recent
        asked, self._asked = self._asked, {}
        for (what, number), one in asked.items():
            if what == "stay" and number in put:
                self._asked[what, number] = replace(one, is_told=one.is_told or one.number in told)
            elif what != "stay" and one.number in unmet:
                self._asked[what, number] = one
        for number in sorted(before.put & put):
            row, places = before.index(number), {("stay", number), ("place", number)}
            if row is not None and not places & self._asked.keys():
                self._ask("stay", number, (before.poses.x[row], before.poses.y[row]))
        self._settled = self._count

    def copy(self) -> Requests:
        """The same, to be gone back to."""
        made = copy(self)
        made._asked = dict(self._asked)
        return made

    def leapt(self, before: Document, after: Document) -> None:
        """Go from a document to one of the history, and to what was asked for there."""
        self._asked_of[before] = self._asked
        self._asked = dict(self._asked_of.get(after, {}))

    def forget(self) -> None:
        """Take back all that was asked for."""
        self._asked.clear()

    def unmet(self, document: Document) -> dict[int, str]:
        """Sentences about what items of a document have not got, by the count of what was asked."""
        sentences = {}
        for (what, number), asked in self._asked.items():
            k = None if asked.is_told else document.index(number)
            told = None if k is None else _MISSES[what](document, k, *asked.value)
            if told is not None:
                sentences[asked.number] = told
        return sentences


@dataclass(frozen=True)
class _Request:
    """Request, in the order of asking.

    ``value``: coordinates; of a size itself and what it was before. ``is_told``: whether that it is
    not had was said and is not to be said again.
    """

    number: int
    value: tuple[float, float]
    is_told: bool = False


def _miss_of_place(document: Document, k: int, x: float, y: float) -> str | None:
    found = _elsewhere(document, k, x, y, NEAR)
    if not found:
        return None
    row = np.array([k])
    asked = replace(document.poses.subset(row), x=np.array([x]), y=np.array([y]))
    there = document.with_poses(document.poses.with_some(row, asked))
    return f"{found}: {stray(document, there) or 'there is no room for it'}"


def _miss_of_stay(document: Document, k: int, x: float, y: float) -> str | None:
    found = _elsewhere(document, k, x, y, AWAY)
    return found and f"{found} as put by hand: it made way"


def _elsewhere(document: Document, k: int, x: float, y: float, near: float) -> str | None:
    """Sentence where an item is farther off than ``near``, in sides of the canvas."""
    at, container = (float(document.poses.x[k]), float(document.poses.y[k])), document.container
    if container.lattice is not None:
        x, y = container.lattice.nearest(np.array([x, y]), np.array(at)).tolist()
    # What forces pull at does not stay where it is put.
    if document.options.force or math.dist((x, y), at) <= near * container.side:
        return None
    return f"{called(document, k)} is at {at[0]:.4g}, {at[1]:.4g}, not at {x:.4g}, {y:.4g}"


def _miss_of_size(document: Document, k: int, asked: float, first: float) -> str | None:
    spare = NEARLY if document.options.sizes == "free" else 1.0
    if _size(document, k) * spare >= asked * (1 - ROUNDING):
        return None
    return (
        f"{called(document, k)} is {_size(document, k) / first:.3g} times as large as it was, "
        f"not {asked / first:.3g} times: there is no room for more"
    )


_MISSES = {"place": _miss_of_place, "size": _miss_of_size, "stay": _miss_of_stay}


def _size(document: Document, k: int) -> float:
    """Size of an item: beside the others' where sizes are in shares."""
    if document.options.sizes == "shared":
        return math.sqrt(document.weights[k])
    return float(document.poses.scale[k])

"""A document and all that follows a change of it: neighbours flow, what was touched is finished."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.live.certificate import Certificate
from packwork.live.change import Change, Stale, differing
from packwork.live.document import PROPERTIES, Document
from packwork.live.frames import Frames
from packwork.live.marks import Marks
from packwork.live.neighbourhood.flow import Flow
from packwork.live.neighbourhood.nearest import brought_inside
from packwork.live.neighbourhood.settle import settle
from packwork.live.neighbourhood.shapes import ShapeCache
from packwork.live.neighbourhood.sights import LevelCache
from packwork.metrics.violations import Violation
from packwork.progress import Stop
from packwork.scene.pose import Poses

NEAR = 2
"""Rings about what was touched that stay where they have flowed; all others go back to where they
were. More lose more coverage, fewer leave less room for what was dropped. Tried."""

LEFT = 3
"""The same about where something was taken from: these grow into the room. Tried."""

RELAX = 60
"""Epochs before a settle: what lies under what was dropped has to get out of its way first. More
take longer, fewer leave more to be shrunk. Tried."""


class Following:
    """The present document, with what is known about it from one change to the next."""

    def __init__(self, document: Document, *, record: bool = False) -> None:
        self._document = self._base = document
        self.shapes = ShapeCache()
        """Covers of the outlines."""
        self.marks = Marks()
        """What has been done to which items."""
        self._sights = LevelCache()
        self._grabbed: tuple[int, ...] = ()
        self._flow: Flow | None = None
        self._certificate = Certificate()
        self._frames = Frames(document) if record else None

    @property
    def document(self) -> Document:
        """Document as it is now."""
        return self._document

    @property
    def is_at_rest(self) -> bool:
        """Whether the flow has nothing to move."""
        return self._flow is None or self._flow.is_at_rest

    def begin_film(self) -> None:
        """Keep the way of the items from now on."""
        self._frames = Frames(self._document)

    def make_ready(self) -> None:
        """Have what takes long the first time done before the hand comes; changes nothing."""
        if len(self._document):
            Flow(self._document, self._sights).make_ready()

    def _put_back(self) -> set[int]:
        """Put back what flowed and lies far from what was touched; numbers of what is near.

        It lay well before, and where the hand only passed by, it does so again.
        """
        flow, base, now = self._flow, self._base, self._document
        if flow is None:
            return set()
        flow.review()
        near = flow.touching.rings(self._rows(self.marks.touched), NEAR) >= 0
        near[self._rows(self.marks.left)] = True
        _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
        back = ~near[rows] & differing(now.poses.subset(rows), base.poses.subset(theirs))
        rows, theirs = rows[back], theirs[back]
        flow.put_back(rows, now.poses.with_some(rows, base.poses.subset(theirs)))
        self._follow(flow)
        return set(now.ids[near].tolist())

    def _bring_inside(self) -> None:
        """Put what the hand has put where it sticks out to the nearest place, at its size.

        What finds its size by itself becomes smaller there.
        """
        before = self._document
        if before.options.sizes == "free":
            return
        rows = self._rows(self.marks.given | self.marks.turned)
        inside = brought_inside(before, rows, self.shapes)
        if inside is not before:
            self._take(Change.between(before, inside), before, inside)

    def _make_room(self, flow: Flow, near: set[int]) -> Document:
        """Let what was touched make room; the document then, its angles held as the hand has."""
        self.marks.given = self._fitting(self.marks.given)
        flow.bring_in(self._rows(self.marks.touched - self.marks.given))
        strict = self._turned_held(self._document)
        flow.rule(strict)
        flow.hold(self._rows(self.marks.given))
        flow.harden(RELAX, self._rows(near | self.marks.touched))
        self._follow(flow)
        return replace(self._document, held=strict.held)

    def _settle(self, flow: Flow, strict: Document, stop: Stop) -> bool:
        """Finish what was touched; whether that could be without what is far from it."""
        touched = np.union1d(self._rows(self.marks.touched), np.flatnonzero(flow.moved))
        flow.review()
        given = self._rows(self.marks.given)
        done = settle(strict, touched.astype(np.int64), given, flow.touching, self.shapes, stop)
        self._turn_to(self._document.with_poses(done.document.poses))
        return done.is_clean

    def _turn_to(self, document: Document) -> None:
        """Have this document, and the flow go on from it."""
        self._document = document
        if self._flow is not None:
            self._flow.turn_to(document)

    @property
    def violations(self) -> tuple[Violation, ...]:
        """Conflicts as of now, items by their numbers."""
        return self._certificate.violations(self._document)

    @property
    def is_certified(self) -> bool:
        """Whether exact geometry finds no overlap, nothing outside, and gaps as promised."""
        return len(self._document) > 0 and not self.in_the_way

    @property
    def in_the_way(self) -> tuple[str, ...]:
        """Reasons that keep the layout from its certificate, a sentence each."""
        return self._certificate.in_the_way(self._document)

    def _begin_anew(self) -> None:
        """Have a flow that knows no more than documents and marks say; nothing moves yet."""
        now, base = self._document, self._base
        self._flow = Flow(self._turned_held(now), self._sights)
        _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
        self._flow.moved[rows] = differing(now.poses.subset(rows), base.poses.subset(theirs))
        self._hold()

    def _flow_again(self) -> None:
        """Have what is not settled go on."""
        if self._flow is not None:
            self._flow.stir(self._rows(self.marks.touched))
            self._hold()

    def _follow(self, flow: Flow) -> None:
        """Take over where the flow has brought the items."""
        self._document = self._document.with_poses(flow.poses)
        self._film()

    def _film(self) -> None:
        if self._frames is not None:
            self._frames.keep(self._document)

    def _take(self, change: Change, before: Document, after: Document) -> None:
        """Bring the flow to a changed document."""
        self._document = after
        if change.stale == Stale.NOTHING:
            return
        flow = self._flow = self._flow or Flow(before, self._sights)
        if change.stale <= Stale.RULES:
            flow.rule(self._turned_held(after))
            return
        if change.stale == Stale.POSES:
            self._give(flow, before.poses, after)
            return
        gone = np.array([k for k in change.items if before.index(k) is not None], dtype=np.int64)
        beside: set[int] = set()
        if len(gone) and change.stale == Stale.ITEMS:
            rows = np.array([before.index(int(k)) for k in gone], dtype=np.int64)
            beside = set(before.ids[flow.touching.beside(rows)].tolist())
        flow.turn_to(self._turned_held(after))
        present = set(after.ids.tolist())
        self.marks.given &= present
        self.marks.touched = (self.marks.touched | beside | set(change.items.tolist())) & present
        flow.stir(self._rows(self.marks.touched))
        self._hold()
        self._film()

    def _give(self, flow: Flow, before: Poses, after: Document) -> None:
        """Note which items the hand has moved or turned; others make room for all it changed."""
        now, numbers = after.poses, after.ids
        moved = (now.x != before.x) | (now.y != before.y)
        turned, changed = now.angle != before.angle, differing(before, now)
        self.marks.given |= set(numbers[moved].tolist())
        self.marks.turned |= set(numbers[turned].tolist())
        by_hand = set(numbers[moved | turned].tolist())
        if not self.marks.touched:
            self.marks.lately.clear()
        self.marks.lately |= by_hand
        self.marks.by_hand |= by_hand
        new = np.flatnonzero(changed & ~np.isin(numbers, list(self.marks.touched)))
        if len(new):
            self.marks.left |= set(numbers[flow.touching.rings(new, LEFT) >= 0].tolist())
        self.marks.touched |= set(numbers[changed].tolist())
        flow.rule(self._turned_held(after))
        kept = self.marks.given | set(numbers[changed].tolist()) | set(self._grabbed)
        flow.give(self._rows(kept), now)

    def _keep_angles(self, numbers: Iterable[int]) -> None:
        """Have items keep their angles while others make room for them."""
        given = set(numbers)
        self.marks.turned |= given
        self.marks.by_hand |= given

    def _turned_held(self, document: Document) -> Document:
        """A document in which what the hand has turned holds its angle."""
        held = document.held.copy()
        turned = np.isin(document.ids, list(self.marks.turned))
        held[turned, PROPERTIES.index("angle")] = True
        return replace(document, held=held)

    def _hold(self) -> None:
        """Have the flow hold what lies where the hand has put it, or is in the hand."""
        if self._flow is not None:
            self._flow.hold(self._rows(self.marks.given | set(self._grabbed)))

    def _rows(self, numbers: set[int]) -> IntArray:
        return np.flatnonzero(np.isin(self._document.ids, list(numbers)))

    def _fitting(self, numbers: set[int]) -> set[int]:
        """Those items that can stay where they are: in the container, and clear of what is held."""
        document = self._document
        fixed = set(document.ids[document.held[:, 0]].tolist()) | numbers
        bad = set()
        for one in self._certificate.violations(document):
            if one.other is None or {one.item, one.other} <= fixed:
                bad |= {one.item, one.other} & numbers
        return numbers - bad


def beyond(wrong: Iterable[Violation], near: set[int]) -> set[int]:
    """Numbers of items in conflicts that what is near has no part in."""
    found: set[int] = set()
    for one in wrong:
        pair = {one.item} if one.other is None else {one.item, one.other}
        if not pair & near:
            found |= pair
    return found

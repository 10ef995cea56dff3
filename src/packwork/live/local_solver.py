"""A document and all that follows a change of it: neighbours flow, what was touched is finished."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.live.certificate import Certificate, Settlement, beyond
from packwork.live.document import PROPERTIES, Change, Document, Invalidation, differing
from packwork.live.ground import coloured
from packwork.live.history import Frames, Marks, SessionState
from packwork.live.neighbourhood.allowance import widened, within
from packwork.live.neighbourhood.caches import LevelCache, ShapeCache
from packwork.live.neighbourhood.contacts import RINGS
from packwork.live.neighbourhood.flow import LINGER, Flow
from packwork.live.neighbourhood.places import brought_inside, fallen
from packwork.live.neighbourhood.settle import made_smaller, polish, settle, sizes_are_common
from packwork.live.nested_again import taken_apart
from packwork.live.refilling import is_other_cloud, refilled, sent_back, taken_back
from packwork.metrics.violations import Violation
from packwork.progress import Stop
from packwork.scene.pose import Poses
from packwork.scene.track import Track

NEAR = 2
"""Rings about what was touched that stay where they have flowed; all others go back to where they
were. More lose more coverage, fewer leave less room for what was dropped. Tried."""

ENOUGH = 6
"""Turns for each item that gestures have touched after which no more are tried. Chosen."""

MOST_LOST = 0.012
"""Share of the container by which less may be covered then, or turns go on and sizes vary farther.
Larger empties what is edited often, smaller changes more about an edit. Tried."""

STAGES = 8
"""Times that turns are tried then at most, a ring of neighbours more each time. Fewer cover less
after many gestures, more take longer and win nothing back. Measured, decision 0055."""


class LocalSolver:
    """The present document, and the solver on the neighbourhood of what was touched."""

    def __init__(self, document: Document, *, record: bool = False) -> None:
        self.base = document
        """Document in which all had been settled last: what has flowed in vain goes back to it."""
        self.marks = Marks()
        self.shapes = ShapeCache()
        self.grabbed: tuple[int, ...] = ()
        """Numbers of what is in the hand."""
        self.news: tuple[str, ...] = ()
        """Sentences about what the last settle did to all items."""
        self.on_fall: Callable[[Document], object] = lambda _: None
        self._levels = LevelCache()
        self._flow = Flow(document, self._levels)
        self._certificate = Certificate()
        self._frames = Frames(document) if record else None

    @property
    def document(self) -> Document:
        """Document as it is now."""
        return self._flow.document

    @property
    def is_at_rest(self) -> bool:
        """Whether the flow has nothing to move."""
        return self._flow.is_at_rest

    @property
    def violations(self) -> tuple[Violation, ...]:
        """Conflicts as of now, items by their numbers."""
        return self._certificate.violations(self.document)

    @property
    def in_the_way(self) -> tuple[str, ...]:
        """Reasons that keep the layout from its certificate, a sentence each."""
        return self._certificate.in_the_way(self.document)

    @property
    def is_certified(self) -> bool:
        """Whether exact geometry finds no overlap, nothing outside, and gaps as promised."""
        return len(self.document) > 0 and not self.in_the_way

    @property
    def track(self) -> Track | None:
        """Way of the items; None unless it is recorded."""
        return None if self._frames is None else self._frames.track

    def begin_film(self) -> None:
        """Keep the way of the items from now on."""
        self._frames = Frames(self.document)

    def make_ready(self) -> None:
        """Have what takes long the first time done before the hand comes; changes nothing."""
        if len(self.document):
            Flow(self.document, self._levels).make_ready()

    def go_on_from(self, state: SessionState) -> None:
        """Take over what a file holds, nothing else: so that the same follows wherever it is."""
        self.base, self.marks = state.base, state.marks
        self.shapes, self._certificate = ShapeCache(), Certificate()
        self.grabbed, self._flow = (), Flow(state.document, self._levels)
        if self.marks.touched:
            self.begin_anew()
            self._flow.activate(self._rows(self.marks.touched))
            self._hold()

    def grab(self, items: tuple[int, ...]) -> None:
        """Have items in the hand, or with none let go of them."""
        if items:
            self._flow.begin()
        self.grabbed = items
        self._hold()

    def place(self, numbers: set[int]) -> None:
        """Have items stay where the hand has put them, also such as are new."""
        if not numbers <= self.marks.placed_by_user:
            self.marks.placed_by_user |= numbers
            self.marks.recent |= numbers
            self._hold()

    def take(self, after: Document) -> None:
        """Go on with a document that a command has changed."""
        flow, before = self._flow, self.document
        change = Change.between(before, after)
        if change.stale == Invalidation.NOTHING:
            flow.document = after
            return
        flow.begin()
        if change.stale <= Invalidation.RULES:
            flow.set_rules(after, self._strict(after))
            return
        self.marks.begin(self.base)
        if len(change.items) >= len(after):
            # What changes all items is to cover what it says.
            self.marks.full = 0.0
        if change.stale == Invalidation.POSES:
            self._take_poses(before.poses, after)
            return
        gone = np.array([k for k in change.items if before.index(k) is not None], dtype=np.int64)
        beside: set[int] = set()
        if len(gone) and change.stale == Invalidation.ITEMS:
            rows = np.array([before.index(int(k)) for k in gone], dtype=np.int64)
            beside = set(before.ids[flow.contacts.beside(rows)].tolist())
            self._allow(rows)
        flow.turn_to(after, self._strict(after))
        present = set(after.ids.tolist())
        self.marks.placed_by_user &= present
        edited = set(change.items.tolist())
        self.marks.touched = (self.marks.touched | beside | edited) & present
        self.marks.edited = (self.marks.edited | edited) & present
        flow.activate(self._rows(self.marks.touched))
        self._hold()
        self.film()

    def _take_poses(self, before: Poses, after: Document) -> None:
        """Note which items the hand has moved or turned; others make room for all it changed."""
        flow, marks, now, numbers = self._flow, self.marks, after.poses, after.ids
        moved = (now.x != before.x) | (now.y != before.y)
        turned, changed = now.angle != before.angle, differing(before, now)
        marks.placed_by_user |= set(numbers[moved].tolist())
        marks.turned |= set(numbers[turned].tolist())
        marks.turned_by_hand |= set(numbers[turned].tolist())
        marks.recent |= set(numbers[moved | turned].tolist())
        new = np.flatnonzero(changed & ~np.isin(numbers, list(marks.touched)))
        if len(new):
            marks.vacated |= set(numbers[self._allow(new) >= 0].tolist())
        marks.touched |= set(numbers[changed].tolist())
        marks.edited |= set(numbers[changed].tolist())
        flow.set_rules(after, self._strict(after))
        kept = marks.placed_by_user | set(numbers[changed].tolist()) | set(self.grabbed)
        flow.make_way(self._rows(kept))

    def run(self, epochs: int, resolution: int | None = None) -> int | None:
        """Run epochs; of which level, or None where nothing has been touched yet."""
        if not self._flow.is_begun:
            return None
        resolution = resolution or self._flow.resolution
        self._flow.run(epochs, resolution)
        self.film()
        return resolution

    def finish(self, stop: Stop) -> Settlement:
        """Finish exactly what was touched, and certify the whole."""
        self._flow.bring_in()
        before = self.document
        if home := sent_back(self.base, before):
            self.take(home.document)
        near, wrong = self._put_back(), self.violations
        # What is in conflict is touched, whenever that came about.
        in_conflict = beyond(wrong, near)
        self.marks.touched |= in_conflict
        if self.marks.touched and not stop():
            self._flow.begin()
            self._allow(self._rows(self.marks.edited | in_conflict))
            self.news = (home.message,) if home else ()
            self._finish_touched(near, len(wrong), stop)
        if self.document.options.force and self.document is not self.base and not stop():
            loose = self._rows(self.marks.touched)
            self._turn_to(fallen(self.document, loose, self.shapes, stop, self._fell))
        is_over, is_wrong = stop() or not self.marks.touched, bool(self.violations)
        if back := None if is_over else taken_back(self.base, self.document, is_wrong=is_wrong):
            self.news = (back.message,)
            self._turn_to(back.document)
        moved = self.document.rows_moved_from(before)
        self.marks.unpolished |= set(self.document.ids[moved].tolist())
        return Settlement(self.is_certified, self.in_the_way, len(moved))

    def settled(self) -> None:
        """Note that all that was touched is finished; items of a mosaic take its colours there."""
        shown = coloured(self.document, self.document.rows_moved_from(self.base))
        if shown is not self.document:
            self._turn_to(shown)
        self.base = self.document
        self.marks.settled(self.base)
        self.film()

    def restart(self, document: Document, marks: Marks) -> None:
        """Leave all as it was before a settle that was broken off."""
        self.marks = marks
        self._flow = Flow(document, self._levels)
        self.begin_anew()

    def begin_anew(self) -> None:
        """Have a flow that knows no more than documents and marks say; nothing moves yet."""
        now, base = self.document, self.base
        self._flow = Flow(now, self._levels)
        self._flow.begin(self._strict(now))
        _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
        self._flow.moved[rows] = differing(now.poses.subset(rows), base.poses.subset(theirs))
        self._hold()

    def leap_to(self, document: Document) -> None:
        """Go on with a document of the history, as if it had been settled."""
        self.base = document
        self._turn_to(document)
        self.marks.leapt()
        self.film()

    @property
    def is_rough(self) -> bool:
        """Whether coverage may be won back where gestures have cost some."""
        is_busy = self.grabbed or self.marks.touched or self.document.options.force
        return bool(self.marks.unpolished) and not is_busy

    def polish(self, trials: int, stop: Stop) -> int | None:
        """Try turns of what edits have reached; how many have moved, or None."""
        marks, before = self.marks, self.document
        if trials < 1 or not self.is_rough:
            return None
        self._flow.begin(self._strict(before))
        reached = self._rows(set(marks.ranges))
        most = max(ENOUGH * len(reached), 1)
        stage = min(marks.tried // most, STAGES - 1)
        # What was put somewhere last stays there; what no edit has reached takes part in need.
        around = self._flow.contacts.rings(reached, stage) >= 0
        rows = np.setdiff1d(np.flatnonzero(around), self._rows(marks.recent))
        held = before.held.copy()
        held[self._rows(marks.turned_by_hand), PROPERTIES.index("angle")] = True
        strict = within(replace(before, held=held), marks.ranges, stage=stage)
        poses, is_clean = polish(strict, rows, trials, marks.polished + 1, self.shapes, stop)
        if stop():
            return None
        marks.polished += 1
        now = before.with_poses(poses) if is_clean else before
        now = coloured(now, now.rows_moved_from(before))
        self.base = now if is_clean else self.base
        self._turn_to(now)
        marks.tried += trials
        is_full = now.covered >= marks.full - MOST_LOST
        if marks.tried >= most * (1 if is_full else STAGES):
            marks.unpolished, marks.ranges, marks.tried = set(), {}, 0
        self.film()
        return int(differing(before.poses, now.poses).sum())

    def film(self) -> None:
        """Keep where the items are, if that is recorded."""
        if self._frames is not None:
            self._frames.keep(self.document)

    def _put_back(self) -> set[int]:
        """Put back what flowed far from what was touched: it lay well; numbers of what is near."""
        flow, base, now = self._flow, self.base, self.document
        if not flow.is_begun:
            return set()
        flow.review()
        near = flow.contacts.rings(self._rows(self.marks.touched), NEAR) >= 0
        near[self._rows(self.marks.vacated)] = True
        _, rows, theirs = np.intersect1d(now.ids, base.ids, return_indices=True)
        back = ~near[rows] & differing(now.poses.subset(rows), base.poses.subset(theirs))
        flow.put_back(rows[back], base.poses.subset(theirs[back]))
        self.film()
        return set(now.ids[near].tolist())

    def _finish_touched(self, near: set[int], wrong: int, stop: Stop) -> None:
        """Finish what was touched near where it is; else pour all anew, or make all smaller."""
        self._bring_inside()
        if self.document.kind.has_parts:
            by_hand = self.marks.placed_by_user | self.marks.turned_by_hand
            apart = taken_apart(self.document, self.base, by_hand, self._certificate, stop)
            if apart is not None:
                self._turn_to(apart)
                return
        asked = self.document
        if not (is_other_cloud(self.base, asked) and self._refill(asked, stop)):
            strict = self._make_room(near)
            is_clean = self._settle(strict, stop)
            if not self._refill(asked, stop):
                if not is_clean and sizes_are_common(strict):
                    smaller, _ = made_smaller(strict, self.shapes, stop)
                    self._turn_to(self.document.with_poses(smaller))
                if len(self.violations) > wrong:  # Nothing is better than something worse.
                    self._turn_to(asked)

    def _fell(self, document: Document) -> None:
        if self._frames is not None:
            self._frames.keep(document)
        self.on_fall(document)

    def _bring_inside(self) -> None:
        """Put what the hand has put where it sticks out to the nearest place, at its size.

        What finds its size by itself becomes smaller there.
        """
        before = self.document
        if before.options.sizes == "free" or before.container.lattice is not None:
            return
        rows = self._rows(self.marks.placed_by_user | self.marks.turned)
        inside = brought_inside(before, rows, self.shapes)
        if inside is not before:
            self.take(inside)

    def _make_room(self, near: set[int]) -> Document:
        """Let what was touched make room; the document then, its angles held as the hand has."""
        flow, marks = self._flow, self.marks
        marks.placed_by_user = self._fitting(marks.placed_by_user)
        flow.project_inside(self._rows(marks.touched - marks.placed_by_user))
        held = self._strict(self.document)
        flow.set_rules(self.document, held)
        flow.hold(self._rows(marks.placed_by_user))
        flow.raise_overlap_weight(LINGER, self._rows(near | marks.touched))
        self.film()
        return within(replace(self.document, held=held), marks.ranges, marks.edited)

    def _allow(self, sources: IntArray) -> IntArray:
        """Let sizes vary about some items, ``(m,)`` rows; rings from these."""
        rings = self._flow.contacts.rings(sources, RINGS)
        self.marks.ranges = widened(self.marks.ranges, self.document, self.base, rings)
        return rings

    def _settle(self, strict: Document, stop: Stop) -> bool:
        """Finish what was touched; whether that could be without what is far from it."""
        flow = self._flow
        touched = np.union1d(self._rows(self.marks.touched), np.flatnonzero(flow.moved))
        flow.review()
        kept = self._rows(self.marks.placed_by_user)
        poses, is_clean = settle(
            strict, touched.astype(np.int64), kept, flow.contacts, self.shapes, stop
        )
        self._turn_to(self.document.with_poses(poses))
        return is_clean

    def _refill(self, asked: Document, stop: Stop) -> bool:
        """Pour a cloud anew that a gesture, new words or weights have left emptier; if it was."""
        by_hand = self._rows(self.marks.placed_by_user | self.marks.turned)
        if found := None if stop() else refilled(self.base, asked, self.document, by_hand, stop):
            self.news = (found.message,)
            self._turn_to(found.document)
        return found is not None

    def _fitting(self, numbers: set[int]) -> set[int]:
        """Those items that can stay where they are: in the container, and clear of what is held."""
        document = self.document
        fixed = set(document.ids[document.held[:, 0]].tolist()) | numbers
        bad = set()
        for one in self.violations:
            if one.other is None or {one.item, one.other} <= fixed:
                bad |= {one.item, one.other} & numbers
        return numbers - bad

    def _turn_to(self, document: Document) -> None:
        self._flow.turn_to(document, document.held)

    def _strict(self, document: Document) -> BoolArray:
        """Held parts of poses, as :attr:`Document.held`, and angles that the hand has given."""
        held = document.held.copy()
        held[np.isin(document.ids, list(self.marks.turned)), PROPERTIES.index("angle")] = True
        return held

    def _hold(self) -> None:
        """Have the flow hold what lies where the hand has put it, or is in the hand."""
        if self._flow.is_begun:
            self._flow.hold(self._rows(self.marks.placed_by_user | set(self.grabbed)))

    def _rows(self, numbers: set[int]) -> IntArray:
        return np.flatnonzero(np.isin(self.document.ids, list(numbers)))

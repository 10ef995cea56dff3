"""History of a session: documents to go back to, marks on items, and their way for films."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, field, fields, replace

import numpy as np

from packwork.live.commands.command import Command
from packwork.live.document import Document
from packwork.live.neighbourhood.allowance import Ranges, widened
from packwork.scene.pose import Poses
from packwork.scene.track import Track, track_of

MOST_ENTRIES = 1_000
"""Documents that can be gone back to. Of a thousand items each holds about 0.1 MB. Chosen."""


class UndoHistory:
    """Documents that can be gone back to, and forward to again.

    Parameters
    ----------
    past
        The oldest first.
    future
        The next first.
    """

    def __init__(self, past: Sequence[Document] = (), future: Sequence[Document] = ()) -> None:
        self._past: deque[Document] = deque(past, maxlen=MOST_ENTRIES)
        self._future: list[Document] = list(reversed(future))

    @property
    def past(self) -> tuple[Document, ...]:
        """Documents before the present one, the oldest first."""
        return tuple(self._past)

    @property
    def future(self) -> tuple[Document, ...]:
        """Documents after it, the next first."""
        return tuple(reversed(self._future))

    @property
    def can_undo(self) -> bool:
        """Whether there is a document before."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether there is a document after."""
        return bool(self._future)

    def __len__(self) -> int:
        return len(self._past)

    def note(self, before: Document) -> None:
        """Keep a document that a gesture has changed; what was undone is gone."""
        self._past.append(before)
        self._future.clear()

    def undo(self, present: Document) -> Document:
        """The document before; the present one where there is none."""
        if not self._past:
            return present
        self._future.append(present)
        return _titled(self._past.pop(), present)

    def redo(self, present: Document) -> Document:
        """The document after; the present one where there is none."""
        if not self._future:
            return present
        self._past.append(present)
        return _titled(self._future.pop(), present)


def _titled(document: Document, present: Document) -> Document:
    """A document of the history with the present title, which is no step of it."""
    was, title = (one.manifest.get("title", "") for one in (document, present))
    manifest = {**document.manifest, "title": title}
    return document if was == title else replace(document, manifest=manifest)


@dataclass
class Marks:
    """Numbers of items that gestures have done something to, and how much was polished.

    Parameters
    ----------
    touched
        To be finished by the next settle.
    placed_by_user
        Of these, what lies where the hand has put it.
    turned
        Of these, what has the angle that the hand has given it.
    vacated
        What lay beside items before the hand took them away.
    turned_by_hand
        Turned by hand since the last leap: polish leaves its angle.
    recent
        Put somewhere or turned by hand since the last settle but one: polish leaves it as it is.
    unpolished
        Settled, yet not polished.
    edited
        Of what is touched, what commands have changed themselves.
    ranges
        Scales between which others may vary that edits have reached, until all is polished.
    full
        Share of the container that was covered at most before gestures; 0 if that is unknown.
    polished
        How many times polish was called: the seed of what it tries.
    tried
        Turns that were tried since anything was unpolished.
    """

    touched: set[int] = field(default_factory=set)
    placed_by_user: set[int] = field(default_factory=set)
    turned: set[int] = field(default_factory=set)
    vacated: set[int] = field(default_factory=set)
    turned_by_hand: set[int] = field(default_factory=set)
    recent: set[int] = field(default_factory=set)
    unpolished: set[int] = field(default_factory=set)
    edited: set[int] = field(default_factory=set)
    ranges: Ranges = field(default_factory=dict)
    full: float = 0.0
    polished: int = 0
    tried: int = 0

    def copy(self) -> Marks:
        """The same, to be gone back to."""
        return deepcopy(self)

    def note_hand(self, steps: Sequence[Command], before: Document, after: Document) -> Document:
        """Note what steps of a hand leave as it has turned it; the document, with what it put."""
        kept = {one for step in steps for one in step.keeps_angles}
        self.turned |= kept
        self.turned_by_hand |= kept
        is_run = any(step.kind == "arrange" for step in steps)
        put = after.put & before.unmoved_in(after) if is_run else after.put
        put |= {one for step in steps for one in step.keeps_places}
        return after if put == after.put else replace(after, put=put)

    def begin(self, base: Document) -> None:
        """Note that a gesture begins unless one has: ``base`` is as full as is to be kept."""
        if not self.touched:
            self.recent.clear()
            self.full = max(self.full, base.covered)

    def settled(self, document: Document) -> None:
        """Forget what was to be settled; what was edited is as large as it came to be, about."""
        others = {n: one for n, one in self.ranges.items() if n not in self.edited}
        rings = np.where(np.isin(document.ids, list(self.edited)), 1, -1)
        self.ranges = widened(others, document, document, rings)
        self.keep(set(document.ids.tolist()))
        for kept in (self.touched, self.placed_by_user, self.turned, self.vacated, self.edited):
            kept.clear()

    def leapt(self) -> None:
        """Forget all items: the document is another one."""
        self.keep(set())
        self.full, self.tried = 0.0, 0

    def keep(self, present: set[int]) -> None:
        """Forget items that are no more."""
        for column in fields(self):
            value = getattr(self, column.name)
            if isinstance(value, set):
                value &= present
        self.ranges = {number: one for number, one in self.ranges.items() if number in present}


@dataclass(frozen=True)
class SessionState:
    """All that a session goes on from.

    ``base``: document in which all had been settled last: what has flowed in vain goes back to it.
    """

    document: Document
    base: Document
    history: UndoHistory
    marks: Marks


MOST, MOST_PLACES = 2_000, 400_000
"""Frames that are kept, and places of items in all; of more every other frame goes. Chosen: 16 MB.
"""


class Frames:
    """Poses from time to time, of the items that there are now.

    ``document``: where the film begins. It begins anew when items come or go.

    Examples
    --------
    >>> from packwork import fill
    >>> document = Document.from_layout(fill("circle", "star", count=3, levels="50"))
    >>> frames = Frames(document)
    >>> frames.keep(document)
    >>> frames.track
    <Track: 2 keyframes of 3 items>
    """

    def __init__(self, document: Document) -> None:
        self._ids = document.ids
        self._poses: list[Poses] = [document.poses]

    def keep(self, document: Document) -> None:
        """Keep where the items of a document are."""
        if not np.array_equal(document.ids, self._ids):
            self._ids, self._poses = document.ids, []
        self._poses.append(document.poses)
        if len(self._poses) > max(min(MOST, MOST_PLACES // max(len(self._ids), 1)), 2):
            self._poses = self._poses[::2]

    @property
    def track(self) -> Track:
        """Keyframes of a film."""
        return track_of(self._poses)

"""History: documents before and after the present one, as many as are kept."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from packwork.live.document import Document

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
        return self._past.pop()

    def redo(self, present: Document) -> Document:
        """The document after; the present one where there is none."""
        if not self._future:
            return present
        self._past.append(present)
        return self._future.pop()

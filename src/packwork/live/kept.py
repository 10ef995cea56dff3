"""State that is kept of a session when it is put away."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.live.document import Document
from packwork.live.history import UndoHistory
from packwork.live.marks import Marks


@dataclass(frozen=True)
class Kept:
    """All that a session goes on from.

    Parameters
    ----------
    base
        Document in which all had been settled last: what has flowed in vain goes back to it.
    """

    document: Document
    base: Document
    history: UndoHistory
    marks: Marks

"""Frames of a session: the way of its items, for films."""

from __future__ import annotations

import numpy as np

from packwork.live.document import Document
from packwork.scene.pose import Poses
from packwork.scene.track import Track, track_of

MOST, MOST_PLACES = 2_000, 400_000
"""Frames that are kept, and places of items in all; of more every other frame goes. Chosen: 16 MB.
"""


class Frames:
    """Poses from time to time, of the items that there are now.

    Parameters
    ----------
    document
        Where the film begins. It begins anew when items come or go.

    Examples
    --------
    >>> from packwork import fill
    >>> document = Document.of(fill("circle", "star", count=3, effort="draft", levels="50"))
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

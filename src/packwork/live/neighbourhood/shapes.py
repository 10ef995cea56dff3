"""Outlines simplified outwards, kept for a whole session."""

from __future__ import annotations

from packwork.compaction.arrangement import FINE
from packwork.compaction.outer_simplify import Covers
from packwork.geometry.outline import Outline


class ShapeCache:
    """Covers of outlines, as fine as the last rounds of an exact finish have them.

    Examples
    --------
    >>> import numpy as np
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [4, 0], [4, 4], [2, 4.0001], [0, 4]])])
    >>> shapes = ShapeCache()
    >>> len(shapes.cover(tile).points), shapes.cover(tile) is shapes.cover(tile)
    (4, True)
    """

    def __init__(self) -> None:
        self._covers = Covers()
        self._known: dict[Outline, Outline] = {}

    def cover(self, outline: Outline) -> Outline:
        """The outline with fewer vertices, holding all of it; made once."""
        if outline not in self._known:
            self._known[outline] = self._covers.cover(outline, FINE * outline.extent)
        return self._known[outline]

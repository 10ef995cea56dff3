"""Shapes kept for a whole session: covers of outlines, and rasters of them per level.

All that is kept depends on what was asked alone, on nothing that was asked before: a session that
is done again, without what was broken off, sees the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from packwork.compaction.arrangement import FINE
from packwork.compaction.outer_simplify import Covers
from packwork.geometry.affine import stretched
from packwork.geometry.outline import Outline
from packwork.pipeline.plan.limits import padded
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.free_space import FreeSpace
from packwork.solve.outlines import MARGIN_RUNGS, OutlineCache, simplify_for_level


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


ROUGH = 0.03
"""Tolerance of the covers by which neighbours are found, shares of an item's extent. Larger is
faster and takes items for neighbours that are not. Chosen."""

MOST = 10_000
"""Outlines that are kept at most; then all is made anew. Chosen."""


_ByPose: TypeAlias = dict[tuple[Outline, float, float], Outline]
"""Outlines as a level sees them, by outline, logarithm of size and stretch."""


class LevelCache:
    """Outlines and containers as levels see them, each made once.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container, builtin_item
    >>> sights, star = LevelCache(), builtin_item("star").outline
    >>> one = Poses(*np.ones((4, 1)))
    >>> sights.outlines([star], one, 1.0, 0.0)[0] is sights.outlines([star], one, 1.0, 0.0)[0]
    True
    """

    def __init__(self) -> None:
        self._seen: dict[tuple[float, float], tuple[OutlineCache, _ByPose]] = {}
        self._kept = set[Outline]()
        self._covers: tuple[Sequence[Outline], Sequence[float], list[Outline]] = ((), (), [])
        self._region: tuple[Container, float, Container] | None = None
        self._free_spaces: dict[int, FreeSpace] = {}

    def region(self, container: Container, padding: float) -> Container:
        """A container drawn in by half the padding."""
        known = self._region
        if known is not None and known[0] is container and known[1] == padding:
            return known[2]
        region = padded(container, padding)
        self._region, self._free_spaces = (container, padding, region), {}
        return region

    def free_space(self, region: Container, resolution: int) -> FreeSpace:
        """Free space of what :meth:`region` has answered last."""
        if resolution not in self._free_spaces:
            self._free_spaces[resolution] = FreeSpace.of(region, resolution)
        return self._free_spaces[resolution]

    def covers(self, outlines: Sequence[Outline], stretches: Sequence[float]) -> list[Outline]:
        """Outlines with few vertices that hold those given, stretched; those last asked for."""
        known, alike, found = self._covers
        if stretches != alike or any(a is not b for a, b in zip(known, outlines, strict=True)):
            found = _covered(outlines, stretches)
            self._covers = (outlines, stretches, found)
        return found

    def outlines(
        self, outlines: Sequence[Outline], poses: Poses, px_per_cu: float, margin: float
    ) -> list[Outline]:
        """Outlines at a level, see :func:`packwork.solve.outlines.simplify_for_level`."""
        if len(self._kept) > MOST:
            self._seen, self._kept = {}, set()
        self._kept.update(outlines)
        before, known = self._seen.setdefault((px_per_cu, margin), (OutlineCache(), {}))
        # Of sizes that share an outline the first would tell which: here they are the same.
        rungs = np.rint(np.log2(poses.scale) * MARGIN_RUNGS) / MARGIN_RUNGS
        keys = list(zip(outlines, rungs.tolist(), poses.stretch.tolist(), strict=True))
        if new := [k for k, key in enumerate(keys) if key not in known]:
            some = replace(poses, scale=2.0**rungs).subset(np.array(new))
            made = simplify_for_level([outlines[k] for k in new], some, px_per_cu, margin, before)
            known.update(zip([keys[k] for k in new], made, strict=True))
        return [known[key] for key in keys]


def _covered(outlines: Sequence[Outline], stretches: Sequence[float]) -> list[Outline]:
    covers, known = Covers(), dict[tuple[Outline, float], Outline]()
    for outline, stretch in zip(outlines, stretches, strict=True):
        key = (outline, stretch)
        if key not in known:
            shape = outline.mapped(stretched(stretch))
            known[key] = covers.cover(shape, ROUGH * shape.extent)
    return [known[o, s] for o, s in zip(outlines, stretches, strict=True)]

"""Simpler outlines that stand for the items while they are arranged."""

from __future__ import annotations

from collections.abc import Sequence

from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.solve.options import OutlineChoice


def stand_ins(outlines: Sequence[Outline], choice: OutlineChoice) -> list[Outline]:
    """Outlines for the stages to see, in the units and about the origin of the true ones.

    Parameters
    ----------
    outlines
        The true ones, one per item.
    choice
        ``exact`` gives them back, ``hull`` their convex hulls, one for all copies.

    Examples
    --------
    >>> dart = Outline.from_rings([[[0.0, 0], [4, 2], [0, 4], [1, 2]]])
    >>> first, second = stand_ins([dart, dart], "hull")
    >>> len(first.points), first is second
    (3, True)
    """
    if choice == "exact":
        return list(outlines)
    known: dict[Outline, Outline] = {}
    for outline in outlines:
        if outline not in known:
            known[outline] = hull(outline)
    return [known[outline] for outline in outlines]

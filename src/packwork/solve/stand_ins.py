"""Simpler outlines that stand for the items while they are arranged."""

from __future__ import annotations

from collections.abc import Sequence

from packwork.errors import ShapeError
from packwork.fit.fitted import fit_outline
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull
from packwork.solve.options import OutlineChoice


def stand_ins(outlines: Sequence[Outline], choice: OutlineChoice) -> list[Outline]:
    """Outlines for the solver to see, in the units and about the origin of the true ones.

    Copies are made once; fits of equal outlines are also remembered by the process.

    Parameters
    ----------
    outlines
        The true ones, one per item.
    choice
        ``exact`` gives them back, ``fitted`` a few cubic curves for each (Wang and Lu
        2025, section 3.1), ``hull`` their convex hulls. What cannot be fitted, because it
        crosses itself, stands for itself.

    Examples
    --------
    >>> dart = Outline.from_rings([[[0.0, 0], [4, 2], [0, 4], [1, 2]]])
    >>> first, second = stand_ins([dart, dart], "hull")
    >>> len(first.points), first is second
    (3, True)
    """
    known: dict[int, Outline] = {}
    for outline in outlines:
        if id(outline) not in known:
            known[id(outline)] = _stand_in(outline, choice)
    return [known[id(outline)] for outline in outlines]


def _stand_in(outline: Outline, choice: OutlineChoice) -> Outline:
    if choice == "hull":
        return hull(outline)
    if choice == "exact":
        return outline
    try:
        return fit_outline(outline).outline
    except ShapeError:
        return outline

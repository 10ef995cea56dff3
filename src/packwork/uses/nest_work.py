"""Work of a nest: passes by effort, so that the same bytes come on any machine; or seconds."""

from __future__ import annotations

import math
from collections.abc import Iterable

from packwork.errors import RecipeError
from packwork.phrasing import enumerated
from packwork.separation.strip import WorkBound
from packwork.uses.nested import SheetPart

PASSES: dict[str, int] = {"draft": 1_000, "normal": 10_000, "best": 100_000}
"""Passes of a search, by effort: of 50 parts some 1, 10 and 100 s on two cores. Tried."""

PER_PART = {"draft": 3, "normal": 10, "best": 100}
"""Passes for each part at least: to lay one takes one or two, so that with fewer than that some of
many parts find no room. Tried."""

LONGER = 3
"""Times the work that is advised. Chosen."""


def work_of(
    parts: Iterable[SheetPart], *, effort: str = "normal", passes: int | None = None,
    time: float | None = None,
) -> WorkBound:  # fmt: skip
    """Bound of the work on some parts.

    Parameters
    ----------
    effort
        ``"draft"``, ``"normal"`` or ``"best"``.
    passes, time
        Passes, or seconds, in place of it.

    Raises
    ------
    RecipeError
        If one has no meaning.

    Examples
    --------
    >>> work_of([]).passes, work_of([], passes=7).passes, work_of([], time=2.5).seconds
    (10000, 7, 2.5)
    """
    if effort not in PASSES:
        raise RecipeError("effort", f"is one of {enumerated([*PASSES])}, not {effort!r:.40}")
    if passes is not None and not 1 <= passes < math.inf:
        raise RecipeError("passes", f"is 1 or more, not {passes:g}")
    if time is not None and not 0.0 < time < math.inf:
        raise RecipeError("time", f"is a number of seconds above 0, not {time:g}")
    if passes is not None:
        return WorkBound(passes=passes)
    if time is not None:
        return WorkBound(seconds=time)
    count = sum(part.count for part in parts)
    return WorkBound(passes=max(PASSES[effort], PER_PART[effort] * count), name=effort)


def more_than(work: WorkBound) -> str:
    """Option that asks for more work than was allowed.

    >>> [more_than(work_of([], **asked)) for asked in ({"effort": "draft"}, {"time": 9.0})]
    ['--effort normal', '--time 27']
    """
    efforts = list(PASSES)
    if work.name in efforts[:-1]:
        return f"--effort {efforts[efforts.index(work.name) + 1]}"
    if math.isinf(work.passes):
        return f"--time {LONGER * work.seconds:.3g}"
    return f"--passes {LONGER * work.passes:.0f}"

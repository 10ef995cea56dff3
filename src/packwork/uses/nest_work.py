"""Work of a nest: places that it prices, so that the same bytes come on any machine; or seconds."""

from __future__ import annotations

import math
from collections.abc import Iterable

from packwork.errors import RecipeError
from packwork.phrasing import enumerated
from packwork.separation.strip import WorkBound
from packwork.uses.nested import SheetPart

PLACES: dict[str, int] = {"draft": 500_000, "normal": 4_000_000, "best": 40_000_000}
"""Places that a search prices, by effort: a hundred parts take some 5 s, then 20 s. Tried."""

PER_PART: dict[str, int] = {"draft": 2_000, "normal": 4_000, "best": 20_000}
"""Places for each part at least: a thousand parts on sheets take some 23 s of processor time with
4,000. More gain ever less. Tried."""

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
    >>> work_of([]).places, work_of([], passes=7).passes, work_of([], time=2.5).seconds
    (4000000, 7, 2.5)
    """
    if effort not in PLACES:
        raise RecipeError("effort", f"is one of {enumerated([*PLACES])}, not {effort!r:.40}")
    if passes is not None and time is not None:
        raise RecipeError("time", "stands in place of passes; give one of them")
    if passes is not None and not 1 <= passes < math.inf:
        raise RecipeError("passes", f"is 1 or more, not {passes:g}")
    if time is not None and not 0.0 < time < math.inf:
        raise RecipeError("time", f"is a number of seconds above 0, not {time:g}")
    if passes is not None:
        return WorkBound(passes=passes)
    if time is not None:
        return WorkBound(seconds=time)
    count = sum(part.count for part in parts)
    return WorkBound(places=max(PLACES[effort], PER_PART[effort] * count), name=effort)


def more_than(work: WorkBound) -> str:
    """Option that asks for more work than was allowed.

    >>> [more_than(work_of([], **asked)) for asked in ({"effort": "draft"}, {"time": 9.0})]
    ['--effort normal', '--time 27']
    """
    efforts = list(PLACES)
    if work.name in efforts[:-1]:
        return f"--effort {efforts[efforts.index(work.name) + 1]}"
    if math.isinf(work.passes):
        return f"--time {LONGER * work.seconds:.3g}"
    return f"--passes {LONGER * work.passes:.0f}"

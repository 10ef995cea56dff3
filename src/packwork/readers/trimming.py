"""Pages round small drawings: whether they are part of a container's canvas."""

from __future__ import annotations

from typing import TypeAlias

from packwork.readers.unfit import notice
from packwork.units import Unit, convert

SMALL = 1 / 3
"""Share of its page, across or down, that a drawing takes at least where the page is kept. By
extent, not by area: a banner on a square page is as large as can be. Larger leaves out margins
that were meant, smaller keeps postage stamps. Chosen."""

Box: TypeAlias = tuple[float, float, float, float]


def canvas_box(box: Box, page: tuple[float, float], trim: bool | None, unit: Unit | None) -> Box:
    """Left, top, width and height of the canvas: the page, or the box of what is drawn on it.

    A page in a real unit is a sheet on which the drawing has its size and place: it stays
    unless it is to be trimmed, which leaves the drawing as large as it is.

    Parameters
    ----------
    box
        Left, top, right and bottom of what is to be filled, in px.
    page
        Width and height, in px.
    trim
        What is asked for; None for what looks right, which is said.
    unit
        In which the page keeps its size; None if it is scaled to the canvas.

    Examples
    --------
    >>> canvas_box((1.0, 1.0, 9.0, 2.0), (10.0, 10.0), None, None)
    (0.0, 0.0, 10.0, 10.0)
    >>> canvas_box((1.0, 1.0, 9.0, 2.0), (10.0, 10.0), True, None)
    (1.0, 1.0, 8.0, 1.0)
    """
    left, top, right, bottom = box
    taken = max((right - left) / page[0], (bottom - top) / page[1])
    is_small = trim is None and taken < SMALL
    if is_small and unit is not None:
        width, height = (convert(side, "px", unit) for side in page)
        notice(
            f"takes {taken:.0%} of its page of {width:g} x {height:g} {unit}, which is kept; "
            "--trim leaves it out and keeps the scale"
        )
    elif is_small:
        notice(f"takes {taken:.0%} of its page, which is left out; --no-trim keeps it")
    if trim or (is_small and unit is None):
        return left, top, right - left, bottom - top
    return 0.0, 0.0, *page

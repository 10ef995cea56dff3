"""Gap and turns that exact moves keep, for every stage that makes them."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from packwork.options import Options

HAIR = 1e-5
"""Gap kept beyond the one asked for, as a share of the canvas. Derived: ten times the precision of
the files that are written, so that what was checked still holds when it is read back. Larger wastes
room."""

HOPELESS = 0.3
"""Logarithm of size an item may lose before the smaller one of a pair in conflict is moved to a
void. Smaller moves items that had a place, larger makes dwarfs. Tried."""


class MoveOptions(Options):
    """Gap that items keep, turns that they may make, and the seed of what is random."""

    gap_cu: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    """Gap between items and to the container's edge, canvas units. A hair is added:
    :data:`HAIR` of the canvas."""

    turning: bool = True
    """False keeps every angle as it is."""

    turn_limit: Annotated[float, Field(ge=0)] | None = None
    """Largest turn from upright, rad; None for any."""

    leans: tuple[float, ...] | None = None
    """With a limit: least tilt of each item, rad, to the side of its sign; 0 for either side."""

    still: tuple[bool, ...] | None = None
    """Items that keep their angle; None for none."""

    seed: Annotated[int, Field(ge=0)] = 0
    """Of the trials."""

"""What a finish is asked to do."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from packwork.options import Options

SizeMode: TypeAlias = Literal["free", "shared", "fixed"]

HAIR = 1e-5
"""Gap kept beyond the one asked for, as a share of the canvas: ten times the precision
of the files that are written, so that what was checked still holds when it is read back.
Larger wastes room (this one 0.1 % of it with 100 items). Derived."""


HOPELESS = 0.3
"""Logarithm of size an item may lose before the smaller one of a pair in conflict is moved
to a void instead. Smaller moves items that had a place, larger makes dwarfs. Tried."""

HOPELESS_AT_HOME = 1.0
"""The same of items that are to stay near where they were: they may grow back, and do. Smaller
lets some jump across the layout, larger leaves dwarfs where there is no room. Tried."""


class FinishOptions(Options):
    """Gap, size mode, turns and rounds of one finish."""

    gap_cu: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    """Gap between items and to the container's edge, canvas units. A hair is added:
    :data:`HAIR` of the canvas."""

    sizes: SizeMode = "free"
    """free: each item's scale varies; shared: one common factor; fixed: none."""

    smallest: tuple[float, ...] | None = None
    """In mode free: smallest scale of each item; half of what it was given at if None."""

    largest: tuple[float, ...] | None = None
    """In mode free: largest scale of each item; twice what it was given at if None."""

    turning: bool = True
    """False keeps every angle as it is."""

    turn_limit: Annotated[float, Field(ge=0)] | None = None
    """Largest turn from upright, rad; None for any."""

    leans: tuple[float, ...] | None = None
    """With a limit: least tilt of each item, rad, to the side of its sign; 0 for either side."""

    rounds: Annotated[int, Field(ge=1, le=10_000)] = 24
    """Linear programmes of each item in one compaction. More fills a little better."""

    refining: bool = False
    """The layout is clean already: small steps, so that nothing is lost, and no trials."""

    staying: bool = False
    """With ``refining``: the layout is clean but for a few items, which were made larger or
    are new; where sizes are shared, all end at one."""

    trials: Annotated[int, Field(ge=0, le=1_000_000)] = 0
    """Turns and exchanges of items that are tried after the first compaction."""

    relieving: bool = True
    """Where sizes are shared: try whether all can grow once those that hold them back lie in
    voids."""

    seed: Annotated[int, Field(ge=0)] = 0
    """Of the trials."""

    @property
    def hopeless(self) -> float:
        """Logarithm of size that an item in conflict may lose before one is moved to a void."""
        return HOPELESS_AT_HOME if self.staying else HOPELESS

"""Options of the finish."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from packwork.compaction.options import HOPELESS, MoveOptions
from packwork.options import SizeMode

HOPELESS_AT_HOME = 1.0
"""The same as :data:`HOPELESS` of items that are to stay near where they were. Smaller lets some
jump across the layout, larger leaves dwarfs where there is no room. Tried."""


class FinishOptions(MoveOptions):
    """Gap, size mode, turns and rounds of one finish."""

    sizes: SizeMode = "free"
    """free: each item's scale varies; shared: one common factor; fixed: none."""

    smallest: tuple[float, ...] | None = None
    """In mode free: smallest scale of each item; half of what it was given at if None."""

    largest: tuple[float, ...] | None = None
    """In mode free: largest scale of each item; twice what it was given at if None."""

    rounds: Annotated[int, Field(ge=1, le=10_000)] = 24
    """Linear programmes of each item in one compaction. More fills a little better."""

    refining: bool = False
    """The layout is clean already: small steps, so that nothing is lost."""

    staying: bool = False
    """With ``refining``: the layout is clean but for a few items, which were made larger or
    are new; where sizes are shared, all end at one."""

    loosened: bool = False
    """With ``refining``: items have lost room, and first steps are as wide as in any finish."""

    covered: bool = False
    """The outlines are simplified covers of the items, and the container's is of those about them:
    nothing is simplified again."""

    trials: Annotated[int, Field(ge=0, le=1_000_000)] = 0
    """Turns and exchanges of items that are tried after the first compaction."""

    exchanging: bool = True
    """Whether such trials exchange items; else each is only turned where it is."""

    keeps_order: bool = False
    """What is in conflict is moved to a void only where nothing else helps."""

    relieving: bool = True
    """Where sizes are shared: try whether all can grow once those that hold them back lie in
    voids."""

    @property
    def hopeless(self) -> float:
        """Logarithm of size that an item in conflict may lose before one is moved to a void."""
        return HOPELESS_AT_HOME if self.staying or self.keeps_order else HOPELESS

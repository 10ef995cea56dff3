"""What a solve is asked to do."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field

SizeMode: TypeAlias = Literal["free", "shared", "fixed"]


class SolveOptions(BaseModel):
    """Levels, epochs, modes and steps of one solve."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    levels: Annotated[tuple[Annotated[int, Field(ge=8, le=8192)], ...], Field(min_length=1)] = (
        50,
        200,
        600,
    )
    """Pixels on the canvas' longer side, coarse to fine."""

    epochs: Annotated[int, Field(ge=1, le=100_000)] = 600
    """Optimisation steps in all, shared evenly among the levels."""

    sizes: SizeMode = "free"
    """free: each item's scale varies; shared: one common factor; fixed: none."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """In mode free: how far up or down from its nominal scale an item may go."""

    turn_rate: Annotated[float, Field(ge=0, le=1)] = 0.05
    """Longest turn in one epoch, rad; 0 keeps the start angles. The paper's own."""

    turn_limit: Annotated[float, Field(gt=0)] | None = None
    """Largest turn from upright, rad; None for any."""

    position_rate: Annotated[float, Field(gt=0, le=1)] = 0.008
    """Longest move in the first epoch, as a share of the canvas' longer side. Larger
    mixes the items more, smaller keeps the start. Tried."""

    size_rate: Annotated[float, Field(gt=0, le=1)] = 0.03
    """Largest change of log scale in the first epoch. Tried."""

    cooling: Annotated[float, Field(gt=0, le=1)] = 0.05
    """Rates at the end of the run over those at its begin. Smaller settles finer but
    stops earlier. Tried."""

    overlap: Annotated[float, Field(ge=0)] = 4.0
    """Weight of the overlap loss at the begin, filling being 1."""

    containment: Annotated[float, Field(ge=0)] = 4.0
    """Weight of the containment loss at the begin, filling being 1."""

    hardening: Annotated[float, Field(ge=1)] = 8.0
    """By how much those two weights grow over the run. Larger ends cleaner and emptier.
    Tried."""

    losses: dict[str, float] = Field(default_factory=dict)
    """Further image losses by name or module:function, with their weights."""

    herd: bool = True
    """Between levels, move items that are mostly overlapped into the largest voids."""

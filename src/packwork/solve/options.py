"""What a solve is asked to do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field

SizeMode: TypeAlias = Literal["free", "shared", "fixed"]

MIN_RESOLUTION = 8
"""Coarsest level, px: coarser ones show no item. Chosen."""

MAX_RESOLUTION = 8_192
"""Finest level, px: the renderer's largest image."""

ImageLossFunction: TypeAlias = Callable[..., Any]
"""An ImageLoss; its own type would bring numpy to the command line's help."""

Resolution: TypeAlias = Annotated[int, Field(ge=MIN_RESOLUTION, le=MAX_RESOLUTION)]


class SolveOptions(BaseModel):
    """Levels, epochs, modes and steps of one solve."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    levels: Annotated[tuple[Resolution, ...], Field(min_length=1)] = (50, 200, 600)
    """Pixels on the canvas' longer side, coarse to fine."""

    shares: tuple[Annotated[float, Field(gt=0, allow_inf_nan=False)], ...] | None = None
    """How the epochs are shared among the levels; evenly if None."""

    epochs: Annotated[int, Field(ge=1, le=1_000_000)] = 1_000
    """Optimisation steps in all."""

    sizes: SizeMode = "free"
    """free: each item's scale varies; shared: one common factor; fixed: none."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """In mode free: how far up or down from its nominal scale an item may go."""

    margin: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    """Canvas units by which items are taken for larger than they are, all round."""

    turn_rate: Annotated[float, Field(ge=0, le=1)] = 0.5
    """Longest turn in one epoch, rad; 0 keeps the start angles. Tried
    (the paper: 0.05)."""

    turn_limit: Annotated[float, Field(gt=0)] | None = None
    """Largest turn from upright, rad; None for any."""

    position_rate: Annotated[float, Field(gt=0, le=1)] = 0.022
    """Longest move in the first epoch, as a share of the canvas' longer side. Larger
    mixes the items more, smaller keeps the start. Tried."""

    size_rate: Annotated[float, Field(gt=0, le=1)] = 0.22
    """Largest change of log scale in the first epoch. Tried."""

    cooling: Annotated[float, Field(gt=0, le=1)] = 0.0045
    """Rates at the end of the run over those at its begin. Smaller settles finer but
    stops earlier. Tried."""

    overlap: Annotated[float, Field(ge=0)] = 4.0
    """Weight of the overlap loss at the begin, filling being 1."""

    containment: Annotated[float, Field(ge=0)] = 3.0
    """Weight of the containment loss at the begin, filling being 1."""

    hardening: Annotated[float, Field(ge=1)] = 45.0
    """By how much those two weights grow over the run. Larger ends cleaner and emptier.
    Tried."""

    settling: Annotated[float, Field(ge=0, lt=1)] = 0.055
    """Last share of the run, in which the reward for filling is cut: items draw back
    from each other. Larger ends cleaner and emptier. Tried."""

    settling_filling: Annotated[float, Field(ge=0, le=1)] = 0.35
    """Weight of the filling loss while settling. Tried."""

    momentum: Annotated[float, Field(ge=0, lt=1)] = 0.54
    """Decay of Adam's first moment (the paper: 0.9). Forces here change at every
    contact, so a long memory overshoots. Tried."""

    memory: Annotated[float, Field(ge=0, lt=1)] = 0.96
    """Decay of Adam's second moment (the paper: 0.9). Tried."""

    losses: dict[str | ImageLossFunction, float] = Field(default_factory=dict)
    """Further image losses by name, module:function or as functions, with weights."""

    herd: bool = True
    """Between levels and half-way through the last one, move items that are badly
    overlapped into the largest voids."""

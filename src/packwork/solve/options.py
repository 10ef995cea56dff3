"""Options of a solve."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field

from packwork.options import Options, SizeMode

OutlineChoice: TypeAlias = Literal["exact", "hull"]

MIN_RESOLUTION = 8
"""Coarsest level, px: coarser ones show no item. Chosen."""

MAX_RESOLUTION = 8_192
"""Finest level, px: the renderer's largest image."""

MAX_STRETCH = 100.0
"""Most that an item may be stretched: beyond it nothing is left to recognise. Chosen."""

ImageLossFunction: TypeAlias = Callable[..., Any]
"""An ImageLoss; its own type would bring numpy to the command line's help."""

Resolution: TypeAlias = Annotated[int, Field(ge=MIN_RESOLUTION, le=MAX_RESOLUTION)]

Weight: TypeAlias = Annotated[float, Field(allow_inf_nan=False)]


def _default_losses() -> dict[str | ImageLossFunction, float]:
    return {"containment": 5.5, "overlap": 5.5, "filling": 1.0, "evenness": 1.9}


class SolveOptions(Options):
    """Levels, epochs, modes and steps of one solve."""

    levels: Annotated[tuple[Resolution, ...], Field(min_length=1)] = (50, 200, 600)
    """Pixels on the canvas' longer side, coarse to fine."""

    shares: tuple[Annotated[float, Field(gt=0, allow_inf_nan=False)], ...] | None = None
    """How the epochs are shared among the levels; evenly if None."""

    epochs: Annotated[int, Field(ge=1, le=1_000_000)] = 1_000
    """Optimisation steps in all."""

    seconds: Annotated[float, Field(ge=0, allow_inf_nan=False)] | None = None
    """Time for all levels, instead of a number of epochs."""

    sizes: SizeMode = "free"
    """free: each item's scale varies; shared: one common factor; fixed: none."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """In mode free: how far up or down from its nominal scale an item may go."""

    stretch: Annotated[float, Field(ge=1, le=MAX_STRETCH, allow_inf_nan=False)] = 1.0
    """How far an item's width may grow against its height, or its height against its
    width; 1 keeps all proportions."""

    margin: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    """Canvas units by which items are taken for larger than they are, all round."""

    turn_rate: Annotated[float, Field(ge=0, le=1)] = 0.5
    """Longest turn in one epoch, rad; 0 keeps the start angles. Tried
    (the paper: 0.05)."""

    turn_limit: Annotated[float, Field(gt=0)] | None = None
    """Largest turn from upright, rad; None for any."""

    leans: tuple[float, ...] | None = None
    """With a limit: least tilt of each item, rad, to the side of its sign; 0 for either side."""

    position_rate: Annotated[float, Field(gt=0, le=1)] = 0.022
    """Longest move in the first epoch, as a share of the canvas' longer side. Larger
    mixes the items more, smaller keeps the start. Tried."""

    size_rate: Annotated[float, Field(gt=0, le=1)] = 0.22
    """Largest change of log scale in the first epoch. Tried."""

    stretch_rate: Annotated[float, Field(gt=0, le=1)] = 0.1
    """Largest change of log stretch in the first epoch. Tried."""

    cooling: Annotated[float, Field(gt=0, le=1)] = 0.0045
    """Rates at the end of the run over those at its begin. Smaller settles finer but
    stops earlier. Tried."""

    losses: dict[str | ImageLossFunction, Weight] = Field(default_factory=_default_losses)
    """Losses by name, module:function or as functions, with their weights at the begin.
    Only ratios count. Tried."""

    recall: Weight = 5.5
    """Weight of what calls back items that left the container or the canvas; about
    containment's. Chosen."""

    hardening: Annotated[float, Field(ge=1)] = 45.0
    """By how much recall and all losses but filling grow over the run. Larger ends cleaner
    and emptier. Tried."""

    settling: Annotated[float, Field(ge=0, lt=1)] = 0.055
    """Last share of the run, in which the rewards for filling and evenness are cut: items
    draw back from each other. Larger ends cleaner and emptier. Tried."""

    settling_reward: Annotated[float, Field(ge=0, le=1)] = 0.35
    """Factor on filling and evenness while settling. Tried."""

    momentum: Annotated[float, Field(ge=0, lt=1)] = 0.54
    """Decay of Adam's first moment (the paper: 0.9). Forces here change at every
    contact, so a long memory overshoots. Tried."""

    memory: Annotated[float, Field(ge=0, lt=1)] = 0.96
    """Decay of Adam's second moment (the paper: 0.9). Tried."""

    relocating: bool = True
    """Between levels and half-way through the last one, relocate items that are badly
    overlapped to the largest voids."""

    exchanging: bool = True
    """Let items change places among parts, for forces and away from their kind."""

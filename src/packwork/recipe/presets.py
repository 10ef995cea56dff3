"""Named sets of choices: our own, and the paper's as published."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from packwork.solve.options import SolveOptions
from packwork.start.options import StartOptions


@dataclass(frozen=True)
class Preset:
    """Base of a recipe; the recipe's own options go before.

    Parameters
    ----------
    coverage
        Share of the container that items cover at the start.
    """

    solve: SolveOptions
    coverage: float


DEFAULT = Preset(
    solve=SolveOptions(levels=(50, 200, 600), shares=(9, 23, 68)),
    coverage=StartOptions.model_fields["coverage"].default,
)

PAPER = Preset(
    # Wang and Lu 2025, section 3 and supplement. Where they are silent, the choice is
    # that of their published code, as far as it shows, or else marked as ours.
    solve=SolveOptions(
        levels=(50, 200, 600),
        shares=None,  # even
        losses={
            "paper-containment": 3e3,  # alpha; squared error, 1 inside to 100 outside
            "overlap": 8e4,  # beta; mean of max(density - 1, 0): their indicator has no gradient
            # gamma = 5e-4 of a sum over an image of 600 x 600 px, ours being a mean: as a
            # mean of its own it would move nothing. Windows of 5 to 35 px, weights 1 to 6.
            "paper-evenness": 180.0,
        },
        recall=6e5,  # ours: alpha times the slope of their squared error at one item outside
        momentum=0.9,
        memory=0.9,
        position_rate=1.1e-3,  # 1.1 per 1,000 canvas units
        turn_rate=0.05,
        size_rate=5e-3,  # theirs acts on the scale, ours on its logarithm: no size turns negative
        stretch_rate=5e-3,
        cooling=1.0,  # steps do not shrink
        hardening=1.0,  # weights do not grow
        settling=0.0,
        relocating=False,
    ),
    coverage=0.55,
)

PRESETS: Mapping[str, Preset] = MappingProxyType({"default": DEFAULT, "paper": PAPER})

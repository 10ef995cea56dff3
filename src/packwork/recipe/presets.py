"""Resolutions of the levels, and named sets of choices: our own, and the paper's as published."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from packwork.errors import RecipeError
from packwork.solve.options import MAX_RESOLUTION, MIN_RESOLUTION, SolveOptions
from packwork.start.options import StartOptions

LEAST_PITCH_PX = 25.0
"""Pixels of the finest level that the default gives an item to each side. Fewer leave overlaps
that the finish pays for with coverage; more cost time and gain nothing. Tried."""

MOST_REFINED = 2.0
"""How much finer than usual the levels may get for that: twice takes four times the pixels.
More gains little. Tried."""


LEAST_COARSE_PX = 2.1
"""Pixels of a level to each side of an item below which the level is left out: it shows no
item, and drives them from their places. Larger leaves out levels that mix them. Tried."""

FEWER_EPOCHS = 0.75
"""Share of the epochs that is made without it. With 1,000 and 10,000 items these cover 0.003 to
0.007 more of a bear and a heart than all epochs with it do. Measured."""


def parse_levels(text: str) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Resolutions and their shares of the epochs from ``50:9,200:23,600:68``.

    Examples
    --------
    >>> parse_levels("50,600")
    ((50, 600), (1.0, 1.0))
    """
    levels, shares = [], []
    for part in text.split(","):
        resolution, _, share = part.partition(":")
        try:
            levels.append(int(resolution))
            shares.append(float(share or 1))
        except ValueError:
            raise _bad_levels(text) from None
    if not all(MIN_RESOLUTION <= level <= MAX_RESOLUTION for level in levels):
        raise RecipeError(
            "levels", f"a level has {MIN_RESOLUTION} to {MAX_RESOLUTION} px, not {text!r}"
        )
    if not all(math.isfinite(share) and share > 0 for share in shares):
        raise _bad_levels(text)
    return tuple(levels), tuple(shares)


def refined_levels(
    levels: tuple[int, ...], side: float, room: float, count: int
) -> tuple[int, ...]:
    """Levels fine enough for small items.

    Parameters
    ----------
    levels
        Resolutions, coarse to fine.

    Examples
    --------
    >>> refined_levels((50, 200, 600), 600.0, 600.0**2 / 2, 100)
    (50, 200, 600)
    >>> refined_levels((50, 200, 600), 600.0, 600.0**2 / 2, 1_000)
    (93, 373, 1118)
    """
    pitch_px = math.sqrt(room / count) * levels[-1] / side
    factor = min(max(LEAST_PITCH_PX / pitch_px, 1.0), MOST_REFINED)
    return tuple(round(level * factor) for level in levels)


def _bad_levels(text: str) -> RecipeError:
    return RecipeError(
        "levels", f"use resolutions like 50,200,600 or 50:9,200:23,600:68, not {text!r}"
    )


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

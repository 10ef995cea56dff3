"""Plan of a run, in numbers: a recipe resolved against the container that was read."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from packwork.errors import RecipeError
from packwork.pipeline.plan.counts import TYPICAL_RATIO, widest_cu
from packwork.readers.regions import Holes
from packwork.recipe import APART, EPOCHS, Effort, Recipe
from packwork.recipe.pictures import Shades
from packwork.recipe.presets import PRESETS, Preset, parse_levels
from packwork.recipe.refusals import validated
from packwork.recipe.rules import Rotation
from packwork.scene.container import Container
from packwork.scene.palette import palette_colours
from packwork.solve.options import ImageLossFunction, OutlineChoice, SolveOptions
from packwork.start.options import StartOptions

PHOTO_TRIALS = 6
"""How many times as many trials of photos: rectangles have few corners and are tried faster. 60
photos, seeds 0 to 2, of the best of three starts: with 4, a mean of 0.890 on the fish, 0.927 on the
moon, 0.913 on the heart; with 6, 0.893, 0.928, 0.914 and 0.2 s more. From one start, 12 gain 0.0003
over 8 on the fish. Measured."""

FoundSizes: TypeAlias = Literal["free", "shared", "fixed", "graded"]

THIN = 0.19
"""Area of the largest disc in a container, as a share of the container's, below which it counts as
thin. Larger lets sizes of words give way in fat shapes. Chosen: logos of lines and maps have 0.04
to 0.19; there 100 words in proportion draw on 5 to 24 %, words that give way on 26 to 49 %."""

USUAL_DETAIL = 0.5
"""How far sizes follow a picture unless it is asked. Smaller lets eyes and lines vanish, larger
shows soft shades by few large items. Chosen by eye; colour distances of 0 and 0.5 are equal."""

SHOWING_RATIO = 1.5
"""Usual ``size_ratio`` of a layout that shows a picture. Larger shows less of it where
items are large, smaller fills less. Chosen by eye."""

Losses = Mapping[str | ImageLossFunction, float]


@dataclass(frozen=True)
class VoidPlan:
    """Plan for filling voids after the exact finish.

    Parameters
    ----------
    target
        Share of the container to cover; None for as much as goes.
    most
        Items in all at most; None for as many as is usual.
    smallest
        Longer side of the smallest copy, canvas units.
    has_own
        Whether other items than copies of the placed ones go into voids.
    """

    target: float | None
    most: int | None
    smallest: float
    has_own: bool
    fills: bool = True

    @property
    def enough(self) -> float:
        """Share of the container from which no more is put into voids."""
        return math.inf if self.target is None else self.target


NO_VOIDS = VoidPlan(None, None, math.inf, has_own=False, fills=False)
"""Plan of runs that leave voids as they are."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Plan:
    """Numbers and choices of one run; parts of a run ``dataclasses.replace`` some of them.

    The recipe is what was asked, and nothing changes it. Options of the stages are derived from
    the plan when a stage begins, so one changed field changes all that depends on it.

    Parameters
    ----------
    gap
        Between items, and from them to the container's edge, canvas units.
    sizes, size_ratio, has_own_ratio, stretch
        How sizes are found, how far free ones go, whether that was asked, how much items may be
        stretched.
    rotation
        How far items may turn unless a rule says otherwise.
    keeps_apart, keeps_order
        Whether copies of one item are not to lie side by side, and whether items are put in an
        order that later stages have to keep.
    method
        How first places are found; None for what suits.
    is_from_layout, stays
        Whether the run begins from an earlier layout, and whether items stay near it.
    outline
        What stands for an item in the levels.
    preset, levels, losses
        What the levels begin from, and what was asked of them in its place.
    effort, epochs, seconds
        How long is tried: as usual for that effort, or as many epochs, or so much time.
    trial_factor
        How many times the usual number of trials the finish makes.
    leans
        Whether photographs are balanced about upright.
    share
        Shares of area of words, photos and other items; None for none.
    least_dpi
        Pixels to the inch that photographs keep; None for any.
    palette, shades
        Colours that items take on, none to keep their own; what drawings of several do.
    tint
        How far items take on the colours of a picture; None for as usual.
    detail
        How far sizes follow how much a picture has to show in their places, 0..1.
    has_even_lines, holes
        Whether lines of line drawings come out alike, and what becomes of holes in items.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container
    >>> from packwork.recipe import make_recipe
    >>> plan = Plan.of(make_recipe(container="heart", padding="1%"), builtin_container("heart"))
    >>> plan.gap, plan.solve_options().margin
    (6.0, 3.0)
    """

    gap: float
    sizes: FoundSizes
    size_ratio: float
    has_own_ratio: bool
    stretch: float
    rotation: Rotation
    has_own_turns: bool
    keeps_apart: bool
    keeps_order: bool
    method: str | None
    is_from_layout: bool
    stays: bool
    outline: OutlineChoice
    preset: Preset
    levels: str | None
    losses: Losses
    effort: Effort
    epochs: int | None
    seconds: float | None
    is_exact: bool
    trial_factor: int
    leans: bool
    forces: tuple[str, ...]
    share: Mapping[str, float] | None
    least_dpi: float | None
    voids: VoidPlan
    palette: tuple[str, ...]
    shades: Shades
    tint: float | None
    detail: float
    has_even_lines: bool
    holes: Holes
    seed: int

    @classmethod
    def of(cls, recipe: Recipe, container: Container) -> Plan:
        """Plan of a recipe for a container on its canvas."""
        sizes = found_sizes(recipe, container)
        plan = cls(
            gap=recipe.padding_cu(container),
            sizes=sizes,
            size_ratio=recipe.size_ratio or (SHOWING_RATIO if recipe.picture else TYPICAL_RATIO),
            has_own_ratio=recipe.size_ratio is not None,
            stretch=recipe.stretch,
            rotation=recipe.rotation,
            has_own_turns=any(rule.rotate for rule in recipe.rules),
            keeps_apart=recipe.keeps_apart,
            keeps_order=bool(recipe.arrange or recipe.embeddings) and not recipe.stay,
            method=None if recipe.layout_file else recipe.start,
            is_from_layout=recipe.layout_file is not None,
            stays=recipe.stay,
            outline=recipe.outline,
            preset=PRESETS[recipe.preset],
            levels=recipe.levels,
            losses=recipe.losses,
            effort=recipe.effort,
            epochs=recipe.epochs,
            seconds=recipe.time,
            is_exact=recipe.finish == "exact",
            trial_factor=1 if recipe.photos is None else PHOTO_TRIALS,
            leans=recipe.photos is not None and not recipe.layout_file,
            forces=tuple(recipe.force or ()),
            share=recipe.share,
            least_dpi=recipe.least_dpi,
            voids=void_plan(recipe, container) if recipe.fills_gaps else NO_VOIDS,
            palette=() if recipe.palette is None else tuple(palette_colours(recipe.palette)),
            shades=recipe.shades,
            tint=recipe.tint,
            detail=_detail(recipe, sizes) if recipe.picture else 0.0,
            has_even_lines=recipe.stroke_width == "even",
            holes=recipe.holes,
            seed=recipe.seed,
        )
        plan.start_options()
        return plan

    def start_options(self) -> StartOptions:
        """Options of the start stage."""
        if self.is_from_layout:
            return StartOptions()
        method = "distance-field" if self.method is None else self.method
        asked = {"method": method, "coverage": self.preset.coverage}
        return validated(StartOptions, asked, {"method": "start"})

    def solve_options(self, seconds: float | None = None) -> SolveOptions:
        """Options of the levels.

        Parameters
        ----------
        seconds
            Time for all of them in place of epochs; None for none.
        """
        changes: dict[str, Any] = {}
        if not self.has_own_turns:
            # Where rules turn items each in their own way, the limits of items hold.
            turns = self.rotation
            changes = {"turn_rate": 0.0} if turns.is_still else {"turn_limit": turns.limit}
        preset = self.preset.solve
        if self.levels is not None:
            changes["levels"], changes["shares"] = parse_levels(self.levels)
        losses = {**preset.losses, "apart": APART * self.keeps_apart, **self.losses}
        if "evenness" not in self.losses and not (self.sizes == "free" and self.gap == 0):
            # Items that are pressed together for even gaps would cost overlap.
            losses.pop("evenness", None)
        changes |= {
            "epochs": self.epochs or EPOCHS[self.effort],
            "seconds": seconds,
            # Graded ones are free within bounds of each item's own.
            "sizes": "free" if self.sizes == "graded" else self.sizes,
            "size_ratio": self.size_ratio,
            "stretch": self.stretch,
            "losses": {loss: weight for loss, weight in losses.items() if weight},
            "margin": self.gap / 2,
        }
        return SolveOptions(**{**dict(preset), **changes})


def found_sizes(recipe: Recipe, container: Container) -> FoundSizes:
    """Mode of finding sizes: as asked, or else as suits words here, if nothing hinders.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container
    >>> from packwork.recipe import make_recipe
    >>> asked = make_recipe(container="heart", words={"source": {"ox": 1}}, sizes="auto")
    >>> [found_sizes(asked, builtin_container(name)) for name in ("heart", "ring")]
    ['shared', 'graded']
    """
    if recipe.sizes != "auto":
        return recipe.sizes
    disc = math.pi * (widest_cu(container.outline) / 2) ** 2
    return "graded" if disc < THIN * container.outline.area else "shared"


def void_plan(recipe: Recipe, container: Container) -> VoidPlan:
    """Plan for voids of a container on a recipe's canvas."""
    return VoidPlan(
        recipe.target_coverage, recipe.max_items, recipe.smallest_cu(container), bool(recipe.filler)
    )


def _detail(recipe: Recipe, sizes: str) -> float:
    """Degree to which sizes follow the picture that is shown, if they can.

    Unless it is asked, those of photos do not: fewer of them find a place where their colours fit.
    """
    clash = None
    if sizes != "free":
        clash = f"makes sizes follow the picture, and they are {sizes}; use --sizes free"
    elif recipe.start is not None:
        clash = "chooses places by the picture; leave --start out"
    elif any(rule.region is not None for rule in recipe.rules):
        clash = "chooses places by the picture, and a rule keeps items to a region; leave one out"
    if clash is None:
        usual = 0.0 if recipe.photos is not None else USUAL_DETAIL
        return usual if recipe.detail is None else recipe.detail
    if recipe.detail:
        raise RecipeError("detail", clash)
    return 0.0

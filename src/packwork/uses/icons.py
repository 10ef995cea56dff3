"""Icons and drawings: the plain use, whose items' files say all about them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.quadratic import cheapest
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.copies import Cast, expand_copies
from packwork.pipeline.plan.counts import LEAST, MOST, TYPICAL_RATIO, items_needed, no_container
from packwork.pipeline.read import Material, drawn_first, read_named
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.raster.coverage import coverage
from packwork.recipe import AUTO, Recipe
from packwork.recipe.rules import Rotation
from packwork.scene.container import Container
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.item import Item, PhotoArt
from packwork.scene.recolour import run_together
from packwork.scene.swatch import mean_lights
from packwork.scene.target import TargetPicture, blurred
from packwork.steps.close_gap import RemarkApart
from packwork.steps.control import BestOf, Replan, Retry
from packwork.steps.starts import fits_first, may_rearrange
from packwork.uses.collage import filling, jamming, placing, reporting

NO_CONTAINER = "none"
"""Name for no container at all: a pile lies anywhere, a chart's groups are bars."""


MOST_SEPARATED = 40
"""Items of one common scale for which another arrangement is sought. More gain little in long:
decision 0045. Measured."""


FEW, MANY = 6, 60
"""Items of free sizes up to which each is looked at by itself, and from which a crowd is: between
them they turn and vary ever more. Larger keep items near upright that fill better by turning. By
eye, of 7 to 70 icons of three sets in five containers."""

BEND = 4
"""Power of the way from few to many by which turns and sizes are let go. Larger keeps 40 more alike
and changes more towards the end. By eye: 40 may turn by 41 degrees."""

NEAR_UPRIGHT, ALIKE = 15.0, 1.5
"""Degrees that each of few items may turn, and how many times their sizes may differ from the
nominal ones. Larger look thrown down, smaller cover less. By eye."""

STARTS = {"draft": 0, "normal": 5, "best": 24}
"""Such starts of few items by effort, each about 0.3 s; of more, as many as take that time. More
cover a little more. Tried."""

STRIDE = 1_000_003
"""Between the seeds of starts, so that those of neighbouring seeds differ. Chosen."""

AS_FULL = 0.75
"""Share of a plain layout's cover from which one of items alike and upright is better. Larger
leaves more of them on their heads, smaller leaves room bare. By eye."""

ONE_COLOUR_GAP = 0.04
"""Gap between drawings of one colour, over the side of an item's share of the container. Larger
covers less, smaller runs lines of drawings together. By eye, of 40 and 200 icons in lines."""

FULL = 0.6
"""Share of the container that is covered well enough not to ask what a plain layout covers, which
is 0.8 at most. Larger takes longer. Derived from ``AS_FULL``."""


@dataclass(frozen=True, eq=False)
class KnownContainer:
    """The container of a run."""

    container: Container | None

    @property
    def known(self) -> Container:
        """The container."""
        if self.container is None:
            raise no_container()
        return self.container

    def of(self, cast: Cast) -> Container:
        """Container that these items are placed in."""
        del cast
        return self.known

    def needed(self, recipe: Recipe, items: Sequence[Item]) -> int:
        """Number of items at which the container's shape shows: more of thin and branched ones."""
        needed = items_needed(self.known, recipe.sizes, recipe.size_ratio or TYPICAL_RATIO).count
        outlines = [item.outline for item in items]
        solidity = np.mean([one.area for one in outlines] / hull_areas(outlines))
        return max(needed, min(MOST, math.ceil(LEAST / solidity)), len(items))


def suited_first(
    recipe: Recipe, container: Container, items: tuple[Item, ...]
) -> tuple[tuple[Item, ...], TargetPicture | None]:
    """Items in the order in which they are taken, those that show the picture best first.

    As they are where none is left out, or none keeps colours of its own; else the picture beside.
    """
    count, tint = recipe.count, recipe.tint
    are_photos = all(isinstance(item.art, PhotoArt) for item in items)
    keeps_none = tint == 1.0 or (tint is None and not are_photos)
    if recipe.picture is None or keeps_none or not isinstance(count, int) or count >= len(items):
        return items, None
    # Only what is asked for loads the picture library.
    from packwork.readers.target import read_target

    target = read_target(recipe.picture, container, recipe.read_options)
    best = best_suited(mean_lights(items), _wanted(target, container, count))
    rest = np.setdiff1d(np.arange(len(items)), best)
    return tuple(items[k] for k in (*best, *rest)), target


def best_suited(lights: FloatArray, wanted: FloatArray) -> IntArray:
    """``(m,)`` ascending indices of the items by which wanted colours are met best, one by each.

    Parameters
    ----------
    lights
        ``(n, 3)`` light of items.
    wanted
        ``(m, 3)`` light, no more than items.

    Examples
    --------
    >>> lights = np.array([[1.0, 0, 0], [0, 0, 1.0], [0.9, 0, 0], [0, 1.0, 0]])
    >>> best_suited(lights, np.array([[1.0, 0, 0], [0.9, 0, 0]])).tolist()
    [0, 2]
    """
    own, asked = oklabs_of_light(lights), oklabs_of_light(wanted)
    away = ((own[None] - asked[:, None]) ** 2).sum(axis=2)
    return np.sort(cheapest(away))


def _wanted(target: TargetPicture, container: Container, count: int) -> FloatArray:
    """``(count, 3)`` light of the picture at places all over the container."""
    outline = container.outline
    shape = target.light.shape[:2]
    inside = coverage(outline.points * target.px_per_cu, outline.starts, shape) > 0.5
    light = blurred(target.light, 1.0, count)[inside]
    return np.asarray(light[np.linspace(0, len(light) - 1, count).astype(int)])


@final
class IconsUse(Use):
    """Items whose files say all about them."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Places, levels, finish; voids if asked; measures and looks."""
        if not runs_together(job):
            return self._listed(job)
        gap = one_colour_gap(job.container, len(job.items))
        return [Replan(gap=gap), *self._listed(job.replanned(gap=gap)), RemarkApart()]

    def _listed(self, job: Job) -> list[RunStep]:
        if job.plan.sizes == "shared":
            placed = jamming(job) or placing(
                job, suits_first_fit=fits_first(job), bounds=separation(job)
            )
        else:
            # First fit is not tried.
            placed = placing(job, suits_first_fit=False)
            if tried := alike_upright(job):
                placed = [Retry([BestOf(tried, best_balanced)], placed, is_full, fuller)]
                placed.append(as_asked(job))
        return [*placed, *filling(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False)


def one_colour_gap(container: Container, count: int) -> float:
    """Gap, canvas units, by which drawings of one colour are told apart."""
    region = container.outline.region
    width = 2.0 * region.area / region.length
    return ONE_COLOUR_GAP * min(math.sqrt(region.area / count), float(width))


def runs_together(job: Job) -> bool:
    """Whether neighbours that touch would be read as one, and the run finds the padding."""
    plan = job.plan
    if job.recipe.padding != AUTO or not plan.is_exact:
        return False
    # An earlier layout keeps its own gaps.
    if plan.is_from_layout or keeps_gaps(plan.sizes, vars(job.recipe)):
        return False
    # Lines in a palette's colours that touch look tangled too, and it may be of one.
    has_others = job.target is not None or any(one.values for one in job.asked)
    return not has_others and run_together(job.items)


def keeps_gaps(sizes: str, asked: Mapping[str, Any]) -> bool:
    """Whether a gap would take room that a recipe asks for: fixed sizes, or a hero's."""
    return sizes == "fixed" or asked.get("hero") is not None


def alike_upright(job: Job) -> list[list[RunStep]]:
    """Starts of few items, near upright and of about one size, unless asked otherwise.

    Each of few is looked at: one that lies on its side beside a giant looks thrown down. The more
    there are, the more they may turn and vary. None in tiles of paper, which has no up, and where
    something is asked of where they lie.
    """
    plan, count, away = job.plan, len(job.items), from_few(job)
    if count < 2 or away == 1 or plan.voids.fills or not may_rearrange(job):
        return []
    near = Rotation(limit=math.radians(NEAR_UPRIGHT + away * (180 - NEAR_UPRIGHT)))
    rotation, ratio = near if plan.rotation.is_free else plan.rotation, ratio_of_few(job)
    starts = 1 if plan.seconds is not None else STARTS[plan.effort] * FEW // max(count, FEW)
    if starts <= 1 and (rotation, ratio) == (plan.rotation, plan.size_ratio):
        return []
    found = list[list[RunStep]]()
    for k in range(max(starts, 1)):
        tried = {"rotation": rotation, "size_ratio": ratio, "seed": plan.seed + k * STRIDE}
        steps = placing(job.replanned(**tried), suits_first_fit=False)
        found.append([Replan(**tried), *steps])
    return found


def from_few(job: Job) -> float:
    """Way of a number of items from few to many; 1 in tiles of paper, too."""
    if job.container.lattice is not None:
        return 1.0
    return float(np.clip((len(job.items) - FEW) / (MANY - FEW), 0.0, 1.0)) ** BEND


def ratio_of_few(job: Job) -> float:
    """Most that sizes may differ from the nominal ones: less for few, unless it was asked."""
    plan = job.plan
    usual = round(ALIKE + from_few(job) * (plan.size_ratio - ALIKE), 2)
    return plan.size_ratio if plan.has_own_ratio else usual


def as_asked(job: Job) -> RunStep:
    """Step that takes back what those of :func:`alike_upright` change in the plan."""
    plan = job.plan
    return Replan(rotation=plan.rotation, size_ratio=plan.size_ratio, seed=plan.seed)


def best_balanced(tried: Sequence[RunState], context: RunContext) -> RunState:
    """Of layouts, the fullest and most balanced of those that are clean, if any is.

    Balance is how near to each item's mirror image another one lies, or it itself.
    """
    del context
    return max(tried, key=lambda one: (not one.conflicts, _covered(one) * (1.0 - _imbalance(one))))


def is_full(state: RunState) -> bool:
    """Whether a layout will do without a look at a plain one.

    Copies of one drawing may lie as there.
    """
    is_one_kind = len({item.source for item in state.job.items}) == 1
    enough = FULL * state.job.container.outline.area
    return not (is_one_kind or state.conflicts) and _covered(state) >= enough


def fuller(tried: Sequence[RunState], context: RunContext) -> RunState:
    """Of an upright layout and a plain one the plain one, if that is by far fuller."""
    upright, plain = tried
    if plain.conflicts:
        return upright
    if upright.conflicts or _covered(upright) < AS_FULL * _covered(plain):
        return plain
    is_one_kind = len({item.source for item in plain.job.items}) == 1
    return best_balanced(tried, context) if is_one_kind else upright


def _covered(state: RunState) -> float:
    areas = np.array([item.outline.area for item in state.job.items])
    return float(areas @ state.poses.scale**2)


def _imbalance(state: RunState) -> float:
    """Mean distance of items from the mirror images of others, over half the container's side."""
    container, poses = state.job.container, state.poses
    places = np.column_stack([poses.x, poses.y])
    mirrored = np.column_stack([2 * container.outline.centroid[0] - poses.x, poses.y])
    apart = np.linalg.norm(places[:, None] - mirrored, axis=2).min(axis=1)
    return min(2 * float(apart.mean()) / container.side, 1.0)


def separation(job: Job) -> list[RunStep]:
    """Search for a larger common size, where items may lie anywhere; else nothing."""
    is_few = 1 < len(job.items) <= MOST_SEPARATED
    if job.plan.effort == "draft" or job.plan.has_even_lines or not (is_few and may_rearrange(job)):
        return []
    # Only what is asked for loads its kernels.
    from packwork.steps.separate import Separate

    return [Separate()]


def material_of(
    use: Use, recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None
) -> Material:
    """Items and photographs that a recipe names, for a use that reads nothing else."""
    named = read_named(recipe, given)
    items, target = named.items, None
    if recipe.picture is not None:
        items, target = suited_first(recipe, room.known, items)
    if given is None and items is named.items:
        items = drawn_first(recipe, items)
    total = room.needed(recipe, items) if recipe.count == AUTO else None
    chosen = expand_copies(recipe, items, total)
    container, order = room.of(chosen), None
    if recipe.embeddings is not None and all(item.text is None for item in given or ()):
        order = named.keys
    return Material(
        use=use,
        container=container,
        cast=chosen,
        fillers=named.items,
        # Words of a layout come by weight: what a user means by their order is not known.
        given=order,
        skipped=named.skipped,
        target=target if container is room.container else None,
    )

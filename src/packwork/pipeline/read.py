"""From a recipe to a job: what all uses read alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely

from packwork.errors import PackworkError, ReadError, RecipeError, ShapeError
from packwork.geometry import polygon
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection
from packwork.pipeline.hero import placed_hero
from packwork.pipeline.job import Clock, Job, Region, Use
from packwork.pipeline.plan.copies import Cast, ItemRules, rules_by_source, shared_out
from packwork.pipeline.plan.own_losses import check_ablations, losses_with_a_say
from packwork.pipeline.plan.plan import Plan
from packwork.pipeline.plan.vectors import ItemVectors, Key, key_of, read_item_vectors
from packwork.pipeline.registration import registered
from packwork.readers.container import read_container
from packwork.readers.folders import Sample
from packwork.readers.items import is_several, read_items
from packwork.readers.layouts.read import is_drawn, read_written
from packwork.readers.options import AS_DRAWN
from packwork.readers.regions import MAX_POINTS
from packwork.readers.saliency import QuietOptions
from packwork.recipe import AUTO, Recipe
from packwork.recipe.order import FROM_TEXT
from packwork.scene.container import Container, inside_margin, on_canvas
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses, Zone
from packwork.scene.target import TargetPicture
from packwork.sources import stored
from packwork.units import CanvasSize, length_asked, parse_length


def read_regions(asked: Sequence[ItemRules], container: Container) -> tuple[Region, ...]:
    """Regions of all copies that have one, one for each that is named."""
    members: dict[Any, list[int]] = {}
    for k, one in enumerate(asked):
        if "region" in one.values:
            members.setdefault(one.values["region"], []).append(k)
    found = []
    for given, items in members.items():
        source = asked[items[0]].sources["region"]
        outline = _common(_region(given, container), container)
        words = given if isinstance(given, str) else ", ".join(map(_plain_length, given))
        if outline is None:
            raise source.error(f"region: {words} and the container have no part in common")
        found.append(Region(Zone(outline, np.array(items)), source, words))
    return tuple(found)


def _plain_length(length: str | float) -> str:
    return length if isinstance(length, str) else f"{length:g}"


def _region(given: str | tuple[str | float, ...], container: Container) -> polygon.Region:
    if isinstance(given, str):
        size = CanvasSize(container.width, container.height, container.unit)
        return read_container(given, size, reading=AS_DRAWN).outline.region
    wholes = (container.width, container.height) * 2
    left, top, width, height = (
        parse_length(str(side), container.unit, whole)
        for side, whole in zip(given, wholes, strict=True)
    )
    return shapely.box(left, top, left + width, top + height)


def _common(region: polygon.Region, container: Container) -> Outline | None:
    try:
        return Outline.from_region(intersection(region, container.outline.region))
    except ShapeError:
        return None


@dataclass(frozen=True, eq=False, kw_only=True)
class Material:
    """Things that a use read of a recipe.

    Parameters
    ----------
    fillers
        Of which voids are filled, unless the recipe names others.
    given
        Names and sources of all that was read, in the order it was given; None if it had none,
        or nothing asks for it.
    target
        The recipe's picture on this container, if it has been read.
    """

    use: Use
    container: Container
    cast: Cast
    fillers: tuple[Item, ...]
    given: tuple[Key, ...] | None = None
    skipped: tuple[PackworkError, ...] = ()
    target: TargetPicture | None = None


@dataclass(frozen=True, eq=False)
class Named:
    """Items that a recipe names, and files of them that were left out."""

    items: tuple[Item, ...]
    skipped: tuple[PackworkError, ...]

    @property
    def keys(self) -> tuple[Key, ...]:
        """Names and sources of the items, each once."""
        return tuple(dict.fromkeys(map(key_of, self.items)))


def read_room(recipe: Recipe, given: Container | None) -> Container:
    """The container of a recipe on its canvas; one that was given is in its place."""
    if given is not None:
        found = on_canvas(given, recipe.canvas_size)
    else:
        quiet = QuietOptions(recipe.quiet_share, recipe.keep_clear or ())
        found = read_container(
            recipe.container, recipe.canvas_size, recipe.font, quiet, recipe.read_options
        )
        found = safe_area(recipe, found) if recipe.margin != NO_MARGIN else found
    count = len(found.outline.points)
    if count > MAX_POINTS:
        why = f"has {count:,} points, more than {MAX_POINTS:,}; simplify it"
        raise ReadError(found.source or found.name, why)
    return found


NO_MARGIN = "0"


def safe_area(recipe: Recipe, found: Container) -> Container:
    """The part of a container that is as far from the sheet's edge as a recipe's margin says."""
    margin = length_asked("margin", recipe.margin, found.unit, found.side)
    if margin == 0:
        return found
    try:
        return inside_margin(found, margin)
    except ShapeError as error:
        raise RecipeError("margin", f"{recipe.margin} {error}; use a smaller one") from None


def sample_of(recipe: Recipe) -> Sample | None:
    """Sample of more items than are needed; None where all are taken."""
    if recipe.words is not None or not isinstance(recipe.count, int):
        return None
    wanted = tuple(pattern for _, rule in rules_by_source(recipe) for pattern in rule.items)
    return Sample(recipe.count, recipe.seed if recipe.items_from == "seed" else None, wanted)


def drawn_first(recipe: Recipe, items: tuple[Item, ...]) -> tuple[Item, ...]:
    """Items in the order in which they are taken: those that are drawn of too many come first."""
    sample = sample_of(recipe)
    if sample is None or len(items) <= sample.most or not any(map(is_several, recipe.items)):
        return items
    order = sample.order([item.name for item in items])
    drawn, rest = sorted(order[: sample.most]), sorted(order[sample.most :])
    sample.tell(recipe.items, len(items))
    return tuple(items[k] for k in (*drawn, *rest))


def read_named(recipe: Recipe, given: Sequence[Item] | None) -> Named:
    """Photos and items of a recipe; items that were given are in place of its names."""
    items: tuple[Item, ...] = ()
    skipped: tuple[PackworkError, ...] = ()
    # Of all items it has to be known, not of those alone that are taken.
    keeps_colours = recipe.photos is not None or recipe.tint is not None
    is_chosen = recipe.picture is not None and keeps_colours
    has_data = recipe.embeddings is not None or recipe.weights is not None
    sample = None if is_chosen or has_data else sample_of(recipe)
    if recipe.photos is not None:
        from packwork.readers.photos import read_photos

        threshold = recipe.alpha_threshold
        photos = read_photos(
            recipe.photos, strict=recipe.strict, threshold=threshold, sample=sample
        )
        items, skipped = photos.items, photos.skipped
    if given is not None:
        return Named((*items, *given), skipped)
    # Items are mixed in with words and photos only if they were named.
    is_alone = recipe.words is None and recipe.photos is None
    if is_alone or ("items" in recipe.model_fields_set and recipe.items):
        found = read_items(
            recipe.items,
            holes=recipe.holes,
            strict=recipe.strict,
            reading=recipe.read_options,
            sample=sample,
        )
        items, skipped = (*items, *found.items), (*skipped, *found.skipped)
    return Named(items, skipped)


def job_of(recipe: Recipe, material: Material, clock: Clock) -> Job:
    """Job of what was read, everything in it found usable."""
    chosen, container = material.cast, material.container
    weights = chosen.weights
    if recipe.share is not None:
        weights = shared_out(chosen.items, weights, material.use.words, recipe.share)
    plan = Plan.of(recipe, container)
    if plan.losses:
        check_ablations(plan, recipe.preset)
        plan = replace(plan, losses=losses_with_a_say(plan.losses, container, chosen.items))
    fillers = _fillers(recipe, material.fillers) if recipe.fills_gaps else Named((), ())
    vectors = None if recipe.embeddings is None else _vectors(recipe, recipe.embeddings, material)
    file = recipe.layout_file
    job = Job(
        recipe=recipe,
        plan=plan,
        use=material.use,
        container=container,
        items=chosen.items,
        asked=chosen.asked,
        weights=weights,
        regions=read_regions(chosen.asked, container),
        fillers=fillers.items,
        earlier=_earlier(file, container, chosen.items) if file else None,
        target=_target(recipe, recipe.picture, material) if recipe.picture else None,
        vectors=vectors,
        is_counted=recipe.count == AUTO,
        skipped=(*material.skipped, *fillers.skipped, *(vectors.told if vectors else ())),
        clock=clock,
    )
    if recipe.label_regions:
        from packwork.pipeline.region_labels import labelled

        job = labelled(job)
    if recipe.hero is not None:
        job = placed_hero(job)
    # Refuses forces that name no item, before anything is run.
    _ = job.forces
    if job.vectors is not None and recipe.arrange is not None:
        raise RecipeError("embeddings", "and --arrange both say where items lie; leave one out")
    if job.vectors is not None and len(job.seated):
        raise RecipeError(
            "embeddings",
            "puts like items together, and --picture puts them where their colours "
            "fit; leave one out, or recolour them by --tint 100%",
        )
    return job


def _vectors(recipe: Recipe, asked: str, material: Material) -> ItemVectors:
    """Vectors of the items, from a file or made by the use."""
    if recipe.chart is not None or recipe.pile is not None:
        raise RecipeError("embeddings", "puts like items together in a collage; this is none")
    if asked == FROM_TEXT:
        return material.use.vectors(recipe)
    return read_item_vectors(recipe, asked, material.cast.items, material.given)


def _target(recipe: Recipe, picture: str, material: Material) -> TargetPicture:
    """The picture that the layout is to show."""
    if recipe.chart is not None:
        raise RecipeError("picture", "has no meaning in a chart, whose colours say something")
    if material.container.backdrop is not None:
        raise RecipeError("picture", "has no meaning round a picture, which is seen behind all")
    if material.target is not None:
        return material.target
    # Only what is asked for loads the picture library.
    from packwork.readers.target import read_target

    return read_target(picture, material.container, recipe.read_options)


def _earlier(file: str, container: Container, items: tuple[Item, ...]) -> Layout:
    """The earlier layout that a run begins from."""
    made = stored(file)
    if isinstance(made, Layout):
        # Arrays of a layout are read-only, which kernels would be compiled for anew.
        return replace(made, poses=made.poses.subset(np.arange(len(made.items))))
    if isinstance(made, Poses):
        if len(made) != len(items):
            raise RecipeError(
                "start", f"has {len(made)} poses, this run {len(items)} items; give as many"
            )
        return Layout(container, items, made.subset(np.arange(len(items))), np.ones(len(items)))
    layout = read_written(file)
    # GeoJSON holds poses; of drawings they are found from the shapes.
    return registered(layout, items) if is_drawn(file) else layout


def _fillers(recipe: Recipe, items: tuple[Item, ...]) -> Named:
    """Fillers of voids, and files that were left out."""
    if not recipe.filler:
        return Named(items, ())
    found = read_items(
        recipe.filler, holes=recipe.holes, strict=recipe.strict, reading=recipe.read_options
    )
    return Named(found.items, found.skipped)

"""Losses of users' own, tried out before a run: what never says anything shall change nothing."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.errors import RecipeError
from packwork.losses.registry import (
    LOSSES,
    POSE_LOSSES,
    find_loss,
    find_pose_loss,
    loss_name,
    takes_colour,
)
from packwork.losses.term import (
    ImageLoss,
    PosedItems,
    PoseLoss,
    SeenInColour,
    checked_call,
    checked_term,
)
from packwork.pipeline.plan.plan import Plan
from packwork.raster.coverage import Rasteriser, image_shape, region_image
from packwork.scene.colour import parse_colour
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.pose import Poses

TRIED_PX = 64
"""Pixels on the longer side of the images that losses are tried on. Chosen."""

DENSEST = 3.0
"""Largest density that they are tried on. Chosen: what overlaps twice over is rare."""

Losses: TypeAlias = Mapping[str | ImageLoss, float]

_LOG = logging.getLogger("packwork")


def losses_with_a_say(losses: Losses, container: Container, items: Sequence[Item]) -> Losses:
    """The losses without those of one's own that are zero wherever items are, which is told."""
    return {key: weight for key, weight in losses.items() if _has_a_say(key, container, items)}


def _has_a_say(key: str | ImageLoss, container: Container, items: Sequence[Item]) -> bool:
    if isinstance(key, str) and key in {*LOSSES, *POSE_LOSSES}:
        return True
    of_poses = find_pose_loss(key)
    says = _moves(of_poses, container, items) if of_poses else _prices(find_loss(key), container)
    if not says:
        name = key if isinstance(key, str) else getattr(key, "__name__", repr(key))
        _LOG.warning("the loss %s is zero wherever items are: it changes nothing", name)
    return says


def check_ablations(plan: Plan, preset: str) -> None:
    """Refuse to switch a loss off that the preset has not, tell of one that weighs nothing here."""
    plain = replace(plan, losses={}).solve_options().losses
    known = dict.fromkeys([*plan.preset.solve.losses, *plain])
    for name, weight in plan.losses.items():
        if weight or name not in {*LOSSES, *POSE_LOSSES} or name in plain:
            continue
        if name not in known:
            raise RecipeError(
                "losses",
                f"{name} is none of the losses of the preset {preset}, so 0 would change nothing; "
                f"those are {', '.join(map(loss_name, known))}",
            )
        _LOG.warning("the loss %s weighs nothing here anyway: 0 changes nothing", name)


def sees_colours(losses: Losses) -> bool:
    """Whether one of the losses is given the colours of items."""
    return any(takes_colour(find_loss(key)) for key in losses if key not in POSE_LOSSES)


def in_colours(losses: Losses, colours: FloatArray) -> dict[Any, float]:
    """The losses, those that are given colours bound to those of the items, ``(n, 3)`` sRGB."""
    bound: dict[Any, float] = {}
    for key, weight in losses.items():
        found: Any = key if key in POSE_LOSSES else find_loss(key)
        if takes_colour(found):
            seen = SeenInColour(found, loss_name(key), colours, background_of(found))
            bound[seen] = weight
        else:
            bound[key] = weight
    return bound


def background_of(loss: object) -> FloatArray:
    """Colour ``(3,)``, 0 to 1, over which a loss sees items: its attribute, else white.

    Examples
    --------
    >>> background_of(len)
    array([1., 1., 1.])
    """
    text = str(getattr(loss, "background", "white"))
    channels = parse_colour("losses", text)
    if channels is None or channels[3] < 255:
        raise RecipeError("losses", f"the background {text[:40]!r} is clear; use a solid colour")
    return np.array(channels[:3]) / 255


def _prices(loss: ImageLoss, container: Container) -> bool:
    """Whether an adjoint of an image loss is anything but zero for some image."""
    shape = image_shape(container.width, container.height, TRIED_PX)
    rasteriser = Rasteriser(shape, np.float32)
    inside = region_image(container.outline, rasteriser, TRIED_PX / container.side)
    if not takes_colour(loss):
        return any(checked_term(loss, d, inside).adjoint.any() for d in _densities(inside))
    background_of(loss)
    rng = np.random.default_rng(0)
    for density in _densities(inside):
        colour = rng.random((*shape, 3)).astype(np.float32)
        term = checked_call(loss, (density, colour, inside))
        if term.adjoint.any() or np.any(term.colour_adjoint):
            return True
    return False


def _densities(inside: Image) -> Iterator[Image]:
    yield (np.random.default_rng(0).random(inside.shape) * DENSEST).astype(np.float32)
    yield np.zeros_like(inside)
    yield np.ones_like(inside)
    yield inside.copy()


def _moves(loss: PoseLoss, container: Container, items: Sequence[Item]) -> bool:
    """Whether a loss of poses pulls at any item that lies somewhere on the canvas."""
    rng, count = np.random.default_rng(0), len(items)
    x, y = rng.random(count) * container.width, rng.random(count) * container.height
    areas = np.array([item.outline.area for item in items])
    term = loss(PosedItems(Poses(x, y, rng.random(count)), areas, np.ones(count), np.arange(count)))
    return bool(np.any(term.x) or np.any(term.y) or np.any(term.log_scale))

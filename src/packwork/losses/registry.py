"""Losses by name: the built-in ones and a user's own."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Mapping
from functools import partial
from itertools import count
from types import MappingProxyType
from typing import Any

from packwork.errors import RecipeError
from packwork.losses.image import containment, evenness, filling, overlap
from packwork.losses.paper import paper_containment, paper_evenness
from packwork.losses.pose import apart, area_shares
from packwork.losses.term import ImageLoss, PoseLoss, checked_pose_term

LOSSES: Mapping[str, ImageLoss] = MappingProxyType(
    {
        "containment": containment,
        "overlap": overlap,
        "filling": filling,
        "evenness": evenness,
        "paper-containment": paper_containment,
        "paper-evenness": paper_evenness,
    }
)

"""Losses read from the image."""

POSE_LOSSES: Mapping[str, PoseLoss] = MappingProxyType({"area-shares": area_shares, "apart": apart})
"""Losses read from the poses: of the object space."""


def find_loss(name: str | ImageLoss) -> ImageLoss:
    """Image loss by its registered name, by ``module:function``, or given as a function.

    Raises ``RecipeError`` if there is no such loss, module or function.

    Examples
    --------
    >>> find_loss("overlap").__name__
    'overlap'
    """
    if not isinstance(name, str):
        return name
    if name in LOSSES:
        return LOSSES[name]
    module, colon, function = name.partition(":")
    if not colon:
        known = ", ".join([*LOSSES, *POSE_LOSSES])
        raise RecipeError(
            "loss",
            f"no loss is called {name!r}; use one of {known} or module:function",
        )
    try:
        found = getattr(importlib.import_module(module), function)
    except (ImportError, TypeError, ValueError) as error:  # the latter two: not a module's name
        raise RecipeError("loss", f"module {module!r} cannot be imported: {error}") from error
    except AttributeError as error:
        raise RecipeError("loss", f"module {module!r} has no function {function!r}") from error
    if not callable(found):
        raise RecipeError(
            "loss",
            f"{name!r} is not a function of (density, container), (density, colour, container) "
            "or (placed)",
        )
    loss: ImageLoss = found
    return loss


def loss_name(loss: str | ImageLoss | PoseLoss) -> str:
    """Name of a loss, in tables of losses.

    Examples
    --------
    >>> loss_name("overlap"), loss_name(overlap)
    ('overlap', 'overlap')
    """
    return loss if isinstance(loss, str) else getattr(loss, "__name__", type(loss).__name__)


def by_name(weights: Mapping[Any, float]) -> dict[str, float]:
    """Weights by what losses are called, in their order, numbered where two are called the same.

    Examples
    --------
    >>> by_name({overlap: 2.0, "overlap": 1.0})
    {'overlap': 2.0, 'overlap 2': 1.0}
    """
    found: dict[str, float] = {}
    for loss, weight in weights.items():
        name = loss_name(loss)
        numbered = (name if k == 1 else f"{name} {k}" for k in count(1))
        found[next(one for one in numbered if one not in found)] = weight
    return found


def find_pose_loss(name: str | ImageLoss | PoseLoss) -> PoseLoss | None:
    """Loss of the poses, by its name or as a function of one argument; None of image losses.

    Raises ``RecipeError`` as for :func:`find_loss`.

    Examples
    --------
    >>> find_pose_loss("overlap") is None, find_pose_loss("apart") is apart
    (True, True)
    >>> find_pose_loss(lambda placed: None) is None
    False
    """
    if isinstance(name, str) and name in POSE_LOSSES:
        return POSE_LOSSES[name]
    if isinstance(name, str) and name in LOSSES:
        return None
    found: Any = find_loss(name) if isinstance(name, str) else name
    return partial(checked_pose_term, found) if _takes_poses(found) else None


def takes_colour(function: Any) -> bool:
    """Whether a function has to be given three things: density, colours and container.

    Examples
    --------
    >>> takes_colour(overlap), takes_colour(lambda density, colour, container: None)
    (False, True)
    """
    return _needed(function) == 3


def _takes_poses(function: Any) -> bool:
    """Whether a function has to be given one thing only, and not the two images."""
    return _needed(function) == 1


def _needed(function: Any) -> int | None:
    """Number of things a function is to be given, if it takes as many and no more."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return None
    taken = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    has_rest = any(p.kind is p.VAR_POSITIONAL for p in parameters)
    needed = sum(p.default is p.empty for p in taken)
    return needed if needed == len(taken) and not has_rest else None

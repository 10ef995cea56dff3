"""Losses by name: the built-in ones and a user's own."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import MappingProxyType

from packwork.errors import RecipeError
from packwork.losses.containment import containment
from packwork.losses.evenness import evenness
from packwork.losses.filling import filling
from packwork.losses.overlap import overlap
from packwork.losses.term import ImageLoss

LOSSES: Mapping[str, ImageLoss] = MappingProxyType(
    {
        "containment": containment,
        "overlap": overlap,
        "filling": filling,
        "evenness": evenness,
    }
)


def find_loss(name: str | ImageLoss) -> ImageLoss:
    """Loss by its registered name, by ``module:function``, or given as a function.

    Raises
    ------
    RecipeError
        If there is no such loss, module or function.

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
        raise RecipeError(
            "loss", f"no loss is called {name!r}; use one of {', '.join(LOSSES)} or module:function"
        )
    try:
        found = getattr(importlib.import_module(module), function)
    except (ImportError, TypeError, ValueError) as error:  # the latter two: not a module's name
        raise RecipeError("loss", f"module {module!r} cannot be imported: {error}") from error
    except AttributeError as error:
        raise RecipeError("loss", f"module {module!r} has no function {function!r}") from error
    if not callable(found):
        raise RecipeError("loss", f"{name!r} is not a function of (density, container)")
    loss: ImageLoss = found
    return loss

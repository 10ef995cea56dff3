"""Losses by name: the built-in ones and a user's own."""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from types import MappingProxyType

from packwork.errors import RecipeError
from packwork.losses.apart import apart
from packwork.losses.area_shares import area_shares
from packwork.losses.containment import containment
from packwork.losses.evenness import evenness
from packwork.losses.filling import filling
from packwork.losses.overlap import overlap
from packwork.losses.paper_containment import paper_containment
from packwork.losses.paper_evenness import paper_evenness
from packwork.losses.term import ImageLoss, PoseLoss

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
        raise RecipeError("loss", f"{name!r} is not a function of (density, container)")
    loss: ImageLoss = found
    return loss

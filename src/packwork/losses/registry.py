"""Losses by name: the built-in ones, a user's own, and those of the paper.

The latter are as Wang and Lu 2025, section 3.3, have them (doi:10.1145/3721238.3730690).
"""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Mapping
from functools import partial
from itertools import count
from types import MappingProxyType
from typing import Any

import numpy as np

from packwork.arrays import Image
from packwork.errors import RecipeError
from packwork.fields.filters import box_mean
from packwork.losses.image import containment, evenness, filling, overlap
from packwork.losses.pose import apart, area_shares
from packwork.losses.term import ImageLoss, PoseLoss, Term, checked_pose_term

OUTSIDE = 100.0
"""Weight of an error outside the container, against 1 inside (the paper's)."""


def paper_containment(density: Image, container: Image) -> Term:
    """Mean squared difference of covered and container, outside a hundred times dearer.

    Of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3. Inside, covered is min(density, 1), as black items on
    white compose; outside it is the density itself, so that coincident items there are
    still pushed back.

    Examples
    --------
    >>> term = paper_containment(np.array([[0.5, 2.0]]), np.array([[1.0, 0.0]]))
    >>> term.value, term.adjoint.tolist()
    (200.125, [[-0.5, 200.0]])
    """
    short = np.minimum(density - container, 1 - container)
    inside = container * short
    beyond = density * (1 - container)
    value = float(np.mean(inside * short)) + OUTSIDE * float(np.mean(beyond * density))
    free = density < 1
    adjoint = (2 / density.size) * (inside * free + OUTSIDE * beyond)
    return Term(value, adjoint.astype(density.dtype))


WINDOWS_PX = (5, 11, 17, 23, 29, 35)
"""Sides of the windows, pixels of the level: 5 px is a tenth of an image of 50 px (the
paper's)."""

WEIGHTS = (1, 2, 3, 4, 5, 6)
"""Weight of each window (the paper's code)."""

ALMOST_EMPTY = 0.999
"""Emptiness from which a window counts (the paper's code)."""

GAIN = 1_000.0
"""Factor on what is above that (the paper's code)."""


def paper_evenness(density: Image, container: Image) -> Term:
    """Share of windows that hold nothing but empty container, larger ones weighing more.

    Of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3: the empty space is dilated by kernels of growing size
    and only what is almost wholly empty is kept. A window that sticks out of the image
    or the container is not wholly empty container.

    Examples
    --------
    >>> empty, full = np.zeros((9, 9)), np.ones((9, 9))
    >>> paper_evenness(full, full).value, paper_evenness(empty, full).value > 0.1
    (0.0, True)
    """
    free = density < 1
    room = container * free
    empty = np.ascontiguousarray(room * (1 - density))
    total, by_empty = 0.0, np.zeros_like(empty)
    for size, weight in zip(WINDOWS_PX, WEIGHTS, strict=True):
        above = box_mean(empty, size) - ALMOST_EMPTY
        counts = above > 0
        if not counts.any():
            break  # A larger window is no emptier.
        total += weight * GAIN * float(above[counts].sum())
        by_empty += weight * GAIN * box_mean(counts.astype(empty.dtype), size)
    return Term(total / density.size, (-room * by_empty / density.size).astype(density.dtype))


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
            "losses",
            f"no loss is called {name!r}; use one of {known} or module:function",
        )
    try:
        found = getattr(importlib.import_module(module), function)
    except (ImportError, TypeError, ValueError) as error:  # the latter two: not a module's name
        raise RecipeError("losses", f"module {module!r} cannot be imported: {error}") from error
    except AttributeError as error:
        raise RecipeError("losses", f"module {module!r} has no function {function!r}") from error
    if not callable(found):
        raise RecipeError(
            "losses",
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

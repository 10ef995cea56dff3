"""A PyTorch function of the density image, and of colours, as one of our losses."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any

from packwork.adapters.torch.found import found_torch
from packwork.arrays import Image
from packwork.errors import ShapeError
from packwork.losses.term import Term

if TYPE_CHECKING:
    from torch import Tensor


def torch_loss(function: Callable[..., Tensor]) -> Callable[..., Term]:
    """Image loss whose derivative PyTorch finds; also a decorator.

    Use it by itself, as ``pw.fill(..., losses={torch_loss(function): 2.0})``, or above a
    function of a module, which then is a loss by name: ``--loss module:function``.

    Parameters
    ----------
    function
        Of the density image and the container's coverage, float32 tensors ``[row, col]``
        on the CPU, of every level's size in turn, to a tensor of one number: a mean over
        pixels, so that levels agree. It owns both tensors. May be a ``torch.nn.Module``;
        parameters of networks in it gather no gradients.

        A function of three tensors is given the colour image between the two,
        ``[row, col, channel]``, sRGB from 0 to 1: items in their mean colours over its
        ``background``, an attribute that is a CSS colour (white if it has none).

    Raises
    ------
    PackworkError
        If PyTorch is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> @torch_loss
    ... def crowding(density, container):
    ...     return (density**2).mean()
    >>> term = crowding(np.array([[1.0, 3.0]]), np.ones((1, 2)))
    >>> term.value, term.adjoint.tolist()
    (5.0, [[1.0, 3.0]])
    """
    found_torch()

    # A module's attributes would come along as the function's own.
    @wraps(function, updated=())
    def loss(*images: Image) -> Term:
        return _term(function, images)

    if not hasattr(function, "__name__"):
        loss.__name__ = loss.__qualname__ = type(function).__name__
    if isinstance(function, found_torch().nn.Module):
        # Called as a function, a module takes anything: what it takes, forward says.
        loss.__signature__ = inspect.signature(function.forward)  # type: ignore[attr-defined]
    if hasattr(function, "background"):
        loss.background = function.background  # type: ignore[attr-defined]
    return loss


def _term(function: Callable[..., Any], images: tuple[Image, ...]) -> Term:
    """Value and adjoints by one pass of autograd; the container is the last image.

    Raises
    ------
    ShapeError
        If the function returns anything but one number that depends on the others.
    """
    torch = found_torch()
    with torch.enable_grad():
        seen = [torch.tensor(image, requires_grad=True) for image in images[:-1]]
        value = function(*seen, torch.tensor(images[-1]))
        if not isinstance(value, torch.Tensor):
            raise ShapeError(f"it must return a tensor of one number, not {type(value).__name__}")
        if value.numel() != 1:
            raise ShapeError(
                f"it must return a tensor of one number, not shape {tuple(value.shape)}"
            )
        adjoints = _derivatives(value, seen)
    return Term(float(value.detach()), *(adjoint.numpy() for adjoint in adjoints))


def _derivatives(value: Tensor, seen: list[Tensor]) -> list[Tensor]:
    """One of each image; zero of one that does not matter."""
    torch = found_torch()
    adjoints: tuple[Tensor | None, ...] = (None,)
    if value.requires_grad:
        adjoints = torch.autograd.grad(value.sum(), seen, allow_unused=True)
    if all(adjoint is None for adjoint in adjoints):
        images = "the density" if len(seen) == 1 else "the density or the colours"
        raise ShapeError(f"its value must depend on {images}, through PyTorch's functions alone")
    pairs = zip(adjoints, seen, strict=True)
    return [torch.zeros_like(image) if one is None else one for one, image in pairs]

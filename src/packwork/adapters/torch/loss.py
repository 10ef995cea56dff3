"""A PyTorch function of the density image as one of our losses."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any

from packwork.adapters.torch.found import found_torch
from packwork.arrays import Image
from packwork.errors import ShapeError
from packwork.losses.term import ImageLoss, Term

if TYPE_CHECKING:
    from torch import Tensor


def torch_loss(function: Callable[[Tensor, Tensor], Tensor]) -> ImageLoss:
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
    def loss(density: Image, container: Image) -> Term:
        return _term(function, density, container)

    if not hasattr(function, "__name__"):
        loss.__name__ = loss.__qualname__ = type(function).__name__
    return loss


def _term(function: Callable[..., Any], density: Image, container: Image) -> Term:
    """Value and adjoint by one pass of autograd.

    Raises
    ------
    ShapeError
        If the function returns anything but one number that depends on the density.
    """
    torch = found_torch()
    with torch.enable_grad():
        seen = torch.tensor(density, requires_grad=True)
        value = function(seen, torch.tensor(container))
        if not isinstance(value, torch.Tensor):
            raise ShapeError(f"it must return a tensor of one number, not {type(value).__name__}")
        if value.numel() != 1:
            raise ShapeError(
                f"it must return a tensor of one number, not shape {tuple(value.shape)}"
            )
        adjoint = _derivative(value, seen)
    return Term(float(value.detach()), adjoint.numpy())


def _derivative(value: Tensor, seen: Tensor) -> Tensor:
    torch = found_torch()
    adjoint: Tensor | None = None
    if value.requires_grad:
        (adjoint,) = torch.autograd.grad(value.sum(), seen, allow_unused=True)
    if adjoint is None:
        raise ShapeError("its value must depend on the density, through PyTorch's functions alone")
    return adjoint

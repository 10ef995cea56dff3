"""PyTorch on both sides of the renderer: images with gradients, losses without adjoints.

Needs the extra ``packwork[torch]``. Importing this needs nothing yet; calling does.
"""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Sequence
from functools import cache, wraps
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from packwork.arrays import Image, as_points, as_starts
from packwork.errors import PackworkError, ShapeError
from packwork.geometry.outline import Outline, joined
from packwork.installed import command_to_install
from packwork.losses.term import Term
from packwork.raster.colour import prepare_colour_image
from packwork.raster.coverage import Rasteriser

if TYPE_CHECKING:
    from torch import Tensor

__all__ = ["render", "render_colour", "render_items", "torch_loss"]


def found_torch() -> Any:
    """Module ``torch``.

    Raises
    ------
    PackworkError
        If it is not installed, saying what to install.

    Examples
    --------
    >>> found_torch().__name__
    'torch'
    """
    try:
        return importlib.import_module("torch")
    except ModuleNotFoundError as error:
        if error.name != "torch":
            raise
        raise PackworkError(
            "this needs PyTorch, which is not installed; install it: "
            f"{command_to_install(['torch'])}"
        ) from None


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


def render(points_px: Tensor, starts: npt.ArrayLike, shape: tuple[int, int]) -> Tensor:
    """Density image of all rings; gradients flow back to the points.

    Both ways are exact: the image holds area shares, the gradient is the boundary
    integral of :func:`packwork.render_pullback`. Only an edge that lies on a line of the
    pixel grid has a kink, as its two sides differ. Second derivatives are refused.

    Parameters
    ----------
    points_px
        ``(n, 2)`` vertices in pixels, float32 (coverage within 1e-4) or float64, on the
        CPU; rings simple, outer ones clockwise on screen.
    starts
        Ring starts, from 0 to n.
    shape
        ``(rows, columns)``.

    Returns
    -------
    Tensor
        ``(rows, columns)``, of the dtype of the points.

    Raises
    ------
    ShapeError
        If the points or starts are not of that form.
    PackworkError
        If PyTorch is not installed.

    Examples
    --------
    >>> import torch
    >>> square = torch.tensor([[0.5, 0], [2, 0], [2, 1], [0.5, 1]], requires_grad=True)
    >>> image = render(square, [0, 4], (1, 3))
    >>> image.tolist()
    [[0.5, 1.0, 0.0]]
    >>> image.sum().backward()
    >>> square.grad[:, 0].tolist()
    [-0.5, 0.5, 0.5, -0.5]
    """
    _check_points(points_px)
    image: Tensor = _coverage_function().apply(points_px, starts, shape)
    return image


def render_colour(
    points_px: Tensor,
    starts: npt.ArrayLike,
    colours: Tensor,
    shape: tuple[int, int],
    background: Tensor | float = 0.0,
) -> Tensor:
    """Colour image of all rings; gradients flow back to points, colours and background.

    As :func:`packwork.render_colour`: ``background + sum of coverage x (colour - background)``.

    Parameters
    ----------
    points_px, starts, shape
        As for :func:`render`; all tensors on the CPU.
    colours
        ``(rings, channels)``; a hole has its item's.
    background
        ``(channels,)`` or one number.

    Returns
    -------
    Tensor
        ``(rows, columns, channels)``, of the dtype of the points.

    Raises
    ------
    ShapeError
        If points, starts, colours or background are not of that form.
    PackworkError
        If PyTorch is not installed.

    Examples
    --------
    >>> import torch
    >>> square = torch.tensor([[0.5, 0], [2, 0], [2, 1], [0.5, 1]], requires_grad=True)
    >>> image = render_colour(square, [0, 4], torch.tensor([[1.0, 0, 0]]), (1, 3), 1.0)
    >>> image[0, 0].tolist()
    [1.0, 0.5, 0.5]
    >>> image[..., 1].sum().backward()
    >>> square.grad[:, 0].tolist()
    [0.5, -0.5, -0.5, 0.5]
    """
    torch = found_torch()
    _check_points(points_px)
    table = torch.as_tensor(colours)
    if table.ndim != 2:
        raise ShapeError(f"colours must have shape (rings, channels), not {tuple(table.shape)}")
    behind = torch.as_tensor(background, dtype=points_px.dtype)
    if behind.ndim > 1 or behind.numel() not in {1, table.shape[1]}:
        raise ShapeError(
            f"the background must be one number or {table.shape[1]}, "
            f"not of shape {tuple(behind.shape)}"
        )
    behind = behind.expand(table.shape[1])
    image: Tensor = _colour_function().apply(points_px, starts, table, behind, shape)
    return image


def render_items(
    outlines: Sequence[Outline],
    x: Tensor,
    y: Tensor,
    angle: Tensor,
    scale: Tensor,
    shape: tuple[int, int],
    *,
    stretch: Tensor | None = None,
    px_per_cu: float = 1.0,
    colours: Tensor | None = None,
    background: Tensor | float = 0.0,
) -> Tensor:
    """Density image of items at their poses, or their image in colours.

    Gradients flow back to the poses; of colours also to these and to the background.

    Parameters
    ----------
    outlines
        One per item, in item units; copies may repeat one object.
    x, y
        ``(n,)`` canvas units: where each item's origin lies.
    angle
        ``(n,)`` radians, clockwise on screen.
    scale
        ``(n,)`` canvas units per item unit.
    shape
        ``(rows, columns)``.
    stretch
        ``(n,)`` as in :class:`~packwork.scene.pose.Poses`; all ones if None.
    px_per_cu
        Pixels per canvas unit.
    colours
        ``(n, channels)``, one of each item, for :func:`render_colour`; None for the density.
    background
        ``(channels,)`` or one number: what shows where nothing lies.

    Raises
    ------
    ShapeError
        If there are not as many poses or colours as outlines.
    PackworkError
        If PyTorch is not installed.

    Examples
    --------
    >>> import torch
    >>> tile = Outline.from_rings([np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])])
    >>> zero, scale = torch.zeros(1), torch.ones(1, requires_grad=True)
    >>> image = render_items([tile], zero + 2, zero + 2, zero, scale, (4, 4))
    >>> image.sum().backward()
    >>> image.sum().item(), scale.grad.tolist()
    (4.0, [8.0])
    """
    torch = found_torch()
    across = torch.ones_like(scale) if stretch is None else stretch.sqrt()
    for name, value in {"x": x, "y": y, "angle": angle, "scale": scale, "stretch": across}.items():
        if tuple(value.shape) != (len(outlines),):
            raise ShapeError(
                f"{name} must hold one number per outline ({len(outlines)}), "
                f"not shape {tuple(value.shape)}"
            )
    points, starts = joined(outlines)
    own = torch.from_numpy(points).to(x.dtype)
    counts = torch.tensor([len(o.points) for o in outlines], dtype=torch.int64)
    columns = torch.stack([x, y, angle.cos(), angle.sin(), scale * across, scale / across])
    left, top, cosine, sine, wide, high = columns.repeat_interleave(counts, dim=1)
    u, v = own[:, 0] * wide, own[:, 1] * high
    placed = torch.stack([cosine * u - sine * v + left, sine * u + cosine * v + top], dim=1)
    if colours is None:
        return render(placed * px_per_cu, starts, shape)
    if len(colours) != len(outlines):
        raise ShapeError(f"colours must be one per outline ({len(outlines)}), not {len(colours)}")
    rings = torch.tensor([len(o.rings) for o in outlines], dtype=torch.int64)
    per_ring = colours.repeat_interleave(rings, dim=0)
    return render_colour(placed * px_per_cu, starts, per_ring, shape, background)


def _check_points(points_px: Tensor) -> None:
    torch = found_torch()
    if points_px.dtype not in {torch.float32, torch.float64}:
        raise ShapeError(f"points must be float32 or float64, not {points_px.dtype}")
    if points_px.device.type != "cpu":
        raise ShapeError(f"points must be on the CPU, not on {points_px.device}; use points.cpu()")


@cache
def _coverage_function() -> Any:
    torch = found_torch()
    function: Any = torch.autograd.Function

    class Coverage(function):  # type: ignore[misc]
        """Sweeps on the way out, reads the sweep's record on the way back."""

        @staticmethod
        def forward(
            ctx: Any, points: Tensor, starts: npt.ArrayLike, shape: tuple[int, int]
        ) -> Tensor:
            # Copied: the record must hold even if an optimiser moves the points in place.
            kept = as_points(points.detach().numpy()).copy()
            ctx.rasteriser = Rasteriser(shape, points.detach().numpy().dtype)
            ctx.rasteriser.sweep(kept, as_starts(starts, len(kept)))
            image: Tensor = torch.from_numpy(ctx.rasteriser.density())
            return image

        @staticmethod
        @torch.autograd.function.once_differentiable  # type: ignore[untyped-decorator]
        def backward(ctx: Any, adjoint: Tensor) -> tuple[Tensor, None, None]:
            gradient = ctx.rasteriser.pullback(np.ascontiguousarray(adjoint.numpy()))
            return torch.from_numpy(gradient.copy()).to(adjoint.dtype), None, None

    return Coverage


@cache
def _colour_function() -> Any:
    torch = found_torch()
    function: Any = torch.autograd.Function

    class Colours(function):  # type: ignore[misc]
        """Renders on the way out; on the way back reads the record of the sweep."""

        @staticmethod
        def forward(
            ctx: Any, points: Tensor, starts: npt.ArrayLike, colours: Tensor,
            background: Tensor, shape: tuple[int, int],
        ) -> Tensor:  # fmt: skip
            # Copied: the record must hold even if an optimiser moves the points in place.
            kept = points.detach().numpy().copy()
            table, behind = (one.detach().double().numpy() for one in (colours, background))
            ctx.dtypes = points.dtype, colours.dtype, background.dtype
            ctx.image, seen = prepare_colour_image(kept, starts, table, shape, behind, kept.dtype)
            image: Tensor = torch.from_numpy(seen)
            return image

        @staticmethod
        @torch.autograd.function.once_differentiable  # type: ignore[untyped-decorator]
        def backward(ctx: Any, adjoint: Tensor) -> tuple[Tensor | None, ...]:
            pull = np.ascontiguousarray(adjoint.numpy())
            found = (ctx.image.by_points(pull), *ctx.image.by_colours(pull))
            pairs = zip(found, ctx.dtypes, strict=True)
            points, table, behind = (torch.from_numpy(one).to(dtype) for one, dtype in pairs)
            return points, None, table, behind, None

    return Colours

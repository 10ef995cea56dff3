"""The renderer as a PyTorch function: exact coverage, exact gradients, no samples."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from packwork.adapters.torch.found import found_torch
from packwork.arrays import as_points, as_starts
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline, joined
from packwork.raster.coverage import Rasteriser

if TYPE_CHECKING:
    from torch import Tensor


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
    torch = found_torch()
    if points_px.dtype not in {torch.float32, torch.float64}:
        raise ShapeError(f"points must be float32 or float64, not {points_px.dtype}")
    if points_px.device.type != "cpu":
        raise ShapeError(f"points must be on the CPU, not on {points_px.device}; use points.cpu()")
    image: Tensor = _coverage_function().apply(points_px, starts, shape)
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
) -> Tensor:
    """Density image of items at their poses; gradients flow back to the poses.

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

    Raises
    ------
    ShapeError
        If there are not as many poses as outlines.
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
    return render(placed * px_per_cu, starts, shape)


@cache
def _coverage_function() -> Any:
    """Class of the autograd function, made when PyTorch is first needed."""
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

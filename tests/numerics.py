"""Derivatives judged by numbers: central differences and the adjoint identity.

A gradient is asserted, not looked at. Stay off kinks: where the two one-sided
derivatives differ (an edge on a grid line, a density of exactly one) no difference
quotient is right.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from packwork.arrays import FloatArray

Array: TypeAlias = npt.NDArray[np.floating[Any]]

STEP = 2.0**-14
"""Half the width of a difference. A power of two, so that points on the renderer's
lattice stay on it. Larger: truncation; smaller: rounding. Derived."""


@dataclass(frozen=True)
class Agreement:
    """How a gradient compares with its reference.

    Parameters
    ----------
    error
        Relative L2: ``|g - r| / |r|``.
    cosine
        Of the angle between the two: direction alone.
    bias
        Signed share by which ``g`` overshoots along ``r``: noise averages out of it, a
        wrong factor does not.
    """

    error: float
    cosine: float
    bias: float


def central_differences(
    value: Callable[[FloatArray], float], at: npt.ArrayLike, step: float = STEP
) -> FloatArray:
    """Gradient of a scalar function at an array of any shape, entry by entry."""
    point = np.array(at, dtype=np.float64)
    gradient = np.empty_like(point)
    for index in np.ndindex(point.shape):
        kept = point[index]
        point[index] = kept + step
        above = value(point.copy())
        point[index] = kept - step
        gradient[index] = (above - value(point.copy())) / (2 * step)
        point[index] = kept
    return gradient


def compare(gradient: npt.ArrayLike, reference: npt.ArrayLike) -> Agreement:
    """Agreement of a gradient with a reference that is not all zero."""
    g = np.asarray(gradient, dtype=np.float64)
    r = np.asarray(reference, dtype=np.float64)
    assert g.shape == r.shape, f"gradient has shape {g.shape}, its variable {r.shape}"
    square = float(np.vdot(r, r))
    assert square > 0, "the reference gradient is zero: the test would judge nothing"
    along = float(np.vdot(g, r))
    length = float(np.linalg.norm(g)) * square**0.5
    return Agreement(
        error=float(np.linalg.norm(g - r)) / square**0.5,
        cosine=along / length if length > 0 else 0.0,
        bias=along / square - 1,
    )


def assert_gradient(
    value: Callable[[FloatArray], float],
    gradient: npt.ArrayLike,
    at: npt.ArrayLike,
    *,
    step: float = STEP,
    error: float = 1e-6,
    bias: float | None = None,
) -> None:
    """Fail unless ``gradient`` is the derivative of ``value`` at ``at``.

    Parameters
    ----------
    value
        Scalar function, evaluated in float64.
    gradient
        What is claimed; of the shape of ``at``.
    error
        Largest relative L2 error.
    bias
        Largest signed bias, as large as ``error`` if None: give less where single
        entries may be noisy but their sum may not lean.
    """
    met = compare(gradient, central_differences(value, at, step))
    report = f"{met}, allowed error {error:g}"
    assert np.isfinite(met.error), report
    assert met.error <= error, report
    assert met.cosine >= 1 - error, report
    assert abs(met.bias) <= (error if bias is None else bias), report


def assert_adjoint(
    forward: Callable[[Array], Array],
    backward: Callable[[Array], Array],
    x: Array,
    y: Array,
    *,
    error: float = 1e-12,
) -> None:
    """Fail unless ``<forward(x), y> = <x, backward(y)>``: each is the other's transpose."""
    ahead = float(np.vdot(forward(x), y))
    back = float(np.vdot(x, backward(y)))
    scale = float(np.linalg.norm(forward(x)) * np.linalg.norm(y))
    assert scale > 0, "the map is zero there: the test would judge nothing"
    assert abs(ahead - back) <= error * scale, f"<Ax, y> = {ahead!r}, <x, A'y> = {back!r}"


def white_image(rng: np.random.Generator, shape: tuple[int, int]) -> FloatArray:
    """Independent noise in every pixel: shows a backward pass that is off by one."""
    return rng.normal(size=shape)


def smooth_image(rng: np.random.Generator, shape: tuple[int, int]) -> FloatArray:
    """Noise of a few pixels' length, as real losses leave it."""
    blurred: FloatArray = ndimage.gaussian_filter(rng.normal(size=shape), 2.0, mode="wrap")
    return blurred / max(float(np.abs(blurred).max()), 1e-300)


def box_mean(image: Array, factor: int) -> Array:
    """Means of ``factor`` x ``factor`` blocks."""
    rows, columns = image.shape[0] // factor, image.shape[1] // factor
    blocks = image.reshape(rows, factor, columns, factor)
    means: Array = blocks.mean(axis=(1, 3))
    return means


def box_spread(image: Array, factor: int) -> Array:
    """Transpose of :func:`box_mean`."""
    return np.kron(image, np.full((factor, factor), 1 / factor**2, dtype=image.dtype))


def winding_numbers(queries: FloatArray, ring: FloatArray) -> npt.NDArray[np.int64]:
    """How often a ring goes clockwise (on screen) round each point: its angles summed."""
    spokes = ring[None, :, :] - queries[:, None, :]
    following = np.roll(spokes, -1, axis=1)
    cross = spokes[..., 0] * following[..., 1] - spokes[..., 1] * following[..., 0]
    dot = np.sum(spokes * following, axis=2)
    turns = np.sum(np.arctan2(cross, dot), axis=1) / (2 * np.pi)
    return np.asarray(np.rint(turns), dtype=np.int64)

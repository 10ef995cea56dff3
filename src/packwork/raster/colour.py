"""The colour image: the renderer of coverage, with a colour for each ring.

A pixel's colour is the background's where nothing lies, an item's where it lies, and mixed by area
where edges pass: ``background + sum of coverage x (colour - background)``. That is linear in
coverage and in colour, whatever overlaps: two items over each other add what each changes of the
background, so no order of drawing is needed, none is lost behind another, and the derivative by
every vertex, colour and the background is exact, by the boundary integral of the density image.
Where items overlap, the image may leave the colours that can be shown; the density beside it says
where (docs/decisions/0037-colour-image.md).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, Image, IntArray, as_points, as_starts
from packwork.errors import ShapeError
from packwork.raster.coverage import Rasteriser, Record
from packwork.raster.kernels import colour as kernels
from packwork.threads import at_once

MAX_CHANNELS = 16
"""Most channels of an image: all of a pixel's are read at once. Chosen."""

MAX_REACH_PX = {np.dtype(np.float32): 1e5, np.dtype(np.float64): 1e9}
"""Furthest that a vertex may lie: edges from further off cross the image where rounding has them
cross. Chosen."""

SHORT_PX = 1e-10
"""How far off a line of the grid the record has a short edge's crossing, px. Derived: a multiple of
what rounding does to the x of the largest image."""


class ColourImage:
    """Renders what a rasteriser has swept last, in colours, again and again.

    ``channels``: how many numbers a colour has, 1 to ``MAX_CHANNELS``.

    >>> rasteriser = Rasteriser((1, 3), np.float64)
    >>> image = ColourImage(rasteriser, 1)
    >>> rasteriser.sweep(np.array([[0.5, 0], [2, 0], [2, 1], [0.5, 1]]), np.array([0, 4]))
    >>> image.render(np.array([[0.0]]), np.array([1.0]))[..., 0].tolist()
    [[0.5, 0.0, 1.0]]
    """

    def __init__(self, rasteriser: Rasteriser, channels: int = 3) -> None:
        if not 1 <= channels <= MAX_CHANNELS:
            raise ShapeError(f"a colour must have 1 to {MAX_CHANNELS} channels, not {channels}")
        self.channels = channels
        self._rasteriser = rasteriser
        rows, columns = rasteriser.shape
        self._deposits = np.zeros((rows + 1, columns * channels), dtype=rasteriser.dtype)
        self._running = np.zeros(columns * channels, dtype=rasteriser.dtype)
        self._excess = np.zeros((0, channels))
        self._area_magic = 0.0
        # The record's parameters have the image's dtype, and a few roundings before.
        self._precision = np.array([8 * float(np.finfo(rasteriser.dtype).eps), SHORT_PX])

    def render(
        self, colours: FloatArray, background: FloatArray, out: Image | None = None
    ) -> Image:
        """Image ``(rows, columns, channels)`` of the rings swept last.

        ``colours``: ``(rings, channels)``, holes have their item's; ``background``:
        ``(channels,)``.
        """
        self.set_colours(colours, background)
        rasteriser, records = self._rasteriser, self._rasteriser.swept.records
        rows, columns = rasteriser.shape
        image = np.empty((rows, columns, self.channels), rasteriser.dtype) if out is None else out
        if len(records) > 1:
            at_once(self._deposit, [(record,) for record in records[:-1]])
        self._deposit(records[-1])
        row = np.tile(background, columns).astype(rasteriser.dtype)
        kernels.accumulate(self._deposits, row, self._running, image.reshape(rows, -1))
        return image

    def set_colours(self, colours: FloatArray, background: FloatArray) -> None:
        """Let derivatives be those of colours as given to :meth:`render`, and render nothing."""
        self._excess = np.ascontiguousarray(colours - background, dtype=np.float64)
        # On a lattice of the colours' range, sums are as exact as those of the density.
        largest = float(np.abs(self._excess).max(initial=0.0))
        power = math.ceil(math.log2(largest)) if largest > 0 else 0
        self._area_magic = self._rasteriser.swept.area_magic * 2.0**power

    def pullback(self, adjoint: Image, gradient: FloatArray) -> None:
        """Add the derivative of sum(adjoint * image) by the swept vertices to ``gradient``.

        ``adjoint``: d loss / d image, contiguous; of colours and background as rendered last.
        """
        flat = adjoint.reshape(-1, self.channels)
        records = self._rasteriser.swept.records
        at_once(self._pull_back, [(record, flat, gradient) for record in records])

    def by_points(self, adjoint: Image) -> FloatArray:
        """Derivative of sum(adjoint * image) by the swept vertices alone, ``(n, 2)``."""
        gradient = np.zeros_like(self._rasteriser.swept.points)
        self.pullback(adjoint, gradient)
        return gradient

    def by_colours(self, adjoint: Image) -> tuple[FloatArray, FloatArray]:
        """Derivatives of sum(adjoint * image) by colours and background."""
        rows, columns = self._rasteriser.shape
        below = np.empty((rows + 1, columns * self.channels), adjoint.dtype)
        kernels.sum_below(adjoint.reshape(rows, -1), np.empty(below.shape[1]), below)
        flat, totals = below.reshape(-1, self.channels), np.zeros_like(self._excess)
        records = self._rasteriser.swept.records
        at_once(self._integrate, [(record, flat, totals) for record in records])
        everything = below[0].reshape(-1, self.channels).sum(axis=0, dtype=np.float64)
        return totals, everything - totals.sum(axis=0)

    def _deposit(self, record: Record) -> None:
        swept = self._rasteriser.swept
        kernels.deposit(
            swept.points, swept.starts, record.order, self._rasteriser.shape[1], swept.x_magic,
            self._area_magic, self._precision, record.cells, record.leaves, record.first,
            self._excess, self._deposits.reshape(-1, self.channels),
        )  # fmt: skip

    def _pull_back(self, record: Record, adjoint: Image, gradient: FloatArray) -> None:
        swept = self._rasteriser.swept
        kernels.pullback(
            swept.points, swept.starts, record.order, record.cells, record.leaves, record.first,
            adjoint, self._excess, gradient,
        )  # fmt: skip

    def _integrate(self, record: Record, below: Image, totals: FloatArray) -> None:
        swept = self._rasteriser.swept
        kernels.integrals(
            swept.points, swept.starts, record.order, self._rasteriser.shape[1], swept.x_magic,
            self._precision, record.cells, record.leaves, record.first, below, totals,
        )  # fmt: skip


def render_colour(
    points_px: npt.ArrayLike,
    starts: npt.ArrayLike,
    colours: npt.ArrayLike,
    shape: tuple[int, int],
    background: npt.ArrayLike = 0.0,
    dtype: npt.DTypeLike = np.float64,
) -> Image:
    """Colour of every pixel, mixed by the exact area that each ring covers of it.

    ``background + sum of coverage x (colour - background)``, linear in coverage and colours: where
    rings overlap, what each changes of the background is added up. Red, green and blue as shares of
    light (linear) mix as light does; any other numbers are mixed alike.

    Parameters
    ----------
    points_px, starts
        As for :func:`packwork.render`; at most 1e9 px off (float32: 1e5).
    colours
        ``(rings, channels)``, or ``(rings,)`` for one channel. A hole has its item's colour.
    shape
        ``(rows, columns)``.
    background
        ``(channels,)`` or one number: what shows where nothing lies.
    dtype
        float64 (default) or float32.

    Returns
    -------
    numpy.ndarray
        ``(rows, columns, channels)``.

    Examples
    --------
    A red tile over one and a half pixels of white:

    >>> tile = [[0.5, 0], [2, 0], [2, 1], [0.5, 1]]
    >>> render_colour(tile, [0, 4], [[1, 0, 0]], (1, 3), background=1.0)[0].tolist()
    [[1.0, 0.5, 0.5], [1.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    """
    return prepare_colour_image(points_px, starts, colours, shape, background, dtype)[1]


def prepare_colour_image(
    points_px: npt.ArrayLike,
    starts: npt.ArrayLike,
    colours: npt.ArrayLike,
    shape: tuple[int, int],
    background: npt.ArrayLike,
    dtype: npt.DTypeLike,
) -> tuple[ColourImage, Image]:
    """Inputs of :func:`render_colour`, to be pulled back through, and its picture.

    >>> tile = [[0.0, 0], [1, 0], [1, 1], [0, 1]]
    >>> image, seen = prepare_colour_image(tile, [0, 4], [[0.5]], (1, 1), 1.0, np.float64)
    >>> seen.item(), image.by_colours(np.ones((1, 1, 1)))[0].item()
    (0.5, 1.0)
    """
    rasteriser = Rasteriser(shape, dtype)
    points, ring_starts = _rings(points_px, starts, rasteriser.dtype)
    table = _colours(colours, len(ring_starts) - 1)
    image = ColourImage(rasteriser, table.shape[1])
    rasteriser.sweep(points, ring_starts)
    return image, image.render(table, _background(background, table.shape[1]))


def render_colour_pullback(
    points_px: npt.ArrayLike,
    starts: npt.ArrayLike,
    colours: npt.ArrayLike,
    adjoint: npt.ArrayLike,
    background: npt.ArrayLike = 0.0,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Derivatives of ``sum(adjoint * render_colour(...))`` by points, colours and background.

    Parameters
    ----------
    adjoint
        ``(rows, columns, channels)``, d loss / d image.

    Returns
    -------
    tuple
        ``(n, 2)``, ``(rings, channels)`` and ``(channels,)``. By pose and size: each point's by
        how the pose moves it.

    Examples
    --------
    More of a red tile is more red, less green and blue:

    >>> tile = [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]]
    >>> green = np.zeros((2, 2, 3)); green[..., 1] = 1
    >>> points, colours, background = render_colour_pullback(tile, [0, 4], [[1, 0, 0]], green, 1.0)
    >>> points[:, 0].tolist(), colours.tolist(), background.tolist()
    ([0.5, -0.5, -0.5, 0.5], [[0.0, 1.0, 0.0]], [0.0, 3.0, 0.0])
    """
    pulls = np.asarray(adjoint)
    dtype = np.dtype(np.float32 if pulls.dtype == np.float32 else np.float64)
    points, ring_starts = _rings(points_px, starts, dtype)
    table = _colours(colours, len(ring_starts) - 1)
    if pulls.ndim != 3 or pulls.size == 0 or pulls.shape[2] != table.shape[1]:
        raise ShapeError(
            f"the adjoint must have shape (rows, columns, {table.shape[1]}), not {pulls.shape}"
        )
    pulls = np.ascontiguousarray(pulls, dtype=dtype)
    rasteriser = Rasteriser((pulls.shape[0], pulls.shape[1]), dtype)
    image = ColourImage(rasteriser, table.shape[1])
    rasteriser.sweep(points, ring_starts)
    image.set_colours(table, _background(background, table.shape[1]))
    return (image.by_points(pulls), *image.by_colours(pulls))


def _rings(
    points_px: npt.ArrayLike, starts: npt.ArrayLike, dtype: np.dtype[Any]
) -> tuple[FloatArray, IntArray]:
    points = as_points(points_px)
    if len(points) and np.abs(points).max() > MAX_REACH_PX[dtype]:
        raise ShapeError(f"points of a {dtype} image must lie within {MAX_REACH_PX[dtype]:g} px")
    return points, as_starts(starts, len(points))


def _colours(colours: npt.ArrayLike, rings: int) -> FloatArray:
    """``(rings, channels)`` finite numbers."""
    table = np.asarray(colours, dtype=np.float64)
    if table.ndim == 1:
        table = table[:, None]
    if table.ndim != 2 or len(table) != rings:
        raise ShapeError(
            f"colours must have shape ({rings}, channels), one a ring, not {np.shape(colours)}"
        )
    if not np.isfinite(table).all():
        raise ShapeError("colours must be finite numbers; some are NaN or infinite")
    return table


def _background(background: npt.ArrayLike, channels: int) -> FloatArray:
    """``(channels,)`` finite numbers, of as many or of one."""
    row = np.asarray(background, dtype=np.float64)
    if row.shape not in {(), (channels,)}:
        raise ShapeError(
            f"the background must be one number or {channels}, not of shape {row.shape}"
        )
    if not np.isfinite(row).all():
        raise ShapeError("the background must be finite; some of it is NaN or infinite")
    return np.broadcast_to(row, (channels,)).copy()

"""The image on which words find places: near those that they had, or where there is room."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.start.first_fit.occupancy import Occupancy
from packwork.start.first_fit.stencil import TOUCHED, covered, cut
from packwork.start.first_poses import container_image

SIDE_PX = 600
"""Longer side of the image. Larger wastes less room at the edges of pixels, and takes longer. As
the finest image of ``first_fit``."""

REACH = 3
"""Width of the fringe in which taken pixels are counted. As in ``first_fit``."""

HOMING = 20.0
"""Score that an item gives for coming nearer to its home by the canvas' side, where what it touches
gives 1 at most. Larger leaves more of the room bare, smaller lets words wander. Tried."""

NOISE = 0.01
"""Random part of a place's score. As in ``first_fit``."""

SIZES = (1.0, 0.9, 0.8, 0.65, 0.5, 0.35, 0.2)
"""Shares of its size at which an item is tried in turn: it grows to the whole of it later on.
Chosen."""


class WordBoard:
    """Pixels of a container, each taken or not.

    Parameters
    ----------
    margin_cu
        Room that every item keeps from others, canvas units.
    """

    def __init__(self, container: Container, rng: np.random.Generator, margin_cu: float) -> None:
        image, self._px_per_cu = container_image(container, SIDE_PX)
        self._occupancy = Occupancy(image > 1 - TOUCHED, REACH)
        self._noise = NOISE * rng.random(image.shape)
        self._margin_px = margin_cu * self._px_per_cu
        rows, columns = np.ogrid[: image.shape[0], : image.shape[1]]
        self._rows, self._columns = rows, columns

    def lay(self, outline: Outline) -> None:
        """Take what an item covers that lies in place."""
        posed = outline.mapped(similarity(0.0, 0.0, 0.0, self._px_per_cu))
        mask, origin = covered(posed, self._margin_px)
        self._occupancy.take(mask, -origin[0], -origin[1])

    def put(
        self,
        outline: Outline,
        scale: float,
        angles: Sequence[float],
        home: tuple[float, float] | None,
    ) -> tuple[float, float, float, float] | None:
        """Pose of an item put on the board, as large as there is room; None if there is none.

        Parameters
        ----------
        scale
            The largest to try; see ``SIZES``.
        angles
            To try, radians, the preferred one first.
        home
            What it is to lie near, canvas units; None puts it where it touches most.

        Returns
        -------
        tuple or None
            x, y, angle, scale.
        """
        worth = self._noise if home is None else self._noise - HOMING * self._away(home)
        for share in SIZES:
            for angle in angles:
                posed = outline.mapped(similarity(0.0, 0.0, angle, share * scale * self._px_per_cu))
                if self._is_larger(posed):
                    continue
                stencil = cut(posed, REACH, self._margin_px)
                found = self._occupancy.best_place(stencil, worth, home is not None)
                if found is not None:
                    _, row, column = found
                    self._occupancy.take(stencil.mask, row, column)
                    x, y = column + stencil.origin[1], row + stencil.origin[0]
                    return x / self._px_per_cu, y / self._px_per_cu, angle, share * scale
        return None

    def _away(self, home: tuple[float, float]) -> FloatArray:
        """Distance of each pixel's corner from a place, over the image's longer side."""
        x, y = home[0] * self._px_per_cu, home[1] * self._px_per_cu
        away = np.hypot(self._rows - y, self._columns - x)
        return np.asarray(away / max(self._noise.shape))

    def _is_larger(self, outline_px: Outline) -> bool:
        left, top, right, bottom = outline_px.bounds
        height, width = self._noise.shape
        wide, high = math.ceil(right) - math.floor(left), math.ceil(bottom) - math.floor(top)
        return bool(wide > width or high > height)

"""A rung of the resolution hierarchy where items repeat: coverages are summed on the torus.

Items are drawn into an image with a margin about the cell. What lies in the margin is added to
where it comes in again, and the sum is laid out once more with its margin: so the losses see the
plane as it will be, and the adjoint, taken back to the cell and laid out likewise, says to every
outline what its images see too. The two ways are transposes of each other, so gradients stay exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias, final

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.losses.image import FUSED
from packwork.losses.pose import Recall
from packwork.losses.term import ImageLoss, SeenInColour
from packwork.scene.container import Container
from packwork.scene.limits import NO_LIMITS, Limits
from packwork.scene.pose import Poses
from packwork.solve.free_space import FreeSpace
from packwork.solve.level import Level

ROOM = 1.3
"""Margin about the cell over the largest radius of an item at a level's begin. Larger takes longer,
of smaller ones items that grow leave the image. Chosen."""

_Part: TypeAlias = tuple[slice, slice]


class Torus:
    """An image with a margin about a cell, in blocks each of which is a part of the cell.

    >>> torus = Torus(Lattice(2.0, 1.0), 1.0, 1)
    >>> torus.repeated(np.arange(12.0).reshape(3, 4)).tolist()
    [[6.0, 5.0, 6.0, 5.0], [6.0, 5.0, 6.0, 5.0], [6.0, 5.0, 6.0, 5.0]]
    >>> torus.summed(np.ones((3, 4))).tolist()
    [[6.0, 6.0, 6.0, 6.0], [6.0, 6.0, 6.0, 6.0], [6.0, 6.0, 6.0, 6.0]]
    """

    def __init__(self, lattice: Lattice, px_per_cu: float, margin: int) -> None:
        rows, columns = (max(round(v * px_per_cu), 1) for v in (lattice.height, lattice.width))
        self.margin, self.cell = margin, (rows, columns)
        self.shape = (rows + 2 * margin, columns + 2 * margin)
        drop = round(lattice.drop * px_per_cu)
        beside = range(-margin // columns, (columns + margin - 1) // columns + 1)
        tops = sorted(
            (i * rows + j * drop, j)
            for j in beside
            for i in range((-margin - j * drop) // rows, (rows + margin - 1 - j * drop) // rows + 1)
        )
        # From the top and the left, so that a pixel's sum is that of its images in reading order.
        self._blocks = [self._block(top, j * columns) for top, j in tops]

    def _block(self, top: int, left: int) -> tuple[_Part, _Part]:
        """Of a cell at that place the part of the image that it is, and the part of the cell."""
        places, parts = [], []
        for begin, side in zip((top, left), self.cell, strict=True):
            first = max(begin, -self.margin)
            last = min(begin, self.margin) + side
            places.append(slice(first + self.margin, last + self.margin))
            parts.append(slice(first - begin, last - begin))
        return (places[0], places[1]), (parts[0], parts[1])

    def _laid_out(self, cell: Image, dtype: np.dtype[Any]) -> Image:
        image = np.empty(self.shape, dtype)
        for place, part in self._blocks:
            image[place] = cell[part]
        return image

    def repeated(self, image: Image) -> Image:
        """The cell of an image, with what repeats of it about it."""
        rows, columns = self.cell
        inner = image[self.margin : self.margin + rows, self.margin : self.margin + columns]
        return self._laid_out(inner, image.dtype)

    def summed(self, image: Image) -> Image:
        """Sum of an image and all its translates: the transpose of :meth:`repeated`, laid out."""
        sums = np.zeros(self.cell)
        for place, part in self._blocks:
            sums[part] += image[place]
        return self._laid_out(sums, image.dtype)


@final
class RepeatingLevel(Level):
    """Level of a tile: nothing lies outside, and what leaves it comes in again.

    Parameters as of :class:`packwork.solve.level.Level`; ``largest``: radius of the largest item,
    canvas units; ``taken``: density of what does not move, of a level of the same ``largest``.
    """

    def __init__(
        self,
        container: Container,
        lattice: Lattice,
        outlines: Sequence[Outline],
        resolution: int,
        largest: float,
        losses: Iterable[str | ImageLoss | SeenInColour] = FUSED,
        nominal: FloatArray | None = None,
        limits: Limits = NO_LIMITS,
        taken: Image | None = None,
    ) -> None:
        px_per_cu = resolution / container.side
        self._lattice = lattice
        self._torus = torus = Torus(lattice, px_per_cu, int(ROOM * largest * px_per_cu) + 2)
        everywhere = np.ones(torus.shape, np.float32)
        room = everywhere if taken is None else np.maximum(everywhere - taken, 0)
        # No item is outside: the way back weighs nothing.
        super().__init__(
            container, outlines, resolution, losses, nominal, limits,
            free_space=FreeSpace(room, Recall(np.ones((1, 1), np.float32), 1.0)),
            seen=round(len(outlines) * everywhere.size / (torus.cell[0] * torus.cell[1])),
        )  # fmt: skip
        self.corner = (-torus.margin / px_per_cu, -torus.margin / px_per_cu)
        self.shifts, self.margin = lattice.neighbours() * px_per_cu, torus.margin

    def gradient(
        self,
        poses: Poses,
        weights: Mapping[str | ImageLoss, float],
        recall: float = 0.0,
        force: float = 1.0,
    ) -> FloatArray:
        """Derivatives as without repeats; nothing calls items back."""
        return super().gradient(self._on_image(poses), weights, 0.0, force)

    def density(self, poses: Poses) -> Image:
        """Density image of these poses and all that repeats of them."""
        return super().density(self._on_image(poses))

    def _on_image(self, poses: Poses) -> Poses:
        x, y = self._lattice.wrapped(np.column_stack([poses.x, poses.y])).T
        return replace(poses, x=x - self.corner[0], y=y - self.corner[1])

    def _sweep(self, poses: Poses) -> None:
        super()._sweep(poses)
        accumulation = self.rasteriser.accumulation
        summed = self._torus.summed(self.rasteriser.density())
        accumulation[:-1] = summed
        accumulation[1:-1] -= summed[:-1]

    def _adjoint(self, weights: Mapping[str | ImageLoss, float]) -> Image:
        return self._torus.repeated(super()._adjoint(weights))

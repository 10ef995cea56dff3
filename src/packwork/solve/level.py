"""One rung of the resolution hierarchy: poses in, pose gradients out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.geometry.outline import Outline
from packwork.losses.linear import LinearAdjoint, LinearWeights
from packwork.losses.recall import Recall
from packwork.losses.registry import find_loss
from packwork.losses.term import ImageLoss, checked_term
from packwork.raster.coverage import Rasteriser
from packwork.raster.pyramid import image_shape, region_image
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.solve.ensemble import Ensemble

RECALL_PX = 200
"""Finest image on which the way back to the container is looked up. Larger costs a
distance transform that no item notices. Chosen."""


class Level:
    """Renders all items at one resolution and reads the losses' pose gradients.

    Parameters
    ----------
    container
        The region to fill.
    outlines
        One per item, item units, as this level shall see them.
    resolution
        Pixels on the canvas' longer side.
    losses
        Further image losses, by name or as functions, with their weights.
    """

    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        resolution: int,
        losses: Mapping[str | ImageLoss, float] | None = None,
    ) -> None:
        self.resolution = resolution
        self.px_per_cu = resolution / container.side
        shape = image_shape(container.width, container.height, resolution)
        self.rasteriser = Rasteriser(shape, np.float32)
        self.container_image = region_image(container.outline, self.rasteriser, self.px_per_cu)
        self.ensemble = Ensemble(outlines)
        self.areas = np.array([o.area for o in outlines])
        """``(n,)`` areas of the outlines as this level sees them, item units squared."""
        self._linear = LinearAdjoint(self.container_image)
        self._recall = _recall(container, min(resolution, RECALL_PX))
        self._losses: list[tuple[ImageLoss, float]] = [
            (find_loss(loss), weight) for loss, weight in (losses or {}).items()
        ]

    def gradient(self, poses: Poses, weights: LinearWeights) -> FloatArray:
        """Derivative of the weighted losses by x, y, angle and log scale, ``(n, 4)``.

        Losses count in squared canvas units (sums over pixels times a pixel's area), so
        that a level change does not change the physics.
        """
        points = self.ensemble.place(poses, self.px_per_cu)
        self.rasteriser.sweep(points, self.ensemble.ring_starts)
        adjoint = self._adjoint(weights)
        by_points = self.rasteriser.pullback(adjoint, beyond=weights.containment)
        by_pose = self.ensemble.gather(by_points, poses, self.px_per_cu)
        by_pose /= self.px_per_cu**2
        recall = self._recall(poses.x, poses.y, self.areas * poses.scale**2)
        pull = weights.containment * self.px_per_cu / self.resolution
        by_pose[:, 0] += pull * recall.x
        by_pose[:, 1] += pull * recall.y
        return by_pose

    def density(self, poses: Poses) -> Image:
        """Density image of these poses; their walk stays on record."""
        points = self.ensemble.place(poses, self.px_per_cu)
        self.rasteriser.sweep(points, self.ensemble.ring_starts)
        return self.rasteriser.density()

    def shares(self, density: Image) -> tuple[float, float, float]:
        """Shares of the container: covered, covered twice, covered outside it."""
        # A container that no pixel of this level shows counts as one pixel.
        whole = max(float(self.container_image.sum()), 1.0)
        covered = np.minimum(density, 1)
        inside = float((covered * self.container_image).sum())
        twice = float(np.maximum(density - 1, 0).sum())
        outside = float((covered * (1 - self.container_image)).sum())
        return inside / whole, twice / whole, outside / whole

    def _adjoint(self, weights: LinearWeights) -> Image:
        if not self._losses:
            return self._linear(self.rasteriser.accumulation, weights)
        accumulation = self.rasteriser.accumulation.copy()
        density = self.rasteriser.density()
        adjoint = self._linear(accumulation, weights)
        for loss, weight in self._losses:
            term = checked_term(loss, density, self.container_image)
            adjoint += weight * density.size * term.adjoint
        return adjoint


def _recall(container: Container, resolution: int) -> Recall:
    px_per_cu = resolution / container.side
    rasteriser = Rasteriser(image_shape(container.width, container.height, resolution))
    return Recall(region_image(container.outline, rasteriser, px_per_cu), px_per_cu)

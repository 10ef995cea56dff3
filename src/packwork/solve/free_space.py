"""Free space of a level: room that may be filled, and the way back to it and to zones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import BoolArray, FloatArray, Image
from packwork.geometry.outline import Outline
from packwork.losses.pose import Recall
from packwork.raster.coverage import Rasteriser, image_shape, region_image
from packwork.scene.container import Container
from packwork.scene.pose import Poses, Zone
from packwork.solve.outlines import Ensemble

RECALL_PX = 200
"""Finest image on which the way back to the container or a zone is looked up. Larger costs a
distance transform that no item notices. Chosen."""


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """Room that may be filled, at one resolution, and the way back to the container.

    ``room``: ``(rows, columns)`` share of each pixel that may be filled.
    """

    room: Image
    recall: Recall

    @classmethod
    def of(cls, container: Container, resolution: int) -> FreeSpace:
        """Free space of a container in which nothing stands.

        >>> from packwork.geometry.outline import Outline
        >>> tile = Outline.from_rings([np.array([[0.0, 0], [8, 0], [8, 8], [0, 8]])])
        >>> FreeSpace.of(Container("tile", "tile", tile, 16.0, 8.0), 16).room.sum()
        np.float32(64.0)
        """
        coarse = min(resolution, RECALL_PX)
        recall = Recall(_image(container, coarse), coarse / container.side)
        return cls(_image(container, resolution), recall)

    def less(self, density: Image) -> FreeSpace:
        """The same where something stands that does not move, ``(rows, columns)``.

        >>> free_space = FreeSpace(np.ones((1, 2)), Recall(np.ones((1, 2)), 1.0))
        >>> free_space.less(np.array([[0.25, 2.0]])).room.tolist()
        [[0.75, 0.0]]
        """
        return replace(self, room=np.maximum(self.room - density, 0))


def _image(container: Container, resolution: int) -> Image:
    rasteriser = Rasteriser(image_shape(container.width, container.height, resolution))
    return region_image(container.outline, rasteriser, resolution / container.side)


class ZonePull:
    """Pull of a zone on its items: a price on their area outside it, and on lost centres.

    Only these items are drawn, into an image of their own: the price has to depend on whose area it
    is. It is linear in that area, as containment is, and the same in all of the plane, so that the
    adjoint image is made once. ``outlines``: of the whole layout, item units, as the level sees
    them; ``shape``: of the level's image.
    """

    def __init__(
        self, zone: Zone, outlines: Sequence[Outline], shape: tuple[int, int], px_per_cu: float
    ) -> None:
        self.items = zone.items
        self._px_per_cu = px_per_cu
        self._ensemble = Ensemble([outlines[k] for k in zone.items])
        self._areas = np.array([outlines[k].area for k in zone.items])
        self._rasteriser = Rasteriser(shape, np.float32)
        inside = region_image(zone.outline, self._rasteriser, px_per_cu)
        self.outside: Image = 1 - inside
        """Per pixel of the level, the share outside the zone."""
        self._blank = np.empty_like(inside)
        self._recall = _recall(zone, shape, px_per_cu)
        most = float(inside.max())
        self.room: BoolArray = inside > 0.5 if most > 0.5 else inside >= most / 2
        """Pixels of the level that belong to the zone; of one thinner than half a pixel, where it
        is thickest."""

    def add(self, by_pose: FloatArray, poses: Poses, price: float) -> None:
        """Add the derivatives of the zone's items to those of all, ``(n, 5)``.

        By canvas unit, rad, log scale and log stretch; ``price``: of a squared canvas unit outside
        the zone.
        """
        own = poses.subset(self.items)
        points = self._ensemble.place(own, self._px_per_cu)
        self._rasteriser.sweep(points, self._ensemble.ring_starts)
        by_points = self._rasteriser.pullback(self.outside, beyond=1.0)
        felt = self._ensemble.gather(by_points, own, self._px_per_cu)
        by_pose[self.items] += price / self._px_per_cu**2 * felt
        # The next sweep begins with an empty buffer.
        self._rasteriser.density(self._blank)
        called = self._recall(own.x, own.y, self._areas * own.scale**2)
        side_cu = max(self.outside.shape) / self._px_per_cu
        by_pose[self.items, 0] += price / side_cu * called.x
        by_pose[self.items, 1] += price / side_cu * called.y

    def value(self, poses: Poses) -> float:
        """Objective of :meth:`add`, at a price of 1, squared canvas units."""
        own = poses.subset(self.items)
        areas = self._areas * own.scale**2
        self._rasteriser.sweep(
            self._ensemble.place(own, self._px_per_cu), self._ensemble.ring_starts
        )
        inside = self._rasteriser.density(self._blank) * (1 - self.outside)
        called = self._recall(own.x, own.y, areas)
        side_cu = max(self.outside.shape) / self._px_per_cu
        kept = float(inside.sum(dtype=np.float64)) / self._px_per_cu**2
        return float(areas.sum() - kept + called.value / side_cu)


def _recall(zone: Zone, shape: tuple[int, int], px_per_cu: float) -> Recall:
    coarser = max(max(shape) / RECALL_PX, 1.0)
    rows, columns = (int(np.ceil(side / coarser)) for side in shape)
    scale = px_per_cu / coarser
    return Recall(region_image(zone.outline, Rasteriser((rows, columns)), scale), scale)

"""Ground of a level: room that may be filled, and the way back to the container."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import Image
from packwork.losses.pose import Recall
from packwork.raster.coverage import Rasteriser
from packwork.raster.pyramid import image_shape, region_image
from packwork.scene.container import Container

RECALL_PX = 200
"""Finest image on which the way back to the container is looked up. Larger costs a
distance transform that no item notices. Chosen."""


@dataclass(frozen=True, eq=False)
class Ground:
    """Room at one resolution, and the way back to the container.

    Parameters
    ----------
    room
        ``(rows, columns)`` share of each pixel that may be filled.
    recall
        Distance from the container of items whose centre lies outside it.
    """

    room: Image
    recall: Recall

    @classmethod
    def of(cls, container: Container, resolution: int) -> Ground:
        """Ground of a container in which nothing stands.

        Examples
        --------
        >>> from packwork.geometry.outline import Outline
        >>> tile = Outline.from_rings([np.array([[0.0, 0], [8, 0], [8, 8], [0, 8]])])
        >>> Ground.of(Container("tile", "tile", tile, 16.0, 8.0), 16).room.sum()
        np.float32(64.0)
        """
        coarse = min(resolution, RECALL_PX)
        recall = Recall(_image(container, coarse), coarse / container.side)
        return cls(_image(container, resolution), recall)

    def less(self, density: Image) -> Ground:
        """The same where something stands that does not move, ``(rows, columns)``.

        Examples
        --------
        >>> ground = Ground(np.ones((1, 2)), Recall(np.ones((1, 2)), 1.0))
        >>> ground.less(np.array([[0.25, 2.0]])).room.tolist()
        [[0.75, 0.0]]
        """
        return replace(self, room=np.maximum(self.room - density, 0))


def _image(container: Container, resolution: int) -> Image:
    rasteriser = Rasteriser(image_shape(container.width, container.height, resolution))
    return region_image(container.outline, rasteriser, resolution / container.side)

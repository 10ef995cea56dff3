"""Items in the places of others: how unlike their shapes are, and poses after an exchange."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.simplify import hull_areas
from packwork.pipeline.job import Job
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_poses import container_image, start_resolution
from packwork.start.stippling import stippled


def even_points(region: Container, count: int, rng: np.random.Generator) -> FloatArray:
    """``(count, 2)`` points spread evenly over a container, canvas units."""
    inside, px_per_cu = container_image(region, start_resolution(count))
    found = stippled(inside, np.ones_like(inside), count, rng)
    return np.column_stack([found.x, found.y]) / px_per_cu


def shapes(job: Job, movable: IntArray) -> FloatArray:
    """``(n, 2)`` logarithms of width over height, and of the share that fills the box."""
    found = []
    for k in movable:
        outline = job.items[k].outline
        left, top, right, bottom = outline.bounds
        wide, high = right - left, bottom - top
        found.append((np.log(wide / high), np.log(outline.area / (wide * high))))
    return np.array(found)


def exchanged(job: Job, poses: Poses, places: IntArray, comers: IntArray) -> Poses:
    """Poses in which ``comers`` have the places, angles and sizes of hull of ``places``."""
    hulls = hull_areas([item.outline for item in job.items])
    x, y, angle, scale = (getattr(poses, name).copy() for name in ("x", "y", "angle", "scale"))
    x[comers], y[comers], angle[comers] = poses.x[places], poses.y[places], poses.angle[places]
    scale[comers] = poses.scale[places] * np.sqrt(hulls[places] / hulls[comers])
    return replace(poses, x=x, y=y, angle=angle, scale=scale)

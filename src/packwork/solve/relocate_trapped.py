"""Relocation of trapped items to the largest voids, between levels.

An item wholly inside another sees the same adjoint all round: no force, no torque, only
shrinking. Between levels, and half-way through the last, the worst are moved out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.voids import Clearance, largest_voids
from packwork.scene.pose import NO_LIMITS, Limits, Poses
from packwork.solve.level import Level

TRAPPED_SHARE = 0.02
"""Share of an item that is overlapped or outside from which it counts as trapped.
Smaller moves items that would have worked themselves free. Tried."""

MOST_AT_ONCE = 0.1
"""Share of the items moved in one go: more upsets a layout that was settling. Tried."""

SNUGNESS = 0.8
"""Area of a moved item over that of the void's largest disc, at most. Tried."""


@dataclass(frozen=True)
class Relocation:
    """One item that was relocated, canvas units."""

    item: int
    share: float
    from_x: float
    from_y: float
    to_x: float
    to_y: float


def violation_shares(level: Level, poses: Poses, density: Image) -> FloatArray:
    """Share of each item's area that is overlapped or outside the container or its zone.

    ``(n,)``; ``density`` must be the one whose walk the level still has on record.
    """
    wrong = np.maximum(np.clip(density - 1, 0, 1), 1 - level.container_image)
    per_item = level.ensemble.per_item(level.rasteriser.ring_integrals(wrong))
    for zone in level.zones:
        wrong_here = level.rasteriser.ring_integrals(np.maximum(wrong, zone.outside))
        per_item[zone.items] = level.ensemble.per_item(wrong_here)[zone.items]
    areas_px = level.areas * (poses.scale * level.px_per_cu) ** 2
    on_canvas = level.ensemble.per_item(level.rasteriser.ring_integrals(np.ones_like(density)))
    return np.asarray((per_item + np.maximum(areas_px - on_canvas, 0)) / areas_px)


def relocate_trapped(
    level: Level,
    poses: Poses,
    areas: FloatArray,
    smallest: FloatArray,
    largest: FloatArray,
    limits: Limits = NO_LIMITS,
) -> tuple[Poses, list[Relocation]]:
    """Relocate the worst trapped items to the largest voids.

    ``areas``: ``(n,)`` item units squared; ``smallest``, ``largest``: ``(n,)`` bounds of the
    scales.
    """
    density = level.density(poses)
    shares = violation_shares(level, poses, density)
    if limits.binds:
        shares = shares * limits.is_movable
    homes = {int(k): np.flatnonzero(zone.room) for zone in level.zones for k in zone.items}
    worst = np.argsort(-shares, kind="stable")[: max(1, int(MOST_AT_ONCE * len(poses)))]
    worst = worst[shares[worst] > TRAPPED_SHARE]
    if len(worst) == 0:
        return poses, []
    free = (level.container_image > 0.5) & (density < 0.5)
    room = Clearance(free, level.shifts, level.margin)
    x, y, scale = poses.x.copy(), poses.y.copy(), poses.scale.copy()
    relocations = []

    def fitted(k: int, free_px: float) -> float:
        free = free_px / level.px_per_cu
        fitting = np.sqrt(SNUGNESS * np.pi * free**2 / areas[k])
        return float(np.clip(min(fitting, poses.scale[k]), smallest[k], largest[k]))

    def taken_px(k: int, free_px: float) -> float:
        return float(np.sqrt(areas[k] / np.pi) * fitted(k, free_px) * level.px_per_cu)

    # Where no void is left, an item would be worse off anywhere.
    for k, x_px, y_px, free_px in largest_voids(
        room, worst, taken_px, least_px=float(np.nextafter(0.0, 1.0)), among=homes.get
    ):
        scale[k] = fitted(k, free_px)
        x[k] = x_px / level.px_per_cu + level.corner[0]
        y[k] = y_px / level.px_per_cu + level.corner[1]
        relocations.append(
            Relocation(
                k, float(shares[k]), float(poses.x[k]), float(poses.y[k]),
                float(x[k]), float(y[k]),
            )
        )  # fmt: skip
    return replace(poses, x=x, y=y, scale=scale), relocations

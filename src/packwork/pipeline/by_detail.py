"""First places and sizes where a picture is to be shown: small items where it has much to show.

Of items each of one colour, so many to the square that their number goes with the change of colour
across a place shows a picture with the least squared error (A. Gersho, "Asymptotically optimal
block quantization", IEEE Transactions on Information Theory 25 (1979), 373-380,
doi:10.1109/TIT.1979.1056067); Lloyd's method finds such places where it weighs pixels by the square
of that change.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.boxes import box_mean
from packwork.pipeline.job import Job
from packwork.scene.container import Container
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.target import TargetPicture, blurred
from packwork.start.first_poses import container_image, start_resolution
from packwork.start.stippling import stippled

FARTHEST = 4.0
"""Side of the largest places over that of the smallest, about, at a detail of 1. Larger shows finer
lines by coarser areas. Chosen by eye."""

CLEAR = 0.98
"""Share of the pixels whose change of colour is below the most that counts. Larger lets one sharp
edge take all small items. Chosen."""

SMOOTH, SPREAD = 0.25, 0.5
"""Sides of the squares over which the picture is averaged before its change of colour is taken, and
over which that is averaged, over that of an item's share of the canvas. Smaller ones follow grain,
larger ones miss lines. Chosen."""


@dataclass(frozen=True, eq=False)
class DetailedPlaces:
    """Places of items, one each, and what share of the area each place is given.

    Parameters
    ----------
    x, y
        ``(n,)``, canvas units.
    shares
        ``(n,)`` relative areas.
    """

    x: FloatArray
    y: FloatArray
    shares: FloatArray


def places_by_detail(
    job: Job, region: Container, rng: np.random.Generator
) -> DetailedPlaces | None:
    """A place for each item, the heaviest ones where the picture has least to show.

    None where no detail is asked for.
    """
    if job.target is None or not job.plan.detail:
        return None
    count = len(job.items)
    inside, px_per_cu = container_image(region, start_resolution(count))
    density = _density(job.target, inside.shape, px_per_cu, count) ** job.plan.detail
    found = stippled(inside, density, count, rng)
    # Items of one weight come anywhere, copies of one drawing not all to one end.
    mixed = rng.permutation(count)
    items = mixed[np.argsort(-job.weights[mixed], kind="stable")]
    of_item = np.empty(count, dtype=np.int64)
    is_ranked = np.ptp(job.weights) > 0
    of_item[items] = np.argsort(-found.areas, kind="stable") if is_ranked else np.arange(count)
    x, y = found.x[of_item] / px_per_cu, found.y[of_item] / px_per_cu
    return DetailedPlaces(x, y, found.areas[of_item])


def _density(target: TargetPicture, shape: tuple[int, ...], px_per_cu: float, count: int) -> Image:
    """Squared change of colour across each pixel, over the most that counts."""
    labs = oklabs_of_light(blurred(target.light, SMOOTH, count))
    down, across = np.gradient(labs, axis=(0, 1))
    change = (down**2 + across**2).sum(axis=2)
    wide = 2 * int(SPREAD * np.sqrt(change.size / count) / 2) + 1
    seen = box_mean(np.ascontiguousarray(change), wide) if wide > 1 else change
    rows, columns = (
        np.minimum(((np.arange(n) + 0.5) / px_per_cu * target.px_per_cu).astype(int), most - 1)
        for n, most in zip(shape, seen.shape, strict=True)
    )
    laid = seen[np.ix_(rows, columns)]
    most = max(float(np.quantile(laid, CLEAR)), 1e-12)
    return np.asarray(np.clip(laid / most, FARTHEST**-4, 1.0))

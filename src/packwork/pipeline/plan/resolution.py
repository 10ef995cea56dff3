"""How fine photographs are where they lie, and how large that lets them be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.job import Job
from packwork.scene.item import PhotoArt
from packwork.scene.layout import Layout
from packwork.units import convert
from packwork.writers.printing import DPI

ROUNDING = 1e-3
"""Share by which a photo may miss what is asked: sizes are rounded, pixels are not. Chosen."""


MOST_NAMED = 5
"""Photos that a line names; a report has them all. Chosen."""


@dataclass(frozen=True)
class PhotoPixels:
    """A photo of a layout, and its own pixels to the inch of the canvas, however it is drawn."""

    photo: str
    ppi: float


def photo_pixels(layout: Layout) -> tuple[PhotoPixels, ...]:
    """Pixels to the inch of all photos of a layout, in its order."""
    inch = convert(1.0, "in", layout.container.unit)
    scales = layout.poses.axis_scales.max(axis=1).tolist()
    return tuple(
        # A photo's own units are its pixels.
        PhotoPixels(item.name, round(inch / scale, 2))
        for item, scale in zip(layout.items, scales, strict=True)
        if isinstance(item.art, PhotoArt)
    )


def coarser(photos: Sequence[PhotoPixels], ppi: float) -> list[PhotoPixels]:
    """Photos that have fewer pixels to the inch, the coarsest first.

    Examples
    --------
    >>> [one.photo for one in coarser([PhotoPixels("a", 90), PhotoPixels("b", 300)], 300)]
    ['a']
    """
    found = [one for one in photos if one.ppi < (1 - ROUNDING) * ppi]
    return sorted(found, key=lambda one: one.ppi)


def coarse_photos(layout: Layout, dpi: float | None) -> list[str]:
    """Photos that have fewer pixels than paper is to show, in a sentence; or nothing.

    Parameters
    ----------
    dpi
        What was asked of the files; None leaves it to what printers like, and asks nothing of a
        canvas in px, which is for screens.
    """
    if dpi is None and layout.container.unit == "px":
        return []
    asked = dpi or DPI
    photos = photo_pixels(layout)
    short = coarser(photos, asked)
    if not short:
        return []
    named = enumerated([f"{one.photo} ({one.ppi:.0f})" for one in short], MOST_NAMED)
    many = number_of(len(photos), "photo has", "photos have")
    return [
        f"{len(short)} of {many} fewer than {asked:g} pixels to the inch: {named}; "
        "--least-dpi N keeps such photos smaller"
    ]


def largest_scales(job: Job) -> FloatArray:
    """``(n,)`` scales beyond which photos would have fewer pixels than ``least_dpi`` asks.

    Infinite for what is no photo, and for photos whose size is given.

    Raises
    ------
    RecipeError
        If sizes are not free.
    """
    least = job.plan.least_dpi
    if least is None:
        return np.full(len(job.items), np.inf)
    if job.plan.sizes != "free":
        raise RecipeError(
            "least_dpi", f"bounds free sizes, not {job.plan.sizes} ones; use --sizes free"
        )
    most = convert(1.0, "in", job.container.unit) / least
    return np.array(
        [
            most if isinstance(item.art, PhotoArt) and "size" not in one.pin else np.inf
            for item, one in zip(job.items, job.asked, strict=True)
        ]
    )


def resolution_faults(job: Job, layout: Layout) -> tuple[str, ...]:
    """Photos that are coarser than ``least_dpi`` asks all the same, in a sentence; or nothing."""
    least = job.plan.least_dpi
    short = [] if least is None else coarser(photo_pixels(layout), least)
    if not short:
        return ()
    many = number_of(len(short), "photo has", "photos have")
    return (
        f"{many} fewer than the {least:g} pixels to the inch asked for, "
        f"{short[0].photo} the fewest: {short[0].ppi:.0f}",
    )

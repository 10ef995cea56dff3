"""Recognition of a mosaic's picture from afar, and the number of items that would show it.

Layout and picture are seen at the size of a thumbnail, in Oklab, and correlated there. Of a layout
whose items have been shuffled that is nothing but noise about zero. What is missed goes down with
the root of the number of items, as noise does that is averaged.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.pipeline.job import Job
from packwork.raster.coverage import coverage
from packwork.scene.colour import css_colour
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.layout import Layout
from packwork.scene.light import light_of
from packwork.scene.swatch import mean_lights
from packwork.scene.target import TargetPicture
from packwork.steps.dress.likeness import windows_of

SIDE_PX = 64
"""Longer side at which a thumbnail is looked at. Larger asks for details, smaller for blots alone.
Chosen."""

LEAST = 0.7
"""Correlation from which a picture is recognised. Larger blames a face of 300 icons (0.77), smaller
passes 300 photographs of any colours (0.58) and 60 icons (0.43). By eye."""

COUNTS = (100, 200, 300, 500, 700, 1_000, 1_500, 2_000, 3_000, 5_000, 7_000, 10_000)
"""Numbers of items that are named. Chosen."""

HALF = "50%"
"""Tint that shows a picture by photographs of any colours. By eye."""


def unrecognised(job: Job, target: TargetPicture, layout: Layout) -> tuple[str, ...]:
    """Remedy for a picture that does not show, in a sentence; nothing where it shows or is none."""
    if not layout.items:
        return ()
    found = likeness(layout, target)
    if found >= LEAST:
        return ()
    needed = len(layout.items) * ((1 - found) / (1 - LEAST)) ** 2
    more = [f"-n {count:,}".replace(",", "") for count in COUNTS if count >= needed][:1]
    if job.tints.mean() < 0.5:
        more.append(f"--tint {HALF}")
    remedy = " or ".join(more) or "a plainer picture"
    return (f"the picture shows to {max(100 * found, 0):.0f} % only; {remedy} would show it",)


def likeness(layout: Layout, target: TargetPicture) -> float:
    """Correlation of a layout with the picture, both thumbnails, inside the container."""
    seen = _thumb(_seen(layout, target))
    return _correlation(seen, _thumb(target.light), _inside(layout, target))


def _seen(layout: Layout, target: TargetPicture) -> FloatArray:
    """Light of a layout in the pixels of the picture, each item in its mean colour."""
    ground = light_of(np.array(css_colour(layout.ground or "white")[:3]) / 255)
    light = np.broadcast_to(ground, target.light.shape).copy()
    lights = mean_lights(layout.items)
    for window, own in zip(windows_of(layout, target), lights, strict=True):
        part = light[window.rows, window.columns]
        part += window.shares[..., None] * (own - ground)
    return np.clip(light, 0.0, 1.0)


def _thumb(light: FloatArray) -> FloatArray:
    """The same, averaged over squares, in Oklab ``(rows, columns, 3)``."""
    size = max(round(max(light.shape[:2]) / SIDE_PX), 1)
    rows, columns = (max(n // size, 1) for n in light.shape[:2])
    squares = light[: rows * size, : columns * size].reshape(rows, size, columns, size, -1)
    mean = squares.mean(axis=(1, 3))
    return oklabs_of_light(mean.reshape(-1, 3)).reshape(rows, columns, 3)


def _inside(layout: Layout, target: TargetPicture) -> BoolArray:
    outline = layout.container.outline
    shape = target.light.shape[:2]
    whole = coverage(outline.points * target.px_per_cu, outline.starts, (shape[0], shape[1]))
    size = max(round(max(shape) / SIDE_PX), 1)
    rows, columns = (max(n // size, 1) for n in shape)
    squares = whole[: rows * size, : columns * size].reshape(rows, size, columns, size)
    return np.asarray(squares.mean(axis=(1, 3)) > 0.5)


def _correlation(one: FloatArray, other: FloatArray, inside: BoolArray) -> float:
    a, b = (values[inside] - values[inside].mean(axis=0) for values in (one, other))
    scale = float(np.sqrt((a**2).sum() * (b**2).sum()))
    return float((a * b).sum()) / scale if scale > 0 else 0.0

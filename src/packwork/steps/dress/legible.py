"""Items that can be told from the picture behind them: by their colour, else by a halo."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
from PIL import Image

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.pipeline.job import Job
from packwork.raster.coverage import coverage
from packwork.raster.drawing import drawn_png
from packwork.scene.container import Backdrop, Container
from packwork.scene.contrast import contrast_over, luminances, readable, readable_over
from packwork.scene.item import Item, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.notation import matrix_text
from packwork.scene.recolour import has_one_colour, recoloured
from packwork.scene.swatch import representative_colour

TEXT, GRAPHIC = 4.5, 3.0
"""Least contrast of words and of other items with what lies under them: WCAG 2.2, 1.4.3 and
1.4.11, level AA."""

GROUND_PX = 500
"""Longer side of the image in which it is looked up what lies under an item. Larger is slower
and sees grain that no eye does. Chosen."""

DARKEST, BRIGHTEST = 5.0, 95.0
"""Percentiles of luminance under an item that count as the darkest and the brightest: a spark
does not make a word unreadable. Chosen."""

BRIGHT = 0.4
"""Mean luminance under items from which halos are black: the eye's middle grey has 0.18, and
white rims look better than black ones for long. Chosen by eye."""

PAPER = "white"
"""What is seen where the picture does not reach."""


def legible(job: Job, layout: Layout) -> Layout:
    """Layout whose items stand out from the picture behind.

    Photos stay as they are. What has one colour gets a lighter or darker one of that hue where
    it needs to; where none would do, and what has several colours, gets a halo.
    """
    behind = layout.container.backdrop
    if behind is None:
        return layout
    ground = ground_luminance(layout.container, behind)
    words = set(job.use.words)
    under = luminances_under(layout, ground)
    # One colour for all: halos of two colours look like a mistake.
    halo = "white" if np.mean(under) < BRIGHT else "black"
    items = tuple(
        _told_apart(item, pair, TEXT if original in words else GRAPHIC, halo)
        for item, original, pair in zip(layout.items, job.items, under, strict=True)
    )
    return replace(layout, items=items)


def ground_luminance(container: Container, behind: Backdrop) -> FloatArray:
    """``[row, col]`` luminance, 0..1, of the picture behind on its canvas."""
    scale = GROUND_PX / container.side
    width, height = (max(1, round(side * scale)) for side in (container.width, container.height))
    art = behind.art.preview
    place = matrix_text(affine.compose(behind.matrix, art.matrix))
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'width="{width}" height="{height}" viewBox="0 0 {container.width} {container.height}" '
        f'preserveAspectRatio="none"><rect width="100%" height="100%" fill="{PAPER}"/>'
        f'<g transform="{place}">{art.markup}</g></svg>'
    )
    with Image.open(io.BytesIO(drawn_png(text))) as picture:
        return luminances(np.asarray(picture.convert("RGB"), dtype=np.float64) / 255)


def luminances_under(layout: Layout, ground: FloatArray) -> list[tuple[float, float]]:
    """Least and greatest luminance of ``ground`` ``(rows, columns)`` under each item."""
    scale = GROUND_PX / layout.container.side
    found = []
    for ink in layout.inks:
        share = coverage(ink.points * scale, ink.starts, ground.shape, np.float32)
        seen = ground[share >= min(0.5, float(share.max()))]
        low, high = np.percentile(seen, [DARKEST, BRIGHTEST])
        found.append((float(low), float(high)))
    return found


def _told_apart(item: Item, under: tuple[float, float], least: float, halo: str) -> Item:
    if isinstance(item.art, PhotoArt):
        return item
    own = representative_colour(item)
    if contrast_over(own, *under) >= least:
        return item
    can_change = has_one_colour(item.art)
    better = readable_over(own, *under, least) if can_change else None
    if better is not None:
        return recoloured(item, better)
    if not can_change:
        return replace(item, halo=halo)
    return replace(recoloured(item, readable(own, halo, least)), halo=halo)

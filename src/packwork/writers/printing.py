"""Photographs at the size of the print: each opened once more, for its largest copy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from packwork.scene.item import Art, Item, PhotoArt, VectorArt
from packwork.scene.layout import Layout
from packwork.units import convert

DPI = 300
"""Pixels of a photo to the inch of paper, where nothing else is asked. More: larger files.
Chosen, as printers do."""

SPARE = 1.2
"""Pixels of a photo per pixel of a picture that it is drawn into: it is turned there, which
softens what has no more than one. Larger takes longer and more memory. Tried by eye."""


def printed(layout: Layout, px_per_cu: float) -> Layout:
    """Layout whose photos have that many pixels per canvas unit, if there are as many.

    One photo at a time is in memory; what stays of it is a file in text.

    Raises
    ------
    ReadError
        If a photo is no longer there, or broken.
    """
    layout = _with_backdrop(layout, px_per_cu)
    largest: dict[Art, float] = {}
    scales = layout.poses.axis_scales.max(axis=1).tolist()
    for item, scale in zip(layout.items, scales, strict=True):
        if isinstance(item.art, PhotoArt):
            largest[item.art] = max(largest.get(item.art, 0.0), scale)
    if not largest:
        return layout
    arts: dict[Art, VectorArt] = {}
    known: dict[Item, Item] = {}
    for item in layout.items:
        if isinstance(item.art, PhotoArt) and item not in known:
            key = item.art
            if key not in arts:
                arts[key] = item.art.original.printed(largest[key] * px_per_cu)
            known[item] = replace(item, art=arts[key])
    return replace(layout, items=tuple(known.get(item, item) for item in layout.items))


def _with_backdrop(layout: Layout, px_per_cu: float) -> Layout:
    """The same layout, the picture behind as fine as that."""
    container = layout.container
    behind = container.backdrop
    if behind is None:
        return layout
    art = behind.art.original.printed(float(np.hypot(*behind.matrix[:, 0])) * px_per_cu)
    behind = replace(behind, art=replace(behind.art, preview=art))
    return replace(layout, container=replace(container, backdrop=behind))


def printed_on_paper(layout: Layout, dpi: float) -> Layout:
    """The same layout, its photos with that many pixels per inch of the canvas.

    Raises
    ------
    ReadError
        If a photo is no longer there, or broken.
    """
    return printed(layout, dpi * convert(1.0, layout.container.unit, "in"))

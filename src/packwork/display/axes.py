"""A layout on Matplotlib axes: what is drawn of each item as a path."""

from __future__ import annotations

from typing import Any

import numpy as np

from packwork.display.extras import found
from packwork.geometry.outline import Outline
from packwork.scene.layout import Layout
from packwork.scene.swatch import representative_colour

INSTEAD = "save a picture"


def draw_on_axes(layout: Layout, ax: Any = None) -> Any:
    """Axes with a patch for each item, in canvas units, y down.

    Raises ``PackworkError`` if Matplotlib is not installed.
    """
    patches = found("matplotlib.patches", INSTEAD)
    if ax is None:
        _, ax = found("matplotlib.pyplot", INSTEAD).subplots(layout="constrained")
        ax.axis("off")
    colours = {item.art: representative_colour(item) for item in layout.items}
    told: set[str] = set()
    for item, ink in zip(layout.items, layout.inks, strict=True):
        category = "" if item.datum is None else item.datum.category
        # What begins with a line is no key to Matplotlib, which is right for all but the first.
        label = "_" + item.name if category in told or not category else category
        told.add(category)
        patch = patches.PathPatch(
            _path(ink), facecolor=colours[item.art], edgecolor="none", label=label
        )
        ax.add_patch(patch)
    ax.set_xlim(0.0, layout.container.width)
    ax.set_ylim(layout.container.height, 0.0)
    ax.set_aspect("equal")
    return ax


def _path(outline: Outline) -> Any:
    """All rings as one path: holes run the other way, so they stay free."""
    path = found("matplotlib.path", INSTEAD).Path
    rings = [np.vstack([ring, ring[:1]]) for ring in outline.rings]
    codes = np.full(sum(map(len, rings)), path.LINETO, dtype=path.code_type)
    begins = np.cumsum([0, *map(len, rings)])
    codes[begins[:-1]] = path.MOVETO
    codes[begins[1:] - 1] = path.CLOSEPOLY
    return path(np.vstack(rings), codes)

"""Glyphs of TrueType fonts: quadratic outlines and composites, from ``glyf``."""

from __future__ import annotations

import numpy as np

from packwork.readers.text.pen import Draw, RingPen
from packwork.readers.text.sfnt import Font
from packwork.readers.unfit import UnfitError


def truetype_drawer(font: Font) -> Draw:
    """Function that draws the glyph of a name; of a variable font, its default.

    Raises
    ------
    UnfitError
        If the glyphs' places in the file make no sense.
    """
    _check_places(font)
    table = font["glyf"]
    metrics = font["hmtx"].metrics
    depth = 0

    def draw(name: str, pen: RingPen) -> None:
        nonlocal depth
        glyph = table[name]
        # A whole glyph begins at its side bearing, a component where it is put.
        bearing = metrics[name][1] - glyph.xMin if depth == 0 and hasattr(glyph, "xMin") else 0
        depth += 1
        try:
            if glyph.isComposite() and bearing:
                pen.addComponent(name, (1, 0, 0, 1, bearing, 0))
            else:
                glyph.draw(pen, table, bearing)
        finally:
            depth -= 1

    return draw


def _check_places(font: Font) -> None:
    """Refuse places that run backwards: each would copy most of the table."""
    places = np.asarray(font["loca"].locations, dtype=np.int64)
    most = len(font.getGlyphOrder()) + 1
    if len(places) > most or (np.diff(places) < 0).any():
        raise UnfitError("is a damaged font (its glyphs overlap in the file); give an intact one")

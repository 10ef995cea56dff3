"""Filters that paint beyond their shapes, or nothing at all: detected by rendering."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from dataclasses import replace

from packwork.readers.budget.expansion import count_expanded
from packwork.readers.budget.filters import FILTER, drop_filters
from packwork.readers.svg.drawing import Drawing
from packwork.readers.svg.render.compare import SIDES_PX, excess, side_by_side
from packwork.readers.unfit import UnfitError, notice

MOST_GLOW = 0.02
"""What filters may add beyond the ink, as a share of it. Larger lets shadows fall on
neighbours, smaller takes the shading off drawings whose edges it softens. Tried: the
shading of four public collections stays below 0.003, shadows come to 0.05 and more."""


def without_glow(drawing: Drawing) -> ET.Element:
    """Tree of a drawing, its filters taken off if they paint beyond its ink, which is said.

    Raises
    ------
    UnfitError
        If its filters leave nothing to be seen.

    Examples
    --------
    >>> from packwork.readers.svg.drawing import read_drawing
    >>> data = b'<svg viewBox="0 0 9 9"><rect width="4" height="2"/></svg>'
    >>> len(without_glow(read_drawing(data)))
    1
    """
    root, ink = drawing.root, drawing.ink.whole
    if not any(FILTER in element.attrib for element in root.iter()):
        return root
    work = replace(drawing.work, layers=count_expanded(root)[1])
    side = work.side(SIDES_PX[0], work.page)
    work.spend(side, work.page)
    shown, drawn = side_by_side(ink, root, drawing.page, side)
    if not shown.any():
        raise UnfitError("paints nothing, for its filters hide every shape; save it without them")
    if excess(shown, drawn) <= MOST_GLOW:
        return root
    notice("its filters were left out, for they paint shadows or light beyond its shapes")
    plain = copy.deepcopy(root)
    drop_filters(plain)
    return plain

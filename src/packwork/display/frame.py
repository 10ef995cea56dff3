"""A layout as a data frame: one row per item."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from packwork.display.extras import found
from packwork.readers.charts.columns import as_number, is_missing
from packwork.scene.layout import Layout
from packwork.scene.swatch import representative_colour

TAKEN = "mark_"
"""What our columns begin with where a table has one of that name."""

_CODE = re.compile(r"\s*[-+]?0\d")
"""Numbers that no number begins with: codes such as 0042."""


def data_frame(layout: Layout) -> Any:
    """Pandas data frame of a layout, one row per item.

    Raises
    ------
    PackworkError
        If pandas is not installed.
    """
    pandas = found("pandas", "save the layout as .geojson")
    table = _table(layout)
    ours = _ours(layout)
    named = {TAKEN + name if name in table else name: cells for name, cells in ours.items()}
    return pandas.DataFrame(table | named)


def _table(layout: Layout) -> dict[str, list[Any]]:
    """Columns of a chart's table, a cell for each mark."""
    rows = [{} if item.datum is None else item.datum.row for item in layout.items]
    names = dict.fromkeys(name for row in rows for name in row)
    return {name: _cells([row.get(name) for row in rows]) for name in names}


def _cells(cells: Sequence[Any]) -> list[Any]:
    """Cells of a column: texts as numbers if all are some, nothing for what is missing.

    Examples
    --------
    >>> _cells(["1", "2.5", ""]), _cells(["01", "2"]), _cells(["a", "NA"])
    ([1, 2.5, None], ['01', '2'], ['a', None])
    """
    held = [None if is_missing(cell) else cell for cell in cells]
    texts = [cell for cell in held if isinstance(cell, str)]
    if any(_CODE.match(text) or np.isnan(as_number(text)) for text in texts):
        return held
    return [_number(cell) if isinstance(cell, str) else cell for cell in held]


def _number(text: str) -> float:
    try:
        return int(text)
    except ValueError:
        return float(text)


def _ours(layout: Layout) -> dict[str, Any]:
    """What we know of each item, by the name of its column."""
    poses, data = layout.poses, [item.datum for item in layout.items]
    said: dict[str, Any] = {}
    if any(data):
        said["value"] = [None if datum is None else datum.value for datum in data]
        for key in ("category", "group"):
            if any(datum is not None and getattr(datum, key) for datum in data):
                said[key] = [datum and (getattr(datum, key) or None) for datum in data]
    colours = {id(item.art): representative_colour(item) for item in layout.items}
    return said | {
        "item": [item.name for item in layout.items],
        "source": [item.source for item in layout.items],
        "x": poses.x,
        "y": poses.y,
        "angle_deg": np.degrees(poses.angle),
        "scale": poses.scale,
        "stretch": poses.stretch,
        "area": layout.areas,
        "weight": layout.weights,
        "color": [colours[id(item.art)] for item in layout.items],
    }

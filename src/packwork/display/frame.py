"""A layout as a data frame: one row per item."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from packwork.display.extras import found
from packwork.readers.tables.cells import as_number, is_missing
from packwork.scene.layout import Layout
from packwork.scene.swatch import representative_colour

TAKEN = "mark_"
"""What our columns begin with where a table has one of that name."""

_UNNAMED = re.compile(r"index|level_\d+")
"""What pandas calls columns of an index that has no name."""

_CODE = re.compile(r"\s*[-+]?0\d")
"""Numbers that no number begins with: codes such as 0042."""


def data_frame(layout: Layout) -> Any:
    """Pandas data frame of a layout, one row per item.

    Raises ``PackworkError`` if pandas is not installed.
    """
    pandas = found("pandas", "save the layout as .geojson")
    table = _table(layout)
    ours = _ours(layout)
    named = {TAKEN + name if name in table else name: cells for name, cells in ours.items()}
    frame = pandas.DataFrame(table | named)
    return _indexed(frame, layout, pandas) if table else _labelled(frame, layout, pandas)


def _labelled(frame: Any, layout: Layout, pandas: Any) -> Any:
    """The frame with the labels that items had as rows of another one, if they had some."""
    rows = [item.row for item in layout.items]
    names = next((row.names for row in rows if row is not None), None)
    if names is None:
        return frame
    if len(names) == 1:
        labels = [None if row is None else row.label for row in rows]
        return frame.set_index(pandas.Index(labels, name=names[0]))
    nothing = (None,) * len(names)
    several = [nothing if row is None else row.label for row in rows]
    return frame.set_index(pandas.MultiIndex.from_tuples(several, names=names))


def _indexed(frame: Any, layout: Layout, pandas: Any) -> Any:
    """The frame with the index that a chart's table had, if it was a data frame with one."""
    chart = layout.manifest.get("recipe", {}).get("chart") or {}
    types = {name: kind for name, kind in chart.get("index", {}).items() if name in frame}
    if not types:
        return frame
    # As they were read: an index of texts such as 1 stays one of texts.
    cells = {
        name: [item.datum and item.datum.row.get(name) for item in layout.items] for name in types
    }
    levels = [_level(pandas, cells[name], kind) for name, kind in types.items()]
    names = [None if _UNNAMED.fullmatch(name) else name for name in types]
    made = pandas.MultiIndex.from_arrays(levels) if len(levels) > 1 else levels[0]
    return frame.drop(columns=list(types)).set_index(made.set_names(names))


def _level(pandas: Any, cells: Sequence[Any], kind: str) -> Any:
    """One level of an index, of the type that it had where that is known here."""
    plain = pandas.Index(cells)
    try:
        return plain.astype(kind)
    except (TypeError, ValueError):
        return plain


def _table(layout: Layout) -> dict[str, list[Any]]:
    """Columns of a chart's table, a cell for each mark."""
    rows = [{} if item.datum is None else item.datum.row for item in layout.items]
    names = dict.fromkeys(name for row in rows for name in row)
    return {name: _cells([row.get(name) for row in rows]) for name in names}


def _cells(cells: Sequence[Any]) -> list[Any]:
    """Cells of a column: texts as numbers if all are some, nothing for what is missing.

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
    """Our data of each item, by the name of its column."""
    poses, data = layout.poses, [item.datum for item in layout.items]
    said: dict[str, Any] = {}
    if any(data):
        said["value"] = [None if datum is None else datum.value for datum in data]
        for key in ("category", "group"):
            if any(datum is not None and getattr(datum, key) for datum in data):
                said[key] = [datum and (getattr(datum, key) or None) for datum in data]
    colours = {item.art: representative_colour(item) for item in layout.items}
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
        "color": [colours[item.art] for item in layout.items],
    }

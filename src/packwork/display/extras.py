"""A layout in packages that are extras: a data frame of pandas, patches on Matplotlib's axes.

Such packages are imported when used, and named when missing.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from packwork.errors import PackworkError
from packwork.geometry.outline import Outline
from packwork.installed import command_to_install
from packwork.readers.tables.cells import as_number, is_missing, is_numeric, is_time
from packwork.scene.layout import Layout
from packwork.scene.swatch import representative_colour


def import_extra(module: str, otherwise: str) -> Any:
    """Module that is an extra of ours.

    ``otherwise``: what does without it.

    Raises ``PackworkError`` if it is not installed, saying what to install.

    >>> import_extra("no_such_package", "save a picture")
    Traceback (most recent call last):
        ...
    packwork.errors.PackworkError: this needs no_such_package, which is not installed; install it:
    pip install no_such_package, or save a picture
    """
    package = module.partition(".")[0]
    try:
        importlib.import_module(package)
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise PackworkError(
            f"this needs {package}, which is not installed; install it: "
            f"{command_to_install([package])}, or {otherwise}"
        ) from None


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
    pandas = import_extra("pandas", "save the layout as .geojson")
    table = _table(layout)
    ours = _ours(layout)
    named = {TAKEN + name if name in table else name: cells for name, cells in ours.items()}
    frame = pandas.DataFrame(table | named)
    return _indexed(frame, layout, pandas) if table else _labelled(frame, layout, pandas)


def geo_data_frame(layout: Layout) -> Any:
    """The same with the items' outlines in place, as a frame of GeoPandas.

    Raises ``PackworkError`` if GeoPandas is not installed.
    """
    geopandas = import_extra("geopandas", "save the layout as .geojson")
    outlines = [outline.region for outline in layout.outlines]
    return geopandas.GeoDataFrame(data_frame(layout), geometry=outlines)


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
    if any(_CODE.match(text) or is_time(text) or np.isnan(as_number(text)) for text in texts):
        return held
    return [_number(cell) if isinstance(cell, str) else cell for cell in held]


def _number(text: str) -> float:
    try:
        return int(text)
    except ValueError:
        return as_number(text)


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


INSTEAD = "save a picture"


def draw_on_axes(layout: Layout, ax: Any, asked: Mapping[str, Any]) -> Any:
    """Axes with a patch for each item, in canvas units, y down, as ``asked`` of all patches.

    Raises ``PackworkError`` if Matplotlib is not installed.
    """
    patches = import_extra("matplotlib.patches", INSTEAD)
    if ax is None:
        _, ax = import_extra("matplotlib.pyplot", INSTEAD).subplots(layout="constrained")
        ax.axis("off")
    colours = {item.art: representative_colour(item) for item in layout.items}
    chosen = import_extra("matplotlib.cbook", INSTEAD).normalize_kwargs(asked, patches.Patch)
    told: set[str] = set()
    for item, ink in zip(layout.items, layout.inks, strict=True):
        category = "" if item.datum is None else item.datum.category
        # What begins with a line is no key to Matplotlib, which is right for all but the first.
        label = "_" + item.name if category in told or not category else category
        told.add(category)
        own = {} if "color" in chosen else {"facecolor": colours[item.art], "edgecolor": "none"}
        ax.add_patch(patches.PathPatch(_path(ink), **({"label": label} | own | chosen)))
    ax.set_xlim(0.0, layout.container.width)
    ax.set_ylim(layout.container.height, 0.0)
    ax.set_aspect("equal")
    chart = layout.manifest.get("recipe", {}).get("chart") or {}
    if chart.get("title"):
        ax.set_title(chart["title"])
    if any(told) and chart.get("legend", True):
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    if chart.get("color_by") and chart.get("legend", True):
        _draw_colour_bar(layout, ax, chart["color_by"], colours)
    return ax


def _draw_colour_bar(layout: Layout, ax: Any, column: str, colours: Mapping[Any, str]) -> None:
    """Numbers that colours stand for beside the axes, if the column holds numbers that differ."""
    shown = [(item.datum.row, colours[item.art]) for item in layout.items if item.datum]
    if not is_numeric([row for row, _ in shown], column):
        return
    cells = [(row.get(column), ink) for row, ink in shown]
    colour_of = {as_number(cell): ink for cell, ink in cells if not is_missing(cell)}
    low, high = min(colour_of, default=0.0), max(colour_of, default=0.0)
    if low == high:
        return
    # Straight between the marks' own colours: a ramp that any palette may have made.
    stops = [((number - low) / (high - low), colour_of[number]) for number in sorted(colour_of)]
    ramp = import_extra("matplotlib.colors", INSTEAD).LinearSegmentedColormap.from_list("", stops)
    span = import_extra("matplotlib.colors", INSTEAD).Normalize(low, high)
    shades = import_extra("matplotlib.cm", INSTEAD).ScalarMappable(span, ramp)
    ax.figure.colorbar(shades, ax=ax, label=column, shrink=0.6)


def _path(outline: Outline) -> Any:
    """All rings as one path: holes run the other way, so they stay free."""
    path = import_extra("matplotlib.path", INSTEAD).Path
    rings = [np.vstack([ring, ring[:1]]) for ring in outline.rings]
    codes = np.full(sum(map(len, rings)), path.LINETO, dtype=path.code_type)
    begins = np.cumsum([0, *map(len, rings)])
    codes[begins[:-1]] = path.MOVETO
    codes[begins[1:] - 1] = path.CLOSEPOLY
    return path(np.vstack(rings), codes)

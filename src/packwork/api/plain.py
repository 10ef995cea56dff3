"""Values of Python, NumPy, pandas and Matplotlib as the plain ones that a recipe holds."""

from __future__ import annotations

import contextlib
import importlib
import math
from collections.abc import Iterable, Mapping, Sequence
from numbers import Real
from typing import Any, Protocol, TypeAlias

import numpy as np

from packwork.errors import RecipeError
from packwork.readers import items as item_reader
from packwork.readers.tables.table import collected, is_count
from packwork.recipe.typed import Anchor, Force, Hero
from packwork.scene.colour import hex_colour
from packwork.scene.palette import colours_by_name, palette_colours

Colour: TypeAlias = str | Sequence[float]
"""A name, ``#rrggbb``, or red, green and blue from 0 to 1, with or without opacity."""


class Colormap(Protocol):
    """One of Matplotlib's."""

    N: int

    def __call__(self, X: Any) -> Any:  # noqa: N803
        """Colours of numbers."""


Colours: TypeAlias = Colour | Mapping[str, Colour] | Iterable[Colour] | Colormap
"""A palette: its name, its colours, by category or not, or a colormap."""

Cells: TypeAlias = str | Iterable[Any]
"""A column by its name, or what stands in it."""

RAMP = 16
"""Colours of a palette that is made of a continuous colormap. More follow it closer, and are less
unlike each other. Chosen."""

QUALITATIVE = 32
"""Colours of a colormap at most, all of which are the palette. Chosen: tab20 has the most."""


def plain_texts(value: Any) -> Any:
    """A hero, a force, an anchor, or several, as a command line has them; texts as they are.

    Examples
    --------
    >>> plain_texts([Force("down", strength=2), "left"]), plain_texts(Hero("owl"))
    (['down strength=2', 'left'], 'owl')
    """
    if isinstance(value, list | tuple):
        return [plain_texts(one) for one in value]
    return str(value) if isinstance(value, Hero | Force | Anchor) else value


def plain_seed(seed: Any) -> Any:
    """A whole number: drawn from a source of random bits of NumPy, or, of None, from the system.

    Examples
    --------
    >>> plain_seed(np.random.default_rng(1)) == plain_seed(np.random.default_rng(1)), plain_seed(3)
    (True, 3)
    """
    drawn = (np.random.Generator, np.random.BitGenerator, np.random.SeedSequence)
    if seed is None or isinstance(seed, drawn):
        return int(np.random.default_rng(seed).integers(2**32))
    return seed


def plain_colours(value: Any) -> Any:
    """Colours as texts: of a colormap or its name, of RGB tuples, of a dict by category.

    What is none is given back, for the option to refuse.

    Examples
    --------
    >>> plain_colours([(1, 0, 0), "teal"]), plain_colours({"a": (0, 0.5, 1)}), plain_colours("ink")
    (['#ff0000', 'teal'], {'a': '#0080ff'}, 'ink')
    """
    if isinstance(value, str):
        return _known(value)
    if isinstance(value, Mapping):
        return {str(name): plain_colour(colour) for name, colour in value.items()}
    if callable(value) and hasattr(value, "N"):
        steps = np.arange(value.N) if value.N <= QUALITATIVE else np.linspace(0.0, 1.0, RAMP)
        return [plain_colour(colour) for colour in value(steps)]
    if not isinstance(value, Iterable):
        return value
    several = list(value)
    if several and all(isinstance(one, Real) for one in several):
        return [plain_colour(several)]
    return [plain_colour(one) for one in several]


def plain_colour(value: Any) -> Any:
    """A colour as a text: ``#rrggbb`` of three or four numbers from 0 to 1, texts as they are."""
    if isinstance(value, str):
        known = _known(value)
        return known if isinstance(known, str) else value
    try:
        channels = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return value
    if channels.shape not in {(3,), (4,)} or not ((channels >= 0) & (channels <= 1)).all():
        raise RecipeError("palette", f"colours have 3 or 4 numbers from 0 to 1, not {value!r:.60}")
    levels = tuple(round(255 * float(one)) for one in channels)
    return hex_colour(levels) + (f"{levels[3]:02x}" if len(levels) == 4 and levels[3] < 255 else "")


def _known(text: str) -> Any:
    """Colours of a name of Matplotlib's or seaborn's that we have not, if these are there."""
    with contextlib.suppress(ValueError):
        if colours_by_name(text) is not None or palette_colours(text):
            return text
    with contextlib.suppress(ImportError):
        import matplotlib

        if text in matplotlib.colormaps:
            return plain_colours(matplotlib.colormaps[text])
        from matplotlib.colors import is_color_like, to_rgba

        if is_color_like(text) and text != "none":
            return plain_colour(to_rgba(text))
        with contextlib.suppress(Exception):  # whatever seaborn meets in a name that it parses
            seaborn: Any = importlib.import_module("seaborn")
            if text in matplotlib.colormaps:  # which seaborn adds to
                return plain_colours(matplotlib.colormaps[text])
            return plain_colours(seaborn.color_palette(text))
    return text


def plain_weights(weights: Any, names: Sequence[str]) -> Any:
    """Shares of area by name: of a Series by its index, of numbers in the order of the items."""
    if hasattr(weights, "index") and hasattr(weights, "to_dict") and np.ndim(weights) == 1:
        if not is_count(weights.index):
            return {str(name): weight for name, weight in weights.to_dict().items()}
    elif weights is None or isinstance(weights, str | Mapping) or hasattr(weights, "__fspath__"):
        return weights
    try:
        numbers = np.asarray(weights, dtype=float).tolist()
    except (TypeError, ValueError):
        numbers = [math.nan]
    if not np.isfinite(numbers).all():
        raise RecipeError("weights", f"takes numbers, not {' '.join(repr(weights).split()):.60}")
    items = [item.name for item in item_reader.read_items(list(names)).items]
    if np.shape(numbers) != (len(items),) or len(set(items)) < len(items):
        raise RecipeError(
            "weights",
            f"takes a number for each of {len(items)} items of unlike names, or a dict by name",
        )
    return dict(zip(items, numbers, strict=True))


def with_columns(data: Any, options: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
    """A chart's table with the columns that options give as numbers or texts, named in the options.

    A Series is a table of one column, which sizes come from.

    Examples
    --------
    >>> with_columns({"fig": ["a", "b"]}, {"size_by": [3, 1], "seed": 2})
    ({'fig': ['a', 'b'], 'size': [3, 1]}, {'size_by': 'size', 'seed': 2})
    """
    asked, data = dict(options), collected(data)
    if hasattr(data, "to_frame") and not hasattr(data, "columns"):
        name = "value" if data.name is None else str(data.name)
        data, asked = data.to_frame(name), {"size_by": name} | asked
    for key, cells in options.items():
        if key.split("_")[-1] != "by" or isinstance(cells, str | None) or callable(cells):
            continue
        names = getattr(data, "columns", ())
        if not hasattr(cells, "__iter__") or (isinstance(cells, tuple) and cells in names):
            asked[key] = str(cells)  # a column that is called by a number, or on several levels
            continue
        if hasattr(data, "to_pydict"):  # of pyarrow
            data = data.to_pydict()
        elif hasattr(data, "to_dicts"):  # of polars
            data = data.to_dict(as_series=False)
        is_table = isinstance(data, Sequence) and not isinstance(data, str)
        if not (is_table or isinstance(data, Mapping) or hasattr(data, "assign")):
            raise RecipeError(key, "must be a column's name where the data are a file's")
        there = set(data[0] if is_table and len(data) else data)
        rows = len(next(iter(data.values()), ())) if isinstance(data, Mapping) else len(data)
        if len(cells) != rows:
            raise RecipeError(key, f"has {len(cells)} cells for {rows} rows")
        name = str(getattr(cells, "name", None) or key.removesuffix("_by"))
        while name in there:  # another option may ask for the column that is called so
            name += "_"
        asked[key] = name
        if is_table:
            data = [{**row, name: cell} for row, cell in zip(data, cells, strict=True)]
        else:
            data = (
                data.assign(**{name: cells})
                if hasattr(data, "assign")
                else {**data, name: list(cells)}
            )
    return data, asked


def weighed(items: list[str], asked: Mapping[str, Any]) -> dict[str, Any]:
    """Items and options, in which weights are by name."""
    if "weights" not in asked:
        return {**asked, "items": items}
    return {**asked, "items": items, "weights": plain_weights(asked["weights"], items)}


def without_none(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options that are set, in tables too: a manifest lists all."""
    return {
        key: without_none(value) if isinstance(value, Mapping) else value
        for key, value in options.items()
        if value is not None
    }

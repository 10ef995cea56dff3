"""The Python face: the verbs of the command line, on plain values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal, Unpack

from packwork import uses
from packwork.api.frozen import ReadOnly
from packwork.api.handing import handed_over, with_names
from packwork.api.history import keeper
from packwork.api.keywords import ChartKeywords, FillKeywords, PileKeywords, WordsKeywords
from packwork.api.layout import Layout, public
from packwork.api.signatures import of_verb
from packwork.display.bar import bar_for, shown
from packwork.errors import RecipeError
from packwork.offers import Verbs
from packwork.options import offered
from packwork.progress import NOBODY, Listener, Stop, as_observer, never, together
from packwork.readers import items as item_reader
from packwork.readers.container import read_container as _read_container
from packwork.readers.memory.shapes import Columns
from packwork.readers.memory.values import Value
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.reading import ReadingOptions
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.writers.options import DrawingOptions

(BACKGROUND,) = (option for option in offered(DrawingOptions) if option.name == "background")
"""Colours of words and charts are made to be read on it."""


@of_verb(Verbs.FILL)
def fill(
    container: Value,
    items: Value | Iterable[Value] = "builtin:icons",
    *,
    y_up: bool | None = None,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Unpack[FillKeywords],
) -> Layout:
    """Fill a container with items.

    Parameters
    ----------
    container
        A mask (PNG, JPEG), an SVG, ``"text:HELLO"``, ``"around:IMAGE"``, a built-in name such
        as ``"heart"``, or a :class:`Container`. Also what is in memory: an array (of bools,
        shares or zeros and ones True, or 1, is inside; of whole numbers to 255 dark is), a
        picture, bytes or an open file of one, the text of an SVG, a Shapely geometry, GeoJSON, a
        frame of geometries.
    items
        SVGs, pictures, folders, built-in names, values in memory as for the container, or what
        :func:`read_items` returned; one, several, or a dict by name. Each row of a frame is one
        item, its name and its weight from the columns that are called so.
    y_up
        Whether the y of geometries points up; None: where a frame says its reference system.
    observer
        Told of progress: a function of a :class:`Step`, called every ten epochs, or an object with
        ``every`` and ``on_step``.
    stop
        Asked before every epoch; True ends the run with what it has.
    progress
        True shows a bar, False none; None one in a notebook only.
    record
        Keep the way of the items, for :meth:`Layout.save_film`.
    history
        Keep losses by epoch, in ``layout.history``: of each, or of every so many (``10``). Reading
        them takes longer than the epochs themselves.
    options
        As on the command line, by the names in the signature; and ``rules`` about single
        items, tables as in a recipe file: ``[{"items": "star", "count": 3}]``.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> layout = fill("circle", ["star"], count=3, effort="draft", levels="50", seed=1)
    >>> layout.manifest["seed"]
    1
    """
    with handed_over(y_up) as handed:
        recipe = make_recipe(
            container=handed.name_of(container, "container"),
            items=handed.names_of(items, "items"),
            **with_names(options, handed),
        )
        return run_recipe(recipe, container, observer, stop, progress, record, history)


@of_verb(Verbs.WORDS, BACKGROUND)
def words(
    container: Value,
    source: str | Path | Mapping[str, float] | Any,
    *,
    add: Value | Iterable[Value] = (),
    y_up: bool | None = None,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Unpack[WordsKeywords],
) -> Layout:
    """Fill a container with words.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    source
        A text or the file that holds it, a table ``word,weight`` (.csv, .tsv, .json), or
        weights by word: a dict, a ``Counter``, a pandas Series.
    add
        Items that are placed among the words: files, folders or built-in names.
    options
        As on the command line, by the names in the signature. ``color_by`` may be a function
        of a word; a ``background`` is to be given to ``save`` too.

    Raises
    ------
    ReadError
        If a file or a font cannot be used, or no word is left.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> layout = words("heart", {"bear": 3, "fox": 2, "owl": 1}, effort="draft", levels="50")
    >>> [item.name for item in layout.items]
    ['bear', 'fox', 'owl']
    >>> heights = layout.poses.scale / layout.poses.scale[-1]
    >>> heights.round(6).tolist()
    [3.0, 2.0, 1.0]
    """
    with handed_over(y_up) as handed:
        recipe = uses.words_recipe(
            handed.name_of(container, "container"),
            source,
            add=handed.names_of(add, "add"),
            **with_names(options, handed),
        )
        return run_recipe(recipe, container, observer, stop, progress, record, history)


@of_verb(Verbs.PILE)
def pile(
    container: Value,
    items: Value | Iterable[Value] = "builtin:icons",
    *,
    y_up: bool | None = None,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Unpack[PileKeywords],
) -> Layout:
    """Heap items of given sizes, under forces, until they are at rest.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    container
        As for :func:`fill`; an SVG of open paths is open where they are, and ``"none"``
        lets items lie anywhere.
    options
        As on the command line, by the names in the signature.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning, or no item fits.

    Examples
    --------
    >>> layout = pile("square", "circle", count=3, size="30%", seed=1)
    >>> layout.metrics["exact"]["OO"], bool(layout.poses.y.mean() > 400)
    (0.0, True)
    """
    with handed_over(y_up) as handed:
        recipe = uses.pile_recipe(
            handed.name_of(container, "container"),
            handed.names_of(items, "items"),
            **with_names(options, handed),
        )
        return run_recipe(recipe, container, observer, stop, progress, record, history)


@of_verb(Verbs.CHART, BACKGROUND)
def chart(
    container: Value,
    data: Any,
    *,
    y_up: bool | None = None,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Unpack[ChartKeywords],
) -> Layout:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    container
        As for :func:`fill`; ``"none"`` shows the groups of ``by`` as bars.
    data
        A table (.csv, .tsv, .json, with pandas .parquet), a data frame, rows as dicts, or a
        dict of columns.
    options
        As on the command line, by the names in the signature; a ``background`` is to be given
        to ``save`` too.

    Raises
    ------
    ReadError, RecipeError
        If a file, a column or an option cannot be used.

    Examples
    --------
    >>> layout = chart("heart", {"kg": [4, 1]}, size_by="kg", effort="draft", levels="50")
    >>> round(float(layout.areas[0] / layout.areas[1]), 6)
    4.0
    """
    with handed_over(y_up) as handed:
        named = with_names(options, handed)
        recipe = uses.chart_recipe(handed.name_of(container, "container"), data, **named)
        return run_recipe(recipe, container, observer, stop, progress, record, history)


def read_items(
    sources: Value | Iterable[Value],
    *,
    name_by: str | None = None,
    weight_by: str | None = None,
    y_up: bool | None = None,
    holes: Literal["fill", "keep"] = "fill",
    strict: bool = False,
    keep_page: bool | None = None,
    alpha_threshold: float = 0.5,
) -> list[Item]:
    """Items from SVGs, pictures, folders of them, globs, built-in names or values in memory.

    Parameters that :func:`fill` has too mean the same here.

    Unusable files in a folder are left out with a warning in the log.

    Parameters
    ----------
    sources
        One or several, or a dict of them by name; values in memory as for :func:`fill`.
    name_by, weight_by
        Columns of a frame, or properties of GeoJSON, that say what each item is called and what
        share of area it asks for. None: those called name and weight, where there are such.
    holes
        ``"keep"`` lets small items sit in the holes of large ones.
    strict
        Refuse a folder with an unusable file.

    Raises
    ------
    ReadError
        If a file that is named cannot be used, or nothing usable is found.

    Examples
    --------
    >>> [item.name for item in read_items(["circle", "star"])]
    ['circle', 'star']
    >>> import shapely
    >>> lake = {"type": "Feature", "properties": {"lake": "Como", "km2": 146}}
    >>> (item,) = read_items(
    ...     {**lake, "geometry": shapely.box(0, 0, 4, 1)}, name_by="lake", weight_by="km2"
    ... )
    >>> item.name, item.weight, item.outline.bounds
    ('Como', 146.0, (-2.0, -0.5, 2.0, 0.5))
    """
    asked = {"keep_page": keep_page, "alpha_threshold": alpha_threshold}
    how = validated(ReadingOptions, asked).read_options
    with handed_over(y_up, Columns(name_by, weight_by)) as handed:
        named = handed.names_of(sources, "sources")
        return list(item_reader.read_items(named, holes=holes, strict=strict, reading=how).items)


def read_container(
    source: Value,
    *,
    canvas: str | float | None = None,
    font: str | Path | None = None,
    y_up: bool | None = None,
    trim: bool | None = None,
    close_gaps: str = "auto",
    alpha_threshold: float = 0.5,
) -> Container:
    """Container from a mask, an SVG, ``text:WORD``, a built-in name or a value in memory.

    ``source`` is what :func:`fill` takes as ``container``; what both take means the same.

    Parameters
    ----------
    canvas
        Its longer side (``600``, ``"200mm"``, ``"8in"``) or a sheet (``"200x150mm"``,
        ``"A4"``). None: an SVG in mm, cm, in or pt keeps its size, any other is 600 px.
    font
        Font file or installed family for ``text:WORD``; the bundled one if None.

    Raises
    ------
    ReadError
        If it cannot be used.
    RecipeError
        If the canvas has no meaning.

    Examples
    --------
    >>> read_container("circle").width
    600.0
    >>> import shapely
    >>> tile = read_container(shapely.box(7.1, 46.2, 7.5, 46.4), canvas="200mm", y_up=True)
    >>> round(tile.width), round(tile.height), tile.unit
    (200, 100, 'mm')
    """
    asked = {"trim": trim, "close_gaps": close_gaps, "alpha_threshold": alpha_threshold}
    how = validated(ReadingOptions, asked).read_options
    with handed_over(y_up) as handed:
        name = handed.name_of(source, "container")
        return _read_container(name, canvas, font, reading=how)


def run_recipe(
    recipe: Recipe,
    container: Value,
    observer: Listener | None,
    stop: Stop,
    progress: bool | None,
    record: bool,
    history: bool | int = False,
) -> Layout:
    """Run a recipe, with a bar if one is to be shown; a container that was given is used as is."""
    kept = keeper(history)
    heard = NOBODY if observer is None else as_observer(observer)
    if not callable(stop):
        raise RecipeError("stop", f"must be a function that says whether to stop, not {stop!r}")
    bar = bar_for(progress, None if observer is None else heard)
    whole = container if isinstance(container, Container) else None
    with shown(bar):
        told = together(bar or heard, kept or NOBODY)
        run = uses.fill(recipe, None, whole, told, stop, record)
    layout = public(run.layout)
    # What was just measured is not measured again when it is asked for.
    layout.__dict__["metrics"] = ReadOnly(run.metrics.as_dict())
    layout.__dict__["history"] = None if kept is None else kept.history()
    return layout

"""The Python face: the verbs of the command line, on plain values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from packwork import uses
from packwork.api.layout import Layout, public
from packwork.api.signatures import of_verb
from packwork.display.bar import bar_for, shown
from packwork.offers import Verbs
from packwork.options import offered
from packwork.progress import Observer, Stop, never
from packwork.readers import items as item_reader
from packwork.readers.container import read_container as _read_container
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.reading import Interpreted
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.writers.options import DrawingOptions

(BACKGROUND,) = (option for option in offered(DrawingOptions) if option.name == "background")
"""Colours of words and charts are made to be read on it."""


@of_verb(Verbs.FILL)
def fill(
    container: str | Path | Container,
    items: str | Path | Item | Sequence[str | Path | Item] = "builtin:icons",
    *,
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    **options: Any,
) -> Layout:
    """Fill a container with items.

    Parameters
    ----------
    container
        A mask (PNG, JPEG), an SVG, ``"text:HELLO"``, ``"around:IMAGE"``, a built-in name such
        as ``"heart"``, or a :class:`Container`.
    items
        SVGs, pictures, folders, built-in names, or what :func:`read_items` returned.
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run with what it has.
    progress
        True shows a bar, False none; None one in a notebook only.
    record
        Keep the way of the items, for :meth:`Layout.save_film`.
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
    given = [items] if isinstance(items, str | Path | Item) else list(items)
    whole = container if isinstance(container, Container) else None
    recipe = make_recipe(
        container=whole.source if whole else str(container),
        items=[entry.source if isinstance(entry, Item) else str(entry) for entry in given],
        **options,
    )
    return _run(recipe, _as_items(given, recipe), whole, observer, stop, progress, record)


@of_verb(Verbs.WORDS, BACKGROUND)
def words(
    container: str | Path | Container,
    source: str | Path | Mapping[str, float] | Any,
    *,
    add: str | Path | Sequence[str | Path] = (),
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    **options: Any,
) -> Layout:
    """Fill a container with words.

    Parameters
    ----------
    container
        As for :func:`fill`.
    source
        A text or the file that holds it, a table ``word,weight`` (.csv, .tsv, .json), or
        weights by word: a dict, a ``Counter``, a pandas Series.
    add
        Items that are placed among the words: files, folders or built-in names.
    observer, stop, progress, record
        As for :func:`fill`.
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
    whole = container if isinstance(container, Container) else None
    mixed_in = [add] if isinstance(add, str | Path) else add
    recipe = uses.words_recipe(
        whole.source if whole else str(container),
        source,
        add=[str(item) for item in mixed_in],
        **options,
    )
    return _run(recipe, None, whole, observer, stop, progress, record)


@of_verb(Verbs.PILE)
def pile(
    container: str | Path | Container,
    items: str | Path | Item | Sequence[str | Path | Item] = "builtin:icons",
    *,
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    **options: Any,
) -> Layout:
    """Heap items of given sizes, under forces, until they are at rest.

    Parameters
    ----------
    container
        As for :func:`fill`; an SVG of open paths is open where they are, and ``"none"``
        lets items lie anywhere.
    items, observer, stop, progress, record
        As for :func:`fill`.
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
    given = [items] if isinstance(items, str | Path | Item) else list(items)
    whole = container if isinstance(container, Container) else None
    recipe = uses.pile_recipe(
        whole.source if whole else str(container),
        [entry.source if isinstance(entry, Item) else str(entry) for entry in given],
        **options,
    )
    return _run(recipe, _as_items(given, recipe), whole, observer, stop, progress, record)


@of_verb(Verbs.CHART, BACKGROUND)
def chart(
    container: str | Path | Container,
    data: Any,
    *,
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    **options: Any,
) -> Layout:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    Parameters
    ----------
    container
        As for :func:`fill`; ``"none"`` shows the groups of ``by`` as bars.
    observer, stop, progress, record
        As for :func:`fill`.
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
    whole = container if isinstance(container, Container) else None
    recipe = uses.chart_recipe(whole.source if whole else str(container), data, **options)
    return _run(recipe, None, whole, observer, stop, progress, record)


def read_items(
    sources: str | Path | Sequence[str | Path],
    *,
    holes: Literal["fill", "keep"] = "fill",
    strict: bool = False,
    keep_page: bool | None = None,
    alpha_threshold: float = 0.5,
) -> list[Item]:
    """Items from SVGs, pictures, folders of them, globs or built-in names.

    Unusable files in a folder are left out with a warning in the log.

    Parameters
    ----------
    sources
        One or several.
    holes
        ``"keep"`` lets small items sit in the holes of large ones.
    strict
        Refuse a folder with an unusable file.
    keep_page, alpha_threshold
        As for :func:`fill`.

    Raises
    ------
    ReadError
        If a file that is named cannot be used, or nothing usable is found.

    Examples
    --------
    >>> [item.name for item in read_items(["circle", "star"])]
    ['circle', 'star']
    """
    several = [sources] if isinstance(sources, str | Path) else list(sources)
    asked = {"keep_page": keep_page, "alpha_threshold": alpha_threshold}
    how = validated(Interpreted, asked).read_options
    return list(item_reader.read_items(several, holes=holes, strict=strict, reading=how).items)


def read_container(
    source: str | Path,
    *,
    canvas: str | float | None = None,
    font: str | Path | None = None,
    trim: bool | None = None,
    close_gaps: str = "auto",
    alpha_threshold: float = 0.5,
) -> Container:
    """Container from a mask, an SVG, ``text:WORD`` or a built-in name.

    Parameters
    ----------
    source
        As for :func:`fill`.
    canvas
        Its longer side (``600``, ``"200mm"``, ``"8in"``) or a sheet (``"200x150mm"``,
        ``"A4"``). None: an SVG in mm, cm, in or pt keeps its size, any other is 600 px.
    font
        Font file or installed family for ``text:WORD``; the bundled one if None.
    trim, close_gaps, alpha_threshold
        As for :func:`fill`.

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
    """
    asked = {"trim": trim, "close_gaps": close_gaps, "alpha_threshold": alpha_threshold}
    how = validated(Interpreted, asked).read_options
    return _read_container(str(source), canvas, font, reading=how)


def _run(
    recipe: Recipe,
    items: list[Item] | None,
    container: Container | None,
    observer: Observer | None,
    stop: Stop,
    progress: bool | None,
    record: bool,
) -> Layout:
    bar = bar_for(progress, observer)
    with shown(bar):
        run = uses.fill(recipe, items, container, bar or observer, stop, record)
    layout = public(run.layout)
    # What was just measured is not measured again when it is asked for.
    layout.__dict__["metrics"] = run.metrics.as_dict()
    return layout


def _as_items(given: Sequence[str | Path | Item], recipe: Recipe) -> list[Item] | None:
    """Items where some are given as such; None if all are names for the recipe."""
    if not any(isinstance(entry, Item) for entry in given):
        return None
    chosen: list[Item] = []
    for entry in given:
        if isinstance(entry, Item):
            chosen.append(entry)
        else:
            chosen += read_items(
                entry, holes=recipe.holes, strict=recipe.strict, keep_page=recipe.keep_page,
                alpha_threshold=recipe.alpha_threshold,
            )  # fmt: skip
    return chosen

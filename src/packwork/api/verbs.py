"""The Python face: the verbs of the command line, on plain values."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, Unpack

from packwork import uses
from packwork.api.history import keeper
from packwork.api.inputs import handed_over, with_names
from packwork.api.keywords import (
    ChartRun,
    FillRun,
    PhotosRun,
    PileRun,
    WordsRun,
)
from packwork.api.layout import Layout, public
from packwork.api.parts import measures
from packwork.api.plain import weighed, with_columns, without_none
from packwork.api.signatures import BACKGROUND, RunKeywords, of_verb
from packwork.batches.pool import results
from packwork.batches.seeds import best_first
from packwork.batches.task import telling_once
from packwork.display.bar import bar_for, shown
from packwork.errors import RecipeError
from packwork.options import Verbs
from packwork.pipeline import Run
from packwork.pipeline.read import safe_area
from packwork.progress import NOBODY, Listener, Stop, as_observer, never, together
from packwork.readers.layouts.read import is_session
from packwork.readers.memory.values import Handed, Value
from packwork.readers.recipe import read_recipe
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container, on_canvas
from packwork.uses.overriding import overridden
from packwork.uses.photos.recipe import photos_recipe


@of_verb(Verbs.FILL)
def fill(
    container: Value,
    items: Value | Iterable[Value] = "builtin:icons",
    **options: Unpack[FillRun],
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
    best_of, best_by
        Try so many seeds, from ``seed`` on, and keep the best: by ``"coverage"``, ``"evenness"`` or
        a metric of the report, with a minus where less is better.
    options
        Those below; and ``rules`` about single items, tables as in a recipe file:
        ``[{"items": "star", "count": 3}]``.

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
    return _run(
        container,
        options,
        lambda name, handed, asked: make_recipe(
            container=name, **weighed(handed.names_of(items, "items"), asked)
        ),
    )


@of_verb(Verbs.WORDS, BACKGROUND)
def words(
    container: Value,
    source: str | Path | Mapping[str, float] | Any,
    *,
    add: Value | Iterable[Value] = (),
    **options: Unpack[WordsRun],
) -> Layout:
    """Fill a container with words.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    source
        A text or the file that holds it, a table ``word,weight`` (.csv, .xlsx, .json), or
        weights by word: a dict, a ``Counter``, a pandas Series; or a list of words, each as heavy
        as it occurs often.
    add
        Items that are placed among the words: files, folders or built-in names.
    options
        Those below. ``color_by`` may be a function of a word; a ``background`` is to be given to
        ``save`` too.

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
    return _run(
        container,
        options,
        lambda name, handed, asked: uses.words_recipe(
            name, source, add=handed.names_of(add, "add"), **asked
        ),
    )


@of_verb(Verbs.PHOTOS)
def photos(
    container: Value,
    sources: Value | Iterable[Value],
    *,
    add: Value | Iterable[Value] = (),
    **options: Unpack[PhotosRun],
) -> Layout:
    """Fill a container with photographs.

    Parameters that :func:`packwork.fill` has too mean the same here.

    Parameters
    ----------
    sources
        Photos (JPEG, PNG, WebP), folders of them or patterns; pictures, arrays and bytes too.
    add
        Items that are placed among the photos, as for :func:`packwork.fill`.
    options
        Those below.

    Raises
    ------
    ReadError
        If a photo cannot be used.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for name in ("sea", "sky"):
    ...         Image.new("RGB", (300, 200), "teal").save(f"{folder}/{name}.jpg")
    ...     layout = photos("heart", folder, effort="draft", levels="50")
    ...     layout.save(f"{folder}/heart.jpg", dpi=300)
    >>> [item.name for item in layout.items]
    ['sea', 'sky']
    """
    return _run(
        container,
        options,
        lambda name, handed, asked: photos_recipe(
            name,
            handed.names_of(sources, "sources"),
            add=handed.names_of(add, "items"),
            **asked,
        ),
    )


@of_verb(Verbs.PILE)
def pile(
    container: Value,
    items: Value | Iterable[Value] = "builtin:icons",
    **options: Unpack[PileRun],
) -> Layout:
    """Heap items of given sizes, under forces, until they are at rest.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    container
        As for :func:`fill`; an SVG of open paths is open where they are, and ``"none"``
        lets items lie anywhere.
    options
        Those below.

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
    return _run(
        container,
        options,
        lambda name, handed, asked: uses.pile_recipe(
            name, **weighed(handed.names_of(items, "items"), asked)
        ),
    )


@of_verb(Verbs.CHART, BACKGROUND)
def chart(
    container: Value,
    data: Any,
    **options: Unpack[ChartRun],
) -> Layout:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    Parameters that :func:`fill` has too mean the same here.

    Parameters
    ----------
    container
        As for :func:`fill`; ``"none"`` shows the groups of ``by`` as bars.
    data
        A table (.csv, .xlsx, .json, with pandas .parquet), a data frame, rows as dicts, a dict of
        columns, or a Series of sizes. ``size_by``, ``color_by`` and the like are names of columns,
        or the cells themselves.
    options
        Those below; a ``background`` is to be given to ``save`` too.

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
    table, named = with_columns(data, options)
    return _run(container, named, lambda name, _, asked: uses.chart_recipe(name, table, **asked))


def run(
    recipe: str | Path | Mapping[str, Any],
    *,
    allow_code: bool = False,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    best_of: int = 1,
    best_by: str = "coverage",
    **options: Any,
) -> Layout:
    """Run what a recipe asks for.

    Parameters that :func:`packwork.fill` has too mean the same here.

    Parameters
    ----------
    recipe
        A recipe file (TOML), its options as a dict, what ``layout.manifest["recipe"]`` holds, or
        a session's file (.packwork), from which the run goes on.
    allow_code
        Run code that a recipe file names, as losses ``module:function``: only if you trust
        whoever wrote both.
    options
        In place of the recipe's.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> asked = {"container": "circle", "items": ["star"], "epochs": 25, "levels": "50"}
    >>> layout = run(asked, count=3)
    >>> len(layout), run(layout.manifest["recipe"]).metrics == layout.metrics
    (3, True)
    """
    with handed_over() as handed, contextlib.ExitStack() as stack:
        if not isinstance(recipe, Mapping | str | os.PathLike):
            raise RecipeError(
                "recipe", f"is {type(recipe).__name__}; give a recipe file, or options as a dict"
            )
        if isinstance(recipe, Mapping):
            plain = with_names(without_none(recipe), handed)
        elif is_session(recipe):
            from packwork.live.file.recipe import recipe_of_session

            plain = read_recipe(stack.enter_context(recipe_of_session(recipe)))
        else:
            plain = read_recipe(recipe, allow_code=allow_code)
        asked = make_recipe(**overridden(plain, with_names(options, handed)))
        return run_recipe(
            asked, asked.container, observer, stop, progress, record, history, best_of, best_by
        )


def _run(
    container: Value,
    options: Mapping[str, Any],
    recipe_of: Callable[[str, Handed, dict[str, Any]], Recipe],
) -> Layout:
    """Run the recipe that a verb makes of its container's name, values in memory, and options."""
    asked = dict(options)
    run = {name: asked.pop(name) for name in RunKeywords.__annotations__ if name in asked}
    with handed_over(run.pop("y_up", None)) as handed:
        name = handed.name_of(container, "container")
        recipe = recipe_of(name, handed, with_names(asked, handed))
        return run_recipe(recipe, container, **run)


def run_recipe(
    recipe: Recipe,
    container: Value,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    best_of: int = 1,
    best_by: str = "coverage",
) -> Layout:
    """Run a recipe, with a bar if one is to be shown; a container that was given is used as is."""
    if isinstance(best_of, bool) or not isinstance(best_of, int) or best_of < 1:
        raise RecipeError("best_of", f"must be a whole number from 1 on, not {best_of!r}")
    keepers = [keeper(history) for _ in range(best_of)]
    heard = NOBODY if observer is None else as_observer(observer)
    if not callable(stop):
        raise RecipeError("stop", f"must be a function that says whether to stop, not {stop!r}")
    bar = bar_for(progress, None if observer is None else heard)
    whole = None
    if isinstance(container, Container):
        whole = safe_area(recipe, on_canvas(container, recipe.canvas_size))

    def run_seed(k: int, stop: Stop) -> Run:
        seeded = recipe.model_copy(update={"seed": recipe.seed + k})
        told = together(bar or heard, keepers[k] or NOBODY)
        return uses.fill(seeded, None, whole, told, stop, record)

    with shown(bar):
        if best_of == 1:
            run = run_seed(0, stop)
        else:
            tried = results(range(best_of), run_seed, 1, stop)
            with telling_once():
                run = best_first((made for _, made in tried), best_by)[0]
    layout = public(run.layout)
    kept = keepers[run.layout.manifest["seed"] - recipe.seed]
    # What was just measured is not measured again when it is asked for.
    layout.__dict__["metrics"] = measures(run.metrics.as_dict())
    layout.__dict__["history"] = None if kept is None else kept.history()
    return layout

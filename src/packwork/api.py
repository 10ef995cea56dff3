"""The Python face: the verbs of the command line, on plain values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from packwork import pipeline, writers
from packwork.display.bar import bar_for, shown
from packwork.display.picture import notebook_png, notebook_svg
from packwork.metrics.measure import measure
from packwork.progress import Observer, Stop, never
from packwork.readers import items as item_reader
from packwork.readers.container import read_container as _read_container
from packwork.readers.layout import read_layout
from packwork.recipe import Recipe, make_recipe
from packwork.scene import layout as scene
from packwork.scene.container import Container
from packwork.scene.item import Item


@dataclass(frozen=True, eq=False, repr=False)
class Layout(scene.Layout):
    """Container + items + poses: what :func:`fill` returns, what is saved and shown.

    It shows itself in a notebook, and may be copied and pickled. It never changes:
    ``dataclasses.replace(layout, poses=...)`` gives another one.

    Parameters
    ----------
    container
        The region that was filled.
    items
        One entry per placed item; copies repeat the same :class:`Item`.
    poses
        Where they are: arrays ``x``, ``y`` (canvas units, y down), ``angle`` (radians,
        clockwise on screen), ``scale`` and ``stretch``, one number per item.
    weights
        ``(n,)`` share of area asked for each item; all ones if none were given.
    manifest
        What the run did: version, recipe, seed, seconds and metrics per level.

    Examples
    --------
    >>> layout = fill("heart", ["circle", "star"], count=4, effort="draft", levels="50")
    >>> layout
    <Layout: 4 items in heart>
    >>> [item.name for item in layout.items]
    ['circle', 'star', 'circle', 'star']
    >>> layout.poses.x.shape, layout.container.width
    ((4,), 600.0)
    >>> layout.manifest["recipe"]["effort"]
    'draft'
    """

    @classmethod
    def load(cls, path: str | Path) -> Layout:
        """Layout from a file that was saved as ``.geojson``.

        The items come back as flat shapes in their mean colour: pictures and drawings stay in
        their files.

        Raises
        ------
        ReadError
            If the file is missing or is not such a layout.

        Examples
        --------
        >>> import tempfile
        >>> layout = fill("circle", "star", count=3, effort="draft", levels="50")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     layout.save(f"{folder}/stars.geojson")
        ...     again = Layout.load(f"{folder}/stars.geojson")
        >>> bool(abs(again.poses.angle - layout.poses.angle).max() < 1e-9)
        True
        """
        return _public(read_layout(Path(path)))

    def save(
        self,
        path: str | Path,
        *,
        pixels: int = 1_600,
        background: str | None = None,
        show_container: bool = False,
        flatten: bool = False,
        text: Literal["outlines", "live"] = "outlines",
    ) -> None:
        """Write the layout; the ending (.svg, .png, .pdf, .dxf, .geojson) picks the format.

        Parameters
        ----------
        path
            Where to; an older file is replaced only when the new one is complete.
        pixels
            Longer side of a PNG.
        background
            Any CSS colour, or ``none``. Default: none in SVG and PDF, white in PNG.
        show_container
            Draw the container's line.
        flatten
            In SVG, repeat each drawing in place, for tools that choke on ``use``.
        text
            ``live``: words in SVG are text, to be selected and found, in parts of their
            fonts that the file carries; ``outlines``: they are curves.

        Raises
        ------
        WriteError
            If the ending is unknown or the file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> layout = fill("circle", "star", count=3, effort="draft", levels="50")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     layout.save(f"{folder}/stars.png", pixels=200, background="ivory")
        ...     Path(folder, "stars.png").read_bytes()[1:4]
        b'PNG'
        """
        options = writers.write_options(
            pixels=pixels,
            background=background,
            show_container=show_container,
            flatten=flatten,
            text=text,
        )
        writers.write(self, path, options)

    @cached_property
    def metrics(self) -> Mapping[str, Any]:
        """Measures by name: LC, LC_ratio, OO, EA, LnU, LC_ink and a table ``exact``.

        Shares are of the container's area; docs/conventions.md says what each means.

        Examples
        --------
        >>> layout = fill("circle", "hexagon", count=7, effort="draft", levels="50")
        >>> 0.5 < layout.metrics["LC"] < 1, sorted(layout.metrics["exact"])[-3:]
        (True, ['min_gap', 'outside_area', 'overlap_area'])
        """
        return measure(self).as_dict()

    def _repr_svg_(self) -> str | None:
        return notebook_svg(self)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]] | None:
        return notebook_png(self)


def fill(
    container: str | Path | Container,
    items: str | Path | Item | Sequence[str | Path | Item] = "builtin:icons",
    *,
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    **options: Any,
) -> Layout:
    """Fill a container with items.

    Parameters
    ----------
    container
        A mask (PNG, JPEG), an SVG, words to fill such as ``"text:HELLO"`` (a ``|``
        begins a new line), a built-in name such as ``"heart"``, or a :class:`Container`.
    items
        SVGs, pictures, folders, built-in names, or what :func:`read_items` returned.
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run with what it has.
    progress
        True shows a bar, False none; None shows one in a notebook only.
    options
        As on the command line: ``count``, ``font``, ``canvas``, ``seed``, ``sizes``,
        ``size_ratio``, ``stretch``, ``rotate``, ``padding``, ``weights``, ``holes``,
        ``outline``, ``strict``, ``start``, ``effort``, ``epochs``, ``levels``,
        ``losses``, ``hero``, ``palette``, ``apart``; and ``rules`` about single items,
        tables as in a recipe file: ``[{"items": "star", "count": 3}]``.

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
    chosen: list[Item] | None = None
    if any(isinstance(entry, Item) for entry in given):
        chosen = _as_items(given, recipe.holes, recipe.strict)
    return _run(recipe, chosen, whole, observer, stop, progress)


def words(
    container: str | Path | Container,
    source: str | Path | Mapping[str, float] | Any,
    *,
    add: str | Path | Sequence[str | Path] = (),
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
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
    observer, stop, progress
        As for :func:`fill`.
    options
        As on the command line: ``count``, ``min_count``, ``language``, ``stopwords``,
        ``phrases``, ``plurals``, ``case``, ``min_word_length``, ``include_numbers``,
        ``regexp``, ``fonts``, ``font_weight``, ``weight_is``, ``smallest``, ``largest``,
        ``color_by`` (also a function of a word), ``contrast``, ``background`` (to be given to
        ``save`` too), and those of :func:`fill` but ``count`` and ``weights``.

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
    recipe = pipeline.words_recipe(
        whole.source if whole else str(container),
        source,
        add=[str(item) for item in mixed_in],
        **options,
    )
    return _run(recipe, None, whole, observer, stop, progress)


def chart(
    container: str | Path | Container,
    data: Any,
    *,
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    **options: Any,
) -> Layout:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    Parameters
    ----------
    container, observer, stop, progress
        As for :func:`fill`.
    data
        A table (.csv, .tsv, .json, with pandas .parquet), a data frame, rows as dicts, or a
        dict of columns.
    options
        As on the command line: ``size_by``, ``size_is``, ``unit``, ``color_by``, ``mark``,
        ``mark_by``, ``label_by``, ``title``, ``legend``, ``background``; those of :func:`fill`.

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
    recipe = pipeline.chart_recipe(whole.source if whole else str(container), data, **options)
    return _run(recipe, None, whole, observer, stop, progress)


def read_items(
    sources: str | Path | Sequence[str | Path],
    *,
    holes: Literal["fill", "keep"] = "fill",
    strict: bool = False,
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
    return list(item_reader.read_items(several, holes=holes, strict=strict).items)


def read_container(
    source: str | Path, *, canvas: str | float | None = None, font: str | Path | None = None
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
        Font file for ``text:WORD``; the bundled one if None.

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
    return _read_container(str(source), canvas, font)


def _run(
    recipe: Recipe,
    items: list[Item] | None,
    container: Container | None,
    observer: Observer | None,
    stop: Stop,
    progress: bool | None,
) -> Layout:
    bar = bar_for(progress, observer)
    with shown(bar):
        run = pipeline.fill(recipe, items, container, bar or observer, stop)
    layout = _public(run.layout)
    # What was just measured is not measured again when it is asked for.
    layout.__dict__["metrics"] = run.metrics.as_dict()
    return layout


def _as_items(
    given: Sequence[str | Path | Item], holes: Literal["fill", "keep"], strict: bool
) -> list[Item]:
    chosen: list[Item] = []
    for entry in given:
        chosen += (
            [entry] if isinstance(entry, Item) else read_items(entry, holes=holes, strict=strict)
        )
    return chosen


def _public(layout: scene.Layout) -> Layout:
    return Layout(**{field.name: getattr(layout, field.name) for field in fields(layout)})

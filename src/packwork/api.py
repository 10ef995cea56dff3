"""The Python face: the verbs of the command line, on plain values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from packwork import pipeline, writers
from packwork.metrics.measure import measure
from packwork.progress import Observer, Stop, never
from packwork.readers import items as item_reader
from packwork.readers.container import read_container as _read_container
from packwork.readers.layout import read_layout
from packwork.recipe import make_recipe
from packwork.scene import layout as scene
from packwork.scene.container import Container
from packwork.scene.item import Item


@dataclass(frozen=True, eq=False, repr=False)
class Layout(scene.Layout):
    """Container + items + poses: what :func:`fill` returns, what is saved and shown.

    Examples
    --------
    >>> layout = fill("heart", ["circle", "star"], count=4, effort="draft", levels="50")
    >>> len(layout.items), layout.metrics["OO"] < 0.1
    (4, True)
    """

    @classmethod
    def load(cls, path: str | Path) -> Layout:
        """Layout from a file that was saved as ``.geojson``.

        The items come back as flat shapes: pictures and drawings stay in their files.

        Raises
        ------
        ReadError
            If the file is missing or is not such a layout.
        """
        return _public(read_layout(Path(path)))

    def save(
        self,
        path: str | Path,
        *,
        pixels: int = 1_600,
        background: str | None = None,
        outline: bool = False,
        flatten: bool = False,
    ) -> None:
        """Write the layout; the ending (.svg, .png, .geojson) picks the format.

        Parameters
        ----------
        path
            Where to; an older file is replaced only when the new one is complete.
        pixels
            Longer side of a PNG.
        background
            Any CSS colour, or ``none``. Default: none in SVG, white in PNG.
        outline
            Draw the container's outline.
        flatten
            In SVG, repeat each drawing in place, for tools that choke on ``use``.

        Raises
        ------
        WriteError
            If the ending is unknown or the file cannot be written.
        """
        options = writers.write_options(
            pixels=pixels, background=background, outline=outline, flatten=flatten
        )
        writers.write(self, path, options)

    @cached_property
    def metrics(self) -> Mapping[str, Any]:
        """Measures by name: LC, LC_ratio, OO, EA, LnU, LC_ink and a table ``exact``."""
        return measure(self).as_dict()

    def _repr_svg_(self) -> str:
        return writers.svg_text(self)


def fill(
    container: str | Path | Container,
    items: str | Path | Item | Sequence[str | Path | Item] = "builtin:icons",
    *,
    observer: Observer | None = None,
    stop: Stop = never,
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
    options
        As on the command line: ``count``, ``font``, ``canvas``, ``seed``, ``sizes``,
        ``size_ratio``, ``rotate``, ``weights``, ``holes``, ``strict``, ``start``,
        ``effort``, ``epochs``, ``levels``, ``losses``.

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
    run = pipeline.fill(recipe, chosen, whole, observer, stop)
    layout = _public(run.layout)
    # What was just measured is not measured again when it is asked for.
    layout.__dict__["metrics"] = run.metrics.as_dict()
    return layout


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
    source: str | Path, *, canvas: float = 600.0, font: str | Path | None = None
) -> Container:
    """Container from a mask, an SVG, ``text:WORD`` or a built-in name.

    Parameters
    ----------
    source
        As for :func:`fill`.
    canvas
        Its longer side, in canvas units.
    font
        Font file for ``text:WORD``; the bundled one if None.

    Raises
    ------
    ReadError
        If it cannot be used.

    Examples
    --------
    >>> read_container("circle").width
    600.0
    """
    return _read_container(str(source), canvas, font)


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
    return Layout(layout.container, layout.items, layout.poses, layout.weights, layout.manifest)

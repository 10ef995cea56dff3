"""Runs that fill a page's container with what it did not hold before."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from packwork import uses
from packwork.live.anew import canvas_of
from packwork.live.assets import named_container, named_item
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.container import SetContainer, SetOption
from packwork.live.commands.items import Add, Remove
from packwork.live.document import Document
from packwork.live.options import LiveOptions
from packwork.live.running import Shown, run_shown
from packwork.progress import Stop, never
from packwork.recipe import Recipe, make_recipe
from packwork.scene.layout import Layout


def poured(recipe: Recipe, shown: Shown, stop: Stop = never) -> Layout:
    """Layout of a recipe, every moment of its run shown.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning for these files.
    """
    job = uses.read(recipe)
    return run_shown(job, shown, stop)[0]


def poured_into(
    document: Document,
    use: str,
    source: str,
    options: Mapping[str, Any],
    shown: Shown,
    stop: Stop = never,
) -> Layout:
    """Other items in the container of a document: a run of their own.

    Parameters
    ----------
    use
        ``items``, ``words`` or ``photos``.
    source
        Of them: a folder or a bundled name, or the file of a text or a table.
    options
        ``count``, items in all, and of words ``font`` and ``palette``; what is None the use
        decides by itself.

    Raises
    ------
    ReadError
        If nothing of them can be used.
    """
    given: dict[str, Any] = {"effort": "draft", "canvas": canvas_of(document)}
    given |= {name: value for name, value in options.items() if value is not None}
    if use == "words":
        recipe = uses.words_recipe("page", source, **given)
    elif use == "photos":
        recipe = uses.photos_recipe("page", [source], **given)
    else:
        recipe = make_recipe(container="page", items=[source], **given)
    return run_shown(uses.read(recipe, None, document.container), shown, stop)[0]


def in_place(document: Document, library: Library, layout: Layout) -> list[Command]:
    """Commands after which the items of a layout are there, and none of those before."""
    options = LiveOptions.of(layout.manifest)
    poses, container = layout.poses, layout.container
    kept = ("padding", "sizes", "size_ratio", "rotate")
    asked = [
        made(SetOption, name=name, value=getattr(options, name))
        for name in kept
        if getattr(options, name) != getattr(document.options, name)
    ]
    brought = [
        made(
            Add,
            asset=named_item(library, replace(item, weight=float(weight))),
            x=float(poses.x[k]),
            y=float(poses.y[k]),
            area=item.outline.area * float(poses.scale[k]) ** 2,
            angle=math.degrees(poses.angle[k]),
        )
        for k, (item, weight) in enumerate(zip(layout.items, layout.weights, strict=True))
    ]
    other = (
        []
        if container is document.container
        else [made(SetContainer, asset=named_container(library, container))]
    )
    return [*other, *brought, made(Remove, items=tuple(document.ids.tolist())), *asked]

"""Runs of other items in the container of a session, and the commands that put them there."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from packwork import uses
from packwork.live.commands.command import Command, Library, made, named_container, named_item
from packwork.live.commands.container import SetContainer, SetLines, SetOption
from packwork.live.commands.items import Add, Remove
from packwork.live.document import Document
from packwork.live.kinds import LineKind, LiveOptions, kind_of
from packwork.live.relayout import Shown, ground_of, run_shown
from packwork.metrics.certificate import Promise
from packwork.progress import Stop, never
from packwork.recipe import make_recipe
from packwork.scene.layout import Layout


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
    """
    given: dict[str, Any] = {"effort": "draft", **ground_of(document)}
    given |= {name: value for name, value in options.items() if value is not None}
    if use == "words":
        recipe = uses.words_recipe("page", source, **given)
    elif use == "photos":
        recipe = uses.photos_recipe("page", [source], **given)
    else:
        recipe = make_recipe(container="page", items=[source], **given)
    return run_shown(uses.read(recipe, None, document.container.sheet), shown, stop)[0]


def in_place(document: Document, library: Library, layout: Layout) -> list[Command]:
    """Commands after which the items of a layout are there, and none of those before."""
    options = LiveOptions.from_manifest(layout.manifest)
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
    before, now = (Promise.of(one.manifest) or Promise() for one in (document, layout))
    kind, in_shares = kind_of(layout.manifest), now.areas_in_shares
    lined: list[Command] = []
    if isinstance(kind, LineKind):
        lines = {"along": kind.along, "ring": kind.ring, "palette": kind.palette}
        lined = [made(SetLines, areas_in_shares=in_shares, **lines)]
    elif isinstance(document.kind, LineKind) or in_shares != before.areas_in_shares:
        lined = [made(SetLines, areas_in_shares=in_shares)]
    return [*other, *brought, made(Remove, items=tuple(document.ids.tolist())), *asked, *lined]

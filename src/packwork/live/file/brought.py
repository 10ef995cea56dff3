"""Assets of commands, as a line of a log holds them: with their fonts."""

from __future__ import annotations

import base64
from typing import Annotated, Any

from pydantic import Field, ValidationError

from packwork.live.file.arrays import bytes_of
from packwork.live.file.records import ContainerRecord, ItemRecord, Key
from packwork.live.file.things import (
    Shared,
    Things,
    container_of,
    container_record,
    item_of,
    item_record,
)
from packwork.options import Options
from packwork.readers.reading import UnfitError
from packwork.recipe.refusals import refusal
from packwork.scene.container import Container
from packwork.scene.item import Item

BROUGHT = ("item", "container")
"""Kinds of lines."""


class Brought(Options):
    """An item or a container of the library."""

    name: Annotated[str, Field(max_length=200)]
    """By which commands call it."""
    item: ItemRecord | None = None
    container: ContainerRecord | None = None
    fonts: dict[Key, str] = Field(default_factory=dict)
    """Font files as base64, by the hash of their content."""


def brought_record(name: str, thing: Item | Container) -> Brought:
    """An item or a container as plain values.

    Raises
    ------
    ReadError
        If the file of a photograph is no longer there.
    """
    if isinstance(thing, Container):
        return Brought(name=name, container=container_record(thing))
    things = Things()
    record = item_record(thing, things)
    fonts = {
        path.removeprefix("fonts/"): base64.b64encode(data).decode("ascii")
        for path, data in things.encoded.items()
    }
    return Brought(name=name, item=record, fonts=fonts)


def brought_of(value: Any, kind: str) -> tuple[str, Item | Container]:
    """The item or container of a line's value, and its name.

    Raises
    ------
    UnfitError
        If it is none.
    """
    try:
        found = Brought.model_validate(value, strict=False)
    except ValidationError as error:
        raise UnfitError(f"holds what cannot be read: {refusal(error, Brought)}") from None
    shared = Shared(lambda key: _font(found, key))
    if kind == "container" and found.container is not None:
        return found.name, container_of(found.container, shared)
    if kind == "item" and found.item is not None:
        return found.name, item_of(found.item, shared)
    raise UnfitError(f"holds a line of kind {kind} without one")


def _font(found: Brought, key: str) -> bytes:
    if key not in found.fonts:
        raise UnfitError("lacks a font of a word")
    return bytes_of(found.fonts[key])

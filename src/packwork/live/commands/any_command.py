"""Any command, as logs hold it."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field, TypeAdapter

from packwork.live.commands.container import PlaceContainer, Reshape, SetContainer, SetOption
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.holding import Hold, Release
from packwork.live.commands.items import Add, Duplicate, Recolour, Remove, Rename, Replace, Weigh
from packwork.live.commands.placing import Exchange, Move, Scale, Turn

AnyCommand: TypeAlias = Annotated[
    Move | Turn | Scale | Exchange
    | Hold | Release
    | Add | Duplicate | Remove | Replace | Weigh | Rename | Recolour
    | SetContainer | Reshape | PlaceContainer | SetOption
    | Grab | Drop,
    Field(discriminator="kind"),
]  # fmt: skip

COMMANDS: TypeAdapter[AnyCommand] = TypeAdapter(AnyCommand)
"""Reads a command from plain values and refuses what is none."""

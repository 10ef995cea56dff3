"""Any command, as logs hold it."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field, TypeAdapter

from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.single import SingleCommand
from packwork.live.commands.together import Together

AnyCommand: TypeAlias = Annotated[
    SingleCommand | Together | Grab | Drop, Field(discriminator="kind")
]

COMMANDS: TypeAdapter[AnyCommand] = TypeAdapter(AnyCommand)
"""Reads a command from plain values and refuses what is none."""

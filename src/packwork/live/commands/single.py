"""Any command that is one edit by itself."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from packwork.live.commands.container import PlaceContainer, Reshape, SetContainer, SetOption
from packwork.live.commands.holding import Hold, Release
from packwork.live.commands.items import Add, Duplicate, Recolour, Remove, Rename, Replace, Weigh
from packwork.live.commands.placing import Arrange, Cover, Exchange, Move, Scale, Turn

SingleCommand: TypeAlias = Annotated[
    Move | Turn | Scale | Exchange | Cover | Arrange
    | Hold | Release
    | Add | Duplicate | Remove | Replace | Weigh | Rename | Recolour
    | SetContainer | Reshape | PlaceContainer | SetOption,
    Field(discriminator="kind"),
]  # fmt: skip

"""Commands of all kinds, and several of them as one gesture."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal, TypeAlias, get_args

from pydantic import Field, TypeAdapter

from packwork.errors import RecipeError
from packwork.live.commands.aligning import Align, Distribute
from packwork.live.commands.command import Command, Library
from packwork.live.commands.container import (
    DrawContainer,
    Entitle,
    LeaveOut,
    PlaceContainer,
    Reshape,
    SetContainer,
    SetLines,
    SetOption,
)
from packwork.live.commands.gestures import Cancel, Drop, Grab, Hold, Release
from packwork.live.commands.items import (
    Add,
    Duplicate,
    Flip,
    Group,
    Recolour,
    Remove,
    Rename,
    Replace,
    Ungroup,
    Weigh,
)
from packwork.live.commands.look import Background, CropPhoto, Paint, SetHalos, SetMosaic
from packwork.live.commands.placing import Arrange, Cover, Exchange, Move, Scale, Turn
from packwork.live.document import Document
from packwork.live.kinds import Kind

SingleCommand: TypeAlias = Annotated[
    Move | Turn | Scale | Exchange | Cover | Arrange | Align | Distribute
    | Hold | Release
    | Add | Duplicate | Remove | Replace | Weigh | Rename | Recolour | Flip
    | Group | Ungroup
    | SetContainer | Reshape | PlaceContainer | SetOption | Entitle | LeaveOut
    | Paint | SetMosaic | CropPhoto | Background | SetHalos | DrawContainer | SetLines,
    Field(discriminator="kind"),
]  # fmt: skip
"""Any command that is one edit by itself."""


class Together(Command):
    """Do commands one after another, or none of them: one entry of the history."""

    kind: Literal["together"] = "together"
    commands: Annotated[tuple[SingleCommand, ...], Field(min_length=1)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document after all of them."""
        for command in self.commands:
            document = command.applied(document, library)
        return document

    @property
    def steps(self) -> tuple[Command, ...]:
        """The commands."""
        return self.commands

    @property
    def assets(self) -> tuple[str, ...]:
        """Of all of them."""
        return tuple(name for command in self.commands for name in command.assets)


OF_THE_HAND = (
    Move, Turn, Scale, Exchange, Cover, Arrange, Align, Distribute, Hold, Add, Duplicate, Remove,
    Replace, Flip, Group, Ungroup, Grab,
)  # fmt: skip
"""Commands that put items somewhere, bring them or take them away."""


def of_the_hand(command: Command, kind: Kind) -> str | None:
    """Kind of the first step that would move words on lines; None where all are set anew."""
    if not kind.stays or any(isinstance(step, SetLines) for step in command.steps):
        return None
    return next((one.kind for one in command.steps if isinstance(one, OF_THE_HAND)), None)


def check_places(command: Command, kind: Kind) -> None:
    """Refuse what would move words on lines, or others beside them."""
    if (refused := of_the_hand(command, kind)) is not None:
        raise RecipeError(refused, kind.stays)


AnyCommand: TypeAlias = Annotated[
    SingleCommand | Together | Grab | Drop | Cancel, Field(discriminator="kind")
]

COMMANDS: TypeAdapter[AnyCommand] = TypeAdapter(AnyCommand)
"""Reads a command from plain values and refuses what is none."""

KINDS: Mapping[str, type[Command]] = {
    one.model_fields["kind"].default: one
    for one in (*get_args(get_args(SingleCommand)[0]), Together, Grab, Drop, Cancel)
}
"""Commands by what logs call them: those that a log can be read with, and no other."""

"""What a pile is asked to be, beside what all runs have in common."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import BaseModel, BeforeValidator, ConfigDict, field_validator

from packwork.errors import RecipeError
from packwork.refusals import length_asked

Side: TypeAlias = Literal["top", "bottom", "left", "right"]
"""Where a container is open."""


def _one_or_more(value: object) -> object:
    """Let one side be a text."""
    if isinstance(value, str):
        return (value,)
    return () if value is None else value


class PileOptions(BaseModel):
    """How items of given sizes are heaped."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    open: Annotated[tuple[Side, ...], BeforeValidator(_one_or_more)] = ()
    """Take the lid off on that side (top, bottom, left or right): items come in through it and
    may heap up beyond it, to the canvas' edge. May be given several times."""

    size: str | float | None = None
    """Longer side of each item, a length as for the padding; with weights, of one of weight 1.
    Default: as large as in their files."""

    compact: bool = False
    """Report how tight the pile is: shares of its hull, its smallest circle and its box."""

    @field_validator("size")
    @classmethod
    def _size_is_a_length(cls, value: str | float | None) -> str | float | None:
        if value is not None and length_asked("size", value, "px", 1.0) <= 0:
            raise RecipeError("size", f"must be more than nothing, not {value}")
        return value

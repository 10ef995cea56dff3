"""Numbers for all items as a page asks for them: from the fields that sessions have them by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, get_args

from packwork.live.options import LiveOptions
from packwork.options import SizeMode, offered
from packwork.recipe import Recipe

RANGES: Mapping[str, tuple[float, float, float]] = {
    "size_ratio": (1.0, 6.0, 0.1), "evenness": (0.0, 20.0, 0.5), "padding": (0.0, 20.0, 0.5)
}  # fmt: skip
"""Least, most and step of sliders. The field itself takes more. Chosen."""

CHOICES: Mapping[str, tuple[str, ...]] = {
    "sizes": get_args(SizeMode), "rotate": ("free", "none", "15", "30", "90")
}  # fmt: skip
"""What is offered to be chosen from."""


@dataclass(frozen=True)
class Question:
    """One number or choice.

    Parameters
    ----------
    choices
        What it may be; empty for a number.
    range
        Least, most and step of a number; empty for a choice.
    """

    name: str
    help: str
    choices: tuple[str, ...] = ()
    range: tuple[float, ...] = ()
    default: Any = field(default=None)


def questions() -> tuple[Question, ...]:
    """Settings that hold for all items, in the order of the fields.

    Examples
    --------
    >>> [one.name for one in questions()]
    ['padding', 'sizes', 'size_ratio', 'rotate', 'evenness']
    """
    known = {option.name: option.help for option in offered(Recipe)}
    return tuple(
        Question(
            name,
            known.get(name) or one.description or "",
            CHOICES.get(name, ()),
            RANGES.get(name, ()),
            one.default,
        )
        for name, one in LiveOptions.model_fields.items()
        if name in CHOICES or name in RANGES
    )

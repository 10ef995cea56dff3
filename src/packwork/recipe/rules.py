"""Rules of single items, as a recipe's ``[[rules]]`` say them."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    BeforeValidator,
    Field,
    field_validator,
)

from packwork.errors import RecipeError
from packwork.options import Offer, Options, number_or_auto
from packwork.units import parse_length

AUTO = "auto"
"""Word for what the run finds."""

USUAL_GAPS = MappingProxyType({"pile": "0", "photos": "0.4%", "words": "0.3%", "chart": "0.2%"})
"""Usual gaps by the part of a recipe, the first that it has: a heap's items touch; of photos
between borders cut at the edge, where a hair would look like a fault of the print. Larger cover
less. By eye."""


def usual_padding(asked: Mapping[str, Any]) -> str:
    """Gap of a recipe that asks for none, by what it places.

    Examples
    --------
    >>> usual_padding({"words": {"source": "poem.txt"}}), usual_padding({"items": ["star"]})
    ('0.3%', '0')
    >>> usual_padding({"photos": {"border": "4%", "edge": "crop"}})
    '0.4%'
    """
    photos = asked.get("photos")
    said = photos if isinstance(photos, Mapping) else getattr(photos, "__dict__", {})
    are_apart = said.get("edge") == "crop" and str(said.get("border", "")).strip("0.% ")
    parts = (part for part in USUAL_GAPS if asked.get(part) and (part != "photos" or are_apart))
    return USUAL_GAPS.get(next(parts, ""), "0")


MAX_COUNT = 100_000
"""Most items in one run; more would not be seen on any sheet. Chosen."""


ItemCount: TypeAlias = Annotated[
    Annotated[int, Field(ge=1, le=MAX_COUNT)] | Literal["auto"], BeforeValidator(number_or_auto)
]
"""How many items there are, or auto: as many as the container takes."""

WIDEST_SCALE = 100.0
"""By how much an item may be larger or smaller than the typical one. Chosen."""

HERO_SIZE = "30%"
"""Size of a hero that was given none: a third of the canvas is seen first, and leaves room
for a crowd. Chosen by eye."""

OWN_COLOURS = "own"
"""Stands for the colours that an item has anyway."""

TURNED: Mapping[str, tuple[float, ...]] = MappingProxyType(
    {"vertical": (-90.0,), "mixed": (0.0, 0.0, 0.0, -90.0)}
)
"""Ways to turn that have a name: the angles that items get, in equal shares, degrees."""

UPRIGHT = 30.0
"""Degrees from upright within which things with an up still look upright. Larger fills a little
more, smaller costs coverage. By eye: docs/decisions/0025-upright.md."""

_HERO = re.compile(
    r"(?P<name>[^@=]+|.*[/\\\\][^@=]+)(?:@(?P<x>[^,@=]+),(?P<y>[^,@=]+))?(?:=(?P<size>[^@=]+))?"
)


def checked_length(value: object) -> object:
    """The same value, if it is a length of the grammar; percents of whatever it turns out.

    Examples
    --------
    >>> checked_length("40%"), checked_length(12)
    ('40%', 12)
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError(f"use a length such as 4, 1mm or 50%, not {value!r}")
    parse_length(str(value), "px", 1.0)
    return value


Length: TypeAlias = Annotated[str | float, BeforeValidator(checked_length)]
"""A length as people write it."""


Turns: TypeAlias = str | float | tuple[float, ...]
"""How far items may turn, as Python may say it: in words, a limit, or the only angles."""


class Rotation(Options):
    """Range in which items may turn, radians."""

    limit: float | None = None
    """Largest turn from upright; None for any."""

    choices: tuple[float, ...] | None = None
    """The only angles allowed; None for all within the limit."""

    @classmethod
    def parse(cls, text: str) -> Rotation:
        """Rotation from ``free``, ``none``, ``30`` (within 30 degrees) or ``0,90``.

        Examples
        --------
        >>> round(Rotation.parse("30").limit, 3)
        0.524
        >>> Rotation.parse("0,90").choices[0]
        0.0
        """
        plain = text.strip().lower()
        if plain == "free":
            return cls()
        if plain == "upright":
            return cls(limit=math.radians(UPRIGHT))
        if plain in {"none", "horizontal"}:
            return cls(limit=0.0)
        if plain in TURNED:
            return cls(choices=tuple(math.radians(v) for v in TURNED[plain]))
        numbers = [_degrees(part, text) for part in plain.split(",") if part.strip()]
        if "," in plain and numbers:
            return cls(choices=tuple(math.radians(v) for v in numbers))
        if len(numbers) == 1 and 0 < numbers[0] <= 180:
            return cls(limit=math.radians(numbers[0]))
        raise _bad_rotation(text)

    @property
    def of_words(self) -> Rotation:
        """The same of what has to be read: free, yet never upside down.

        Examples
        --------
        >>> [Rotation.parse(text).of_words.limit for text in ("free", "0,90")]
        [1.57..., None]
        """
        return Rotation(limit=math.pi / 2) if self.is_free else self

    @property
    def is_free(self) -> bool:
        """Whether items may have any angle."""
        return self.limit is None and self.choices is None

    @property
    def farthest(self) -> float:
        """Largest turn from upright; infinite for any."""
        return math.inf if self.limit is None else self.limit

    @property
    def is_still(self) -> bool:
        """Whether items keep the angle that they start with.

        Examples
        --------
        >>> Rotation.parse("0,90").is_still, Rotation.parse("30").is_still
        (True, False)
        """
        return self.choices is not None or self.limit == 0.0


def as_text(value: object) -> object:
    """Value of Python, a list or a number, in the words of the command line.

    Examples
    --------
    >>> as_text((50, 200)), as_text(30), as_text("free")
    ('50,200', '30', 'free')
    """
    if isinstance(value, tuple | list):
        return ",".join(str(part) for part in value)
    return str(value) if isinstance(value, int | float) else value


def rotation_text(value: object) -> object:
    """As :func:`as_text`; one angle in a list is the only one, a number alone a limit.

    Examples
    --------
    >>> rotation_text((90,)), rotation_text(30), rotation_text((22, 5))
    ('90,', '30', '22,5')
    """
    text = as_text(value)
    return f"{text}," if isinstance(value, tuple | list) and len(value) == 1 else text


def known_rotation(value: object) -> object:
    """As :func:`rotation_text`, refused unless it has a meaning.

    Examples
    --------
    >>> known_rotation((0, 90))
    '0,90'
    """
    text = rotation_text(value)
    if isinstance(text, str):
        Rotation.parse(text)
    return text


class Pin(Options):
    """Given parts of one item's pose; the rest is free."""

    x: Length | None = None
    """Where its centroid lies, from the canvas' left edge; % are of the canvas' width."""

    y: Length | None = None
    """The same from the canvas' top edge; % are of its height."""

    angle_deg: Annotated[float, Field(allow_inf_nan=False)] | None = None
    """Turn from upright, degrees clockwise."""

    size: Length | None = None
    """Longer side of the item as drawn; % are of the canvas' longer side."""

    @field_validator("size")
    @classmethod
    def _there_is_something_to_see(cls, size: str | float | None) -> str | float | None:
        if size is not None and parse_length(str(size), "px", 1.0) == 0:
            raise ValueError(f"must be more than 0, not {size!r}")
        return size

    @property
    def is_place(self) -> bool:
        """Whether it is one point, so that there is room for one item only."""
        return self.x is not None and self.y is not None


class Rule(Options):
    """Rule for the items of some names; every key but ``items`` may be left out."""

    items: Annotated[tuple[str, ...], Offer(takes=str | tuple[str, ...])]
    """Names of items, or patterns such as ``b*``."""

    count: Annotated[int, Field(ge=0, le=MAX_COUNT)] | None = None
    """Copies of each of them."""

    scale: tuple[float, float] | None = None
    """Smallest and largest size, 1 being the typical item's. With free sizes."""

    rotate: Annotated[str | None, Offer(takes=Turns | None)] = None
    """Turns that they may have, in the words of the option ``rotate``."""

    weight: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    """Share of area, as in ``weights``."""

    pin: Pin | None = None
    """Given parts of the pose. With both x and y the rule is for one copy only."""

    region: str | tuple[Length, Length, Length, Length] | None = None
    """Part of the canvas to stay in: a container, or left, top, width and height."""

    color: str | tuple[str, ...] | None = None
    """One colour, or a palette: items of several colours become silhouettes; or ``own``,
    where another rule or the recipe gives colours that these items shall not have."""

    name: str | None = None
    """Name in the file that is written."""

    link: str | None = None
    """Where a click on it leads: http(s), mailto or a relative address."""

    title: str | None = None
    """Text that is shown when a pointer rests on it."""

    @field_validator("items", mode="before")
    @classmethod
    def _one_name_is_enough(cls, items: object) -> object:
        if isinstance(items, str):
            return (items,)
        if isinstance(items, list | tuple) and items and all(isinstance(n, str) for n in items):
            return tuple(items)
        raise ValueError(f"use a name, a pattern such as b*, or a list of them, not {items!r}")

    @field_validator("scale", mode="before")
    @classmethod
    def _scale_is_a_pair(cls, scale: object) -> object:
        if scale is None or (isinstance(scale, list | tuple) and len(scale) == 2):
            return scale
        raise ValueError(f"use the smallest and the largest size, as in [0.5, 2.0], not {scale!r}")

    @field_validator("scale")
    @classmethod
    def _scale_is_a_range(cls, scale: tuple[float, float] | None) -> tuple[float, float] | None:
        if scale is None:
            return None
        low, high = scale
        if not (low >= 1 / WIDEST_SCALE and high <= WIDEST_SCALE):
            raise ValueError(
                f"must be within {1 / WIDEST_SCALE:g} and {WIDEST_SCALE:g}, not {low:g} to {high:g}"
            )
        if low > high:
            raise ValueError(f"is empty, from {low:g} to {high:g}; the smaller comes first")
        return scale

    @field_validator("rotate", mode="before")
    @classmethod
    def _rotation_is_known(cls, value: object) -> object:
        text = rotation_text(value)
        if isinstance(text, str):
            try:
                Rotation.parse(text)
            except RecipeError as error:
                raise ValueError(error.problem) from None
        return text

    @field_validator("region", mode="before")
    @classmethod
    def _region_is_a_name_or_a_box(cls, region: object) -> object:
        if region is None or isinstance(region, str):
            return region
        if not isinstance(region, list | tuple) or len(region) != 4:
            raise ValueError(f"use a container or [left, top, width, height], not {region!r}")
        return tuple(checked_length(side) for side in region)

    @field_validator("color", mode="before")
    @classmethod
    def _colours_are_known(cls, color: object) -> object:
        if color not in (None, OWN_COLOURS):
            # Loads the picture library, which the command line's help can do without.
            from packwork.scene.palette import palette_colours

            palette_colours(color)
        return color

    @field_validator("name", "link", "title")
    @classmethod
    def _labels_are_sound(cls, text: str | None, info: Any) -> str | None:
        if text is not None:
            # Loads NumPy and Shapely, which the command line's help can do without.
            from packwork.scene.item import Label

            try:
                Label(**{info.field_name: text})
            except RecipeError as error:
                raise ValueError(error.problem) from None
        return text

    @property
    def is_for_one(self) -> bool:
        """Whether the rule is for one copy of each item that it names."""
        return self.pin is not None and self.pin.is_place


def hero_rule(text: str) -> Rule:
    """Rule of a hero ``NAME``, ``NAME@X,Y``, ``NAME=SIZE`` or ``NAME@X,Y=SIZE``.

    Examples
    --------
    >>> rule = hero_rule("bear@50%,40%=25%")
    >>> rule.items, rule.pin.x, rule.pin.y, rule.pin.size, rule.pin.angle_deg
    (('bear',), '50%', '40%', '25%', 0.0)
    >>> hero_rule("bear").pin.size
    '30%'
    """
    match = _HERO.fullmatch(text)
    if match is None or not match["name"].strip():
        raise RecipeError("hero", f"use NAME, NAME@X,Y or NAME@X,Y=SIZE, not {text!r}")
    name, x, y, size = (part and part.strip() for part in match.groups())
    try:
        pin = Pin(x=x, y=y, angle_deg=0.0, size=size or HERO_SIZE)
    except ValueError:
        raise RecipeError(
            "hero", f"use lengths such as 50%,40%=30% or 30mm,40mm=60mm, not {text!r}"
        ) from None
    return Rule(items=(name,), pin=pin)


def some_rules(value: object) -> object:
    """The same value, refused unless it can be a list of rules."""
    if not isinstance(value, list | tuple):
        raise RecipeError("rules", f"must be a list of tables, not {str(value)[:60]!r}")
    return value


def _degrees(part: str, text: str) -> float:
    try:
        value = float(part)
    except ValueError:
        raise _bad_rotation(text) from None
    if not math.isfinite(value):
        raise _bad_rotation(text)
    return value


def _bad_rotation(text: str) -> RecipeError:
    return RecipeError(
        "rotate",
        f"use free, upright, none, 30 (within 30 degrees) or 0,90 (only these), not {text!r}",
    )

"""What a run is asked to do: one validated value composed of the stages' options."""

from __future__ import annotations

import difflib
import math
import re
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
)

from packwork.errors import RecipeError
from packwork.solve.options import (
    MAX_RESOLUTION,
    MIN_RESOLUTION,
    ImageLossFunction,
    SizeMode,
    SolveOptions,
)
from packwork.start.options import StartOptions

Effort: TypeAlias = Literal["draft", "normal", "best"]

EPOCHS: dict[str, int] = {"draft": 200, "normal": 800, "best": 6_000}
"""Epochs per effort. Effort bounds iterations and never seconds, so that one seed gives
one result on any machine. Measured in docs/benchmarks.md."""

MAX_COUNT = 100_000
"""Most items in one run; more would not be seen on any sheet. Chosen."""


class Rotation(BaseModel):
    """How far items may turn, radians."""

    model_config = ConfigDict(frozen=True, extra="forbid")

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
        if plain == "none":
            return cls(limit=0.0)
        numbers = [_degrees(part) for part in plain.split(",") if part.strip()]
        if "," in plain and numbers:
            return cls(choices=tuple(math.radians(v) for v in numbers))
        if len(numbers) == 1 and 0 < numbers[0] <= 180:
            return cls(limit=math.radians(numbers[0]))
        raise _bad_rotation(text)


class Recipe(BaseModel):
    """What one ``fill`` is asked to do. Lengths in canvas units, angles in degrees."""

    model_config = ConfigDict(frozen=True, extra="forbid", use_attribute_docstrings=True)

    container: str
    """What to fill: a mask (PNG, JPEG), an SVG, text:WORD, or a built-in name such as heart."""

    font: str | None = None
    """Font file (TTF, OTF, TTC) for a container text:WORD. Default: a bundled bold sans."""

    items: tuple[str, ...] = ("builtin:icons",)
    """What to place: SVGs, pictures, folders of them, or built-in names."""

    count: Annotated[int, Field(ge=1, le=MAX_COUNT)] | None = None
    """How many items in all; the given ones are repeated in turn. Default: one of each."""

    canvas: Annotated[float, Field(ge=1e-3, le=1e6, allow_inf_nan=False)] = 600.0
    """Longer side of the canvas, in px (96 to the inch): the unit of all results."""

    seed: Annotated[int, Field(ge=0, le=2**63 - 1)] = 0
    """Same seed, same machine, same versions: same layout."""

    sizes: SizeMode = "free"
    """free: each item finds its size; shared: all have equal areas, or areas in the shares
    of the weights; fixed: as large as in their files."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """With free sizes: 2 lets an item be half to twice as large as the typical one."""

    rotate: str = "free"
    """free, none, 30 (within 30 degrees of upright) or 0,90 (only these angles)."""

    padding: str | float = "0"
    """Gap between items and to the container's edge: 4 (px), 1mm, 3pt, 0.5cm, 0.1in, or
    1% of the canvas' longer side."""

    weights: str | dict[str, float] | None = None
    """Shares of area: a CSV file with lines of name,weight (in Python also a dict)."""

    holes: Literal["fill", "keep"] = "fill"
    """keep: the holes of items stay free, so that small items may sit in them."""

    strict: bool = False
    """Refuse a folder with an unusable file instead of leaving that file out."""

    start: str = "distance-field"
    """How the first places are found: distance-field (one after another into the largest
    room), medial-axis (along the container's middle line first), auto (one of these two, by
    the container's form), scatter (at random), or a layout file (.geojson) to start from."""

    effort: Effort = "normal"
    """How many iterations: draft, normal or best."""

    epochs: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    """Iterations in all, instead of an effort."""

    levels: str = "50:9,200:23,600:68"
    """Resolutions from coarse to fine, pixels on the longer side, each with its share
    of the epochs; without shares (50,200,600) they are even."""

    losses: dict[str | ImageLossFunction, float] = Field(default_factory=dict)
    """Further losses, by name, module:function or (in Python) as functions, with weights."""

    @field_validator("font", mode="before")
    @classmethod
    def _font_may_be_a_path(cls, font: Any) -> Any:
        return str(font) if isinstance(font, Path) else font

    @field_validator("font")
    @classmethod
    def _font_sets_words(cls, font: str | None, info: ValidationInfo) -> str | None:
        container = str(info.data.get("container", ""))
        if font is not None and not container.startswith("text:"):
            raise RecipeError(
                "font", f"sets a container of words, as in text:HELLO, not {container!r}"
            )
        return font

    @field_validator("rotate", "levels", mode="before")
    @classmethod
    def _numbers_are_text_too(cls, value: object, info: ValidationInfo) -> object:
        """Let Python say ``rotate=30``, ``rotate=(0, 90)`` and ``levels=(50, 200)``."""
        if isinstance(value, tuple | list):
            alone = len(value) == 1 and info.field_name == "rotate"
            return ",".join(str(part) for part in value) + ("," if alone else "")
        return str(value) if isinstance(value, int | float) else value

    @field_validator("rotate")
    @classmethod
    def _rotation_is_known(cls, text: str) -> str:
        Rotation.parse(text)
        return text

    @field_validator("padding")
    @classmethod
    def _padding_is_a_length(cls, value: str | float) -> str | float:
        parse_length("padding", value, 1.0)
        return value

    @field_validator("losses")
    @classmethod
    def _weights_are_finite(
        cls, losses: dict[str | ImageLossFunction, float]
    ) -> dict[str | ImageLossFunction, float]:
        for name, weight in losses.items():
            if not math.isfinite(weight):
                raise RecipeError("losses", f"the weight of {name} must be a number, not {weight}")
        return losses

    @field_validator("levels")
    @classmethod
    def _levels_are_numbers(cls, text: str) -> str:
        parse_levels(text)
        return text

    def plain(self) -> dict[str, Any]:
        """Values that JSON can hold; a loss given as a function by its name."""
        values = self.model_dump(exclude={"losses"}, mode="json")
        named = {
            loss if isinstance(loss, str) else getattr(loss, "__qualname__", repr(loss)): weight
            for loss, weight in self.losses.items()
        }
        return {**values, "losses": named}

    @property
    def rotation(self) -> Rotation:
        """How far items may turn."""
        return Rotation.parse(self.rotate)

    @property
    def starts_from_layout(self) -> bool:
        """True if ``start`` names a layout file and no method."""
        return Path(self.start).suffix.lower() in {".geojson", ".json"}

    @property
    def padding_cu(self) -> float:
        """Gap asked for, canvas units."""
        return parse_length("padding", self.padding, self.canvas)

    def start_options(self) -> StartOptions:
        """Options of the start stage."""
        if self.starts_from_layout:
            return StartOptions()
        try:
            return StartOptions.model_validate({"method": self.start})
        except ValidationError as error:
            raise _recipe_error(error, {"method": "start"}) from error

    def solve_options(self) -> SolveOptions:
        """Options of the solve stage."""
        rotation = self.rotation
        still = rotation.choices is not None or rotation.limit == 0.0
        changes: dict[str, Any] = {"turn_rate": 0.0} if still else {"turn_limit": rotation.limit}
        levels, shares = parse_levels(self.levels)
        return SolveOptions(
            levels=levels,
            shares=shares,
            epochs=self.epochs or EPOCHS[self.effort],
            sizes=self.sizes,
            size_ratio=self.size_ratio,
            losses=self.losses,
            margin=self.padding_cu / 2,
            **changes,
        )


UNITS_PX = {
    "": 1.0,
    "px": 1.0,
    "pt": 96 / 72,
    "mm": 96 / 25.4,
    "cm": 96 / 2.54,
    "in": 96.0,
}
"""Pixels per unit of a length, 96 to the inch."""


def parse_length(key: str, value: str | float, side: float) -> float:
    """Length in canvas units from ``2``, ``2pt``, ``1mm`` or ``5%`` of the longer side.

    Raises
    ------
    RecipeError
        About ``key``, if it is no length or below zero.

    Examples
    --------
    >>> parse_length("padding", "5%", 600.0), parse_length("padding", "1in", 600.0)
    (30.0, 96.0)
    """
    found = re.fullmatch(r"([0-9]*\.?[0-9]+)\s*(%|[a-z]*)", str(value).strip().lower())
    if found is not None:
        number, unit = float(found[1]), found[2]
        if unit == "%":
            return number / 100 * side
        if unit in UNITS_PX:
            return number * UNITS_PX[unit]
    raise RecipeError(key, f"use a length such as 4, 1mm, 3pt, 0.1in or 1%, not {value!r}")


def parse_levels(text: str) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Resolutions and their shares of the epochs from ``50:9,200:23,600:68``.

    Examples
    --------
    >>> parse_levels("50,600")
    ((50, 600), (1.0, 1.0))
    """
    levels, shares = [], []
    for part in text.split(","):
        resolution, _, share = part.partition(":")
        try:
            levels.append(int(resolution))
            shares.append(float(share or 1))
        except ValueError:
            raise _bad_levels(text) from None
    if not all(MIN_RESOLUTION <= level <= MAX_RESOLUTION for level in levels):
        raise RecipeError(
            "levels", f"a level has {MIN_RESOLUTION} to {MAX_RESOLUTION} px, not {text!r}"
        )
    if not all(math.isfinite(share) and share > 0 for share in shares):
        raise _bad_levels(text)
    return tuple(levels), tuple(shares)


def make_recipe(**options: Any) -> Recipe:
    """Recipe from plain values.

    Raises
    ------
    RecipeError
        Naming the option, what was met and what would do.

    Examples
    --------
    >>> make_recipe(container="heart", count=0)
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: count: must be at least 1, not 0
    """
    try:
        return Recipe.model_validate(options)
    except ValidationError as error:
        raise _recipe_error(error) from error


_PLAIN_WORDS = {
    "should be": "must be",
    "greater than or equal to": "at least",
    "less than or equal to": "at most",
    "greater than": "more than",
    "a valid integer, unable to parse string as an integer": "a whole number",
    "a valid number, unable to parse string as a number": "a number",
    "a valid integer, got a number with a fractional part": "a whole number",
}


def _recipe_error(error: ValidationError, names: dict[str, str] | None = None) -> RecipeError:
    first = error.errors(include_url=False)[0]
    key = str(first["loc"][0]) if first["loc"] else "recipe"
    key = (names or {}).get(key, key)
    if first["type"] == "extra_forbidden":
        known = list(Recipe.model_fields)
        close = difflib.get_close_matches(key, known, n=1)
        hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(known)}"
        return RecipeError(key, f"no such option; {hint}")
    if first["type"] == "missing":
        return RecipeError(key, "must be given")
    message = re.sub(r"^(Value error, |Input )", "", first["msg"])
    for said, meant in _PLAIN_WORDS.items():
        message = message.replace(said, meant)
    return RecipeError(key, f"{message[0].lower()}{message[1:]}, not {first['input']!r}")


def _degrees(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise _bad_rotation(text) from None
    if not math.isfinite(value):
        raise _bad_rotation(text)
    return value


def _bad_levels(text: str) -> RecipeError:
    return RecipeError(
        "levels", f"use resolutions like 50,200,600 or 50:9,200:23,600:68, not {text!r}"
    )


def _bad_rotation(text: str) -> RecipeError:
    return RecipeError(
        "rotate", f"use free, none, 30 (within 30 degrees) or 0,90 (only these), not {text!r}"
    )

"""What a run is asked to do: one validated value composed of the stages' options."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)

from packwork.errors import RecipeError
from packwork.levels import checked_levels, parse_levels
from packwork.pictures import Pictured
from packwork.piles import Moving
from packwork.presets import PRESETS
from packwork.readers.charts.options import ChartOptions
from packwork.readers.tables.format import TableFormat
from packwork.readers.words.options import WordOptions
from packwork.reading import Interpreted
from packwork.recipe_paths import check_names
from packwork.refusals import length_asked, refusal
from packwork.rules import MAX_COUNT, ItemCount, Rotation, Rule, as_text, hero_rule, rotation_text
from packwork.solve.options import (
    MAX_STRETCH,
    ImageLossFunction,
    OutlineChoice,
    SizeMode,
    SolveOptions,
)
from packwork.start.options import LAYOUTS, StartOptions
from packwork.units import CanvasSize, canvas_size, parse_share
from packwork.writers.film.options import FilmOptions

if TYPE_CHECKING:
    from packwork.scene.container import Container

Effort: TypeAlias = Literal["draft", "normal", "best"]

EPOCHS: dict[str, int] = {"draft": 200, "normal": 800, "best": 6_000}
"""Iterations, never seconds: one seed gives one result. Measured (docs/benchmarks-engine.md)."""

APART = 0.5
"""Weight of the loss that keeps kinds apart. Larger parts more and fills less. Tried."""

MAX_SECONDS = 86_400.0
"""Longest time for one run. Chosen."""

DEFAULT_SMALLEST = "0.5%"
"""Of the canvas' longer side: 3 px of 600, below which a copy is a speck. Chosen by eye."""


class Recipe(Pictured, Moving, TableFormat, Interpreted):
    """What one ``fill`` is asked to do. Lengths in canvas units, angles in degrees."""

    container: str
    """What to fill: a mask (PNG, JPEG), SVG, text:WORD, around:IMAGE, a built-in name or page."""

    font: str | None = None
    """Font file (TTF, OTF, TTC) or installed family, for a container text:WORD or for words;
    for these also several in turn. Default: a bundled bold sans, others for what it lacks."""

    items: tuple[str, ...] = ("builtin:icons",)
    """What to place: SVGs, pictures, folders of them, or built-in names."""

    words: WordOptions | None = None
    """Words to place: what they are and how they are set (``packwork words``)."""

    chart: ChartOptions | None = None
    """Rows of a table, a mark for each (``packwork chart``)."""
    count: ItemCount | None = None
    """How many items in all; the given ones are repeated in turn. Default: one of each.
    Of words: how many at most, those of the largest weights; default 100. auto: as many as it
    takes for the container's shape to show."""

    canvas: str | float | None = None
    """Longer side of the canvas, as 600 (px, 96 to the inch), 200mm or 8in, or a sheet, as
    200x150mm, A4 (A0 to A6, letter) or A4-landscape. Its unit is that of all results.
    Default: an SVG container in mm, cm, in or pt keeps its size; any other becomes 600 px."""

    seed: Annotated[int, Field(ge=0, le=2**63 - 1)] = 0
    """Same seed, same machine, same versions: same layout."""

    sizes: SizeMode = "free"
    """free: each item finds its size; shared: all have equal areas, or areas in the shares
    of the weights; fixed: as large as in their files."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """With free sizes: 2 lets an item be half to twice as large as the typical one."""

    stretch: Annotated[float, Field(ge=1, le=MAX_STRETCH, allow_inf_nan=False)] = 1.0
    """1.5 lets each item become up to 1.5 times as wide for its height as it was drawn, or
    as high for its width, at the same area. 1 keeps all proportions."""

    rotate: str = "free"
    """free (words: within 90 degrees, never upside down), none, 30 (within 30 degrees of upright;
    upright is the same) or 0,90 (only these angles); also horizontal, vertical (read upwards),
    mixed (one in four vertical)."""

    padding: str | float = "0"
    """Gap between items and to the container's edge: 4 (in the canvas' unit), 1mm, 3pt,
    0.5cm, 0.1in, or 1% of the canvas' longer side."""

    weights: str | dict[str, float] | None = None
    """Shares of area: a CSV file with lines of name,weight (in Python also a dict)."""

    hero: str | None = None
    """One item larger than the rest and upright: NAME, NAME=30% (its longer side) or
    NAME@50%,40%=30% (where its middle lies, as shares of the canvas' width and height)."""

    palette: str | tuple[str, ...] | None = None
    """New colours for items, neighbours unlike: #e63946,#457b9d or okabe-ito, tol-bright,
    tol-vibrant, tol-muted, tol-high-contrast. Photographs keep theirs."""

    apart: bool = False
    """Keep copies of one item from lying side by side, as far as that goes."""

    rules: tuple[Rule, ...] = ()
    """What is asked of single items (in Python and recipe files)."""

    holes: Literal["fill", "keep"] = "fill"
    """keep: the holes of items stay free, so that small items may sit in them."""

    outline: OutlineChoice = "exact"
    """What an item is taken for while it is placed: exact (its true outline), fitted (20
    smooth curves) or hull (no item in another's bays). What is measured and written is the
    true outline."""

    strict: bool = False
    """Refuse a folder with an unusable file instead of leaving that file out."""

    start: str | None = None
    """How the first places are found: distance-field (into the largest room), medial-axis (along
    the middle line), auto (of these two), scatter (at random), first-fit (where they touch most;
    for words and shared sizes), or a layout (.geojson, .svg, .dxf; edited ones too). Default: what
    suits the sizes, of photos the best of distance-field, medial-axis and scatter."""

    finish: Literal["exact", "none"] = "exact"
    """exact: after the levels, items are moved, turned and sized in exact geometry until
    nothing overlaps and nothing sticks out; none: what the levels gave, not certified."""

    target_coverage: Annotated[float, Field(gt=0, lt=1), BeforeValidator(parse_share)] | None = None
    """Share of the container to cover, as 0.94 or 94%: smaller copies are put into the voids,
    round by round, until it is reached or nothing more fits."""

    max_items: Annotated[int, Field(ge=1, le=MAX_COUNT)] | None = None
    """Most items in all once smaller copies have been put into the voids. Default: 1000."""

    smallest: str | float | None = None
    """Put smaller copies into the voids, down to this longer side, a length as for the padding
    (default 0.5%). Of words: the least font size; smaller ones are left out and named."""

    filler: tuple[str, ...] | None = None
    """Items to put into the voids, in place of smaller copies of the items."""

    effort: Effort = "normal"
    """How many iterations: draft, normal or best."""

    epochs: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    """Iterations in all, instead of an effort."""

    time: Annotated[float, Field(gt=0, le=MAX_SECONDS, allow_inf_nan=False)] | None = None
    """Seconds for the whole run, instead of a number of iterations: results then depend on
    the machine."""

    preset: Literal["default", "paper"] = "default"
    """Losses, weights and steps: default, or paper (as published by Wang and Lu, 2025)."""

    levels: Annotated[str | None, BeforeValidator(as_text), AfterValidator(checked_levels)] = None
    """Resolutions from coarse to fine, pixels on the longer side, each with its share of
    the epochs, as 50:9,200:23,600:68 (the default); without shares, as 50,200,600 (the
    paper's), they are even."""

    losses: dict[str | ImageLossFunction, float] = Field(default_factory=dict)
    """Weights of losses, by name, module:function or (in Python) as functions: in place of
    the preset's, or beside them; 0 switches one off."""

    film: FilmOptions | None = None
    """How a film of the run is made, where one is asked for (``--film``)."""

    @field_validator("font", mode="before")
    @classmethod
    def _font_sets_words(cls, font: Any, info: ValidationInfo) -> Any:
        container = str(info.data.get("container", ""))
        if font is not None and not container.startswith("text:"):
            raise RecipeError(
                "font", f"sets a container of words, as in text:HELLO, not {container!r}"
            )
        return str(font) if isinstance(font, Path) else font

    @field_validator("rotate", mode="before")
    @classmethod
    def _rotation_is_known(cls, value: object) -> object:
        text = rotation_text(value)
        if isinstance(text, str):
            Rotation.parse(text)
        return text

    @field_validator("rules", mode="before")
    @classmethod
    def _rules_are_tables(cls, value: object) -> object:
        if not isinstance(value, list | tuple):
            raise RecipeError("rules", f"must be a list of tables, not {str(value)[:60]!r}")
        return value

    @field_validator("hero")
    @classmethod
    def _hero_is_known(cls, text: str | None) -> str | None:
        if text is not None:
            hero_rule(text)
        return text

    @field_validator("palette", mode="before")
    @classmethod
    def _palette_is_known(cls, value: object) -> object:
        if value is not None:
            # Loads the picture library, which the command line's help can do without.
            from packwork.scene.palette import palette_colours

            try:
                palette_colours(value)
            except ValueError as error:
                raise RecipeError("palette", str(error)) from None
        return value

    @field_validator("canvas")
    @classmethod
    def _canvas_has_a_size(cls, value: str | float | None) -> str | float | None:
        if value is not None:
            canvas_size(value)
        return value

    @field_validator("padding")
    @classmethod
    def _padding_is_alength_asked(cls, value: str | float) -> str | float:
        length_asked("padding", value, "px", 1.0)
        return value

    @field_validator("smallest")
    @classmethod
    def _smallest_is_a_size(cls, value: str | float | None) -> str | float | None:
        if value is None or length_asked("smallest", value, "px", 1.0) > 0:
            return value
        raise RecipeError("smallest", f"must be more than nothing, not {value}")

    @field_validator("losses")
    @classmethod
    def _weights_are_finite(
        cls, losses: dict[str | ImageLossFunction, float]
    ) -> dict[str | ImageLossFunction, float]:
        for name, weight in losses.items():
            if not math.isfinite(weight):
                raise RecipeError("losses", f"the weight of {name} must be a number, not {weight}")
        return losses

    @model_validator(mode="after")
    def _sizes_can_be_bounded(self) -> Recipe:
        for number, rule in enumerate(self.rules, start=1):
            if rule.scale is not None and self.sizes != "free":
                raise RecipeError(
                    "rules",
                    f"rule {number}: scale bounds free sizes, not {self.sizes} ones; "
                    'leave it out, pin the size, or use sizes = "free"',
                )
        return self

    @model_validator(mode="after")
    def _stays_somewhere(self) -> Recipe:
        if self.stay and not self.layout_file:
            raise RecipeError("stay", "needs an earlier layout (.geojson, .svg or .dxf) as --start")
        return self

    @model_validator(mode="after")
    def _voids_can_be_filled(self) -> Recipe:
        if self.fills_gaps and self.finish == "none":
            raise RecipeError("finish", "none leaves overlaps; voids are filled after an exact one")
        if self.fills_gaps and self.sizes != "free" and not (self.filler or self.words):
            raise RecipeError(
                "filler",
                f"must be given where sizes are {self.sizes}: "
                "smaller copies of the items would not be of their size",
            )
        return self

    def plain(self) -> dict[str, Any]:
        """Values that JSON can hold; a loss given as a function by its name."""
        values = self.model_dump(exclude={"losses", "rules"}, mode="json")
        values["rules"] = [rule.model_dump(mode="json", exclude_none=True) for rule in self.rules]
        named = {
            loss if isinstance(loss, str) else getattr(loss, "__qualname__", repr(loss)): weight
            for loss, weight in self.losses.items()
        }
        return {**values, "losses": named}

    @property
    def canvas_size(self) -> CanvasSize | None:
        """Size of the canvas; None leaves it to the container."""
        return None if self.canvas is None else canvas_size(self.canvas)

    @property
    def rotation(self) -> Rotation:
        """How far items may turn."""
        asked = Rotation.parse(self.rotate)
        return asked if self.words is None else asked.of_words

    @property
    def keeps_apart(self) -> bool:
        """Whether copies of one item are not to lie side by side."""
        return self.apart or bool(self.losses.get("apart"))

    @property
    def layout_file(self) -> str | None:
        """The earlier layout that ``start`` names; None if it names a method."""
        start = self.start or ""
        return start if Path(start).suffix.lower() in LAYOUTS else None

    def padding_cu(self, container: Container) -> float:
        """Gap asked for, in units of the container's canvas."""
        return length_asked("padding", self.padding, container.unit, container.side)

    @property
    def fills_gaps(self) -> bool:
        """Whether smaller copies go into the voids that are left."""
        asked = (self.target_coverage, self.max_items, self.smallest, self.filler)
        return any(option is not None for option in asked)

    def smallest_cu(self, container: Container) -> float:
        """Longer side of the smallest copy put into a void, canvas units."""
        asked = DEFAULT_SMALLEST if self.smallest is None else self.smallest
        return length_asked("smallest", asked, container.unit, container.side)

    def may_press(self, padding_cu: float) -> bool:
        """Whether items may be pressed together for even gaps: else it would cost overlap."""
        return self.sizes == "free" and padding_cu == 0

    def start_options(self) -> StartOptions:
        """Options of the start stage."""
        if self.layout_file:
            return StartOptions()
        method = "distance-field" if self.start is None else self.start
        asked = {"method": method, "coverage": PRESETS[self.preset].coverage}
        try:
            return StartOptions.model_validate(asked)
        except ValidationError as error:
            raise refusal(error, StartOptions, {"method": "start"}) from error

    def solve_options(self, padding_cu: float = 0.0, seconds: float | None = None) -> SolveOptions:
        """Options of the solve stage, of which only the padding depends on the container.

        ``seconds``, if given, bounds the levels in place of epochs.
        """
        changes: dict[str, Any] = {}
        if not any(rule.rotate for rule in self.rules):
            # Where rules turn items each in their own way, the limits of items hold.
            rotation = self.rotation
            changes = {"turn_rate": 0.0} if rotation.is_still else {"turn_limit": rotation.limit}
        preset = PRESETS[self.preset].solve
        if self.levels is not None:
            changes["levels"], changes["shares"] = parse_levels(self.levels)
        losses = {**preset.losses, "apart": APART if self.apart else 0.0, **self.losses}
        if "evenness" not in self.losses and not self.may_press(padding_cu):
            losses.pop("evenness", None)
        changes |= {
            "epochs": self.epochs or EPOCHS[self.effort],
            "seconds": seconds,
            "sizes": self.sizes,
            "size_ratio": self.size_ratio,
            "stretch": self.stretch,
            "losses": {loss: weight for loss, weight in losses.items() if weight},
            "margin": padding_cu / 2,
        }
        return SolveOptions(**{**dict(preset), **changes})


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
    packwork.errors.RecipeError: count: must be at least 1, not 0
    """
    check_names(options)
    try:
        return Recipe.model_validate(options)
    except ValidationError as error:
        raise refusal(error, Recipe) from error

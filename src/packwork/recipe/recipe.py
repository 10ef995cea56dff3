"""Recipe of a run: one validated value composed of the stages' options."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import (
    BeforeValidator,
    Field,
    ValidationInfo,
    field_validator,
    model_validator,
)

from packwork.errors import RecipeError
from packwork.options import NOT_OFFERED, Group, Offer, Verbs
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.format import TableFormat
from packwork.readers.words.options import WordOptions
from packwork.recipe.order import EmbeddingOptions, OrderOptions
from packwork.recipe.pictures import MosaicOptions, PictureOptions, check_no_names, known_palette
from packwork.recipe.piles import MotionOptions
from packwork.recipe.presets import parse_levels
from packwork.recipe.reading import ReadingOptions
from packwork.recipe.refusals import length_of, parsed_by, validated
from packwork.recipe.rules import (
    AUTO,
    MAX_COUNT,
    ItemCount,
    Rotation,
    Rule,
    Turns,
    as_text,
    hero_rule,
    known_rotation,
    some_rules,
    usual_padding,
)
from packwork.recipe.tiles import TileOptions
from packwork.recipe.typed import Hero
from packwork.recipe_paths import check_names
from packwork.solve.options import MAX_STRETCH, ImageLossFunction, OutlineChoice
from packwork.sources import MEMORY
from packwork.start.options import LAYOUTS
from packwork.units import CanvasSize, canvas_size, length_asked, parse_share
from packwork.writers.film.options import FilmOptions

if TYPE_CHECKING:
    from packwork.scene.container import Container

Effort: TypeAlias = Literal["draft", "normal", "best"]

Sizes: TypeAlias = Literal["free", "shared", "fixed", "graded", "auto"]

EPOCHS: dict[str, int] = {"draft": 200, "normal": 800, "best": 6_000}
"""Iterations, never seconds: one seed gives one result. Measured (docs/benchmarks/engine.md)."""

APART = 0.5
"""Weight of the loss that keeps kinds apart. Larger parts more and fills less. Tried."""

MAX_THREADS, MAX_SECONDS = 1_024, 86_400.0
"""Threads of one run, and seconds for it, at most."""

Seconds: TypeAlias = Annotated[float, Field(gt=0, le=MAX_SECONDS, allow_inf_nan=False)]

DEFAULT_SMALLEST = "0.5%"
"""Of the canvas' longer side: 3 px of 600, below which a copy is a speck. Chosen by eye."""

_COLLAGES = Offer(verbs=Verbs.COLLAGES)
_CANVAS = parsed_by(canvas_size)
_PAIR = Offer(takes=str | float | Sequence[float] | None)
_HERO = replace(_COLLAGES, group=Group.ORDER, takes=str | Hero | None)
_LEVELS = Offer(group=Group.SOLVED, verbs=Verbs.LEVELLED)
_SAFE = Offer(group=Group.PRINTED, verbs=Verbs.COLLAGES)
_VOIDS = Offer(group=Group.VOIDS, verbs=Verbs.COLLAGES)
_LOSS = replace(
    _LEVELS, flags="--loss", typed=list[str],
    help="A loss and its weight, in place of the preset's or beside them: NAME=1 or "
    "MODULE:FUNCTION=1; 0 switches one off. May be given several times.",
)  # fmt: skip
_ADDED = Offer(
    verbs=Verbs.WORDS | Verbs.PHOTOS, flags="--add", after="count",
    help="Items that are placed too: files, folders or built-in names; among words each is as "
    "large as a middling one. May be given several times.",
)  # fmt: skip


class Recipe(
    OrderOptions,
    EmbeddingOptions,
    MosaicOptions,
    PictureOptions,
    MotionOptions,
    TileOptions,
    TableFormat,
    ReadingOptions,
):
    """Request of one ``fill``. Lengths in canvas units, angles in degrees."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.EVERY)

    container: Annotated[str, NOT_OFFERED]
    """What to fill: a mask (PNG, JPEG), SVG, text:WORD, around:IMAGE, a built-in name or page."""

    font: Annotated[
        str | None,
        Offer(verbs=Verbs.FILL | Verbs.PHOTOS | Verbs.PILE, after="share", takes=str | Path | None),
    ] = None
    """Font file (TTF, OTF, TTC) or installed family, for a container text:WORD or for words;
    for these also several in turn. Default: a bundled bold sans, others for what it lacks."""

    items: Annotated[tuple[str, ...], _ADDED] = ("builtin:icons",)
    """What to place: SVGs, pictures, folders of them, or built-in names."""

    words: Annotated[WordOptions | None, NOT_OFFERED] = None
    """Words to place: what they are and how they are set (``packwork words``)."""

    chart: Annotated[ChartOptions | None, NOT_OFFERED] = None
    """Rows of a table, a mark for each (``packwork chart``)."""

    count: Annotated[
        ItemCount | None, Offer(verbs=Verbs.EVERY & ~Verbs.CHART, flags="-n --count")
    ] = None
    """How many items in all; the given ones are repeated in turn. Default: one of each.
    Of words: how many at most, those of the largest weights; default 100. auto: as many as it
    takes for the container's shape to show."""

    canvas: Annotated[str | float | None, _CANVAS, _PAIR] = None
    """Longer side of the canvas, as 600 (px, 96 to the inch), 200mm or 8in, or a sheet, as
    200x150mm, A4 (A0 to A6, letter) or A4-landscape. Its unit is that of all results.
    Default: an SVG container in mm, cm, in or pt keeps its size; any other becomes 600 px."""

    seed: Annotated[int, Field(ge=0, le=2**63 - 1), Offer(group=Group.SOLVED)] = 0
    """Same seed, same machine, same versions: same layout."""

    sizes: Annotated[Sizes, _COLLAGES] = "free"
    """free: each item finds its size; shared: all have equal areas, or areas in the shares
    of the weights; fixed: as large as in their files; graded (words alone): in proportion as far
    as there is room, the heaviest first, no word larger than a heavier one; auto (words alone):
    graded where the container is thin or branched, or many words in proportion would leave it bare,
    else shared."""

    size_ratio: Annotated[Annotated[float, Field(ge=1, le=100)] | None, _COLLAGES] = None
    """With free sizes: 2 lets an item be half to twice as large as the typical one. Default: 2; of
    6 icons at most 1.5, of 7 to 59 in between, and with a picture 1.5."""

    stretch: Annotated[
        float, Field(ge=1, le=MAX_STRETCH, allow_inf_nan=False), Offer(verbs=Verbs.FILL)
    ] = 1.0
    """1.5 lets each item become up to 1.5 times as wide for its height as it was drawn, or
    as high for its width, at the same area. 1 keeps all proportions."""

    rotate: Annotated[str, BeforeValidator(known_rotation), Offer(takes=Turns)] = "free"
    """free (words: within 90 degrees, never upside down; fewer than 60 icons: the nearer to upright
    the fewer, unless 180 is asked), none, 30 (within 30 degrees of upright, as upright) or 0,90
    (only these angles); also horizontal, vertical (read upwards), mixed (one in four vertical)."""

    padding: Annotated[str | float, length_of("padding", may_be_zero=True, word=AUTO)] = AUTO
    """Gap between items and to the container's edge: 4 (in the canvas' unit), 1mm, 3pt,
    0.5cm, 0.1in, or 1% of the canvas' longer side; auto: 0.3% of words, 0.2% in charts, 0.4% of
    cropped photos with borders, less of so many; else none but between icons of one colour."""

    margin: Annotated[str | float, length_of("margin", may_be_zero=True), _SAFE] = "0"
    """Free edge of the sheet, in which nothing is placed, a length as for the padding: what a
    printer cannot reach or a frame hides. The container is drawn in as far as it takes."""

    weights: Annotated[
        str | dict[str, float] | None, Offer(verbs=Verbs.FILL | Verbs.PHOTOS | Verbs.PILE)
    ] = None
    """Shares of area, which shared sizes hold: a CSV file of name,weight (in Python a dict too)."""

    hero: Annotated[str | None, parsed_by(hero_rule), _HERO] = None
    """One item larger than the rest and upright: NAME, NAME=30% (its longer side) or
    NAME@50%,40%=30% (where its middle lies, as shares of the canvas' width and height)."""

    palette: Annotated[
        str | tuple[str, ...] | dict[str, str] | None,
        BeforeValidator(known_palette),
        Offer(group=Group.COLOURS, verbs=Verbs.EVERY & ~Verbs.PHOTOS),
    ] = None
    """New colours for items, neighbours unlike: #e63946,#457b9d or okabe-ito, tol-bright,
    tol-vibrant, tol-muted, tol-high-contrast; of the values of a column (--color-by) also by
    name, as bear=red,fox=#457b9d. Photographs keep theirs."""

    apart: Annotated[bool, Offer(group=Group.ORDER, verbs=Verbs.FILL | Verbs.PHOTOS)] = False
    """Keep copies of one item from lying side by side, as far as that goes."""

    rules: Annotated[tuple[Rule, ...], BeforeValidator(some_rules), NOT_OFFERED] = ()
    """What is asked of single items (in Python and recipe files)."""

    holes: Annotated[
        Literal["fill", "keep"], Offer(group=Group.READ, verbs=Verbs.EVERY & ~Verbs.PHOTOS)
    ] = "fill"
    """keep: the holes of items stay free, so that small items may sit in them."""

    outline: Annotated[OutlineChoice, Offer(verbs=Verbs.FILL | Verbs.WORDS, is_flag=False)] = (
        "exact"
    )
    """What an item is taken for while it is placed: exact (its true outline) or hull
    (no item in another's bays). What is measured and written is the true outline."""

    strict: Annotated[
        bool, Offer(group=Group.READ, verbs=Verbs.FILL | Verbs.PHOTOS | Verbs.PILE)
    ] = False
    """Refuse a folder with an unusable file instead of leaving that file out."""

    start: Annotated[str | None, Offer(group=Group.SOLVED, after="levels")] = None
    """How the first places are found: distance-field (into the largest room), medial-axis (along
    the middle line), auto (of these two), scatter (at random), first-fit (where they touch most;
    for words and shared sizes), or a layout (.geojson, .svg, .dxf, .packwork). Default: what
    suits the sizes, of photos the best of distance-field, medial-axis and scatter."""

    finish: Annotated[Literal["exact", "none"], _LEVELS] = "exact"
    """exact: after the levels, items are moved, turned and sized in exact geometry until
    nothing overlaps and nothing sticks out; none: what the levels gave, not certified."""

    target_coverage: Annotated[
        Annotated[float, Field(gt=0, lt=1), BeforeValidator(parse_share)] | None,
        replace(_VOIDS, metavar="SHARE", takes=float | str | None),
    ] = None
    """Share of the container to cover, as 0.94 or 94%: smaller copies are put into the voids,
    round by round, until it is reached or nothing more fits."""

    max_items: Annotated[Annotated[int, Field(ge=1, le=MAX_COUNT)] | None, _VOIDS] = None
    """Put smaller copies into the voids until there are so many items in all (default 1000)."""

    smallest: Annotated[str | float | None, length_of("smallest"), _VOIDS] = None
    """Put smaller copies into the voids, down to this longer side, a length as for the padding
    (default 0.5%). Of words: the least font size; smaller ones are left out and named."""

    filler: Annotated[tuple[str, ...] | None, _VOIDS] = None
    """Items to put into the voids, in place of smaller copies of the items."""

    effort: Annotated[Effort, _LEVELS] = "normal"
    """How many iterations: draft, normal or best."""

    epochs: Annotated[Annotated[int, Field(ge=1, le=1_000_000)] | None, _LEVELS] = None
    """Iterations in all, instead of an effort."""

    time: Annotated[Seconds | None, _LEVELS] = None
    """Seconds for the whole run, in place of iterations: results then depend on the machine."""

    threads: Annotated[
        Annotated[int, Field(ge=1, le=MAX_THREADS)] | None,
        Field(exclude=True),
        Offer(group=Group.SOLVED, after="time"),
    ] = None
    """Threads that the run may use; default: as many as there are cores for it. The result is the
    same with any number; 1 where several runs share a machine."""

    preset: Annotated[Literal["default", "paper"], Offer(group=Group.SOLVED, verbs=Verbs.FILL)] = (
        "default"
    )
    """Losses, weights and steps: default, or paper (as published by Wang and Lu, 2025)."""

    levels: Annotated[
        str | None,
        BeforeValidator(as_text),
        parsed_by(parse_levels),
        replace(_LEVELS, takes=str | int | tuple[int, ...] | None),
    ] = None
    """Resolutions from coarse to fine, pixels on the longer side, each with its share of
    the epochs, as 50:9,200:23,600:68 (the default); without shares, as 50,200,600 (the
    paper's), they are even."""

    losses: Annotated[dict[str | ImageLossFunction, float], _LOSS] = Field(default_factory=dict)
    """Weights of losses, by name, module:function or (in Python) as functions: in place of
    the preset's, or beside them; 0 switches one off."""

    film: Annotated[FilmOptions | None, NOT_OFFERED] = None
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
    def _colours_have_names(self) -> Recipe:
        by = None if self.words is None else self.words.color_by
        if self.chart is None and (not isinstance(by, str) or by == "weight"):
            check_no_names(self.palette)
        return self

    @model_validator(mode="after")
    def _sizes_suit(self) -> Recipe:
        if self.sizes in {"graded", "auto"} and self.words is None:
            raise RecipeError("sizes", f"{self.sizes} is for words; use free, shared or fixed")
        return self

    @model_validator(mode="after")
    def _stays_somewhere(self) -> Recipe:
        if self.stay and not self.layout_file:
            raise RecipeError(
                "stay", "needs an earlier layout (.geojson, .svg, .dxf or .packwork) as --start"
            )
        return self

    @model_validator(mode="after")
    def _voids_can_be_filled(self) -> Recipe:
        if self.fills_gaps and self.finish == "none":
            raise RecipeError("finish", "none leaves overlaps; voids are filled after an exact one")
        if self.fills_gaps and self.sizes != "free" and not (self.filler or self.words):
            asked = ("target_coverage", "max_items", "smallest", "filler")
            raise RecipeError(
                next(key for key in asked if getattr(self, key) is not None),
                f"adds smaller copies, though sizes are {self.sizes}; name other items as --filler",
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
        """Range in which items may turn."""
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
        return start if start.startswith(MEMORY) or Path(start).suffix.lower() in LAYOUTS else None

    def padding_cu(self, container: Container) -> float:
        """Gap asked for, in units of the container's canvas."""
        asked = usual_padding(vars(self)) if self.padding == AUTO else self.padding
        return length_asked("padding", asked, container.unit, container.side)

    @property
    def fills_gaps(self) -> bool:
        """Whether smaller copies go into the voids that are left."""
        asked = (self.target_coverage, self.max_items, self.smallest, self.filler)
        return any(option is not None for option in asked)

    def smallest_cu(self, container: Container) -> float:
        """Longer side of the smallest copy put into a void, canvas units."""
        asked = self.smallest or DEFAULT_SMALLEST
        return length_asked("smallest", asked, container.unit, container.side)


def make_recipe(**options: Any) -> Recipe:
    """Recipe from plain values.

    Examples
    --------
    >>> make_recipe(container="heart", count=0)
    Traceback (most recent call last):
    packwork.errors.RecipeError: count: must be at least 1, not 0
    """
    check_names(options)
    return validated(Recipe, options)

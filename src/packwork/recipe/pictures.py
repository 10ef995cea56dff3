"""Options of photographs, of pictures behind, and of a picture that a layout shows from afar."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Literal, TypeAlias

from pydantic import BeforeValidator, Field, field_validator, model_validator

from packwork.errors import RecipeError
from packwork.options import Group, Offer, Options, Verbs
from packwork.readers.photo_options import PhotoOptions
from packwork.units import parse_share


class MosaicOptions(Options):
    """The picture that a layout shows from afar, and how."""

    offers = Offer(group=Group.COLOURS, verbs=Verbs.COLLAGES)

    picture: Annotated[str | None, Offer(metavar="FILE", after="palette", flags="--picture")] = None
    """A picture that the layout shows from afar: items take on its colours (--tint), photos come
    to lie where theirs fit best. It covers the container's box."""

    tint: Annotated[
        Annotated[float, Field(ge=0, le=1), BeforeValidator(parse_share)] | None,
        Offer(metavar="SHARE", after="picture", takes=float | str | None),
    ] = None
    """How far items take on the colours of --picture, as 0.3 or 30%; 0 leaves theirs, and puts each
    where they fit best. Default: 0 of photos, 100% of all else."""

    detail: Annotated[
        Annotated[float, Field(ge=0, le=1), BeforeValidator(parse_share)] | None,
        Offer(metavar="SHARE", after="tint", takes=float | str | None),
    ] = None
    """How far sizes follow --picture, as 0.5 or 50%: small items where it has much to show, large
    ones where it has little. Only with --sizes free. Default: 50%, of photos 0."""

    ground: Annotated[str | None, Offer(metavar="COLOR", after="detail")] = None
    """Colour of the gaps, which the colours of --picture make up for. Default: that of
    --background, else the one that shows the picture best, which then is the background."""

    grid: Annotated[bool, Offer(verbs=Verbs.PHOTOS, after="ground")] = False
    """Lay photos as squares in rows, -n of them (1,500 unless given), each where its colours and
    its structure show --picture best. They repeat, and keep apart."""

    repeats: Annotated[
        Annotated[int, Field(ge=1)] | None, Offer(verbs=Verbs.PHOTOS, after="grid")
    ] = None
    """With --grid: how often one photo may be used. Default: twice as often as it takes."""

    @field_validator("ground")
    @classmethod
    def _is_a_colour(cls, value: str | None) -> str | None:
        if value is not None:
            # Loads the picture library, which the command line's help can do without.
            from packwork.scene.colour import parse_colour

            if parse_colour("ground", value)[3] < 255:
                raise RecipeError("ground", f"{value!r} is clear; use a solid colour")
        return value

    @model_validator(mode="after")
    def _of_a_picture(self) -> MosaicOptions:
        for key in ("tint", "detail", "ground", "grid", "repeats"):
            if self.picture is None and getattr(self, key) not in {None, False}:
                raise RecipeError(key, "is of --picture; say which picture is shown")
        if self.repeats is not None and not self.grid:
            raise RecipeError("repeats", "is of --grid; photos that lie freely are repeated by -n")
        return self


_EXAMPLE = "use shares such as words=50%,photos=30%,items=20%"

KINDS = ("words", "photos", "items")
"""What can be mixed in one layout."""


def share_of_kinds(value: object) -> dict[str, float]:
    """Shares by kind, of ``words=50%,items=50%`` or a table of numbers.

    Examples
    --------
    >>> share_of_kinds("words=70%, items=30%"), share_of_kinds({"photos": 2, "items": 1})
    ({'words': 70.0, 'items': 30.0}, {'photos': 2.0, 'items': 1.0})
    """
    if isinstance(value, str):
        value = dict(part.strip().partition("=")[::2] for part in value.split(","))
    if not isinstance(value, Mapping) or not value:
        raise RecipeError("share", f"{_EXAMPLE}, not {str(value)[:40]!r}")
    shares: dict[str, float] = {}
    for kind, text in value.items():
        try:
            part = float(str(text).strip().removesuffix("%"))
        except ValueError:
            part = math.nan
        if kind not in KINDS or not 0 < part < math.inf:
            raise RecipeError("share", f"{_EXAMPLE}, not {f'{kind}={text}'[:40]!r}")
        shares[kind] = part
    return shares


def known_palette(value: object) -> object:
    """The same value, refused unless it is a palette, colours or None; of names a dict."""
    if value is not None:
        # Loads the picture library, which the command line's help can do without.
        from packwork.scene.palette import colours_by_name, palette_colours

        try:
            if (named := colours_by_name(value)) is not None:
                return named
            palette_colours(value)
        except ValueError as error:
            raise RecipeError("palette", str(error)) from None
    return value


def check_no_names(palette: object) -> None:
    """Refuse a palette that gives colours to names, which only the values of a column have."""
    if isinstance(palette, Mapping):
        raise RecipeError(
            "palette",
            "gives colours to names, which the values of a column have (--color-by COL of charts "
            "and words); give a list, as red,#457b9d",
        )


Shades: TypeAlias = Literal["tint", "nearest", "keep"]
"""What a palette does to drawings of several colours."""


_ADDED = Offer(
    verbs=Verbs.WORDS, typed=list[str], after="items",
    help="Photos that are placed too: files, folders or patterns. May be given several times.",
)  # fmt: skip


class PictureOptions(Options):
    """Photographs that are placed, the picture round which items are, and what a palette does."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.COLLAGES)

    shades: Annotated[
        Shades,
        Offer(group=Group.COLOURS, verbs=Verbs.FILL | Verbs.PILE, after="palette", is_flag=False),
    ] = "tint"
    """What --palette does to drawings of several colours: tint (each in the tints and shades of one
    colour, by lightness), nearest (each of their colours becomes the palette's nearest) or keep
    (they keep their own, as among words)."""

    photos: Annotated[PhotoOptions | None, _ADDED] = None
    """Photographs to place: which, and what becomes of their edges (``packwork photos``)."""

    least_dpi: Annotated[
        Annotated[float, Field(gt=0, le=10_000)] | None,
        Offer(verbs=Verbs.FILL | Verbs.PHOTOS, after="weights"),
    ] = None
    """Enlarge no picture beyond so many of its own pixels to the inch: those of few pixels stay
    small. Default: pictures are as large as suits the layout."""

    quiet_share: Annotated[
        float,
        Field(ge=0.02, le=0.98),
        BeforeValidator(parse_share),
        Offer(metavar="SHARE", after="canvas", takes=float | str),
    ] = 0.4
    """Of a container around:IMAGE: the share of the picture that is filled, as 0.4 or 40%: that
    in which least is to be seen."""

    keep_clear: Annotated[
        tuple[str, ...] | None,
        Offer(after="quiet_share", takes=str | tuple[str, ...] | None),
    ] = None
    """Of a container around:IMAGE: what is left free in any case, a mask (dark is kept clear) or
    a box left,top,width,height such as 10%,20%,30%,30%."""

    share: Annotated[
        dict[str, float] | None,
        Offer(
            verbs=Verbs.WORDS | Verbs.PHOTOS,
            typed=str,
            after="photos",
            takes=str | dict[str, float | str] | None,
        ),
    ] = None
    """Shares of the area where words, photos and other items are mixed:
    words=50%,photos=30%,items=20%."""

    @field_validator("share", mode="before")
    @classmethod
    def _shares_are_of_kinds(cls, value: object) -> object:
        return None if value is None else share_of_kinds(value)

    @field_validator("keep_clear", mode="before")
    @classmethod
    def _one_is_enough(cls, value: object) -> object:
        return (value,) if isinstance(value, str) else value

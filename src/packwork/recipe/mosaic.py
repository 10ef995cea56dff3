"""Options of a picture that a layout shows from afar: a part of the recipe."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, Field, field_validator, model_validator

from packwork.errors import RecipeError
from packwork.offers import Group, Offer, Verbs
from packwork.options import Options
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
        for key in ("tint", "detail", "ground"):
            if self.picture is None and getattr(self, key) is not None:
                raise RecipeError(key, "is of --picture; say which picture is shown")
        return self

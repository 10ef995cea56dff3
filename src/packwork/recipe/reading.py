"""Options of reading files of containers and items: a part of the recipe."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, field_validator

from packwork.errors import RecipeError
from packwork.options import Group, Offer, Options, Verbs
from packwork.readers.options import GAPS_AUTO, GAPS_NONE, HALF, ReadOptions
from packwork.units import length_asked


class ReadingOptions(Options):
    """Meaning of files where they do not say it themselves."""

    offers = Offer(group=Group.READ, verbs=Verbs.EVERY)

    trim: bool | None = None
    """Leave out the page round a container's drawing (an SVG or a mask), or keep it. Default: left
    out where the drawing takes less than a third of it across and down, but a page in mm, cm, in
    or pt is kept. Items are their drawings in any case."""

    keep_page: Annotated[bool | None, Offer(flags="--keep-page/--drop-page")] = None
    """Whether the white page behind an item's drawing, or the plain background of a picture, is
    part of it. Default: left out where it looks like a page (nothing on it touches its edges, and
    most files of the same folder do not fill theirs)."""

    close_gaps: Annotated[str, Offer(takes=str | float)] = GAPS_AUTO
    """Slits of a container that are closed, as between the states of a map: auto (up to 0.2% of
    its extent), none, or their width, a length as for the padding."""

    alpha_threshold: Annotated[float, Field(gt=0, lt=1)] = HALF
    """Opacity from which the paint of a picture belongs to its outline, as a share of its most
    opaque pixel: smaller takes soft shadows in, larger leaves more of soft edges out."""

    items_from: Annotated[
        Literal["seed", "first"], Offer(verbs=Verbs.FILL | Verbs.PHOTOS | Verbs.PILE)
    ] = "seed"
    """Where folders hold more items than the count: seed draws from all of them, first takes the
    first by name. No others are read, unless weights, vectors or a picture speak of all."""

    stroke_width: Annotated[
        Literal["scaled", "even"], Offer(verbs=Verbs.FILL | Verbs.WORDS | Verbs.PILE)
    ] = "scaled"
    """Lines of items that are drawn in lines, as line icons: scaled (as wide as their sizes make
    them) or even (alike on all of them: of larger ones thinner, before items grow together)."""

    @field_validator("close_gaps", mode="before")
    @classmethod
    def _gaps_have_a_width(cls, value: object) -> object:
        text = str(value)
        if text not in (GAPS_AUTO, GAPS_NONE) and length_asked("close_gaps", text, "px", 1.0) < 0:
            raise RecipeError("close_gaps", f"must be auto, none or a width, not {text[:40]!r}")
        return text

    @property
    def read_options(self) -> ReadOptions:
        """The same, for the readers."""
        return ReadOptions(self.trim, self.close_gaps, self.keep_page, self.alpha_threshold)

"""Options of moving items: forces, piles, staying near an earlier layout."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, TypeAlias, get_args

from pydantic import BeforeValidator, Field, model_validator

from packwork.errors import RecipeError
from packwork.forces.spec import ForceTexts, is_pair
from packwork.options import NOT_OFFERED, Group, Offer, Options, Verbs
from packwork.recipe.refusals import length_of, one_or_more, parsed_by
from packwork.recipe.typed import Force
from packwork.recipe_paths import split_words

Side: TypeAlias = Literal["top", "bottom", "left", "right"]
"""Where a container is open."""


@dataclass(frozen=True)
class Emitter:
    """Source of items, as it was written.

    Parameters
    ----------
    side
        An edge of the canvas; None for none.
    points
        Pairs ``X,Y`` of lengths: a point, or the corners of a line.
    file
        Of a drawn curve; None for none.
    region
        File or built-in name; None for none.
    """

    side: Side | None = None
    points: tuple[str, ...] = ()
    file: str | None = None
    region: str | None = None


def parse_emitter(text: str) -> Emitter:
    """Emitter of its text.

    Examples
    --------
    >>> parse_emitter("top").side, parse_emitter("10%,0 90%,0").points
    ('top', ('10%,0', '90%,0'))
    """
    words = split_words(text)
    side = next((side for side in get_args(Side) if words == [side]), None)
    if side is not None:
        return Emitter(side=side)
    if len(words) == 2 and words[0] == "in":
        return Emitter(region=words[1])
    if len(words) == 1 and words[0].lower().endswith(".svg"):
        return Emitter(file=words[0])
    if words and all(map(is_pair, words)):
        return Emitter(points=tuple(words))
    raise RecipeError(
        "emit",
        f"use top, bottom, left, right, X,Y, X,Y X,Y, FILE.svg or in NAME, not {text[:60]!r}",
    )


class PileOptions(Options):
    """Piles of items of given sizes."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.PILE)

    open: Annotated[
        tuple[Side, ...], BeforeValidator(one_or_more), Offer(takes=Side | tuple[Side, ...])
    ] = ()
    """Take the lid off on that side (top, bottom, left or right): items come in through it and
    may heap up beyond it, to the canvas' edge. May be given several times."""

    size: Annotated[str | float | None, length_of("size")] = None
    """Longer side of each item, a length as for the padding; with weights, of one of weight 1.
    Default: in the proportions of their files, and so large that all find room and the pile is
    about two thirds high; without a container as large as in their files."""

    emit: Annotated[str | None, parsed_by(parse_emitter)] = None
    """Where items come from: top, bottom, left, right (that edge of the canvas), X,Y (a point),
    X,Y X,Y (a line), FILE.svg (a drawn curve) or in NAME (a region: a file or a built-in
    name). Default: each begins at its lowest free place."""

    release: Annotated[int, Field(ge=0, le=1_000)] = 0
    """With --emit: rounds between one item and the next, so that they pour; 0 lets all begin
    at once."""

    compact: bool = False
    """Report how tight the pile is: shares of its hull, its smallest circle and its box."""

    @model_validator(mode="after")
    def _released_from_somewhere(self) -> PileOptions:
        if self.release and self.emit is None:
            raise RecipeError("release", "says when items come, so --emit must say from where")
        return self


class MotionOptions(Options):
    """The part of a recipe that says how items move."""

    offers = Offer(group=Group.PLACED)

    force: Annotated[
        ForceTexts,
        Offer(
            group=Group.ORDER,
            verbs=Verbs.FILL | Verbs.WORDS | Verbs.PILE,
            after="hero",
            takes=str | Force | tuple[str | Force, ...] | None,
        ),
    ] = None
    """Pull items about: down, up, left, right, 30deg, towards PLACE, away PLACE, inward, align,
    balance or together; docs/guide/forces.md has all. May be given several times."""

    pile: Annotated[PileOptions | None, NOT_OFFERED] = None
    """Items of given sizes, heaped by forces (``packwork pile``)."""

    stay: Annotated[
        bool, Offer(group=Group.SOLVED, verbs=Verbs.FILL | Verbs.WORDS, after="start")
    ] = False
    """With --start LAYOUT: items stay as near to where they were as the result allows. They are
    told by their names; new ones go into voids, and those no longer asked for leave."""

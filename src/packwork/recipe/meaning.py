"""Options of the meaning of items: a part of the recipe."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated

from pydantic import field_validator, model_validator

from packwork.errors import RecipeError
from packwork.forces.spec import DIRECTIONS
from packwork.offers import Group, Offer, Verbs
from packwork.options import Options
from packwork.units import NUMBER

FROM_TEXT = "auto"
"""Stands for vectors that are made from the text of the words."""

MIDDLE = "middle"
"""Where an anchor lies that is no direction."""

_DEGREES = re.compile(rf"({NUMBER})(?:deg|°)")


@dataclass(frozen=True)
class Anchor:
    """A direction or the middle, and what is drawn there.

    Parameters
    ----------
    angle
        Of the direction, degrees clockwise from the right; None for the middle.
    name
        Of a row or a column of the vectors, or a word of the text.
    """

    angle: float | None
    name: str


def parse_anchor(text: str) -> Anchor:
    """Anchor of its text.

    Raises
    ------
    RecipeError
        About ``anchors``: what is wrong, what was met, what would do.

    Examples
    --------
    >>> parse_anchor("left=warm"), parse_anchor("middle = sun").angle
    (Anchor(angle=180.0, name='warm'), None)
    """
    where, _, name = (part.strip() for part in text.partition("="))
    degrees = _DEGREES.fullmatch(where)
    if not degrees and where not in DIRECTIONS and where != MIDDLE:
        known = ", ".join((*DIRECTIONS, "45deg", MIDDLE))
        raise RecipeError("anchors", f"nothing lies {where[:40]!r}; use {known}, as in left=warm")
    if not name:
        raise RecipeError("anchors", f"{text[:60]!r} names nothing; write it as left=warm")
    if where == MIDDLE:
        return Anchor(None, name)
    return Anchor(float(degrees.group(1)) % 360 if degrees else DIRECTIONS[where], name)


class EmbeddingOptions(Options):
    """Likeness of items that come to lie together."""

    offers = Offer(group=Group.ORDER, verbs=Verbs.COLLAGES)

    embeddings: Annotated[
        str | None, Offer(metavar="FILE|auto", after="arrange", flags="--embeddings")
    ] = None
    """Vectors of the items (.npy, .csv, .tsv, .json, .parquet; a row an item, or a first column of
    names): those with like ones come to lie together. auto: of words, by which of them stand near
    each other in the text."""

    anchors: Annotated[
        tuple[str, ...],
        Offer(metavar="WHERE=NAME", after="embeddings", takes=str | tuple[str, ...]),
    ] = ()
    """With --embeddings: where things lie that are like a row, a column or a word, as left=warm;
    also right, up, down, 45deg, middle. May be given several times."""

    label_regions: Annotated[bool, Offer(after="anchors")] = False
    """Write names among the items, on small plates that are placed as items are: of groups, where
    the table of --embeddings has a column of texts beside the names; else of the parts of an SVG
    as the container that have titles or ids."""

    @field_validator("anchors", mode="before")
    @classmethod
    def _one_anchor_is_enough(cls, value: object) -> object:
        return (value,) if isinstance(value, str) else value or ()

    @field_validator("anchors")
    @classmethod
    def _anchors_are_known(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        for text in value:
            parse_anchor(text)
        return value

    @model_validator(mode="after")
    def _anchors_of_vectors(self) -> EmbeddingOptions:
        if self.anchors and self.embeddings is None:
            raise RecipeError("anchors", "are of vectors; say which: --embeddings FILE or auto")
        return self

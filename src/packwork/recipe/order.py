"""Options of the order in which items lie, and of likeness that brings them together."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated

from pydantic import BeforeValidator, model_validator

from packwork.errors import RecipeError
from packwork.forces.spec import DIRECTIONS
from packwork.options import Group, Offer, Options, Verbs
from packwork.phrasing import meant
from packwork.recipe.refusals import one_or_more, parsed_by
from packwork.recipe.typed import Anchor
from packwork.recipe_paths import split_words
from packwork.units import NUMBER

WAYS = (*DIRECTIONS, "outwards", "inwards", "around", "along")
"""Ways along which items may be put in order, beside angles such as 45deg."""

MEASURES = ("weight", "hue", "lightness", "name")
"""What items may be put in order by, beside the numbers of a file."""

FILES = (".csv", ".tsv", ".xlsx", ".json")
"""Endings of files of numbers."""

_DEGREES = re.compile(rf"({NUMBER})(?:deg|°)")
_EXAMPLE = "use a way and a measure, as in right by=weight, outwards by=ages.csv or around by=hue"


@dataclass(frozen=True)
class Ordering:
    """An order of items, as it was written.

    Parameters
    ----------
    way
        right, outwards, inwards, around or along; right is the direction of ``angle``.
    by
        weight, hue, lightness, name, a file, or a column of the words' table.
    angle
        Of a direction, degrees clockwise from the right.
    """

    way: str
    by: str
    angle: float = 0.0


def parse_arrangement(text: str) -> Ordering:
    """Arrangement of its text.

    Examples
    --------
    >>> parse_arrangement("down by=weight")
    Ordering(way='right', by='weight', angle=90.0)
    >>> parse_arrangement("hue").way, parse_arrangement("outwards").by
    ('around', 'weight')
    """
    words = split_words(text)
    measures = [word.partition("=")[2].strip('"') for word in words if word.startswith("by=")]
    said = [word.lower() for word in words if not word.startswith("by=")]
    if said and said[-1] in MEASURES:
        measures.append(said.pop())
    if len(said) > 1 or len(measures) > 1 or not words:
        raise RecipeError("arrange", f"{_EXAMPLE}, not {text[:60]!r}")
    by = _measure(measures[0]) if measures else "weight"
    way = said[0] if said else ("around" if by == "hue" else "right")
    degrees = _DEGREES.fullmatch(way)
    if degrees or way in DIRECTIONS:
        angle = float(degrees.group(1)) if degrees else DIRECTIONS[way]
        return Ordering("right", by, angle % 360.0)
    if way not in WAYS:
        raise RecipeError("arrange", f"there is no way {way[:40]!r}; {_meant(way, WAYS)}")
    return Ordering(way, by)


def _measure(by: str) -> str:
    if not by:
        raise RecipeError("arrange", f"{_EXAMPLE}; by= names nothing")
    return by


def unknown_measure(by: str, columns: str = "") -> RecipeError:
    """Error about a measure that items do not have.

    Parameters
    ----------
    columns
        Of their table, which would do.

    Examples
    --------
    >>> print(unknown_measure("hight", "year"))  # doctest: +ELLIPSIS
    arrange: nothing is measured by 'hight'; did you mean weight?, a column (year), or a file of ...
    """
    hint = _meant(by, MEASURES)
    others = f"{hint}, a column ({columns})," if columns else f"{hint},"
    return RecipeError(
        "arrange", f"nothing is measured by {by[:40]!r}; {others} or a file of name,number (.csv)"
    )


def _meant(word: str, known: tuple[str, ...]) -> str:
    return meant(word, known) or f"use {', '.join(known)}"


class OrderOptions(Options):
    """In which order items lie."""

    offers = Offer(group=Group.ORDER, verbs=Verbs.COLLAGES)

    arrange: Annotated[
        str | None, parsed_by(parse_arrangement), Offer(metavar="WAY", after="ground")
    ] = None
    """In which order items lie: a way (right, left, down, up, 45deg, outwards or inwards from the
    middle, around it, or along the container from end to end) and what rises along it, as in
    right by=weight, outwards by=ages.csv (lines of name,number), around by=hue; also lightness
    and name, and of words a column of their table."""


FROM_TEXT = "auto"
"""Stands for vectors that are made from the text of the words."""

MIDDLE = "middle"
"""Where an anchor lies that is no direction."""


@dataclass(frozen=True)
class AnchorSpec:
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


def parse_anchor(text: str) -> AnchorSpec:
    """Anchor of its text.

    Examples
    --------
    >>> parse_anchor("left=warm"), parse_anchor("middle = sun").angle
    (AnchorSpec(angle=180.0, name='warm'), None)
    """
    where, _, name = (part.strip() for part in text.partition("="))
    degrees = _DEGREES.fullmatch(where)
    if not degrees and where not in DIRECTIONS and where != MIDDLE:
        known = ", ".join((*DIRECTIONS, "45deg", MIDDLE))
        raise RecipeError("anchors", f"nothing lies {where[:40]!r}; use {known}, as in left=warm")
    if not name:
        raise RecipeError("anchors", f"{text[:60]!r} names nothing; write it as left=warm")
    if where == MIDDLE:
        return AnchorSpec(None, name)
    return AnchorSpec(float(degrees.group(1)) % 360 if degrees else DIRECTIONS[where], name)


class EmbeddingOptions(Options):
    """Likeness of items that come to lie together."""

    offers = Offer(group=Group.ORDER, verbs=Verbs.COLLAGES)

    embeddings: Annotated[
        str | None, Offer(metavar="FILE|auto", after="arrange", flags="--embeddings")
    ] = None
    """Vectors of the items (.npy, .csv, .xlsx, .json, .parquet; a row an item, or a first column of
    names): those with like ones come to lie together. auto: of words, by which of them stand near
    each other in the text."""

    anchors: Annotated[
        tuple[str, ...],
        BeforeValidator(one_or_more),
        parsed_by(lambda texts: [parse_anchor(text) for text in texts]),
        Offer(
            metavar="WHERE=NAME",
            after="embeddings",
            takes=str | Anchor | tuple[str | Anchor, ...],
        ),
    ] = ()
    """With --embeddings: where things lie that are like a row, a column or a word, as left=warm;
    also right, up, down, 45deg, middle. May be given several times."""

    label_regions: Annotated[bool, Offer(after="anchors")] = False
    """Write names among the items, on small plates that are placed as items are: of groups, where
    the table of --embeddings has a column of texts beside the names; else of the parts of an SVG
    as the container that have titles or ids."""

    @model_validator(mode="after")
    def _anchors_of_vectors(self) -> EmbeddingOptions:
        if self.anchors and self.embeddings is None:
            raise RecipeError("anchors", "are of vectors; say which: --embeddings FILE or auto")
        return self

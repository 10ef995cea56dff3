"""One thing to be placed: an outline, an appearance, and what is known of it."""

from __future__ import annotations

import base64
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any, Protocol, TypeAlias
from urllib.parse import urlsplit

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError, ShapeError
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.outline import Outline, OutlineLike
from packwork.scene.pose import Poses


@dataclass(frozen=True, eq=False)
class Datum:
    """Row and number behind one mark.

    ``row``: cells by column, as they were read.
    ``value``: what the mark stands for: in the unit of the size column, or a number of rows. The
    marks of one row add up to it.
    ``category``: what its colour says; empty where colours are numbers or say nothing.
    ``group``: which group it is in; empty where there are none.
    """

    row: Mapping[str, Any]
    value: float
    category: str = ""
    group: str = ""


@dataclass(frozen=True, eq=False)
class RowLabel:
    """Label of a row in the index of a data frame of geometries.

    ``label``: as the index has it: of several levels a tuple.
    ``names``: of the levels, None for one without a name.
    """

    label: Any
    names: tuple[Any, ...] = (None,)


SCHEMES = ("", "http", "https", "mailto")
"""Where a link may lead; the first stands for addresses relative to the file."""

MAX_LENGTH = 2_000
"""Characters of a name, a title or a link. Chosen: what browsers take as an address."""

_UNSEEN = re.compile(r"[\x00-\x20\x7f-\xa0\u2028\u2029\\]")
"""What no address holds; browsers pass over some of it, even inside ``java script:``."""


@dataclass(frozen=True)
class Label:
    """Name, link and tooltip of one placed item; empty where there is none.

    ``name``: what it is called in the file.
    ``link``: where a click leads: http, https, mailto, or relative to the file.
    ``title``: what is shown when a pointer rests on it.

    Raises ``RecipeError`` under the field's name, if a text is too long or a link leads elsewhere.

    Examples
    --------
    >>> Label(link="javascript:alert(1)")
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: link: must begin with http:, https: or mailto:, or be relative,
    not 'javascript:alert(1)'
    """

    name: str = ""
    link: str = ""
    title: str = ""

    def __post_init__(self) -> None:
        for key in ("name", "link", "title"):
            if len(getattr(self, key)) > MAX_LENGTH:
                raise RecipeError(key, f"may have {MAX_LENGTH} characters, not more")
        if not _is_sound(self.link):
            raise RecipeError(
                "link",
                f"must begin with http:, https: or mailto:, or be relative, not {self.link[:60]!r}",
            )


def _is_sound(link: str) -> bool:
    if _UNSEEN.search(link):
        return False
    try:
        return urlsplit(link).scheme in SCHEMES
    except ValueError:  # such as an unfinished [address]
        return False


@dataclass(frozen=True, eq=False)
class FontFile:
    """One face of a font, as its file holds it.

    ``index``: which face of a collection.
    ``weight``: where its weight axis is held; None if it has none, or stands at its default.
    """

    data: bytes
    name: str
    index: int = 0
    weight: float | None = None


@dataclass(frozen=True, eq=False)
class TextRun:
    """Characters of one font and one direction.

    ``text``: in the order in which it is read.
    ``font``: that draws it.
    ``x``, ``y``: where its base line begins, at its left end whatever its direction; units of the
    text, y down.
    ``size``: height of an em, in the same units.
    ``steps``: where each glyph's origin stands, from the left, as shares of an em.
    ``advance``: from the left end to the right one, as a share of an em.
    ``is_leftward``: whether it is read from right to left; ``angle``: turn about its left end.
    """

    text: str
    font: FontFile
    x: float
    y: float
    size: float
    steps: tuple[float, ...]
    advance: float
    is_leftward: bool = False
    angle: float = 0.0


@dataclass(frozen=True, eq=False)
class LiveText:
    """Text of a word, beside the curves that draw it.

    ``runs``: in the order in which they are read; in the units of the word's markup.
    ``path``: SVG path data of the same letters, filled non-zero, in the same units.
    ``language``: as in ``lang``; empty if it is not known.
    """

    runs: tuple[TextRun, ...]
    path: str
    language: str = ""


@dataclass(frozen=True)
class FlatArt:
    """The item is its ink, filled with one colour (any CSS colour)."""

    fill: str = "#4a5568"


@dataclass(frozen=True, eq=False)
class VectorArt:
    """An SVG fragment that has been through the gate.

    ``markup``: well-formed elements, fit to stand inside one ``<g>`` of any SVG document: ids,
    references and style rules are scoped so that two fragments never meet, and nothing in it
    reaches outside the document.
    ``matrix``: 2 x 3 map from the fragment's user units to the item's own units.
    ``is_traced``: whether only a rendering tells what it covers, not its shapes.
    """

    markup: str
    matrix: FloatArray
    is_traced: bool = False


@dataclass(frozen=True, eq=False)
class PictureArt:
    """Pixels with transparency.

    ``png``: a complete PNG file (RGBA).
    ``width``, ``height``: its size in pixels.
    ``matrix``: 2 x 3 map from its pixels (x right, y down) to the item's own units.
    ``is_traced``: whether the outline is another one than where its opacity passes one half.
    """

    png: bytes
    width: int
    height: int
    matrix: FloatArray
    is_traced: bool = False

    @property
    def markup(self) -> str:
        """The picture as an SVG element, in units that ``matrix`` maps."""
        data = base64.b64encode(self.png).decode("ascii")
        return (
            f'<image width="{self.width}" height="{self.height}" preserveAspectRatio="none"'
            f' xlink:href="data:image/png;base64,{data}"/>'
        )


class Original(Protocol):
    """A photograph on disk, opened anew each time it is printed."""

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photograph with that many pixels per item unit, never more than it has."""


@dataclass(frozen=True, eq=False)
class PhotoArt:
    """A photograph of which only a small copy is kept.

    ``preview``: the small copy, for screens.
    ``original``: where a writer gets as many pixels as the print needs.
    ``crop``: how much of it the frame shows; None for all.
    """

    preview: VectorArt
    original: Original
    crop: Crop | None = None


@dataclass(frozen=True, eq=False)
class Crop:
    """Part of a photograph that its frame shows.

    ``whole``: the photograph as it was before.
    ``zoom``: how many times as large it is in its frame, 1 at least.
    ``x``, ``y``: of its middle from the frame's, in widths and heights of the frame.
    """

    whole: PhotoArt
    zoom: float
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class Parts:
    """Items that a group is made of; none of them is a group.

    ``poses``: where they lie in its units; ``weights``: ``(m,)`` that they had by themselves.
    """

    items: tuple[Item, ...]
    poses: Poses
    weights: FloatArray


Art: TypeAlias = FlatArt | VectorArt | PictureArt | PhotoArt

_PLAIN, _UNLABELLED = FlatArt(), Label()


@dataclass(frozen=True, eq=False, init=False)
class Item:
    """One thing to be placed.

    What is given is brought into form: a Shapely polygon or a ring of points is an outline, a
    colour is an art. An outline off its centroid is moved there when the item is placed.

    Parameters
    ----------
    name
        What people call it: the file's stem or the built-in's name.
    source
        Where it came from, as the user gave it.
    outline
        The region that must not overlap: the silhouette, or with its holes where they are kept. In
        the item's own units, y down, centroid at the origin (where it was, if lines got thinner).
    ink
        What is really drawn, holes and gaps taken off; same units and origin. Unless given,
        the outline.
    art
        How it is drawn: an art, or any CSS colour.
    label
        What this one is called in a file, where it links to, its tooltip.
    text
        What it says, if it is a word; its art then draws these letters and nothing else.
    halo
        Colour of a rim that makes it stand out from a picture behind; empty for none. It is
        no part of the item, and is drawn under all.
    datum
        What it stands for, if it is a mark of a chart.
    weight
        Share of area it asks for, where nothing else says one.
    row
        Which row of a data frame it came from, in memory only; None of all else.
    own_art
        How it was drawn before another colour was put on it; None if none was.
    parts
        Of a group the items that it is made of; None of any other.
    coarseness
        Distance that its curves keep to its outline at most, over ``FLATTENING`` of its extent.

    Raises
    ------
    ShapeError
        If the outline has no area, or the art is no colour.

    Examples
    --------
    >>> tile = Item("tile", outline=[(0, 0), (4, 0), (4, 2), (0, 2)], art="teal", weight=3)
    >>> tile.outline.area, tile.art
    (8.0, FlatArt(fill='teal'))
    """

    name: str
    source: str
    outline: Outline
    ink: Outline
    art: Art
    label: Label
    text: LiveText | None
    halo: str
    datum: Datum | None
    weight: float = 1.0  # of those kept on disk, too
    row: RowLabel | None = None
    own_art: Art | None = None
    parts: Parts | None = None
    coarseness: float = 1.0

    def __init__(
        self,
        name: str,
        source: str = "",
        outline: OutlineLike | None = None,
        ink: OutlineLike | None = None,
        art: Art | str = _PLAIN,
        label: Label = _UNLABELLED,
        text: LiveText | None = None,
        halo: str = "",
        datum: Datum | None = None,
        weight: float = 1.0,
        row: RowLabel | None = None,
        own_art: Art | None = None,
        parts: Parts | None = None,
        coarseness: float = 1.0,
    ) -> None:
        if outline is None:
            raise ShapeError(f"the item {name!r} needs an outline, such as a Shapely polygon")
        solid = Outline.of(outline)
        drawn = solid if ink is None else Outline.of(ink)
        made = FlatArt(_known_colour(art)) if isinstance(art, str) else art
        if not isinstance(made, Art):
            raise ShapeError(
                f"the art of the item {name!r} must be a colour or an art, not {str(art)[:40]}"
            )
        values = (
            name, source, solid, drawn, made, label, text, halo, datum, weight, row, own_art,
            parts,
            coarseness,
        )  # fmt: skip
        for column, value in zip(fields(Item), values, strict=True):
            object.__setattr__(self, column.name, value)

    @property
    def is_filled_ink(self) -> bool:
        """Whether the outline is the ink with its holes filled, ring for ring.

        Most words and icons are so, and their edges coincide: asking Shapely takes a millisecond.
        """
        if self.ink is self.outline:
            return True
        rings = {ring.tobytes() for ring in self.outline.rings}
        return not self.outline.has_holes and rings == {
            ring.tobytes() for ring in self.ink.solid_rings
        }

    def __repr__(self) -> str:
        left, top, right, bottom = self.outline.bounds
        return f"<Item: {self.name}, {right - left:.4g} x {bottom - top:.4g}>"


def bulge_between(items: Sequence[Item], largest: FloatArray) -> float:
    """By how much curves of items come nearer than outlines at scales ``(n,)``, canvas units.

    Examples
    --------
    >>> tile = Item("tile", outline=[(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> round(bulge_between([tile], np.array([10.0])), 6)
    0.0016
    """
    extents = np.array([item.coarseness * item.outline.extent for item in items])
    return 2 * FLATTENING * float(np.max(extents * largest, initial=0.0))


def _known_colour(text: str) -> str:
    # Loads the picture library, which most of the package can do without.
    from packwork.scene.colour import css_colour

    try:
        css_colour(text)
    except ValueError:
        raise ShapeError(f"{text[:40]!r} is no colour; use one such as ivory or #102030") from None
    return text

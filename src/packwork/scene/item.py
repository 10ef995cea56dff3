"""One thing to be placed: an outline and an appearance."""

from __future__ import annotations

import base64
from dataclasses import dataclass, fields
from typing import Protocol, TypeAlias

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline, OutlineLike
from packwork.scene.datum import Datum, RowLabel
from packwork.scene.label import Label
from packwork.scene.live_text import LiveText


@dataclass(frozen=True)
class FlatArt:
    """The item is its ink, filled with one colour (any CSS colour)."""

    fill: str = "#4a5568"


@dataclass(frozen=True, eq=False)
class VectorArt:
    """An SVG fragment that has been through the gate.

    Parameters
    ----------
    markup
        Well-formed elements, fit to stand inside one ``<g>`` of any SVG document: ids,
        references and style rules are scoped so that two fragments never meet, and
        nothing in it reaches outside the document.
    matrix
        2 x 3 map from the fragment's user units to the item's own units.
    is_traced
        Whether only a rendering tells what it covers, not its shapes.
    """

    markup: str
    matrix: FloatArray
    is_traced: bool = False


@dataclass(frozen=True, eq=False)
class PictureArt:
    """Pixels with transparency.

    Parameters
    ----------
    png
        A complete PNG file (RGBA).
    width, height
        Its size in pixels.
    matrix
        2 x 3 map from its pixels (x right, y down) to the item's own units.
    is_traced
        Whether the outline is another one than where its opacity passes one half.
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

    Parameters
    ----------
    preview
        The small copy, for screens.
    original
        Where a writer gets as many pixels as the print needs.
    """

    preview: VectorArt
    original: Original


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
        The region that must not overlap: the silhouette, or with its holes where they
        are kept. In the item's own units, y down, centroid at the origin (where it was, if its
        lines have become thinner).
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
        values = (name, source, solid, drawn, made, label, text, halo, datum, weight, row)
        for column, value in zip(fields(Item), values, strict=True):
            object.__setattr__(self, column.name, value)


def _known_colour(text: str) -> str:
    # Loads the picture library, which most of the package can do without.
    from packwork.scene.colour import css_colour

    try:
        css_colour(text)
    except ValueError:
        raise ShapeError(f"{text[:40]!r} is no colour; use one such as ivory or #102030") from None
    return text

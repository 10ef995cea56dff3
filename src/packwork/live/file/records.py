"""Records of items and containers in files: plain values, checked as they are read."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field

from packwork.geometry.lattice import Repeat
from packwork.options import Options
from packwork.readers.regions import MAX_POINTS
from packwork.scene.item import MAX_LENGTH
from packwork.units import Unit

MOST_NAMED = 10_000
"""Characters of a name or a source at most. Chosen."""

FARTHEST = 1e12
"""Numbers of matrices and of text at most. Larger ones drown what is beside them. Chosen."""

MOST_LINES = 100_000
"""Walls of a container, or runs and advances of a word, at most. Chosen."""

MOST_PATH = 4_000_000
"""Characters of path data of one part's lines at most. Chosen: 40,000 curves of ten digits."""

PATH = r"^[MmLlHhVvCcSsQqTtAaZz0-9eE .,+-]*$"
"""Path data, which is written as it is: nothing else may stand in it."""

MOST_CELLS = 10_000
"""Cells of one row of a table at most. Chosen."""


def _is_sound(letter: str) -> bool:
    return (ord(letter) >= 32 or letter in "\t\n\r") and not 0xD800 <= ord(letter) < 0xE000


def _sound_text(text: str) -> str:
    if not all(map(_is_sound, text)):
        raise ValueError("must hold no control characters")
    return text


def kept_text(text: str) -> str:
    r"""A text as a file keeps it: what no file can hold is a sign in its place.

    Examples
    --------
    >>> kept_text("a\x07b") == "a\N{REPLACEMENT CHARACTER}b"
    True
    """
    if not all(map(_is_sound, text)):
        text = "".join(c if _is_sound(c) else "\N{REPLACEMENT CHARACTER}" for c in text)
    return text[:MOST_NAMED]


def plain_fields(value: object, *names: str) -> dict[str, Any]:
    """Values of some fields, or of all that a dataclass has, its texts as a file keeps them."""
    read = {name: getattr(value, name) for name in names or vars(value)}
    return {name: kept_text(v) if isinstance(v, str) else v for name, v in read.items()}


def _turning(matrix: tuple[float, ...]) -> tuple[float, ...]:
    a, b, _, c, d, _ = matrix
    if not math.isfinite(1 / (a * d - b * c or math.inf)) or a * d == b * c:
        raise ValueError("must be a map that can be inverted")
    return matrix


Text: TypeAlias = Annotated[str, Field(max_length=MOST_NAMED), AfterValidator(_sound_text)]

Number: TypeAlias = Annotated[float, Field(allow_inf_nan=False, ge=-FARTHEST, le=FARTHEST)]

Length: TypeAlias = Annotated[float, Field(allow_inf_nan=False, gt=0, le=FARTHEST)]

HASH = "^[0-9a-f]{64}$"

Key: TypeAlias = Annotated[str, Field(pattern=HASH)]
"""Hash of content, by which one thing calls another."""

Numbers: TypeAlias = str
"""An array's bytes, little-endian, as base64."""

Matrix: TypeAlias = Annotated[
    tuple[Number, Number, Number, Number, Number, Number], AfterValidator(_turning)
]
"""Row by row: a, b, x, c, d, y."""


class OutlineRecord(Options):
    """Rings of a region."""

    points: Numbers
    """x, y, x, y and so on, eight bytes each."""
    starts: Annotated[
        tuple[Annotated[int, Field(ge=0, le=MAX_POINTS)], ...], Field(max_length=MAX_POINTS)
    ]


class FlatRecord(Options):
    """One colour."""

    kind: Literal["flat"] = "flat"
    fill: Text


class VectorRecord(Options):
    """A fragment of SVG, which goes through the gate again."""

    kind: Literal["vector"] = "vector"
    markup: str
    matrix: Matrix
    is_traced: bool = False


class ArcLineRecord(Options):
    """Points one after another, each side straight or an arc."""

    points: Numbers
    bulges: Annotated[tuple[Number, ...], Field(max_length=MAX_POINTS)]
    is_closed: bool


class EngravedRecord(ArcLineRecord):
    """A line that is not cut through, with the colour and layer that it has of its own."""

    colour: Text = ""
    layer: Text = ""


class LineRecord(VectorRecord):
    """A drawing of lines for a machine, with arcs."""

    kind: Literal["lines"] = "lines"  # type: ignore[assignment]
    cut: Annotated[tuple[ArcLineRecord, ...], Field(max_length=MOST_LINES)]
    engraved: Annotated[tuple[EngravedRecord, ...], Field(max_length=MOST_LINES)]
    is_painted: bool = False
    path: Annotated[str, Field(pattern=PATH, max_length=MOST_PATH)] | None = None
    """Path data of what is cut, where it has other curves than arcs."""


class PictureRecord(Options):
    """Pixels."""

    kind: Literal["picture"] = "picture"
    png: str
    """The PNG file as base64."""
    width: Annotated[int, Field(ge=1)]
    height: Annotated[int, Field(ge=1)]
    matrix: Matrix
    is_traced: bool = False


class PhotoRecord(Options):
    """A photograph: a small copy and a large one."""

    kind: Literal["photo"] = "photo"
    preview: VectorRecord
    printed: VectorRecord
    crop: tuple[Number, Number, Number] | None = None
    """Zoom, x and y in its frame, of a photograph of which a part is seen."""


ArtRecord: TypeAlias = Annotated[
    FlatRecord | VectorRecord | LineRecord | PictureRecord | PhotoRecord,
    Field(discriminator="kind"),
]


class RunRecord(Options):
    """Characters of one font and one direction."""

    text: Text
    font: Key
    font_name: Text
    index: Annotated[int, Field(ge=0, le=10_000)] = 0
    weight: Number | None = None
    x: Number
    y: Number
    size: Length
    steps: Annotated[tuple[Number, ...], Field(max_length=MOST_LINES)]
    advance: Number
    is_leftward: bool = False
    angle: Number = 0.0


class WordRecord(Options):
    """Text of a word, beside the curves that draw it."""

    runs: Annotated[tuple[RunRecord, ...], Field(max_length=MOST_LINES)]
    path: Annotated[str, Field(pattern=PATH)]
    language: Annotated[str, Field(pattern="^[A-Za-z0-9-]{0,40}$")] = ""


class LabelRecord(Options):
    """Name, link and tooltip in a file."""

    name: Annotated[Text, Field(max_length=MAX_LENGTH)] = ""
    link: Annotated[Text, Field(max_length=MAX_LENGTH)] = ""
    title: Annotated[Text, Field(max_length=MAX_LENGTH)] = ""


def _plain_cell(value: Any) -> Any:
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError("must be a number")
    if value is not None and not isinstance(value, str | int | float | bool):
        raise ValueError("must be text, a number or nothing")
    return value


class DatumRecord(Options):
    """Row and number behind one mark."""

    row: Annotated[
        dict[Text, Annotated[Any, BeforeValidator(_plain_cell)]], Field(max_length=MOST_CELLS)
    ]
    value: Number
    category: Text = ""
    group: Text = ""


class ItemRecord(Options):
    """One thing to be placed."""

    name: Text
    source: Text = ""
    outline: OutlineRecord
    ink: OutlineRecord | None = None
    """None if it is the outline."""
    art: ArtRecord
    label: LabelRecord = LabelRecord()
    text: WordRecord | None = None
    halo: Text = ""
    datum: DatumRecord | None = None
    weight: Length = 1.0
    own_art: ArtRecord | None = None
    """How it was drawn before another colour was put on it."""
    coarseness: Annotated[float, Field(allow_inf_nan=False, ge=0, le=FARTHEST)] = 1.0
    parts: Annotated[tuple[PartRecord, ...], Field(max_length=MOST_LINES)] = ()
    """Of a group."""


class PartRecord(Options):
    """An item of a group, which is none."""

    item: ItemRecord
    pose: tuple[Number, Number, Number, Length, Length]
    """x, y, angle, scale and stretch in the units of the group."""
    weight: Number


class BackdropRecord(Options):
    """A picture that is drawn under all items."""

    art: PhotoRecord
    matrix: Matrix


class ContainerRecord(Options):
    """The region to fill."""

    name: Text
    source: Text = ""
    outline: OutlineRecord
    width: Length
    height: Length
    unit: Unit
    backdrop: BackdropRecord | None = None
    walls: Annotated[tuple[Numbers, ...], Field(max_length=MOST_LINES)] | None = None
    repeats: Repeat | None = None
    file: Key | None = None
    """Hash of the map or drawing that names its parts."""

    pen: tuple[Annotated[str, Field(pattern=r"^#[0-9a-f]{6}$")], Length] | None = None

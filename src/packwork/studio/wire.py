"""Messages between page and studio: one model each, and frames of poses as bytes.

``schema()`` is what both ends are checked against: the page's own list of messages, ``wire.js``, is
written from it.
"""

from __future__ import annotations

import json
import struct
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from packwork.errors import PackworkError
from packwork.live.commands.any_command import AnyCommand
from packwork.live.commands.command import ItemIds
from packwork.live.commands.placing import Arrange

HEAD = struct.Struct("<4I")
"""Of a frame: its number, the version of the scene it is of, the newest command of this page that
it knows, and flags."""

MOVING = 1
"""Flag of a frame: something moves, and nothing is certified."""

MOST_TEXT = 1_000_000
"""Characters of a message at most: a container's outline of 20,000 points. Chosen."""


Weight: TypeAlias = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class Message(BaseModel):
    """One message."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Do(Message):
    """Do a command."""

    type: Literal["do"] = "do"
    n: Annotated[int, Field(ge=0, lt=2**32)]
    """Number of the command, counted by the page."""
    command: AnyCommand


class LeapMessage(Message):
    """Go through the history."""

    type: Literal["leap"] = "leap"
    n: Annotated[int, Field(ge=0, lt=2**32)]
    """Its number, in one count with the page's commands."""
    to: Literal["undo", "redo"]


class Ack(Message):
    """A frame has come: the next may."""

    type: Literal["ack"] = "ack"
    frame: Annotated[int, Field(ge=0, lt=2**32)]


class Pour(Message):
    """Fill the container anew with the same items, from other first places."""

    type: Literal["pour"] = "pour"
    seed: Annotated[int, Field(ge=0, lt=2**31)]


class Stop(Message):
    """End what takes long, with what there is."""

    type: Literal["stop"] = "stop"


class Count(Message):
    """Have so many items."""

    type: Literal["count"] = "count"
    count: Annotated[int, Field(ge=1, le=10_000)]


class Bring(Message):
    """Bring items: bundled ones by name, or files that were sent before."""

    type: Literal["bring"] = "bring"
    sources: Annotated[tuple[Annotated[str, Field(max_length=200)], ...], Field(min_length=1)]
    x: Annotated[float, Field(allow_inf_nan=False)] | None = None
    y: Annotated[float, Field(allow_inf_nan=False)] | None = None


class Swap(Message):
    """Put another item in the place of some."""

    type: Literal["swap"] = "swap"
    items: ItemIds
    source: Annotated[str, Field(max_length=200)]


class Room(Message):
    """Fill another container.

    It is a bundled one, ``text:WORD``, a file that was sent before, or ``same``: that of now on
    another canvas.
    """

    type: Literal["room"] = "room"
    source: Annotated[str, Field(min_length=1, max_length=200)]
    font: Annotated[str, Field(max_length=200)] | None = None
    """Of a word: an installed family, or a file that was sent before."""
    canvas: Annotated[str, Field(max_length=40)] | None = None
    """Its size, as on the command line; that of now if None."""


class Fill(Message):
    """Fill the container with other items, all of those there taken away."""

    type: Literal["fill"] = "fill"
    use: Literal["items", "words", "photos"]
    source: Annotated[str, Field(min_length=1, max_length=200)]
    count: Annotated[int, Field(ge=1, le=2_000)] | None = None
    font: Annotated[str, Field(max_length=200)] | None = None
    """Of words, as of a container."""
    palette: Annotated[str, Field(max_length=200)] | None = None
    """Of words."""


class Picture(Message):
    """Have the items show a picture by their colours."""

    type: Literal["picture"] = "picture"
    source: Annotated[str, Field(min_length=1, max_length=200)]


class Order(Message):
    """Put all anew in an order along a way; no measure of a file, which a page cannot name."""

    type: Literal["order"] = "order"
    way: Literal["right", "left", "down", "up", "outwards", "inwards", "around", "along"]
    by: Literal["weight", "hue", "lightness", "name"]


class Alike(Message):
    """Put all anew, like items side by side, by vectors in a file that was sent before."""

    type: Literal["alike"] = "alike"
    source: Annotated[str, Field(min_length=1, max_length=200)]
    """The file, or ``auto``: of words, by their text."""


class Words(Message):
    """Have these words with these weights; those that stay keep their places."""

    type: Literal["words"] = "words"
    words: Annotated[
        tuple[tuple[Annotated[str, Field(min_length=1, max_length=200)], Weight], ...],
        Field(min_length=1, max_length=2_000),
    ]
    font: Annotated[str, Field(max_length=200)] | None = None


class More(Message):
    """Try the same items from other first places, beside what there is."""

    type: Literal["more"] = "more"
    seed: Annotated[int, Field(ge=0, lt=2**30)]


class Set(Message):
    """Set numbers for all items, as people write them."""

    type: Literal["set"] = "set"
    options: dict[Annotated[str, Field(max_length=40)], str | float | tuple[str, ...]]


Told: TypeAlias = Annotated[
    Do | LeapMessage | Ack | Pour | Stop | Count | Bring | Swap | Room | Fill | Picture | Order
    | Alike | Words | More | Set,
    Field(discriminator="type"),
]  # fmt: skip
"""What a page says."""


class Shape(Message):
    """Shapes of items, in their own units; sent once."""

    key: str
    outline: str
    box: tuple[float, float, float, float]
    fill: str
    ink: str
    svg: str


class Shapes(Message):
    """Looks that are new to this page."""

    type: Literal["shapes"] = "shapes"
    shapes: tuple[Shape, ...]


class Thing(Message):
    """One item."""

    id: int
    shape: str
    name: str
    weight: float
    stretch: float
    is_word: bool
    held: tuple[bool, bool, bool]


class Scene(Message):
    """All that poses do not tell; sent when any of it has changed."""

    type: Literal["scene"] = "scene"
    version: int
    name: str
    outline: str
    """Of the container, path data in canvas units."""
    width: float
    height: float
    unit: str
    items: tuple[Thing, ...]
    options: dict[str, Any]


class LeftOut(Message):
    """Items that found no place in the last run."""

    name: str
    reason: str


class State(Message):
    """State of the desk."""

    type: Literal["state"] = "state"
    covered: float
    moving: bool
    certified: bool
    in_the_way: tuple[str, ...]
    entangled: tuple[int, ...]
    unplaced: tuple[LeftOut, ...]
    """What the run that brought the items could not place."""
    advice: tuple[str, ...]
    """What is poor where it is certified, and what would do."""
    can_undo: bool
    can_redo: bool
    busy: str
    """What is going on that takes long; empty if nothing is."""
    progress: float
    saved: bool


class Variant(Message):
    """Other places for the same items."""

    type: Literal["variant"] = "variant"
    seed: int
    """What it was begun with; variants asked for together have it from that of the asking on."""
    covered: float
    command: Arrange
    """What puts it in place of what there is."""


class Line(Message):
    """A line for people: what was refused, or left out."""

    type: Literal["line"] = "line"
    text: str
    is_error: bool = True


Said: TypeAlias = Annotated[Shapes | Scene | State | Variant | Line, Field(discriminator="type")]
"""What the studio says; poses come as frames."""

TOLD: TypeAdapter[Told] = TypeAdapter(Told)
SAID: TypeAdapter[Said] = TypeAdapter(Said)


class UnreadableError(PackworkError):
    """A message that means nothing; its text is a line for people."""


def read(text: str) -> Told:
    """Message that a page has sent.

    Raises
    ------
    UnreadableError
        If it is none.

    Examples
    --------
    >>> read('{"type": "ack", "frame": 4}')
    Ack(type='ack', frame=4)
    """
    if len(text) > MOST_TEXT:
        raise UnreadableError(f"a message of {len(text)} characters is too long")
    try:
        return TOLD.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(str(part)[:40] for part in first["loc"][:6])
        raise UnreadableError(f"message: {where or 'it'}: {first['msg'][:120]}") from None
    except (ValueError, RecursionError):
        raise UnreadableError("message: cannot be read") from None


def frame_bytes(number: int, version: int, done: int, moving: bool, poses: np.ndarray) -> bytes:
    """A frame: its head, then four numbers an item.

    Parameters
    ----------
    poses
        ``(n, 4)`` x, y, angle in radians, scale.

    Examples
    --------
    >>> len(frame_bytes(1, 1, 0, False, np.zeros((3, 4))))
    64
    """
    head = HEAD.pack(number % 2**32, version, done % 2**32, MOVING if moving else 0)
    return head + poses.astype("<f4").tobytes()


def schema() -> dict[str, Any]:
    """JSON schema of all messages, both ways."""
    return {"told": TOLD.json_schema(), "said": SAID.json_schema()}


def page_types() -> str:
    """The page's list of messages, ``static/wire.js``: types for its checker."""
    named: dict[str, str] = {}
    for side, said in schema().items():
        names = [one.rpartition("/")[2] for one in said["discriminator"]["mapping"].values()]
        defined = said["$defs"]
        named |= {name: _written(one) for name, one in defined.items()}
        named[side.capitalize()] = " | ".join(names)
    lines = [f" * @typedef {{{written}}} {name}" for name, written in sorted(named.items())]
    head = "// @ts-check\n/**\n * What page and studio say to each other.\n *"
    foot = " * Written by ``tools/write_wire.py`` from the schema; nothing here is run.\n *"
    return "\n".join((head, foot, *lines, " */", "export {};", ""))


def _written(said: dict[str, Any]) -> str:
    """A JSON schema as a type."""
    if "$ref" in said:
        return str(said["$ref"]).rpartition("/")[2]
    if "const" in said or "enum" in said:
        values = [json.dumps(one) for one in said.get("enum", [said.get("const")])]
        return values[0] if len(values) == 1 else f"({' | '.join(values)})"
    for key in ("anyOf", "oneOf"):
        if key in said:
            return "(" + " | ".join(_written(one) for one in said[key]) + ")"
    if "prefixItems" in said:
        return "[" + ", ".join(_written(one) for one in said["prefixItems"]) + "]"
    if said.get("type") == "array":
        return f"{_written(said.get('items', {}))}[]"
    if "properties" in said:
        needed = said.get("required", [])
        parts = [
            f"{name}{'' if name in needed or 'const' in one else '?'}: {_written(one)}"
            for name, one in said["properties"].items()
        ]
        return "{" + ", ".join(parts) + "}"
    plain = {"integer": "number", "number": "number", "string": "string", "boolean": "boolean"}
    return plain.get(str(said.get("type")), "any" if said.get("type") != "null" else "null")

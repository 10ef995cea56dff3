"""Messages of the studio to its pages: one model each, and frames of poses as bytes."""

from __future__ import annotations

import struct
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from packwork.live.commands.placing import Arrange
from packwork.live.kinds import KindName, LineWay

HEAD = struct.Struct("<4I")
"""Of a frame: its number, the version of the scene it is of, the newest command of this page that
it knows, and flags."""

MOVING = 1
"""Flag of a frame: something moves, and nothing is certified."""


class Message(BaseModel):
    """One message."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Shape(Message):
    """Shapes of items, in their own units; sent once."""

    key: str
    outline: str
    size: tuple[float, float]
    """Width and height of the outline."""
    box: tuple[float, float, float, float]
    fill: str
    ink: str
    svg: str
    whole: str
    """Of a cropped photograph all of it, as ``svg``; else empty."""


class Shapes(Message):
    """Looks that are new to this page, and keys of those that it may forget."""

    type: Literal["shapes"] = "shapes"
    shapes: tuple[Shape, ...] = ()
    gone: tuple[str, ...] = ()


class Thing(Message):
    """One item."""

    id: int
    shape: str
    name: str
    weight: float
    count: float | None
    """How often a word was counted, where that is known."""
    stretch: float
    is_word: bool
    held: tuple[bool, bool, bool]
    crop: tuple[float, float, float] | None
    """Zoom, x and y of a photograph in its frame; None of what is none."""
    halo: str
    """Colour of the rim by which it stands out; empty for none."""
    parts: int
    """Number of items that a group is made of; 0 of what is none."""


class DrawnNote(Message):
    """A letter or a key beside the items, or a label on one of them, which it follows."""

    path: str
    matrix: tuple[float, float, float, float, float, float]
    """As an SVG has it."""
    fill: str
    item: int | None
    pose: tuple[float, float, float, float]
    """x, y, angle and scale of the item where the label was put."""


class Underlay(Message):
    """A picture under all items."""

    shape: str
    """The drawing, of a canvas' box."""
    matrix: tuple[float, float, float, float, float, float]
    """To canvas units, as an SVG has it."""
    faint: bool
    """Whether it is the picture that a mosaic shows, seen faintly in the container alone."""


class Scene(Message):
    """All that poses do not tell; sent when any of it has changed."""

    type: Literal["scene"] = "scene"
    version: int
    name: str
    outline: str
    """Of the container, path data in canvas units."""
    is_lined: bool
    """Whether that is drawn: on a map borders of regions are, and not the rooms of marks."""
    width: float
    height: float
    unit: str
    items: tuple[Thing, ...]
    options: dict[str, Any]
    angles: tuple[float, ...] | None = None
    """The only ones allowed, radians; None for any."""
    kind: KindName = "collage"
    """Kind of document, by which the page shows what has meaning."""
    notes: tuple[DrawnNote, ...] = ()
    title: str = ""
    """That a person has given, or the container's name."""
    palette: tuple[str, ...] = ()
    """Colours put on all items; none where each has its own."""
    shades: str = ""
    """What then became of drawings of several colours; empty where nobody has said."""
    ground: str = ""
    """Colour behind all; empty for none."""
    gradient: str = ""
    """Gradient behind all, as CSS writes it; empty for none."""
    font: str = ""
    """Name of the font of most words; empty without words."""
    left_out: dict[str, float] = Field(default_factory=dict)
    """Words that a person left out, with how often they were there."""
    likeness: float | None = None
    """Share of the colours of the picture shown that items take on; None without one."""
    halos: str = ""
    """Items that were asked to have halos, or that have some in a file; empty for none."""
    along: LineWay | None = None
    """Lines that words follow."""
    ring: tuple[str, ...] = ()
    """Texts round the edge of the container, of words that follow lines."""
    repeat: tuple[float, float, float] | None = None
    """Of a seamless tile the width and height of its cell, and the drop of each column of them."""
    rim: float = 0.0
    """How far a halo reaches beyond its item, canvas units."""
    under: tuple[Underlay, ...] = ()
    """The lowest first."""

    @property
    def shapes(self) -> list[str]:
        """Keys of all that it draws, each once."""
        below = (one.shape for one in self.under)
        return list(dict.fromkeys((*(thing.shape for thing in self.items), *below)))


class LeftOut(Message):
    """Items that found no place in the last run."""

    name: str
    reason: str


class State(Message):
    """State of the workspace."""

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
    unmet: dict[int, str]
    """Places and sizes that were asked for and not had, by the count of what was asked."""
    can_undo: bool
    can_redo: bool
    busy: str
    """What is being worked on; empty if nothing is."""
    polishing: bool
    """Whether coverage is won back while nobody touches anything, certified all the while."""
    progress: float
    """Share of that, 0 where nobody knows."""
    can_stop: bool
    saved: bool
    clip: str
    """Token of what the studio holds to be pasted; empty for nothing."""
    document: int = 0
    """Number of the document, in the order in which they were opened."""
    fresh: bool = False
    """Whether it began with nothing that a person named, and nothing was done since."""


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


SAID: TypeAdapter[Said] = TypeAdapter(Said)


def frame_bytes(number: int, version: int, done: int, moving: bool, poses: np.ndarray) -> bytes:
    """A frame: its head, then four numbers an item.

    ``poses``: ``(n, 4)`` x, y, angle in radians, scale.

    Examples
    --------
    >>> len(frame_bytes(1, 1, 0, False, np.zeros((3, 4))))
    64
    """
    head = HEAD.pack(number % 2**32, version, done % 2**32, MOVING if moving else 0)
    return head + poses.astype("<f4").tobytes()

"""Pictures and gradients behind all, as items that cover a canvas; mosaics in sessions.

Of a mosaic a document keeps the picture, and its items have colours that show it.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ReadError, RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.svg.art import KeptOriginal
from packwork.readers.target import target_of
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.container import Backdrop, Container
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.layout import Layout, ground_in
from packwork.scene.palette import LONGEST
from packwork.scene.recolour import in_own_colours
from packwork.scene.target import TargetPicture
from packwork.steps.mosaic import LEAST, SQUARE, correlation_with, in_picture, too_fine
from packwork.uses.cutting import CutOriginal, Window

if TYPE_CHECKING:
    from packwork.live.document import Document

MOSAIC_PX = 640
"""Longer side of the pixels that are kept of a picture. Larger makes files larger; targets of runs
have half as many. Chosen."""


@dataclass(frozen=True, eq=False)
class Mosaic:
    """A picture that the items of a document show from afar.

    ``tint``: how far they take on its colours, 0..1; None: 0 of photographs, 1 of all else.
    """

    picture: Item
    tint: float | None = None
    _targets: WeakKeyDictionary[Container, TargetPicture] = field(
        default_factory=WeakKeyDictionary, repr=False
    )

    def target(self, container: Container) -> TargetPicture:
        """The picture as it lies on a container."""
        if container not in self._targets:
            self._targets[container] = target_of(self.picture, container)
        return self._targets[container]

    def is_seen_on(self, container: Container) -> bool:
        """Whether a container has more than one colour of it: colours are to be had there."""
        try:
            self.target(container)
        except ReadError:
            return False
        return True

    def tint_of(self, item: Item) -> float:
        """Share of the colours that an item takes on."""
        usual = 0.0 if isinstance(item.art, PhotoArt) else 1.0
        return usual if self.tint is None else self.tint


def coloured(document: Document, rows: IntArray) -> Document:
    """A document with some of its items in the colours that show its picture where they lie.

    The others keep theirs, and are made up for where they are near; groups keep theirs too,
    and so do all where the container has one colour of the picture only.
    """
    mosaic, container = document.mosaic, document.container
    rows = rows[[document.items[k].parts is None for k in rows]]
    if mosaic is None or not len(rows) or not mosaic.is_seen_on(container):
        return document
    items, tints = list(document.items), np.zeros(len(document))
    for k in rows.tolist():
        items[k] = in_own_colours(items[k])
        tints[k] = mosaic.tint_of(items[k])
    near, box = _around(document, rows)
    target, corner = _cut(mosaic.target(container), box)
    poses = document.poses.subset(near).moved(*(-corner).tolist())
    nearby = tuple(items[k] for k in near)
    layout = Layout(container, nearby, poses, document.weights[near])
    shown = in_picture(layout, target, tints[near], ground_in(document.manifest) or "white")
    for k, item in zip(near.tolist(), shown.items, strict=True):
        items[k] = item
    return replace(document, items=tuple(items))


def advice_on_picture(document: Document) -> tuple[str, ...]:
    """Advice on a mosaic whose picture few items hardly show: how many would do."""
    mosaic, container = document.mosaic, document.container
    if mosaic is None or not mosaic.is_seen_on(container):
        return ()
    target = mosaic.target(container)
    found = too_fine(target, container, len(document), "item")
    is_poor = found is not None and correlation_with(document.layout, target) < LEAST
    return (str(found),) if is_poor else ()


def _around(document: Document, rows: IntArray) -> tuple[IntArray, FloatArray]:
    """Rows of items about some of them, and their box: left and top, right and bottom."""
    reach = document.poses.scale * [item.outline.extent for item in document.items]
    places = np.column_stack([document.poses.x, document.poses.y])
    first, last = places - reach[:, None], places + reach[:, None]
    # As far as the colours of one make up for those of another.
    far = SQUARE * np.sqrt(document.container.outline.area / len(document))
    box = np.array([first[rows].min(axis=0) - far, last[rows].max(axis=0) + far])
    near = ((last > box[0]) & (first < box[1])).all(axis=1)
    return np.flatnonzero(near), box


def _cut(target: TargetPicture, box: FloatArray) -> tuple[TargetPicture, FloatArray]:
    """Part of a picture in a box of the canvas, and its corner there."""
    shape = np.array(target.light.shape[1::-1])
    first = np.clip(np.floor(box[0] * target.px_per_cu), 0, shape - 1).astype(int)
    last = np.clip(np.ceil(box[1] * target.px_per_cu), first + 1, shape).astype(int)
    light = target.light[first[1] : last[1], first[0] : last[0]]
    return TargetPicture(light, target.px_per_cu), first / target.px_per_cu


MOST_PX = 2_400
"""Longer side of the pixels that are kept of a picture behind all. Larger prints finer, and makes
files larger. Chosen: 20 cm at 300 to the inch."""

_GRADIENT = re.compile(r"\s*(linear|radial)-gradient\((.*)\)\s*", re.DOTALL)
_ANGLE = re.compile(r"\s*(-?\d{1,4}(?:\.\d{1,6})?)deg\s*")
_PLAIN = re.compile(
    r"(linear-gradient\(-?\d{1,4}(\.\d{1,6})?deg|radial-gradient\(#[0-9a-f]{6,8})"
    r"(, #[0-9a-f]{6,8})+\)"
)
_COMMA = re.compile(r",(?![^(]*\))")

DOWN = 180.0
"""Angle of a gradient of which none is said, as CSS has it: degrees clockwise from upwards."""


def gradient(text: str, container: Container) -> Item | None:
    """Drawing of a gradient, as CSS writes it, on a canvas; None of any other text.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container
    >>> found = gradient("linear-gradient(90deg, navy, pink)", builtin_container("circle", 100.0))
    >>> found.art.markup.count("<stop"), found.outline.bounds
    (2, (-50.0, -50.0, 50.0, 50.0))
    """
    if (met := _GRADIENT.fullmatch(text)) is None:
        return None
    _check_length(text)
    parts = _COMMA.split(met[2])
    turn = _ANGLE.fullmatch(parts[0]) if met[1] == "linear" else None
    colours = [parse_colour("background", one.strip()) for one in parts[turn is not None :]]
    if len(colours) < 2:
        raise RecipeError("background", f"a gradient has two colours or more, not {text[:40]!r}")
    half = np.array([container.width, container.height]) / 2
    angle = np.radians(DOWN if turn is None else float(turn[1]))
    way = np.array([np.sin(angle), -np.cos(angle)])
    x, y = (way * float(np.abs(way) @ half)).tolist()
    ends = f'x1="{-x:.9g}" y1="{-y:.9g}" x2="{x:.9g}" y2="{y:.9g}"'
    if met[1] == "radial":
        ends = f'cx="0" cy="0" r="{float(np.hypot(*half)):.9g}"'
    stops = "".join(
        f'<stop offset="{k / (len(colours) - 1):.6g}" stop-color="{hex_colour(one)[:7]}"'
        f' stop-opacity="{one[3] / 255:.3g}"/>'
        for k, one in enumerate(colours)
    )
    key = "ground-" + hashlib.sha256((ends + stops).encode()).hexdigest()[:12]
    box = Outline.box(*(-half), *half)
    markup = (
        f'<{met[1]}Gradient id="{key}" gradientUnits="userSpaceOnUse" {ends}>{stops}'
        f'</{met[1]}Gradient><path fill="url(#{key})" d="{_rectangle(box)}"/>'
    )
    degrees = f"{np.degrees(angle):.6f}".rstrip("0").rstrip(".")
    turned = "" if met[1] == "radial" else f"{degrees}deg, "
    said = ", ".join(hex_colour(one) + f"{one[3]:02x}" * (one[3] < 255) for one in colours)
    plain = f"{met[1]}-gradient({turned}{said})"
    # It is told in this form, which names of colours may be shorter than.
    _check_length(plain)
    return Item("gradient", plain, box, box, VectorArt(markup, np.eye(2, 3)))


def _check_length(text: str) -> None:
    if len(text) > LONGEST:
        many = f"{LONGEST:,} characters at most, colours as numbers, not {len(text):,}"
        raise RecipeError("background", f"a gradient takes {many}")


def gradient_text(behind: Item | None) -> str:
    """Gradient that an item is the drawing of, as CSS writes it; empty for any other.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container
    >>> drawn = gradient("linear-gradient(navy, pink)", builtin_container("circle", 100.0))
    >>> gradient_text(drawn), gradient_text(None)
    ('linear-gradient(180deg, #000080, #ffc0cb)', '')
    """
    if behind is None or behind.name != "gradient":
        return ""
    # Items of a session's file may say anything of themselves.
    is_one = len(behind.source) <= LONGEST and _PLAIN.fullmatch(behind.source)
    return behind.source if is_one else ""


def sheet_box(container: Container) -> Outline:
    """The canvas of a container."""
    return Outline.box(0.0, 0.0, container.width, container.height)


def covering(item: Item, box: Outline) -> Backdrop:
    """Item that covers a box of the canvas, its middle on that of the box, and is cut off there."""
    own, there = (np.reshape(one.bounds, (2, 2)) for one in (item.outline, box))
    scale = float((np.ptp(there, axis=0) / np.ptp(own, axis=0)).max())
    x, y = (there.mean(axis=0) - scale * own.mean(axis=0)).tolist()
    place = affine.similarity(x, y, 0.0, scale)
    seen = box.mapped(affine.inverse(place))
    window = Window("ground", f'<path d="{_rectangle(seen)}"/>', np.eye(2, 3), is_traced=True)
    art = item.art
    if not isinstance(art, PhotoArt):
        assert isinstance(art, VectorArt)  # noqa: S101
        art = PhotoArt(art, KeptOriginal(art))
    return Backdrop(PhotoArt(window.over(art.preview), CutOriginal(art.original, window)), place)


def underlays(
    container: Container, behind: Item | None, mosaic: Mosaic | None
) -> Iterator[tuple[Item, FloatArray, bool]]:
    """Pictures under the items of a document: drawing, its map to the canvas, whether it is faint.

    Faint is the one that a mosaic shows; the lowest comes first.
    """
    backdrop = container.backdrop
    if behind is not None:
        backdrop = covering(behind, sheet_box(container))
    found = [] if backdrop is None else [(backdrop, sheet_box(container), False)]
    if mosaic is not None:
        box = Outline.box(*container.outline.bounds)
        found.append((covering(mosaic.picture, box), box, True))
    for one, box, is_faint in found:
        own = box.mapped(affine.inverse(one.matrix))
        yield Item("backdrop", "", own, own, one.art), one.matrix, is_faint


def _rectangle(box: Outline) -> str:
    left, top, right, bottom = box.bounds
    return f"M{left:.9g} {top:.9g}H{right:.9g}V{bottom:.9g}H{left:.9g}Z"

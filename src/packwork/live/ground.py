"""Pictures and gradients behind all, as items that cover a canvas."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.live.mosaic import Mosaic
from packwork.readers.svg.art import KeptOriginal
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.container import Backdrop, Container
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.palette import LONGEST
from packwork.uses.cutting import CutOriginal, Window

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

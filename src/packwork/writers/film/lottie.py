"""Films as Lottie: JSON that players on web pages, phones and in presentations show.

An item of one colour is a shape, any other a picture: the format knows gradients, strokes
and masks in ways of its own, and players differ in what they support.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Hashable, Iterable, Sequence
from typing import Any

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import WriteError
from packwork.geometry import affine
from packwork.raster.overlay import FINENESS
from packwork.scene.colour import Colour, css_colour, hex_colour, parse_colour
from packwork.scene.item import FlatArt, Item
from packwork.scene.track import poses_of
from packwork.writers.film.animated_svg import TOLERANCE
from packwork.writers.film.film import Film, Tell, tell_nobody
from packwork.writers.frame import PictureFrame, picture_frame
from packwork.writers.pictures import as_picture
from packwork.writers.svg import container_line
from packwork.writers.svg_symbols import shape_key

Json = dict[str, Any]

VERSION = "5.7.0"
"""Of the format as players name it: all of what is used here is older."""

_SOLID, _IMAGE, _SHAPE = 1, 2, 4
_EVEN_ODD = 2
_STRAIGHT = {"o": {"x": [0], "y": [0]}, "i": {"x": [1], "y": [1]}}
"""Handles of a keyframe from which it goes straight on to the next."""


def lottie_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """Lottie file of a film; whether it loops is for its player to say."""
    frame = picture_frame(film.layout.container, film.options.film_pixels)
    scene = _Scene(film, frame)
    layers = [scene.layer(k, tell) for k in range(len(film.items))]
    # The first layer is the one on top.
    layers = [*layers[::-1], *_under(film, frame)]
    end = float(film.seconds.sum()) * film.options.fps
    for index, layer in enumerate(layers, start=1):
        layer |= {"ind": index, "ip": 0, "op": end, "st": 0}
    whole = {
        "v": VERSION, "nm": film.layout.container.name, "fr": film.options.fps, "ip": 0,
        "op": end, "w": frame.columns, "h": frame.rows, "assets": list(scene.assets.values()),
        "layers": layers,
    }  # fmt: skip
    return json.dumps(whole, separators=(",", ":")).encode()


class _Scene:
    """Layers of items, and the pictures that several of them share."""

    def __init__(self, film: Film, frame: PictureFrame) -> None:
        self._film, self._frame = film, frame
        self._items = film.items
        self._largest: dict[Hashable, float] = {}
        for item, scale in zip(self._items, film.frames[:, :, 3].max(axis=0), strict=True):
            key = shape_key(item)
            self._largest[key] = max(self._largest.get(key, 0.0), float(scale))
        self._anchors: dict[Hashable, tuple[list[float], float]] = {}
        self.assets: dict[Hashable, Json] = {}

    def layer(self, k: int, tell: Tell) -> Json:
        """Layer of one item."""
        item, frames = self._items[k], self._film.frames[:, k]
        tolerance = TOLERANCE * self._film.layout.container.side
        knots = self._film.knots(k, tolerance)
        at = np.round(self._film.starts[knots] * self._film.options.fps).astype(np.int64)
        name = item.label.name or item.name
        tell((k + 1) / len(self._items))
        if isinstance(item.art, FlatArt):
            shapes = [_group(item.ink.rings, _fill(css_colour(item.art.fill)))]
            moved = _transform(frames[knots], at, self._frame.px_per_cu)
            return {"ty": _SHAPE, "nm": name, "ks": moved, "shapes": shapes}
        anchor, scale = self._picture(item)
        moved = _transform(frames[knots], at, self._frame.px_per_cu, anchor, scale)
        reference = self.assets[shape_key(item)]["id"]
        return {"ty": _IMAGE, "nm": name, "ks": moved, "refId": reference}

    def _picture(self, item: Item) -> tuple[list[float], float]:
        """Place of the item's origin in its picture, px, and units of the item per px."""
        key = shape_key(item)
        if key not in self._anchors:
            fineness = FINENESS * self._largest[key] * self._frame.px_per_cu
            try:
                art = as_picture(item, fineness)
            except ValueError as error:
                raise WriteError("Lottie", f"an item cannot be rendered ({error})") from error
            origin = affine.inverse(art.matrix)[:, 2]
            self._anchors[key] = (_rounded(origin), float(art.matrix[0, 0]))
            data = "data:image/png;base64," + base64.b64encode(art.png).decode("ascii")
            self.assets[key] = {
                "id": f"drawing-{len(self.assets) + 1}", "w": art.width, "h": art.height,
                "u": "", "p": data, "e": 1,
            }  # fmt: skip
        return self._anchors[key]


def _under(film: Film, frame: PictureFrame) -> list[Json]:
    """Layers under the items: the container's line and the background."""
    layers: list[Json] = []
    container = film.layout.container
    still = _still([0, 0], 100 * frame.px_per_cu)
    is_shown, (ink, width) = container_line(container, film.show_container)
    if is_shown:
        line = _stroke(css_colour(ink), width)
        shapes = [_group(container.outline.rings, line)]
        if container.walls is not None:
            shapes = [_group(container.walls, line, is_closed=False)]
        layers.append({"ty": _SHAPE, "nm": "container", "ks": still, "shapes": shapes})
    colour = parse_colour("background", film.background)
    if colour[3]:
        opacity = 100 * colour[3] / 255
        layers.append(
            {
                "ty": _SOLID, "nm": "background", "ks": _still([0, 0], 100, opacity),
                "sw": frame.columns, "sh": frame.rows, "sc": hex_colour(colour),
            }
        )  # fmt: skip
    return layers


def _still(place: Sequence[float], percent: float, opacity: float = 100) -> Json:
    return {
        "a": _fixed([0, 0]), "p": _fixed(list(place)), "r": _fixed(0),
        "s": _fixed([percent, percent]), "o": _fixed(opacity),
    }  # fmt: skip


def _transform(
    frames: FloatArray,
    at: IntArray,
    px_per_cu: float,
    anchor: Sequence[float] = (0, 0),
    unit: float = 1.0,
) -> Json:
    """Place, turn and size of a layer at the frames ``at``.

    ``frames`` are ``(k, 5)`` numbers of a track at the ``(k,)`` times ``at``; ``anchor`` is where
    the item's origin lies in the layer, ``unit`` units of the item per unit of the layer.
    """
    poses = poses_of(frames)
    return {
        "a": _fixed(list(anchor)),
        "p": _animated(at, np.column_stack([poses.x, poses.y]) * px_per_cu),
        "r": _animated(at, np.degrees(poses.angle)[:, None]),
        "s": _animated(at, 100 * px_per_cu * unit * poses.axis_scales),
        "o": _fixed(100),
    }


def _animated(at: IntArray, values: FloatArray) -> Json:
    """A property that goes straight on from keyframe to keyframe."""
    if np.ptp(values, axis=0).max() == 0:
        first = _rounded(values[0])
        return _fixed(first if len(first) > 1 else first[0])
    keys: list[Json] = [
        {"t": int(t), "s": _rounded(value), **_STRAIGHT}
        for t, value in zip(at, values, strict=True)
    ]
    return {"a": 1, "k": keys}


def _fixed(value: float | list[float]) -> Json:
    return {"a": 0, "k": value}


def _group(lines: Iterable[FloatArray], style: Json, *, is_closed: bool = True) -> Json:
    paths = [{"ty": "sh", "ks": _fixed_path(line, is_closed)} for line in lines]
    moved = {"ty": "tr", **_still([0, 0], 100)}
    return {"ty": "gr", "it": [*paths, style, moved]}


def _fixed_path(line: FloatArray, is_closed: bool) -> Json:
    corners = [_rounded(point) for point in line]
    straight = [[0, 0]] * len(corners)
    return {"a": 0, "k": {"c": is_closed, "v": corners, "i": straight, "o": straight}}


def _fill(colour: Colour) -> Json:
    return {
        "ty": "fl", "c": _fixed(_shares(colour)), "o": _fixed(100 * colour[3] / 255), "r": _EVEN_ODD
    }  # fmt: skip


def _stroke(colour: Colour, width: float) -> Json:
    return {
        "ty": "st", "c": _fixed(_shares(colour)), "o": _fixed(100), "w": _fixed(width),
        "lc": 2, "lj": 2,
    }  # fmt: skip


def _shares(colour: Colour) -> list[float]:
    return [round(channel / 255, 4) for channel in colour[:3]]


def _rounded(values: FloatArray) -> list[float]:
    """Six significant digits after the larger: far finer than a pixel."""
    largest = max(float(np.abs(values).max()), 1e-12)
    digits = max(5 - math.floor(math.log10(largest)), 0)
    return [round(float(v), digits) for v in values]

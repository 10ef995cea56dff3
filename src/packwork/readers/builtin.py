"""Shapes that come with the package: plain ones by formula and bundled drawings."""

from __future__ import annotations

import difflib
import math
import os
from collections.abc import Iterable, Mapping
from importlib import resources

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, region
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import Holes, centred
from packwork.readers.svg.container import container_of_svg
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.readers.svg_syntax.shapes import flattened
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.units import SHEETS

MOST_STRIPE = 100.0
"""Longest stripe, as a multiple of its width. Chosen."""

_SIDE = 100.0


def _corners(count: int, inner: float = 1.0) -> str:
    """Path through ``count`` corners of a circle, one on top; stars dent by ``inner``."""
    points = count if inner == 1.0 else 2 * count
    places = []
    for k in range(points):
        radius = _SIDE / 2 * (inner if points > count and k % 2 else 1.0)
        turn = 2 * math.pi * k / points
        places.append(f"{50 + radius * math.sin(turn)!r} {50 - radius * math.cos(turn)!r}")
    return f"M{' '.join(places)}z"


def _scalloped(count: int, inner: float) -> str:
    """Path of ``count`` bows round the box, whose ends lie ``inner`` from its middle."""
    half = math.pi / count
    bow, up = inner * math.sin(half), inner * math.cos(half)
    # A bow ends where it meets the next and comes out by what is left to the box.
    out = _SIDE / 2 - up
    radius = (bow**2 + out**2) / (2 * out)
    ends = [
        f"{50 + inner * math.sin(turn)!r} {50 - inner * math.cos(turn)!r}"
        for turn in (half * (2 * k - 1) for k in range(count + 1))
    ]
    return f"M{ends[0]}" + "".join(f"A{radius!r} {radius!r} 0 0 1 {end}" for end in ends[1:]) + "z"


def _disc(radius: float, ry: float | None = None) -> str:
    """Path round an ellipse in the middle of the box."""
    down = radius if ry is None else ry
    arc = f"a{radius} {down} 0 1 1"
    return f"M{50 - radius} 50{arc}{2 * radius} 0{arc}{-2 * radius} 0z"


PATHS: Mapping[str, str] = {
    "arrow": "M0 36h56v-24l44 38-44 38v-24h-56z",
    "circle": _disc(50),
    "cloud": "M24 78A22 22 0 0 1 18 36A27 27 0 0 1 66 24A24 24 0 0 1 84 44A18 18 0 0 1 80 78z",
    "cross": "M35 0h30v35h35v30h-35v35h-30v-35h-35v-30h35z",
    "diamond": "M50 0L88 50L50 100L12 50z",
    "drop": "M50 0C62 24 84 44 84 66A34 34 0 0 1 16 66C16 44 38 24 50 0z",
    "ellipse": _disc(50, 31),
    "heart": (
        "M50 92C18 66 0 50 0 28C0 12 12 0 27 0C37 0 45 5 50 14"
        "C55 5 63 0 73 0C88 0 100 12 100 28C100 50 82 66 50 92z"
    ),
    "hexagon": _corners(6),
    "leaf": "M50 0C90 22 92 72 50 100C8 72 10 22 50 0z",
    "moon": "M62 2A50 50 0 1 0 98 62A40 40 0 0 1 62 2z",
    "octagon": _corners(8),
    "pentagon": _corners(5),
    "rectangle": "M0 0h100v62h-100z",
    "ring": _disc(50) + _disc(30),
    "square": "M0 0h100v100h-100z",
    "star": _corners(5, 0.42),
    "triangle": _corners(3),
    # Their places here are their colours, so new ones come last.
    "crescent": "M60 1A50 50 0 1 0 99 60A38 38 0 1 1 60 1z",
    "badge": _scalloped(12, 44.0),
    "shield": "M8 12C24 13 40 9 50 0C60 9 76 13 92 12V44C92 70 74 90 50 100C26 90 8 70 8 44z",
}
"""Path data by name; holes by the even-odd rule."""

NAMES = (*sorted(PATHS), "stripe:6")
"""All plain shapes; a stripe takes any length, as a multiple of its width."""


def primitive(name: str) -> Region | None:
    """Region of a plain shape; None if none has that name.

    Examples
    --------
    >>> primitive("square").area, primitive("stripe:4").bounds, primitive("dodo")
    (10000.0, (0.0, 0.0, 100.0, 25.0), None)
    """
    if name.startswith("stripe:"):
        return _stripe(name.partition(":")[2])
    if name not in PATHS:
        return None
    pieces = parse_path(PATHS[name])
    return region([flattened(piece, FLATTENING * _SIDE) for piece in pieces], "evenodd")


def _stripe(text: str) -> Region:
    try:
        aspect = float(text)
    except ValueError:
        aspect = math.nan
    if not 1 / MOST_STRIPE <= aspect <= MOST_STRIPE:
        raise UnfitError(
            f"a stripe needs its length as a multiple of its width, up to {MOST_STRIPE:g}, "
            f"as in stripe:6, not {text[:20]!r}"
        )
    width, height = (_SIDE, _SIDE / aspect) if aspect >= 1 else (_SIDE * aspect, _SIDE)
    return region([flattened(parse_path(f"M0 0h{width!r}v{height!r}h{-width!r}z")[0], 1.0)])


ALL_ICONS = "icons"
"""Name that stands for every bundled icon."""

_MEANT = {
    "badge": "emblem seal rosette medal scallop sticker stamp",
    "circle": "disc disk round ball dot",
    "cross": "plus",
    "diamond": "rhombus lozenge",
    "drop": "teardrop water raindrop",
    "ellipse": "oval egg",
    "heart": "love",
    "rectangle": "box banner",
    "ring": "donut doughnut annulus",
    "shield": "crest coat-of-arms",
}
"""Other words for shapes, by their names."""

COLOURS = ("#ee6c4d", "#e9b341", "#1f6f78", "#7b3b5e", "#8fb48c", "#22304f", "#f5b7a4")
"""Fills of the plain shapes, given out in the order of their names."""


def item_names() -> list[str]:
    """Names that ``builtin_item`` knows.

    Examples
    --------
    >>> {"circle", "heart", "stripe:6"} <= set(item_names())
    True
    """
    return sorted({*NAMES, *_stems("icons")})


def icon_names() -> list[str]:
    """Names of the bundled icons: what ``icons`` stands for."""
    return _stems("icons")


def container_names() -> list[str]:
    """Names that ``builtin_container`` knows."""
    return sorted({*NAMES, *_stems("containers")})


def builtin_item(name: str, holes: Holes = "fill") -> Item:
    """Item by name: a bundled icon, else a plain shape in one colour.

    Examples
    --------
    >>> builtin_item("square").outline.bounds
    (-50.0, -50.0, 50.0, 50.0)
    """
    drawn = _drawing("icons", name)
    if drawn is not None:
        return item_of_svg(drawn, name, name, holes)
    with reading_file(name):
        shape = primitive(name)
    if shape is None:
        raise unknown_name(name, item_names(), "item")
    outline, ink, _ = centred(shape, holes)
    order = list(PATHS).index(name) if name in PATHS else len(PATHS)
    return Item(name, name, outline, ink, FlatArt(COLOURS[order % len(COLOURS)]))


def builtin_container(name: str, side: float = 600.0) -> Container:
    """Container by name: a bundled drawing, else a plain shape that fills its canvas.

    Examples
    --------
    >>> stripe = builtin_container("stripe:6", 300.0)
    >>> stripe.width, stripe.height
    (300.0, 50.0)
    """
    drawn = _drawing("containers", name)
    if drawn is not None:
        return container_of_svg(drawn, name, name, side)
    with reading_file(name):
        shape = primitive(name)
    if shape is None:
        raise unknown_name(name, container_names(), "container")
    left, top, right, bottom = shape.bounds
    scale = side / max(right - left, bottom - top)
    place = affine.similarity(-left * scale, -top * scale, 0.0, scale)
    outline = Outline.from_region(shape).mapped(place)
    return Container(name, name, outline, (right - left) * scale, (bottom - top) * scale)


def unknown_name(name: str, known: Iterable[str], kind: str) -> ReadError:
    """Error that names what may have been meant.

    Examples
    --------
    >>> print(unknown_name("hart", ["heart", "star"], "item"))
    hart: there is no such file and no built-in item of that name; did you mean heart?
    >>> print(unknown_name("oval", ["ellipse", "star"], "container"))
    oval: there is no such file and no built-in container of that name; did you mean ellipse?
    """
    names = list(known)
    if name.endswith(("/", os.sep)):
        return ReadError(name, "there is no such folder")
    if name.isdecimal():
        return ReadError(name, f"is no {kind}; -n {name} asks for so many")
    if name.lower().removesuffix("-landscape") in SHEETS:
        return ReadError(name, f"is a sheet; the whole of it is: page --canvas {name}")
    meant = [shape for shape, words in _MEANT.items() if name.lower() in words.split()]
    close = meant or difflib.get_close_matches(name.lower(), names, n=3, cutoff=0.6)
    hint = f"did you mean {' or '.join(close)}?" if close else f"built in are {', '.join(names)}"
    return ReadError(name, f"there is no such file and no built-in {kind} of that name; {hint}")


def _stems(folder: str) -> list[str]:
    place = resources.files("packwork.bundled").joinpath(folder)
    if not place.is_dir():
        return []
    return sorted(f.name.removesuffix(".svg") for f in place.iterdir() if f.name.endswith(".svg"))


def _drawing(folder: str, name: str) -> bytes | None:
    """Bytes of a bundled drawing; the name is looked up, never joined to a path."""
    if name not in _stems(folder):
        return None
    return resources.files("packwork.bundled").joinpath(folder, f"{name}.svg").read_bytes()

"""Shapes that come with the package: plain ones by formula and bundled drawings."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from importlib import resources

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.primitives import NAMES, PATHS, primitive
from packwork.readers.regions import Holes, centred
from packwork.readers.svg.container import container_of_svg
from packwork.readers.svg.item import item_of_svg
from packwork.readers.unfit import naming
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.units import SHEETS

ALL_ICONS = "icons"
"""Name that stands for every bundled icon."""

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
    """Names of the bundled icons: what ``icons`` stands for.

    Examples
    --------
    >>> set(icon_names()) <= set(item_names())
    True
    """
    return _stems("icons")


def container_names() -> list[str]:
    """Names that ``builtin_container`` knows.

    Examples
    --------
    >>> {"circle", "heart", "stripe:6"} <= set(container_names())
    True
    """
    return sorted({*NAMES, *_stems("containers")})


def builtin_item(name: str, holes: Holes = "fill") -> Item:
    """Item by name: a bundled icon, else a plain shape in one colour.

    Raises
    ------
    ReadError
        If there is no such name; the message names close ones.

    Examples
    --------
    >>> builtin_item("square").outline.bounds
    (-50.0, -50.0, 50.0, 50.0)
    """
    drawn = _drawing("icons", name)
    if drawn is not None:
        return item_of_svg(drawn, name, name, holes)
    with naming(name):
        shape = primitive(name)
    if shape is None:
        raise unknown_name(name, item_names(), "item")
    outline, ink, _ = centred(shape, holes)
    return Item(name, name, outline, ink, FlatArt(_colour(name)))


def builtin_container(name: str, side: float = 600.0) -> Container:
    """Container by name: a bundled drawing, else a plain shape that fills its canvas.

    Parameters
    ----------
    side
        Longer side of the canvas, in canvas units.

    Raises
    ------
    ReadError
        If there is no such name; the message names close ones.

    Examples
    --------
    >>> stripe = builtin_container("stripe:6", 300.0)
    >>> stripe.width, stripe.height
    (300.0, 50.0)
    """
    drawn = _drawing("containers", name)
    if drawn is not None:
        return container_of_svg(drawn, name, name, side)
    with naming(name):
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
    """
    names = list(known)
    if name.isdecimal():
        return ReadError(name, f"is no {kind}; -n {name} asks for so many")
    if name.lower().removesuffix("-landscape") in SHEETS:
        return ReadError(name, f"is a sheet; the whole of it is: page --canvas {name}")
    close = difflib.get_close_matches(name, names, n=3, cutoff=0.6)
    hint = f"did you mean {' or '.join(close)}?" if close else f"built in are {', '.join(names)}"
    return ReadError(name, f"there is no such file and no built-in {kind} of that name; {hint}")


def _colour(name: str) -> str:
    order = sorted(PATHS).index(name) if name in PATHS else len(PATHS)
    return COLOURS[order % len(COLOURS)]


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

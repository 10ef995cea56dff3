"""SVG transform lists and viewports to affine maps."""

from __future__ import annotations

import math
import re

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.svg_syntax.lengths import NUMBER, checked, parse_numbers

_CALL = re.compile(r"[\s,]*([A-Za-z]+)\s*\(([^()]*)\)")
_UNIT = re.compile(rf"(?<![\d.])({NUMBER})\s*(deg|grad|rad|turn|px)", re.IGNORECASE)
_DEGREES = {"deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0, "px": 1.0}


def parse_transform(text: str | None) -> FloatArray:
    """Map of a ``transform`` attribute or property; the identity if it is none.

    Examples
    --------
    >>> parse_transform("translate(10) scale(2)").tolist()
    [[2.0, 0.0, 10.0], [0.0, 2.0, 0.0]]
    """
    matrix = affine.identity()
    place = 0
    plain = _UNIT.sub(_without_unit, text or "")
    while match := _CALL.match(plain, place):
        step = _call(match.group(1).lower(), parse_numbers(match.group(2)))
        if step is None:
            return affine.identity()
        matrix = affine.compose(matrix, step)
        place = match.end()
    for number in matrix.flat:
        checked(float(number))
    return matrix if not plain[place:].strip() else affine.identity()


def view_matrix(
    view: tuple[float, float, float, float], width: float, height: float, fit: str
) -> FloatArray:
    """Map of a ``viewBox`` into a viewport of ``width`` x ``height`` at the origin.

    Parameters
    ----------
    view
        Left, top, width and height of the box, both sizes positive.
    fit
        ``preserveAspectRatio``; empty means ``xMidYMid meet``.

    Examples
    --------
    >>> view_matrix((0, 0, 10, 10), 40, 20, "").tolist()
    [[2.0, 0.0, 10.0], [0.0, 2.0, 0.0]]
    """
    across, down = width / view[2], height / view[3]
    words = fit.split()
    align = words[0].lower() if words else "xmidymid"
    if align != "none":
        slices = len(words) > 1 and words[1].lower() == "slice"
        across = down = max(across, down) if slices else min(across, down)
    x = _share(align, "x") * (width - across * view[2]) - across * view[0]
    y = _share(align, "y") * (height - down * view[3]) - down * view[1]
    return np.array([[across, 0.0, x], [0.0, down, y]])


def _without_unit(match: re.Match[str]) -> str:
    return f"{float(match.group(1)) * _DEGREES[match.group(2).lower()]:.12g}"


def _share(align: str, axis: str) -> float:
    """Share of the room left over that lies before the picture."""
    if f"{axis}min" in align:
        return 0.0
    if f"{axis}max" in align:
        return 1.0
    return 0.0 if align == "none" else 0.5


def _call(name: str, args: list[float]) -> FloatArray | None:
    """Map of one function of the list, None if its arguments make no sense."""
    count = len(args)
    if name == "matrix" and count == 6:
        return np.array([[args[0], args[2], args[4]], [args[1], args[3], args[5]]])
    if name == "rotate" and count in {1, 3}:
        turn = affine.similarity(0.0, 0.0, math.radians(args[0]), 1.0)
        x, y = args[1:] if count == 3 else (0.0, 0.0)
        return affine.compose(affine.compose(_shift(x, y), turn), _shift(-x, -y))
    if name == "scale" and count in {1, 2}:
        return np.array([[args[0], 0.0, 0.0], [0.0, args[-1], 0.0]])
    if name in {"scalex", "scaley"} and count == 1:
        across, down = (args[0], 1.0) if name == "scalex" else (1.0, args[0])
        return np.array([[across, 0.0, 0.0], [0.0, down, 0.0]])
    if name == "skew" and count in {1, 2}:
        across, down = math.tan(math.radians(args[0])), math.tan(math.radians((*args, 0.0)[1]))
        return np.array([[1.0, across, 0.0], [down, 1.0, 0.0]])
    if name in {"skewx", "skewy"} and count == 1:
        slant = math.tan(math.radians(args[0]))
        across, down = (slant, 0.0) if name == "skewx" else (0.0, slant)
        return np.array([[1.0, across, 0.0], [down, 1.0, 0.0]])
    if name == "translate" and count in {1, 2}:
        return _shift(args[0], args[1] if count == 2 else 0.0)
    if name in {"translatex", "translatey"} and count == 1:
        return _shift(args[0], 0.0) if name == "translatex" else _shift(0.0, args[0])
    return None


def _shift(x: float, y: float) -> FloatArray:
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y]])

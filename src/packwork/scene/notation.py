"""Numbers, names and ids in XML: short, and safe whatever they hold."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.arcs import STRAIGHT, ArcLine, divided, radius_of
from packwork.geometry.outline import Outline

MAX_DECIMALS = 24
"""Digits after the point at most: enough for items a billion times their canvas. Chosen."""

_NOT_XML = "[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"
_ESCAPES = str.maketrans(
    {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\n": " ", "\r": " ", "\t": " "}
)
_ID = re.compile(r"""\bid\s*=\s*(["'])([^"']+)\1""")


def decimals(step: float) -> int:
    """Digits after the point so that the last one counts no more than ``step``.

    Examples
    --------
    >>> decimals(0.02), decimals(0.01), decimals(5.0)
    (2, 2, 0)
    """
    return min(max(math.ceil(-math.log10(step) - 1e-9), 0), MAX_DECIMALS)


def finer_decimals(matrix: FloatArray) -> int:
    """Digits more that are wanted in units of which a map (2 x 3) makes larger ones.

    >>> import numpy as np
    >>> finer_decimals(20.0 * np.eye(2, 3)), finer_decimals(0.5 * np.eye(2, 3))
    (2, 0)
    """
    return max(0, math.ceil(math.log10(np.linalg.norm(matrix[:, :2], 2))))


def number(value: float, digits: int) -> str:
    """Fixed-point text without idle zeros; never an exponent, never ``-0``.

    Examples
    --------
    >>> number(2.50001, 3), number(-0.0001, 2), number(100, 0)
    ('2.5', '0', '100')
    """
    text = f"{value:.{digits}f}"
    if digits:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def matrix_text(matrix: FloatArray, digits: int = 12) -> str:
    """Affine map (2 x 3), in user units, as an SVG ``transform``, to so many significant digits.

    Examples
    --------
    >>> import numpy as np
    >>> matrix_text(np.array([[2.0, 0.0, 5.0], [0.0, 2.0, 7.5]]))
    'matrix(2 0 0 2 5 7.5)'
    """
    # Adding nothing makes a plain zero of a negative one.
    return "matrix(" + " ".join(f"{v + 0.0:.{digits}g}" for v in matrix.T.ravel()) + ")"


def path_data(outline: Outline, digits: int) -> str:
    """SVG path of an outline's rings, absolute coordinates.

    Absolute, as relative ones would add up their rounding in readers that count in
    single precision.

    Examples
    --------
    >>> import numpy as np
    >>> path_data(Outline.from_rings([np.array([[0, 0], [2, 0], [2, 1.5]])]), 3)
    'M0 0 2 0 2 1.5Z'
    """
    return "".join(f"M{points_text(ring, digits)}Z" for ring in outline.rings)


SHORT_ARC = math.pi / 5
"""Longest arc of a path, in radians: programs make cubics of them, which lie off it by 1.2e-6 of
the radius, longer ones by more. Derived."""

WIDEST_ARC = 1e6
"""Largest radius of an arc, in the path's unit, whatever else would do: programs that count in
single precision, or bound their numbers, lose larger ones. Chosen."""


def arc_path_data(line: ArcLine, digits: int) -> str:
    """SVG path of a line with arcs, absolute coordinates.

    Examples
    --------
    >>> from packwork.geometry.arcs import arc
    >>> arc_path_data(arc((0.0, 0.0), 2.0, 0.0, 0.5), 2)
    'M2 0A2 2 0 0 1 1.94 0.49A2 2 0 0 1 1.76 0.96'
    >>> arc_path_data(ArcLine(np.array([[0.0, 0.0], [80.0, 0.0]]), np.array([1e-5, 0.0])), 4)
    'M0 0Q40 -0.0008 80 0'

    The parabola is one only where that is within half of the last digit:

    >>> arc_path_data(ArcLine(np.array([[-3e6, 0.0], [3e6, 0.0]]), np.array([0.1, 0.0])), 0)
    'M-3000000 0A15150000 15150000 0 0 1 3000000 0'
    """
    made = [f"M{points_text(line.points[:1], digits)}"]
    # A straight side at the end of a closed line is drawn by its Z.
    sides = line.sides - int(line.is_closed and abs(line.bulges[-1]) <= STRAIGHT)
    for start, end, bulge in zip(
        line.points[:sides], line.ends, line.bulges.tolist(), strict=False
    ):
        if abs(bulge) <= STRAIGHT:
            made.append(f"L{points_text(end[None], digits)}")
            continue
        chord = end - start
        # Of one sagitta, the two differ by a quarter of the bulge's square times that, at most.
        off = abs(bulge) ** 3 * math.hypot(*chord) / 8.0
        if off <= 0.5 * 10.0**-digits and radius_of(start, end, bulge) > WIDEST_ARC:
            top = (start + end) / 2.0 + bulge * np.array([chord[1], -chord[0]])
            made.append(f"Q{points_text(np.array([top, end]), digits)}")
            continue
        radius, sweep = f"{radius_of(start, end, bulge):.12g}", int(bulge > 0)
        made += [
            f"A{radius} {radius} 0 0 {sweep} {points_text(point[None], digits)}"
            for point in divided(start, end, bulge, SHORT_ARC)
        ]
    return "".join(made) + ("Z" if line.is_closed else "")


def cubic_path_data(cubics: FloatArray, digits: int) -> str:
    """SVG path of closed cubics end to end, ``(k, 4, 2)``.

    >>> import numpy as np
    >>> cubic_path_data(np.array([[[0, 0], [0, 2], [1, 3], [3, 3]]]), 2)
    'M0 0C0 2 1 3 3 3Z'
    """
    # The handles of a straight line lie at its thirds but for rounding.
    bends = np.abs(np.diff(cubics, n=2, axis=1)).max(axis=(1, 2))
    drawn = "".join(
        f"C{points_text(one[1:], digits)}" if bend > 10.0**-digits
        else f"L{points_text(one[3:], digits)}"
        for one, bend in zip(cubics, bends.tolist(), strict=True)
    )  # fmt: skip
    return f"M{points_text(cubics[0, :1], digits)}{drawn}Z"


def points_text(points: FloatArray, digits: int) -> str:
    """Coordinates ``(n, 2)``, in any unit, one after another.

    Examples
    --------
    >>> import numpy as np
    >>> points_text(np.array([[0, 0], [2, 1.5]]), 3)
    '0 0 2 1.5'
    """
    return " ".join([number(v, digits) for v in points.ravel().tolist()])


def xml_text(text: str) -> str:
    """Text fit for XML content and attributes; what XML forbids becomes U+FFFD.

    Examples
    --------
    >>> xml_text('R&D <"1">')
    'R&amp;D &lt;&quot;1&quot;&gt;'
    """
    return sound_text(text).translate(_ESCAPES)


def sound_text(text: str) -> str:
    """Text that can be encoded and shown; control characters become U+FFFD.

    Examples
    --------
    >>> sound_text("R&D" + chr(0)) == "R&D" + chr(0xFFFD)
    True
    """
    # Compiled when it is first needed, and then kept by Python: that takes milliseconds.
    return text if text.isascii() and text.isprintable() else re.sub(_NOT_XML, "\ufffd", text)


def attributes(pairs: Mapping[str, str]) -> str:
    """Attributes ready to follow an element's name; empty ones are left out.

    Examples
    --------
    >>> attributes({"id": "item-1", "fill": ""})
    ' id="item-1"'
    """
    return "".join(f' {name}="{xml_text(value)}"' for name, value in pairs.items() if value)


def with_fresh_ids(markup: str, suffix: str) -> str:
    """Markup whose ids, and what refers to them, end in ``suffix``.

    A document may hold each id once, so a second copy in place needs ids of its own.

    Examples
    --------
    >>> with_fresh_ids('<g id="a"><use href="#a"/><b fill="url(#a)" x="#ab"/></g>', "-2")
    '<g id="a-2"><use href="#a-2"/><b fill="url(#a-2)" x="#ab"/></g>'
    """
    ids = {m.group(2) for m in _ID.finditer(markup)}
    if not ids:
        return markup
    longest_first = "|".join(re.escape(i) for i in sorted(ids, key=lambda i: (-len(i), i)))
    uses = re.compile(rf"""(\bid\s*=\s*["']|\#)({longest_first})(?![\w.:-])""")
    return uses.sub(rf"\g<1>\g<2>{suffix}", markup)

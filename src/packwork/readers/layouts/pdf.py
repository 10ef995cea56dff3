"""Reader of the paint in a PDF of ours, from its own text: operators of its page's content.

Paths come as those of an SVG do, in CSS pixels of the sheet that is left after trimming, so that
both can be held against each other. Operators are those of ISO 32000-1, annex A.
"""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import FillRule
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.painted import Clip, Painted, Painting, StrokeStyle
from packwork.readers.svg_syntax.path_data import PathBuilder, SubPath
from packwork.units import convert

MAX_OPERATORS = 5_000_000
"""Operators of one page. Larger takes minutes to read. Chosen."""

_DEEPEST = 40
"""Forms in forms. Deeper ones are drawn by no program. Chosen."""

_CAPS, _JOINS = ("butt", "round", "square"), ("miter", "round", "bevel")
_NOWHERE = ET.Element("path")

_DRAWN = {"m": "M", "l": "L", "c": "C", "h": "Z"}
"""Operators of paths, as path data of SVG has them."""

_FILLS: Mapping[str, FillRule] = MappingProxyType(
    {"f": "nonzero", "F": "nonzero", "f*": "evenodd", "B": "nonzero", "b": "nonzero",
     "B*": "evenodd", "b*": "evenodd"}
)  # fmt: skip
_CLIPS: Mapping[str, FillRule] = MappingProxyType({"W": "nonzero", "W*": "evenodd"})
_STROKES = frozenset({"S", "s", "B", "B*", "b", "b*"})
_CLOSING = frozenset({"s", "b", "b*"})
_PAINTING = _FILLS.keys() | _STROKES | {"n"}
_TEXT = frozenset({"Tj", "TJ", "'", '"'})
_UNSEEN = 3
"""Mode of text in which nothing is painted."""


@dataclass(frozen=True, kw_only=True)
class PrintedPage:
    """A page's paint: the trimmed sheet in CSS pixels, and shapes in painting order."""

    width: float
    height: float
    shapes: list[Painted]


def printed_page(data: bytes) -> PrintedPage:
    """Paint of a PDF's page."""
    import pikepdf

    try:
        with pikepdf.open(io.BytesIO(data)) as pdf:
            if len(pdf.pages) != 1:
                raise UnfitError(f"has {len(pdf.pages)} pages instead of one")
            page = pdf.pages[0]
            left, low, right, high = (float(side) for side in page.trimbox)
            px = convert(1.0, "pt", "px")
            to_px = np.array([[px, 0.0, -px * left], [0.0, -px, px * high]])
            reading = _Reading()
            reading.follow(page.obj, page.obj.get("/Resources", {}), _State(matrix=to_px))
    except pikepdf.PdfError as error:
        raise UnfitError(f"is no PDF that can be read ({error})") from None
    return PrintedPage(
        width=px * (right - left),
        height=px * (high - low),
        shapes=reading.shapes,
    )


@dataclass(frozen=True)
class _State:
    """The graphics state, as far as it is geometry."""

    matrix: FloatArray
    pen: StrokeStyle = field(default_factory=lambda: StrokeStyle(miter_limit=10.0))
    clips: tuple[Clip, ...] = ()
    text_mode: int = 0


@final
class _Reading:
    """Follows content and collects what it paints."""

    def __init__(self) -> None:
        self.shapes: list[Painted] = []
        self._count = 0

    def follow(self, stream: Any, resources: Any, state: _State, depth: int = 0) -> None:
        """Follow the content of a page or a form from a state on."""
        if depth > _DEEPEST:
            raise UnfitError("has forms nested too deeply")
        kept: list[_State] = []
        path, clip = PathBuilder(), ""
        for operands, name in _instructions(stream):
            self._count += 1
            if self._count > MAX_OPERATORS:
                raise UnfitError(f"has more than {MAX_OPERATORS:,} operators")
            if name in _DRAWN:
                path.draw(_DRAWN[name], [float(v) for v in operands])
            elif name == "re":
                _draw_box(path, *(float(v) for v in operands))
            elif name in _CLIPS:
                clip = name
            elif name in _PAINTING:
                if name in _CLOSING:
                    path.draw("Z", [])
                pieces, path = path.finished(), PathBuilder()
                for painting in _paintings(name, state):
                    self.shapes += [_painted(pieces, painting, state)] if pieces else []
                if clip:
                    cut = _painted(pieces, Painting(fill_rule=_CLIPS[clip]), state)
                    state = replace(state, clips=(*state.clips, Clip((cut,))))
                    clip = ""
            elif name == "q":
                kept.append(state)
            elif name == "Q" and kept:
                state = kept.pop()
            elif name == "Do":
                self._draw(resources["/XObject"][operands[0]], resources, state, depth)
            elif name in _TEXT and state.text_mode == _UNSEEN:
                continue
            elif name in {"sh", "INLINE IMAGE", *_TEXT}:
                raise UnfitError(f"paints by {name}, which no PDF of ours does")
            else:
                state = self._changed(state, name, operands, resources)

    def _draw(self, drawn: Any, resources: Any, state: _State, depth: int) -> None:
        """Follow a form, or note a picture's frame."""
        if drawn.Subtype == "/Image":
            frame = PathBuilder()
            _draw_box(frame, 0.0, 0.0, 1.0, 1.0)
            self.shapes.append(_painted(frame.finished(), Painting(), state))
            return
        own = affine.compose(state.matrix, matrix_of(drawn.get("/Matrix", (1, 0, 0, 1, 0, 0))))
        inside = replace(state, matrix=own)
        self.follow(drawn, drawn.get("/Resources", resources), inside, depth + 1)

    def _changed(self, state: _State, name: str, operands: Sequence[Any], found: Any) -> _State:
        pen = state.pen
        if name == "Tr":
            return replace(state, text_mode=int(operands[0]))
        if name == "cm":
            return replace(state, matrix=affine.compose(state.matrix, matrix_of(operands)))
        if name == "w":
            pen = replace(pen, width=float(operands[0]))
        elif name == "J":
            pen = replace(pen, cap=_CAPS[int(operands[0])])
        elif name == "j":
            pen = replace(pen, join=_JOINS[int(operands[0])])
        elif name == "M":
            pen = replace(pen, miter_limit=float(operands[0]))
        elif name == "d":
            dashes = tuple(float(v) for v in operands[0])
            pen = replace(
                pen, dashes=dashes * (1 + len(dashes) % 2), dash_offset=float(operands[1])
            )
        return state if pen is state.pen else replace(state, pen=pen)


def _instructions(stream: Any) -> Iterator[tuple[Any, str]]:
    import pikepdf

    for one in pikepdf.parse_content_stream(stream):
        yield one.operands, str(one.operator)


def _draw_box(path: PathBuilder, x: float, y: float, width: float, height: float) -> None:
    path.draw("M", [x, y])
    for corner in ([x + width, y], [x + width, y + height], [x, y + height]):
        path.draw("L", corner)
    path.draw("Z", [])


def _paintings(name: str, state: _State) -> list[Painting]:
    fills = [Painting(fill_rule=_FILLS[name])] if name in _FILLS else []
    is_stroked = name in _STROKES
    return [*fills, *([Painting(fill="none", stroke="black", pen=state.pen)] if is_stroked else [])]


def _painted(pieces: list[SubPath], painting: Painting, state: _State) -> Painted:
    return Painted(pieces, state.matrix, painting, None, _NOWHERE, state.clips)


def matrix_of(numbers: Any) -> FloatArray:
    """Map, 2 x 3, of the six numbers of a PDF."""
    a, b, c, d, e, f = (float(v) for v in numbers)
    return np.array([[a, c, e], [b, d, f]])

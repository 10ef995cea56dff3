"""Preflight: what a print shop looks at in a PDF or SVG before it prints.

The page's content is followed with all that it paints (operators of ISO 32000-1, annex A); an SVG
is set on a page first.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, final

import numpy as np
import pikepdf
import typst

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.phrasing import number_of
from packwork.readers.gate.door import parse_xml
from packwork.readers.layouts.pdf import matrix_of
from packwork.readers.reading import UnfitError, notice, read_bytes, reading_file
from packwork.readers.svg_syntax.coordinates import read_page
from packwork.scene.layout import Layout
from packwork.units import convert
from packwork.verify.graphics_state import NOWHERE, Graphics, corners, scale_of
from packwork.verify.near_trim import HAIR_PT, NEAR_MM, SEEN_PT, ending_near
from packwork.verify.pdf_fonts import MOST_WIDTHS, FontWidths
from packwork.verify.pdf_objects import TOO_MUCH, check_size, listed, space_name

MAX_BYTES = 500_000_000
"""Bytes of a file at most. Chosen."""

MAX_CONTENT = 20_000_000
"""Bytes of what a page paints at most, forms as often as they are drawn. Larger takes more than
ten seconds. Measured."""

_FORM_BYTES = 1_000
"""What following a form costs besides, in bytes of content."""

LEAST_DPI = 300.0
"""Pixels to the inch that print shops ask of pictures."""

LEAST_LINE_PT = 0.25
"""Width below which a line may break in print."""

LEAST_TEXT_PT = 5.0
"""Em below which letters may fill up in print."""

_DEEPEST = 40
_PAINTING = frozenset({"f", "F", "f*", "B", "B*", "b", "b*", "S", "s"})
_STROKES = frozenset({"S", "s", "B", "B*", "b", "b*"})
_POINTS = {"m": 1, "l": 1, "c": 3, "v": 2, "y": 2}
_DEVICE = {"rg": "RGB", "g": "grey", "k": "CMYK"}
_MALFORMED = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What comes of content that is not as the standard has it."""


@dataclass(frozen=True)
class Check:
    """One line of a preflight: what was looked at, what was met, and whether that is well."""

    about: str
    found: str
    is_well: bool


def preflight(path: str | Path) -> list[Check]:
    """Checks of a PDF or SVG file.

    A ReadError if it is none, or has more pages than one.
    """
    ending = Path(path).suffix.lower()
    if ending not in {".pdf", ".svg"}:
        raise ReadError(path, "is no PDF or SVG, which alone are looked at before they are printed")
    return preflight_of(read_bytes(path, MAX_BYTES), path)


def preflight_of(data: bytes, path: str | Path, layout: Layout | None = None) -> list[Check]:
    """Checks of a file's content; of the words of its layout too, which are curves in a PDF."""
    with reading_file(str(path)):
        if Path(path).suffix.lower() == ".svg":
            data = _printed(data, path)
        try:
            with pikepdf.open(io.BytesIO(data)) as pdf:
                if len(pdf.pages) != 1:
                    raise ReadError(path, f"has {len(pdf.pages)} pages; one is looked at")
                found = _Content(pdf).checks(_ems(layout))
                if pdf.get_warnings():
                    notice("is damaged; there may be more in it than was looked at")
                return found
        except pikepdf.PasswordError:
            raise ReadError(path, "is encrypted; take the password off") from None
        except (pikepdf.PdfError, *_MALFORMED) as error:
            reason = str(error).rpartition(">: ")[2]
            raise ReadError(path, f"is no PDF that can be read ({reason})") from None


def _printed(data: bytes, path: str | Path) -> bytes:
    """PDF of an SVG, at its size."""
    page = read_page(parse_xml(data))
    if page is None:
        raise ReadError(path, "has no size")
    width, height = (convert(side, "px", "pt") for side in (page.width, page.height))
    source = (
        f"#set page(width: {width:.9f}pt, height: {height:.9f}pt, margin: 0pt)\n"
        '#image(bytes(sys.inputs.drawing), format: "svg", width: 100%, height: 100%)'
    )
    try:
        return typst.compile(source.encode(), sys_inputs={"drawing": data.decode("utf-8")})
    except (RuntimeError, UnicodeDecodeError) as error:
        raise ReadError(path, f"cannot be rendered ({error})") from None


def _ems(layout: Layout | None) -> list[float]:
    """Heights of an em, in points, of the words of a layout."""
    if layout is None:
        return []
    scales, pt = layout.poses.scale.tolist(), convert(1.0, layout.container.unit, "pt")
    return [
        run.size * scale_of(item.art.matrix) * scale * pt
        for item, scale in zip(layout.items, scales, strict=True)
        if item.text is not None and hasattr(item.art, "matrix")
        for run in item.text.runs
    ]


@final
class _Content:
    """All that a page paints, counted."""

    def __init__(self, pdf: pikepdf.Pdf) -> None:
        page = pdf.pages[0]
        unit = float(page.obj.get("/UserUnit", 1))
        self._trim = unit * _box(page.trimbox)
        self._bleed = unit * _box(page.obj.get("/BleedBox", page.trimbox))
        self._intents = [
            str(one.get("/OutputConditionIdentifier", ""))
            for one in pdf.Root.get("/OutputIntents", [])
        ]
        with pdf.open_metadata() as meta:
            self._standard = str(meta.get("pdfxid:GTS_PDFXVersion", ""))
        self._dpi: list[float] = []
        self._lines: list[float] = []
        self._ems: list[float] = []
        self._spaces: Counter[str] = Counter()
        self._inks: set[str] = set()
        self._clear: Counter[str] = Counter()
        self._painted_boxes: list[FloatArray] = []
        self._fonts: dict[tuple[int, int], FontWidths] = {}
        self._widths_left = MOST_WIDTHS
        self._inked = np.array([[np.inf, np.inf], [-np.inf, -np.inf]])
        self._left = MAX_CONTENT
        if "/Contents" in page.obj:
            for part in listed(page.obj.Contents):
                check_size(part, self._left)
            page.contents_coalesce()
            resources: Any = page.obj.get("/Resources", {})
            state = Graphics(affine.similarity(0.0, 0.0, 0.0, unit))
            self._follow(page.obj.Contents, resources, state, 0)

    def checks(self, ems: Sequence[float]) -> list[Check]:
        """Lines of the table; ``ems`` are heights of letters that are curves here."""
        return [
            self._boxes(), self._resolution(), self._thin(), self._letters([*self._ems, *ems]),
            self._transparency(), self._edge(), self._colours(), self._intent(),
        ]  # fmt: skip

    def _boxes(self) -> Check:
        width, height = np.diff(self._trim, axis=0)[0] / 72 * 25.4
        bleed = float(np.min([self._trim[0] - self._bleed[0], self._bleed[1] - self._trim[1]]))
        told = f"bleed {bleed / 72 * 25.4:.3g} mm" if bleed > HAIR_PT else "no bleed"
        return Check("trimmed sheet", f"{width:.4g} x {height:.4g} mm, {told}", bleed > HAIR_PT)

    def _resolution(self) -> Check:
        low = [dpi for dpi in self._dpi if dpi < LEAST_DPI]
        told = number_of(len(self._dpi), "picture") if self._dpi else "none"
        if self._dpi:
            told += f", {min(self._dpi):.0f} to {max(self._dpi):.0f} pixels to the inch"
        told += f"; {len(low)} under {LEAST_DPI:.0f}" if low else ""
        return Check("pictures", told, not low)

    def _thin(self) -> Check:
        thin = [width for width in self._lines if width < LEAST_LINE_PT - HAIR_PT]
        told = f"thinnest {min(self._lines):.2f} pt" if self._lines else "none"
        told += f"; {len(thin)} under {LEAST_LINE_PT} pt" if thin else ""
        return Check("lines", told, not thin)

    @staticmethod
    def _letters(ems: Sequence[float]) -> Check:
        small = [em for em in ems if em < LEAST_TEXT_PT]
        told = (
            f"smallest {min(ems):.1f} pt" if ems else "none; letters that are curves are not seen"
        )
        told += f"; {len(small)} under {LEAST_TEXT_PT:g} pt" if small else ""
        return Check("text", told, not small)

    def _transparency(self) -> Check:
        told = [number_of(n, *names.split("|")) for names, n in self._clear.items() if n]
        return Check("transparency", ", ".join(told) or "none", not told)

    def _edge(self) -> Check:
        count = ending_near(np.reshape(self._painted_boxes, (-1, 2, 2)), self._trim)
        told = f"{number_of(count, 'shape ends', 'shapes end')} there"
        return Check(f"within {NEAR_MM:g} mm of the trim", told if count else "none", not count)

    def _colours(self) -> Check:
        told = [f"{space} {count:,}" for space, count in sorted(self._spaces.items())]
        told += [f"ink {name}" for name in sorted(self._inks)]
        return Check("colours", ", ".join(told) or "none", "RGB" not in self._spaces)

    def _intent(self) -> Check:
        told = " ".join([*self._intents, self._standard]).strip()
        return Check("output intent", told or "none", bool(told))

    def _follow(self, stream: Any, resources: Any, state: Graphics, depth: int) -> None:
        check_size(stream, self._left)
        self._left -= len(stream.read_bytes()) + _FORM_BYTES
        if self._left < 0 or depth > _DEEPEST:
            raise UnfitError(TOO_MUCH)
        kept: list[Graphics] = []
        points: list[FloatArray] = []
        clips = False
        for one in pikepdf.parse_content_stream(stream):
            operands, name = one.operands, str(one.operator)
            if name in _POINTS:
                points.append(np.reshape([float(v) for v in operands], (-1, 2)))
            elif name == "re":
                x, y, wide, high = (float(v) for v in operands)
                points.append(corners(x, y, x + wide, y + high))
            elif name in {"W", "W*"}:
                clips = True
            elif name in _PAINTING or name == "n":
                box = state.bounds(points) if points else None
                if box is not None and name != "n":
                    self._lines += [state.line_pt] if name in _STROKES else []
                    self._paint(box, (name not in {"S", "s"}, name in _STROKES), state)
                if clips and box is not None:
                    state = replace(state, window=box)
                points, clips = [], False
            elif name == "q":
                kept.append(state)
            elif name == "Q" and kept:
                state = kept.pop()
            elif name == "Do":
                self._drawn(resources["/XObject"][operands[0]], resources, state, depth)
            elif name == "INLINE IMAGE":
                self._picture(operands[0].obj, resources, state)
            elif name in {"Tj", "TJ", "'", '"'}:
                shown = operands[0] if name == "TJ" else operands[-1:]
                state = self._lettered(state.after(name, operands), shown)
            else:
                state = self._changed(state, name, operands, resources, depth)

    def _paint(self, box: FloatArray, paints: tuple[bool, bool], state: Graphics) -> None:
        """Count what is filled, or stroked, or both."""
        for space in (state.spaces[k] for k in (0, 1) if paints[k]):
            self._count(space)
        if any(state.alphas[k] < 1 for k in (0, 1) if paints[k]):
            self._clear["opacity|opacities"] += 1
        is_bare = all(state.bare[k] for k in (0, 1) if paints[k])
        if is_bare and not ((box[0] < self._inked[1]) & (box[1] > self._inked[0])).all():
            # White on bare paper, as the ground that many programs paint, ends nowhere to be seen.
            return
        self._placed(box)

    def _placed(self, box: FloatArray) -> None:
        self._inked[0] = np.minimum(self._inked[0], box[0])
        self._inked[1] = np.maximum(self._inked[1], box[1])
        self._painted_boxes.append(box)

    def _lettered(self, state: Graphics, operands: Any) -> Graphics:
        """Count letters that are shown; those of a mode that paints nothing are not."""
        box, after = state.shown(operands)
        if any(state.text_paints):
            self._paint(box, state.text_paints, state)
            self._ems.append(state.em_pt)
        return after

    def _count(self, space: str) -> None:
        if space.startswith("ink "):
            self._inks.add(space.removeprefix("ink "))
        elif space:
            self._spaces[space] += 1

    def _drawn(self, drawn: Any, resources: Any, state: Graphics, depth: int) -> None:
        if drawn.Subtype == "/Image":
            self._picture(drawn, resources, state)
            return
        if "/Group" in drawn and state.alphas[0] < 1:
            # The whole is as opaque as that, and in itself all of it is.
            self._clear["opacity|opacities"] += 1
            state = replace(state, alphas=(1.0, 1.0))
        own = affine.compose(state.matrix, matrix_of(drawn.get("/Matrix", (1, 0, 0, 1, 0, 0))))
        state = replace(state, matrix=own)
        if "/BBox" in drawn:
            box = corners(*(float(v) for v in drawn.BBox))
            state = replace(state, window=state.bounds([box]))
        self._follow(drawn, drawn.get("/Resources", resources), state, depth + 1)

    def _picture(self, drawn: Any, resources: Any, state: Graphics) -> None:
        box = state.bounds([corners(0.0, 0.0, 1.0, 1.0)])
        self._placed(box)
        if state.alphas[0] < 1:
            self._clear["opacity|opacities"] += 1
        if (box[1] > self._trim[0] + SEEN_PT).all() and (box[0] < self._trim[1] - SEEN_PT).all():
            inches = np.hypot(*state.matrix[:, :2]) / 72
            size = np.array([float(drawn.Width), float(drawn.Height)])
            self._dpi.append(float((size / inches).min()))
        space = drawn.get("/ColorSpace", pikepdf.Name.DeviceGray)
        is_mask = bool(drawn.get("/ImageMask", False))
        self._count(state.spaces[0] if is_mask else space_name(space, resources))
        if "/SMask" in drawn:
            self._clear["soft edge|soft edges"] += 1

    def _changed(
        self, state: Graphics, name: str, operands: Any, resources: Any, depth: int
    ) -> Graphics:
        if name == "gs":
            return self._set(state, resources["/ExtGState"][operands[0]])
        if name == "Tf":
            font = self._font(resources.get("/Font", {}).get(operands[0]))
            return replace(state, font=font, em=float(operands[1]))
        if name == "sh":
            shading = resources["/Shading"][operands[0]]
            self._count(space_name(shading.ColorSpace, resources))
            self._clear["opacity|opacities"] += state.alphas[0] < 1
        elif name.lower() == "cs":
            return state.coloured(name.isupper(), space_name(operands[0], resources), None)
        elif name.lower() in _DEVICE:
            return state.coloured(name.isupper(), _DEVICE[name.lower()], operands)
        elif name.lower() in {"sc", "scn"}:
            if operands and isinstance(operands[-1], pikepdf.Name):
                self._tiled(resources["/Pattern"][operands[-1]], resources, depth)
                operands = None
            return state.coloured(name.isupper(), state.spaces[name.isupper()], operands)
        return state.after(name, operands)

    def _font(self, font: Any) -> FontWidths:
        """Widths of a font, read once; usual ones of what stands in the resources themselves."""
        key = getattr(font, "objgen", (0, 0))
        if key not in self._fonts:
            found = FontWidths.of(font, self._widths_left) if key[0] else FontWidths()
            self._widths_left -= found.count
            self._fonts[key] = found
        return self._fonts[key]

    def _tiled(self, pattern: Any, resources: Any, depth: int) -> None:
        """Count what a pattern is painted with."""
        if "/Shading" in pattern:
            self._count(space_name(pattern.Shading.ColorSpace, resources))
        elif pattern.PatternType == 1:
            # The shape that it fills ends on the page, not its tiles.
            unseen = Graphics(affine.identity(), window=NOWHERE)
            self._follow(pattern, pattern.get("/Resources", {}), unseen, depth + 1)

    def _set(self, state: Graphics, settings: Any) -> Graphics:
        """State after a dictionary of settings; blend modes and masks in it are counted."""
        if settings.get("/BM", "/Normal") != "/Normal":
            self._clear["blend mode|blend modes"] += 1
        if isinstance(settings.get("/SMask"), pikepdf.Dictionary):
            self._clear["mask|masks"] += 1
        fill, stroke = (
            float(settings.get(key, had))
            for key, had in zip(("/ca", "/CA"), state.alphas, strict=True)
        )
        width = float(settings.get("/LW", state.width))
        return replace(state, alphas=(fill, stroke), width=width)


def _box(box: Any) -> FloatArray:
    return np.sort(np.reshape([float(v) for v in box], (2, 2)), axis=0)

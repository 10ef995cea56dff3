"""Colours of a PDF brought to inks: spot inks, and the four of a press's profile.

The PDF is one that Typst made: colours are sRGB or grey by ICC profiles, gradients interpolate,
pictures have eight bits a channel.
"""

from __future__ import annotations

import io
import logging
from collections.abc import Mapping
from decimal import Decimal
from typing import Any, TypeAlias, final

import pikepdf
from pikepdf import Array, Dictionary, Name

from packwork.phrasing import number_of
from packwork.scene.notation import number
from packwork.writers.prepress.profile import PressProfile

_LOG = logging.getLogger("packwork")

_Channels: TypeAlias = tuple[int, int, int]

JPEG_QUALITY = 95
"""Of photographs in inks. Larger files at more, traces of the second compression at less."""

_DIGITS = 4
"""Decimals of an amount of ink: finer than 8 bits."""


@final
class InkWriter:
    """Brings the colours of one PDF to inks; without a profile only those of spot inks."""

    def __init__(
        self, pdf: pikepdf.Pdf, profile: PressProfile | None, spots: Mapping[str, str]
    ) -> None:
        self._pdf, self._profile = pdf, profile
        self._spots = {_channels_of(colour): name for colour, name in spots.items()}
        self._spaces: dict[_Channels, Any] = {}
        self._known: dict[_Channels, tuple[float, ...]] = {}
        self._done: set[tuple[int, int]] = set()
        self._left = self._blended = 0

    def convert(self) -> None:
        """Convert the first page and all that it paints with; what cannot be is told."""
        page = self._pdf.pages[0]
        page.contents_coalesce()
        self._content(page.obj, page.obj.Contents)
        if self._profile is not None:
            page.obj.Group = Dictionary(S=Name.Transparency, CS=Name.DeviceCMYK)
        vain = [name for rgb, name in self._spots.items() if rgb not in self._spaces]
        if vain:
            _LOG.warning("nothing is drawn in the colour of the spot ink %s", " or ".join(vain))
        if self._blended:
            told = number_of(self._blended, "gradient has", "gradients have")
            _LOG.warning("%s the colour of a spot ink and no such ink", told)
        if self._left:
            told = number_of(self._left, "gradient stays", "gradients stay")
            _LOG.warning("%s in sRGB, which the press converts", told)

    def _content(self, holder: Any, stream: Any) -> None:
        """Convert a content stream; ``holder`` has its resources."""
        resources = holder.get("/Resources", Dictionary())
        spaces = resources.get("/ColorSpace", Dictionary())
        current: dict[bool, int] = {}
        kept: list[dict[bool, int]] = []
        written: list[Any] = []
        for one in pikepdf.parse_content_stream(stream):
            operands, operator = one.operands, str(one.operator)
            is_stroke = operator.isupper()
            if operator == "q":
                kept.append(dict(current))
            elif operator == "Q" and kept:
                current = kept.pop()
            elif operator.lower() == "cs":
                current[is_stroke] = _components(spaces.get(operands[0]))
            elif operator.lower() == "scn" and current.get(is_stroke):
                rgb = _bytes_of(operands)
                if self._profile is not None or rgb in self._spots:
                    written += self._set(rgb, is_stroke, resources)
                    continue
            written.append(one)
        stream.write(pikepdf.unparse_content_stream(written))
        self._resources(resources)

    def _set(self, rgb: _Channels, is_stroke: bool, resources: Any) -> list[Any]:
        """Instructions that set a colour, sRGB, in its ink."""

        def instruction(operands: list[Any], name: str) -> Any:
            name = name.upper() if is_stroke else name
            return pikepdf.ContentStreamInstruction(operands, pikepdf.Operator(name))

        if rgb in self._spots:
            spot = Name(f"/Spot{list(self._spots).index(rgb) + 1}")
            if "/ColorSpace" not in resources:
                resources.ColorSpace = Dictionary()
            resources.ColorSpace[spot] = self._separation(rgb)
            return [instruction([spot], "cs"), instruction([1], "scn")]
        return [instruction([_decimal(v) for v in self._inks(rgb)], "k")]

    def _separation(self, rgb: _Channels) -> Any:
        """Colour space of a spot ink, seen as the press or else the screen has its colour."""
        if rgb not in self._spaces:
            is_press = self._profile is not None
            tint = Dictionary(
                FunctionType=2,
                Domain=[0, 1],
                C0=[0] * 4 if is_press else [1] * 3,
                C1=[_decimal(v) for v in self._inks(rgb)],
                N=1,
            )
            base = Name.DeviceCMYK if is_press else Name.DeviceRGB
            space = Array([Name.Separation, Name(f"/{self._spots[rgb]}"), base, tint])
            self._spaces[rgb] = self._pdf.make_indirect(space)
        return self._spaces[rgb]

    def _inks(self, rgb: _Channels) -> tuple[float, ...]:
        """Amounts of the press's inks; without a profile of red, green and blue."""
        if rgb not in self._known:
            press = self._profile
            shares = tuple(v / 255 for v in rgb)
            self._known[rgb] = shares if press is None else press.inks(rgb)
        return self._known[rgb]

    def _resources(self, resources: Any) -> None:
        """Convert what content paints with; masks stay, whose colours are no paint."""
        for drawn in resources.get("/XObject", Dictionary()).values():
            if not self._is_new(drawn):
                continue
            if drawn.Subtype == "/Image":
                self._picture(drawn)
                continue
            if self._profile is not None and "/Group" in drawn:
                drawn.Group.CS = Name.DeviceCMYK
            self._content(drawn, drawn)
        for pattern in resources.get("/Pattern", Dictionary()).values():
            if pattern.PatternType == 2:
                self._shading(pattern.Shading)
            elif self._is_new(pattern):
                self._content(pattern, pattern)
        for shading in resources.get("/Shading", Dictionary()).values():
            self._shading(shading)

    def _is_new(self, found: Any) -> bool:
        is_new = found.objgen not in self._done
        self._done.add(found.objgen)
        return is_new

    def _shading(self, shading: Any) -> None:
        if not _components(shading.ColorSpace):
            return
        self._blended += not self._spots.keys().isdisjoint(_ends(shading.Function))
        if self._profile is None:
            return
        converted = self._function(shading.Function)
        if converted is None:
            self._left += 1
            return
        shading.ColorSpace, shading.Function = Name.DeviceCMYK, converted

    def _function(self, function: Any) -> Any:
        """Function from a share to inks, of one to sRGB or grey; None of unknown kinds."""
        about = {key: value for key, value in function.items() if key != "/Range"}
        if function.FunctionType == 2:
            ends = {key: self._inks(_bytes_of(function[key])) for key in ("/C0", "/C1")}
            return Dictionary(
                about | {key: Array([_decimal(v) for v in ink]) for key, ink in ends.items()}
            )
        if function.FunctionType == 3:
            parts = [self._function(part) for part in function.Functions]
            return None if None in parts else Dictionary(about | {"/Functions": Array(parts)})
        return None

    def _picture(self, drawn: Any) -> None:
        if self._profile is None or not _components(drawn.get("/ColorSpace")):
            return
        is_photo = drawn.get("/Filter") == "/DCTDecode"
        picture = pikepdf.PdfImage(drawn).as_pil_image().convert("RGB")
        separated = self._profile.separated(picture)
        for key in ("/Decode", "/DecodeParms"):
            if key in drawn:
                del drawn[key]
        drawn.ColorSpace = Name.DeviceCMYK
        if not is_photo:
            drawn.write(separated.tobytes())
            return
        content = io.BytesIO()
        separated.save(content, "JPEG", quality=JPEG_QUALITY, subsampling=0)
        drawn.write(content.getvalue(), filter=Name.DCTDecode)
        # Files of four inks hold them the other way round.
        drawn.Decode = [1, 0] * 4


def _components(space: Any) -> int:
    """Channels of a colour space by an ICC profile, or of grey; 0 of any other."""
    if isinstance(space, Array) and space[0] == "/ICCBased":
        return int(space[1].N)
    return 0


def _bytes_of(operands: Any) -> _Channels:
    values = [round(float(v) * 255) for v in operands]
    red, green, blue = values * 3 if len(values) == 1 else values
    return red, green, blue


def _ends(function: Any) -> list[_Channels]:
    """Colours between which a function of a share blends, of one to sRGB or grey."""
    if function.FunctionType == 2:
        return [_bytes_of(function.C0), _bytes_of(function.C1)]
    return [rgb for part in function.get("/Functions", []) for rgb in _ends(part)]


def _channels_of(colour: str) -> _Channels:
    red, green, blue = bytes.fromhex(colour.removeprefix("#"))
    return red, green, blue


def _decimal(value: float) -> Decimal:
    return Decimal(number(value, _DIGITS))

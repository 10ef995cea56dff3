"""Words as text in an SVG, to be selected and found, in parts of their fonts that it carries.

A part of a font is embedded only where its licence field allows it and HarfBuzz, which
browsers shape text with too, sets the words with that part just as it did with the whole.
"""

from __future__ import annotations

import base64
import logging
import math
import struct
import unicodedata
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from packwork.errors import WriteError
from packwork.scene.colour import Colour
from packwork.scene.item import Art, FontFile, Item, LiveText, TextRun, VectorArt
from packwork.scene.notation import attributes, matrix_text, xml_text
from packwork.scene.recolour import one_colour
from packwork.writers.svg_symbols import fill_attributes

_LOG = logging.getLogger("packwork")

_SETTING = "font-kerning:normal;white-space:pre"
"""As HarfBuzz sets words. Not ``geometricPrecision``: with it Chromium places small letters
more coarsely."""


class LiveWords:
    """Items of a document that are text, and the fonts that it carries.

    Fonts that cannot be embedded are named in the log; their words are outlines.
    """

    def __init__(self, items: Sequence[Item]) -> None:
        texts = dict.fromkeys(item.text for item in items if item.text is not None)
        self._fonts, refused = embedded_fonts(texts)
        self._colours: dict[Art, Colour | None] = {}
        for name, reason in refused.items():
            _LOG.warning("%s: its words are outlines, not text: %s", name, reason)

    def has(self, item: Item) -> bool:
        """Whether an item is written as text."""
        return (
            item.text is not None
            and isinstance(item.art, VectorArt)
            and self._colour(item.art) is not None
            and all(run.font in self._fonts for run in item.text.runs)
        )

    def style(self) -> list[str]:
        """Element that holds the fonts; none if there are none."""
        if not self._fonts:
            return []
        rules = "".join(font.rule for font in self._fonts.values())
        return [f"<style>{rules}#items text{{{_SETTING}}}</style>"]

    def element(self, item: Item, own: Mapping[str, str], place: str) -> str:
        """Element of a word that :meth:`has` affirms, with its outline, by which it is measured.

        ``place`` is a ``transform`` to wherever it goes.
        """
        art, text = item.art, item.text
        assert isinstance(art, VectorArt)  # noqa: S101 - has() says so
        assert text is not None  # noqa: S101 - has() says so
        head = {
            **own,
            "transform": place + matrix_text(art.matrix),
            **fill_attributes(self._colour(art) or (0, 0, 0, 255)),
            "data-outline": text.path,
        }
        return f"<g{attributes(head)}>{text_element(text, self._fonts)}</g>"

    def _colour(self, art: VectorArt) -> Colour | None:
        """Its one colour, read once; arts live as long as the items."""
        if art not in self._colours:
            self._colours[art] = one_colour(art)
        return self._colours[art]


def text_element(text: LiveText, fonts: Mapping[FontFile, Embedded]) -> str:
    """Text whose runs stand where they were set.

    Examples
    --------
    >>> font = FontFile(b"", "sans")
    >>> run = TextRun("ox", font, 0.0, 5.0, 10.0, (0.0, 0.5), 1.0)
    >>> text_element(LiveText((run,), "", "en"), {font: Embedded("a", "")})
    '<text lang="en" xml:lang="en" font-family="a" font-size="10" x="0" y="5">ox</text>'
    """
    language = {"lang": text.language, "xml:lang": text.language}
    if len(text.runs) == 1:
        (run,) = text.runs
        head = attributes({**language, **_run_attributes(run, fonts)})
        return f"<text{head}>{xml_text(run.text)}</text>"
    spans = (
        f"<tspan{attributes(_run_attributes(run, fonts))}>{xml_text(run.text)}</tspan>"
        for run in text.runs
    )
    return f"<text{attributes(language)}>{''.join(spans)}</text>"


def _run_attributes(run: TextRun, fonts: Mapping[FontFile, Embedded]) -> dict[str, str]:
    """Attributes of a run; text that runs leftward begins at its right end."""
    start = run.x + run.advance * run.size if run.is_leftward else run.x
    return {
        "font-family": fonts[run.font].family,
        "font-size": f"{run.size:.10g}",
        "x": f"{start:.10g}",
        "y": f"{run.y:.10g}",
        "rotate": f"{math.degrees(run.angle):.10g}" if run.angle else "",
        "direction": "rtl" if run.is_leftward else "",
        "unicode-bidi": "bidi-override" if run.is_leftward else "",
    }


RESTRICTED, WHOLE_ONLY, BITMAPS_ONLY = 0x0002, 0x0100, 0x0200
"""Bits of ``fsType`` in the table OS/2: no embedding at all, none of parts, none of curves."""

_PERMITTED = 0x000C
"""Bits that allow embedding where they stand beside ``RESTRICTED``: the most permissive
of them holds."""

_KERN = int.from_bytes(b"kern")
"""Name of a table, as HarfBuzz has it in sets."""

STEP = 2e-3
"""Share of an em by which glyphs may stand elsewhere than in the whole font: rounding of
variable fonts. Smaller refuses some of them. Chosen."""

_RunText: TypeAlias = tuple[TextRun, str]
"""A run and its language."""


@dataclass(frozen=True)
class Embedded:
    """A part of a font as a document names it."""

    family: str
    rule: str


def embedded_fonts(texts: Iterable[LiveText]) -> tuple[dict[FontFile, Embedded], dict[str, str]]:
    """Parts of all fonts that texts are set in, and why some cannot be embedded, by name."""
    runs: dict[FontFile, list[_RunText]] = {}
    for text in texts:
        for run in text.runs:
            runs.setdefault(run.font, []).append((run, text.language))
    found: dict[FontFile, Embedded] = {}
    refused: dict[str, str] = {}
    for number, (font, several) in enumerate(runs.items(), start=1):
        try:
            found[font] = _embed(f"words-{number}", font, several)
        except WriteError as error:
            refused[font.name] = error.problem
    return found, refused


def may_be_embedded(fs_type: int) -> bool:
    """Whether the licence field of a font allows a part of it in a document."""
    if fs_type & (WHOLE_ONLY | BITMAPS_ONLY):
        return False
    return not fs_type & RESTRICTED or bool(fs_type & _PERMITTED)


def _embed(family: str, font: FontFile, runs: Sequence[_RunText]) -> Embedded:
    part = _font_part(font, _characters(run.text for run, _ in runs))
    if not all(_is_same(part, run, language) for run, language in runs):
        raise WriteError(font.name, "a part of it would set the words otherwise")
    data = base64.b64encode(_as_woff(part)).decode("ascii")
    source = f'url(data:font/woff;base64,{data})format("woff")'
    return Embedded(family, f'@font-face{{font-family:"{family}";src:{source}}}')


def _characters(texts: Iterable[str]) -> str:
    """All that shaping may ask a font for: it takes letters apart, and puts them together."""
    text = "".join(texts)
    return "".join(unicodedata.normalize(form, text) for form in ("NFC", "NFD", "NFKD"))


def _font_part(font: FontFile, characters: str) -> bytes:
    """The font's glyphs of some characters, at one weight."""
    import uharfbuzz as hb

    face = hb.Face(font.data, font.index)
    licence = face.reference_table("OS/2").data[8:10]
    if licence and not may_be_embedded(int.from_bytes(licence)):
        raise WriteError(font.name, "its licence does not allow a part of it to be embedded")
    asked = hb.SubsetInput()
    asked.unicode_set.set(set(map(ord, characters)))
    asked.name_id_set.set({1, 2})
    asked.flags = hb.SubsetFlags.NO_HINTING | hb.SubsetFlags.NOTDEF_OUTLINE
    if "kern" in face.table_tags and "GPOS" not in face.table_tags:
        # HarfBuzz does not cut this table down, which knows glyphs by their numbers.
        asked.flags |= hb.SubsetFlags.RETAIN_GIDS
        asked.drop_table_tag_set.discard(_KERN)
        asked.no_subset_table_tag_set.add(_KERN)
    for axis in face.axis_infos:
        is_weight = axis.tag == "wght" and font.weight is not None
        asked.pin_axis_location(face, axis.tag, font.weight if is_weight else axis.default_value)
    try:
        return bytes(asked.subset(face).blob.data)
    except RuntimeError:
        raise WriteError(font.name, "its tables cannot be cut down") from None


def _as_woff(part: bytes) -> bytes:
    """The same as WOFF (W3C 2012), in which each table is compressed: all browsers know it."""
    count = int.from_bytes(part[4:6])
    offset, records, tables = 44 + 20 * count, b"", b""
    for k in range(count):
        tag, checksum, start, size = struct.unpack(">4sIII", part[12 + 16 * k : 28 + 16 * k])
        plain = part[start : start + size]
        packed = min(zlib.compress(plain, 9), plain, key=len)
        records += struct.pack(">4sIIII", tag, offset + len(tables), len(packed), size, checksum)
        tables += packed + bytes(-len(packed) % 4)
    head = struct.pack(">4s4sIHHI", b"wOFF", part[:4], offset + len(tables), count, 0, len(part))
    return head + bytes(24) + records + tables


def _is_same(part: bytes, run: TextRun, language: str) -> bool:
    """Whether glyphs of the part stand where those of the whole font do."""
    import uharfbuzz as hb

    face = hb.Face(part)
    if face.upem == 0:
        return False
    buffer = hb.Buffer()
    buffer.add_str(run.text)
    buffer.language = language or "und"
    buffer.guess_segment_properties()
    buffer.direction = "rtl" if run.is_leftward else "ltr"
    hb.shape(hb.Font(face), buffer)
    x, steps = 0.0, []
    for place in buffer.glyph_positions:
        steps.append((x + place.x_offset) / face.upem)
        x += place.x_advance
    expected = [*run.steps, run.advance]
    found = [*steps, x / face.upem]
    return len(found) == len(expected) and all(
        abs(a - b) <= STEP for a, b in zip(found, expected, strict=True)
    )

"""Words as text in an SVG, to be selected and found, in parts of their fonts that it carries.

A part of a font is embedded only where its licence field allows it and HarfBuzz, which
browsers shape text with too, sets the words with that part just as it did with the whole.
"""

from __future__ import annotations

import base64
import io
import logging
import struct
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeAlias

from packwork.errors import WriteError
from packwork.scene.colour import Colour, hex_colour
from packwork.scene.item import Art, FontFile, Item, LiveText, TextRun, VectorArt
from packwork.scene.notation import attributes, matrix_text, xml_text
from packwork.scene.recolour import one_colour

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
        channels = self._colour(art) or (0, 0, 0, 255)
        head = {
            **own,
            "transform": place + matrix_text(art.matrix),
            "fill": hex_colour(channels),
            "fill-opacity": "" if channels[3] == 255 else f"{channels[3] / 255:.3g}",
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
        "direction": "rtl" if run.is_leftward else "",
        "unicode-bidi": "bidi-override" if run.is_leftward else "",
    }


RESTRICTED, WHOLE_ONLY, BITMAPS_ONLY = 0x0002, 0x0100, 0x0200
"""Bits of ``fsType`` in the table OS/2: no embedding at all, none of parts, none of curves."""

_PERMITTED = 0x000C
"""Bits that allow embedding where they stand beside ``RESTRICTED``: the most permissive
of them holds."""

STEP = 2e-3
"""Share of an em by which glyphs may stand elsewhere than in the whole font: rounding of
variable fonts. Smaller refuses some of them. Chosen."""

MOST_STEPS = 3_000_000
"""Bytes of programs that cutting down one font may run, each call counted: some seconds. A cloud
of 500 words in a PostScript font takes a twentieth of it. Chosen."""

_FAILURES = (
    AssertionError, AttributeError, IndexError, KeyError, OverflowError, TypeError, ValueError,
    NotImplementedError, RecursionError, struct.error,
)  # fmt: skip
"""What fontTools raises on damaged tables, beside errors of its own."""


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
    try:
        with _bounded_programs():
            part = _font_part(font, _characters(run.text for run, _ in runs))
    except _FAILURES as error:
        raise WriteError(
            font.name, f"its tables cannot be cut down ({type(error).__name__})"
        ) from None
    if not all(_is_same(part, run, language) for run, language in runs):
        raise WriteError(font.name, "a part of it would set the words otherwise")
    data = base64.b64encode(_as_woff(part)).decode("ascii")
    source = f'url(data:font/woff;base64,{data})format("woff")'
    return Embedded(family, f'@font-face{{font-family:"{family}";src:{source}}}')


@contextmanager
def _bounded_programs() -> Iterator[None]:
    """Let fontTools run no more of a PostScript font's programs than ``MOST_STEPS``.

    It follows calls of calls of calls while it cuts a font down, whatever they come to; at more of
    them a ValueError is raised.
    """
    from fontTools.misc.psCharStrings import SimpleT2Decompiler  # type: ignore[import-untyped]

    run, left = SimpleT2Decompiler.execute, MOST_STEPS

    def execute(self: Any, program: Any) -> None:
        nonlocal left
        left -= 1 + len(program.bytecode or program.program or ())
        if left < 0:
            raise ValueError("its programs do not end")
        run(self, program)

    SimpleT2Decompiler.execute = execute
    try:
        yield
    finally:
        SimpleT2Decompiler.execute = run


def _characters(texts: Iterable[str]) -> str:
    """All that shaping may ask a font for: it takes letters apart, and puts them together."""
    text = "".join(texts)
    return "".join(unicodedata.normalize(form, text) for form in ("NFC", "NFD", "NFKD"))


def _font_part(font: FontFile, characters: str) -> bytes:
    """The font's glyphs of some characters, at one weight."""
    from fontTools.subset import Options, Subsetter  # type: ignore[import-untyped]
    from fontTools.ttLib import TTFont, TTLibError  # type: ignore[import-untyped]
    from fontTools.varLib.instancer import instantiateVariableFont  # type: ignore[import-untyped]

    try:
        opened = TTFont(io.BytesIO(font.data), fontNumber=font.index, recalcTimestamp=False)
        if "OS/2" in opened and not may_be_embedded(opened["OS/2"].fsType):
            raise WriteError(font.name, "its licence does not allow a part of it to be embedded")
        options = Options(hinting=False, notdef_outline=True, legacy_kern=True, name_IDs=[1, 2])
        subsetter = Subsetter(options)
        subsetter.populate(text=characters)
        subsetter.subset(opened)
        if "fvar" in opened:
            opened = instantiateVariableFont(opened, _location(opened, font.weight))
        made = io.BytesIO()
        opened.save(made)
    except TTLibError as error:
        raise ValueError(error) from None
    return made.getvalue()


def _location(font: Any, weight: float | None) -> Mapping[str, float]:
    place = {axis.axisTag: axis.defaultValue for axis in font["fvar"].axes}
    return place if weight is None else {**place, "wght": weight}


def _as_woff(part: bytes) -> bytes:
    """The same as WOFF: about half the size, and all browsers know it."""
    from fontTools.ttLib import TTFont

    font = TTFont(io.BytesIO(part), recalcTimestamp=False)
    font.flavor = "woff"
    made = io.BytesIO()
    font.save(made)
    return made.getvalue()


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

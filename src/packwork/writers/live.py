"""Words as text in an SVG: drawn as their outlines are, and to be selected and found."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence

from packwork.scene.colour import Colour, hex_colour
from packwork.scene.item import Art, FontFile, Item, LiveText, TextRun, VectorArt
from packwork.scene.notation import attributes, matrix_text, xml_text
from packwork.scene.recolour import one_colour
from packwork.writers.embedding import Embedded, embedded_fonts

_LOG = logging.getLogger("packwork")

_SETTING = "font-kerning:normal;white-space:pre"
"""As HarfBuzz sets words. Not ``geometricPrecision``: with it Chromium places small letters
more coarsely. Measured on four clouds at 1,600 px: 0.97 to 0.99 of the outlines' pixels are
the same with it, 0.985 to 0.994 without."""


class LiveWords:
    """Items of a document that are text, and the fonts that it carries.

    Fonts that cannot be embedded are named in the log; their words are outlines.

    Examples
    --------
    >>> LiveWords([]).style()
    []
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
        """Element of a word, its outline beside it so that the file can be measured.

        Parameters
        ----------
        item
            That :meth:`has` affirms.
        place
            A ``transform`` to wherever it goes.
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
        head = attributes({**language, **_placed(run, fonts)})
        return f"<text{head}>{xml_text(run.text)}</text>"
    spans = (
        f"<tspan{attributes(_placed(run, fonts))}>{xml_text(run.text)}</tspan>" for run in text.runs
    )
    return f"<text{attributes(language)}>{''.join(spans)}</text>"


def _placed(run: TextRun, fonts: Mapping[FontFile, Embedded]) -> dict[str, str]:
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

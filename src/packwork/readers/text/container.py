"""Words to containers: ``text:HELLO|WORLD``."""

from __future__ import annotations

from pathlib import Path

from packwork.readers.fonts.fallback import Fonts, is_font_file, open_fonts, typeface_of_file
from packwork.readers.regions import clean_union
from packwork.readers.text import PREFIX
from packwork.readers.text.letters import letters_of
from packwork.readers.text.lines import lines_of, set_lines
from packwork.readers.unfit import naming
from packwork.scene.canvas import placed_container
from packwork.scene.container import Container

WEIGHT = 900
"""Of installed families: the thickest letters hold the most. Chosen."""

MARGIN = 0.02
"""Free edge of the canvas, as a share of the words' longer side. Chosen."""


def container_of_words(
    source: str, side: float = 600.0, font: str | Path | None = None
) -> Container:
    """Container of ``text:`` and words, ``|`` between lines, on a canvas about them.

    Words of any script, shaped as its readers expect. Letters stand apart, but those that
    join in writing, as in Arabic and Hindi. The counters of letters are holes.

    Parameters
    ----------
    side
        Longer side of the canvas, in canvas units.
    font
        A TTF, OTF or TTC file, or an installed family. If None the bundled bold sans, and
        installed fonts for what it lacks.

    Raises
    ------
    ReadError
        If there is no word, or the font cannot be read or lacks one of its characters.

    Examples
    --------
    >>> container = container_of_words("text:OX", 300.0)
    >>> container.name, container.width, len(container.outline.rings)
    ('OX', 300.0, 3)
    """
    with naming(source):
        lines = lines_of(source.removeprefix(PREFIX))
        fonts = _fonts(None if font is None else str(font))
        words = clean_union(set_lines([letters_of(line) for line in fonts.settings(lines)]))
    left, top, right, bottom = words.bounds
    edge = MARGIN * max(right - left, bottom - top)
    canvas = (left - edge, top - edge, right - left + 2 * edge, bottom - top + 2 * edge)
    return placed_container(" ".join(lines), source, words, canvas, side)


def _fonts(font: str | None) -> Fonts:
    if font is None:
        return open_fonts([], WEIGHT)
    return Fonts([typeface_of_file(font)]) if is_font_file(font) else open_fonts([font], WEIGHT)

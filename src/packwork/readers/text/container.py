"""Words to containers: ``text:HELLO|WORLD``."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from packwork.readers.files import read_bytes
from packwork.readers.regions import clean_union
from packwork.readers.svg.container import placed_container
from packwork.readers.text import PREFIX
from packwork.readers.text.face import Letter, letters
from packwork.readers.text.setting import lines_of, set_lines
from packwork.readers.text.sfnt import MAX_FONT_BYTES
from packwork.readers.unfit import naming
from packwork.scene.container import Container

FONT = "InterDisplay-Black.otf"
"""The bundled font: thick strokes, in Latin, Greek and Cyrillic letters."""

MARGIN = 0.02
"""Free edge of the canvas, as a share of the words' longer side. Chosen."""


def container_of_words(
    source: str, side: float = 600.0, font: str | Path | None = None
) -> Container:
    """Container of ``text:`` and words, ``|`` between lines, on a canvas about them.

    One glyph a character, left to right: no ligatures, no scripts whose letters join.
    The counters of letters are holes.

    Parameters
    ----------
    side
        Longer side of the canvas, in canvas units.
    font
        A TTF, OTF or TTC file; the bundled bold sans if None.

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
    with naming(FONT if font is None else str(font)):
        found = _letters(font, "".join(lines))
    with naming(source):
        words = clean_union(set_lines(lines, found))
    left, top, right, bottom = words.bounds
    edge = MARGIN * max(right - left, bottom - top)
    canvas = (left - edge, top - edge, right - left + 2 * edge, bottom - top + 2 * edge)
    return placed_container(" ".join(lines), source, words, canvas, side)


def _letters(font: str | Path | None, characters: str) -> dict[str, Letter]:
    if font is not None:
        return letters(read_bytes(font, MAX_FONT_BYTES), characters)
    bundled = resources.files("packwork.bundled").joinpath("fonts", FONT)
    return letters(bundled.read_bytes(), characters)

"""Text, numbers and shapes drawn beside the marks of a chart, as notes."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from datetime import timedelta
from functools import lru_cache

import numpy as np

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.fonts.lettering import MOST_WORDS, Lettering
from packwork.readers.reading import UnfitError
from packwork.readers.tables.durations import written_duration
from packwork.scene.layout import Note
from packwork.scene.notation import path_data

_LOG = logging.getLogger("packwork")

MOST_LETTERS = 400
"""Of one note; an ellipsis stands for the rest. Larger sets text too long to be read,
slowly, and at last more glyphs than one word may have; smaller cuts long titles. Chosen."""

WEIGHT = 500
DIGITS = 6
ROUNDING = 1e-9
SHORTEST, LONGEST = 1e-5, 1e9
"""Hours that are said as lengths of time: others have too few digits, or too many. Chosen."""

MIDDLE_EM = 0.35
"""From the line that letters stand on to the middle of theirs."""


LARGEST_NAMED, SMALLEST_PLAIN = 1e15, 1e-6
"""Numbers from which on, and below which, powers of ten are written. Chosen."""


class Pen:
    """Collects notes; places are canvas units, letters stand on their line.

    Examples
    --------
    >>> pen = Pen("black")
    >>> end = pen.write("kg", 10.0, 20.0, 12.0)
    >>> pen.notes[0].says, bool(abs(end - 10.0 - pen.width("kg", 12.0)) < 1e-9)
    ('kg', True)
    """

    def __init__(self, ink: str) -> None:
        self.ink = ink
        self.notes: list[Note] = []

    @staticmethod
    def width(text: str, em: float) -> float:
        """Width of letters an em of which is so high."""
        return _ends(text)[1] * em - _ends(text)[0] * em

    def write(self, text: str, x: float, y: float, em: float, ink: str = "") -> float:
        """Letters from ``x`` on; where they end."""
        if not text.strip():
            return x
        drawn = lettering(text)
        left, right = _ends(text)
        place = affine.similarity(x - left * em, y, 0.0, em / drawn.units)
        self.notes.append(Note(drawn.path, place, ink or self.ink, text))
        return x + (right - left) * em

    def write_about(self, text: str, x: float, y: float, em: float, ink: str = "") -> None:
        """Letters with ``x`` in their middle."""
        self.write(text, x - self.width(text, em) / 2, y, em, ink)

    def write_upwards(self, text: str, x: float, top: float, em: float) -> None:
        """Letters read from below to above, with ``x`` in the middle of their height."""
        if not text.strip():
            return
        drawn = lettering(text)
        left, right = _ends(text)
        scale, foot = em / drawn.units, top + (right - left) * em
        place = affine.similarity(x + MIDDLE_EM * em, foot + left * em, -np.pi / 2, scale)
        self.notes.append(Note(drawn.path, place, self.ink, text))

    def shape(self, outline: Outline, x: float, y: float, scale: float, fill: str) -> None:
        """A shape, its origin at a place."""
        place = affine.similarity(x, y, 0.0, scale)
        self.notes.append(Note(path_data(outline, DIGITS), place, fill))


@lru_cache(maxsize=1)
def letters() -> Fonts:
    """The typeface of all notes."""
    return open_fonts([], WEIGHT)


@lru_cache(maxsize=4096)
def _ends(text: str) -> tuple[float, float]:
    """Left and right end of letters, in ems from their middle."""
    if not text.strip():
        return 0.0, 0.0
    left, _, right, _ = lettering(text).region.bounds
    return float(left), float(right)


@lru_cache(maxsize=MOST_WORDS)
def lettering(text: str) -> Lettering:
    """Text as it is drawn; what no font has is a question mark, and told; very long ones are cut.

    Examples
    --------
    >>> lettering("kg").path == lettering("kg").path
    True
    """
    if len(text) > MOST_LETTERS:
        return lettering(brief(text))
    try:
        return letters().lettering([text])
    except UnfitError:
        lacking = "".join(dict.fromkeys(one for one in text if not _is_drawn(one)))
        _LOG.warning("no font installed has %s of %r: ? stands for it", lacking[:20], text[:40])
        return letters().lettering(["".join("?" if one in lacking else one for one in text)])


@lru_cache(maxsize=4096)
def _is_drawn(character: str) -> bool:
    if character.isspace():
        return True
    try:
        letters().lettering([character])
    except UnfitError:
        return False
    return True


def brief(text: str) -> str:
    """No more than ``MOST_LETTERS``, the last an ellipsis if there were more.

    Examples
    --------
    >>> len(brief("a" * 9_000)), brief("Peru")
    (400, 'Peru')
    """
    return text if len(text) <= MOST_LETTERS else f"{text[: MOST_LETTERS - 1]}…"


def shortened(text: str, em: float, room: float) -> str:
    """As many letters as there is room for, the rest as an ellipsis.

    Examples
    --------
    >>> shortened("Nicaragua", 10.0, 40.0), shortened("Peru", 10.0, 40.0)
    ('Nicara…', 'Peru')
    """
    text = brief(text)
    # An em may have been chosen by this very width.
    if Pen.width(text, em) <= room * (1 + ROUNDING):
        return text
    for end in range(len(text) - 1, 0, -1):
        short = f"{text[:end].rstrip()}…"
        if Pen.width(short, em) <= room:
            return short
    return "…"


def spoken(number: float, decimal: str = ".", places: int | None = None) -> str:
    """Number as people say it, or as the table that it comes from would write it.

    With a decimal comma points group thousands, and no English names stand for large numbers.
    With ``places``, it has so many decimals; else four to six digits are said. Hours are said as
    lengths of time where the sign is ``:``, or ``::`` with seconds at all.

    Examples
    --------
    >>> spoken(5e8), spoken(2000), spoken(0.5), spoken(2e-5), spoken(3e20)
    ('500 million', '2,000', '0.5', '0.00002', '3e20')
    >>> spoken(2.5, ":"), spoken(2.5, "::"), spoken(0.51, ":"), spoken(1e-6, ":")
    ('2:30', '2:30:00', '0:30:36', '0.000001 h')
    >>> spoken(5e8, ","), spoken(2000, ","), spoken(0.5, ","), spoken(24456.2, ",", 2)
    ('500.000.000', '2.000', '0,5', '24.456,20')
    """
    if ":" in decimal and SHORTEST <= number < LONGEST:
        text = written_duration(timedelta(hours=number))
        return text.removesuffix(":00") if decimal == ":" else text
    if ":" in decimal:
        return f"{_english(number, is_named=True, places=None)} h"
    text = _english(number, is_named=decimal == ".", places=places)
    return text if decimal == "." else text.translate(str.maketrans(".,", ",."))


def places_of(numbers: Iterable[float]) -> int:
    """Decimals of the number that has most, up to nine.

    Examples
    --------
    >>> places_of([1.0, 2.25, 0.5]), places_of([]), places_of([1 / 3])
    (2, 0, 9)
    """
    return max((len(f"{n:.9f}".rstrip("0").partition(".")[2]) for n in numbers), default=0)


def _english(number: float, *, is_named: bool, places: int | None) -> str:
    size = abs(number)
    if size and not SMALLEST_PLAIN <= size < LARGEST_NAMED:
        digits, _, power = f"{number:.4g}".partition("e")
        return f"{digits}e{int(power)}" if power else f"{number:.4g}"
    for name, unit in (("billion", 1e9), ("million", 1e6)):
        if size >= unit and is_named:
            return f"{number / unit:,.4g} {name}"
    if places is not None:
        return f"{number:,.{places}f}"
    if size >= 1e6:
        return f"{float(f'{number:.6g}'):,.0f}"
    if 0 < size < 1e-4:
        return f"{number:.9f}".rstrip("0")
    # Numbers of four digits may be years.
    return f"{number:,.6g}" if size >= 1e3 else f"{number:.4g}"

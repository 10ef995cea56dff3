"""Font fallback: files and installed families as a list of typefaces, each asked in turn."""

from __future__ import annotations

import difflib
import math
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from packwork.errors import ReadError
from packwork.fonts import FONT_ENDINGS, MOST_FACES, installed_families
from packwork.geometry.curves import Curve
from packwork.readers.fonts.bent import bent_lettering
from packwork.readers.fonts.face import MAX_FONT_BYTES, UNKNOWN_LANGUAGE, Typeface, bundled_typeface
from packwork.readers.fonts.itemise import Piece, clusters, itemised
from packwork.readers.fonts.lettering import MOST_COARSE, Lettering, TypeSetting, lettering_of
from packwork.readers.reading import UnfitError, exists, read_bytes, reading_file

MOST_NAMED = 6
"""Characters that a message about missing ones names. Chosen."""

_PREFERRED = ("noto sans", "noto", "dejavu sans")
"""Families that are asked first among those installed: drawn for many scripts alike."""


@dataclass(eq=False)
class Fonts:
    """Typefaces in the order in which they are asked for a word.

    ``weight`` is of installed families and variable fonts. ``is_open`` lets installed fonts be
    asked where these lack a letter. ``language`` matters where letters have forms of their own.
    """

    faces: list[Typeface]
    weight: int = 700
    is_open: bool = False
    language: str = ""
    _installed: list[Typeface] = field(default_factory=list)

    def lettering(
        self, lines: Sequence[str], em: float = math.inf, most_coarse: float = MOST_COARSE
    ) -> Lettering:
        """Lines as a word of its own, its curves followed as ``lettering_of`` says.

        >>> Fonts([bundled_typeface()]).lettering(["ox"]).region.is_valid
        True
        """
        return lettering_of(self.settings(lines), self.asked_language, em, most_coarse)

    def bent(self, line: str, curve: Curve, start: float, end: float) -> Lettering:
        """Line along a curve, in ems, from one arc length to another."""
        [setting] = self.settings([line])
        return bent_lettering(setting, curve, start, end, self.asked_language)

    def settings(self, lines: Sequence[str]) -> list[list[TypeSetting]]:
        """Pieces of lines, each with the font that draws it: the first that has all characters.

        Where none has all, each part is drawn by the first font that has it.

        >>> [found] = Fonts([bundled_typeface()]).settings(["Кот"])
        >>> found[0].piece.text, found[0].face.name
        ('Кот', 'Inter Display')
        """
        pieces = [itemised(line) for line in lines]
        for face in self._asked("".join(lines)):
            whole = [[TypeSetting(piece, face) for piece in line] for line in pieces]
            if self._is_drawn(whole):
                return whole
        mixed = [[part for piece in line for part in self._parts(piece)] for line in pieces]
        if not self._is_drawn(mixed):
            raise UnfitError(self._lacking("".join(lines)))
        return mixed

    @property
    def asked_language(self) -> str:
        """The language of words; ``UNKNOWN_LANGUAGE`` where none was named."""
        return self.language or UNKNOWN_LANGUAGE

    def _is_drawn(self, lines: Sequence[Sequence[TypeSetting]]) -> bool:
        return all(
            one.face.draws(
                one.piece.text, is_leftward=one.piece.is_leftward, language=self.asked_language
            )
            for line in lines
            for one in line
        )

    def _parts(self, piece: Piece) -> list[TypeSetting]:
        """A piece, cut where its font changes."""
        found: list[TypeSetting] = []
        for cluster in clusters(piece.text):
            face = next((face for face in self._asked(cluster) if face.has(_seen(cluster))), None)
            if face is None:
                raise UnfitError(self._lacking(cluster if self.is_open else piece.text))
            if found and found[-1].face is face:
                cluster = found.pop().piece.text + cluster
            found.append(TypeSetting(replace(piece, text=cluster), face))
        return found

    def _asked(self, text: str) -> Iterator[Typeface]:
        yield from self.faces
        if self.is_open:
            characters = _seen(text)
            yield from (face for face in self._installed if face.has(characters))
            face = _installed_face(characters, self.weight)
            if face is not None:
                self._installed.append(face)
                yield face

    def _lacking(self, text: str) -> str:
        missing = [c for c in dict.fromkeys(text) if not any(face.has(c) for face in self.faces)]
        seen = [character for character in missing if not _is_unseen(character)]
        what = named(seen or missing) if missing else "all of its characters at once"
        if self.is_open:
            return f"no font installed has {what}; install one, or give its file with --font"
        return f"no font given has {what}; choose another with --font"


def named(characters: Sequence[str]) -> str:
    """Characters as a person can find them again.

    >>> named("aé")
    "'a' (U+0061), 'é' (U+00E9)"
    """
    more = f" and {len(characters) - MOST_NAMED} more" if len(characters) > MOST_NAMED else ""
    return ", ".join(f"{c!r} (U+{ord(c):04X})" for c in characters[:MOST_NAMED]) + more


def open_fonts(names: Sequence[str], weight: int = 700, language: str = "") -> Fonts:
    """Fonts by file or by installed family; the bundled one, then any, if none is named.

    >>> open_fonts([]).faces[0].name, open_fonts(["Inter Display"]).is_open
    ('Inter Display', False)
    """
    if not names:
        return Fonts([bundled_typeface()], weight, is_open=True, language=language)
    return Fonts([_named(name, weight) for name in names], weight, language=language)


def is_font_file(name: str) -> bool:
    """Whether a name is meant as that of a file, be it there or not."""
    return exists(name) or Path(name[-20:]).suffix.lower() in FONT_ENDINGS


def typeface_of_file(name: str, weight: int | None = None) -> Typeface:
    """First face of a font file, a variable one at its own weight if none is given.

    >>> typeface_of_file("no such.ttf")
    Traceback (most recent call last):
    packwork.errors.ReadError: no such.ttf: there is no such file
    """
    with reading_file(name):
        return Typeface(read_bytes(name, MAX_FONT_BYTES), name, 0, weight)


def _named(name: str, weight: int) -> Typeface:
    if is_font_file(name):
        return typeface_of_file(name, weight)
    files = installed_families().get(name.strip().lower())
    if not files:
        known = sorted(installed_families())
        close = difflib.get_close_matches(name.lower(), known, n=3, cutoff=0.4)
        hint = f"similar are {', '.join(close)}" if close else "give a font file"
        raise ReadError(name[:60], f"is no font file and no installed family; {hint}")
    found = _nearest([face for file in files for face in _faces(file, weight)], weight)
    if found is None:
        raise ReadError(name, "is installed, but cannot be read; give a font file")
    return found


def _installed_face(characters: str, weight: int) -> Typeface | None:
    """Face of an installed family that has all characters; none if there is none."""
    families = installed_families()
    for family in sorted(families, key=_rank):
        faces = [f for file in families[family] for f in _faces(file, weight) if f.has(characters)]
        found = _nearest(faces, weight)
        if found is not None:
            return found
    return None


def _rank(family: str) -> tuple[int, str]:
    rank = next((k for k, name in enumerate(_PREFERRED) if family.startswith(name)), 9)
    return rank, family


def _nearest(faces: Sequence[Typeface], weight: int) -> Typeface | None:
    """The upright face of the common width whose weight is nearest."""
    return min(faces, key=lambda f: (*f.oddity, abs(f.weight - weight), f.name), default=None)


def _faces(file: str, weight: int) -> list[Typeface]:
    """All faces of a file; none if it cannot be read."""
    try:
        data = read_bytes(file, MAX_FONT_BYTES)
        count = int.from_bytes(data[8:12], "big") if data[:4] == b"ttcf" else 1
        return [Typeface(data, file, k, weight) for k in range(min(count, MOST_FACES))]
    except (ReadError, UnfitError):
        return []


def _seen(text: str) -> str:
    return "".join(character for character in text if not _is_unseen(character))


def _is_unseen(character: str) -> bool:
    """Whether no glyph of its own is needed: joiners, variants, spaces."""
    return unicodedata.category(character) in {"Cf", "Zs"} or 0xFE00 <= ord(character) <= 0xFE0F

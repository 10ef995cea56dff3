"""Which font files the letters of a drawing need, and which families are not there.

Fonts are looked up here, once, and handed to the renderer by name: it would read all of
them for every picture, and tells nobody which one it missed.
"""

from __future__ import annotations

import os
import struct
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import BinaryIO

from packwork.raster.drawing import Fonts

MAX_FILES = 5_000
"""Font files that are looked at. A well-equipped studio has as many. Chosen."""

MAX_NAMES = 100_000
"""Bytes of a font's table of names: those of many languages have 20,000. Chosen."""

BUNDLED_FAMILY = "Inter Display"
"""Family of the bundled font, for machines that have no other."""

_ENDINGS = frozenset({".ttf", ".otf", ".ttc", ".otc"})
_MOST_FACES = 64
_FAMILY, _WHOLE_FAMILY = 1, 16
_PLAIN_LETTERS = "\u024f"
_GENERIC = {
    "serif": ("Times New Roman", "Times", "Liberation Serif", "DejaVu Serif", "Noto Serif"),
    "sans-serif": ("Arial", "Helvetica", "Liberation Sans", "DejaVu Sans", "Noto Sans"),
    "monospace": ("Courier New", "Menlo", "Liberation Mono", "DejaVu Sans Mono", "Noto Sans Mono"),
}
_OTHER_GENERIC = frozenset(
    {"cursive", "fantasy", "system-ui", "ui-serif", "ui-sans-serif", "ui-monospace", "inherit"}
)


@dataclass(frozen=True)
class FontChoice:
    """Fonts for a drawing.

    Parameters
    ----------
    fonts
        To be handed to the renderer.
    replaced
        Families that are not there, each with the one that stands in for it.
    """

    fonts: Fonts
    replaced: Mapping[str, str]


def choose_fonts(wishes: Iterable[str], letters: str) -> FontChoice:
    """Fonts for lists of families as ``font-family`` writes them.

    The installed font of a family is taken, else that of the next one in the list, else a
    serif one; where nothing is installed, the bundled font.

    Parameters
    ----------
    wishes
        One list of families for each style of the drawing.
    letters
        All that is to be set.

    Examples
    --------
    >>> choice = choose_fonts(["'No Such Font'"], "abc")
    >>> list(choice.replaced)
    ['No Such Font']
    """
    installed = installed_families()
    generic = {name: _first(names, installed) for name, names in _GENERIC.items()}
    needed = set(generic.values())
    replaced: dict[str, str] = {}
    for names in map(family_names, wishes):
        known = [name for name in names if name.lower() in installed or _is_generic(name)]
        found = known[0] if known else generic["serif"]
        needed.add(generic.get(found.lower(), found))
        if names and found != names[0]:
            replaced[names[0]] = generic.get(found.lower(), found)
    files = [file for name in sorted(needed) for file in installed.get(name.lower(), ())]
    fonts = Fonts(
        files=(*files, _bundled_file()),
        serif=generic["serif"],
        sans_serif=generic["sans-serif"],
        monospace=generic["monospace"],
        with_installed=any(letter > _PLAIN_LETTERS for letter in letters),
    )
    return FontChoice(fonts, replaced)


def fonts_for(root: ET.Element) -> Fonts | None:
    """Fonts for whatever text there is in a clean drawing; None if there is none.

    Examples
    --------
    >>> fonts_for(ET.Element("svg")) is None
    True
    """
    texts = list(root.iter("text"))
    if not texts:
        return None
    wishes = [e.attrib["font-family"] for e in root.iter() if "font-family" in e.attrib]
    return choose_fonts(wishes, "".join(letter for t in texts for letter in t.itertext())).fonts


def family_names(wish: str) -> list[str]:
    """Families of a ``font-family`` list, quotes taken off.

    Examples
    --------
    >>> family_names("'Gill Sans', Arial,sans-serif")
    ['Gill Sans', 'Arial', 'sans-serif']
    """
    return [name for part in wish.split(",") if (name := " ".join(part.split()).strip("'\""))]


@cache
def installed_families() -> Mapping[str, tuple[str, ...]]:
    """Font files of this machine by family, in lower case; the bundled font is among them.

    Looked up once. Files that are no fonts are passed over.
    """
    found: dict[str, list[str]] = {}
    for file in (_bundled_file(), *_font_files()):
        for family in family_of(file):
            found.setdefault(family.lower(), []).append(file)
    return {family: tuple(files) for family, files in found.items()}


def family_of(file: str) -> set[str]:
    """Families that a font file says it belongs to; none if it cannot be read.

    Examples
    --------
    >>> sorted(family_of(_bundled_file()))
    ['Inter Display']
    """
    try:
        with Path(file).open("rb") as font:
            return {name for start in _face_starts(font) for name in _families(font, start)}
    except (OSError, struct.error, UnicodeDecodeError, ValueError):
        return set()


def _first(names: Iterable[str], installed: Mapping[str, tuple[str, ...]]) -> str:
    return next((name for name in names if name.lower() in installed), BUNDLED_FAMILY)


def _is_generic(name: str) -> bool:
    return name.lower() in _GENERIC or name.lower() in _OTHER_GENERIC


def _bundled_file() -> str:
    folder = resources.files("packwork.bundled").joinpath("fonts")
    return str(folder.joinpath("InterDisplay-Black.otf"))


def _font_files() -> list[str]:
    files: list[str] = []
    for folder in _folders():
        for place, _, names in os.walk(folder):
            fonts = [name for name in sorted(names) if Path(name).suffix.lower() in _ENDINGS]
            files += [str(Path(place, name)) for name in fonts]
            if len(files) >= MAX_FILES:
                return files[:MAX_FILES]
    return files


def _folders() -> list[Path]:
    """Where this system keeps its fonts."""
    home = Path("~").expanduser()
    if sys.platform == "win32":
        windows = Path(os.environ.get("WINDIR", r"C:\Windows"), "Fonts")
        own = Path(os.environ.get("LOCALAPPDATA", home), "Microsoft", "Windows", "Fonts")
        return [windows, own]
    if sys.platform == "darwin":
        return [Path("/System/Library/Fonts"), Path("/Library/Fonts"), home / "Library" / "Fonts"]
    return [
        Path("/usr/share/fonts"),
        Path("/usr/local/share/fonts"),
        home / ".local" / "share" / "fonts",
        home / ".fonts",
    ]


def _face_starts(font: BinaryIO) -> list[int]:
    """Where each face of a file begins: one, or several in a collection."""
    tag, _, count = struct.unpack(">4s4sI", font.read(12))
    if tag != b"ttcf":
        return [0]
    faces = min(count, _MOST_FACES)
    return list(struct.unpack(f">{faces}I", font.read(4 * faces)))


def _families(font: BinaryIO, start: int) -> set[str]:
    """Families of the face that begins at ``start``, all its weights under one name.

    Older programs know four weights to a family; for them the others are families.
    """
    names = list(_names(font, start))
    whole = {name for kind, name in names if kind == _WHOLE_FAMILY}
    return whole or {name for kind, name in names if kind == _FAMILY}


def _names(font: BinaryIO, start: int) -> Iterator[tuple[int, str]]:
    """Kinds and texts of a face's table of names."""
    font.seek(start)
    (tables,) = struct.unpack(">4xH6x", font.read(12))
    for _ in range(tables):
        tag, offset, length = struct.unpack(">4s4xII", font.read(16))
        if tag == b"name":
            font.seek(offset)
            yield from _records(font.read(min(length, MAX_NAMES)))
            return


def _records(table: bytes) -> Iterator[tuple[int, str]]:
    count, texts = struct.unpack_from(">2xHH", table)
    for k in range(count):
        platform, _, _, kind, length, place = struct.unpack_from(">6H", table, 6 + 12 * k)
        text = table[texts + place : texts + place + length]
        if kind in {_FAMILY, _WHOLE_FAMILY}:
            yield kind, text.decode("mac-roman" if platform == 1 else "utf-16-be")

"""Fonts of this machine: the one place that looks for them, for all that draws letters.

The folders of the system are searched, or those that ``PACKWORK_FONTS`` names instead of
them. What is found is handed to the renderer by file: it would read all fonts for every
picture, searches other folders, and does not report which family it missed.
"""

from __future__ import annotations

import html
import os
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from packwork.folders import home_folder

FOLDERS = "PACKWORK_FONTS"
"""Environment variable: folders, separated as in ``PATH``, that are searched for fonts
instead of the system's."""

MAX_FILES = 5_000
"""Font files that are looked at. A well-equipped studio has as many. Chosen."""

MOST_FACES = 64
"""Faces of one collection that are looked at. Chosen."""

FONT_ENDINGS = frozenset({".ttf", ".otf", ".ttc", ".otc"})
"""Of files that hold fonts."""

BUNDLED_FAMILY = "Inter Display"
"""Family of the bundled font, for machines that have no other."""

_FAMILY, _WHOLE_FAMILY = 1, 16
_UNREADABLE = "\ufffd"
_TAG = re.compile(r"<[^>]*>")
_WISH = re.compile(r"""\bfont-family=("[^"]*"|'[^']*')""")
_PLAIN_LETTERS = "\u024f"
_LETTERS = {
    "Latin": "a", "Greek": "α", "Cyrillic": "ж", "Armenian": "ա", "Georgian": "ა", "Hebrew": "א",
    "Arabic": "ع", "Ethiopic": "ሀ", "Devanagari": "क", "Bengali": "ক", "Gujarati": "ક",
    "Gurmukhi": "ਕ", "Tamil": "க", "Telugu": "క", "Kannada": "ಕ", "Malayalam": "ക", "Sinhala": "ක",
    "Thai": "ก", "Lao": "ກ", "Khmer": "ក", "Myanmar": "က", "Tibetan": "ཀ", "Hangul": "한",
    "Hiragana": "あ", "Katakana": "ア", "Han": "水",
}  # fmt: skip
"""A common letter of each script."""
_GENERIC = {
    "serif": ("Times New Roman", "Times", "Liberation Serif", "DejaVu Serif", "Noto Serif"),
    "sans-serif": ("Arial", "Helvetica", "Liberation Sans", "DejaVu Sans", "Noto Sans"),
    "monospace": ("Courier New", "Menlo", "Liberation Mono", "DejaVu Sans Mono", "Noto Sans Mono"),
}
_ALIKE = {
    "monospace": re.compile("courier|consolas|menlo|monaco|lucida console|inconsolata|.*\\bmono"),
    "sans-serif": re.compile(
        "arial|helvetica|verdana|tahoma|trebuchet|calibri|segoe|roboto|lato|montserrat|futura|impact"
        "|myriad|univers|frutiger|lucida grande|geneva|candara|corbel|swiss|poppins|raleway|ubuntu"
        r"|cantarell|oswald|.*\b(sans|gothic|grotesk)\b"
    ),
}
"""Families that are like a generic one, of which the letters of others are taken where they are not
there: as fontconfig's aliases and stylesheets have it, whose lists name the generic one last."""

_OTHER_GENERIC = frozenset(
    {"cursive", "fantasy", "system-ui", "ui-serif", "ui-sans-serif", "ui-monospace", "inherit"}
)


@dataclass(frozen=True, kw_only=True)
class FontChoice:
    """Fonts that the letters of a document are set in.

    Families stand for the generic names; ``serif`` also stands in for a family that is not there
    and like no other.
    """

    files: tuple[str, ...]
    serif: str
    sans_serif: str
    monospace: str


def fonts_of(document: str) -> FontChoice | None:
    """Fonts for whatever text there is in an SVG document; None if there is none.

    It is one of ours or a cleaned one: families stand in attributes, no text in another.

    >>> fonts_of("<svg><text font-family='Inter Display'>a</text></svg>").files[-1]
    '...InterDisplay-Black.otf'
    >>> fonts_of("<svg/>") is None
    True
    """
    _, *after = document.split("<text")
    if not after:
        return None
    wishes = dict.fromkeys(html.unescape(wish[1:-1]) for wish in _WISH.findall(document))
    texts = "<text".join(part.partition("</text>")[0] for part in after)
    return fonts_for(wishes, html.unescape(_TAG.sub("", texts)))


def fonts_for(wishes: Iterable[str], letters: str) -> FontChoice:
    """Fonts for lists of families as ``font-family`` writes them, one for each style of a document.

    Of each list the first family that is installed; where nothing is, the bundled font. If there
    are letters that few fonts have, all fonts, for the renderer to choose from.
    """
    installed = installed_families()
    generic = {name: _first(names, installed) for name, names in _GENERIC.items()}
    needed = [*generic.values(), *(_stand_in(family_names(wish)) for wish in wishes)]
    if any(letter > _PLAIN_LETTERS for letter in letters):
        needed += sorted(installed)
    files = [file for name in needed for file in installed.get(name.lower(), ())]
    return FontChoice(
        files=tuple(dict.fromkeys((*files, bundled_file()))),
        serif=generic["serif"],
        sans_serif=generic["sans-serif"],
        monospace=generic["monospace"],
    )


def with_stand_ins(document: str) -> str:
    """A document, families that are not there replaced by those that stand in for them.

    >>> with_stand_ins("<text font-family='Inter Display, Arial'>a</text>")
    "<text font-family='Inter Display, Arial'>a</text>"
    """

    def named(wish: re.Match[str]) -> str:
        names = family_names(html.unescape(wish[1][1:-1]))
        is_there = any(name.lower() in installed_families() or _is_generic(name) for name in names)
        return wish[0] if is_there or not names else f'font-family="{_stand_in(names)}"'

    return _WISH.sub(named, document) if "<text" in document else document


def replaced_families(wishes: Iterable[str]) -> dict[str, str]:
    """Families that are wished for and not there, each with the one that stands in for it.

    >>> list(replaced_families(["'No Such Font'", "Inter Display"]))
    ['No Such Font']
    """
    lists = [names for wish in wishes if (names := family_names(wish))]
    pairs = ((names[0], _stand_in(names)) for names in lists)
    return {name: found for name, found in pairs if found != name and not _is_generic(name)}


def family_names(wish: str) -> list[str]:
    """Families of a ``font-family`` list, quotes taken off.

    >>> family_names("'Gill Sans', Arial,sans-serif")
    ['Gill Sans', 'Arial', 'sans-serif']
    """
    return [name for part in wish.split(",") if (name := " ".join(part.split()).strip("'\""))]


def installed_families() -> Mapping[str, tuple[str, ...]]:
    """Font files of this machine by family, in lower case; the bundled font is among them.

    Looked up once. Files that are no fonts are passed over.

    >>> "inter display" in installed_families()
    True
    """
    return _families_in(tuple(_folders()))


def scripts_of(family: str) -> list[str]:
    """Scripts of an installed family, by Unicode's names: those of which it has a common letter.

    None of one whose file has gone away since.

    >>> scripts_of("inter display")
    ['Latin', 'Greek', 'Cyrillic']
    """
    import uharfbuzz as hb

    try:
        face = hb.Face(hb.Blob.from_file_path(installed_families()[family][0]))
    except hb.HarfBuzzError:
        return []
    return [script for script, letter in _LETTERS.items() if ord(letter) in face.unicodes]


@cache
def _families_in(folders: tuple[Path, ...]) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, list[str]] = {}
    for file in (bundled_file(), *_font_files(folders)):
        for family in family_of(file):
            found.setdefault(family.lower(), []).append(file)
    return {family: tuple(files) for family, files in found.items()}


def family_of(file: str) -> set[str]:
    """Families that a font file says it belongs to; none if it cannot be read.

    >>> sorted(family_of(bundled_file()))
    ['Inter Display']
    """
    import uharfbuzz as hb

    try:
        # The file is mapped: no more than its table of names is read.
        blob = hb.Blob.from_file_path(file)
    except hb.HarfBuzzError:
        return set()
    faces = min(hb.Face(blob).count, MOST_FACES)
    return {name for k in range(faces) for name in _families(hb.Face(blob, k))}


def families_of_face(data: bytes, index: int) -> set[str]:
    """The same of one face of a font file's bytes.

    >>> families_of_face(Path(bundled_file()).read_bytes(), 0)
    {'Inter Display'}
    """
    import uharfbuzz as hb

    return _families(hb.Face(data, index))


def _families(face: Any) -> set[str]:
    """Families of a face, all its weights under one name.

    Older programs know four weights to a family; for them the others are families.
    """
    entries = face.list_names()
    for kind in (_WHOLE_FAMILY, _FAMILY):
        languages = {entry.language for entry in entries if entry.name_id == kind}
        names = {face.get_name(kind, language) or _UNREADABLE for language in languages}
        if names := {name for name in names if _UNREADABLE not in name}:
            return names
    return set()


def _first(names: Iterable[str], installed: Mapping[str, tuple[str, ...]]) -> str:
    return next((name for name in names if name.lower() in installed), BUNDLED_FAMILY)


def _stand_in(names: Sequence[str]) -> str:
    """Family that a list of wishes comes to."""
    installed = installed_families()
    known = (name for name in names if name.lower() in installed or _is_generic(name))
    found = next(known, None) or next(filter(None, map(_like, names)), "serif")
    generic = _GENERIC.get(found.lower())
    return found if generic is None else _first(generic, installed)


def _like(name: str) -> str | None:
    """Generic family that one which is not there is like; None where that is not known."""
    return next((kind for kind, names in _ALIKE.items() if names.match(name.lower())), None)


def _is_generic(name: str) -> bool:
    return name.lower() in _GENERIC or name.lower() in _OTHER_GENERIC


def bundled_file() -> str:
    """Place of the bundled font."""
    folder = resources.files("packwork.bundled").joinpath("fonts")
    return str(folder.joinpath("InterDisplay-Black.otf"))


def _font_files(folders: Iterable[Path]) -> list[str]:
    files: list[str] = []
    for folder in folders:
        for place, _, names in os.walk(folder):
            fonts = [name for name in sorted(names) if Path(name).suffix.lower() in FONT_ENDINGS]
            files += [str(Path(place, name)) for name in fonts]
            if len(files) >= MAX_FILES:
                return files[:MAX_FILES]
    return files


def _folders() -> list[Path]:
    """Font folders: as the environment says, else where this system has them."""
    if own := os.environ.get(FOLDERS):
        return [Path(folder) for folder in own.split(os.pathsep) if folder]
    # Folders that are not there are passed over.
    home = home_folder() or Path(os.sep, "nonexistent")
    if sys.platform == "win32":
        windows = Path(os.environ.get("WINDIR", r"C:\Windows"), "Fonts")
        users = Path(os.environ.get("LOCALAPPDATA", home), "Microsoft", "Windows", "Fonts")
        return [windows, users]
    if sys.platform == "darwin":
        return [Path("/System/Library/Fonts"), Path("/Library/Fonts"), home / "Library" / "Fonts"]
    return [
        Path("/usr/share/fonts"),
        Path("/usr/local/share/fonts"),
        home / ".local" / "share" / "fonts",
        home / ".fonts",
    ]

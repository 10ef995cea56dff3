"""Paths in recipes: one list for reading, writing and checking them.

A recipe file's names are seen from its own folder. Which texts are names of files, and where
they stand inside longer ones (``towards curve.svg``), is known here alone.
"""

from __future__ import annotations

import glob
import itertools
import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, TypeAlias

from packwork.errors import RecipeError

AROUND = "around:"
"""Before a picture's name: its quiet part is the container."""

BUILTIN = "builtin:"
"""Before a name: the bundled shape, whatever files there are."""

Rename: TypeAlias = Callable[[str], str]
"""The name of a file, as it is to be called."""

_SCHEME = re.compile(r"[A-Za-z]{2,}:")
"""Of names that are no path, as text:HELLO; one letter is a drive."""

_ENDING = re.compile(r"\.[A-Za-z]\w*")
_LIST_ENDING = re.compile(r".*\.(txt|text|lst|list|md|csv|tsv|json)", re.IGNORECASE)
_PATH_START = re.compile(r"~|/|\.{1,2}[/\\]|[A-Za-z]:[/\\]")
_LONGEST = 4_096
"""Characters of a path, on most systems."""

_BY_FILE = re.compile(r'by=(?P<quote>"?)(?P<file>[^"]*?\.(?:csv|tsv|json))(?P=quote)(?!\S)')
_WORD = re.compile(r'(?:by=)?"[^"]*"|\S+')

_IN_TABLES: Mapping[str, tuple[str, ...]] = {
    "": (
        "container", "weights", "start", "font", "items", "keep_clear", "filler", "force",
        "picture", "arrange", "embeddings",
    ),
    "words": ("source", "stopwords", "keep_words", "color_by", "fonts", "container_font"),
    "chart": ("data", "mark"),
    "photos": ("sources", "shape"),
    "pile": ("emit",),
}  # fmt: skip
"""Options that name files, by the table that they stand in; those of rules are ``region``."""

_TEXTS = frozenset({"source", "force", "emit", "arrange"})
"""Those that may be texts, and are told of as such where they are empty."""

_SHAPES = frozenset({"container", "items", "filler", "mark", "shape", "region", "emit"})
"""Options that may name what is bundled."""


def split_words(text: str) -> list[str]:
    """Words of a text; quotes keep together a name with spaces.

    Examples
    --------
    >>> split_words('towards "my curves/arc.svg" strength=2')
    ['towards', 'my curves/arc.svg', 'strength=2']
    """
    return [word.strip('"') if word.startswith('"') else word for word in _WORD.findall(text)]


def is_like_a_path(text: str) -> bool:
    """Whether a text is meant as the name of a list's file, rather than as words, if none is there.

    Examples
    --------
    >>> [is_like_a_path(text) for text in ("stop.txt", "./stop", "a.txt,b.txt", "no such/stop")]
    [True, True, True, False]
    >>> [is_like_a_path(text) for text in ("river,hands", "TCP/IP", "node.js", "Oslo, No.")]
    [False, False, False, False]
    """
    if _PATH_START.match(text) or any(map(_LIST_ENDING.fullmatch, text.split(","))):
        return True
    path = Path(text)
    return len(path.parts) > 1 and _is_there(path.parent)


def with_paths(options: Mapping[str, Any], rename: Rename) -> dict[str, Any]:
    """Plain options of a recipe with each file's name put through ``rename``.

    Values of a wrong type are left as they are: validation of options refuses them.

    Examples
    --------
    >>> with_paths({"items": ["a.svg"], "force": "towards b.svg", "seed": 1}, "x/{}".format)
    {'items': ['x/a.svg'], 'force': 'towards x/b.svg', 'seed': 1}
    """
    changed = dict(options)
    for table, keys in _IN_TABLES.items():
        within = changed if not table else changed.get(table)
        if not isinstance(within, Mapping):
            continue
        renamed = {
            key: _renamed(key, within[key], rename) if key in keys else within[key]
            for key in within
        }
        changed = renamed if not table else {**changed, table: renamed}
    if isinstance(changed.get("rules"), list | tuple):
        changed["rules"] = [_rule(rule, rename) for rule in changed["rules"]]
    return changed


def named_files(options: Mapping[str, Any]) -> list[str]:
    """Names of files that a recipe's plain options hold; most may be something else too.

    Examples
    --------
    >>> named_files({"container": "around:a.jpg", "pile": {"emit": "in b.svg"}})
    ['a.jpg', 'b.svg']
    """
    found: list[str] = []

    def note(name: str) -> str:
        found.append(name)
        return name

    with_paths(options, note)
    return found


def check_names(options: Mapping[str, Any]) -> None:
    """Refuse names of nothing: as paths they would stand for the whole of a folder.

    Examples
    --------
    >>> check_names({"filler": ["star", ""]})
    Traceback (most recent call last):
    packwork.errors.RecipeError: filler: is an empty name, which stands for nothing; ...
    """
    for table, keys in _IN_TABLES.items():
        within = options if not table else options.get(table)
        if not isinstance(within, Mapping):
            continue
        for key in keys:
            value = None if key in _TEXTS else within.get(key)
            names = value if isinstance(value, list | tuple) else [value]
            if any(isinstance(name, str) and not name.strip() for name in names):
                raise RecipeError(
                    key,
                    "is an empty name, which stands for nothing; give a file, or leave it out",
                )


def files_outside(options: Mapping[str, Any], folders: Iterable[Path]) -> list[str]:
    """Files and folders that a recipe names and that lie in none of some folders.

    Examples
    --------
    >>> files_outside({"items": ["/", "heart"]}, [Path.cwd()])
    ['/']
    """
    homes = [folder.resolve() for folder in folders]
    named = dict.fromkeys(named_files(options))
    there = [Path(name) for name in named if name and _is_there(Path(name))]
    found = [path for path in there if not any(path.resolve().is_relative_to(h) for h in homes)]
    return list(dict.fromkeys(map(str, found)))


def named_elsewhere(options: Mapping[str, Any], folder: Path) -> str:
    """First name in a recipe's options of what lies, or would lie, outside a folder; or nothing.

    Stricter than :func:`files_outside`: absolute names count though nothing is there.

    Examples
    --------
    >>> named_elsewhere({"items": ["heart", "/no/such/*.svg"]}, Path.cwd())
    '/no/such/*.svg'
    """
    home = folder.resolve()
    for name in filter(None, named_files(options)):
        try:
            path = Path(name)
            is_one = path.is_absolute() or path.exists() or any(Path().glob(name))
            if is_one and not path.resolve().is_relative_to(home):
                return name
        except (OSError, ValueError):  # a text that can be no name
            continue
    return ""


def found_from(folder: Path) -> Callable[[str], str]:
    """Names of files of a recipe in ``folder``, as seen from another folder.

    What is neither there nor a bundled name is looked for there too, so that a file of the same
    name in the folder where the program runs is never taken in its place.

    Examples
    --------
    >>> found_from(Path("sets"))("icons/bear.svg"), found_from(Path("sets"))("heart")
    ('sets/icons/bear.svg', 'heart')
    """

    def found(name: str) -> str:
        if not name or _SCHEME.match(name) or Path(name).is_absolute():
            return name
        if _is_there(folder / name):
            # A folder keeps its last stroke: without it, it may be called as what is bundled.
            return str(folder / name) + ("/" if name.endswith("/") else "")
        if _is_pattern(name):
            return str(Path(glob.escape(str(folder)), name))
        is_path = len(Path(name).parts) > 1 or _ENDING.fullmatch(Path(name).suffix)
        if is_path and len(name.split()) == 1 and len(name) < _LONGEST:
            return str(folder / name)
        return f"{BUILTIN}{name}" if _is_there(Path(name)) and name.isidentifier() else name

    return found


def seen_from(folder: Path) -> Callable[[str], str]:
    """Names of files here, as a recipe that is saved in ``folder`` has to call them.

    Relative, unless nothing but the root of the disk holds both.

    Examples
    --------
    >>> seen_from(Path("sets"))("heart")
    'heart'
    """
    home = folder.resolve()

    def seen(name: str) -> str:
        if not name or _SCHEME.match(name):
            return name
        if _is_there(Path(name)):
            return _relative(Path(name).resolve(), home) + ("/" if name.endswith("/") else "")
        if _is_pattern(name):
            parts = Path(name).parts
            fixed = list(itertools.takewhile(lambda part: not glob.has_magic(part), parts))
            return Path(_relative(Path(*fixed).resolve(), home), *parts[len(fixed) :]).as_posix()
        return f"{BUILTIN}{name}" if name.isidentifier() and _is_there(home / name) else name

    return seen


def _renamed(key: str, value: Any, rename: Rename) -> Any:
    if isinstance(value, list | tuple) and key != "data":
        return [_renamed(key, one, rename) for one in value]
    if not isinstance(value, str):
        return value
    if key == "arrange":
        return _measured_by(value, rename)
    if key in {"force", "emit"}:
        return _within(value, rename)
    if value.startswith(AROUND):
        return AROUND + rename(value.removeprefix(AROUND))
    if key == "color_by" and not Path(value).suffix:
        return value  # a column
    renamed = rename(value)
    if key in {"stopwords", "keep_words"} and not _is_list_file(value, renamed):
        return value  # words
    return value if renamed.startswith(BUILTIN) and key not in _SHAPES else renamed


def _is_list_file(*names: str) -> bool:
    there = (name for name in names if _is_there(Path(name)))
    return any(map(is_like_a_path, names)) or any(Path(name).is_file() for name in there)


def _rule(rule: Any, rename: Rename) -> Any:
    if isinstance(rule, Mapping) and isinstance(rule.get("region"), str):
        return {**rule, "region": rename(rule["region"])}
    return rule


def _measured_by(text: str, rename: Rename) -> str:
    """An arrangement, the file of its numbers renamed."""
    return _BY_FILE.sub(lambda met: f'by="{rename(met["file"])}"', text)


def _within(text: str, rename: Rename) -> str:
    """A force or an emitter, its drawn curve or region renamed."""
    words = split_words(text)
    renamed = [
        rename(word) if _is_curve(word) or (k == 1 and words[0] == "in") else word
        for k, word in enumerate(words)
    ]
    return text if renamed == words else " ".join(map(_quoted, renamed))


def _is_curve(word: str) -> bool:
    return word.lower().endswith(".svg") and "=" not in word


def _quoted(word: str) -> str:
    return f'"{word}"' if " " in word else word


def _relative(path: Path, home: Path) -> str:
    try:
        shared = Path(os.path.commonpath([path, home]))
    except ValueError:  # two drives
        return path.as_posix()
    if shared == Path(shared.anchor):
        return path.as_posix()
    return Path(os.path.relpath(path, home)).as_posix()


def _is_pattern(name: str) -> bool:
    return glob.has_magic(name) and _ENDING.fullmatch(Path(name).suffix) is not None


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except (OSError, ValueError):  # a text that can be no name
        return False

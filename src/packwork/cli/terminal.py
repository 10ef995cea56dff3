"""Lines on a terminal: text that is safe there, several notices of one kind as one line."""

from __future__ import annotations

import codecs
import contextlib
import logging
import re
import sys
import unicodedata
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import typer

from packwork.errors import ReadError
from packwork.phrasing import enumerated

PLAIN = {
    "²": "2", "³": "3", "±": "+-", "×": "x", "°": " deg", "µ": "u", "…": "...", "·": "-",
    "–": "-", "—": "-", "−": "-", "’": "'", "‘": "'", "“": '"', "”": '"', "•": "*",
    "─": "-", "━": "-", "│": "|", "┃": "|", "╭": "+", "╮": "+", "╰": "+", "╯": "+",
    "╸": "-", "╺": "-", "├": "+", "┤": "+", "\u00a0": " ", "\u202f": " ",
}  # fmt: skip
"""What stands for signs that an encoding lacks; of all others a question mark does."""

_HANDLER = "packwork.plain"

_OBEYED = frozenset({"Cc", "Cf", "Zl", "Zp"})
"""Kinds of characters that move the cursor, colour, or turn the reading direction round."""

_JOINERS = frozenset("\u200c\u200d\u00ad")
"""Of these kinds, what stands inside words of some scripts."""


def prepare_streams() -> None:
    """Let standard output and error write in plain letters what their encoding lacks.

    A name of a file may hold bytes that are no letters at all; these are written so too.
    """
    codecs.register_error(_HANDLER, _plain)
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(AttributeError, ValueError, OSError):
            stream.reconfigure(errors=_HANDLER)  # type: ignore[union-attr]


def printable(text: str) -> str:
    r"""Text whose control characters are written out, as a name from a stranger may hold some."""
    return "".join(_escaped(letter) if _is_obeyed(letter) else letter for letter in text)


def say(text: str) -> None:
    """Print one line about the run to standard error; one that is closed hears nothing."""
    with contextlib.suppress(OSError, ValueError):
        typer.echo(f"packwork: {printable(text)}", err=True)


def _is_obeyed(letter: str) -> bool:
    return unicodedata.category(letter) in _OBEYED and letter not in _JOINERS


def _escaped(letter: str) -> str:
    return letter.encode("unicode_escape").decode("ascii")


def _plain(error: UnicodeError) -> tuple[str, int]:
    """Stand-ins for what an encoding lacks, as ``codecs.register_error`` wants them."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    return "".join(PLAIN.get(letter, "?") for letter in lacking), error.end


MOST_NAMED = 3
"""Names in a line that stands for several notices; fewer have a line each. Chosen."""

MOST_LINES = 5
"""Lines about items without a place, or different notices, on the terminal; a report names all.
Chosen."""

LEFT_OUT = "left out"
"""How a notice begins that says that a file was not used."""

_NUMBER = re.compile(r"\d+(?:[.,]\d+)*")


class Notices(logging.Handler):
    """Prints what the library logs, one line each, to standard error; or holds it back."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._held: list[tuple[str, str]] | None = None

    def emit(self, record: logging.LogRecord) -> None:
        """Print one notice, or keep it with those of its kind."""
        name, text = _parts(record)
        if self._held is None:
            say(_line(name, text))
        else:
            self._held.append((name, text))

    @contextmanager
    def joining(self) -> Iterator[None]:
        """Hold notices back while the block runs, then print those of one kind as one line."""
        self._held = []
        try:
            yield
        finally:
            held, self._held = self._held, None
            for line in joined_notices(held):
                say(line)


def joined_notices(notices: Sequence[tuple[str, str]], things: str = "files") -> list[str]:
    """Lines for notices, each a name and what is said of it; those of one kind together.

    Of one kind are those that differ in their numbers alone.

    Examples
    --------
    >>> joined_notices([("a.svg", "left out: is empty"), ("b.svg", "has 3 texts")])
    ['left out a.svg: is empty', 'b.svg: has 3 texts']
    >>> joined_notices([(f"{k}.svg", f"has {k} texts") for k in range(1, 6)])
    ['5 files: has 1 texts (1.svg, 2.svg, 3.svg and 2 more)']
    """
    kinds: dict[str, list[tuple[str, str]]] = {}
    for name, text in notices:
        kinds.setdefault(_NUMBER.sub("#", text), []).append((name, text))
    lines: list[str] = []
    for several in kinds.values():
        names = list(dict.fromkeys(name for name, _ in several if name))
        if len(names) < MOST_NAMED:
            lines += dict.fromkeys(_line(*one) for one in several)
            continue
        text = several[0][1]
        colon = " " if text.startswith(LEFT_OUT) else ": "
        lines.append(f"{len(names)} {things}{colon}{text} ({enumerated(names, MOST_NAMED)})")
    return lines


def _line(name: str, text: str) -> str:
    if name and text.startswith(f"{LEFT_OUT}: "):
        return f"{LEFT_OUT} {name}{text.removeprefix(LEFT_OUT)}"
    return f"{name}: {text}" if name else text


def _parts(record: logging.LogRecord) -> tuple[str, str]:
    """Name and text of a notice that speaks of a file; no name where it speaks of none."""
    args = record.args if isinstance(record.args, tuple) else ()
    if record.msg == "%s: %s" and len(args) == 2:
        name, text = (" ".join(str(part).split()) for part in args)
        return name, text
    if record.msg == "left out %s" and len(args) == 1 and isinstance(args[0], ReadError):
        name, why = (" ".join(part.split()) for part in (args[0].file, args[0].problem))
        return name, f"{LEFT_OUT}: {why}"
    return "", " ".join(record.getMessage().split())


NOTICES = Notices()
"""What the command line listens with."""

"""Text that is safe on a terminal: escapes removed, characters that it cannot show replaced."""

from __future__ import annotations

import codecs
import contextlib
import sys
import unicodedata

import typer

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
    r"""Text whose control characters are written out, as a name from a stranger may hold some.

    Examples
    --------
    >>> printable("bear\x1b[2J.svg"), printable("Bär, 熊\n")
    ('bear\\x1b[2J.svg', 'Bär, 熊\\n')
    """
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

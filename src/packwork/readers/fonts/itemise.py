"""A line of a word to runs that can be shaped: of one script and one direction each.

What the bidirectional algorithm of Unicode (UAX 9) says of single words: letters that run
to the left, numbers and other scripts among them that run to the right. Brackets are not
paired and there is no embedding, as words have none.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby

MOST_KNOWN = 4096
"""Clusters and glyphs that are remembered: those of a long Chinese text. Chosen."""

_LEFTWARD, _RIGHTWARD = ("R", "AL"), ("L", "EN", "AN")
_JOINER = "\u200d"
_FIRST_TONE, _LAST_TONE = "\U0001f3fb", "\U0001f3ff"
_FIRST_FLAG, _LAST_FLAG = "\U0001f1e6", "\U0001f1ff"


@dataclass(frozen=True)
class Piece:
    """Part of a line that is shaped at once, in the order in which it is read."""

    text: str
    is_leftward: bool = False


@lru_cache(MOST_KNOWN)
def itemised(line: str) -> tuple[Piece, ...]:
    """Pieces of a line in the order in which they are read.

    >>> [piece.text for piece in itemised("Tōkyō東京")]
    ['Tōkyō', '東京']
    >>> [(piece.text, piece.is_leftward) for piece in itemised("كوفيد19")]
    [('كوفيد', True), ('19', False)]
    """
    return tuple(
        Piece(text, is_leftward)
        for is_leftward, run in _directed(line, _is_leftward(line))
        for text in _of_one_script(run)
    )


def visual_order(pieces: Sequence[Piece]) -> list[int]:
    """Numbers of the pieces from left to right: those read leftward come reversed.

    >>> visual_order(itemised("كوفيد19")), visual_order(itemised("Tōkyō東京"))
    ([1, 0], [0, 1])
    """
    groups = [
        (is_leftward, list(run))
        for is_leftward, run in groupby(
            range(len(pieces)), key=lambda number: pieces[number].is_leftward
        )
    ]
    if _is_leftward("".join(piece.text for piece in pieces)):
        groups.reverse()
    return [k for is_leftward, run in groups for k in (run[::-1] if is_leftward else run)]


def clusters(text: str) -> list[str]:
    r"""Characters with all that belongs to them: marks, variants, joined emoji, flags.

    >>> [len(cluster) for cluster in clusters("e\u0301a👍🏽🇩🇪")]
    [2, 1, 2, 2]
    """
    found: list[str] = []
    for character in text:
        if found and _belongs(character, found[-1]):
            found[-1] += character
        else:
            found.append(character)
    return found


@lru_cache(maxsize=MOST_KNOWN)
def script_of(text: str) -> str:
    """Script of the first character that is of one, by its four letters; empty if none is.

    >>> [script_of(text) for text in ("a", "(я)", "漢", "हि", "2!")]
    ['Latn', 'Cyrl', 'Hani', 'Deva', '']
    """
    import uharfbuzz as hb

    buffer = hb.Buffer()
    buffer.add_str(text)
    buffer.guess_segment_properties()
    return buffer.script or ""


def _belongs(character: str, before: str) -> bool:
    if before.endswith(_JOINER) or _FIRST_TONE <= character <= _LAST_TONE:
        return True
    if _FIRST_FLAG <= character <= _LAST_FLAG:
        return len(before) == 1 and _FIRST_FLAG <= before <= _LAST_FLAG
    return unicodedata.category(character) in {"Mn", "Mc", "Me", "Cf"}


def _is_leftward(line: str) -> bool:
    """Whether its first letter is of a script that runs to the left."""
    return next((kind for kind in map(_strength, line) if kind is not None), False)


def _strength(character: str) -> bool | None:
    """True if it runs to the left; None for what runs as its neighbours do."""
    kind = unicodedata.bidirectional(character)
    if kind in _LEFTWARD:
        return True
    return False if kind in _RIGHTWARD else None


def _directed(line: str, is_leftward: bool) -> Iterator[tuple[bool, str]]:
    """Runs of one direction, in the order of reading."""
    strengths = [_strength(character) for character in line]
    kinds = [
        _between(strengths, k, is_leftward) if strength is None else strength
        for k, strength in enumerate(strengths)
    ]
    for kind, run in groupby(zip(kinds, line, strict=True), key=lambda pair: pair[0]):
        yield kind, "".join(character for _, character in run)


def _between(strengths: list[bool | None], k: int, is_leftward: bool) -> bool:
    """Direction of what has none: that of both sides if they agree, else the line's."""
    before = next((s for s in reversed(strengths[:k]) if s is not None), is_leftward)
    after = next((s for s in strengths[k + 1 :] if s is not None), is_leftward)
    return before if before == after else is_leftward


def _of_one_script(run: str) -> list[str]:
    found: list[str] = []
    current = ""
    for cluster in clusters(run):
        own = script_of(cluster)
        if found and (not own or not current or _alike(own, current)):
            found[-1] += cluster
        else:
            found.append(cluster)
        current = own or current
    return found


def _alike(first: str, second: str) -> bool:
    """Whether two scripts are written together, as the three of Japanese are."""
    japanese = {"Hira", "Kana", "Hani"}
    return first == second or {first, second} <= japanese

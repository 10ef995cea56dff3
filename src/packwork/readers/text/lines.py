"""Letters to lines of words, no part of one touching another."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

import shapely
from shapely import affinity

from packwork.geometry.overlay import union
from packwork.geometry.polygon import Region
from packwork.readers.text.letters import Letter
from packwork.readers.unfit import UnfitError

MOST_CHARACTERS = 500
"""Characters in one container; more could not be filled on any canvas. Chosen."""

LETTER_GAP = 0.04
"""Least distance between neighbouring letters, in ems. Larger wastes the canvas, smaller
lets items of one letter crowd those of the next. Chosen."""

LINE_GAP = 0.12
"""Distance between the boxes of two lines, in ems. Chosen."""

FEW_POINTS = 20_000
"""Points of two neighbours up to which distances are taken from the whole of them: a phrase of
letters that all join has 100,000, and costs a minute. Single letters have hundreds. Chosen."""

_JOINERS = "\u200c\u200d"
"""Where letters are to join, and where not."""

_NOTHING = _JOINERS + " \ufe0e\ufe0f"


def lines_of(text: str) -> list[str]:
    """Lines of a text, ``|`` between them, in composed characters, single spaces.

    Raises
    ------
    UnfitError
        If nothing is left, or it is too long.

    Examples
    --------
    >>> lines_of(" HELLO   big|WORLD| ")
    ['HELLO big', 'WORLD']
    """
    composed = "".join(c for c in unicodedata.normalize("NFC", text) if not _is_unseen(c))
    lines = [" ".join(line.split()) for line in composed.split("|")]
    kept = [line for line in lines if line.strip(_NOTHING)]
    if not kept:
        raise UnfitError("holds no word; give one, as in text:HELLO")
    if sum(map(len, kept)) > MOST_CHARACTERS:
        raise UnfitError(f"is longer than {MOST_CHARACTERS} characters; give fewer words")
    return kept


def set_lines(lines: Sequence[Sequence[Letter]]) -> Region:
    """Region of centred lines, one under the other, in ems.

    Letters stand by their advance, moved apart where they would come nearer than
    ``LETTER_GAP``; lines stand ``LINE_GAP`` under each other's ink.

    Parameters
    ----------
    lines
        Letters of each from left to right.

    Raises
    ------
    UnfitError
        If a line has no ink at all.

    Examples
    --------
    >>> block = Letter(shapely.box(0, -1, 1, 0), 1.0)
    >>> set_lines([[block, block], [block]]).bounds
    (-1.02, 0.0, 1.02, 2.12)
    """
    placed, top = [], 0.0
    for line in lines:
        ink = _set_line(line)
        left, low, right, high = ink.bounds
        placed.append(affinity.translate(ink, -(left + right) / 2, top - low))
        top += high - low + LINE_GAP
    return union(placed)


def _set_line(line: Sequence[Letter]) -> Region:
    pieces: list[Region] = []
    x = 0.0
    for letter in line:
        moved = affinity.translate(letter.region, x)
        push = _push(pieces[-1], moved) if pieces and not moved.is_empty else 0.0
        if not moved.is_empty:
            pieces.append(affinity.translate(moved, push))
        x += push + letter.advance
    if not pieces:
        raise UnfitError("holds a line that draws nothing; choose other signs")
    return union(pieces)


def _push(before: Region, after: Region) -> float:
    """How far right ``after`` must go to keep its distance from ``before``."""
    push, widest = 0.0, before.bounds[2] - after.bounds[0] + LETTER_GAP
    shapely.prepare(before)
    if not shapely.dwithin(before, after, LETTER_GAP):
        return push
    if len(shapely.get_coordinates([before, after])) > FEW_POINTS:
        before, after = _facing(before, after)
    lack = LETTER_GAP - float(shapely.distance(before, after))
    # A step right widens the gap by no more than itself, so no step goes too far.
    while lack > 1e-3 * LETTER_GAP and push < widest:
        push += lack
        lack = LETTER_GAP - float(shapely.distance(before, affinity.translate(after, push)))
    return push


def _facing(before: Region, after: Region) -> tuple[Region, Region]:
    """Parts of two regions beside each other that can be nearer than ``LETTER_GAP``."""
    left, right = after.bounds[0] - LETTER_GAP, before.bounds[2] + LETTER_GAP
    low, high = min(before.bounds[1], after.bounds[1]), max(before.bounds[3], after.bounds[3])
    parts = shapely.clip_by_rect([before, after], left, low - 1, right, high + 1)
    return parts[0], parts[1]


def _is_unseen(character: str) -> bool:
    """Whether a character only steers the text, as marks of direction do; joiners stay."""
    return unicodedata.category(character) == "Cf" and character not in _JOINERS

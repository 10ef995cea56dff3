"""Words that follow lines, set again where anything of them has changed: letters bend as they lie.

No such word lies elsewhere as it is: what changes words, weights, the line or the container has a
run of its own, in which all are set anew.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from packwork import uses
from packwork.errors import RecipeError
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.container import MOST_LEFT_OUT, LeaveOut, SetLines
from packwork.live.document import Document, counted_weight, is_ring_text
from packwork.live.face.offers import font_told, offered_fonts
from packwork.live.kinds import Kind, LineKind, kind_of
from packwork.live.macros import left_out_of
from packwork.live.other_items import in_place
from packwork.live.relayout import Moment, Shown, ground_of, poured_again, run_shown
from packwork.phrasing import enumerated
from packwork.progress import Stop, never
from packwork.readers.fonts.face import bundled_typeface
from packwork.readers.words.word import as_one_line
from packwork.scene.colour import hex_colour
from packwork.scene.item import FontFile, Item
from packwork.scene.layout import Layout
from packwork.scene.recolour import one_colour, recoloured
from packwork.temporary import TemporaryFolder

MOST_FONTS = 16
"""Fonts whose families are remembered. Chosen."""

Put = Callable[[Library], Sequence[Command]]
"""Commands that put something onto a desk, once there is a library for what they bring."""


def put_anew(document: Document, seed: int, shown: Shown, stop: Stop = never, **asked: Any) -> Put:
    """All of a document anew: poured, or where words follow lines set.

    ``asked``: as for :func:`packwork.live.relayout.poured_again`; of words on lines ``words``, by
    how often they are there, ``font``, and ``along`` and ``ring`` as options of words have them.

    Raises
    ------
    RecipeError
        If lines are asked for and something is there that is no word or is held, or a text round
        the edge has no room; if words have fonts of their own and none is asked for.
    """
    if "along" not in asked and not isinstance(document.kind, LineKind):
        arranged = poured_again(document, seed, shown, stop, **asked)
        return lambda _: [arranged]
    return _set_anew(document, asked, shown, stop)


def words_in(document: Document) -> dict[str, float]:
    """Words of a document, each once, and how often it is there; without texts of rings."""
    found = dict[str, float]()
    rows = _word_rows(document)
    counts = [counted_weight(document.items[k]) for k in rows]
    for k, count in zip(rows, counts, strict=True):
        weight = float(document.weights[k])
        found.setdefault(document.items[k].name, weight if None in counts else float(count or 1.0))
    return found


def _word_rows(document: Document) -> list[int]:
    return [
        k
        for k, item in enumerate(document.items)
        if _is_word(item) and not is_ring_text(item, document.kind)
    ]


def _is_word(item: Item) -> bool:
    """Whether an item is a word: emoji are drawn, and have the tooltip of one."""
    return item.text is not None or item.label.title.startswith(f"{item.name}: ")


def _set_anew(document: Document, asked: Mapping[str, Any], shown: Shown, stop: Stop) -> Put:
    before, kind = words_in(document), document.kind
    known = kind if isinstance(kind, LineKind) else LineKind()
    along, ring = asked.get("along", known.along), tuple(asked.get("ring", known.ring))
    words = asked.get("words") or before
    if not words:
        raise RecipeError("along", "is for words, and there are none; fill with some first")
    # Refuse what would be lost where all words are set anew.
    others = dict.fromkeys(item.name for item in document.items if not _is_word(item))
    if others:
        names = enumerated(list(others))
        raise RecipeError("along", f"is for words alone; take away first what is none: {names}")
    rows = np.flatnonzero(document.held.any(axis=1)).tolist()
    if rows:
        names = enumerated(list(dict.fromkeys(document.items[k].name for k in rows)))
        raise RecipeError("along", f"sets all words anew; release first what is held: {names}")
    given: dict[str, Any] = {**ground_of(document), "effort": "draft", "along": along}
    given["padding"] = f"{document.options.padding:.17g}{document.container.unit}"
    given |= {"palette": known.palette} if known.palette else {}
    with TemporaryFolder("font") as folder:
        asked_font = asked.get("font")
        given["fonts"] = [asked_font] if asked_font else _fonts_of(document, folder.path)
        recipe = uses.words_recipe("page", words, ring=ring, count=len(words), **given)
        job = uses.read(recipe, None, document.container.sheet)

        def show(moment: Moment) -> None:
            # Other letters have no place among those that are there.
            shown(replace(moment, items=document.items, poses=None))

        layout = _in_their_colours(run_shown(job, show, stop)[0], document)
    if not asked_font:
        _check_fonts(document, layout)
    now = kind_of(layout.manifest)
    rings = {item.name for item in layout.items if is_ring_text(item, now)}
    there = {item.name for item in layout.items if not is_ring_text(item, now)}
    if lost := [text for text in ring if as_one_line(text) not in rings]:
        raise RecipeError("ring", f"has no room for {lost[0][:40]!r}; give a shorter text")
    stated = made(SetLines, along=along, ring=ring, palette=known.palette)
    gone = [k for k in _word_rows(document) if document.items[k].name not in there]
    no_room = {text: n for text, n in words.items() if as_one_line(text) not in there}
    kept = {**left_out_of(document, gone, there), **no_room}
    left_out = made(LeaveOut, words=dict(list(kept.items())[-MOST_LEFT_OUT:]))
    return lambda library: [left_out, *in_place(document, library, layout), stated]


def _fonts_of(document: Document, folder: Path) -> list[str]:
    """Fonts that are there, each for what those before it lack; none where the bundled one does.

    Families of this machine by name, others as files.
    """
    runs = [run for item in document.items if item.text for run in item.text.runs]
    found, offered = list[str](), offered_fonts()
    for told, font in {_told(run.font): run.font for run in runs}.items():
        if told in offered:
            found.append(told)
        else:
            file = folder / (Path(font.name).name or "font.ttf")
            file.write_bytes(font.data)
            found.append(str(file))
    # With none named, what is installed draws what the bundled one lacks.
    return [] if found == [_told(bundled_typeface().file)] else found


def _check_fonts(document: Document, layout: Layout) -> None:
    """Refuse where words or texts would lose a font of their own to that of others."""
    before, now = document.kind, kind_of(layout.manifest)
    own = {_key(item, before): _families(item) for item in document.items}
    for item in layout.items:
        if (known := own.get(_key(item, now))) and known != _families(item):
            names = enumerated(sorted({name for one in own.values() for name in one}))
            raise RecipeError("font", f"is one for all words on lines, not {names}; choose one")


def _families(item: Item) -> frozenset[str]:
    return frozenset(_told(run.font) for run in item.text.runs) if item.text else frozenset()


@lru_cache(MOST_FONTS)
def _told(font: FontFile) -> str:
    return font_told(font)


def _key(item: Item, kind: Kind) -> tuple[str, bool]:
    return item.name, is_ring_text(item, kind)


def _in_their_colours(layout: Layout, before: Document) -> Layout:
    """A layout whose words and texts have the colours that they had before."""
    kind = kind_of(layout.manifest)
    colours = {_key(item, before.kind): one_colour(item.art) for item in before.items}
    items = [
        item
        if (known := colours.get(_key(item, kind))) in {None, one_colour(item.art)}
        else recoloured(item, hex_colour(known))
        for item in layout.items
    ]
    return replace(layout, items=tuple(items))

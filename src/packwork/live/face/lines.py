"""Words that follow lines, set again where anything of them has changed: letters bend as they lie.

No such word lies elsewhere as it is: what changes words, weights, the line or the container has a
run of its own, in which all are set anew.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from packwork import uses
from packwork.errors import RecipeError
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.container import LeaveOut
from packwork.live.commands.lines import SetLines
from packwork.live.document import Document, counted_weight
from packwork.live.face.offers import font_told, offered_fonts
from packwork.live.kinds import LineKind
from packwork.live.macros import left_out_of
from packwork.live.other_items import in_place
from packwork.live.relayout import Moment, Shown, ground_of, poured_again, run_shown
from packwork.progress import Stop, never
from packwork.scene.colour import hex_colour
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.recolour import one_colour, recoloured
from packwork.temporary import TemporaryFolder

Put = Callable[[Library], Sequence[Command]]
"""Commands that put something onto a desk, once there is a library for what they bring."""


def put_anew(document: Document, seed: int, shown: Shown, stop: Stop = never, **asked: Any) -> Put:
    """All of a document anew: poured, or where words follow lines set.

    ``asked``: as for :func:`packwork.live.relayout.poured_again`; of words on lines ``words``, by
    how often they are there, ``font``, and ``along`` and ``ring`` as options of words have them.
    """
    if "along" not in asked and not isinstance(document.kind, LineKind):
        arranged = poured_again(document, seed, shown, stop, **asked)
        return lambda _: [arranged]
    return _set_anew(document, asked, shown, stop)


def words_in(document: Document) -> dict[str, float]:
    """Words of a document, each once, and how often it is there; without texts of rings."""
    kind, found = document.kind, dict[str, float]()
    rings = kind.ring if isinstance(kind, LineKind) else ()
    pairs = list(zip(document.items, document.weights.tolist(), strict=True))
    words = [(item, weight) for item, weight in pairs if item.text and item.name not in rings]
    counts = [counted_weight(item) for item, _ in words]
    for (item, weight), count in zip(words, counts, strict=True):
        found.setdefault(item.name, weight if None in counts else float(count or 1.0))
    return found


def _set_anew(document: Document, asked: Mapping[str, Any], shown: Shown, stop: Stop) -> Put:
    before, kind = words_in(document), document.kind
    known = kind if isinstance(kind, LineKind) else LineKind()
    along, ring = asked.get("along", known.along), tuple(asked.get("ring", known.ring))
    words = asked.get("words") or before
    if not words:
        raise RecipeError("along", "is for words, and there are none; fill with some first")
    given: dict[str, Any] = {**ground_of(document), "effort": "draft", "along": along}
    given["padding"] = f"{document.options.padding:.17g}{document.container.unit}"
    given |= {"palette": known.palette} if known.palette else {}
    with TemporaryFolder("font") as folder:
        font = asked.get("font") or _font_of(document, folder.path)
        given |= {"font": font} if font else {}
        recipe = uses.words_recipe("page", words, ring=ring, **given)
        job = uses.read(recipe, None, document.container.sheet)

        def show(moment: Moment) -> None:
            # Other letters have no place among those that are there.
            shown(replace(moment, items=document.items, poses=None))

        layout = _in_their_colours(run_shown(job, show, stop)[0], document.items)
    stated = made(SetLines, along=along, ring=ring, palette=known.palette)
    gone = [k for k, item in enumerate(document.items) if item.name in before.keys() - words]
    left_out = made(LeaveOut, words=left_out_of(document, gone, set(words)))
    return lambda library: [left_out, *in_place(document, library, layout), stated]


def _font_of(document: Document, folder: Path) -> str | None:
    """Font of the words that are there: a family of this machine, else a file of what they have."""
    font = next((one.text.runs[0].font for one in document.items if one.text), None)
    if font is None or (told := font_told(font)) in offered_fonts():
        return None if font is None else told
    file = folder / (Path(font.name).name or "font.ttf")
    file.write_bytes(font.data)
    return str(file)


def _in_their_colours(layout: Layout, before: Sequence[Item]) -> Layout:
    """A layout whose words have the colours that they had before."""
    colours = {item.name: one_colour(item.art) for item in before}
    items = [
        item
        if (known := colours.get(item.name)) in {None, one_colour(item.art)}
        else recoloured(item, hex_colour(known))
        for item in layout.items
    ]
    return replace(layout, items=tuple(items))

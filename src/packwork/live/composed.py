"""What takes several commands: another number of items, another list of words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from packwork.errors import RecipeError
from packwork.live.assets import named_item
from packwork.live.commands.command import Command, Library, made
from packwork.live.commands.items import Add, Remove, Weigh
from packwork.live.document import Document
from packwork.live.neighbourhood.shapes import Shapes
from packwork.live.neighbourhood.voids import widest_places
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.scene.colour import hex_colour
from packwork.scene.item import Item
from packwork.scene.recolour import one_colour, recoloured
from packwork.uses.words.recipe import words_recipe

SAME = 1e-6
"""By how much, relatively, a weight may differ and be the same. Derived: rounding."""


def brought(
    document: Document, library: Library, shapes: Shapes, items: Iterable[Item]
) -> Iterator[Add]:
    """Commands that bring items to where most room is, as large as it is good for."""
    places = widest_places(document, shapes)
    for item, (x, y, radius) in zip(items, places, strict=False):
        area = first_area(document, radius, item.weight)
        yield made(Add, asset=named_item(library, item), x=x, y=y, area=area)


def first_area(document: Document, radius: float, weight: float) -> float:
    """Area that a new item begins with: what a disc is good for, within the usual sizes.

    Parameters
    ----------
    radius
        Of the disc, canvas units.
    weight
        Of the item: where sizes are in shares, that is what it gets.
    """
    areas = document.own_areas * document.poses.scale**2
    usual = float(np.mean(areas)) if len(areas) else np.pi * radius**2
    if document.options.sizes != "free":
        mean = float(np.mean(document.weights)) if len(areas) else 1.0
        return usual * weight / mean
    least = usual / document.options.size_ratio**2
    return float(np.clip(np.pi * radius**2, least, usual))


def counted(document: Document, library: Library, shapes: Shapes, count: int) -> Iterator[Command]:
    """Commands after which there are so many items.

    What is most there goes first, the last of it, and nothing that is held; of what is least there
    copies come.
    """
    present = Counter(document.items)
    more = count - len(document)
    if more > 0:
        yield from brought(document, library, shapes, _scarcest(present, more))
    elif more < 0:
        yield made(Remove, items=_spared(document, present, -more))


def words_of(document: Document, source: object, options: Mapping[str, Any]) -> WordsRead:
    """Words of a text or a table, set as the run did that made the layout.

    Parameters
    ----------
    options
        Of words, in place of that run's.

    Raises
    ------
    ReadError
        If they cannot be read.
    RecipeError
        If an option has no meaning.
    """
    recipe = document.manifest.get("recipe")
    before = recipe.get("words") if isinstance(recipe, Mapping) else None
    known = before if isinstance(before, Mapping) else {}
    given = {k: v for k, v in known.items() if v is not None and k != "source"}
    asked = words_recipe(document.container.name, source, **{**given, **options}).words
    if asked is None:
        raise RecipeError("words", "none were given")
    return read_word_items(asked)


def worded(
    document: Document, library: Library, shapes: Shapes, read: WordsRead
) -> Iterator[Command]:
    """Commands after which the words are those of another list, with its weights.

    Words that stay are the same items; new ones come in the colours of the others, in turn.
    """
    now = {item.name: share for item, share in zip(read.items, read.areas, strict=True)}
    rows = {item.name: k for k, item in enumerate(document.items) if item.name in now}
    # Shares are of another whole each time: what stays is as large as before in all.
    kept = list(rows.values())
    asked = sum(now[name] for name in rows)
    unit = float(document.weights[kept].sum()) / asked if asked else 1.0
    for name, k in rows.items():
        weight = unit * now[name]
        if abs(weight - document.weights[k]) > SAME * weight:
            yield made(Weigh, items=(int(document.ids[k]),), weight=weight)
    colours = list(dict.fromkeys(c for item in document.items if (c := one_colour(item.art))))
    new = [
        replace(item, weight=unit * now[item.name]) for item in read.items if item.name not in rows
    ]
    if colours:
        new = [recoloured(one, hex_colour(colours[k % len(colours)])) for k, one in enumerate(new)]
    yield from brought(document, library, shapes, new)
    gone = [
        int(document.ids[k]) for k, item in enumerate(document.items)
        if item.text is not None and item.name not in now
    ]  # fmt: skip
    if gone:
        yield made(Remove, items=gone)


def _scarcest(present: Counter[Item], count: int) -> Iterator[Item]:
    """As many copies of those items that there are fewest of."""
    present = Counter(present)
    for _ in range(count):
        item = min(present, key=present.__getitem__)
        present[item] += 1
        yield item


def _spared(document: Document, present: Counter[Item], count: int) -> tuple[int, ...]:
    """Numbers of items that go: of what there is most, the last."""
    present, gone = Counter(present), []
    free = [k for k in range(len(document)) if not document.held[k].any()]
    if len(free) < count:
        raise RecipeError("count", f"{len(document) - len(free)} items are held; release some")
    for _ in range(count):
        k = max(free, key=lambda k: (present[document.items[k]], k))
        free.remove(k)
        present[document.items[k]] -= 1
        gone.append(int(document.ids[k]))
    return tuple(gone)

"""Macros: commands for another number of items, or another list of words."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from packwork.errors import RecipeError
from packwork.live.commands.command import Command, made, named_item, true_scale
from packwork.live.commands.container import MOST_LEFT_OUT, LeaveOut, SetOption
from packwork.live.commands.gestures import Hold, Release
from packwork.live.commands.items import Add, Remove, Replace, Weigh
from packwork.live.document import Document, counted_weight, is_straight_word
from packwork.live.neighbourhood.places import widest_places
from packwork.phrasing import enumerated
from packwork.pipeline.region_labels import PART_LABEL, PartLabel
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.scene.colour import hex_colour
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.recolour import in_own_colours, one_colour, recoloured
from packwork.uses.words.recipe import words_recipe

if TYPE_CHECKING:
    from packwork.live.session import Session

SAME = 1e-6
"""By how much, relatively, a weight may differ and be the same. Derived: rounding."""

ALIKE = 0.003
"""By how much a word's figure may differ where its letters are the same: files round. Chosen."""


def brought(session: Session, items: Iterable[Item]) -> Iterator[Add]:
    """Commands that bring items to where most room is, as large as it is good for.

    What is there already comes with the weight that it has there, all else with its own, in the
    document's unit.
    """
    listed = list(items)
    yield from weighed(session, zip(listed, weights_in(session.document, listed), strict=True))


def weights_in(document: Document, items: Sequence[Item]) -> list[float]:
    """Weights with which items come into a document, in its unit."""
    there = dict(zip(reversed(document.items), reversed(document.weights.tolist()), strict=True))
    # Factor of items' own weights: words weigh what they cover.
    own = sum(item.weight for item in document.items)
    total = float(document.weights.sum())
    unit = total / own if own > 0 and total > 0 else 1.0
    return [there.get(item, item.weight * unit) for item in items]


def weighed(session: Session, pairs: Iterable[tuple[Item, float]]) -> Iterator[Add]:
    """The same for items with weights in the document's unit."""
    document = session.document
    places = widest_places(document, session.shapes)
    for (item, weight), (x, y, radius) in zip(pairs, places, strict=False):
        true = true_scale(document, item)
        area = first_area(document, radius, weight)
        area = area if true is None else item.outline.area * true**2
        asset = named_item(session.library, item)
        yield made(Add, asset=asset, x=x, y=y, area=area, weight=weight)


def first_area(document: Document, radius: float, weight: float) -> float:
    """Area that a new item begins with: what a disc is good for, within the usual sizes.

    Parameters
    ----------
    radius
        Of the disc, canvas units.
    weight
        Of the item, in the document's unit: where sizes are in shares, or weights differ, that is
        what it gets.
    """
    areas = document.areas
    usual = float(np.mean(areas)) if len(areas) else np.pi * radius**2
    if document.options.sizes != "free" or np.ptp(document.weights) > 0:
        mean = float(np.mean(document.weights)) if len(areas) else 1.0
        return usual * weight / mean
    least = usual / document.options.size_ratio**2
    return float(np.clip(np.pi * radius**2, least, usual))


def counted(session: Session, count: int) -> Iterator[Command]:
    """Commands after which there are so many items.

    What is most there goes first, the last of it, and nothing that is held; of what is least there
    copies come.
    """
    document = session.document
    present = Counter(document.items)
    more = count - len(document)
    if more > 0:
        yield from brought(session, _scarcest(present, more))
    elif more < 0:
        yield made(Remove, items=_spared(document, present, -more))


def words_of(document: Document, source: object, options: Mapping[str, Any]) -> WordsRead:
    """Words of a text or a table, set as the run did that made the layout."""
    recipe = document.manifest.get("recipe")
    before = recipe.get("words") if isinstance(recipe, Mapping) else None
    known = before if isinstance(before, Mapping) else {}
    given = {k: v for k, v in known.items() if v is not None and k != "source"}
    if "font" in options:
        # A session has no container that letters are read from.
        options = {"fonts": options["font"], **{k: v for k, v in options.items() if k != "font"}}
    asked = words_recipe(document.container.name, source, **{**given, **options}).words
    if asked is None:
        raise RecipeError("words", "none were given")
    return read_word_items(asked)


def worded(session: Session, read: WordsRead, *, is_lettered: bool) -> Iterator[Command]:
    """Commands after which the words are those of another list, with its weights.

    Words that stay are the same items; new ones come in the colours of the others, in turn.

    ``is_lettered``: whether how words are set was asked for: those that stay then take on the new
    letters.
    """
    document = session.document
    now = {item.name: share for item, share in zip(read.items, read.areas, strict=True)}
    words = word_rows(document)
    rows: dict[str, int] = {}
    # Of copies the heaviest stays.
    for k in sorted(words, key=lambda k: -document.weights[k]):
        if document.items[k].name in now:
            rows.setdefault(document.items[k].name, k)
    gone = [k for k in words if k not in rows.values()]
    # Refuse to take away what is held.
    held = [document.items[k].name for k in gone if document.held[k].any()]
    if held:
        raise RecipeError(
            "words", f"{enumerated(held)}: held, and not among these words; release it first"
        )
    # Shares are of another whole each time: what stays is as large as before in all.
    kept = list(rows.values()) or words
    asked = sum(now[name] for name in rows) or sum(now.values())
    unit = float(document.weights[kept].sum()) / asked if kept and asked else 1.0
    letters = {item.name: item for item in read.items} if is_lettered else {}
    replaced = set[str]()
    for name, k in rows.items():
        if name in letters and _is_set_otherwise(document.items[k], letters[name]):
            item, colour = letters[name], one_colour(_drawn(document, document.items[k]).art)
            item = item if colour is None else recoloured(item, hex_colour(colour))
            asset = named_item(session.library, item)
            replaced.add(name)
            yield made(Replace, item=int(document.ids[k]), asset=asset)
    titles = {item.name: item.label.title for item in read.items}
    for name, k in rows.items():
        item = document.items[k]
        if name not in replaced and item.label.title != titles[name]:
            told = replace(item, label=replace(item.label, title=titles[name]))
            asset = named_item(session.library, told)
            yield made(Replace, item=int(document.ids[k]), asset=asset)
    for name, k in rows.items():
        weight = unit * now[name]
        if abs(weight - document.weights[k]) > SAME * weight:
            yield made(Weigh, items=(int(document.ids[k]),), weight=weight)
    drawn = (one_colour(_drawn(document, item).art) for item in document.items)
    colours = list(dict.fromkeys(colour for colour in drawn if colour))
    new = [item for item in read.items if item.name not in rows]
    weights = [unit * now[item.name] for item in new]
    if colours:
        new = [recoloured(one, hex_colour(colours[k % len(colours)])) for k, one in enumerate(new)]
    yield from weighed(session, zip(new, weights, strict=True))
    if gone:
        yield made(Remove, items=tuple(int(document.ids[k]) for k in gone))
    left_out = left_out_of(document, gone, set(now))
    if left_out != document.left_out:
        yield made(LeaveOut, words=left_out)


def _drawn(document: Document, item: Item) -> Item:
    """An item without the colours of a mosaic, which it has only where it lies."""
    return item if document.mosaic is None else in_own_colours(item)


def mixed(
    session: Session, read: WordsRead | None, share: float, colours: Sequence[str] = ()
) -> list[Command]:
    """Commands after which words have a share of what all cover, and other items the rest.

    Sizes are in proportion from then on, and words horizontal; where all lie, a run is to find.

    Parameters
    ----------
    read
        Words that come beside those that are there; None for none.
    colours
        Of new words, in turn; none for that in which they were set.
    """
    document, new = session.document, () if read is None else read.items
    rows = np.array([item.text is not None for item in document.items])
    if rows.all() or not (len(new) or rows.any()):
        raise RecipeError("share", "is of words among other items; there is one kind only")
    weights = document.positive_weights
    kept = weights[rows]
    come = np.zeros(0) if read is None else read.areas / float(np.mean(read.areas))
    come = come * (float(np.mean(kept)) if len(kept) else 1.0)
    others = float(weights[~rows].sum())
    unit = others * share / (1 - share) / float(kept.sum() + come.sum())
    commands: list[Command] = [
        made(SetOption, name=name, value=value)
        for name, value in (("sizes", "shared"), ("rotate", "horizontal"))
        if getattr(document.options, name) != value
    ]
    shared = np.where(rows, unit * weights, weights)
    commands += [
        made(Weigh, items=(int(document.ids[k]),), weight=float(shared[k]))
        for k in np.flatnonzero(shared != document.weights)
    ]
    x, y = (side / 2 for side in (document.container.width, document.container.height))
    area = float(document.areas.sum()) / (others + unit * float(kept.sum()))
    for k, (item, weight) in enumerate(zip(new, (unit * come).tolist(), strict=True)):
        one = recoloured(item, colours[k % len(colours)]) if colours else item
        asset = named_item(session.library, one)
        commands.append(made(Add, asset=asset, x=x, y=y, area=area * weight, weight=weight))
    return commands


def labelled(session: Session, labels: Sequence[PartLabel]) -> Iterator[Command]:
    """Commands after which names lie on the parts of a container, held; those before are gone.

    Where these are all there is and no others come they stay, as items like any.
    """
    document = session.document
    before = tuple(document.ids[_part_labels(document)].tolist())
    for label in labels:
        longest = float(np.ptp(np.reshape(label.item.outline.bounds, (2, 2)), axis=0).max())
        area = label.item.outline.area * (label.size / longest) ** 2
        asset = named_item(session.library, label.item)
        yield made(Add, asset=asset, x=label.x, y=label.y, area=area)
    if labels:
        first = document.next_id
        yield made(Hold, items=tuple(range(first, first + len(labels))))
    if before and (labels or len(before) < len(document)):
        yield made(Remove, items=before)
    elif before:
        yield made(Release, items=before)


def labels_in(document: Document, container: Container) -> list[PartLabel]:
    """Names on the parts of a document's container, as they lie in one of another size."""
    here, there = (
        np.reshape(one.outline.bounds, (2, 2)) for one in (document.container, container)
    )
    scale = float(np.ptp(there, axis=0).max() / np.ptp(here, axis=0).max())
    poses, labels = document.poses, list[PartLabel]()
    for k in _part_labels(document):
        item = document.items[k]
        place = np.array([poses.x[k], poses.y[k]])
        x, y = (there[0] + scale * (place - here[0])).tolist()
        size = scale * float(
            poses.scale[k] * np.ptp(np.reshape(item.outline.bounds, (2, 2)), 0).max()
        )
        labels.append(PartLabel(item, size, x, y))
    return labels


def _part_labels(document: Document) -> list[int]:
    """Rows of names of the parts of a container."""
    return [k for k, one in enumerate(document.items) if one.source.startswith(PART_LABEL)]


def left_out_of(document: Document, gone: Sequence[int], now: set[str]) -> dict[str, float]:
    """Words left out with how often they were there; none where there are others than before."""
    before, words = document.left_out, [item.name for item in document.items]
    if not now <= {*before, *words}:
        return {}
    kept = {name: count for name, count in before.items() if name not in now}
    share = 100 / float(document.weights.max())
    for k in gone:
        item, weight = document.items[k], share * float(document.weights[k])
        if item.name not in now:
            kept[item.name] = counted_weight(item) or float(f"{weight:.3g}")
    return dict(list(kept.items())[-MOST_LEFT_OUT:])


def word_rows(document: Document) -> list[int]:
    """Rows of a cloud's words, those that are not bent; files of shapes say so of all alone."""
    rows = [k for k, item in enumerate(document.items) if is_straight_word(item)]
    recipe = document.manifest.get("recipe")
    is_of_words = isinstance(recipe, Mapping) and recipe.get("words") is not None
    return list(range(len(document))) if is_of_words and not rows else rows


def _is_set_otherwise(before: Item, now: Item) -> bool:
    """Whether a word's letters are others, whatever their size."""
    return bool(np.abs(np.subtract(_figure(before), _figure(now))).max() > ALIKE)


def _figure(item: Item) -> tuple[float, float]:
    """Logarithms of a word's length over its height, and of the share of its box that it inks."""
    left, top, right, bottom = item.outline.bounds
    wide, high = right - left, bottom - top
    return math.log(wide / high), math.log(item.outline.area / (wide * high))


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


def prepared(
    session: Session, make: Callable[[Session], Sequence[Command]], *, keeps_hand: bool = False
) -> tuple[Sequence[Command], Document]:
    """Commands, and the document as they would leave it, for a run to put its items anew.

    ``keeps_hand``: whether places are held there that a hand has given to items.
    """
    commands, document = make(session), session.document
    for command in commands:
        document = command.applied(document, session.library)
    return commands, document.with_held_hand() if keeps_hand else document

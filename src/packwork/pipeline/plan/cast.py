"""Items that are placed, their numbers of copies, and the rules of each copy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.pipeline.plan.asked import ItemRules, RuleSource, named, voices
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import read_weights
from packwork.recipe import Recipe
from packwork.recipe.rules import MAX_COUNT, Rule
from packwork.scene.item import Item

WIDEST_WEIGHTS = 1e6
"""Largest weight over the smallest: beyond it the small ones could not be seen. Chosen."""


@dataclass(frozen=True, eq=False)
class Cast:
    """All copies to be placed.

    Parameters
    ----------
    weights
        ``(n,)`` share of area of each.
    """

    items: tuple[Item, ...]
    asked: tuple[ItemRules, ...]
    weights: FloatArray


def expand_copies(
    recipe: Recipe,
    items: Sequence[Item],
    total: int | None = None,
    areas: FloatArray | None = None,
) -> Cast:
    """Copies of items in turn, and what the rules ask of each.

    A rule that pins both x and y is for one copy of each item that it names: the first
    that no such rule before it has taken. All others are for all copies.

    Parameters
    ----------
    total
        Copies in all, where the run found it; None for as many as the recipe says.
    areas
        ``(n,)`` share of area of each item, in place of the recipe's table.

    Raises
    ------
    RecipeError
        If rules name no item, ask for more than the count, or pin one copy twice.
    """
    shares = item_weights(items, recipe.weights, recipe) if areas is None else areas
    if total is None and isinstance(recipe.count, int):
        total = recipe.count
    said = voices(recipe)
    members_of = [_members(rule, voice, items) for voice, rule in said]
    which = turns(_counts(said, members_of, len(items)), total)
    asked = [ItemRules() for _ in which]
    taken: dict[int, RuleSource] = {}
    for (voice, rule), members in zip(said, members_of, strict=True):
        for member in members:
            copies = [int(k) for k in np.flatnonzero(which == member)]
            if rule.is_for_one:
                copies = [_free_copy(copies, taken, items[member].name, voice)]
                taken[copies[0]] = voice
            for k in copies:
                asked[k] = asked[k].heard(rule, voice)
    chosen = tuple(items[k] for k in which)
    return Cast(chosen, tuple(asked), _weights(shares[which], asked))


def turns(counts: Sequence[int | None], total: int | None) -> IntArray:
    """Index of each copy's item: all in turn, again and again, until each has its count.

    Parameters
    ----------
    counts
        Copies of each item; None for as many as are left, shared evenly.
    total
        Copies in all; None for one of each that has no count of its own.

    Raises
    ------
    RecipeError
        If the counts do not add up to the total, or to nothing at all.

    Examples
    --------
    >>> turns([None, 3, None], 7).tolist(), turns([None, 2], None).tolist()
    ([0, 1, 2, 0, 1, 2, 1], [0, 1, 1])
    """
    given = sum(count for count in counts if count is not None)
    others = [k for k, count in enumerate(counts) if count is None]
    left = (given + len(others) if total is None else total) - given
    if left < 0 or (left > 0 and not others):
        raise RecipeError(
            "count", f"rules count {number_of(given, 'item')} in all, this {total}; make them one"
        )
    if not 0 < given + left <= MAX_COUNT:
        raise RecipeError("rules", f"count {given + left} items; use 1 to {MAX_COUNT}")
    copies = [count or 0 for count in counts]
    for turn, k in enumerate(others):
        copies[k] = left // len(others) + (turn < left % len(others))
    rounds = np.concatenate([np.arange(count) for count in copies])
    whose = np.repeat(np.arange(len(counts)), copies)
    return np.asarray(whose[np.lexsort((whose, rounds))])


def item_weights(
    items: Sequence[Item],
    weights: str | Mapping[str, float] | None,
    asked: TableFormat | None = None,
) -> FloatArray:
    """``(n,)`` share of area of each item, by its name or its file's; else its own.

    Raises
    ------
    RecipeError
        If a weight names no item, or is not a positive number.
    """
    if weights is None:
        return np.array([float(item.weight) for item in items])
    table = read_weights(weights, asked) if isinstance(weights, str) else weights
    names = {item.name for item in items}
    files = {Path(item.source).name for item in items}
    for name, weight in table.items():
        if name not in names | files:
            raise RecipeError(
                "weights", f"no item is called {name!r}; there are {', '.join(sorted(names)[:12])}"
            )
        if not (np.isfinite(weight) and weight > 0):
            raise RecipeError("weights", f"the weight of {name} must be positive, not {weight}")
    of_file = [table.get(Path(item.source).name, item.weight) for item in items]
    pairs = zip(items, of_file, strict=True)
    return np.array([float(table.get(item.name, other)) for item, other in pairs])


def kinds(items: Sequence[Item]) -> IntArray:
    """``(n,)`` the same number for items of one name."""
    _, numbers = np.unique([item.name for item in items], return_inverse=True)
    return np.asarray(numbers, dtype=np.int64)


def _weights(shares: FloatArray, asked: Sequence[ItemRules]) -> FloatArray:
    """Shares of the copies, weights of the rules in their place, not too far apart."""
    pairs = zip(asked, shares.tolist(), strict=True)
    found = np.array([one.values.get("weight", weight) for one, weight in pairs])
    if found.max() / found.min() > WIDEST_WEIGHTS:
        raise RecipeError(
            "weights",
            f"the largest may be {WIDEST_WEIGHTS:g} times the smallest, "
            f"not {found.max():g} to {found.min():g}",
        )
    return found


def _members(rule: Rule, voice: RuleSource, items: Sequence[Item]) -> list[int]:
    members = named(rule, voice, [item.name for item in items])
    if voice.key != "hero":
        return members
    if len({items[k].name for k in members}) > 1:
        several = ", ".join(items[k].name for k in members[:4])
        raise voice.error(f"names {len(members)} items ({several} ...); name one")
    return members[:1]


def _counts(
    said: Sequence[tuple[RuleSource, Rule]], members_of: Sequence[Sequence[int]], items: int
) -> list[int | None]:
    """Copies of each item where rules count them; a hero stands alone if others can."""
    counts: list[int | None] = [None] * items
    for (voice, rule), members in zip(said, members_of, strict=True):
        for k in members:
            if rule.count is not None:
                counts[k] = rule.count
            elif voice.key == "hero" and counts[k] is None and items > 1:
                counts[k] = 1
    return counts


def _free_copy(
    copies: Sequence[int], taken: Mapping[int, RuleSource], name: str, voice: RuleSource
) -> int:
    """The first copy that has no place yet."""
    free = [k for k in copies if k not in taken]
    if free:
        return free[0]
    if not copies:
        raise voice.error(f"pins {name}, of which there is no copy; count at least 1")
    others = " and ".join(sorted({(taken[k].place or taken[k].key).strip(" :") for k in copies}))
    amount = "the only copy" if len(copies) == 1 else f"all {len(copies)} copies"
    raise voice.error(
        f"pins {name}, but {others} pins {amount} of it; count {len(copies) + 1} or more"
    )

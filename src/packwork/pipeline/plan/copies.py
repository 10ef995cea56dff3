"""Copies of items, their shares of area, and what rules ask of each."""

from __future__ import annotations

import difflib
import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase
from pathlib import Path, PurePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.phrasing import MOST_NAMED, meant, number_of
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import read_weights
from packwork.recipe import Recipe
from packwork.recipe.rules import MAX_COUNT, Pin, Rotation, Rule, hero_rule
from packwork.scene.item import Item, PhotoArt


@dataclass(frozen=True)
class RuleSource:
    """Option of a recipe that asks for something, for messages."""

    key: str
    place: str = ""

    def error(self, problem: str) -> RecipeError:
        """Error about what this source asked.

        Examples
        --------
        >>> print(RuleSource("rules", "rule 2: ").error("asks too much"))
        rules: rule 2: asks too much
        """
        return RecipeError(self.key, f"{self.place}{problem}")


@dataclass(frozen=True)
class ItemRules:
    """Rules of one copy: of two that speak of one thing the later one holds.

    Parameters
    ----------
    values
        By key of a rule, but not ``items``, ``count`` and ``pin``.
    sources
        Which option asked, by the same keys, those of the pin with ``pin.`` before them.
    is_central
        Whether it names those about it, and has to lie among them.
    """

    values: Mapping[str, Any] = field(default_factory=dict)
    pin: Mapping[str, Any] = field(default_factory=dict)
    sources: Mapping[str, RuleSource] = field(default_factory=dict)
    is_read: bool = False
    is_central: bool = False

    def merged(self, rule: Rule, source: RuleSource) -> ItemRules:
        """The same after one more rule.

        Examples
        --------
        >>> first = ItemRules().merged(Rule(items="a", color="red", weight=2), RuleSource("rules"))
        >>> dict(first.merged(Rule(items="a", color="blue"), RuleSource("rules")).values)
        {'weight': 2.0, 'color': 'blue'}
        """
        said = {key: value for key, value in rule if key not in {"items", "count", "pin"}}
        said = {key: value for key, value in said.items() if value is not None}
        pinned = {k: v for k, v in rule.pin or Pin() if v is not None}
        speaks = [*said, *(f"pin.{key}" for key in pinned)]
        return ItemRules(
            values={**self.values, **said},
            pin={**self.pin, **pinned},
            sources={**self.sources, **dict.fromkeys(speaks, source)},
        )

    def refuse(self, keys: Sequence[str], where: str) -> None:
        """Refuse rules that have no meaning somewhere."""
        for key in keys:
            source = next((v for k, v in self.sources.items() if k.split(".")[0] == key), None)
            if source is not None:
                raise source.error(f"{key} has no meaning in {where}; leave it out")

    @property
    def is_placed(self) -> bool:
        """Whether the copy has to lie at one point."""
        return "x" in self.pin and "y" in self.pin

    @property
    def is_put(self) -> bool:
        """Whether a rule says where the copy lies, be it roughly."""
        return "x" in self.pin or "y" in self.pin or "region" in self.values

    @property
    def rotation(self) -> Rotation | None:
        """Range in which the copy may turn; None if no rule says it."""
        text = self.values.get("rotate")
        if text is None:
            return None
        return Rotation.parse(text).of_words if self.is_read else Rotation.parse(text)

    @property
    def to_be_read(self) -> ItemRules:
        """The same of a word, which is never upside down."""
        return replace(self, is_read=True)


def rules_by_source(recipe: Recipe) -> list[tuple[RuleSource, Rule]]:
    """All rules of a recipe in the order in which they hold, the hero's last."""
    said = [
        (RuleSource("rules", f"rule {k}: "), rule) for k, rule in enumerate(recipe.rules, start=1)
    ]
    return said if recipe.hero is None else [*said, (RuleSource("hero"), hero_rule(recipe.hero))]


MOST_LISTED = 12
"""Names up to which all are listed where one is not known; of more, the nearest. Chosen."""


def matching(
    patterns: Sequence[str],
    source: RuleSource,
    names: Sequence[str],
    paths: Sequence[str] = (),
) -> list[int]:
    """Indices of the names that match one of the patterns; a pattern may be a path, too.

    ``paths``: of the items, as they were given. One that none of them has counts by its stem.

    Examples
    --------
    >>> matching(["b*"], RuleSource("force"), ["bear", "fox", "bee"])
    [0, 2]
    >>> matching(["b/fox.svg"], RuleSource("hero"), ["fox", "fox"], ["a/fox.svg", "./b/fox.svg"])
    [1]
    """
    found: set[int] = set()
    for pattern in patterns:
        hits = {k for k, name in enumerate(names) if fnmatchcase(name, pattern)}
        hits = hits or {k for k, path in enumerate(paths) if _is_path(path, pattern)}
        hits = hits or {k for k, name in enumerate(names) if name == _stem(pattern)}
        if not hits:
            hint = _names_like(_stem(pattern), sorted(set(names)))
            raise source.error(f"no item is called {pattern!r}; {hint}")
        found |= hits
    return sorted(found)


def _is_path(path: str, asked: str) -> bool:
    return bool(path) and os.path.abspath(path) == os.path.abspath(asked)  # noqa: PTH100 - no disk


def _stem(pattern: str) -> str:
    return PurePath(pattern).stem if PurePath(pattern).suffix else PurePath(pattern).name


def _names_like(asked: str, known: Sequence[str]) -> str:
    if near := meant(asked, known):
        return near
    there = ", ".join(known)
    if len(known) > MOST_LISTED:
        nearest = difflib.get_close_matches(asked, known, n=MOST_NAMED, cutoff=0.0)
        there = f"{len(known)}, the nearest {', '.join(nearest)}"
    return f"there are {there}: add it to the items, or name one of them"


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
    """
    shares = item_weights(items, recipe.weights, recipe) if areas is None else areas
    if total is None and isinstance(recipe.count, int):
        total = recipe.count
    said = rules_by_source(recipe)
    members_of = [_members(rule, source, items) for source, rule in said]
    counts: list[int | None] = [None] * len(items)
    for (source, rule), members in zip(said, members_of, strict=True):
        for k in members:
            if rule.count is not None:
                counts[k] = rule.count
            elif source.key == "hero" and counts[k] is None and len(items) > 1:
                # A hero stands alone if others can.
                counts[k] = 1
    which = turns(counts, total)
    asked = [ItemRules() for _ in which]
    taken: dict[int, RuleSource] = {}
    for (source, rule), members in zip(said, members_of, strict=True):
        for member in members:
            copies = [int(k) for k in np.flatnonzero(which == member)]
            if rule.is_for_one:
                copies = [_free_copy(copies, taken, items[member].name, source)]
                taken[copies[0]] = source
            for k in copies:
                asked[k] = asked[k].merged(rule, source)
    pairs = zip(asked, shares[which].tolist(), strict=True)
    weights = np.array([one.values.get("weight", weight) for one, weight in pairs])
    if float(weights.max()) / float(weights.min()) > WIDEST_WEIGHTS:
        raise RecipeError(
            "weights",
            f"the largest may be {WIDEST_WEIGHTS:g} times the smallest, "
            f"not {weights.max():g} to {weights.min():g}",
        )
    return Cast(tuple(items[k] for k in which), tuple(asked), weights)


def turns(counts: Sequence[int | None], total: int | None) -> IntArray:
    """Index of each copy's item: all in turn, again and again, until each has its count.

    Parameters
    ----------
    counts
        Copies of each item; None for as many as are left, shared evenly.
    total
        Copies in all; None for one of each that has no count of its own.

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
    """``(n,)`` share of area of each item, by its name or its file's; else its own."""
    if weights is None:
        return np.array([float(item.weight) for item in items])
    table = read_weights(weights, asked) if isinstance(weights, str) else weights
    names = {item.name for item in items}
    files = {Path(item.source).name for item in items}
    for name, weight in table.items():
        if name not in names | files:
            raise RecipeError(
                "weights", f"no item is called {name!r}; {_names_like(name, sorted(names))}"
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


def _members(rule: Rule, source: RuleSource, items: Sequence[Item]) -> list[int]:
    names, paths = [item.name for item in items], [item.source for item in items]
    members = matching(rule.items, source, names, paths)
    if source.key != "hero":
        return members
    if len({items[k].name for k in members}) > 1:
        several = ", ".join(items[k].name for k in members[:4])
        raise source.error(f"names {len(members)} items ({several} ...); name one")
    return members[:1]


def _free_copy(
    copies: Sequence[int], taken: Mapping[int, RuleSource], name: str, source: RuleSource
) -> int:
    """The first copy that has no place yet."""
    free = [k for k in copies if k not in taken]
    if free:
        return free[0]
    if not copies:
        raise source.error(f"pins {name}, of which there is no copy; count at least 1")
    others = " and ".join(sorted({(taken[k].place or taken[k].key).strip(" :") for k in copies}))
    amount = "the only copy" if len(copies) == 1 else f"all {len(copies)} copies"
    raise source.error(
        f"pins {name}, but {others} pins {amount} of it; count {len(copies) + 1} or more"
    )


def shared_out(
    items: Sequence[Item],
    weights: FloatArray,
    words: Collection[Item],
    share: Mapping[str, float],
) -> FloatArray:
    """``(n,)`` weights whose sums over words, photos and other items are in the shares asked.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([np.array([[0.0, 0], [1, 0], [1, 1]])])
    >>> items = [Item(name, name, ink, ink, FlatArt()) for name in ("fox", "star", "moon")]
    >>> shared_out(items, np.ones(3), items[:1], {"words": 3, "items": 1}).tolist()
    [0.75, 0.125, 0.125]
    """
    kinds = kinds_of(items, words)
    there, asked = set(kinds.tolist()), set(share)
    if there != asked:
        missing, idle = sorted(there - asked), sorted(asked - there)
        problem = f"says nothing of {missing[0]}" if missing else f"there are no {idle[0]} here"
        raise RecipeError("share", f"{problem}; give shares of {', '.join(sorted(there))}")
    total = sum(share.values())
    result = weights.copy()
    for name, part in share.items():
        own = kinds == name
        result[own] *= part / total / float(weights[own].sum())
    return result


def kinds_of(items: Sequence[Item], words: Collection[Item]) -> NDArray[np.str_]:
    """``(n,)`` what each item counts as: words, photos or items."""
    known = set(words)
    plain = ["photos" if isinstance(item.art, PhotoArt) else "items" for item in items]
    return np.where([item in known for item in items], "words", plain)

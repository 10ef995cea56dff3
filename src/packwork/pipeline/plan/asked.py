"""Options that rules set for each copy."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fnmatch import fnmatchcase
from typing import Any

from packwork.errors import RecipeError
from packwork.recipe import Recipe
from packwork.recipe.rules import Pin, Rotation, Rule, hero_rule


@dataclass(frozen=True)
class RuleSource:
    """Option of a recipe that asks for something, for messages."""

    key: str
    place: str = ""

    def error(self, problem: str) -> RecipeError:
        """Error about what this voice asked.

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
    voices
        Which option asked, by the same keys, those of the pin with ``pin.`` before them.
    is_central
        Whether it names those about it, and has to lie among them.
    """

    values: Mapping[str, Any] = field(default_factory=dict)
    pin: Mapping[str, Any] = field(default_factory=dict)
    voices: Mapping[str, RuleSource] = field(default_factory=dict)
    is_read: bool = False
    is_central: bool = False

    def heard(self, rule: Rule, voice: RuleSource) -> ItemRules:
        """The same after one more rule.

        Examples
        --------
        >>> first = ItemRules().heard(Rule(items="a", color="red", weight=2), RuleSource("rules"))
        >>> dict(first.heard(Rule(items="a", color="blue"), RuleSource("rules")).values)
        {'weight': 2.0, 'color': 'blue'}
        """
        said = {key: value for key, value in rule if key not in {"items", "count", "pin"}}
        said = {key: value for key, value in said.items() if value is not None}
        pinned = {k: v for k, v in rule.pin or Pin() if v is not None}
        speaks = [*said, *(f"pin.{key}" for key in pinned)]
        return ItemRules(
            values={**self.values, **said},
            pin={**self.pin, **pinned},
            voices={**self.voices, **dict.fromkeys(speaks, voice)},
        )

    def refuse(self, keys: Sequence[str], where: str) -> None:
        """Refuse rules that have no meaning somewhere.

        Raises
        ------
        RecipeError
            About the option that asked for one of the keys.
        """
        for key in keys:
            voice = next((v for k, v in self.voices.items() if k.split(".")[0] == key), None)
            if voice is not None:
                raise voice.error(f"{key} has no meaning in {where}; leave it out")

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


def voices(recipe: Recipe) -> list[tuple[RuleSource, Rule]]:
    """All rules of a recipe in the order in which they are heard, the hero's last."""
    said = [
        (RuleSource("rules", f"rule {k}: "), rule) for k, rule in enumerate(recipe.rules, start=1)
    ]
    return said if recipe.hero is None else [*said, (RuleSource("hero"), hero_rule(recipe.hero))]


def named(rule: Rule, voice: RuleSource, names: Sequence[str]) -> list[int]:
    """Indices of the items that a rule names.

    Raises
    ------
    RecipeError
        If one of its patterns names none.

    Examples
    --------
    >>> named(Rule(items=["b*", "fox"]), RuleSource("rules"), ["bear", "fox", "owl", "bee"])
    [0, 1, 3]
    """
    return matching(rule.items, voice, names)


def matching(patterns: Sequence[str], voice: RuleSource, names: Sequence[str]) -> list[int]:
    """Indices of the names that match one of the patterns.

    Raises
    ------
    RecipeError
        If a pattern matches none.

    Examples
    --------
    >>> matching(["b*"], RuleSource("force"), ["bear", "fox", "bee"])
    [0, 2]
    """
    found: set[int] = set()
    for pattern in patterns:
        hits = {k for k, name in enumerate(names) if fnmatchcase(name, pattern)}
        if not hits:
            raise voice.error(f"no item is called {pattern!r}; {_there_are(pattern, names)}")
        found |= hits
    return sorted(found)


def _there_are(name: str, names: Sequence[str]) -> str:
    known = sorted(set(names))
    close = difflib.get_close_matches(name, known, n=1)
    return f"did you mean {close[0]}?" if close else f"there are {', '.join(known[:12])}"

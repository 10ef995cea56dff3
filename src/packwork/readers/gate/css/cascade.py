"""CSS cascade: declarations that apply to an element, from style sheets and ``style``."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import TypeAlias, final

from packwork.readers.account import spend
from packwork.readers.gate.css.declarations import Declarations
from packwork.readers.gate.css.nodes import Node
from packwork.readers.gate.css.selectors import TOO_MANY, Compound
from packwork.readers.gate.css.sheets import StyleRule

_COMPARISON_NS, _MERGE_NS = 4e3, 5e2
"""For a step of a rule that is held against an element, and a declaration that is laid over
others. Measured."""

_Signature: TypeAlias = tuple[str, str | None, frozenset[str]]

_Layers: TypeAlias = tuple[Mapping[str, str], Mapping[str, str]]
"""Plain and important values by property."""


@final
class Cascade:
    """Rules of a document, found quickly by what their first step asks for.

    Examples
    --------
    >>> import xml.etree.ElementTree as ET
    >>> from packwork.readers.gate.css.declarations import parse_declarations
    >>> from packwork.readers.gate.css.sheets import StyleSheet
    >>> sheet = StyleSheet(); sheet.add(".a {fill:blue; stroke:none}")
    >>> path = ET.Element("path", {"class": "a", "style": "stroke:red"})
    >>> Cascade(sheet.rules).declared(Node(path, None, None), parse_declarations("stroke:red"))
    {'fill': 'blue', 'stroke': 'red'}
    """

    def __init__(self, rules: list[StyleRule]) -> None:
        self._by_key: dict[str, list[StyleRule]] = defaultdict(list)
        for rule in rules:
            self._by_key[_key(rule.selector.steps[0])].append(rule)
        self._plain: dict[_Signature, tuple[list[StyleRule], list[StyleRule]]] = {}
        self._merged: dict[tuple[_Signature, tuple[int, ...]], _Layers] = {}

    def declared(self, node: Node, inline: Declarations) -> dict[str, str]:
        """Properties that rules and the ``style`` attribute set on an element.

        Raises
        ------
        TooRichError
            If the document as a whole asks for too many comparisons.
        """
        plain, important = self._of_rules(node) if self._by_key else ({}, {})
        values = {**plain}
        values |= {name: text for name, (text, mark) in inline.values.items() if not mark}
        values |= important
        return values | {name: text for name, (text, mark) in inline.values.items() if mark}

    def _of_rules(self, node: Node) -> _Layers:
        signature = (node.tag, node.attributes.get("id"), node.classes)
        sure, open_ones = self._candidates(node, signature)
        spend(_COMPARISON_NS * sum(len(r.selector.steps) for r in open_ones), TOO_MANY)
        met = [rule for rule in open_ones if rule.selector.matches(node)]
        key = (signature, tuple(rule.order for rule in met))
        if key not in self._merged:
            rules = sorted([*sure, *met], key=_rank)
            spend(_MERGE_NS * sum(len(rule.declarations.values) for rule in rules), TOO_MANY)
            self._merged[key] = _layers(rules)
        return self._merged[key]

    def _candidates(
        self, node: Node, signature: _Signature
    ) -> tuple[list[StyleRule], list[StyleRule]]:
        """Rules that are met for sure, and those that depend on the place."""
        if signature not in self._plain:
            keys = ["*", node.tag, f"#{signature[1]}", *(f".{c}" for c in sorted(node.classes))]
            found = [rule for key in keys for rule in self._by_key.get(key, [])]
            spend(_COMPARISON_NS * len(found), TOO_MANY)
            sure = [
                rule for rule in found if rule.selector.is_plain and rule.selector.matches(node)
            ]
            open_ones = [rule for rule in found if not rule.selector.is_plain]
            self._plain[signature] = (sure, open_ones)
        return self._plain[signature]


def _rank(rule: StyleRule) -> tuple[tuple[int, int, int], int]:
    return rule.specificity, rule.order


def _layers(rules: list[StyleRule]) -> _Layers:
    plain: dict[str, str] = {}
    important: dict[str, str] = {}
    for rule in rules:
        for name, (value, mark) in rule.declarations.values.items():
            (important if mark else plain)[name] = value
    return plain, important


def _key(step: Compound) -> str:
    if step.ids:
        return f"#{min(step.ids)}"
    if step.classes:
        return f".{min(step.classes)}"
    return step.tag or "*"

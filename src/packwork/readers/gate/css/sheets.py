"""CSS style sheets to rules, and the cascade that applies them to an element.

``@media`` counts as a screen of the drawing's own size, in daylight, shows it; ``@supports``
and ``@layer`` as if they were not there. Other blocks with an ``@`` are left out.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias, final

from packwork.readers.gate.css.declarations import COMMENT, Declarations, parse_declarations
from packwork.readers.gate.css.selectors import (
    TOO_MANY,
    Compound,
    Node,
    Selector,
    UnknownSelectorError,
    parse_selector,
    split_outside,
)
from packwork.readers.reading import SHAPES_NS, UnfitError, spend
from packwork.readers.svg_syntax.coordinates import parse_length

MAX_BLOCKS = 8
"""Blocks inside one another. Chosen."""

_RULE_NS = 2e5
"""For reading a selector with its declarations. Measured."""

MAX_RULES = int(2 * SHAPES_NS / _RULE_NS)
"""Style rules of one drawing, however large its budget is."""

_MARK = re.compile(r"[{};]")
_FEATURE = re.compile(r"\(\s*([\w-]+)\s*(?::\s*([^()]+?)\s*)?\)")
_OPEN = frozenset({"supports", "layer"})
_SILENT = frozenset({"charset", "namespace", "page", "import"})
_TRUE_FEATURES = {"prefers-color-scheme": "light", "orientation": "", "scripting": "none"}
_SAID = {
    "font-face": "fonts that it brings along",
    "keyframes": "its animation",
    "container": "rules for containers of some size",
}


@dataclass(frozen=True, eq=False)
class StyleRule:
    """Selector and declarations, and where it stands in the document."""

    selector: Selector
    declarations: Declarations
    order: int

    @cached_property
    def specificity(self) -> tuple[int, int, int]:
        """As CSS orders rules."""
        return self.selector.specificity


@dataclass
class StyleSheet:
    """All rules of a drawing, whose size is for media queries; None if it states none.

    >>> sheet = StyleSheet()
    >>> sheet.add("@import 'x'; path, g > .a {fill:red} @media print {g {fill:none}}")
    >>> [rule.specificity for rule in sheet.rules], sheet.lost
    ([(0, 0, 1), (0, 1, 1)], {'other style sheets'})
    """

    width: float | None = None
    height: float | None = None
    rules: list[StyleRule] = field(default_factory=list)
    lost: set[str] = field(default_factory=set)

    def add(self, text: str) -> None:
        """Add the rules of one ``<style>``."""
        plain = COMMENT.sub(" ", text)
        if re.search(r"@import\b", plain):
            self.lost.add("other style sheets")
        self._add(plain, "", 0)

    def _add(self, text: str, above: str, depth: int) -> None:
        for prelude, block in _blocks(text):
            if "\\" in prelude or depth > MAX_BLOCKS:
                self.lost.add("style rules with escapes")
            elif prelude.startswith("@"):
                self._add_group(prelude, block, above, depth)
            else:
                self._add_rule(_nested(prelude, above), block, depth)

    def _add_group(self, prelude: str, block: str, above: str, depth: int) -> None:
        name, _, words = prelude[1:].partition(" ")
        name = re.split(r"[\s(]", name.lower().removeprefix("-webkit-"))[0]
        if name == "media":
            if any(map(self._is_met, words.lower().split(","))):
                self._add_inside(block, above, depth)
        elif name in _OPEN:
            if not words.strip().lower().startswith("not"):
                self._add_inside(block, above, depth)
        elif name not in _SILENT:
            self.lost.add(_SAID.get(name, f"style rules in @{name[:20]}"))

    def _add_inside(self, block: str, above: str, depth: int) -> None:
        if above:
            self._add_rule(above, block, depth)
        else:
            self._add(block, "", depth + 1)

    def _add_rule(self, prelude: str, block: str, depth: int) -> None:
        own, inner = (block, "") if "{" not in block else _parted(block)
        declarations = parse_declarations(own)
        self.lost |= declarations.lost
        # Counted before they are parted: a list of a million selectors is one block.
        if len(self.rules) + prelude.count(",") >= MAX_RULES:
            raise UnfitError(f"has more than {MAX_RULES:,} style rules; save it as plain SVG")
        for text in split_outside(prelude, ","):
            spend(_RULE_NS, "has too many style rules")
            try:
                selector = parse_selector(text)
            except UnknownSelectorError as unknown:
                self.lost.add(f"style rules for {unknown}")
                continue
            if declarations.values:
                self.rules.append(StyleRule(selector, declarations, len(self.rules)))
        if inner:
            self._add(inner, prelude, depth + 1)

    def _is_met(self, query: str) -> bool:
        words = query.split("(")[0].split()
        is_negated = "not" in words
        kinds = [w for w in words if w not in {"not", "only", "and"}]
        is_met = all(kind in {"all", "screen"} for kind in kinds)
        is_met = is_met and all(self._has(*found) for found in _FEATURE.findall(query))
        return is_met != is_negated

    def _has(self, name: str, value: str) -> bool:
        bound, _, side = name.partition("-")
        if bound in {"min", "max"} and side in {"width", "height"}:
            length = parse_length(value, 0.0)
            stated = self.width if side == "width" else self.height
            if length is None or stated is None:
                return stated is None and bound == "min"
            return stated >= length if bound == "min" else stated <= length
        return name in _TRUE_FEATURES and _TRUE_FEATURES[name] in value


def _nested(prelude: str, above: str) -> str:
    """Selectors of a block inside another one."""
    if not above:
        return prelude
    outer = f":is({above})"
    return ",".join(
        part.replace("&", outer) if "&" in part else f"{outer} {part.strip()}"
        for part in split_outside(prelude, ",")
    )


def _parted(block: str) -> tuple[str, str]:
    """Declarations of a block, and the blocks inside it."""
    own, place = [], 0
    for begin, end in _spans(block):
        head = block[place:begin]
        own.append(head[: head.rfind(";") + 1])
        place = end
    own.append(block[place:])
    return " ".join(own), block


def _blocks(text: str) -> Iterator[tuple[str, str]]:
    """Preludes and bodies of the outermost blocks."""
    place = 0
    for begin, end in _spans(text):
        prelude = text[place:begin]
        yield prelude[prelude.rfind(";") + 1 :].strip(), text[begin + 1 : end - 1]
        place = end


def _spans(text: str) -> Iterator[tuple[int, int]]:
    """Places at which each outermost block opens and ends."""
    opening, depth = 0, 0
    for match in _MARK.finditer(text):
        mark = match.group()
        if mark == "{":
            opening = match.start() if depth == 0 else opening
            depth += 1
        elif mark == "}" and depth > 0:
            depth -= 1
            if depth == 0:
                yield opening, match.end()


_COMPARISON_NS, _MERGE_NS = 4e3, 5e2
"""For a step of a rule that is held against an element, and a declaration that is laid over
others. Measured."""

_Signature: TypeAlias = tuple[str, str | None, frozenset[str]]

_Layers: TypeAlias = tuple[Mapping[str, str], Mapping[str, str]]
"""Plain and important values by property."""


@final
class Cascade:
    """Rules of a document, found quickly by what their first step asks for.

    >>> import xml.etree.ElementTree as ET
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
        """Properties that rules and the ``style`` attribute set on an element."""
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

"""CSS style sheets to rules: blocks, nested blocks, media queries.

``@media`` counts as a screen of the drawing's own size, in daylight, shows it; ``@supports``
and ``@layer`` as if they were not there. Other blocks with an ``@`` are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

from packwork.readers.account import spend
from packwork.readers.gate.css.declarations import COMMENT, Declarations, parse_declarations
from packwork.readers.gate.css.selectors import (
    Selector,
    UnknownSelectorError,
    parse_selector,
    split_outside,
)
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.unfit import UnfitError

MAX_RULES = 20_000
"""Style rules of one drawing. Chosen."""

MAX_BLOCKS = 8
"""Blocks inside one another. Chosen."""

_RULE_NS = 2e5
"""For reading a selector with its declarations. Measured."""

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
    """All rules of a drawing.

    Parameters
    ----------
    width, height
        Of the drawing, for media queries; None if it states none.

    Examples
    --------
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
        """Add the rules of one ``<style>``.

        Raises
        ------
        UnfitError
            If there are too many of them.
        """
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
            if self._is_met(words):
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
        return any(self._is_met_once(part) for part in query.lower().split(","))

    def _is_met_once(self, query: str) -> bool:
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
    """Where each outermost block opens and ends."""
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

"""Style sheets to plain declarations on the elements they match.

Only what drawing programs write is understood: type, class, id and universal selectors,
compound, nested (space) and child (``>``) ones. Rules with anything else (media queries,
imports, font faces, pseudo-classes, attribute selectors) are passed over as a whole, so
that everyone downstream sees one and the same, simple document.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from packwork.readers.gate.vocabulary import PROPERTIES
from packwork.readers.unfit import UnfitError

MAX_STEPS = 20
"""Words of a selector; longer ones are passed over. Chosen."""

MAX_RULES = 20_000
"""Style rules of one drawing. Chosen."""

MAX_MATCHES = 300_000
"""Pairs of an element and a rule that are compared. Chosen: a second's work."""

_COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)|<!--|-->", re.DOTALL)
_IMPORTANT = re.compile(r"!\s*important\s*$", re.IGNORECASE)
_COMPOUND = re.compile(r"(?:\*|[\w-]+)?(?:[.#][\w-]+)*")
_MARK = re.compile(r"[{};]")
_PART = re.compile(r"([.#]?)([\w-]+)")


@dataclass(frozen=True)
class Compound:
    """One step of a selector: what a single element has to be."""

    tag: str | None
    ids: frozenset[str]
    classes: frozenset[str]

    def matches(self, element: ET.Element) -> bool:
        """Whether the element has the tag, the ids and the classes asked for."""
        if self.tag is not None and self.tag != element.tag:
            return False
        if not self.ids <= {element.get("id")}:
            return False
        return not self.classes or self.classes <= set(element.get("class", "").split())


@dataclass(frozen=True)
class Rule:
    """Selector and declarations; steps run from the element outwards."""

    steps: tuple[Compound, ...]
    is_child: tuple[bool, ...]
    declarations: Mapping[str, tuple[str, bool]]

    @property
    def specificity(self) -> tuple[int, int, int]:
        """Counts of ids, classes and types, as CSS orders rules."""
        return (
            sum(len(s.ids) for s in self.steps),
            sum(len(s.classes) for s in self.steps),
            sum(s.tag is not None for s in self.steps),
        )

    def matches(self, element: ET.Element, ancestors: list[ET.Element]) -> bool:
        """Whether the element, inside ``ancestors`` (outermost first), is meant."""
        if not self.steps[0].matches(element):
            return False
        place = len(ancestors)
        for step, is_child in zip(self.steps[1:], self.is_child, strict=True):
            lowest = place - 1 if is_child else 0
            place = next(
                (k for k in range(place - 1, lowest - 1, -1) if step.matches(ancestors[k])), -1
            )
            if place < 0:
                return False
        return True


def parse_declarations(text: str) -> dict[str, tuple[str, bool]]:
    """Values by known property, each with whether it is marked important.

    Examples
    --------
    >>> parse_declarations("fill: red; stroke:none !important; oops")
    {'fill': ('red', False), 'stroke': ('none', True)}
    """
    found: dict[str, tuple[str, bool]] = {}
    for declaration in _COMMENT.sub(" ", text).split(";"):
        name, _, value = (part.strip() for part in declaration.partition(":"))
        if value and name.lower() in PROPERTIES:
            found[name.lower()] = (
                _IMPORTANT.sub("", value).strip(),
                bool(_IMPORTANT.search(value)),
            )
    return found


def parse_rules(sheet: str) -> list[Rule]:
    """Rules of a style sheet in order, one for each selector that is understood.

    Examples
    --------
    >>> [r.specificity for r in parse_rules("@import 'x'; path, g > .a {fill:red}")]
    [(0, 0, 1), (0, 1, 1)]
    """
    rules: list[Rule] = []
    for prelude, block in _blocks(_COMMENT.sub(" ", sheet)):
        declarations = parse_declarations(block)
        # Counted before they are parted: a list of a million selectors is one block.
        if len(rules) + prelude.count(",") >= MAX_RULES:
            raise UnfitError(f"has more than {MAX_RULES:,} style rules; save it as plain SVG")
        for selector in prelude.split(","):
            steps = _parse_selector(selector)
            if steps is not None:
                rules.append(Rule(*steps, declarations))
    return rules


def _blocks(sheet: str) -> Iterator[tuple[str, str]]:
    """Preludes and bodies of the plain rules; rules that start with ``@`` are left out."""
    prelude, opening, place, depth = "", 0, 0, 0
    for match in _MARK.finditer(sheet):
        mark, at = match.group(), match.start()
        if mark == "{":
            if depth == 0:
                prelude, opening = sheet[place:at].strip(), at + 1
            depth += 1
        elif mark == "}" and depth > 0:
            depth -= 1
            if depth == 0 and not prelude.startswith("@") and "\\" not in prelude:
                yield prelude, sheet[opening:at]
        if depth == 0:
            place = at + 1


def _parse_selector(text: str) -> tuple[tuple[Compound, ...], tuple[bool, ...]] | None:
    """Steps from the element outwards and whether each next one is the parent."""
    words = text.replace(">", " > ").split()
    if len(words) > MAX_STEPS:
        return None
    steps: list[Compound] = []
    is_child: list[bool] = []
    wants_step = True
    for word in reversed(words):
        if word == ">" and not wants_step:
            is_child[-1:] = [True]
            wants_step = True
        elif word != ">" and _COMPOUND.fullmatch(word):
            steps.append(_parse_compound(word))
            is_child.append(False)
            wants_step = False
        else:
            return None
    return (tuple(steps), tuple(is_child[:-1])) if steps and not wants_step else None


def _parse_compound(word: str) -> Compound:
    parts = _PART.findall(word)
    tags = [name for mark, name in parts if not mark]
    return Compound(
        tags[0] if tags else None,
        frozenset(name for mark, name in parts if mark == "#"),
        frozenset(name for mark, name in parts if mark == "."),
    )


@dataclass
class Cascade:
    """Rules of a document, found quickly by what their first step asks for.

    Examples
    --------
    >>> path = ET.Element("path", {"class": "a", "style": "stroke:red"})
    >>> Cascade.of(parse_rules(".a {fill:blue; stroke:none}")).declared(path, [])
    {'fill': 'blue', 'stroke': 'red'}
    """

    _by_key: dict[str, list[tuple[int, Rule]]] = field(default_factory=lambda: defaultdict(list))
    _comparisons: int = 0

    @classmethod
    def of(cls, rules: list[Rule]) -> Cascade:
        """Cascade of rules in the order of the document."""
        cascade = cls()
        for order, rule in enumerate(rules):
            cascade._by_key[_key(rule.steps[0])].append((order, rule))
        return cascade

    def declared(self, element: ET.Element, ancestors: list[ET.Element]) -> dict[str, str]:
        """Properties that rules and the ``style`` attribute set on the element.

        Raises
        ------
        UnfitError
            If the document as a whole asks for too many comparisons.
        """
        entries = [
            (important, False, rule.specificity, order, name, value)
            for order, rule in self._candidates(element)
            if rule.matches(element, ancestors)
            for name, (value, important) in rule.declarations.items()
        ]
        inline = parse_declarations(element.get("style", ""))
        entries += [(mark, True, (0, 0, 0), 0, name, text) for name, (text, mark) in inline.items()]
        return {entry[4]: entry[5] for entry in sorted(entries)}

    def _candidates(self, element: ET.Element) -> list[tuple[int, Rule]]:
        classes = set(element.get("class", "").split())
        keys = ["*", str(element.tag), f"#{element.get('id')}", *(f".{c}" for c in sorted(classes))]
        found = [entry for key in keys for entry in self._by_key.get(key, [])]
        self._comparisons += sum(1 + len(rule.is_child) for _, rule in found)
        if self._comparisons > MAX_MATCHES:
            raise UnfitError("has too many style rules for its elements; save it as plain SVG")
        return found


def _key(step: Compound) -> str:
    if step.ids:
        return f"#{min(step.ids)}"
    if step.classes:
        return f".{min(step.classes)}"
    return step.tag or "*"

"""CSS selectors: parsing, specificity and matching of elements.

Types, classes, ids, attributes, the four combinators, ``:not``, ``:is``, ``:where`` and the
pseudo-classes of an element's place among its siblings. What depends on a reader's mouse or
history matches nothing; of what is not known the rule is left out as a whole.
"""

from __future__ import annotations

import functools
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias, final

from packwork.readers.reading import spend


@final
class Node:
    """One element of the file, before anything was taken out, with its nearest elder sibling.

    >>> root = Node(ET.fromstring('<svg><g/><path class="a b"/><g/></svg>'), None, None)
    >>> path = root.children[1]
    >>> path.tag, sorted(path.classes), path.place(True, False), root.children[2].place(False, True)
    ('path', ['a', 'b'], 2, 2)
    """

    def __init__(self, element: ET.Element, parent: Node | None, before: Node | None) -> None:
        self.element = element
        self.parent = parent
        self.before = before
        self.tag = str(element.tag).rpartition("}")[2]
        self._places: dict[tuple[bool, bool], dict[Node, int]] = {}

    @cached_property
    def attributes(self) -> Mapping[str, str]:
        """Attributes by their names without namespaces."""
        return {key.rpartition("}")[2]: value for key, value in self.element.attrib.items()}

    @cached_property
    def classes(self) -> frozenset[str]:
        """Words of ``class``."""
        return frozenset(self.element.get("class", "").split())

    @cached_property
    def children(self) -> list[Node]:
        """Elements inside, in order."""
        nodes: list[Node] = []
        for child in self.element:
            nodes.append(Node(child, self, nodes[-1] if nodes else None))
        return nodes

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing in it."""
        return len(self.element) == 0 and not self.element.text

    def place(self, from_end: bool, of_type: bool) -> int:
        """Number among its siblings, from 1, from the end or of its own tag."""
        return 1 if self.parent is None else self.parent._numbers(from_end, of_type)[self]

    def _numbers(self, from_end: bool, of_type: bool) -> dict[Node, int]:
        """Numbers of all children, counted once."""
        if (from_end, of_type) not in self._places:
            counts: dict[str, int] = {}
            numbers: dict[Node, int] = {}
            for child in reversed(self.children) if from_end else self.children:
                kind = child.tag if of_type else ""
                counts[kind] = counts.get(kind, 0) + 1
                numbers[child] = counts[kind]
            self._places[from_end, of_type] = numbers
        return self._places[from_end, of_type]


_WALK_NS = 1e2
"""For a step from an element to the one before or above. Measured."""

TOO_MANY = "has too many style rules for its elements"
"""What is said where comparisons pass the account."""

MAX_STEPS = 20
"""Compounds of a selector; longer ones are left out. Chosen."""

MAX_NESTED = 4
"""Selectors inside one another, as in ``:not(:is(a))``. Chosen."""

Test: TypeAlias = Callable[[Node], bool]
"""Whether a single element is what one condition asks for."""

_IDENT = r"-?(?:[A-Za-z_\u0080-\U0010ffff]|--)[\w\u0080-\U0010ffff-]*+"
_TOKEN = (
    rf"(?P<combinator>\s*[>+~]\s*|\s+)|(?P<all>\*)|(?P<tag>{_IDENT})|[#](?P<id>[\w-]+)"
    rf"|\.(?P<class>{_IDENT})|\[(?P<attribute>[^\[\]]*)\]|::?(?P<pseudo>[\w-]+)(?P<call>\()?"
)
_ATTRIBUTE = re.compile(
    r"\s*(?:[\w-]*\|)?([\w:-]+)\s*(?:([~|^$*]?=)\s*(?:\"([^\"]*)\"|'([^']*)'|([^\s\"']+))"
    r"\s*([iIsS])?\s*)?"
)
_NTH = re.compile(r"\s*([-+]?\d*)n\s*([-+]\s*\d+)?\s*|\s*([-+]?\d+)\s*", re.IGNORECASE)
_NEVER = frozenset(
    {"hover", "active", "focus", "focus-visible", "focus-within", "visited", "target"}
    | {"checked", "disabled", "fullscreen"}
)
_GROUPS = frozenset({"not", "is", "where", "matches", "-webkit-any", "-moz-any"})
_PLACES: dict[str, Test] = {
    "root": lambda node: node.parent is None,
    "first-child": lambda node: node.place(False, False) == 1,
    "last-child": lambda node: node.place(True, False) == 1,
    "only-child": lambda node: node.place(False, False) == node.place(True, False) == 1,
    "first-of-type": lambda node: node.place(False, True) == 1,
    "last-of-type": lambda node: node.place(True, True) == 1,
    "only-of-type": lambda node: node.place(False, True) == node.place(True, True) == 1,
    "empty": lambda node: node.is_empty,
    "link": lambda node: node.tag == "a",
    "any-link": lambda node: node.tag == "a",
    "enabled": lambda node: False,
}
_COUNTS = {
    "nth-child": (False, False),
    "nth-last-child": (True, False),
    "nth-of-type": (False, True),
    "nth-last-of-type": (True, True),
}


@functools.cache
def _token() -> re.Pattern[str]:
    """Compiled when it is first needed: that takes ten milliseconds, and few drawings do."""
    return re.compile(_TOKEN)


class UnknownSelectorError(Exception):
    """A part of a selector that is not known here."""


@dataclass(eq=False)
class Compound:
    """One step of a selector: what a single element has to be.

    ``weight`` is its specificity, as ids, classes and types.
    """

    tag: str | None = None
    ids: set[str] = field(default_factory=set)
    classes: set[str] = field(default_factory=set)
    tests: list[Test] = field(default_factory=list)
    weight: tuple[int, int, int] = (0, 0, 0)

    @property
    def is_plain(self) -> bool:
        """Whether type, id and classes tell all."""
        return not self.tests

    def matches(self, node: Node) -> bool:
        """Whether the element is all that is asked for."""
        if self.tag is not None and self.tag != node.tag:
            return False
        if not self.ids <= {node.attributes.get("id")} or not self.classes <= node.classes:
            return False
        return all(test(node) for test in self.tests)

    def add(self, ids: int, classes: int, types: int) -> None:
        """Make it more specific."""
        self.weight = (self.weight[0] + ids, self.weight[1] + classes, self.weight[2] + types)


@dataclass(frozen=True, eq=False)
class Selector:
    """Steps of a selector, the element's own first.

    ``relations`` are those of the second step on to the one before: a space, ``>``, ``+`` or ``~``.
    """

    steps: tuple[Compound, ...]
    relations: tuple[str, ...]

    @property
    def specificity(self) -> tuple[int, int, int]:
        """Counts of ids, classes and types, as CSS orders rules."""
        ids, classes, types = (sum(step.weight[k] for step in self.steps) for k in range(3))
        return ids, classes, types

    @property
    def is_plain(self) -> bool:
        """Whether an element's type, id and classes tell all."""
        return len(self.steps) == 1 and self.steps[0].is_plain

    def matches(self, node: Node) -> bool:
        """Whether the element, where it stands, is meant.

        Greedy: of several ancestors that fit the nearest is taken, which is wrong only for
        a ``>`` or ``+`` above it that another one would satisfy.
        """
        if not self.steps[0].matches(node):
            return False
        at: Node | None = node
        for step, relation in zip(self.steps[1:], self.relations, strict=True):
            at = _related(at, relation, step)
            if at is None:
                return False
        return True


def _related(node: Node | None, relation: str, step: Compound) -> Node | None:
    """Nearest element in that relation that the step means."""
    is_beside, is_next = relation in "+~", relation in ">+"
    walked, is_met, tag = 0, False, step.tag
    while node is not None and not is_met and not (is_next and walked):
        node, walked = node.before if is_beside else node.parent, walked + 1
        # Most are of another tag, and a call for each would take as long as all the rest.
        is_met = node is not None and (tag is None or tag == node.tag) and step.matches(node)
    spend(_WALK_NS * walked, TOO_MANY)
    return node if is_met else None


def parse_selector(text: str, depth: int = 0) -> Selector:
    """Selector without commas.

    >>> selector = parse_selector("g > path.a:not([fill])")
    >>> selector.specificity, selector.relations
    ((0, 2, 2), ('>',))
    """
    steps: list[Compound] = [Compound()]
    relations: list[str] = []
    place, text, is_started = 0, text.strip(), False
    while place < len(text):
        token = _token().match(text, place)
        if token is None or len(steps) > MAX_STEPS or depth > MAX_NESTED:
            raise UnknownSelectorError(text[:40])
        place = token.end()
        if token["combinator"] is not None:
            if not is_started:
                raise UnknownSelectorError(text[:40])
            relations.append(token["combinator"].strip() or " ")
            steps.append(Compound())
            is_started = False
            continue
        is_started = True
        if token["call"]:
            inside, place = inside_brackets(text, place)
            _call(steps[-1], token["pseudo"].lower(), inside, depth)
        else:
            _condition(steps[-1], token)
    if not is_started:
        raise UnknownSelectorError(text[:40])
    return Selector(tuple(steps[::-1]), tuple(relations[::-1]))


def split_outside(text: str, mark: str) -> list[str]:
    """Parts of a text between marks that stand in no brackets and no quotes.

    >>> split_outside("a, :is(b, c), [d=',']", ",")
    ['a', ' :is(b, c)', " [d=',']"]
    """
    parts, depth, begin, quote = [], 0, 0, ""
    for k, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter in "([":
            depth += 1
        elif letter in ")]":
            depth -= 1
        elif letter == mark and depth == 0:
            parts.append(text[begin:k])
            begin = k + 1
    return [*parts, text[begin:]]


def inside_brackets(text: str, place: int) -> tuple[str, int]:
    """Text between brackets, the first of which has been passed."""
    depth = 1
    for k in range(place, len(text)):
        depth += (text[k] == "(") - (text[k] == ")")
        if depth == 0:
            return text[place:k], k + 1
    raise UnknownSelectorError(text[:40])


def _condition(step: Compound, token: re.Match[str]) -> None:
    if token["tag"] is not None:
        step.tag = token["tag"]
        step.add(0, 0, 1)
    elif token["id"] is not None:
        step.ids.add(token["id"])
        step.add(1, 0, 0)
    elif token["class"] is not None:
        step.classes.add(token["class"])
        step.add(0, 1, 0)
    elif token["attribute"] is not None:
        step.tests.append(_attribute_test(token["attribute"]))
        step.add(0, 1, 0)
    elif token["pseudo"] is not None:
        name = token["pseudo"].lower()
        if name not in _PLACES and name not in _NEVER:
            raise UnknownSelectorError(f":{name}")
        step.tests.append(_PLACES.get(name, lambda node: False))
        step.add(0, 1, 0)


def _call(step: Compound, name: str, inside: str, depth: int) -> None:
    if name in _GROUPS:
        choices = [parse_selector(part, depth + 1) for part in split_outside(inside, ",")]
        is_wanted = name != "not"
        step.tests.append(lambda node: any(c.matches(node) for c in choices) == is_wanted)
        if name != "where":
            step.add(*max(choice.specificity for choice in choices))
        return
    nth = _NTH.fullmatch(inside.lower().replace("odd", "2n+1").replace("even", "2n"))
    if name not in _COUNTS or nth is None:
        raise UnknownSelectorError(f":{name}")
    step.tests.append(_nth_test(nth, *_COUNTS[name]))
    step.add(0, 1, 0)


def _nth_test(nth: re.Match[str], from_end: bool, of_type: bool) -> Test:
    if nth[3] is not None:
        every, first = 0, int(nth[3])
    else:
        every = int(nth[1] + "1") if nth[1] in {"", "+", "-"} else int(nth[1])
        first = int((nth[2] or "0").replace(" ", ""))

    def is_meant(node: Node) -> bool:
        ahead = node.place(from_end, of_type) - first
        return ahead == 0 if every == 0 else ahead % every == 0 and ahead // every >= 0

    return is_meant


def _attribute_test(text: str) -> Test:
    match = _ATTRIBUTE.fullmatch(text)
    if match is None:
        raise UnknownSelectorError(f"[{text[:40]}]")
    name = match[1].rpartition(":")[2]
    if match[2] is None:
        return lambda node: name in node.attributes
    sought = next((part for part in match.groups()[2:5] if part is not None), "")
    fold = str.lower if (match[6] or "").lower() == "i" else str
    return _COMPARED[match[2]](name, fold(sought), fold)


def _met(node: Node, name: str, fold: Callable[[str], str]) -> str:
    return fold(node.attributes.get(name, ""))


_Fold: TypeAlias = Callable[[str], str]
_COMPARED: dict[str, Callable[[str, str, _Fold], Test]] = {
    "=": lambda name, text, fold: lambda n: name in n.attributes and _met(n, name, fold) == text,
    "~=": lambda name, text, fold: lambda n: text in _met(n, name, fold).split(),
    "|=": lambda name, text, fold: (
        lambda n: _met(n, name, fold) == text or _met(n, name, fold).startswith(f"{text}-")
    ),
    "^=": lambda name, text, fold: lambda n: bool(text) and _met(n, name, fold).startswith(text),
    "$=": lambda name, text, fold: lambda n: bool(text) and _met(n, name, fold).endswith(text),
    "*=": lambda name, text, fold: lambda n: bool(text) and text in _met(n, name, fold),
}

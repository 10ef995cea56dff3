"""Elements as CSS selectors match them: tag, classes, and position among all siblings."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from functools import cached_property
from typing import final


@final
class Node:
    """One element of the file, before anything was taken out.

    Parameters
    ----------
    element
        As parsed, names with their namespaces.
    parent
        None of the root.
    before
        Its nearest elder sibling.

    Examples
    --------
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
        """Number among its siblings, from 1.

        Parameters
        ----------
        from_end
            Whether the last one is the first.
        of_type
            Whether only those of its own tag count.
        """
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

"""Names, links and tooltips of items as SVG says them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from packwork.scene.item import Item, Label
from packwork.scene.notation import attributes, sound_text, xml_text

ID_LENGTH = 60
"""Characters of a name that an id keeps. Chosen."""

_NOT_IN_IDS = re.compile(r"[^\w]+")
_OURS = re.compile(
    r"(item|shape)-\d+(-\d+)?|items|container|background|labels|legend|leaving(-\d+)?|p[0-9a-f]{10}-.*"
)
"""Ids that a document of ours may hold anyway, those of drawings among them."""


def item_ids(items: Sequence[Item]) -> list[str]:
    """One id per item, all unlike: ``item-3`` by its number, or made of a name of its own.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> plain = Item("star", "", ink, ink, FlatArt())
    >>> ours = Item("star", "", ink, ink, FlatArt(), Label(name="R & D"))
    >>> item_ids([plain, ours, ours])
    ['item-1', 'R-D', 'R-D-2']
    """
    taken: set[str] = set()
    found = []
    for number, item in enumerate(items, start=1):
        base = _as_id(item.label.name)
        choice = f"item-{number}" if not base else _free(base, taken)
        taken.add(choice)
        found.append(choice)
    return found


def labelled(drawn: str, label: Label) -> str:
    """An item's element with its tooltip, inside its link; as it is if it has neither.

    Examples
    --------
    >>> labelled("<use/>", Label(link="a.html?x=1&y=2", title="1 < 2"))
    '<a href="a.html?x=1&amp;y=2"><title>1 &lt; 2</title><use/></a>'
    """
    title = f"<title>{xml_text(label.title)}</title>" if label.title else ""
    if label.link:
        return f"<a{attributes({'href': label.link})}>{title}{drawn}</a>"
    return f"<g>{title}{drawn}</g>" if title else drawn


def _as_id(name: str) -> str:
    word = _NOT_IN_IDS.sub("-", sound_text(name)).strip("-")[:ID_LENGTH]
    if not word or (word[0].isalpha() and not _OURS.fullmatch(word)):
        return word
    return f"item-named-{word}"


def _free(base: str, taken: Iterable[str]) -> str:
    choice, count = base, 1
    while choice in taken:
        count += 1
        choice = f"{base}-{count}"
    return choice

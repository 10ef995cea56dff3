"""CSS declarations of a block or a ``style`` attribute, shorthands expanded."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from packwork.readers.gate.css.selectors import split_outside
from packwork.readers.gate.css.shorthands import SHORTHANDS, UnknownValueError
from packwork.readers.svg_syntax.vocabulary import CUSTOM, PROPERTIES

LOST_PROPERTIES = {
    "animation": "its animation",
    "animation-name": "its animation",
    "offset-path": "motion along a path",
    "mask-border": "masks that are no elements",
    "perspective": "perspective",
    "zoom": "zoom",
    "content": "content of style sheets",
}
"""What is said of properties that browsers know and this reading does not."""

COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)|<!--|-->", re.DOTALL)
"""Comments, which may lack their end, and the brackets of old ones."""

_IMPORTANT = re.compile(r"!\s*important\s*$", re.IGNORECASE)
_HARMLESS = frozenset({"none", "auto", "normal", "initial", "0s", "1"})


@dataclass(frozen=True)
class Declarations:
    """What a block sets.

    Parameters
    ----------
    values
        By property, variables among them, each with whether it is marked important.
    lost
        What was left out of it.
    """

    values: Mapping[str, tuple[str, bool]]
    lost: frozenset[str] = field(default=frozenset())


@lru_cache(maxsize=4096)
def parse_declarations(text: str) -> Declarations:
    """Values by known property, each with whether it is marked important.

    Examples
    --------
    >>> parse_declarations("fill: red; stroke:none !important; oops").values
    {'fill': ('red', False), 'stroke': ('none', True)}
    >>> parse_declarations("animation: turn 2s").lost
    frozenset({'its animation'})
    """
    found: dict[str, tuple[str, bool]] = {}
    lost: set[str] = set()
    for declaration in _declarations(COMMENT.sub(" ", text)):
        name, _, raw = (part.strip() for part in declaration.partition(":"))
        name = name if name.startswith(CUSTOM) else name.lower()
        is_important = "!" in raw and _IMPORTANT.search(raw) is not None
        value = _IMPORTANT.sub("", raw).strip() if is_important else raw
        if not value:
            continue
        if name in SHORTHANDS:
            try:
                longhands = SHORTHANDS[name](value)
            except UnknownValueError as unknown:
                lost.add(str(unknown))
                continue
            for key, part in longhands.items():
                found[key] = (part, is_important)
        elif name in PROPERTIES or name.startswith(CUSTOM):
            found[name] = (value, is_important)
        elif name in LOST_PROPERTIES and value.lower() not in _HARMLESS:
            lost.add(LOST_PROPERTIES[name])
    return Declarations(found, frozenset(lost))


def _declarations(text: str) -> list[str]:
    return split_outside(text, ";") if "(" in text or '"' in text else text.split(";")

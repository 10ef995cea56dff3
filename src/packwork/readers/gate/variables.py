"""CSS variables to their values: ``var(--ink, black)`` means nothing to older programs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

MAX_VALUE = 200
"""Letters of a variable's value; longer ones are passed over, as they multiply. Chosen."""

_USE = re.compile(r"var\(\s*+(--[\w-]++)\s*+(?:,((?:[^()]|\([^()]*+\))*+))?\)")
_SETTING = re.compile(r"(?:^|[;{\s])(--[\w-]++)\s*+:([^;{}]*+)")
_ROUNDS = 4


def variables_in(texts: Iterable[str]) -> dict[str, str]:
    """Values that style sheets and ``style`` attributes give to variables, anywhere.

    Where several do, the last one counts: drawings set them once, for the whole.

    Examples
    --------
    >>> variables_in([":root{--ink:red;--pale: #eee }", "--ink:blue"])
    {'--ink': 'blue', '--pale': '#eee'}
    """
    found: dict[str, str] = {}
    for text in texts:
        for name, value in _SETTING.findall(text) if "--" in text else ():
            if len(value) <= MAX_VALUE:
                found[name] = value.strip()
    return found


def filled_in(value: str, variables: Mapping[str, str]) -> str:
    """The value with its variables replaced, or what stands in for those that are not set.

    Examples
    --------
    >>> filled_in("var(--ink, black)", {}), filled_in("var(--ink)", {"--ink": "rgb(1,2,3)"})
    ('black', 'rgb(1,2,3)')
    """
    for _ in range(_ROUNDS):
        if "var(" not in value:
            break
        value = _USE.sub(lambda use: variables.get(use[1], use[2] or "").strip(), value)
    return value

"""CSS variables replaced by their values: ``var(--ink, black)`` means nothing to older programs."""

from __future__ import annotations

import re
from collections.abc import Mapping

MAX_VALUE = 200
"""Letters of a variable's value; longer ones are passed over, as they multiply. Chosen."""

_USE = re.compile(r"var\(\s*+(--[\w-]++)\s*+(?:,((?:[^()]|\([^()]*+\))*+))?\)")
_ROUNDS = 4


def with_variables(
    outer: Mapping[str, str], declared: Mapping[str, str]
) -> tuple[Mapping[str, str], dict[str, str]]:
    """Variables inside an element, and what else is declared on it.

    Parameters
    ----------
    outer
        Variables of what the element stands in.
    declared
        Values by property, variables among them.

    Examples
    --------
    >>> with_variables({"--a": "1"}, {"--b": "var(--a)", "fill": "red"})
    ({'--a': '1', '--b': '1'}, {'fill': 'red'})
    """
    own = {k: v for k, v in declared.items() if k.startswith("--") and len(v) <= MAX_VALUE}
    if not own:
        return outer, dict(declared)
    inner = {**outer, **own}
    for name in own:
        inner[name] = filled_in(own[name], inner)
    return inner, {k: v for k, v in declared.items() if not k.startswith("--")}


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
        if len(value) > _ROUNDS * MAX_VALUE:
            return ""
    return value

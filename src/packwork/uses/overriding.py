"""Options of a recipe that are given anew for one run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from packwork.errors import RecipeError
from packwork.readers.words.options import WordOptions
from packwork.recipe.refusals import validated
from packwork.uses.charts.recipe import NOT_OURS
from packwork.uses.words.recipe import words_colours

_OF_WORDS = {"count": "count", "smallest": "smallest", "font": "fonts"}
"""Options that a cloud of words keeps among its own, and how they are called there."""

_LENGTHS_OF_RUNS = ("effort", "epochs", "time")
"""Ways to say how long to try: the one that is given counts."""


def overridden(options: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Plain options of a recipe, some of them replaced; losses are added to.

    Parameters
    ----------
    changes
        New values by name; None is not given.

    Examples
    --------
    >>> overridden({"container": "heart", "seed": 1, "epochs": 9}, {"seed": 6, "effort": "best"})
    {'container': 'heart', 'seed': 6, 'effort': 'best'}
    """
    given = {key: value for key, value in changes.items() if value is not None}
    changed = dict(options)
    if any(key in given for key in _LENGTHS_OF_RUNS):
        for key in _LENGTHS_OF_RUNS:
            changed.pop(key, None)
    if "chart" in changed:
        for key in NOT_OURS:
            if key in given:
                raise RecipeError(key, "is no option of a chart: its data say how large marks are")
    if isinstance(changed.get("words"), Mapping):
        own = {name: given.pop(key) for key, name in _OF_WORDS.items() if key in given}
        changed["words"] = words = {**changed["words"], **own}
        if "palette" in given:
            asked = validated(WordOptions, words)
            given["palette"] = words_colours(
                given["palette"], asked, str(changed.get("container", ""))
            )
    if "losses" in given:
        before = changed.get("losses")
        given["losses"] = {**(before if isinstance(before, Mapping) else {}), **given["losses"]}
    return {**changed, **given}

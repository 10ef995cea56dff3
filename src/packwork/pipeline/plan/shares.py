"""Words, photos and other items in one layout: a share of the area for each kind."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.scene.item import Item, PhotoArt


def shared_out(
    items: Sequence[Item],
    weights: FloatArray,
    words: Collection[Item],
    share: Mapping[str, float],
) -> FloatArray:
    """``(n,)`` weights whose sums over words, photos and other items are in the shares asked.

    Parameters
    ----------
    weights
        ``(n,)`` as asked within each kind.
    words
        The words among the items. Not their names, which others may have too.
    share
        By kind: words, photos, items. None leaves the weights as they are.

    Raises
    ------
    RecipeError
        If a kind that is there has no share, or one that has one is not there.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([np.array([[0.0, 0], [1, 0], [1, 1]])])
    >>> items = [Item(name, name, ink, ink, FlatArt()) for name in ("fox", "star", "moon")]
    >>> shared_out(items, np.ones(3), items[:1], {"words": 3, "items": 1}).tolist()
    [0.75, 0.125, 0.125]
    """
    kinds = kinds_of(items, words)
    _check_kinds(set(kinds.tolist()), set(share))
    total = sum(share.values())
    result = weights.copy()
    for name, part in share.items():
        own = kinds == name
        result[own] *= part / total / float(weights[own].sum())
    return result


def kinds_of(items: Sequence[Item], words: Collection[Item]) -> NDArray[np.str_]:
    """``(n,)`` what each item counts as: words, photos or items.

    Examples
    --------
    >>> kinds_of([], []).tolist()
    []
    """
    known = set(words)
    return np.array([_kind(item, known) for item in items], dtype=np.str_)


def _kind(item: Item, words: Collection[Item]) -> str:
    if item in words:
        return "words"
    return "photos" if isinstance(item.art, PhotoArt) else "items"


def _check_kinds(there: set[str], asked: set[str]) -> None:
    if there == asked:
        return
    missing, idle = sorted(there - asked), sorted(asked - there)
    problem = f"says nothing of {missing[0]}" if missing else f"there are no {idle[0]} here"
    raise RecipeError("share", f"{problem}; give shares of {', '.join(sorted(there))}")

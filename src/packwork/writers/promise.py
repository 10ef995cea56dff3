"""Promises of a run (gap, shares of area) as text that fits into any file.

A measure of the file alone can then say whether the promise holds.
"""

from __future__ import annotations

import json
from collections.abc import Mapping

from packwork.scene.layout import Layout

EXACT = 1e-14
"""Last digit of coordinates that are compared exactly, over the canvas: a hundredth of what is
taken for rounding. Derived."""

_USUAL = {"rotate": ("free", ""), "sizes": ("free",), "size_ratio": ("2.0", "2")}
"""Options of items as files leave them out."""


def promised(layout: Layout) -> tuple[str, bool]:
    """Smallest gap in canvas units, empty without a promise; and whether shares are kept."""
    found = layout.manifest.get("promised")
    if not isinstance(found, Mapping):
        return "", False
    return f"{float(found.get('gap', 0.0)):.12g}", found.get("areas_in_shares") is True


def finest(layout: Layout, usual: float) -> float:
    """Share of the canvas that the last digit of a coordinate counts: ``usual``.

    Far less of straight rectangles in exact places, so that they keep their distance in the file.
    """
    is_exact = promised(layout)[0] and any(one.coarseness == 0.0 for one in layout.items)
    return min(usual, EXACT) if is_exact else usual


def stated_weights(layout: Layout) -> list[str]:
    """Weight of each item where a promise speaks of it; else empty texts."""
    has_shares = promised(layout)[1]
    weights = layout.weights.tolist()
    return [f"{weight:.12g}" if has_shares and weight != 1.0 else "" for weight in weights]


def stated_limits(layout: Layout) -> dict[str, str]:
    """Attributes that say how far items may turn and how sizes vary, where that is not free.

    And how words were set, where items are words.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from packwork.scene.layout import blank
    >>> stated_limits(replace(blank(), manifest={"recipe": {"rotate": "none", "sizes": "free"}}))
    {'data-rotate': 'none'}
    """
    found: dict[str, str] = {}
    for source in ("recipe", "edited"):
        said = layout.manifest.get(source)
        if isinstance(said, Mapping):
            found |= {key: f"{said[key]}" for key in _USUAL if said.get(key) is not None}
    if promised(layout)[1]:
        # Shares leave sizes no freedom.
        found.pop("sizes", None)
    recipe = layout.manifest.get("recipe")
    words = recipe.get("words") if isinstance(recipe, Mapping) else None
    if isinstance(words, Mapping):
        # So that an edit knows them for words, and sets others alike.
        known = {k: v for k, v in words.items() if k != "source" and v not in (None, [], ())}
        found["words"] = json.dumps(known, separators=(",", ":"), default=str)
    return {
        f"data-{key.replace('_', '-')}": value
        for key, value in found.items()
        if value not in _USUAL.get(key, ())
    }


def is_nest(layout: Layout) -> bool:
    """Whether a layout is of parts for a machine, as its manifest says."""
    return isinstance(layout.manifest.get("nest"), Mapping)

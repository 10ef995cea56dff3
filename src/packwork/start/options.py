"""Options of the first poses."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from packwork.options import Options

Placing: TypeAlias = Literal["distance-field", "medial-axis", "scatter", "first-fit", "erosion"]
"""Ways to find first places."""


LAYOUTS = frozenset({".geojson", ".json", ".svg", ".dxf", ".packwork"})
"""Endings of files that hold a layout from which a run can begin."""


class StartOptions(Options):
    """First places and sizes of items."""

    method: Literal["auto", "distance-field", "medial-axis", "scatter", "first-fit"] = (
        "distance-field"
    )
    """distance-field: one after another into the largest room; medial-axis: along the
    container's middle line first; scatter: at random; auto: one of the first two, as the
    container's form suggests; first-fit: where they touch most, at the largest common size (the
    distance field where none is found)."""

    coverage: Annotated[float, Field(gt=0, le=1)] = 0.64
    """Share of the container that the items cover at the start, were they not to
    overlap. Larger starts crowded, smaller spends
    epochs on growing. Tried (the paper: 0.55)."""

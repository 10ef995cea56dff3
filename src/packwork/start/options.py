"""How the first poses are found."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict, Field

Placing: TypeAlias = Literal["distance-field", "medial-axis", "scatter"]
"""Ways to find first places."""


class StartOptions(BaseModel):
    """Where items begin and how large."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    method: Literal["auto", "distance-field", "medial-axis", "scatter"] = "distance-field"
    """distance-field: one after another into the largest room; medial-axis: along the
    container's middle line first; scatter: at random; auto: as the container's form
    suggests."""

    coverage: Annotated[float, Field(gt=0, le=1)] = 0.64
    """Share of the container that the items cover at the start, were they not to
    overlap. Larger starts crowded, smaller spends
    epochs on growing. Tried (the paper: 0.55)."""

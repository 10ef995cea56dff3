"""How the first poses are found."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field


class StartOptions(BaseModel):
    """Where items begin and how large."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    method: Literal["distance-field", "scatter"] = "distance-field"
    """distance-field: one after another into the largest room; scatter: at random."""

    coverage: Annotated[float, Field(gt=0, le=1)] = 0.64
    """Share of the container that the items cover at the start, were they not to
    overlap. Larger starts crowded, smaller spends
    epochs on growing. Tried (the paper: 0.55)."""

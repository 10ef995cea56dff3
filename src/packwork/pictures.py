"""What a run is asked about photographs and pictures behind: a part of the recipe."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, Field, field_validator

from packwork.readers.photos.options import PhotoOptions


class Pictured(BaseModel, use_attribute_docstrings=True):
    """Photographs that are placed, and the picture round which items are."""

    photos: PhotoOptions | None = None
    """Photographs to place: which, and what becomes of their edges (``packwork photos``)."""

    quiet_share: Annotated[float, Field(ge=0.02, le=0.98)] = 0.4
    """Of a container around:IMAGE: the share of the picture that is filled, that in which least
    is to be seen."""

    keep_clear: tuple[str, ...] | None = None
    """Of a container around:IMAGE: what is left free in any case, a mask (dark is kept clear) or
    a box left,top,width,height such as 10%,20%,30%,30%."""

    @field_validator("keep_clear", mode="before")
    @classmethod
    def _one_is_enough(cls, value: object) -> object:
        return (value,) if isinstance(value, str) else value

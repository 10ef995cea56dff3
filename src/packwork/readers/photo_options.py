"""Options of photographs: their source, frames and edges."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sized
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, field_validator

from packwork.errors import RecipeError
from packwork.options import NOT_OFFERED, Group, Offer, Options, Verbs
from packwork.readers.options import colour_of

ROUNDED = "rounded"
"""Shape of a photo that keeps its proportions and loses its corners."""

DEFAULT_ROUNDING = 10.0
"""Radius of rounded corners, in percent of the shorter side. Chosen by eye."""

_ROUNDED = re.compile(rf"{ROUNDED}(?::(\d+(?:\.\d+)?)%)?")
_SHARE = re.compile(r"(\d+(?:\.\d+)?)\s*%")
_WIDEST = 50.0


class PhotoOptions(Options):
    """Photographs, and what becomes of their edges."""

    offers = Offer(group=Group.EDGES, verbs=Verbs.PHOTOS)

    sources: Annotated[tuple[str, ...], Field(min_length=1), NOT_OFFERED]
    """Photos (JPEG, PNG, WebP), folders of them, or patterns such as *.jpg."""

    shape: str | None = None
    """Cut photos to a shape: rounded, rounded:20% (radius as a share of the shorter side), or
    whatever can be a container, such as circle, heart or a mask. Default: none."""

    border: str = "0%"
    """Width of a border around each photo, as a share of its shorter side, such as 4%: it lies
    outside the photo and hides nothing of it."""

    border_color: Annotated[str, colour_of("border_color")] = "white"
    """Colour of the border."""

    edge: Literal["inside", "crop"] = "inside"
    """What becomes of photos at the container's edge: inside (all of each photo is seen) or crop
    (they cover the edge and are cut at its line, for a clean rim)."""

    @property
    def border_share(self) -> float:
        """Width of the border over the photo's shorter side."""
        return _share("border", self.border)

    @property
    def rounding(self) -> float | None:
        """Radius of corners over the shorter side; None where they are not rounded."""
        match = _ROUNDED.fullmatch(self.shape or "")
        return None if match is None else float(match[1] or DEFAULT_ROUNDING) / 100

    @field_validator("sources", mode="before")
    @classmethod
    def _one_source_is_enough(cls, sources: Any) -> Any:
        if isinstance(sources, str | Path):
            return (str(sources),)
        if isinstance(sources, Sized) and not len(sources):
            raise RecipeError("sources", "none were given; give photos, or a folder of them")
        return tuple(map(str, sources)) if isinstance(sources, Iterable) else sources

    @field_validator("shape")
    @classmethod
    def _rounding_has_a_meaning(cls, shape: str | None) -> str | None:
        if shape is None or not shape.startswith(f"{ROUNDED}:"):
            return shape
        match = _ROUNDED.fullmatch(shape)
        if match is None or float(match[1]) > _WIDEST:
            raise RecipeError("shape", f"use rounded:1% to rounded:50%, not {shape[:40]!r}")
        return shape

    @field_validator("border")
    @classmethod
    def _border_is_a_share(cls, border: str) -> str:
        _share("border", border)
        return border


def _share(key: str, text: str) -> float:
    match = _SHARE.fullmatch(text.strip())
    if match is None or float(match[1]) > _WIDEST:
        raise RecipeError(
            key, f"use a share of the photo's shorter side, 0% to 50%, not {text[:40]!r}"
        )
    return float(match[1]) / 100

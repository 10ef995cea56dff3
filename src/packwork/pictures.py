"""What a run is asked about photographs: a part of the recipe."""

from __future__ import annotations

from pydantic import BaseModel

from packwork.readers.photos.options import PhotoOptions


class Pictured(BaseModel, use_attribute_docstrings=True):
    """Photographs that are placed."""

    photos: PhotoOptions | None = None
    """Photographs to place: which, and what becomes of their edges (``packwork photos``)."""

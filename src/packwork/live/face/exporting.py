"""A session's layout in the formats of the command line, in memory."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

from pydantic import ValidationError

from packwork.errors import RecipeError, WriteError
from packwork.live.file.disk import ENDING
from packwork.live.file.session_file import session_bytes
from packwork.live.file.things import Things
from packwork.live.kept import Kept
from packwork.scene.layout import Layout
from packwork.writers import encoded, write_options

FORMATS: Mapping[str, str] = {
    "svg": "image/svg+xml",
    "pdf": "application/pdf",
    "dxf": "image/vnd.dxf",
    "png": "image/png",
    "jpg": "image/jpeg",
    "webp": "image/webp",
    "tif": "image/tiff",
    "geojson": "application/geo+json",
}
"""Formats of layouts, and what browsers call them."""


def layout_bytes(layout: Layout, kind: str, options: Mapping[str, Any]) -> bytes:
    """A layout in a format.

    Parameters
    ----------
    kind
        One of :data:`FORMATS`.
    options
        Of drawings, as on the command line.

    Raises
    ------
    WriteError
        If it cannot be drawn so, or a package is missing.
    RecipeError
        If an option has no meaning.
    """
    if kind not in FORMATS:
        raise WriteError(kind[:20], f"is no format; use one of {', '.join(FORMATS)}")
    try:
        drawing = write_options(**options)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in first["loc"])
        raise RecipeError(key[:40], first["msg"]) from None
    return encoded(layout, PurePath(f"layout.{kind}").name, drawing)


def kept_bytes(kept: Kept) -> bytes:
    """A session's file, ``.packwork``, with all that undo and redo lead to."""
    return session_bytes(kept, Things())


SESSION = ENDING.removeprefix(".")
"""Ending of session files, without the dot."""

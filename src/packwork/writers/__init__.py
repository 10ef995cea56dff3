"""Layouts to files, all through one atomic writer.

Names load what they need when they are first used: the options of films are part of the
command line's help, which loads nothing heavy.
"""

from __future__ import annotations

import importlib
from typing import Any

_HOMES = {
    "atomic": ("check_all", "check_new", "check_outputs", "check_writable", "described",
               "write_all", "write_atomic"),
    "diagnose": ("diagnose_png",),
    "film.film": ("Film", "tell_nobody"),
    "film.registry": ("FILMS", "check_film", "film_bytes"),
    "geojson": ("geojson_text", "json_bytes"),
    "halos": ("faint_message",),
    "bitmaps": ("png_bytes",),
    "recipe": ("recipe_bytes",),
    "registry": (
        "WRITERS", "WriteOptions", "check_output", "check_picture_size", "encoded",
        "pdf_drawing", "write", "write_options",
    ),
    "svg": ("SvgOptions", "svg_text"),
}  # fmt: skip

__all__ = sorted(name for names in _HOMES.values() for name in names)


def __getattr__(name: str) -> Any:
    """Load a name when it is first used."""
    for home, names in _HOMES.items():
        if name in names:
            return getattr(importlib.import_module(f"packwork.writers.{home}"), name)
    raise AttributeError(f"module 'packwork.writers' has no attribute {name!r}")

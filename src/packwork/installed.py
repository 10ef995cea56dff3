"""Installed version of the program."""

from __future__ import annotations

from functools import cache
from importlib import metadata


@cache
def installed_version() -> str:
    """Version, looked up once: files of the installation are read for it, which takes 2 ms."""
    return metadata.version("packwork")

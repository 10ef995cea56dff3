"""Packages that only some formats need: imported where used, named when missing."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from packwork.errors import WriteError

PACKAGES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {".pdf": ("typst", "pikepdf"), ".dxf": ("ezdxf",), ".mp4": ("av",), ".webm": ("av",)}
)
"""File ending to the packages it needs: the extras ``pdf``, ``dxf`` and ``video`` of the
project."""


def check_extra(path: str | Path) -> None:
    """Refuse a path whose format needs a package that is not installed.

    Raises
    ------
    WriteError
        Saying what to install.

    Examples
    --------
    >>> check_extra("layout.svg")
    """
    for package in PACKAGES.get(Path(path).suffix.lower(), ()):
        if importlib.util.find_spec(package) is None:
            raise WriteError(
                path, f"needs the package {package}; install it: pip install {package}"
            )

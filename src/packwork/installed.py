"""Installed version of the program, and what to install for parts of it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import metadata

EXTRAS = {
    "typst": "pdf", "pikepdf": "pdf", "ezdxf": "dxf", "av": "video", "pandas": "data",
    "pyarrow": "data", "matplotlib": "plot", "geopandas": "geo", "anywidget": "notebook",
    "traitlets": "notebook", "torch": "torch", "distributed": "cluster", "starlette": "studio",
    "uvicorn": "studio", "websockets": "studio",
}  # fmt: skip
"""Extra of ours that brings a package; a test compares them with those of the project."""


@cache
def installed_version() -> str:
    """Version, looked up once: files of the installation are read for it, which takes 2 ms."""
    return metadata.version("packwork")


def command_to_install(packages: Sequence[str]) -> str:
    """Command that installs packages, by our extras where those bring them.

    Examples
    --------
    >>> command_to_install(["typst", "pikepdf"]), command_to_install(["no_such_package"])
    ('pip install "packwork[pdf]"', 'pip install no_such_package')
    """
    extras = dict.fromkeys(EXTRAS[package] for package in packages if package in EXTRAS)
    others = [package for package in packages if package not in EXTRAS]
    ours = [f'"packwork[{",".join(extras)}]"'] if extras else []
    return f"pip install {' '.join([*ours, *others])}"

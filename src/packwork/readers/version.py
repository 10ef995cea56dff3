"""Version of the code that reads: what was kept by another one is not what it would read."""

from __future__ import annotations

import functools
import hashlib
import sys
from importlib.metadata import version
from pathlib import Path

import shapely

from packwork import folders

FOLDERS = ("readers", "geometry", "raster", "fields", "fit", "scene")
"""Parts of the package that say what a drawing or a letter is read as."""


@functools.cache
def reader_version() -> str:
    """One word for all code that reads drawings and letters."""
    # By what is installed: to import SciPy for its number takes longer.
    numbers = [version(name) for name in ("numpy", "scipy", "shapely", "resvg_py")]
    whole = hashlib.sha256(repr((sys.version, shapely.geos_version, numbers)).encode())
    root = Path(folders.__file__).parent
    paths = [*root.glob("*.py"), *(p for f in FOLDERS for p in (root / f).rglob("*.py"))]
    for path in sorted(paths):
        whole.update(path.relative_to(root).as_posix().encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()

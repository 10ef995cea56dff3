"""The decorator of compiled kernels, and their cache, which holds none that is out of date.

Numba keeps what it compiled beside the sources, and compiles a kernel anew where its own file has
changed. What it took over into a kernel from those that it calls, in other files, it does not
look at: after such a change a caller would go on with the old one.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
from pathlib import Path
from typing import Any

from numba import njit

SOURCES = "_kernels.py"
"""Name of the modules that hold kernels."""

DEEPEST = 3
"""Folders that a module of kernels lies deep in the package at most; a test holds it to that."""


def kernel(function: Any = None, /, **options: Any) -> Any:
    """Compile a function when it is first called, once for each installation.

    Parameters
    ----------
    function
        What is compiled; None where options are given, as for ``@kernel(inline="always")``.
    **options
        Of ``numba.njit``, beside those that all kernels have: cached, without Python's lock, and
        with divisions by zero as in NumPy.
    """
    return njit(function, cache=True, nogil=True, error_model="numpy", **options)


def forget_stale(folder: Path) -> bool:
    """Delete what was compiled of other kernels than those that lie in a folder now.

    Where nothing may be written, nothing was kept there either.

    Returns
    -------
    bool
        Whether there was anything out of date.
    """
    mark = folder / "__pycache__" / "kernels"
    text = _fingerprint(folder)
    with contextlib.suppress(OSError):
        if mark.read_text(encoding="ascii") == text:
            return False
    with contextlib.suppress(OSError):
        for compiled in folder.rglob("*.nb[ci]"):
            compiled.unlink(missing_ok=True)
        mark.parent.mkdir(exist_ok=True)
        # Others may start at the same moment.
        own = mark.with_name(f"{mark.name}-{os.getpid()}")
        own.write_text(text, encoding="ascii")
        own.replace(mark)
    return True


def _fingerprint(folder: Path) -> str:
    """One word for all kernels together."""
    whole = hashlib.sha256()
    for depth in range(1, DEEPEST + 1):
        for path in sorted(folder.glob("*/" * depth + SOURCES)):
            whole.update(path.read_bytes())
    return whole.hexdigest()


forget_stale(Path(__file__).parent)

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
    """Delete what was compiled, inside a folder, of other kernels than those that lie there now.

    Where nothing may be written, nothing was kept there either. A cache that ``NUMBA_CACHE_DIR``
    puts elsewhere is not looked at.

    Returns
    -------
    bool
        Whether there was anything out of date.
    """
    mark = folder / "__pycache__" / "kernels"
    fingerprint = _fingerprint(folder)
    with contextlib.suppress(OSError):
        if mark.read_bytes() == fingerprint:
            return False
    for compiled in folder.rglob("*.nb[ci]"):
        with contextlib.suppress(OSError):
            compiled.unlink(missing_ok=True)
    with contextlib.suppress(OSError):
        mark.parent.mkdir(exist_ok=True)
        # Others may start at the same moment.
        own = mark.with_name(f"{mark.name}-{os.getpid()}")
        own.write_bytes(fingerprint)
        own.replace(mark)
    return True


def _fingerprint(folder: Path) -> bytes:
    """One word for all kernels together, and for how they are compiled."""
    whole = hashlib.sha256(Path(__file__).read_bytes())
    for depth in range(1, DEEPEST + 1):
        for path in sorted(folder.glob("*/" * depth + SOURCES)):
            whole.update(path.relative_to(folder).as_posix().encode())
            whole.update(path.read_bytes())
    return whole.hexdigest().encode()


forget_stale(Path(__file__).parent)

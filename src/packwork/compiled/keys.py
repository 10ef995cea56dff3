"""Keys of compiled kernels: the texts of their modules, versions and the processor."""

from __future__ import annotations

import functools
import hashlib
import inspect
import re
import sys
from collections.abc import Iterable

import llvmlite.binding
import numba

from packwork.folders import Store

FORM = 4
"""Number of the form in which kernels are kept; a new one forgets all."""

MOST_BYTES = 200_000_000
"""Size of the cache: about a hundred times what one version of all kernels takes. Chosen."""

VERSIONS = (numba.config.OPT, numba.__version__, llvmlite.__version__, sys.version)

STORE = Store("kernels", MOST_BYTES, variable="NUMBA_CACHE_DIR")

_IMPORT = re.compile(r"^[ \t]*from\s+(\S+)\s+import\s+(\([^)]*\)|[^\n(]*)", re.MULTILINE)
_NAME = re.compile(r"\w+")


@functools.cache
def fingerprint(module: str) -> str:
    """One word for the text of a module of kernels and of all those that it calls.

    >>> import packwork.fields._kernels as kernels
    >>> fingerprint(kernels.__name__) == fingerprint(kernels.__name__)
    True
    """
    source = inspect.getsource(sys.modules[module])
    whole = hashlib.sha256(source.encode())
    for called in sorted(called_by(source) - {module}):
        whole.update(fingerprint(called).encode())
    return whole.hexdigest()


def called_by(source: str) -> set[str]:
    """Modules of kernels from which one of them imports; without a parser, ten times as fast."""
    found = set()
    for package, names in _IMPORT.findall(source):
        found |= {package, *(f"{package}.{name}" for name in _NAME.findall(names))}
    return {name for name in found if holds_kernels(name) and name in sys.modules}


def holds_kernels(module: str) -> bool:
    """Whether compiled code may lie in a module: one called ``_kernels``, or in ``kernels/``.

    >>> holds_kernels("packwork.solve._kernels"), holds_kernels("packwork.raster.kernels.overlay")
    (True, True)
    >>> holds_kernels("packwork.raster.kernels"), holds_kernels("packwork.raster.overlay")
    (False, False)
    """
    *packages, name = module.split(".")
    return name == "_kernels" or packages[-1:] == ["kernels"]


def mark_of(modules: Iterable[str]) -> str:
    """One word for some modules of kernels on this machine, as :data:`STORE` takes it."""
    texts = sorted(map(fingerprint, modules))
    return repr((FORM, texts, VERSIONS, llvmlite.binding.get_host_cpu_name()))

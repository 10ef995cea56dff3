"""Decorators of compiled kernels.

Kernels are kept by a cache of our own, which stands on private parts of Numba; with a Numba that
lacks them by Numba's own, which does not see changes in other files and compiles more.
"""

from __future__ import annotations

import contextlib
import functools
from typing import Any

from numba import njit

from packwork.compiled.keys import STORE, called_by, fingerprint, holds_kernels, mark_of
from packwork.compiled.listeners import NOTICE, Listener, listening

try:
    from packwork.compiled.cache import HelperCompiler, KernelCache

    HAS_OWN_CACHE = True
except ImportError:
    # A Numba whose private parts were moved: its own cache, for what it is worth.
    HAS_OWN_CACHE = False

__all__ = [
    "HAS_OWN_CACHE", "NOTICE", "OUTER", "STORE", "Listener", "as_python", "called_by",
    "fingerprint", "helper", "holds_kernels", "kernel", "leaf", "listening", "mark_of", "shared",
]  # fmt: skip

OUTER = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": True}
"""Options of kernels that Python calls: without its lock, divisions by zero as in NumPy.

``_nrt``: arrays are counted; said here since what is called would take it over from a leaf."""


def kernel(function: Any = None, /, **options: Any) -> Any:
    """Compile a function when it is first called, once for each installation.

    Kernels that call it call its machine code.

    ``function``: what is compiled; None where options are given, as for ``@kernel(fastmath=True)``;
    ``**options``: of ``numba.njit``, beside ``OUTER``.
    """
    if function is None:
        return functools.partial(kernel, **options)
    options = {**OUTER, **options}
    compiled = njit(function, **options)
    # Where compiling is switched off, that is the function itself.
    if compiled is not function and HAS_OWN_CACHE:
        compiled._cache = KernelCache(function, options)
    elif compiled is not function:
        # Where it finds no folder that may be written to, nothing is kept.
        with contextlib.suppress(RuntimeError):
            compiled.enable_caching()
    return compiled


def shared(function: Any = None, /, **options: Any) -> Any:
    """Compile a function once for all kernels that call its machine code; Python cannot call it.

    For what is long and what several kernels call: a call costs some 50 ns more than a helper's.
    """
    return kernel(function, no_cpython_wrapper=True, **options)


def helper(function: Any = None, /, **options: Any) -> Any:
    """Compile a function into the kernels that call it, which keep it; Python cannot call it."""
    if function is None:
        return functools.partial(helper, **options)
    inner: dict[str, Any] = {"no_cpython_wrapper": True}
    if HAS_OWN_CACHE:
        inner["pipeline_class"] = HelperCompiler
    return njit(function, **{**OUTER, **inner, **options})


def leaf(function: Any = None, /, **options: Any) -> Any:
    """Compile a helper that makes no arrays and is given none by what it calls.

    It does not count who holds the arrays that it is given, which its callers hold: threads
    that count on the same arrays wait for each other at every call.
    """
    return helper(function, _nrt=False, **options)


def as_python(compiled: Any) -> Any:
    """The function that a kernel or helper was made of, as Python runs it."""
    return getattr(compiled, "py_func", compiled)

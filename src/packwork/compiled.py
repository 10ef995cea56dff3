"""Decorators of compiled kernels, and their cache, which holds none that is out of date.

Numba keeps compiled functions beside the sources, by the text of the one file each stands in. What
it took over into a kernel from those that it calls, in other files, it does not look at; and where
an installation may not be written to it looks for a home that a service may not have. So we keep
them ourselves: one file a kernel and types, named by all that went into it, in a private folder
(``packwork.folders``), since what is loaded from there is run.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import inspect
import logging
import pickle
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol, final

import llvmlite.binding
import llvmlite.ir
import numba
from numba import njit
from numba.core import serialize
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.runtime import rtsys

from packwork.folders import Store

FORM = 2
"""Number of the form in which kernels are kept; a new one forgets all."""

MOST_BYTES = 200_000_000
"""Size of the cache: about a hundred times what one version of all kernels takes. Chosen."""

OUTER = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}
"""Options of kernels that Python calls: without its lock, divisions by zero as in NumPy."""

INNER = {**OUTER, "no_cpython_wrapper": True}
"""Options of those that only kernels call, which need no way in from Python."""

VERSIONS = (numba.config.OPT, numba.__version__, llvmlite.__version__, sys.version)

NOTICE = "compiling kernels, once after each installation: 10 to 40 s of one processor core"

_IMPORT = re.compile(r"^[ \t]*from\s+(\S+)\s+import\s+(\([^)]*\)|[^\n(]*)", re.MULTILINE)
_NAME = re.compile(r"\w+")

_LOG = logging.getLogger("packwork")

STORE = Store("kernels", MOST_BYTES, variable="NUMBA_CACHE_DIR")


class Listener(Protocol):
    """Callback for kernels that are compiled."""

    def __call__(self, kernel: str, is_done: bool) -> None:
        """Called before a kernel is compiled, and after."""
        ...


_listeners: list[Listener] = []


def kernel(function: Any = None, /, **options: Any) -> Any:
    """Compile a function when it is first called, once for each installation.

    Parameters
    ----------
    function
        What is compiled; None where options are given, as for ``@kernel(fastmath=True)``.
    **options
        Of ``numba.njit``, beside ``OUTER``.
    """
    if function is None:
        return functools.partial(kernel, **options)
    compiled = njit(function, **{**OUTER, **options})
    # Where compiling is switched off, that is the function itself.
    if compiled is not function:
        compiled._cache = KernelCache(function, {**OUTER, **options})
    return compiled


def helper(function: Any = None, /, **options: Any) -> Any:
    """Compile a function into the kernels that call it, which keep it; Python cannot call it.

    Parameters
    ----------
    function
        What is compiled; None where options are given.
    **options
        Of ``numba.njit``, beside ``INNER``.
    """
    if function is None:
        return functools.partial(helper, **options)
    return njit(function, **{**INNER, **options})


def as_python(compiled: Any) -> Any:
    """The function that a kernel or helper was made of, as Python runs it."""
    return getattr(compiled, "py_func", compiled)


def mark_of(modules: Iterable[str]) -> str:
    """One word for some modules of kernels on this machine, as :data:`STORE` takes it."""
    texts = sorted(map(fingerprint, modules))
    return repr((FORM, texts, VERSIONS, llvmlite.binding.get_host_cpu_name()))


@contextlib.contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Tell ``listener`` what is compiled while the block runs, in place of the log."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


@functools.cache
def _tell_once() -> None:
    _LOG.warning(NOTICE)


def _tell(name: str, is_done: bool) -> None:
    if not _listeners:
        _tell_once()
    for listener in _listeners:
        listener(name, is_done)


class KernelCache(NullCache):  # type: ignore[misc]
    """What Numba asks for a kernel before it compiles one, and gives it afterwards.

    Parameters
    ----------
    function
        The kernel, not compiled.
    options
        How it is compiled.
    """

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        self._function = function
        self._name = f"{function.__module__}.{function.__qualname__}"
        self._options = repr(sorted(options.items(), key=lambda item: item[0]))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Kernel for some types of arguments; None if it has to be compiled."""
        key = self._key(sig, target_context.codegen())
        kept = None if key is None else STORE.get(key)
        if kept is None:
            target_context.refresh()
            _tell(self._name, is_done=False)
            return None
        # All that a compiled kernel needs. To refresh the context would load what Numba knows of
        # every function of NumPy, SciPy's linear algebra among it: longer than all kernels.
        rtsys.initialize(target_context)
        state, bitcode = pickle.loads(kept)  # noqa: S301
        loaded = CompileResult._rebuild(target_context, *state)
        loaded.library._shared_module = Bitcode(bitcode)
        return loaded

    def save_overload(self, sig: Any, cres: Any) -> None:
        """Keep what was compiled."""
        key = self._key(sig, cres.codegen)
        if key is not None and not cres.library.has_dynamic_globals:
            STORE.put(key, serialize.dumps(_parted(cres)))
        _tell(self._name, is_done=True)

    def _key(self, sig: Any, codegen: Any) -> str | None:
        """All that a compiled kernel depends on; None where its text is not to be had."""
        try:
            text = fingerprint(self._function.__module__)
        except OSError:
            return None
        parts = (
            FORM, self._name, self._options, text,
            tuple(map(repr, sig)), codegen.magic_tuple(), VERSIONS,
        )  # fmt: skip
        return repr(parts)


@final
@dataclass(frozen=True)
class Bitcode:
    """Code of a kernel for others that call it; read only if one of them is compiled.

    Parameters
    ----------
    data
        As LLVM writes it.
    """

    data: bytes

    def clone(self) -> Any:
        """LLVM's module, as Numba links it into another one."""
        return llvmlite.binding.parse_bitcode(self.data)

    def as_bitcode(self) -> bytes:
        """The code itself, as Numba keeps it."""
        return self.data


def _parted(compiled: Any) -> tuple[tuple[Any, ...], bytes]:
    """What is needed to call a kernel, and its bitcode; without, it is loaded twice as fast."""
    library, *rest = compiled._reduce()
    name, kind, (machine_code, bitcode) = library
    names = compiled.fndesc.llvm_func_name, compiled.fndesc.llvm_cpython_wrapper_name
    return ((name, kind, (machine_code, _names_alone(names))), *rest), bitcode


def _names_alone(names: Iterable[str]) -> bytes:
    """Bitcode that holds nothing but the names by which machine code is found."""
    module = llvmlite.ir.Module()
    for name in names:
        kind = llvmlite.ir.FunctionType(llvmlite.ir.VoidType(), ())
        block = llvmlite.ir.Function(module, kind, name).append_basic_block()
        llvmlite.ir.IRBuilder(block).ret_void()
    return bytes(llvmlite.binding.parse_assembly(str(module)).as_bitcode())


@functools.cache
def fingerprint(module: str) -> str:
    """One word for the text of a module of kernels and of all those that it calls.

    Examples
    --------
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

    Examples
    --------
    >>> holds_kernels("packwork.solve._kernels"), holds_kernels("packwork.raster.kernels.overlay")
    (True, True)
    >>> holds_kernels("packwork.raster.kernels"), holds_kernels("packwork.raster.overlay")
    (False, False)
    """
    *packages, name = module.split(".")
    return name == "_kernels" or packages[-1:] == ["kernels"]

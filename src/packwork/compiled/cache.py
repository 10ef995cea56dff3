"""Cache of compiled kernels, which holds none that is out of date, by private parts of Numba.

Numba keeps compiled functions beside the sources, by the text of the one file each stands in. What
it took over into a kernel from those that it calls, in other files, it does not look at; and where
an installation may not be written to it looks for a home that a service may not have. So we keep
them ourselves: one file a kernel and types, named by all that went into it, in a private folder
(``packwork.folders``), since what is loaded from there is run.

Numba compiles each function to machine code, and once more inside each that calls it. Here a kernel
calls another one's machine code, as it calls the C library; helpers are compiled inside kernels
only.
"""

from __future__ import annotations

import io
import pickle
import sys
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, final

import llvmlite.binding
import llvmlite.ir
from numba.core import serialize
from numba.core.caching import NullCache
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, CompileResult, DefaultPassBuilder
from numba.core.environment import Environment, lookup_environment
from numba.core.runtime import rtsys

from packwork.compiled.keys import FORM, STORE, VERSIONS, fingerprint
from packwork.compiled.listeners import tell

_NEEDED = (
    (CompileResult, "_rebuild"),
    (CompileResult, "_reduce"),
    (CompileResult, "_find_referenced_environments"),
    (Environment, "_memo"),
    (JITCodeLibrary, "_ensure_finalized"),
    (JITCodeLibrary, "_finalize_dynamic_globals"),
    (JITCodeLibrary, "_optimize_final_module"),
    (DefaultPassBuilder, "define_nopython_pipeline"),
)
"""Private parts of Numba that are called or overridden here."""

if missing := [name for owner, name in _NEEDED if not hasattr(owner, name)]:
    raise ImportError(f"this Numba lacks {missing[0]}")


class KernelCache(NullCache):  # type: ignore[misc]
    """Cache that Numba asks for a kernel before it compiles one, and fills afterwards."""

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        self._function = function
        self._name = f"{function.__module__}.{function.__qualname__}"
        self._options = repr(sorted(options.items(), key=lambda item: item[0]))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Kernel for some types of arguments; None if it has to be compiled."""
        key = self._key(sig, target_context.codegen())
        kept = None if key is None else STORE.get(key)
        loaded = None if kept is None else _loaded(kept, target_context)
        if loaded is None:
            target_context.refresh()
            tell(self._name, is_done=False)
            return None
        self._add(loaded)
        return loaded

    def save_overload(self, sig: Any, cres: Any) -> None:
        """Keep what was compiled."""
        # Those of helpers; of a kernel that is loaded, Numba does the same.
        for environment in cres._find_referenced_environments():
            cres.codegen.set_env(environment.env_name, environment)
        self._add(cres)
        key = self._key(sig, cres.codegen)
        if key is not None and not cres.library.has_dynamic_globals:
            STORE.put(key, serialize.dumps((_calls_of(cres.library), _state(cres))))
        tell(self._name, is_done=True)

    def _add(self, compiled: Any) -> None:
        """Let other kernels call its machine code, and not compile it once more."""
        compiled.library._shared_module = NoCode()
        _, _, name = self._name.rpartition(".")
        symbol = compiled.fndesc.llvm_func_name
        place = self._function.__module__, name, tuple(compiled.signature.args)
        _kernels[symbol] = Call(symbol, *place)

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


class Call(NamedTuple):
    """Kernel that another one calls: its symbol, and where it stands with which types."""

    symbol: str
    module: str
    name: str
    types: tuple[Any, ...]


_kernels: dict[str, Call] = {}
"""All kernels of this process, by their symbols."""


@final
class NoCode:
    """Empty code library: a kernel adds nothing to its callers, it is found by its symbol."""

    def clone(self) -> Any:
        """LLVM's module, as Numba links it into another one."""
        return llvmlite.binding.parse_assembly("")

    def as_bitcode(self) -> bytes:
        """The same, as Numba keeps it."""
        return b""


@final
class HelperLibrary(JITCodeLibrary):  # type: ignore[misc]
    """Code of a helper as it is compiled into kernels: not optimised, which they do, nor run."""

    @property
    def codegen(self) -> Any:
        """Code generator with the helper's environment, which its kernels take over."""
        return NoEnvironments()

    def get_pointer_to_function(self, name: str) -> int:
        """Address of machine code: none."""
        self._ensure_finalized()
        return 0

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


@final
class NoEnvironments:
    """Part of Numba's code generator that a helper needs nothing of."""

    def set_env(self, name: str, environment: Any) -> None:
        """Nothing is done."""


@final
class HelperCompiler(CompilerBase):  # type: ignore[misc]
    """Compiles helpers: as Numba does, but for what becomes of their code."""

    def define_pipelines(self) -> list[Any]:
        """Numba's passes."""
        state = self.state
        state.library = HelperLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        return [DefaultPassBuilder.define_nopython_pipeline(state)]


def _calls_of(library: Any) -> tuple[Call, ...]:
    """Kernels that the code of one calls."""
    names = (one.name for one in library._final_module.functions if one.is_declaration)
    return tuple(_kernels[name] for name in names if name in _kernels)


def _loaded(kept: bytes, target_context: Any) -> Any:
    """A kernel that was kept; None if what it calls is not what it was compiled for."""
    calls, state = Unpickler(io.BytesIO(kept)).load()
    for call in calls:
        getattr(sys.modules[call.module], call.name).compile(call.types)
        # Numba numbers the symbols of a process. One that is missing would end the process.
        if call.symbol not in _kernels:
            return None
    # All that a compiled kernel needs. To refresh the context would load what Numba knows of
    # every function of NumPy, SciPy's linear algebra among it: longer than all kernels.
    rtsys.initialize(target_context)
    return CompileResult._rebuild(target_context, *state)


@final
class Unpickler(pickle.Unpickler):
    """Reads what was kept, without importing the modules that compiled functions stand in.

    Helpers of Numba's are among them: its arrays and texts would take longer than all kernels.
    """

    def find_class(self, module: str, name: str, /) -> Any:
        """Object that a name in the entry stands for."""
        return _environment if name == "_rebuild_env" else super().find_class(module, name)


def _environment(module: str, constants: list[Any], name: str) -> Any:
    """Objects that machine code uses: only constants, globals are compiled into it."""
    environment = lookup_environment(name)
    if environment is None:
        loaded = sys.modules.get(module)
        environment = Environment({"__name__": module} if loaded is None else vars(loaded))
        environment.consts[:] = constants
        environment.env_name = name
        Environment._memo[name] = environment
    return environment


def _state(compiled: Any) -> tuple[Any, ...]:
    """State that is needed to call a kernel."""
    library, *rest = compiled._reduce()
    name, kind, (machine_code, _) = library
    names = compiled.fndesc.llvm_func_name, compiled.fndesc.llvm_cpython_wrapper_name
    return (name, kind, (machine_code, _names_alone(names))), *rest


def _names_alone(names: Iterable[str]) -> bytes:
    """Bitcode that holds nothing but the names by which machine code is found."""
    module = llvmlite.ir.Module()
    for name in names:
        kind = llvmlite.ir.FunctionType(llvmlite.ir.VoidType(), ())
        block = llvmlite.ir.Function(module, kind, name).append_basic_block()
        llvmlite.ir.IRBuilder(block).ret_void()
    return bytes(llvmlite.binding.parse_assembly(str(module)).as_bitcode())

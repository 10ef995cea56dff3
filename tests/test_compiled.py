"""Compiled kernels: that none outlives those that it calls, and where they are kept."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from packwork import compiled

NEEDS_JIT = pytest.mark.skipif(
    bool(os.environ.get("NUMBA_DISABLE_JIT")), reason="nothing is compiled"
)

CALLED = "from packwork.compiled import helper\n\n\n@helper\ndef called():\n    return {}\n"
CALLING = (
    "from somekernels.called._kernels import called\nfrom packwork.compiled import kernel\n\n\n"
    "@kernel\ndef calling():\n    return called()\n"
)
RAISING = (
    "from packwork.compiled import helper, leaf, shared\n\n\n"
    "@helper\ndef raising():\n    raise ValueError('met')\n    return 1\n\n\n"
    "@{}\ndef called():\n    return raising()\n"
)
PROGRAM = "from somekernels.calling._kernels import calling; print(calling())"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package of two modules of kernels, of which one calls the other."""
    package = tmp_path / "somekernels"
    for folder in (package, package / "called", package / "calling"):
        folder.mkdir()
        (folder / "__init__.py").touch()
    (package / "calling" / "_kernels.py").write_text(CALLING, encoding="utf-8")
    (package / "called" / "_kernels.py").write_text(CALLED.format(1), encoding="utf-8")
    return package


FORKS = """
import json, os, sys, traceback
import packwork.compiled

for line in sys.stdin:
    asked = json.loads(line)
    child = os.fork()
    if child == 0:
        for number in (1, 2):
            os.dup2(os.open(asked["said"][number - 1], os.O_WRONLY | os.O_CREAT), number)
        os.environ.update(asked["environment"])
        os.chdir(asked["folder"])
        sys.path.insert(0, asked["folder"])
        status = 1
        try:
            exec(asked["program"], {})
            status = 0
        except BaseException:
            traceback.print_exc()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""
"""A process that has loaded what compiles, and compiled nothing, runs programs in copies of it."""

Call = Callable[..., tuple[str, str]]


@pytest.fixture(scope="module")
def call(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Call]:
    """Tells what a program prints that uses the package, and what on standard error."""
    if not hasattr(os, "fork"):
        yield call_anew
        return
    folder = tmp_path_factory.mktemp("said")
    with subprocess.Popen(
        [sys.executable, "-c", FORKS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONPATH": _paths(), "PYTHONDONTWRITEBYTECODE": "1"},
    ) as forks:  # fmt: skip

        def called(package: Path, program: str = PROGRAM, **changes: str) -> tuple[str, str]:
            said = [folder / name for name in ("out", "errors")]
            for path in said:
                path.unlink(missing_ok=True)
            asked = {
                "program": program, "folder": str(package.parent), "said": list(map(str, said)),
                "environment": {"PACKWORK_CACHE_DIR": str(package.parent / "cache"), **changes},
            }  # fmt: skip
            print(json.dumps(asked), file=forks.stdin, flush=True)
            assert forks.stdout is not None
            status = forks.stdout.readline()
            out, errors = (path.read_text(encoding="utf-8") for path in said)
            assert status == "0\n", errors
            return out.strip(), errors

        yield called
        assert forks.stdin is not None
        forks.stdin.close()


def _paths(*more: str) -> str:
    return os.pathsep.join([*more, *filter(None, sys.path)])


def call_anew(package: Path, program: str = PROGRAM, **changes: str) -> tuple[str, str]:
    """The same, in a process of its own."""
    # Python knows changed sources by their size and second: what it keeps of them would be stale.
    cache = {
        "PACKWORK_CACHE_DIR": str(package.parent / "cache"),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "PYTHONPATH": _paths(str(package.parent)), **cache, **changes},
        capture_output=True, text=True, check=True, cwd=package.parent,
    )  # fmt: skip
    return done.stdout.strip(), done.stderr


def kept(package: Path) -> set[Path]:
    return set((package.parent / "cache" / "packwork" / "kernels").iterdir())


@NEEDS_JIT
def test_what_is_compiled_is_kept_and_loaded_and_said_once(package: Path, call: Call) -> None:
    assert call(package) == ("1", f"{compiled.NOTICE}\n")
    once = kept(package)
    assert len(once) == 1
    assert call(package) == ("1", "")
    assert kept(package) == once


@NEEDS_JIT
def test_with_a_numba_that_lacks_private_parts_its_own_cache_is_used(package: Path) -> None:
    lacking = "import numba.core.ccallback, numba.core.caching as caching; del caching.NullCache; "
    own = "import packwork.compiled as compiled; print(compiled.HAS_OWN_CACHE); "
    cache = {"NUMBA_CACHE_DIR": str(package.parent / "numba")}
    assert call_anew(package, lacking + own + PROGRAM, **cache)[0].split() == ["False", "1"]
    assert list((package.parent / "numba").rglob("*.nbi"))
    assert call_anew(package, lacking + own + PROGRAM, **cache)[0].split() == ["False", "1"]
    assert not (package.parent / "cache").exists()


@NEEDS_JIT
def test_a_kernel_that_was_kept_calls_the_others_as_they_are_now(package: Path, call: Call) -> None:
    assert call(package)[0] == "1"
    (package / "called" / "_kernels.py").write_text(CALLED.format(2), encoding="utf-8")
    assert call(package)[0] == "2"


@NEEDS_JIT
@pytest.mark.parametrize("kind", ["kernel", "shared"])
def test_a_kernel_that_calls_another_is_kept_beside_it(
    package: Path, call: Call, kind: str
) -> None:
    called = package / "called" / "_kernels.py"
    called.write_text(CALLED.replace("helper", kind).format("int(abs(-3))"), encoding="utf-8")
    assert call(package)[0] == "3"
    both = kept(package)
    assert len(both) == 2
    assert call(package) == ("3", "")
    for entry in both:
        # A symbol's number tells how many functions were compiled before.
        entry.unlink()
        numbers = "import numba; numba.njit(lambda: 1)(); "
        assert call(package, numbers + PROGRAM) == ("3", f"{compiled.NOTICE}\n")
        assert kept(package) == both
    assert call(package) == ("3", "")


@NEEDS_JIT
def test_a_kernel_that_was_kept_is_called_by_one_compiled_later(package: Path, call: Call) -> None:
    alone = CALLED.replace("helper", "kernel").format("int(abs(-3))")
    (package / "called" / "_kernels.py").write_text(alone, encoding="utf-8")
    first = "from somekernels.called._kernels import called; print(called())"
    assert call(package, first)[0] == "3"
    both = f"{first}; {PROGRAM}"
    assert call(package, both)[0].split() == ["3", "3"]
    assert call(package, both) == ("3\n3", "")


@NEEDS_JIT
@pytest.mark.parametrize("kind", ["helper", "leaf", "shared"])
def test_errors_come_through_what_a_kernel_calls(package: Path, call: Call, kind: str) -> None:
    (package / "called" / "_kernels.py").write_text(RAISING.format(kind), encoding="utf-8")
    program = PROGRAM.replace(
        "print(calling())", "\ntry: calling()\nexcept ValueError as e: print(e)"
    )
    assert call(package, program)[0] == "met"
    assert call(package, program)[0] == "met"


@NEEDS_JIT
def test_the_same_kernels_elsewhere_are_not_compiled_again(
    package: Path, call: Call, tmp_path: Path
) -> None:
    call(package)
    elsewhere = tmp_path / "another" / package.name
    elsewhere.parent.mkdir()
    package.rename(elsewhere)
    cache = str(package.parent / "cache")
    assert call(elsewhere, PACKWORK_CACHE_DIR=cache) == ("1", "")


@NEEDS_JIT
def test_a_damaged_entry_is_compiled_anew(package: Path, call: Call) -> None:
    call(package)
    (entry,) = kept(package)
    entry.write_bytes(entry.read_bytes()[:-1])
    assert call(package) == ("1", f"{compiled.NOTICE}\n")
    assert call(package) == ("1", "")


@NEEDS_JIT
def test_nothing_is_kept_where_that_is_switched_off(package: Path, call: Call) -> None:
    assert call(package, PACKWORK_CACHE_DIR="off")[0] == "1"
    assert not (package.parent / "cache").exists()
    assert {path.name for path in package.parent.iterdir()} == {package.name}


@NEEDS_JIT
def test_listeners_are_told_in_place_of_the_log(package: Path, call: Call) -> None:
    program = (
        "from packwork.compiled import listening\n"
        "def tell(name, is_done): print(name.rpartition('.')[2], is_done)\n"
        "with listening(tell):\n    " + PROGRAM.replace("; ", "\n    ")
    )
    said, errors = call(package, program)
    assert (said, errors) == ("calling False\ncalling True\n1", "")


def test_a_kernel_knows_the_text_of_all_that_it_calls(package: Path, call: Call) -> None:
    program = (
        "import somekernels.calling._kernels\nfrom packwork.compiled import fingerprint\n"
        "print(fingerprint('somekernels.calling._kernels'))"
    )
    first = call(package, program)[0]
    assert call(package, program)[0] == first
    (package / "called" / "_kernels.py").write_text(CALLED.format(2), encoding="utf-8")
    assert call(package, program)[0] != first


@NEEDS_JIT
def test_a_kernel_that_was_kept_brings_no_modules_of_helpers_with_it(
    package: Path, call: Call
) -> None:
    (package / "called" / "_kernels.py").write_text(
        CALLED.replace("@helper\n", "import numpy as np\n\n\n@helper\n").format(
            "np.zeros((2, 3)).sum() + len(np.ones(4).reshape(2, 2))"
        ),
        encoding="utf-8",
    )
    heavy = "numba.np.arrayobj"
    program = f"import sys; {PROGRAM}; print({heavy!r} in sys.modules)"
    assert call(package, program)[0].split() == ["2.0", "True"]
    assert call(package, program)[0].split() == ["2.0", "False"]


@NEEDS_JIT
def test_importing_compiles_and_loads_no_kernel() -> None:
    code = (
        "from packwork.compiled import cache; import packwork.cli.running, packwork.cli.verbs, "
        "packwork.api.verbs, packwork.api.session; print(len(cache._kernels))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "0\n"

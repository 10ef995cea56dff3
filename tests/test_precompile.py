"""Kernels before the first run: all that a run needs, by one process or two."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from packwork import compiled, precompile

pytestmark = pytest.mark.skipif(
    bool(os.environ.get("NUMBA_DISABLE_JIT")), reason="nothing is compiled"
)

RUN = """
import packwork as pw
from packwork import compiled, precompile
asked = []
load = compiled.KernelCache.load_overload
def counting(self, sig, context):
    asked.append(self._name)
    return load(self, sig, context)
compiled.KernelCache.load_overload = counting
precompile.warm_up()
before = len(asked)
pw.fill("circle", ["star", "heart"], count=12, epochs=30, levels="16,32")
print(before, ",".join(set(asked[:before])), *asked[before:])
"""


def test_a_run_needs_no_kernel_that_was_not_compiled_beforehand() -> None:
    done = subprocess.run(
        [sys.executable, "-c", RUN], capture_output=True, text=True, check=True
    )  # fmt: skip
    types, names, *more = done.stdout.split()
    kernels = names.split(",")
    assert len(kernels) <= int(types) == precompile.KERNELS
    assert {name.rpartition(".")[0] for name in kernels} == set(precompile.MODULES)
    assert more == []


def test_two_processes_share_the_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []

    def part(name: str) -> None:
        def do() -> None:
            done.append(name)

        do.__name__ = name
        parts.append(do)

    parts: list[precompile.Part] = []
    for name in "abc":
        part(name)
    (tmp_path / "b").touch()
    precompile.share(parts, tmp_path)
    precompile.share(parts[::-1], tmp_path)
    assert done == ["a", "c"]


def test_a_second_process_counts_for_the_first_and_ends_with_it() -> None:
    counted: list[int] = []
    with precompile.helped(lambda: counted.append(1)) as (claims, helper):
        for part in precompile.PARTS[1:]:
            (claims / part.__name__).touch()
        assert helper.wait(200) == 0
        assert (claims / precompile.PARTS[0].__name__).exists()
    with precompile.helped(lambda: None) as (_, helper):
        pass
    assert helper.returncode is not None
    assert not claims.exists()


def test_a_second_process_is_asked_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    class RefusedError(Exception):
        pass

    def helped(one_more: object) -> None:
        asked.append(1)
        raise RefusedError

    monkeypatch.setattr(precompile, "PARTS", ())
    monkeypatch.setattr(precompile, "helped", helped)
    monkeypatch.setattr(precompile, "_may_have_help", lambda: True)
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    precompile.warm_up(second=False)
    assert asked == []
    with pytest.raises(RefusedError):
        precompile.warm_up(second=True)
    mark = precompile._mark()
    assert mark is not None
    compiled.STORE.put(mark, b"")
    precompile.warm_up(second=True)
    assert asked == [1]


def test_one_that_cannot_be_started_is_no_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precompile, "PARTS", ())
    monkeypatch.setattr(precompile, "_may_have_help", lambda: True)
    monkeypatch.setattr(sys, "executable", str(tmp_path / "no-python"))
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    precompile.warm_up(second=True)


def test_a_run_of_one_thread_starts_no_process() -> None:
    code = (
        "import subprocess, sys\n"
        "def refuse(*_, **__): raise AssertionError\n"
        "subprocess.Popen.__init__ = refuse\n"
        "import packwork as pw\n"
        "from packwork import precompile\n"
        "precompile._mark = lambda: 'none'\n"
        "pw.fill('circle', 'star', count=2, epochs=2, levels='16', threads=1)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("program", "is_asked"), [("python3.12", True), ("Python.exe", True), ("qgis-bin", False)]
)
def test_a_program_with_python_inside_is_not_started_again(
    program: str, is_asked: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / program))
    monkeypatch.setattr(precompile.threads, "available", lambda: 2)
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    with precompile.threads.using(2):
        assert precompile._may_have_help() == is_asked
    with precompile.threads.using(1):
        assert not precompile._may_have_help()


def test_a_script_warms_up_where_nothing_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[bool] = []
    monkeypatch.setattr(precompile, "warm_up", lambda second: done.append(second))
    monkeypatch.setattr(precompile, "_may_have_help", lambda: True)
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    precompile.warm_up_once()
    mark = precompile._mark()
    assert mark is not None
    compiled.STORE.put(mark, b"")
    precompile.warm_up_once()
    assert done == [True]

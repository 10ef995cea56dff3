"""Compiled kernels: that none outlives those that it calls."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import packwork
from packwork import compiled

PACKAGE = Path(packwork.__file__).parent


def test_all_modules_of_kernels_are_looked_at() -> None:
    depths = [len(path.relative_to(PACKAGE).parents) - 1 for path in PACKAGE.rglob("_kernels.py")]
    assert min(depths) >= 1
    assert max(depths) <= compiled.DEEPEST


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A package of two modules of kernels, one of them compiled."""
    for name in ("one", "deep/down"):
        (tmp_path / name / "__pycache__").mkdir(parents=True)
        (tmp_path / name / compiled.SOURCES).write_text("first", encoding="utf-8")
    assert compiled.forget_stale(tmp_path)
    for ending in ("nbi", "1.nbc", "pyc"):
        (tmp_path / "one" / "__pycache__" / f"a.{ending}").touch()
    return tmp_path


def kept(folder: Path) -> set[str]:
    return {path.name for path in (folder / "one" / "__pycache__").iterdir()}


def test_what_is_compiled_of_the_same_kernels_is_kept(folder: Path) -> None:
    assert not compiled.forget_stale(folder)
    assert kept(folder) == {"a.nbi", "a.1.nbc", "a.pyc"}


def test_a_change_of_one_kernel_forgets_what_others_were_compiled_to(folder: Path) -> None:
    (folder / "deep" / "down" / compiled.SOURCES).write_text("second", encoding="utf-8")
    assert compiled.forget_stale(folder)
    assert kept(folder) == {"a.pyc"}
    assert not compiled.forget_stale(folder)


def test_where_nothing_may_be_written_nothing_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "one" / compiled.SOURCES).write_text("second", encoding="utf-8")

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "unlink", refuse)
    assert compiled.forget_stale(folder)
    assert kept(folder) == {"a.nbi", "a.1.nbc", "a.pyc"}


def test_a_damaged_mark_is_made_anew(folder: Path) -> None:
    (folder / "__pycache__" / "kernels").write_bytes(b"\xff\xfe")
    assert compiled.forget_stale(folder)
    assert not compiled.forget_stale(folder)


def test_one_file_that_stays_keeps_no_other(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "one" / compiled.SOURCES).write_text("second", encoding="utf-8")
    unlink = Path.unlink

    def refuse(path: Path, missing_ok: bool = False) -> None:
        if path.suffix == ".nbi":
            raise PermissionError
        unlink(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", refuse)
    assert compiled.forget_stale(folder)
    assert kept(folder) == {"a.nbi", "a.pyc"}


CALLED = "from packwork.compiled import kernel\n\n\n@kernel\ndef called():\n    return {}\n"
CALLING = (
    "from {name}.called._kernels import called\nfrom packwork.compiled import kernel\n\n\n"
    "@kernel\ndef calling():\n    return called()\n"
)


@pytest.mark.skipif(bool(os.environ.get("NUMBA_DISABLE_JIT")), reason="nothing is compiled")
def test_a_kernel_that_was_kept_calls_the_others_as_they_are_now(tmp_path: Path) -> None:
    package = tmp_path / "somekernels"
    for folder in (package, package / "called", package / "calling"):
        folder.mkdir()
        (folder / "__init__.py").touch()
    (package / "calling" / "_kernels.py").write_text(CALLING.format(name=package.name))

    def result(value: int) -> str:
        (package / "called" / "_kernels.py").write_text(CALLED.format(value))
        program = (
            "from pathlib import Path; from packwork.compiled import forget_stale; "
            f"forget_stale(Path({str(package)!r})); "
            f"from {package.name}.calling._kernels import calling; print(calling())"
        )
        paths = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
        environment = {**os.environ, "PYTHONPATH": paths}
        environment.pop("NUMBA_CACHE_DIR", None)
        return subprocess.run(
            [sys.executable, "-c", program], env=environment, capture_output=True, text=True,
            check=True,
        ).stdout.strip()  # fmt: skip

    assert [result(1), result(2)] == ["1", "2"]

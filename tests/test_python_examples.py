"""The twelve uses in Python run, short, and their types are right."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import packwork as pw

FILE = Path(__file__).parents[1] / "examples" / "python" / "twelve_uses.py"


def uses() -> dict[str, Callable[..., pw.Layout]]:
    spec = importlib.util.spec_from_file_location("twelve_uses", FILE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {use.__name__: use for use in module.USES}


USES = uses()


@pytest.mark.parametrize("use", USES.values(), ids=USES)
def test_a_use_runs(use: Callable[..., pw.Layout], tmp_path: Path) -> None:
    layout = use(effort="draft", levels="32")
    assert layout.certified
    layout.save(tmp_path / "use.png", pixels=64)


def test_there_are_twelve() -> None:
    assert len(USES) == 12


def test_types_are_right() -> None:
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(FILE)]
    done = subprocess.run(command, cwd=FILE.parents[2], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout

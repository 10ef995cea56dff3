"""Ctrl-C before a command has begun."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("library", ["typer", "pydantic", "packwork.recipe"])
def test_ctrl_c_while_loading_is_one_line(library: str) -> None:
    code = (
        "import builtins, runpy, sys\n"
        "sys.argv = ['packwork', 'fill', 'heart', '-n', '1']\n"
        "load = builtins.__import__\n"
        "def pressed(name, *rest, **more):\n"
        f"    if name == '{library}': raise KeyboardInterrupt\n"
        "    return load(name, *rest, **more)\n"
        "builtins.__import__ = pressed\n"
        "runpy.run_module('packwork', run_name='__main__')\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode == 130
    assert run.stderr == "packwork: stopped before there was anything to write\n"


PRESSED_IN_EXEC = """
import runpy
import sys
import packwork.cli.running as running

def pressed(*asked):
    exec("raise KeyboardInterrupt")

running.run_and_write = pressed
sys.argv = ["packwork", "fill", "heart", "-n", "1"]
runpy.run_module("packwork", run_name="__main__")
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no death by SIGINT")
def test_ctrl_c_that_strikes_inside_exec_is_no_death_by_signal(folder: Path) -> None:
    (folder / "pressed.py").write_text(PRESSED_IN_EXEC, encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "-m", "pressed"], cwd=folder, capture_output=True, text=True, check=False
    )
    assert run.returncode == 130
    assert run.stderr == "packwork: stopped before there was anything to write\n"


def test_next_to_nothing_is_loaded_before_ctrl_c_is_one_line() -> None:
    code = (
        "import sys; before = set(sys.modules); import packwork.__main__; "
        "print(*sorted(set(sys.modules) - before))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(run.stdout.split())
    assert not loaded & {"logging", "re", "contextlib", "typing", "numpy", "signal"}
    assert "packwork.__main__" in loaded

"""Ctrl-C: the best so far is written, wherever it strikes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from typer.testing import Result

from packwork import pipeline, writers
from packwork.cli.failure import WATCH
from packwork.uses.nested import NestedSheets

Command = Callable[..., Result]


def item_count(file: Path) -> int:
    features = json.loads(file.read_text(encoding="utf-8"))["features"]
    return sum(feature["properties"]["role"] == "item" for feature in features)


WATCHED_LOSS = """
from itertools import count
from pathlib import Path
import packwork as pw

calls = count()

def loss(density, container):
    # It is tried before the run.
    if next(calls) > 5:
        Path("running").touch()
    return pw.Term(1.0, 1e-9 * density)
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no SIGINT between processes")
def test_ctrl_c_writes_the_best_so_far(folder: Path) -> None:
    (folder / "watched.py").write_text(WATCHED_LOSS, encoding="utf-8")
    line = "fill circle star -n 20 --epochs 1000000 --levels 64 -o out.geojson --report r.json"
    with subprocess.Popen(
        [sys.executable, "-m", "packwork", *line.split(), "--loss", "watched:loss"],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    ) as run:  # fmt: skip
        try:
            wait_for(folder / "running")
            run.send_signal(signal.SIGINT)
            out, err = run.communicate(timeout=60)
        finally:
            run.kill()
    assert run.returncode == 130, err
    assert "Traceback" not in err
    assert "out.geojson" in out
    assert item_count(folder / "out.geojson") == 20
    assert "stopped" in json.loads((folder / "r.json").read_text(encoding="utf-8"))["ending"]


@pytest.mark.parametrize("stage", ["start", "levels", "finish", "measure"])
def test_ctrl_c_in_each_stage_writes_the_best_so_far(
    stage: str, folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    pressed = []

    def pressed_on_entry(clock: pipeline.job.Clock, name: str) -> AbstractContextManager[None]:
        # Once: a stage may be entered again, and the second press ends the run at once.
        if name == stage and not pressed:
            pressed.append(name)
            signal.raise_signal(signal.SIGINT)
        return timed(clock, name)

    timed = pipeline.job.Clock.time
    monkeypatch.setattr("packwork.pipeline.job.Clock.time", pressed_on_entry)
    result = packwork(
        "fill circle star -n 20 --levels 32 --epochs 9 -o out.geojson --report r.json"
    )
    assert result.exit_code == 130
    assert item_count(folder / "out.geojson") == 20
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    assert set(report["seconds"]) > {"levels"}
    worth = "certified" if report["certified"] else "not certified"
    said = f"packwork: stopped by Ctrl-C; this is the best so far, {worth}\n"
    assert result.stderr.endswith(said)
    # What is certified is not rough as well, and a run that was stopped needs no more effort.
    assert "still rough" not in result.stderr or worth == "not certified"
    assert "--effort" not in result.stderr
    assert f"\n{worth}: " in result.stdout


def test_ctrl_c_while_a_nest_is_written_keeps_it(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    pressed = []

    def pressed_on_entry(*asked: object) -> bytes:
        if not pressed:
            pressed.append(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
        # Who listens for a program that hangs lets it write.
        assert WATCH.keeps_results
        return encoded(*asked)

    encoded = writers.encoded
    monkeypatch.setattr("packwork.writers.encoded", pressed_on_entry)
    result = packwork("nest 300x200mm builtin:star@40mm*2 --passes 20 -o a.geojson")
    assert result.exit_code == 130
    assert result.stderr.endswith("packwork: stopped by Ctrl-C; this is the best so far\n")
    assert item_count(folder / "a.geojson") == 2


def test_ctrl_c_before_a_part_is_laid_writes_no_nest(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nothing(*asked: object, **named: object) -> NestedSheets:
        signal.raise_signal(signal.SIGINT)
        return NestedSheets((), (), (), {})

    monkeypatch.setattr("packwork.uses.nesting.nest", nothing)
    result = packwork("nest 300x200mm builtin:star@40mm*2 --passes 20 -o a.geojson")
    assert result.exit_code == 130
    assert result.stderr == "packwork: stopped before there was anything to write\n"
    assert not list(folder.iterdir())


def test_ctrl_c_after_all_is_written_changes_nothing(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def pressed(*results: object) -> None:
        for _ in range(2):
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("packwork.cli.running.show_results", pressed)
    result = packwork("fill circle star -n 2 --levels 16 --epochs 2 -o out.svg")
    assert (result.exit_code, result.stderr) == (0, "")
    assert (folder / "out.svg").exists()


def test_a_second_ctrl_c_ends_it_at_once(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def pressed(*asked: object) -> None:
        for _ in range(2):
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("packwork.pipeline.run", pressed)
    result = packwork("fill circle star -n 2 -o out.svg")
    assert result.exit_code == 130
    assert result.stderr == "packwork: stopped by a second Ctrl-C; nothing was written\n"
    assert not list(folder.iterdir())


def wait_for(file: Path) -> None:
    """Return once a file exists; kernels may compile before that."""
    for _ in range(1_200):
        if file.exists():
            return
        time.sleep(0.1)
    raise TimeoutError(file)


def test_ctrl_c_before_there_is_anything_says_so(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("packwork.precompile.warm_up", interrupted)
    result = packwork("fill circle star -o out.svg")
    assert result.exit_code == 130
    assert result.stderr == "packwork: stopped before there was anything to write\n"
    assert not list(folder.iterdir())

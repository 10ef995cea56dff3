"""What a process takes to load is told with its first run."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

from packwork.cli import running
from packwork.cli.start_up import StartUp

Command = Callable[..., Result]
QUICK = "fill circle star -n 2 --levels 16 --epochs 2 --effort draft"


def test_a_report_and_the_table_have_the_start_up_of_the_first_run_alone(
    tmp_path: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running, "START_UP", StartUp())
    told = []
    for name in ("first", "second"):
        report = tmp_path / f"{name}.json"
        result = packwork(f"{QUICK} -o {tmp_path / 'out.svg'} --report {report}")
        told.append(json.loads(report.read_text(encoding="utf-8"))["seconds"]["start-up"])
        assert f"placed; start-up {told[-1]:.2f} s, read " in result.stdout
    assert told[0] > told[1] >= 0.0


def test_a_start_up_ends_once() -> None:
    start_up = StartUp()
    start_up.end()
    seconds = start_up.told()
    start_up.end()
    assert seconds > start_up.told() == 0.0

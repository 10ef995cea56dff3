"""Names that no disk takes, wherever a file may be named: one line, exit code 2."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

Command = Callable[..., Result]

LONG = ["{}", "{}.svg", "{}.jpg", "{}.csv"]
LINES = [
    "fill {} star -n 2", "fill heart {} -n 2", "fill heart star -n 2 --filler {}",
    "fill heart star -n 2 --weights {}", "fill text:A star --font {}", "photos heart {}",
    "words heart {}", "words heart oxen:2 --font {}", "words heart oxen:2 --add {}",
    "words heart oxen:2 --stopwords {}", "chart circle {}", "pile heart {}", "run {}", "measure {}",
]  # fmt: skip


@pytest.mark.parametrize("letters", [300, 3_000])
@pytest.mark.parametrize("ending", LONG)
@pytest.mark.parametrize("line", LINES)
def test_a_name_that_no_disk_takes_is_one_line(
    packwork: Command, line: str, ending: str, letters: int
) -> None:
    name = ending.format("x" * letters)
    result = packwork(line.format(name))
    assert result.exit_code == 2
    assert len(result.stderr.strip().splitlines()) == 1


@pytest.mark.skipif(os.name != "posix", reason="closes a descriptor")
def test_a_closed_standard_input_is_one_line(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "packwork", "words", "circle", "-", "-o", str(tmp_path / "a.svg")],
        preexec_fn=lambda: os.close(0),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "standard input: is closed" in done.stderr.splitlines()[-1]

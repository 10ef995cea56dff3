"""What reaches a terminal, and odd places that a program may be started in."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

QUICK = ["--levels", "16", "--epochs", "2", "--finish", "none"]
DOT = '<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></svg>'


def started(
    line: list[str], folder: Path, more: Mapping[str, str] | None = None, after: str = ""
) -> subprocess.CompletedProcess[bytes]:
    """Run the program as one of its own; ``after`` is put after its command line."""
    command = [sys.executable, "-m", "packwork", *line]
    if after:
        command = ["sh", "-c", f'"$@" {after}', "sh", *command]
    return subprocess.run(
        command, capture_output=True, cwd=folder, env={**os.environ, **(more or {})}, check=False
    )


@pytest.mark.parametrize("encoding", ["ascii", "cp932"])
def test_signs_that_an_encoding_lacks_are_written_plainly(folder: Path, encoding: str) -> None:
    (folder / "Bär².svg").write_text(DOT, encoding="utf-8")
    line = ["fill", "circle", "Bär².svg", "-n", "2", *QUICK, "-o", "ö.geojson"]
    done = started(line, folder, {"PYTHONIOENCODING": encoding})
    assert b"Traceback" not in done.stderr
    assert done.returncode in {0, 1}
    said = done.stdout.decode(encoding)
    assert "unevenness of the gaps, px" in said
    assert "wrote " in said
    assert (folder / "ö.geojson").exists()


def test_names_move_no_cursor(folder: Path, packwork) -> None:
    name = "a\x1b[2Jb\x07\u202e.svg"
    (folder / name).write_text("<svg", encoding="utf-8")
    refused = packwork("fill circle", name)
    assert refused.exit_code == 2
    assert "a\\x1b[2Jb\\x07\\u202e.svg" in refused.stderr
    written = packwork("fill circle star", *QUICK, "-o", "x\x1b]0;y.geojson")
    assert "\x1b" not in written.output
    assert "wrote x\\x1b]0;y.geojson" in written.stdout


def test_a_folder_that_is_gone_is_one_line(folder: Path) -> None:
    gone = folder / "gone"
    gone.mkdir()
    command = f'cd "{gone}" && rmdir "{gone}" && "{sys.executable}" -m packwork fill circle'
    done = subprocess.run(["sh", "-c", command], capture_output=True, check=False)
    assert done.returncode == 2
    assert done.stderr.decode().startswith("packwork: the current folder: is there no more")


def test_closed_streams_are_no_failure(folder: Path) -> None:
    line = ["fill", "circle", "star", "-n", "2", *QUICK, "-o", "a.geojson"]
    done = started(line, folder, after="<&- >&-")
    assert b"Traceback" not in done.stderr
    assert (folder / "a.geojson").exists()


def test_words_from_a_closed_input_are_one_line(folder: Path) -> None:
    done = started(["words", "circle", "-"], folder, after="<&-")
    assert done.returncode == 2
    assert done.stderr.decode().startswith("packwork: standard input: is closed")
    assert done.stderr.count(b"\n") == 1


@pytest.mark.parametrize(
    "line",
    [
        "fill circle star -o /dev/full",
        "fill circle star --report /dev/full",
        "fill circle star --save-recipe /dev/full",
        "fill circle star --diagnose /dev/full",
        "fill circle star --film /dev/full",
        "fill around:a.png star --show-saliency /dev/full",
        "measure a.svg --report /dev/full",
    ],
)
def test_devices_are_no_files(packwork, line: str) -> None:
    result = packwork(line)
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "line",
    [
        "fill circle star -n 3 --hero star@1e308%,1%=1%",
        "pile square star -n 2 --size 1e308",
        "fill circle star --canvas 1x1000",
        "fill circle star --padding 1e308",
        "words circle {bear} --largest 1e308",
    ],
)
def test_sizes_beyond_all_bounds_are_one_line(packwork, line: str) -> None:
    result = packwork(line, *([] if line.startswith("pile") else QUICK), "-q")
    assert result.exit_code in {0, 1, 2}
    assert result.exit_code < 2 or result.stderr.count("\n") == 1


def test_a_balance_beyond_all_bounds_is_one_line(packwork) -> None:
    result = packwork("fill circle star -n 2 -q --force", "balance 1e308,1", *QUICK)
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1

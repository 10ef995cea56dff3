"""Standard output that takes nothing: files count, not what is said of them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

FILL = "fill circle star -n 2 --levels 16 --epochs 2 --finish none"
pytestmark = pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a full device")


def run(line: str, where: str, folder: Path) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, "-m", "packwork", *line.split()]
    if where == "device":
        with open("/dev/full", "wb") as full:  # noqa: PTH123
            return subprocess.run(
                command, stdout=full, stderr=subprocess.PIPE, cwd=folder, check=False
            )
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as pipe:
        return subprocess.run(command, stdout=pipe, stderr=subprocess.PIPE, cwd=folder, check=False)


@pytest.mark.parametrize("where", ["device", "pipe"])
def test_a_run_writes_its_files_all_the_same(where: str, folder: Path) -> None:
    done = run(f"{FILL} -o out.geojson", where, folder)
    assert "Traceback" not in done.stderr.decode()
    last = done.stderr.decode().splitlines()[-1]
    assert last.startswith("packwork: standard output: cannot be written to: ")
    assert last.endswith("; all files are written")
    assert (folder / "out.geojson").exists()
    measured = run("measure out.geojson", where, folder)
    assert measured.returncode == 2
    assert measured.stderr.decode().startswith("packwork: standard output: cannot be written")
    assert measured.stderr.count(b"\n") == 1

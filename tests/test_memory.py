"""Memory stays flat, however often verbs run in one process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

RUNS = 8
MOST_MB_A_RUN = 0.3
"""Twice what chance adds, half of what faces kept by a memory of glyphs added."""


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="tells memory by /proc")
def test_later_runs_add_no_memory() -> None:
    program = Path(__file__).with_name("runs_again.py")
    # Large blocks go back to the system at once: what the allocator keeps for later is no leak.
    done = subprocess.run(
        [sys.executable, program, str(RUNS)],
        env={**os.environ, "MALLOC_MMAP_THRESHOLD_": "131072"},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    a_run = {name: added / (RUNS // 2) for name, added in json.loads(done.stdout).items()}
    assert {name: mb for name, mb in a_run.items() if mb > MOST_MB_A_RUN} == {}

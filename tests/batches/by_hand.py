"""A cluster of Dask whose processes are started by hand; for tests and benchmarks."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path


class Cluster:
    """A scheduler and workers, each a process started by hand."""

    def __init__(self, folder: Path, workers: int = 2) -> None:
        self.folder, self._file = folder, folder / "scheduler.json"
        where = ("--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(self._file))
        self.scheduler = self._start("dask_scheduler", *where, "--no-dashboard")
        self._wait_for(self._file)
        self.address = json.loads(self._file.read_text(encoding="utf-8"))["address"]
        self.workers = [self.add_worker() for _ in range(workers)]

    def add_worker(self) -> subprocess.Popen[bytes]:
        own = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1")
        place = ("--local-directory", str(self.folder / "spill"))
        return self._start("dask_worker", self.address, *own, *place)

    def _start(self, module: str, *arguments: str) -> subprocess.Popen[bytes]:
        line = [sys.executable, "-m", f"distributed.cli.{module}", *arguments]
        quiet = subprocess.DEVNULL
        # The folder of the recipes is none of theirs.
        once = {**os.environ, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1"}
        return subprocess.Popen(line, stdout=quiet, stderr=quiet, cwd=self.folder, env=once)

    def _wait_for(self, file: Path) -> None:
        for _ in range(600):
            if file.exists() and file.stat().st_size:
                return
            time.sleep(0.1)
        raise AssertionError("the scheduler did not start")

    def close(self) -> None:
        for process in (*self.workers, self.scheduler):
            if process.poll() is None:
                process.kill()
            process.wait()

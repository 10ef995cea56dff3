"""Temporary folders and helping processes: gone with the process that they are of."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from packwork.temporary import LOCK, TemporaryFolder, clear_away

PATIENCE_SECONDS = 120.0
POSIX = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="Windows knows no such rights")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")

HOLDER = (
    "import sys, time\n"
    "from packwork.temporary import TemporaryFolder\n"
    "made = TemporaryFolder('studio')\n"
    "print(made.path, flush=True)\n"
    "time.sleep(600)"
)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The system's temporary folder, for this test alone."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


Start = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def start() -> Iterator[Start]:
    """Starts Python; whatever is left of it ends with the test."""
    started: list[subprocess.Popen[str]] = []

    def begin(*arguments: str) -> subprocess.Popen[str]:
        line = [sys.executable, *arguments]
        started.append(subprocess.Popen(line, stdout=subprocess.PIPE, text=True))
        return started[-1]

    yield begin
    for one in started:
        one.kill()
        one.wait()
        assert one.stdout is not None
        one.stdout.close()


def held(start: Start) -> tuple[subprocess.Popen[str], Path]:
    holder = start("-c", HOLDER)
    assert holder.stdout is not None
    return holder, Path(holder.stdout.readline().strip())


def test_a_folder_is_private_and_gone_when_it_is_closed_or_forgotten(place: Path) -> None:
    with TemporaryFolder("some") as made:
        assert made.path.parent == place
        if os.name == "posix":
            assert made.path.stat().st_mode & 0o077 == 0
        (made.path / "a").write_text("b", encoding="utf-8")
    made.close()
    forgotten = TemporaryFolder("some")
    del forgotten
    assert not list(place.iterdir())


@POSIX
def test_what_was_killed_leaves_a_folder_that_the_next_start_removes(
    place: Path, start: Start
) -> None:
    (killed, left), (alive, used) = held(start), held(start)
    killed.kill()
    killed.wait()
    (left / "deep" / "down").mkdir(parents=True)
    (used / "mine").touch()
    assert left.exists()
    # As a command does that makes no folder of its own.
    clear_away()
    assert not left.exists()
    assert (used / "mine").exists()
    assert alive.poll() is None


@POSIX
def test_a_command_clears_away_at_its_start(place: Path, start: Start) -> None:
    killed, left = held(start)
    killed.kill()
    killed.wait()
    start("-m", "packwork", "measure", str(place / "none.svg")).wait(PATIENCE_SECONDS)
    assert not left.exists()


@POSIX
def test_what_is_not_proved_to_be_left_by_us_stays(place: Path) -> None:
    precious = place / "precious"
    precious.mkdir()
    (precious / LOCK).touch()
    for name in ("packwork-studio", "packwork-0", "packwork-Studio-abcdefgh", "other-abcdefgh"):
        (place / name).mkdir()
        (place / name / LOCK).touch()
    (place / "packwork-studio-abcdefgh").mkdir()  # holds no lock
    (place / "packwork-studio-abcdefg1").symlink_to(precious)
    (place / "packwork-studio-abcdefg2").mkdir()
    (place / "packwork-studio-abcdefg2" / LOCK).symlink_to(precious / LOCK)
    (place / "packwork-studio-abcdefg3").touch()
    before = sorted(path for path in place.rglob("*"))
    clear_away()
    TemporaryFolder("some").close()
    assert sorted(path for path in place.rglob("*")) == before


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="gives files away")
def test_what_is_another_users_stays(place: Path) -> None:
    for name, given in (("packwork-studio-abcdefgh", ""), ("packwork-studio-abcdefg1", LOCK)):
        (place / name).mkdir()
        (place / name / LOCK).touch()
        os.chown(place / name / given, 54_321, -1)
    clear_away()
    assert len(list(place.iterdir())) == 2


def children(process: int) -> list[int]:
    """Processes that another one has started, and those that these have."""
    parents: dict[int, int] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parts = (entry / "stat").read_text(encoding="utf-8").rpartition(")")[2].split()
            except OSError:
                continue
            if parts[0] != "Z":
                parents[int(entry.name)] = int(parts[1])
    found, ahead = [], [process]
    while ahead:
        above = ahead.pop()
        below = [one for one, parent in parents.items() if parent == above]
        found += below
        ahead += below
    return found


def until(is_so: Callable[[], object]) -> None:
    end = time.monotonic() + PATIENCE_SECONDS
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.05)


def is_running(process: int) -> bool:
    try:
        return (
            Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0]
            != "Z"
        )
    except OSError:
        return False


@LINUX
@pytest.mark.parametrize(
    "work",
    [
        "from packwork.readers.words.tokens import found_in\nfound_in('(a+)+$', ['a' * 60 + 'b'])",
        "from packwork.raster.drawing import drawn_png\n"
        "line = 'M0 0' + ''.join(f'L{k * 7 % 997} {k * 13 % 991}' for k in range(900_000))\n"
        'drawn_png(f\'<svg xmlns="http://www.w3.org/2000/svg" width="999" height="999">\'\n'
        '    f\'<path d="{line}" stroke="red" stroke-width="9"/></svg>\')',
        "import multiprocessing, sys, threading, time\n"
        "from packwork.batches.pool import _begin\n"
        "sys.argv = ['x']\n"
        "context = multiprocessing.get_context('spawn')\n"
        "event = context.Event()\n"
        "process = context.Process(target=_begin, args=(event,))\n"
        "process.start()\n"
        "time.sleep(600)",
    ],
    ids=["match", "drawing", "worker"],
)
def test_helpers_end_with_a_process_that_is_killed(start: Start, tmp_path: Path, work: str) -> None:
    (tmp_path / "work.py").write_text(
        f"if __name__ == '__main__':\n    {'    '.join(work.splitlines(True))}", encoding="utf-8"
    )
    worker = start(str(tmp_path / "work.py"))
    until(lambda: children(worker.pid))
    # What is ended is at its work.
    time.sleep(1.0)
    below = children(worker.pid)
    os.kill(worker.pid, signal.SIGKILL)
    worker.wait()
    until(lambda: not any(map(is_running, below)))


@LINUX
def test_workers_of_a_batch_that_is_killed_end_with_it(start: Start, tmp_path: Path) -> None:
    (tmp_path / "r.toml").write_text(
        'container = "circle"\nitems = ["star"]\ncount = 300\n', encoding="utf-8"
    )
    names = "\n".join(map(str, range(40)))
    (tmp_path / "t.csv").write_text(f"name\n{names}\n", encoding="utf-8")
    batch = start(
        "-m", "packwork", "batch", str(tmp_path / "r.toml"), "--table", str(tmp_path / "t.csv"),
        "-o", str(tmp_path / "out" / "{name}.svg"), "--workers", "2", "-q",
    )  # fmt: skip
    until(lambda: len(children(batch.pid)) >= 2)
    below = children(batch.pid)
    os.kill(batch.pid, signal.SIGKILL)
    batch.wait()
    until(lambda: not any(map(is_running, below)))

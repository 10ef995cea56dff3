"""Places that do not let the program work: full, read-only, crowded, without a cache."""

from __future__ import annotations

import contextlib
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from benchmarks.robustness.hostile.stops import EARLIER, environment, packwork, wait_for

RUN = ("fill", "heart", "-n", "12", "--levels", "32", "--epochs", "20", "--seed", "3", "-q")
WITHIN = 1_800.0
"""Seconds by the clock for one run; eight may compile all kernels at once, on few cores."""

TOO_SMALL = 8_192
"""Bytes that a full disk has; a layout needs more."""

CROWD = 8


@dataclass(frozen=True)
class Met:
    """What came of one surrounding: how it was made, and what went wrong.

    Parameters
    ----------
    name, how
        For the table; ``how`` says so where the machine did not allow it.
    tried, clear, done
        Runs in all, those that ended in one clear line, and those that did what was asked.
    faults
        A sentence each, as of :class:`stops.Stopped`.
    """

    name: str
    how: str
    tried: int
    clear: int
    done: int
    faults: tuple[str, ...] = ()


def all_surroundings() -> Iterator[Met]:
    """Each place in turn."""
    for meet in (_full_disk, _read_only, _no_cache, _closed_terminal, _crowd):
        with tempfile.TemporaryDirectory() as folder:
            yield meet(Path(folder))


def _judged(
    name: str, how: str, runs: list[tuple[int, str, str]], expected: int, lost: list[str]
) -> Met:
    faults = list(lost)
    for code, _, err in runs:
        lines = err.strip().splitlines()
        if code == -99:
            faults.append(f"hang: {name}")
        elif "Traceback" in err or code != expected or (expected == 2 and len(lines) != 1):
            faults.append(f"crash: {name}: exit code {code}: {' / '.join(lines[-8:])}")
    clear = sum(code == 2 for code, _, _ in runs)
    return Met(name, how, len(runs), clear, sum(code == 0 for code, _, _ in runs), tuple(faults))


@contextlib.contextmanager
def _mounted(folder: Path, *options: str) -> Iterator[bool]:
    """A file system mounted on a folder; False where this machine does not allow it."""
    done = subprocess.run(["mount", *options, str(folder)], capture_output=True, check=False)
    try:
        yield done.returncode == 0
    finally:
        if done.returncode == 0:
            subprocess.run(["umount", "--lazy", str(folder)], check=True)


def _full_disk(folder: Path) -> Met:
    home = folder / "small"
    home.mkdir()
    with _mounted(home, "-t", "tmpfs", "-o", f"size={TOO_SMALL}", "tmpfs") as is_mounted:
        how = f"a tmpfs of {TOO_SMALL:,} bytes" if is_mounted else "no file may grow (RLIMIT_FSIZE)"
        limit = None if is_mounted else _let_no_file_grow
        runs, lost = [], []
        for before in (False, True):
            for ending in (".svg", ".png", ".geojson"):
                output = home / f"out{ending}"
                if before:
                    output.write_bytes(EARLIER)
                runs.append(wait_for(packwork(folder, *RUN, "-o", str(output), preexec_fn=limit),
                                     WITHIN))  # fmt: skip
                kept = {output.name: EARLIER} if before else {}
                lost += _differences(home, kept, "full disk")
                output.unlink(missing_ok=True)
    return _judged("full disk", how, runs, 2, lost)


def _let_no_file_grow() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (TOO_SMALL, TOO_SMALL))


def _differences(folder: Path, kept: dict[str, bytes], name: str) -> list[str]:
    there = {file.name: file.read_bytes() for file in folder.iterdir()}
    return [] if there == kept else [f"lost: {name}: {sorted(there)} instead of {sorted(kept)}"]


def _read_only(folder: Path) -> Met:
    home = folder / "kept"
    home.mkdir()
    (home / "out.svg").write_bytes(EARLIER)
    ways: list[tuple[str, Callable[[], None], Callable[[], None]]] = [
        ("mounted read-only", lambda: _must("mount", "--bind", "-o", "ro", str(home), str(home)),
         lambda: _must("umount", "--lazy", str(home))),
        ("immutable (chattr +i)", lambda: _must("chattr", "+i", str(home)),
         lambda: _must("chattr", "-i", str(home))),
        ("no right to write (chmod 555)", lambda: home.chmod(0o555), lambda: home.chmod(0o755)),
    ]  # fmt: skip
    if os.geteuid() == 0:
        ways.pop()  # Rights on a folder do not hold root back.
    runs, lost, used = [], [], []
    for name, begin, end in ways:
        try:
            begin()
        except (OSError, subprocess.CalledProcessError):
            continue
        try:
            used.append(name)
            for output in ("out.svg", "new.svg", "deeper/new.png"):
                line = (*RUN, "-o", str(home / output))
                runs.append(wait_for(packwork(folder, *line), WITHIN))
            lost += _differences(home, {"out.svg": EARLIER}, name)
        finally:
            end()
    runs += [
        wait_for(packwork(folder, *RUN, "-o", output), WITHIN)
        for output in ("/proc/out.svg", str(home / "out.svg" / "out.svg"))
    ]
    used += ["/proc", "a file in place of a folder"]
    return _judged("read-only folder", ", ".join(used), runs, 2, lost)


def _must(*command: str) -> None:
    subprocess.run(command, check=True, capture_output=True)


def _no_cache(folder: Path) -> Met:
    """No folder that the kernels could be kept in: they are compiled for this run only."""
    env = environment(NUMBA_CACHE_DIR="/proc/no-such-folder", HOME="/proc/nobody")
    output = folder / "out.svg"
    run = wait_for(packwork(folder, *RUN, "-o", str(output), env=env), WITHIN)
    return _judged("no room for the kernel cache", "NUMBA_CACHE_DIR in /proc", [run], 0, [])


def _closed_terminal(folder: Path) -> Met:
    """Nobody reads what is printed: a closed pipe, a full device."""
    line = [argument for argument in RUN if argument != "-q"]
    output = folder / "out.svg"
    runs = []
    lost = []
    for where in ("pipe", "/dev/full"):
        command = [sys.executable, "-m", "packwork", *line, "-o", str(output)]
        end = open("/dev/full", "wb") if where == "/dev/full" else _closed_pipe()  # noqa: SIM115,PTH123
        done = subprocess.run(
            command, stdout=end, stderr=subprocess.PIPE, text=True, check=False, cwd=folder
        )
        end.close()
        runs.append((done.returncode, "", done.stderr))
        if not output.exists():
            lost.append(f"lost: output to {where}: out.svg is not there")
        output.unlink(missing_ok=True)
    return _judged("nobody reads what is printed", "a closed pipe, /dev/full", runs, 0, lost)


def _closed_pipe() -> IO[bytes]:
    reader, writer = os.pipe()
    os.close(reader)
    return os.fdopen(writer, "wb")


def _crowd(folder: Path) -> Met:
    """Eight runs at once that share an empty kernel cache, all but two into one file."""
    env = environment(NUMBA_CACHE_DIR=str(folder / "cache"))
    names = ["one.svg", "two.svg", *(["same.svg"] * (CROWD - 2))]
    begun = [packwork(folder, *RUN, "-o", name, env=env) for name in names]
    runs = [wait_for(one, WITHIN) for one in begun]
    runs.append(wait_for(packwork(folder, *RUN, "-o", "after.svg", env=env), WITHIN))
    files = {file.name: file.read_bytes() for file in folder.glob("*.svg")}
    lost = []
    if set(files) != {"one.svg", "two.svg", "same.svg", "after.svg"}:
        lost.append(f"lost: 8 runs at once: there are {sorted(files)}")
    if len(set(files.values())) > 1:
        lost.append("lost: 8 runs at once: one seed gave different files")
    return _judged(f"{CROWD} runs at once, then one", "one empty kernel cache", runs, 0, lost)

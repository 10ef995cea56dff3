"""One run of the program in a copy of this process, which has all loaded: what came of it."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, TextIO, TypeAlias

from benchmarks.robustness.hostile.trying import CLEAR_ERROR, CRASH, HANG, SUCCESS

SECONDS_AT_MOST = 60
"""Of the processor, for one run."""

CLOCK_SECONDS = 10 * SECONDS_AT_MOST
"""By the clock, on however busy a machine."""

BYTES_AT_MOST = 1 << 30
"""Memory that one run may hold at a time."""

MOST_LETTERS = 4_000
"""Of a recipe, as it is printed."""

MEASURED = (".svg", ".geojson", ".dxf")
"""Endings of outputs that ``measure`` reads."""

Content: TypeAlias = bytes | Callable[[Path], None]
"""What a file holds, or what writes it: a copy of this process has this process' memory too."""


@dataclass(frozen=True)
class Line:
    """One run: what is typed, the files that lie there, and the terminal's encoding.

    Of one that is painted what its SVG shows is held against its certificate, too.
    """

    number: int
    kind: str
    words: tuple[str, ...]
    files: Mapping[str, Content] = field(default_factory=dict, repr=False)
    encoding: str = "utf-8"
    is_painted: bool = False

    @property
    def key(self) -> str:
        """A word for all of it; of files that are written by a function, its name."""
        files = [
            (name, hashlib.sha256(data).hexdigest() if isinstance(data, bytes) else _name(data))
            for name, data in sorted(self.files.items())
        ]
        whole = repr((self.number, self.words, self.encoding, files))
        return hashlib.sha256(whole.encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Ran:
    """What came of a run: in how many seconds of the processor and bytes, and what was said.

    Parameters
    ----------
    came, seconds, bytes, said
        How it ended, the processor's seconds, the most memory at a time, the last lines.
    lost
        Files that were there before and are not, or that a run wrote that refused.
    untrue
        Files that ``measure`` finds not to keep what their run certified.
    """

    came: str
    seconds: float
    bytes: int
    said: str = ""
    lost: int = 0
    untrue: int = 0

    @property
    def is_fault(self) -> bool:
        return self.came in {CRASH, HANG} or self.lost > 0 or self.untrue > 0


def run_line(line: Line) -> Ran:
    """Run the program in a copy of this process, in a folder of its own, and judge it."""
    with tempfile.TemporaryDirectory() as name:
        folder, said = Path(name, "work"), Path(name, "said")
        folder.mkdir()
        for file, content in line.files.items():
            if isinstance(content, bytes):
                (folder / file).write_bytes(content)
            else:
                _in_a_copy(content, folder / file)
        before = _contents(folder)
        code, seconds, held = _forked(line.words, line.encoding, folder, said)
        after = _contents(folder)
        text = said.read_text(encoding="utf-8", errors="replace") if said.exists() else ""
        untrue = _untrue(line, folder, said) if code in {0, 1} else []
    lost = sum(after.get(file) != data for file, data in before.items())
    lost += len(set(after) - set(before)) if code == 2 else 0
    ran = _judged(code, seconds, held, text, lost)
    return replace(ran, said=" / ".join([ran.said, *untrue]), untrue=len(untrue))


def _name(write: Callable[[Path], None]) -> str:
    """Of a function that may be a partial one, without the place where it lies in memory."""
    if isinstance(write, partial):
        return repr((_name(write.func), write.args))
    return write.__qualname__


def _in_a_copy(write: Callable[[Path], None], path: Path) -> None:
    child = os.fork()
    if child == 0:
        code = 1
        with contextlib.suppress(Exception):
            write(path)
            code = 0
        os._exit(code)
    if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]):
        raise RuntimeError(f"{_name(write)} fails")


def _untrue(line: Line, folder: Path, said: Path) -> list[str]:
    """What is certified by the report of a run, and is not so by the file that it wrote."""
    report = folder / "report.out"
    if not report.exists() or not json.loads(report.read_bytes())["certified"]:
        return []
    names = [name for name in line.words if name.endswith(MEASURED)]
    wrong = []
    for name in dict.fromkeys(names):
        if name in line.files or not (folder / name).exists():
            continue
        said.unlink(missing_ok=True)
        code, _, _ = _forked(("measure", name, "-q"), "utf-8", folder, said)
        if code:
            wrong.append(f"measure {name}: exit code {code}: {said.read_text('utf-8', 'replace')}")
    if line.is_painted:
        painted = json.loads(report.read_bytes())["painted"]
        wrong += [f"{painted[what]} px {what}" for what in ("outside", "double") if painted[what]]
    return wrong


def _forked(
    words: tuple[str, ...], encoding: str, folder: Path, said: Path
) -> tuple[int, float, int]:
    """Exit code, seconds of the processor, most bytes of one run beside those of this process."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    child = os.fork()
    if child == 0:
        _be_the_program(words, encoding, folder, said)
    code, seconds, held = _waited(child)
    # What this process holds, its copy holds from the start: a test runner's may be a gigabyte.
    return code, seconds, max(held - pages * os.sysconf("SC_PAGE_SIZE"), 0)


def _contents(folder: Path) -> dict[str, str]:
    """A word for what each file holds."""
    found = {}
    for path in folder.iterdir():
        with path.open("rb") as file:
            found[path.name] = hashlib.file_digest(file, "sha256").hexdigest()
    return found


def _be_the_program(words: tuple[str, ...], encoding: str, folder: Path, said: Path) -> None:
    """Never come back."""
    from packwork.cli import app

    code = 99
    try:
        os.chdir(folder)
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS_AT_MOST, SECONDS_AT_MOST + 5))
        sys.stdout = _stream(Path(os.devnull), encoding, "strict")
        sys.stderr = _stream(said, encoding, "backslashreplace")
        try:
            app(list(words))
        except SystemExit as end:
            code = int(end.code or 0)
        sys.stdout.flush()
    except BaseException:  # noqa: BLE001 - whatever it is, it is what is looked for
        import traceback

        sys.stderr.write(traceback.format_exc(limit=-8))
    finally:
        with contextlib.suppress(Exception):
            sys.stderr.flush()
        os._exit(code)


def _stream(path: Path, encoding: str, errors: str) -> TextIO:
    return path.open("w", encoding=encoding, errors=errors)


def _waited(child: int) -> tuple[int, float, int]:
    """Exit code (of a signal: minus its number), seconds of the processor, most bytes."""
    deadline = time.monotonic() + CLOCK_SECONDS
    while True:
        ended, status, used = os.wait4(child, os.WNOHANG)
        if ended:
            seconds = used.ru_utime + used.ru_stime
            return os.waitstatus_to_exitcode(status), seconds, used.ru_maxrss * 1024
        if time.monotonic() > deadline:
            os.kill(child, signal.SIGKILL)
            deadline = float("inf")
        time.sleep(0.02)


def _judged(code: int, seconds: float, held: int, text: str, lost: int) -> Ran:
    last = text.strip().splitlines()[-8:]
    if code in {-signal.SIGXCPU, -signal.SIGKILL}:
        return Ran(HANG, seconds, held, f"ended by signal {-code}", lost)
    is_sound = code in {0, 1} or (code == 2 and bool(last) and last[-1].startswith("packwork: "))
    if "Traceback" in text or not is_sound:
        return Ran(CRASH, seconds, held, f"exit code {code}: " + " / ".join(last), lost)
    if held > BYTES_AT_MOST:
        return Ran(CRASH, seconds, held, f"held {held / 1e6:.0f} MB", lost)
    return Ran(CLEAR_ERROR if code == 2 else SUCCESS, seconds, held, " / ".join(last), lost)


def warm_up() -> None:
    """Load what every run needs, so that copies of this process have it.

    No run itself: libraries that it calls begin threads, which a copy of a process lacks.
    """
    import ezdxf  # noqa: F401

    import packwork.cli.running
    import packwork.writers.dxf
    import packwork.writers.pdf  # noqa: F401
    from packwork import precompile
    from packwork.cli.commands import Commands

    for command in Commands().values():
        assert command.name
    precompile.warm_up()


def typed(line: Line) -> dict[str, Any]:
    """A run as it can be repeated."""
    recipe = line.files.get("r.toml")
    said = recipe.decode("utf-8", errors="replace") if isinstance(recipe, bytes) else ""
    return {"words": line.words, "recipe": said[:MOST_LETTERS], "encoding": line.encoding}

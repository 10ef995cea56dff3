"""Runs that are stopped at random moments: Ctrl-C, kill -9."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

READY = "import sys; print('ready', flush=True); from packwork.__main__ import main; main()"
"""What the ``packwork`` script does, after a word that says when Python itself has started."""

ENDS_WITHIN = 60.0
"""Seconds by the clock from Ctrl-C to the end of the program; more is a hang."""

INTERRUPTED = 130
EARLIER = b'<svg xmlns="http://www.w3.org/2000/svg"/>'
"""What stands where the output goes, in every second run."""

RUN = ("fill", "heart", "-n", "60", "--seed", "{seed}", "-o", "out.svg", "-o", "out.png")


@dataclass
class Stopped:
    """What came of runs that were stopped, in the words of the table.

    Parameters
    ----------
    tried, came
        How many there were, and how they ended.
    faults
        What is not as it should be, a sentence each; a crash, a hang or a lost file begins
        with that word.
    longest
        Seconds that the slowest took to end.
    left
        Files with another name than the outputs', which nobody asked for.
    """

    tried: int = 0
    came: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)
    longest: float = 0.0
    left: int = 0


def packwork(folder: Path, *arguments: str, **more: object) -> subprocess.Popen[str]:
    """The program, begun; its first line on standard output is ``ready``."""
    return subprocess.Popen(
        [sys.executable, "-c", READY, *arguments],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more,  # type: ignore[call-overload]
    )  # fmt: skip


def whole_length(arguments: Sequence[str] = RUN) -> float:
    """Seconds that a run takes when nothing stops it, from ``ready`` on."""
    with tempfile.TemporaryDirectory() as folder:
        run = packwork(Path(folder), *_with_seed(arguments, 0))
        assert run.stdout is not None
        run.stdout.readline()
        began = time.monotonic()
        out, err = run.communicate()
        if run.returncode:
            raise RuntimeError(f"the run to be stopped fails by itself: {out}{err}")
        return time.monotonic() - began


def stop_at_random(
    number: signal.Signals, count: int, seed: int, length: float, arguments: Sequence[str] = RUN
) -> Stopped:
    """Begin ``count`` runs, send each a signal at some moment of its ``length``, look at it."""
    rng = np.random.default_rng(seed)
    found = Stopped()
    for k in range(count):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            before = k % 2 == 1
            for output in ("out.svg", "out.png") if before else ():
                (folder / output).write_bytes(EARLIER)
            run = packwork(folder, *_with_seed(arguments, k))
            assert run.stdout is not None
            run.stdout.readline()
            moment = float(rng.uniform(0, 1.05 * length))
            time.sleep(moment)
            run.send_signal(number)
            _look(run, number, folder, before, f"{number.name} after {moment:.3f} s", found)
    return found


def _with_seed(arguments: Sequence[str], seed: int) -> list[str]:
    return [argument.format(seed=seed) for argument in arguments]


def _look(
    run: subprocess.Popen[str], number: signal.Signals, folder: Path, before: bool, when: str,
    found: Stopped,
) -> None:  # fmt: skip
    sent = time.monotonic()
    found.tried += 1
    try:
        _, err = run.communicate(timeout=ENDS_WITHIN)
    except subprocess.TimeoutExpired:
        run.kill()
        run.communicate()
        found.faults.append(f"hang: {when}")
        return
    found.longest = max(found.longest, time.monotonic() - sent)
    code = run.returncode
    said = err.strip().splitlines()
    if "Traceback" in err or code not in {0, 1, INTERRUPTED, -int(number)}:
        found.faults.append(f"crash: {when}: exit code {code}: {' / '.join(said[-6:])}")
    if number == signal.SIGINT and code < 0:
        found.faults.append(f"crash: {when}: it died of the signal")
    states = [_state(folder / output, before) for output in ("out.svg", "out.png")]
    for output, state in zip(("out.svg", "out.png"), states, strict=True):
        if state == "lost":
            found.faults.append(f"lost: {when}: {output} is not whole")
    if code == INTERRUPTED:
        found.faults += _untrue(said, states, when)
    found.left += sum(file.name not in {"out.svg", "out.png"} for file in folder.iterdir())
    found.came[_told(code, states)] += 1


def _state(file: Path, before: bool) -> str:
    """Whether an output is absent, as it was, new and whole, or lost."""
    if not file.exists():
        return "lost" if before else "absent"
    data = file.read_bytes()
    if data == EARLIER:
        return "earlier"
    return "new" if _is_whole(data) else "lost"


def _is_whole(data: bytes) -> bool:
    if data.startswith(b"\x89PNG"):
        return data.endswith(b"IEND\xaeB`\x82")
    try:
        return len(ET.fromstring(data)) > 0  # noqa: S314 - we wrote it
    except ET.ParseError:
        return False


def _untrue(said: Sequence[str], states: Sequence[str], when: str) -> list[str]:
    """What a stopped run said of itself that does not hold."""
    is_written = all(state == "new" for state in states)
    last = said[-1] if said else ""
    if "best so far" in last and not is_written:
        return [f"lost: {when}: said {last!r}, but it is not there"]
    if "best so far" not in last and (is_written or "stopped" not in last):
        return [f"crash: {when}: said {last!r}, but outputs are {', '.join(states)}"]
    return []


def _told(code: int, states: Sequence[str]) -> str:
    if code in {0, 1}:
        return "had ended"
    is_new = all(state == "new" for state in states)
    if code == INTERRUPTED:
        return "best so far written" if is_new else "said that nothing was written"
    return "ended, all written" if is_new else "ended, nothing written"


def wait_for(process: subprocess.Popen[str], seconds: float) -> tuple[int, str, str]:
    """Exit code and what was said; ``hang`` as the code's place is -99."""
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return -99, "", "past the clock"
    return process.returncode, out, err


def environment(**changed: str) -> dict[str, str]:
    """This process' environment, with changes."""
    return {**os.environ, **changed}

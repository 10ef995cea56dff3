"""What breaks it: ``packwork bench robustness [inputs=10000] [stops=40] [processes=2] [seed=0]``.

Gives the program spoilt and made-up files, stops it at random moments with Ctrl-C and with
kill -9, lets it write to full and read-only disks, and runs it eight times at once. Prints
counts; crashes, hangs and lost files must be 0, else it says which inputs they were, puts
those into ``out/robustness`` and ends with code 1. Writes ``docs/benchmarks-robustness.md``
if all 10,000 inputs were tried. ``kinds=fonts,tables`` tries those kinds of input only,
``only=inputs``, ``only=stops`` or ``only=surroundings`` one part. Needs Linux and
``packwork[dev]``.
"""

from __future__ import annotations

import signal
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from hostile.inputs import KINDS, Input, inputs
from hostile.stops import Stopped, stop_at_random, whole_length
from hostile.surroundings import Met, all_surroundings
from hostile.trying import CLEAR_ERROR, CRASH, HANG, SECONDS_AT_MOST, SUCCESS, Tried
from hostile.workers import CLOCK_SECONDS, MEMORY_BYTES, try_all
from measuring import markdown_table, write_page

ENOUGH = 10_000
OUT = Path("out") / "robustness"
HEADER = ["what", "tried", "clear errors", "successes", "crashes", "hangs", "lost files"]

PAGE = """# What breaks it

Made by `packwork bench robustness {settings}` on {date}.
{machine}

| what | tried | clear errors | successes | crashes | hangs | lost files |
| --- | --- | --- | --- | --- | --- | --- |
{rows}

The last three must be 0. A **clear error** is one of Packwork's own: one line that says what is
wrong. Any other exception, a warning of a library, a signal or a traceback is a **crash**. A
**hang** is an input that takes more than {seconds} s of the processor or {clock} s by the
clock, or a run that goes on for a minute after Ctrl-C. A file is **lost** if it is
half-written, if an older one is gone or changed, or if the program says that it wrote one and
did not.

## Inputs

Seven in ten are real files, spoilt by the byte, by the word or by the value: the bundled
drawings, made-up drawings that use every feature, the examples' pictures (shrunk), photos,
fonts (whole, and with a few letters only), tables and texts, recipes, and layouts as they are
saved. Check sums of PNGs are put right afterwards, so that they are let in. The others are
made up by hypothesis: right in form, odd in what they say. Each is read as what it is given
for (an item, a container, a photo, a quiet picture, letters, words, a chart, weights, a
recipe that is begun and stopped, a layout that is measured and written again) in a process
that may take {memory} GiB of address space; the most that one held was {peak} MB.
The slowest input took {slowest} s.

## Stops

`packwork fill heart -n 60` with two outputs, stopped at a random moment of the {length} s
that it takes; in every second run there were older files of those names. {stops} After Ctrl-C
the slowest run took {longest} s to end. {left}

## Surroundings

{surroundings}
"""


@dataclass
class Tally:
    """Counts of one row, and what went wrong."""

    counts: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def row(self, name: str) -> list[str]:
        return [name, *(f"{self.counts[column]:,}" for column in HEADER[1:])]

    def add(self, other: Tally) -> None:
        self.counts += other.counts
        self.faults += other.faults

    def blame(self, faults: Sequence[str]) -> None:
        """Count sentences by the word that they begin with."""
        columns = {"crash": CRASH, "hang": HANG, "lost": "lost files"}
        self.counts.update(columns[fault.partition(":")[0]] for fault in faults)
        self.faults += faults


@dataclass
class Fuzzed:
    """What came of the inputs."""

    rows: dict[str, Tally] = field(default_factory=dict)
    peak_bytes: int = 0
    slowest: float = 0.0

    def take(self, one: Input, tried: Tried, peak: int) -> None:
        tally = self.rows.setdefault(one.kind, Tally())
        tally.counts.update(["tried", tried.came])
        tally.counts["lost files"] += tried.lost
        if tried.came in {CRASH, HANG} or tried.lost:
            tally.faults.append(
                f"{tried.came}: {one.kind} as {one.use}: {_kept(one)}: {tried.said}"
            )
        self.peak_bytes = max(self.peak_bytes, peak)
        self.slowest = max(self.slowest, tried.seconds)


def fuzz(count: int, seed: int, processes: int, kinds: Sequence[str] = ()) -> Fuzzed:
    """Try ``count`` inputs; tell how far it is."""
    found = Fuzzed()
    began = time.monotonic()
    for done, (one, tried, peak) in enumerate(try_all(inputs(count, seed, kinds), processes), 1):
        found.take(one, tried, peak)
        if done % 1_000 == 0:
            print(f"{done:,} inputs, {time.monotonic() - began:.0f} s", flush=True)
    return found


def _kept(one: Input) -> Path:
    """The input as a file that can be tried again."""
    OUT.mkdir(parents=True, exist_ok=True)
    path = OUT / f"{one.number}-{one.use}-{one.name}"
    path.write_bytes(one.data)
    return path


def of_stops(stopped: Stopped) -> Tally:
    tally = Tally(Counter({"tried": stopped.tried}))
    tally.blame(stopped.faults)
    nothing = stopped.came["said that nothing was written"]
    tally.counts[CLEAR_ERROR] = nothing
    tally.counts[SUCCESS] = stopped.came.total() - nothing
    return tally


def of_place(met: Met) -> Tally:
    tally = Tally(Counter({"tried": met.tried, CLEAR_ERROR: met.clear, SUCCESS: met.done}))
    tally.blame(met.faults)
    return tally


def main(arguments: list[str]) -> int:
    """Try all that is asked, print, write the page; 1 if anything broke."""
    asked = dict(argument.split("=", 1) for argument in arguments)
    count, stops = int(asked.get("inputs", ENOUGH)), int(asked.get("stops", 40))
    seed, only = int(asked.get("seed", 0)), asked.get("only", "")
    kinds = asked["kinds"].split(",") if "kinds" in asked else list(KINDS)
    rows: dict[str, Tally] = {}
    fuzzed = Fuzzed()
    if only in {"", "inputs"}:
        fuzzed = fuzz(count, seed, int(asked.get("processes", 2)), kinds)
        rows |= fuzzed.rows
    length, stopped = 0.0, {}
    if only in {"", "stops"}:
        length = min(whole_length() for _ in range(2))
        for name, number in (("Ctrl-C", signal.SIGINT), ("kill -9", signal.SIGKILL)):
            stopped[name] = stop_at_random(number, stops, seed, length)
            rows[name] = of_stops(stopped[name])
    places = list(all_surroundings()) if only in {"", "surroundings"} else []
    rows |= {met.name: of_place(met) for met in places}
    whole = Tally()
    for tally in rows.values():
        whole.add(tally)
    table = [tally.row(name) for name, tally in rows.items()] + [whole.row("all")]
    print(markdown_table(HEADER, table))
    for fault in whole.faults:
        print(fault)
    if count >= ENOUGH and not only and len(kinds) == len(KINDS):
        _write(" ".join(arguments), table, fuzzed, length, stopped, places)
    return int(any(whole.counts[column] for column in HEADER[4:]))


def _write(
    settings: str, table: list[list[str]], fuzzed: Fuzzed, length: float,
    stopped: dict[str, Stopped], places: Sequence[Met],
) -> None:  # fmt: skip
    came = [
        f"{name}: " + ", ".join(f"{number} {how}" for how, number in found.came.most_common()) + "."
        for name, found in stopped.items()
    ]
    left = sum(found.left for found in stopped.values())
    write_page(
        "benchmarks-robustness.md",
        PAGE,
        settings=settings,
        rows="\n".join("| " + " | ".join(row) + " |" for row in table),
        seconds=f"{SECONDS_AT_MOST:g}",
        clock=f"{CLOCK_SECONDS:g}",
        memory=f"{MEMORY_BYTES / 2**30:g}",
        peak=f"{fuzzed.peak_bytes / 1e6:.0f}",
        slowest=f"{fuzzed.slowest:.1f}",
        length=f"{length:.1f}",
        stops=" ".join(came),
        longest=f"{stopped['Ctrl-C'].longest:.1f}",
        left="No file of another name was left behind."
        if not left
        else f"kill -9 left {left} files of other names behind.",
        surroundings="\n".join(f"- {met.name}: {met.how}; {met.tried} runs" for met in places),
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

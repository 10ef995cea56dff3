"""What breaks it: ``packwork bench robustness [inputs=10000] [lines=2000] [stops=40] [seed=0]``.

Gives the program spoilt and made-up files, command lines of odd meaning, fonts, Parquet files and
recipes that ask for much, and names and terminals of every encoding; stops it at random moments
with Ctrl-C and with kill -9, lets it write to full and read-only disks, and runs it eight times at
once. Prints counts; crashes, hangs, lost files and false certificates must be 0, else it says which
they were and ends with code 1. ``only=inputs``, ``only=meaning``, ``only=fonts``, ``only=parquet``,
``only=nested``, ``only=encodings``, ``only=drawings``, ``only=stops`` or ``only=surroundings`` is
one part of it (or some of them, with commas); ``fonts=60 parquet=60 nested=80 encodings=80
drawings=1000`` are the numbers of these. Runs are kept in ``out/robustness`` as they are made: what
is interrupted goes on, and what was a fault is run again. ``only=page`` writes
``docs/benchmarks/robustness.md`` of what is there; once there is every part, with 10,000 inputs and
2,000 lines or more, that happens by itself. ``kinds=fonts,tables`` tries those kinds of input only;
``processes=2`` shares them out. Needs Linux and ``packwork[dev]``.
"""

from __future__ import annotations

import signal
import sys
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import partial
from pathlib import Path

from benchmarks.kit.measuring import markdown_table
from benchmarks.robustness.hostile import (
    drawings,
    encodings,
    fonts,
    meaning,
    nested,
    parquet,
    running,
)
from benchmarks.robustness.hostile.inputs import KINDS, Input, inputs
from benchmarks.robustness.hostile.kept import Kept, run_all
from benchmarks.robustness.hostile.page import PAGE as PAGE
from benchmarks.robustness.hostile.page import write
from benchmarks.robustness.hostile.parts import Part, Tally, state
from benchmarks.robustness.hostile.running import Line
from benchmarks.robustness.hostile.stops import stop_at_random, whole_length
from benchmarks.robustness.hostile.surroundings import all_surroundings
from benchmarks.robustness.hostile.tables import FAULTS, HEADER, table_of
from benchmarks.robustness.hostile.trying import CLEAR_ERROR, CRASH, HANG, SUCCESS
from benchmarks.robustness.hostile.workers import try_all

ENOUGH = 10_000
ENOUGH_LINES = 2_000
OUT = Path("out") / "robustness"

LINES = {
    "meaning": (meaning.lines, ENOUGH_LINES),
    "fonts": (fonts.lines, 60),
    "parquet": (parquet.lines, 60),
    "nested": (nested.lines, 80),
    "encodings": (encodings.lines, 80),
    "drawings": (drawings.lines, 1_000),
}
"""Parts that are runs of lines, and how many there are of them."""


def fuzzed(count: int, seed: int, processes: int, kinds: Sequence[str]) -> Part:
    """Try ``count`` inputs; tell how far it is."""
    part = Part("inputs", facts={"count": count, "peak": 0.0, "slowest": 0.0})
    began = time.monotonic()
    for done, (one, tried, peak) in enumerate(try_all(inputs(count, seed, kinds), processes), 1):
        tally = part.rows.setdefault(one.kind, Tally())
        tally.counts.update(["tried", tried.came])
        tally.counts["lost files"] += tried.lost
        if tried.came in {CRASH, HANG} or tried.lost:
            where = f"{one.kind} as {one.use}: {_kept(one)}"
            tally.faults.append(f"{tried.came}: {where}: {tried.said}")
        part.facts["peak"] = max(part.facts["peak"], peak / 1e6)
        part.facts["slowest"] = max(part.facts["slowest"], tried.seconds)
        if done % 1_000 == 0:
            print(f"{done:,} inputs, {time.monotonic() - began:.0f} s", flush=True)
    return part


def _kept(one: Input) -> Path:
    """The input as a file that can be tried again."""
    OUT.mkdir(parents=True, exist_ok=True)
    path = OUT / f"{one.number}-{one.use}-{one.name}"
    path.write_bytes(one.data)
    return path


def ran(name: str, lines: Iterable[Line], count: int) -> Part:
    """Run lines that were not run before; count what came of all."""
    running.warm_up()
    part = Part(name, facts={"count": count, "peak": 0.0, "slowest": 0.0})
    kept = Kept(OUT / f"{name}.jsonl")
    done: list[Line] = []
    for line, one in run_all(lines, kept):
        done.append(line)
        tally = part.rows.setdefault(line.kind, Tally())
        tally.counts.update(["tried", one.came])
        tally.counts["lost files"] += one.lost
        tally.counts["false certificates"] += one.untrue
        if one.is_fault:
            tally.faults.append(f"{one.came}: {line.number}: {running.typed(line)}: {one.said}")
        part.facts["peak"] = max(part.facts["peak"], one.bytes / 1e6)
        part.facts["slowest"] = max(part.facts["slowest"], one.seconds)
        if len(done) % 100 == 0:
            print(f"{len(done):,} lines of {name}", flush=True)
    keys = {line.key for line in done}
    part.commits = dict(Counter(kept.ran[key][1] for key in keys))
    part.facts["mended"] = sum(
        kept.faults[line.key] > 0 and not kept.ran[line.key][0].is_fault for line in done
    )
    return part


def stopped(count: int, seed: int) -> Part:
    """Stop runs by Ctrl-C, then by kill -9."""
    length = min(whole_length() for _ in range(2))
    part = Part("stops", facts={"length": length})
    for name, number in (("Ctrl-C", signal.SIGINT), ("kill -9", signal.SIGKILL)):
        found = stop_at_random(number, count, seed, length)
        nothing = found.came["said that nothing was written"]
        done = found.came.total() - nothing
        tally = Tally(Counter({"tried": found.tried, CLEAR_ERROR: nothing, SUCCESS: done}))
        tally.blame(found.faults)
        part.rows[name] = tally
        part.facts[name] = dict(found.came)
        part.facts[f"longest, {name}"] = found.longest
        part.facts[f"left, {name}"] = found.left
    return part


def surrounded() -> Part:
    """Run in places that do not let the program work."""
    part = Part("surroundings")
    for met in all_surroundings():
        tally = Tally(Counter({"tried": met.tried, CLEAR_ERROR: met.clear, SUCCESS: met.done}))
        tally.blame(met.faults)
        part.rows[met.name] = tally
        part.facts[met.name] = f"{met.how}; {met.tried} runs"
    return part


def main(arguments: list[str]) -> int:
    """Try all that is asked, print; write the page if all is there. 1 if anything broke."""
    asked = dict(argument.split("=", 1) for argument in arguments)
    seed, kinds = int(asked.get("seed", 0)), asked.get("kinds", ",".join(KINDS)).split(",")
    count, processes = int(asked.get("inputs", ENOUGH)), int(asked.get("processes", 2))
    makers = {"inputs": lambda: fuzzed(count, seed, processes, kinds)}
    for name, (lines, most) in LINES.items():
        number = int(asked.get("lines" if name == "meaning" else name, most))
        makers[name] = partial(ran, name, lines(number, seed), number)
    makers["stops"] = lambda: stopped(int(asked.get("stops", 40)), seed)
    makers["surroundings"] = surrounded
    chosen = asked["only"].split(",") if "only" in asked else list(makers)
    done = []
    for name in [name for name in chosen if name != "page"]:
        part = makers[name]()
        part.settings = " ".join(arguments)
        part.commits = part.commits or {state(): sum(t.counts["tried"] for t in part.rows.values())}
        part.save(OUT)
        done.append(part)
    table, whole = table_of(done)
    print(markdown_table(HEADER, table))
    for fault in whole.faults:
        print(fault)
    parts = {name: part for name in makers if (part := Part.load(OUT, name))}
    is_whole = (
        len(parts) == len(makers)
        and parts["inputs"].facts["count"] >= ENOUGH
        and parts["meaning"].facts["count"] >= ENOUGH_LINES
        and len(kinds) == len(KINDS)
    )
    if is_whole or "page" in chosen:
        write(parts)
    return int(any(whole.counts[column] for column in FAULTS))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""What breaks it: ``packwork bench robustness [inputs=10000] [lines=2000] [stops=40] [seed=0]``.

Gives the program spoilt and made-up files and command lines of odd meaning, stops it at random
moments with Ctrl-C and with kill -9, lets it write to full and read-only disks, and runs it eight
times at once. Prints counts; crashes, hangs and lost files must be 0, else it says which inputs
they were, puts those into ``out/robustness`` and ends with code 1. ``only=inputs``,
``only=meaning``, ``only=stops`` or ``only=surroundings`` is one part of it; once there are all four
of one and the same code, with 10,000 inputs and 2,000 lines or more,
``docs/benchmarks-robustness.md`` is written. ``kinds=fonts,tables`` tries those kinds of input
only; ``processes=2`` shares them out. Needs Linux and ``packwork[dev]``.
"""

from __future__ import annotations

import signal
import sys
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from hostile import meaning, running
from hostile.inputs import KINDS, Input, inputs
from hostile.kept import Kept, run_all
from hostile.parts import Part, Tally
from hostile.running import Line
from hostile.stops import stop_at_random, whole_length
from hostile.surroundings import all_surroundings
from hostile.trying import CLEAR_ERROR, CRASH, HANG, SECONDS_AT_MOST, SUCCESS
from hostile.workers import CLOCK_SECONDS, MEMORY_BYTES, try_all
from manifests import write_page
from measuring import markdown_table

ENOUGH = 10_000
ENOUGH_LINES = 2_000
OUT = Path("out") / "robustness"
HEADER = ["what", "tried", "clear errors", "successes", "crashes", "hangs", "lost files",
          "false certificates"]  # fmt: skip

PAGE = """# What breaks it

Made by {settings} on {date}.
{machine}

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

{meaning}

## Stops

`packwork fill heart -n 60` with two outputs, stopped at a random moment of the {length} s
that it takes; in every second run there were older files of those names. {stops} After Ctrl-C
the slowest run took {longest} s to end. {left}

## Surroundings

{surroundings}
"""


MEANING = """## Meaning

Command lines and recipes that are right in form: any options together, tiny and huge canvases,
one to three items, paddings that leave no room, tables in tables, terminals that lack letters.
A run that takes more than {seconds} s of the processor is a hang, one that holds more than
{memory} GiB, or that refuses and writes something all the same, a crash or a lost file. The
slowest took {slowest} s, the most that one held was {peak} MB."""


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


def meant(count: int, seed: int) -> Part:
    """Run ``count`` lines of odd meaning."""
    return ran("meaning", meaning.lines(count, seed), count)


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
    part.facts["commits"] = Counter(kept.ran[key][1] for key in keys)
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
    makers = {
        "inputs": lambda: fuzzed(count, seed, processes, kinds),
        "meaning": lambda: meant(int(asked.get("lines", ENOUGH_LINES)), seed),
        "stops": lambda: stopped(int(asked.get("stops", 40)), seed),
        "surroundings": surrounded,
    }
    chosen = asked["only"].split(",") if "only" in asked else list(makers)
    done = []
    for name in chosen:
        part = makers[name]()
        part.settings = " ".join(arguments)
        part.save(OUT)
        done.append(part)
    table, whole = _table(done)
    print(markdown_table(HEADER, table))
    for fault in whole.faults:
        print(fault)
    parts = {name: Part.load(OUT, name) for name in makers}
    if (
        all(parts.values())
        and parts["inputs"].facts["count"] >= ENOUGH
        and parts["meaning"].facts["count"] >= ENOUGH_LINES
        and len(kinds) == len(KINDS)
    ):
        _write(parts)
    return int(any(whole.counts[column] for column in HEADER[4:]))


def _table(parts: Iterable[Part]) -> tuple[list[list[str]], Tally]:
    rows = [(name, tally) for part in parts for name, tally in part.rows.items()]
    whole = Tally()
    for _, tally in rows:
        whole.add(tally)
    named = [*rows, ("all", whole)]
    return [[name, *(f"{tally.counts[c]:,}" for c in HEADER[1:])] for name, tally in named], whole


def _write(parts: dict[str, Part]) -> None:
    stops = parts["stops"].facts
    came = [
        f"{name}: " + ", ".join(f"{number} {how}" for how, number in stops[name].items()) + "."
        for name in ("Ctrl-C", "kill -9")
    ]
    left = stops["left, Ctrl-C"] + stops["left, kill -9"]
    command = "packwork bench robustness "
    settings = sorted({f"`{(command + part.settings).strip()}`" for part in parts.values()})
    write_page(
        "benchmarks-robustness.md",
        PAGE,
        settings=" and ".join(settings),
        rows=markdown_table(HEADER, _table(parts.values())[0]),
        seconds=f"{SECONDS_AT_MOST:g}",
        clock=f"{CLOCK_SECONDS:g}",
        memory=f"{MEMORY_BYTES / 2**30:g}",
        peak=f"{parts['inputs'].facts['peak']:.0f}",
        slowest=f"{parts['inputs'].facts['slowest']:.1f}",
        meaning=MEANING.format(
            seconds=running.SECONDS_AT_MOST,
            memory=f"{running.BYTES_AT_MOST / 2**30:g}",
            peak=f"{parts['meaning'].facts['peak']:.0f}",
            slowest=f"{parts['meaning'].facts['slowest']:.1f}",
        ),
        length=f"{stops['length']:.1f}",
        stops=" ".join(came),
        longest=f"{stops['longest, Ctrl-C']:.1f}",
        left="No file of another name was left behind."
        if not left
        else f"Files of other names that were left behind: {left}.",
        surroundings="\n".join(f"- {k}: {said}" for k, said in parts["surroundings"].facts.items()),
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""The page that tells what came of all parts, each with the code that it was run with."""

from __future__ import annotations

from collections.abc import Mapping

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from benchmarks.robustness.hostile.parts import Part
from benchmarks.robustness.hostile.running import BYTES_AT_MOST
from benchmarks.robustness.hostile.running import SECONDS_AT_MOST as LINE_SECONDS
from benchmarks.robustness.hostile.tables import HEADER, table_of
from benchmarks.robustness.hostile.trying import SECONDS_AT_MOST
from benchmarks.robustness.hostile.workers import CLOCK_SECONDS, MEMORY_BYTES

PAGE = """# What breaks it

Made on {date}, part by part:

{settings}

{machine}

{rows}

The last four must be 0. A **clear error** is one of Packwork's own: one line that says what is
wrong. Any other exception, a warning of a library, a signal or a traceback is a **crash**. A
**hang** is an input that takes more than {seconds} s of the processor or {clock} s by the
clock, or a run that goes on for a minute after Ctrl-C. A file is **lost** if it is
half-written, if an older one is gone or changed, or if the program says that it wrote one and
did not. A certificate is **false** if a run says that it certified its layout, and `packwork
measure` refuses the file that it wrote.

## Inputs

{inputs}

## Meaning

Command lines and recipes that are right in form: any options together, tiny and huge canvases,
one to three items, paddings that leave no room, tables in tables, terminals that lack letters.
{meaning}

## Fonts

Programs that call programs that call programs, glyphs made of glyphs or of themselves, scribbles of
60,000 points, curves that lead far off, glyphs huge or nothing beside their font's size.
{fonts}

## Parquet

One long text in a million rows, millions of rows of nothing, columns that are a thousand times
larger unpacked, accounts of sizes that are not so, lists in lists, spoilt notes of pandas and
Arrow.
{parquet}

## Nested recipes

Lists and tables 50,000 deep, keys of 100,000 parts, numbers of 100,000 digits, parts of other
commands with odd values, spoilt files.
{nested}

## Encodings

Drawings, tables, texts and recipes in twelve encodings, said rightly, wrongly or not at all; names
of other scripts; terminals in cp932, cp936, cp1251, ASCII, Latin-1 and UTF-8.
{encodings}

## Drawings

Clips, viewports, symbols, patterns, filters, markers, shapes beside the page, texts, long corners
and dashes, moved and turned anywhere, one to four in a drawing, on canvases in px and mm,
stretched, cut, written in full. Each is filled into a shape, measured, and painted: a certificate
is false also if its SVG paints a pixel outside, or one of two items.
{drawings}

## Stops

{stops}

## Surroundings

{surroundings}
"""

INPUTS = """Seven in ten are real files, spoilt by the byte, by the word or by the value: the
bundled drawings, made-up drawings that use every feature, the examples' pictures (shrunk), photos,
fonts (whole, and with a few letters only), tables and texts, recipes, and layouts as they are
saved. Check sums of PNGs are put right afterwards, so that they are let in. The others are
made up by hypothesis: right in form, odd in what they say. Each is read as what it is given
for (an item, a container, a photo, a quiet picture, letters, words, a chart, weights, a
recipe that is begun and stopped, a layout that is measured and written again) in a process
that may take {memory} GiB of address space; the most that one held was {peak} MB.
The slowest input took {slowest} s."""

RUNS = """Each is a whole run of the program. One that takes more than {seconds} s of the processor
is a hang, one that holds more than {memory} GiB a crash, one that refuses and writes something
all the same has a lost file. The slowest took {slowest} s, the most that one held was {peak}
MB.{mended}"""

STOPS = """`packwork fill heart -n 60` with two outputs, stopped at a random moment of the {length}
s that it takes; in every second run there were older files of those names. {stops} After Ctrl-C
the slowest run took {longest} s to end. {left}"""

NOT_YET = "Not yet measured: `packwork bench robustness only={name}`."


def write(parts: Mapping[str, Part]) -> None:
    """Page and manifest of the parts that there are."""
    told = {
        "inputs": _inputs, "meaning": _runs, "fonts": _runs, "parquet": _runs, "nested": _runs,
        "encodings": _runs, "drawings": _runs, "stops": _stops, "surroundings": _surroundings,
    }  # fmt: skip
    sections = {
        name: tell(parts[name]) if name in parts else NOT_YET.format(name=name)
        for name, tell in told.items()
    }
    write_page(
        "robustness.md",
        PAGE,
        settings="\n".join(map(_how, parts.values())),
        rows=markdown_table(HEADER, table_of(parts.values())[0]),
        seconds=f"{SECONDS_AT_MOST:g}",
        clock=f"{CLOCK_SECONDS:g}",
        **sections,
    )


def _how(part: Part) -> str:
    command = f"packwork bench robustness {part.settings}".strip()
    commits = ", ".join(f"{count:,} at {name}" for name, count in part.commits.items())
    return f"- {part.name}: `{command}` ({commits})"


def _inputs(part: Part) -> str:
    return INPUTS.format(
        memory=f"{MEMORY_BYTES / 2**30:g}",
        peak=f"{part.facts['peak']:.0f}",
        slowest=f"{part.facts['slowest']:.1f}",
    )


def _runs(part: Part) -> str:
    mended = part.facts["mended"]
    was = " was a fault at first; it was" if mended == 1 else " were faults at first; they were"
    return RUNS.format(
        seconds=LINE_SECONDS,
        memory=f"{BYTES_AT_MOST / 2**30:g}",
        peak=f"{part.facts['peak']:.0f}",
        slowest=f"{part.facts['slowest']:.1f}",
        mended=f" Of these runs {mended}{was} run again once the program was mended."
        if mended
        else "",
    )


def _stops(part: Part) -> str:
    facts = part.facts
    came = [
        f"{name}: " + ", ".join(f"{number} {how}" for how, number in facts[name].items()) + "."
        for name in ("Ctrl-C", "kill -9")
    ]
    left = facts["left, Ctrl-C"] + facts["left, kill -9"]
    return STOPS.format(
        length=f"{facts['length']:.1f}",
        stops=" ".join(came),
        longest=f"{facts['longest, Ctrl-C']:.1f}",
        left="No file of another name was left behind."
        if not left
        else f"Files of other names that were left behind: {left}.",
    )


def _surroundings(part: Part) -> str:
    return "\n".join(f"- {name}: {said}" for name, said in part.facts.items())

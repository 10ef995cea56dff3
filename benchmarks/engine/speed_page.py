"""docs/benchmarks/speed.md: two checkouts in turn, of the manifest alone."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from benchmarks.kit.manifests import Manifest
from benchmarks.kit.measuring import markdown_table, ranged

HEAD = """# Speed, beside an earlier version

Made by `packwork bench speed --against PATH`: two checkouts, by the last commit that changed the
package, `here` {here}, `before` {before}."""

WHOLE_RUNS = """

Row by row; the table of circumstances says when and with which load. Two checkouts run the same
command in turn, A B A B ..., a process each. Medians; the clock with its least and most. Kernels
are compiled before, but for `first`. {machine}.

{table}

- `draft`, `normal`, `one` (thread), `best`: `packwork fill builtin:bear -n 100`, by effort or with
  `--threads 1`; `1000`, `10000`: as many items; `first`: the same as `normal` with an empty cache,
  so that all kernels are compiled and all drawings read.
- `epochs`: 200 epochs on levels of 50, 200 and 600 px, no finish; start and levels are its work.
- `round`, `round1000`: so many circles of lognormal sizes packed round each other, from Python.
- Processor: of all threads and of the second process of a first run. Peak: of memory. The clock
  beyond the stages is the rest: Python, files, the end of the process. A dash: not known there.

## By stage

Seconds by the clock, medians. LC: share of the container that is covered. L-nU: mean squared
distance of what is bare to the nearest item; both of the one seed that is timed here.

{stages}"""

FLOOR = """

## An epoch beside the bytes that it moves

100 icons, {px} px, no evenness, processor; the floor is a copy of as many bytes, in turn.

{floors}"""

FUNCTIONS = """

## Where the time goes

`packwork fill builtin:bear -n 100 -q` by one thread under Python's profiler (`packwork bench
profiled`): seconds in each function alone, with imports; a kernel counts as one function. The
profiler makes Python's own functions slower, kernels not. {profile}"""

CIRCUMSTANCES = """

## Circumstances

Where the load at a row's beginning is well above 0, others used the machine: then the two codes and
seconds of the processor compare, seconds by the clock are longer than on a calm one, and threads
find no free core.

{circumstances}"""

HEADER = [
    "row", "code", "clock", "processor", "peak", "start-up", "read", "start", "levels", "finish",
    "measure", "write", "LC", "LnU",
]  # fmt: skip

FLOOR_PX = 600

CODES = ("here", "before")


def cells_of(name: str, taken: Sequence[Sequence[Manifest]]) -> list[list[str]]:
    """Lines of what is printed for one row: this checkout's, and the other's."""
    return [
        [
            name,
            code,
            *(_middle(samples, key, ".2f" if key != "LC" else ".4f") for key in HEADER[2:]),
        ]
        for code, samples in zip(CODES, taken, strict=False)
    ]


def page(manifest: Manifest) -> str:
    """Text of the page: the parts that were measured; empty where none was."""
    rows = manifest["sections"]
    timed = {name: row["runs"] for name, row in rows.items() if name != "floor"}
    parts = []
    if timed:
        machine = " ".join({row["machine"].replace("; one thread", "") for row in rows.values()})
        runs = {"table": _table(timed), "stages": _stages(timed)}
        parts.append(WHOLE_RUNS.format(machine=machine, **runs))
    if "floor" in rows:
        parts.append(FLOOR.format(px=FLOOR_PX, floors=_floors(rows["floor"]["runs"])))
    if manifest.get("profile"):
        parts.append(FUNCTIONS.format(profile=_profile(manifest["profile"])))
    if rows:
        parts.append(CIRCUMSTANCES.format(circumstances=_circumstances(rows)))
    here, before = manifest["sources"]
    return HEAD.format(here=here, before=before) + "".join(parts) + "\n" if parts else ""


def _middle(samples: Sequence[Manifest], key: str, form: str = ".2f") -> str:
    values = [one[key] for one in samples if one.get(key) is not None]
    return f"{np.median(values):{form}}" if values else "-"


def _table(timed: dict[str, list[list[Manifest]]]) -> str:
    lines = []
    for name, taken in timed.items():
        for code, samples in zip(CODES, taken, strict=True):
            clock = ranged([one["clock"] for one in samples], ".2f") if samples else "-"
            of = _middle(samples, "processor"), _middle(samples, "peak", ".0f")
            lines.append([name, code, str(len(samples)), clock, *of, _ratio(taken, code)])
    header = ["row", "code", "runs", "clock, s", "processor, s", "peak, MiB", "here / before"]
    return markdown_table(header, lines)


def _ratio(taken: list[list[Manifest]], code: str) -> str:
    """Medians by the clock over each other, on the line of this checkout."""
    if code != CODES[0] or not all(taken):
        return ""
    here, before = (np.median([one["clock"] for one in samples]) for samples in taken)
    return f"{here / before:.2f}"


def _stages(timed: dict[str, list[list[Manifest]]]) -> str:
    keys = ("start-up", "read", "start", "levels", "finish", "measure", "write")
    lines = []
    for name, taken in timed.items():
        for code, samples in zip(CODES, taken, strict=True):
            rest = [
                {"rest": one["clock"] - sum(one.get(key, 0.0) for key in keys)} for one in samples
            ]
            cells = [_middle(samples, key) for key in keys]
            quality = _middle(samples, "LC", ".4f"), _middle(samples, "LnU")
            lines.append([name, code, *cells, _middle(rest, "rest"), *quality])
    return markdown_table(["row", "code", *keys, "rest", "LC", "L-nU"], lines)


def _floors(runs: list[list[Manifest]]) -> str:
    lines = []
    for code, samples in zip(CODES, runs, strict=True):
        over = [{"over": one["epoch_ms"] / one["floor_ms"]} for one in samples]
        of = (_middle(samples, key, ".3f") for key in ("epoch_ms", "floor_ms"))
        lines.append([code, *of, _middle(over, "over")])
    return markdown_table(["code", "epoch, ms", "floor, ms", "epoch over floor"], lines)


def _profile(profile: Manifest) -> str:
    tables = [
        f"{code.capitalize()}:\n\n{markdown_table(['function', 's'], rows)}"
        for code, rows in zip(CODES, profile["runs"], strict=True)
    ]
    return f"Load afterwards: {profile['load'][0]:.1f}.\n\n" + "\n\n".join(tables)


def _circumstances(rows: Manifest) -> str:
    lines = [
        [name, row["date"], f"{row['load'][0]:.1f}", str(row["cores"]), f"`{row['command']}`"]
        for name, row in rows.items()
    ]
    table = markdown_table(["row", "date", "load at its beginning", "cores", "command"], lines)
    remarks = [f"\n- `{name}`: {row['remark']}" for name, row in rows.items() if "remark" in row]
    return table + "\n" * bool(remarks) + "".join(remarks)

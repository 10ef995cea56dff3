"""The studio: ``packwork bench studio`` prints and writes docs/benchmarks/studio.md.

A server of its own and a Chromium without a window, in which drags are made: how long until a first
layout flows, how fast neighbours answer, how many frames are drawn, how soon it is certified; what
crashes of the server, messages gone wrong and long work do. ``drags=N``, ``gestures=N``,
``messages=N`` and ``minutes=N`` measure other numbers. Rates of frames are compared with those of
the manifest that is there: a fall of more than a tenth is said, and the command fails.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "tests"))

from benchmarks.kit.manifests import (
    FOLDER,
    blocks_of,
    of_parts,
    read_manifest,
    stamp,
    write_manifest,
    write_text,
)
from benchmarks.kit.measuring import markdown_table
from benchmarks.studio.drags import SECONDS, dragging, first_layout
from benchmarks.studio.enduring import crashes, density, malformed, memory

ASKED = {"drags": 12.0, "gestures": 1_000.0, "messages": 10_000.0, "minutes": 10.0}

FALL = 0.1
"""Share by which a rate of frames may fall."""

PAGE = """# The studio

Made by `packwork bench studio` on {date}.
{machine}.

In Chromium without a window and without a graphics processor, 1,440 x 900 px: drawing and solving
share the processor's cores. A drag is {seconds} s long, its pointer moves 60 times a second.
{load}

{table}

Rates of frames are kept in [the manifest](../manifests/studio.json); a run of which one is lower by
more than a tenth says so.

{falls}
"""


def main() -> None:
    """Measure, print, write; fail where frames have become fewer."""
    words = dict(word.split("=") for word in sys.argv[1:])
    asked = {**ASKED, **{key: float(value) for key, value in words.items()}}
    before = read_manifest("studio") if (FOLDER / "studio.json").exists() else {}
    loads = [os.getloadavg()[0]]
    rows, rates = measured({key: int(value) for key, value in asked.items()}, asked["minutes"])
    loads.append(os.getloadavg()[0])
    known = before.get("rates", {})
    fallen = falls(known, rates)
    load = (
        f"{loads[0]:.1f} programs wanted a core when it began and {loads[1]:.1f} when it ended,"
        f" of {os.cpu_count()} cores; the bench itself wants two to three."
    )
    parts = {
        "seconds": f"{SECONDS:g}",
        "load": load,
        "table": markdown_table(["what", "measured", "to reach"], rows),
        "falls": "\n".join(fallen) or "None has fallen.",
    }
    manifest = {
        **stamp(),
        "rates": baselines(known, rates),
        "parts": {k: blocks_of(v) for k, v in parts.items()},
    }
    print("\n".join(parts.values()))
    write_text("studio.md", of_parts(PAGE, write_manifest("studio", manifest)))
    if fallen:
        raise SystemExit("\n".join(fallen))


def measured(asked: dict[str, int], minutes: float) -> tuple[list[list[str]], dict[str, float]]:
    """Rows of the table, and rates of frames by name."""
    from studio.browsing import chromium

    with chromium() as browser:
        rows = [first_layout(browser)]
        rates: dict[str, float] = {}
        few = max(asked["drags"] // 3, 2)
        for count, drags in ((100, asked["drags"]), (300, few), (1_000, few)):
            more, found = dragging(browser, count, drags)
            rows, rates = [*rows, *more], {**rates, **found}
            print(more, flush=True)
        rows.append(density(browser, max(asked["gestures"] // 10, 1)))
        rows.append(crashes(browser, asked["gestures"]))
        print(rows[-2:], flush=True)
        if minutes > 0:
            rows.append(memory(browser, minutes))
    rows += malformed(asked["messages"])
    return rows, rates


def baselines(before: dict[str, float], now: dict[str, float]) -> dict[str, float]:
    """Rates that the next run is held against: one that has fallen too far stays as it was.

    Examples
    --------
    >>> baselines({"drawn": 60.0, "poses": 30.0}, {"drawn": 40.0, "poses": 29.0})
    {'drawn': 60.0, 'poses': 29.0}
    """
    return {
        name: before[name] if falls(before, {name: rate}) else rate for name, rate in now.items()
    }


def falls(before: dict[str, float], now: dict[str, float]) -> list[str]:
    """A line for each rate that has fallen too far.

    Examples
    --------
    >>> falls({"drawn, 100": 60.0, "poses, 100": 30.0}, {"drawn, 100": 50.0, "poses, 100": 29.0})
    ['frames drawn, 100: 50 a second, 60 before']
    """
    return [
        f"frames {name}: {now[name]:.0f} a second, {rate:.0f} before"
        for name, rate in before.items()
        if name in now and now[name] < (1 - FALL) * rate
    ]


if __name__ == "__main__":
    main()

"""Where one run spends its time, function by function: ``packwork bench profiled``.

A fill of 100 icons under Python's profiler, imports taken in; the dearest functions by the time in
them alone, written as JSON where a path is given first. A kernel counts as one function.
"""

from __future__ import annotations

import cProfile
import json
import pstats
import re
import sys
import tempfile
from pathlib import Path

FILL = ("fill", "builtin:bear", "-n", "100", "-q")

MOST = 22
"""Functions that are named; the others are one line."""


def profiled(words: list[str]) -> list[list[str]]:
    """Functions and seconds in them alone, dearest first, then the rest and the whole."""
    from packwork.__main__ import main

    profile = cProfile.Profile()
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = ["packwork", *words, "-o", str(Path(folder) / "a.svg")]
        profile.enable()
        try:
            main()
        except SystemExit:
            pass
        finally:
            profile.disable()
    own: dict[str, float] = {}
    for (file, _, function), (_, _, seconds, _, _) in pstats.Stats(profile).stats.items():  # type: ignore[attr-defined]
        name = _named(file, function)
        own[name] = own.get(name, 0.0) + seconds
    dearest = sorted(own, key=lambda name: -own[name])[:MOST]
    total, named = sum(own.values()), sum(own[name] for name in dearest)
    rows = [[f"`{name}`", own[name]] for name in dearest]
    rows += [[f"{len(own) - MOST:,} others", total - named], ["all", total]]
    return [[str(name), f"{float(seconds):.3f}"] for name, seconds in rows]


def _named(file: str, function: str) -> str:
    """A function by its module."""
    place = Path(file)
    if place.suffix != ".py":
        return re.sub(r" at 0x\w+", "", function.strip("<>").replace("built-in method ", ""))
    parts = place.with_suffix("").parts
    for root in ("site-packages", "src"):
        if root in parts:
            parts = parts[parts.index(root) + 1 :]
            return f"{'.'.join(parts)}.{function}"
    return f"{place.stem}.{function}"


def main(words: list[str]) -> None:
    """Profile and write, or print."""
    report = Path(words[0]) if words else None
    rows = profiled(words[1:] or list(FILL))
    if report is not None:
        report.write_text(json.dumps(rows), encoding="utf-8")
    else:
        print("\n".join(" ".join(row) for row in rows))


if __name__ == "__main__":
    main(sys.argv[1:])

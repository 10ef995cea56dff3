"""What came of runs, as rows of one table."""

from __future__ import annotations

from collections.abc import Iterable

from benchmarks.robustness.hostile.parts import Part, Tally

HEADER = ["what", "tried", "clear errors", "successes", "crashes", "hangs", "lost files",
          "false certificates"]  # fmt: skip
FAULTS = HEADER[4:]
TITLES = {
    ("meaning", "command lines"): "command lines of odd meaning",
    ("meaning", "recipes"): "recipes of odd meaning",
    ("fonts", "fonts"): "fonts that ask for much",
}
"""Rows of parts by names that no other part has."""


def table_of(parts: Iterable[Part]) -> tuple[list[list[str]], Tally]:
    """Rows of all parts, the last of all together, and that one as counts."""
    rows = [
        (TITLES.get((part.name, name), name), tally)
        for part in parts
        for name, tally in part.rows.items()
    ]
    whole = Tally()
    for _, tally in rows:
        whole.add(tally)
    named = [*rows, ("all", whole)]
    return [[name, *(f"{tally.counts[c]:,}" for c in HEADER[1:])] for name, tally in named], whole

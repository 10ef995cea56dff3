"""What came of runs, as rows of one table."""

from __future__ import annotations

from collections.abc import Iterable

from hostile.parts import Part, Tally

HEADER = ["what", "tried", "clear errors", "successes", "crashes", "hangs", "lost files",
          "false certificates"]  # fmt: skip
FAULTS = HEADER[4:]


def table_of(parts: Iterable[Part]) -> tuple[list[list[str]], Tally]:
    """Rows of all parts, the last of all together, and that one as counts."""
    rows = [(name, tally) for part in parts for name, tally in part.rows.items()]
    whole = Tally()
    for _, tally in rows:
        whole.add(tally)
    named = [*rows, ("all", whole)]
    return [[name, *(f"{tally.counts[c]:,}" for c in HEADER[1:])] for name, tally in named], whole

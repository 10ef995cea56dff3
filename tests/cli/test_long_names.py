"""Names that no disk takes, wherever a file may be named: one line, exit code 2."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from typer.testing import Result

Command = Callable[..., Result]

LINES = [
    "fill NAME", "fill NAME star -n 2", "fill heart NAME -n 2", "fill circle NAME/a.svg",
    "fill circle NAME*.svg", "fill heart star -n 2 --filler NAME",
    "fill heart star -n 2 --weights NAME", "fill text:A star --font NAME",
    "fill circle star --start NAME.geojson", "fill around:NAME star",
    "fill circle star -o NAME.svg", "fill circle star --report NAME", "photos heart NAME",
    "photos circle star --shape NAME", "words heart NAME", "words circle NAME.txt",
    "words heart oxen:2 --font NAME", "words heart oxen:2 --add NAME",
    "words heart oxen:2 --stopwords NAME", "chart circle NAME", "pile heart NAME",
    "pile square star --emit NAME", "run NAME", "measure NAME", "demo NAME",
]  # fmt: skip


@pytest.mark.parametrize("line", LINES)
def test_a_name_that_no_disk_takes_is_one_line(packwork: Command, line: str) -> None:
    is_whole = line.endswith("NAME") or "NAME " in line
    for letters in (300, 5_000):
        for ending in ("", ".svg", ".jpg", ".csv") if is_whole else ("",):
            result = packwork(line.replace("NAME", "n" * letters + ending))
            said = (letters, ending, result.stderr)
            assert result.exit_code == 2, said
            assert result.stderr.count("\n") == 1, said

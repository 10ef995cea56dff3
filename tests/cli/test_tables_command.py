"""Tables on the command line: what is asked, what is told, the exit code."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--effort draft --levels 50 --epochs 20 -q"


def test_rows_with_data_that_are_left_out_end_in_exit_code_1(
    packwork: Command, tmp_path: Path
) -> None:
    table, report = tmp_path / "t.csv", tmp_path / "r.json"
    table.write_text("Land;Menge\nA;1,5\nB;2\nC;\nD;viele\n", encoding="utf-8")
    run = f"chart circle {table} --size-by Menge --label-by Land {QUICK} -o {tmp_path}/a.svg"
    assert packwork(f"{run} --report {report}").exit_code == 1
    found = json.loads(report.read_text(encoding="utf-8"))
    assert found["certified"]
    assert any("whose Menge is no number: D" in text for text in found["skipped"])
    table.write_text("Land;Menge\nA;1,5\nB;2\nC;\n", encoding="utf-8")
    assert packwork(run).exit_code == 0


def test_what_may_be_read_in_two_ways_is_asked_and_the_answer_taken(
    packwork: Command, tmp_path: Path
) -> None:
    table = tmp_path / "t.csv"
    table.write_text("Land;Menge\nA;1.200\nB;2.400\n", encoding="utf-8")
    for command in ("chart circle {} --size-by Menge", "words circle {}"):
        run = f"{command.format(table)} {QUICK} -o {tmp_path}/a.svg"
        asked = packwork(run)
        assert asked.exit_code == 2
        assert "may be 1.2 or 1,200; say what parts the fraction" in asked.stderr
        assert not (tmp_path / "a.svg").exists()
        assert packwork(f"{run} --decimal ,").exit_code == 0
        (tmp_path / "a.svg").unlink()

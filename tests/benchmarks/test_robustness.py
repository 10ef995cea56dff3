"""The short form of ``packwork bench robustness``, and that it sees what it looks for."""

from __future__ import annotations

import os
import signal
import time
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from benchmarks.robustness import robustness
from benchmarks.robustness.hostile import kept, meaning, page, running, trying, workers
from benchmarks.robustness.hostile.inputs import KINDS, Input, inputs
from benchmarks.robustness.hostile.parts import Part, Tally, state
from benchmarks.robustness.hostile.stops import stop_at_random
from benchmarks.robustness.hostile.trying import CLEAR_ERROR, CRASH, HANG, SUCCESS, attempt
from packwork.errors import ReadError

INPUTS = 150
LINES = 6
DEMANDS = {"fonts": (3, 3), "parquet": (9, 39), "nested": (3, 3), "encodings": (3, 3),
           "drawings": (4, 0)}  # fmt: skip
"""How many lines of each other part, by which seed: of the Parquet files one of each sort, two of
them too large once they are read, and none that takes half a minute to make."""

pytestmark = pytest.mark.skipif(os.name == "nt", reason="alarms and limits are those of Unix")


@pytest.mark.parametrize("kind", KINDS)
def test_spoilt_and_made_up_files_are_read_or_refused(kind: str, tmp_path: Path) -> None:
    lot = list(inputs(round(INPUTS * KINDS[kind].share), 1, [kind]))
    tried = [(one, attempt(one, tmp_path)) for one in lot]
    broken = [(one, came) for one, came in tried if came.came in {CRASH, HANG} or came.lost]
    assert not broken, broken[0]
    assert {came.came for _, came in tried} == {CLEAR_ERROR, SUCCESS}


def test_every_part_is_tried() -> None:
    assert {*DEMANDS, "meaning"} == {*robustness.LINES}


@pytest.mark.parametrize("part", DEMANDS)
def test_what_asks_for_much_is_done_or_refused(part: str) -> None:
    if part == "parquet":
        pytest.importorskip("pyarrow")
    running.warm_up()
    lines, _ = robustness.LINES[part]
    ran = [(line, running.run_line(line)) for line in lines(*DEMANDS[part])]
    broken = [(line, one) for line, one in ran if one.is_fault]
    assert not broken, broken[0]


def test_runs_that_are_kept_are_not_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = []

    def run(line: running.Line) -> running.Ran:
        made.append(line.number)
        is_bad = line.number == 1 and len(made) < 4
        return running.Ran(CRASH if is_bad else SUCCESS, 1.0, 5, untrue=int(line.number == 2))

    monkeypatch.setattr(kept, "run_line", run)
    lot = list(meaning.lines(3, 0))
    for _ in range(2):
        came = [one.came for _, one in kept.run_all(lot, kept.Kept(tmp_path / "runs.jsonl"))]
    assert came == [SUCCESS, SUCCESS, SUCCESS]
    # The crash, and the false certificate, are tried again; what was well is not.
    assert made == [0, 1, 2, 1, 2]
    again = kept.Kept(tmp_path / "runs.jsonl")
    assert [again.faults[line.key] for line in lot] == [0, 1, 2]


def test_a_false_certificate_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    def lie(words: list[str]) -> None:
        if words[0] == "measure":
            raise SystemExit(1)
        Path("a.svg").write_text("<svg/>", encoding="utf-8")
        Path("report.out").write_text('{"certified": true}', encoding="utf-8")
        raise SystemExit(0)

    line = running.Line(0, "lies", ("fill", "-o", "a.svg"))
    monkeypatch.setattr("packwork.cli.app", lie)
    ran = running.run_line(line)
    assert (ran.untrue, ran.is_fault) == (1, True)


def test_the_page_tells_every_part_and_its_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("benchmarks.kit.manifests.FOLDER", tmp_path)
    monkeypatch.setattr("benchmarks.kit.manifests.PAGES", tmp_path)
    tally = Tally(Counter({"tried": 7, SUCCESS: 7}))
    facts = {"count": 7, "peak": 99.0, "slowest": 1.5, "mended": 2}
    page.write(
        {"nested": Part("nested", {"nested recipes": tally}, facts, "only=nested", {"a": 7})}
    )
    text = (tmp_path / "robustness.md").read_text(encoding="utf-8")
    assert "- nested: `packwork bench robustness only=nested` (7 at a)" in text
    assert "Of these runs 2 were faults at first" in text
    assert "Not yet measured: `packwork bench robustness only=meaning`." in text


def test_lines_of_odd_meaning_end_in_a_result_or_a_clear_error() -> None:
    running.warm_up()
    ran = [(line, running.run_line(line)) for line in meaning.lines(LINES, 3)]
    broken = [(line, one) for line, one in ran if one.is_fault]
    assert not broken, broken[0]
    assert {line.kind for line, _ in ran} == {"command lines", "recipes"}


def test_a_line_that_breaks_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    def crash(*_: object) -> None:
        raise ZeroDivisionError

    def write_and_refuse(*_: object) -> None:
        Path("a.svg").write_text("half", encoding="utf-8")
        Path("t.csv").unlink()
        raise SystemExit(2)

    line = next(iter(meaning.lines(1, 0)))
    monkeypatch.setattr("packwork.cli.app", crash)
    assert running.run_line(line).came == CRASH
    monkeypatch.setattr("packwork.cli.app", write_and_refuse)
    ran = running.run_line(line)
    assert (ran.came, ran.lost) == (CRASH, 2)


def test_parts_are_kept(tmp_path: Path) -> None:
    tally = Tally(Counter({"tried": 3, CRASH: 1}))
    tally.blame(["hang: one", "lost: two"])
    part = Part("stops", {"Ctrl-C": tally}, {"length": 2.5}, "stops=3", {"0123abcdef": 3})
    part.save(tmp_path)
    assert Part.load(tmp_path, "stops") == part
    assert tally.counts == {"tried": 3, CRASH: 1, HANG: 1, "lost files": 1}
    assert Part.load(tmp_path, "inputs") is None
    assert state().rstrip("+").isalnum()


def test_the_same_lot_is_the_same() -> None:
    first, again = (list(inputs(40, 5, ["recipes", "tables"])) for _ in range(2))
    assert first == again
    assert len(first) == 40


def trial(read: Any, folder: Path, monkeypatch: pytest.MonkeyPatch) -> trying.Tried:
    monkeypatch.setitem(trying._USES, "item", read)
    return attempt(Input(7, "drawings", "item", "a.svg", b"<svg/>"), folder)


def refuse(path: Path) -> None:
    raise ReadError(path, "no")


def fail(path: Path) -> None:
    raise KeyError(path)


def spin(path: Path) -> None:
    while True:
        pass


@pytest.mark.parametrize(
    ("read", "came"), [(refuse, CLEAR_ERROR), (fail, CRASH), (spin, HANG), (str, SUCCESS)]
)
def test_what_came_of_an_input(
    read: Any, came: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trying, "SECONDS_AT_MOST", 0.05)
    found = trial(read, tmp_path, monkeypatch)
    assert (found.number, found.came, found.lost) == (7, came, 0)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "spoil",
    [
        lambda p: p.write_text("changed", encoding="utf-8"),
        Path.unlink,
        lambda p: p.with_name("more").touch(),
    ],
    ids=["changed", "gone", "beside"],
)
def test_lost_files_are_seen(spoil: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert trial(spoil, tmp_path, monkeypatch).lost == 1


class Fatal:
    """Ends the process that unpickles it, as a fault of native code does."""

    number = 3

    def __reduce__(self) -> Any:
        return os.abort, ()


class Endless:
    """Keeps the process that unpickles it busy past the clock."""

    number = 4

    def __reduce__(self) -> Any:
        return time.sleep, (100,)


def test_processes_that_die_or_hang_are_counted_and_replaced(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sound = Input(9, "tables", "weights", "a.csv", b"star,2\n")
    monkeypatch.setattr(workers, "CLOCK_SECONDS", 60.0)
    lot: list[Any] = [sound, Fatal(), sound]
    came = [tried.came for _, tried, _ in workers.try_all(lot, 1)]
    assert came == [SUCCESS, CRASH, SUCCESS]
    monkeypatch.setattr(workers, "CLOCK_SECONDS", 0.2)
    lot = [Endless()]
    assert [tried.came for _, tried, _ in workers.try_all(lot, 1)] == [HANG]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_runs_that_are_stopped_leave_nothing_half_done(number: signal.Signals) -> None:
    run = ("fill", "heart", "star", "-n", "9", "--levels", "32", "-o", "out.svg", "-o", "out.png")
    stopped = stop_at_random(number, 2, 0, 2.0, run)
    assert (stopped.tried, stopped.faults) == (2, [])

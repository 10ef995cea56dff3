"""Counts of session files and journals that would fill the memory are refused before reading."""

from __future__ import annotations

import io
import json
import logging
import tracemalloc
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import packwork as pw
from packwork.errors import ReadError
from packwork.live.file import disk, documents
from packwork.live.file.session_file import (
    EASILY_UNPACKED,
    MOST_TRIED,
    read_session,
    unpacked,
)
from packwork.live.local_solver import LocalSolver
from packwork.progress import never
from packwork.readers import json_text

MOST_TAKEN = 64_000_000
"""Bytes that a refused file of these tests may take; what they hold would take a gigabyte."""

Change = Callable[[Any], object]


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    file = tmp_path_factory.mktemp("kept") / "a.packwork"
    session = pw.words("heart", "Sonne Mond Sterne", effort="draft", levels="50", epochs=20).edit()
    session.move(0, "50%", "50%")
    session.save(file)
    return file.read_bytes()


def changed(good: bytes, part: str, change: Change) -> bytes:
    parts = dict(unpacked(good))
    name = next(name for name in parts if name.startswith(part))
    found = json.loads(parts[name])
    change(found)
    parts[name] = json.dumps(found).encode()
    return zip_of(parts)


def zip_of(parts: dict[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    return file.getvalue()


def refusal(data: bytes) -> str:
    tracemalloc.start()
    try:
        with pytest.raises(ReadError) as refused:
            read_session(data, "a.packwork")
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < len(data) + MOST_TAKEN
    assert "\n" not in str(refused.value)
    return str(refused.value)


MANY = 7_000_000
"""Of what costs two bytes in a file."""

LISTS: dict[str, tuple[str, str]] = {
    "starts": ("items/", '"starts":[]'),
    "steps": ("items/", '"steps":[]'),
    "runs": ("items/", '"runs":[]'),
    "walls": ("containers/", '"walls":[]'),
    "ids": ("session.json", '"ids":[]'),
    "items": ("session.json", '"items":[]'),
    "documents": ("session.json", '"documents":[]'),
    "marks": ("session.json", '"touched":[]'),
    "manifest": ("session.json", '"manifest":[]'),
}


@pytest.mark.parametrize("name", LISTS)
def test_a_list_of_millions_is_refused_before_it_is_read(good: bytes, name: str) -> None:
    part, place = LISTS[name]
    parts = dict(unpacked(good))
    path = next(path for path in parts if path.startswith(part))
    many = b"[" + b"0," * MANY + b"0]"
    parts[path] = b"{" + place.encode().replace(b"[]", many) + b"}"
    said = refusal(zip_of(parts))
    assert "holds more than 6,000,000 numbers and lists" in said


def test_numbers_that_no_array_holds_are_refused(good: bytes) -> None:
    for number in (1e30, 10**40, -1, 2**63):
        starts: Change = lambda item, n=number: item["outline"].update(starts=[0, n])  # noqa: E731
        assert "outline: must be " in refusal(changed(good, "items/", starts))
    for strange in ({"a": 1}, {"rows": [0], "values": [1.0], "a": 1}):
        column: Change = lambda said, s=strange: said["documents"][1].update(columns={"x": s})  # noqa: E731
        assert "there is no 'a'; there are rows, values" in refusal(
            changed(good, "session.json", column)
        )
    tag: Change = lambda item: item["art"].update(kind=10**400)  # noqa: E731
    assert len(refusal(changed(good, "items/", tag))) < 400
    row = {"x": {"rows": [10**400], "values": [1.0]}}
    rows: Change = lambda said: said["documents"][1].update(columns=row)  # noqa: E731
    assert "documents: must be " in refusal(changed(good, "session.json", rows))


def test_a_small_file_may_not_unpack_to_a_large_one(good: bytes) -> None:
    parts = dict(unpacked(good))
    font = next(name for name in parts if name.startswith("fonts/"))
    parts[font] = bytes(EASILY_UNPACKED)
    assert "unpacks to more than 100 MB" in refusal(zip_of(parts))


def test_no_part_is_unpacked_before_it_is_named(good: bytes) -> None:
    file = io.BytesIO(good)
    with zipfile.ZipFile(file, "a", zipfile.ZIP_DEFLATED) as added:
        for k in range(4):
            added.writestr(f"fonts/{k:064x}", bytes(24_000_000))
    tracemalloc.start()
    read_session(file.getvalue(), "a.packwork")
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < MOST_TAKEN


@pytest.mark.parametrize(
    "marks",
    [{"tried": 2**53}, {"ranges": {"1": [2.0, 1.0]}}, {"ranges": {"1": [1e-300, 1e300]}}],
    ids=["tried", "descending", "endless"],
)
def test_marks_that_no_session_has_are_refused(good: bytes, marks: dict[str, object]) -> None:
    refusal(changed(good, "session.json", lambda found: found["marks"].update(marks)))


def test_polish_after_as_many_trials_as_a_file_may_say(good: bytes) -> None:
    marks = {"touched": [], "unpolished": [1], "ranges": {"1": [0.1, 1.0]}, "tried": MOST_TRIED}
    state, _ = read_session(
        changed(good, "session.json", lambda found: found["marks"].update(marks)), "a.packwork"
    )
    solver = LocalSolver(state.document)
    solver.go_on_from(state)
    assert solver.polish(4, never) is not None
    assert not solver.is_rough


def test_few_documents_of_few_items_go(good: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(documents, "MOST_ROWS", 5)
    assert "documents of more than 5 items together" in refusal(good)


@pytest.mark.parametrize("bound", ["rows", "parts"])
def test_a_history_too_long_to_be_read_is_kept_in_part_and_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, bound: str
) -> None:
    session = pw.fill("circle", "star", count=5, effort="draft", levels="50", epochs=20).edit()
    for share in range(40, 60):
        session.move(0, f"{share}%", "50%")
    if bound == "rows":
        monkeypatch.setattr("packwork.live.file.session_file.MOST_ROWS", 40)
    else:
        session.save(tmp_path / "whole.packwork")
        whole = unpacked((tmp_path / "whole.packwork").read_bytes())["session.json"]
        signs = sum(whole.count(sign) for sign in (b",", b":", b"[", b"{"))
        monkeypatch.setattr(json_text, "MAX_PARTS", signs - 50)
    session.undo()
    with caplog.at_level(logging.WARNING, "packwork"):
        session.save(tmp_path / "a.packwork")
    assert "kept without" in caplog.text
    again = pw.Session.open(tmp_path / "a.packwork")
    assert again.document.poses.x.tolist() == session.document.poses.x.tolist()
    assert 0 < len(again.history.past) < len(session.history.past)
    last, known = again.history.past[-1], session.history.past[-1]
    assert last.poses.x.tolist() == known.poses.x.tolist()


def test_lines_of_a_journal_are_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    file, journal = tmp_path / "a.packwork", tmp_path / "a.packwork.log"
    session = pw.fill("circle", "star", count=3, effort="draft", levels="50", epochs=20).edit()
    session.save(file, journal=True)
    session.close()
    first = journal.read_text(encoding="utf-8")
    monkeypatch.setattr(disk, "LONGEST_GESTURE", 4)
    moves = 9 * '{"do": {"kind": "move", "item": 0, "x": 9.0, "y": 9.0}}\n'
    journal.write_text(first + '{"do": {"kind": "grab", "items": [0]}}\n' + moves, "utf-8")
    again = pw.Session.open(file)
    assert not again.is_grabbed
    assert again.document.poses.x.tolist() == session.document.poses.x.tolist()
    assert "a gesture of more than 4 lines" in caplog.text
    again.close()
    journal.write_text(first + f'{{"flow": [{"0," * MANY} 0]}}\n', "utf-8")
    assert len(pw.Session.open(file).document) == 3
    assert "line 1: holds more than 6,000,000 numbers" in caplog.text

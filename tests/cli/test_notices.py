"""Several notices of one kind are one line, and none is lost."""

from __future__ import annotations

import json
import logging
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

from packwork.cli.terminal import Notices, joined_notices
from packwork.errors import ReadError

Command = Callable[..., Result]


def test_few_of_a_kind_have_their_own_lines() -> None:
    two = [("a.svg", "left out: is empty"), ("b.svg", "left out: is empty")]
    assert joined_notices(two) == ["left out a.svg: is empty", "left out b.svg: is empty"]


def test_many_of_a_kind_are_counted_and_some_named() -> None:
    many = [(f"{k}.svg", "left out: is empty") for k in range(12)]
    other = [("x.svg", "its page was left out")]
    assert joined_notices(many + other) == [
        "12 files left out: is empty (0.svg, 1.svg, 2.svg and 9 more)",
        "x.svg: its page was left out",
    ]
    assert joined_notices(many[:3]) == ["3 files left out: is empty (0.svg, 1.svg, 2.svg)"]


def test_notices_about_nothing_in_particular_are_said_once() -> None:
    assert joined_notices([("", "a word has no font")] * 3) == ["a word has no font"]


def test_what_was_held_is_said_also_if_reading_fails(capsys: pytest.CaptureFixture[str]) -> None:
    notices = Notices()
    log = logging.getLogger("packwork.test_notices")
    log.propagate = False
    log.addHandler(notices)

    def read() -> None:
        log.warning("%s: %s", "a.svg", "has 3 texts")
        log.warning("left out %s", ReadError("b.svg", "is empty"))
        assert capsys.readouterr().err == ""
        raise OSError

    with pytest.raises(OSError), notices.joining():
        read()
    told = ["packwork: a.svg: has 3 texts", "packwork: left out b.svg: is empty"]
    assert capsys.readouterr().err.splitlines() == told
    log.warning("at once")
    assert capsys.readouterr().err == "packwork: at once\n"


def test_a_folder_of_bad_files_is_one_line(folder: Path, packwork: Command) -> None:
    (folder / "icons").mkdir()
    for k in range(6):
        (folder / "icons" / f"bad{k}.svg").write_text("<svg", encoding="utf-8")
    tile = '<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>'
    (folder / "icons" / "good.svg").write_text(tile, encoding="utf-8")
    result = packwork("fill circle icons/ --epochs 3 --levels 16 -q -o out.svg --report r.json")
    assert result.exit_code == 0
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith("packwork: 6 files left out: ")
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    assert len(report["skipped"]) == 6

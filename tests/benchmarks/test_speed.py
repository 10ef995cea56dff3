"""Rows of the page of speed: which are kept, and what stands on their lines."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from benchmarks.engine import speed, speed_page
from benchmarks.kit import manifests

AT = {
    "command": "packwork bench speed draft --against /somewhere/else", "date": "2000-01-01",
    "machine": "m", "cores": 2, "load": [0.1, 0.2, 0.3],
}  # fmt: skip
ONE = {"clock": 3.0, "processor": 2.0, "peak": 100.0, "levels": 1.0, "LC": 0.8, "LnU": 5.0}
OTHER = {**ONE, "clock": 6.0}


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    pages: dict[str, str] = {}
    monkeypatch.setattr(manifests, "FOLDER", tmp_path)
    monkeypatch.setattr(speed, "write_text", pages.__setitem__)
    monkeypatch.setattr(speed.overview, "write", lambda: None)
    return pages


def rows_kept() -> dict[str, Any]:
    return dict(manifests.read_manifest("speed")["sections"])


def test_rows_of_the_same_sources_stay_and_others_go(written: dict[str, str]) -> None:
    speed.keep("normal", [[ONE], [OTHER]], ["a", "b"], AT)
    speed.keep("draft", [[ONE, ONE], [OTHER]], ["a", "b"], AT)
    assert list(rows_kept()) == ["draft", "normal"]
    speed.keep("best", [[ONE], [OTHER]], ["c", "b"], AT)
    assert list(rows_kept()) == ["best"]


def test_a_page_says_how_much_of_the_time_is_left_and_no_path(written: dict[str, str]) -> None:
    speed.keep("draft", [[ONE], [OTHER]], ["a", "b"], AT)
    page = written["speed.md"]
    assert "| draft | here | 1 | 3.00 | 2.00 | 100 | 0.50 |" in page
    assert "--against PATH" in page
    assert "somewhere" not in page


def test_what_a_checkout_does_not_know_has_a_dash() -> None:
    (line, other) = speed_page.cells_of("one", [[ONE], []])
    assert line[:3] == ["one", "here", "3.00"]
    assert set(other[2:]) == {"-"}


@pytest.mark.parametrize("parts", [[], ["profile"], ["draft"], ["floor"], ["profile", "floor"]])
def test_a_page_has_the_parts_that_were_measured_and_no_other(parts: list[str]) -> None:
    runs = {"draft": [[ONE], [OTHER]], "floor": [[{"epoch_ms": 2.0, "floor_ms": 1.0}], []]}
    sections = {name: {**AT, "runs": runs[name]} for name in parts if name in runs}
    manifest: dict[str, Any] = {"sources": ["a", "b"], "sections": sections}
    if "profile" in parts:
        manifest["profile"] = {"load": [0.1], "runs": [[["f", "1.0"]], [["g", "2.0"]]]}
    text = speed_page.page(manifest)
    assert ("## Where the time goes" in text) == ("profile" in parts)
    assert ("## By stage" in text) == ("draft" in parts)
    assert ("## An epoch" in text) == ("floor" in parts)
    assert ("## Circumstances" in text) == bool(sections)
    assert bool(text) == bool(parts)

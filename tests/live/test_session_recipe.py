"""Recipes of sessions: runs that go on where a session is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import WriteError

QUICK = {"effort": "draft", "levels": "50", "epochs": 60}


def icons() -> pw.Layout:
    return pw.fill("heart", ["star", "heart", "builtin:icons"], count=12, padding=2, **QUICK)


def test_a_run_keeps_what_is_held_and_stays_near_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = icons().edit()
    session.duplicate(0)
    session.finish()
    session.hold(0)
    session.hold(3, "place")
    session.hold(5, "angle")
    made = session.recipe(tmp_path / "again")
    assert made.command == f"packwork run {made.file} -o again.svg"
    # The folder may be anywhere.
    moved = (tmp_path / "again").rename(tmp_path / "elsewhere")
    monkeypatch.chdir(tmp_path)
    layout = pw.run(moved / "recipe.toml")
    assert layout.certified
    assert len(layout) == 13
    then, now = session.document.poses, layout.poses
    names = [item.name for item in layout.items]
    first, third, fifth = (names.index(_name(session, k, names)) for k in (0, 3, 5))
    assert now.x[first] == pytest.approx(then.x[0], abs=1e-9)
    assert now.y[third] == pytest.approx(then.y[3], abs=1e-9)
    assert now.angle[fifth] == pytest.approx(then.angle[5], abs=1e-9)
    areas = np.sort(session.layout.areas)
    assert layout.areas.sum() == pytest.approx(areas.sum(), rel=0.1)


def _name(session: pw.Session, k: int, names: list[str]) -> str:
    """What an item that is held is called: by its own name, and a number if there are others."""
    plain = session.document.items[k].name
    return plain if names.count(plain) == 1 else f"{plain} 2"


def test_words_go_on_as_drawings(tmp_path: Path) -> None:
    layout = pw.words("circle", {"a/b": 3, "c\\d": 2, "..": 1, "Ä": 1}, **QUICK)
    made = layout.edit().recipe(tmp_path)
    assert pw.run(made.file).certified
    assert {path.parent for path in (tmp_path / "items").iterdir()} == {tmp_path / "items"}


def test_nothing_is_written_where_that_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(WriteError):
        icons().edit().recipe(tmp_path / "file")

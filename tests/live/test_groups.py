"""Groups: items that keep their places to each other, in commands, files and replays."""

from __future__ import annotations

import io
import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.log import Log, read_entries
from packwork.live.session import Session


def distances(session: pw.Session, number: int) -> list[float]:
    """Distances between the parts of a group, over its size."""
    parts = session.document.items[session.positions(number)[0]].parts
    assert parts is not None
    x, y = parts.poses.x, parts.poses.y
    return [math.dist((x[0], y[0]), (x[k], y[k])) for k in range(len(x))]


def test_a_group_is_dragged_turned_and_settled_as_one(session: pw.Session) -> None:
    poses, first = session.document.poses, session.find("star")[:3]
    across = poses.x[first[1]] - poses.x[first[0]]
    number = session.group(first)
    assert len(session.document) == 10
    assert session.document.areas.sum() == pytest.approx(
        (session.document.own_areas * session.document.poses.scale**2).sum()
    )
    session.move(number, "50%", "45%")
    session.turn(number, 90)
    assert session.finish().certified
    size = session.document.poses.scale[session.positions(number)[0]]
    again = session.ungroup(number)
    after = session.document.poses
    rows = session.positions("star")
    assert len(again) == 3
    down = after.y[session.positions(again[1])[0]] - after.y[session.positions(again[0])[0]]
    assert down == pytest.approx(size * across)
    assert len(rows) == 4
    assert session.finish().certified


def test_what_is_grouped_and_taken_apart_at_once_lies_where_it_lay(
    session: pw.Session, dozen: pw.Layout
) -> None:
    numbers = session.find("star")
    session.hold(numbers, "angle")
    again = session.ungroup(session.group(numbers))
    rows = session.positions(again)
    before = dozen.poses.subset(np.array(numbers))
    for name in ("x", "y", "angle", "scale"):
        got = getattr(session.document.poses, name)[rows]
        assert got == pytest.approx(getattr(before, name), abs=1e-9)
    assert session.document.held[rows].tolist() == [[False, True, False]] * len(rows)
    assert session.document.weights[rows] == pytest.approx(dozen.weights[list(numbers)])


def test_groups_in_a_group_are_taken_apart_by_one_step(session: pw.Session) -> None:
    stars = session.group("star")
    both = session.group([stars, *session.find("heart")])
    parts = session.document.items[session.positions(both)[0]].parts
    assert parts is not None
    assert [item.name for item in parts.items].count("star") == 4
    assert len(session.ungroup(both)) == 8
    assert session.settle().certified


def test_colours_and_flips_of_a_group_are_those_of_its_parts(session: pw.Session) -> None:
    number = session.group("star")
    session.recolor(number, "teal")
    before = distances(session, number)
    session.flip(number)
    assert distances(session, number) == pytest.approx(before)
    item = session.document.items[session.positions(number)[0]]
    assert "#008080" in item.art.markup
    session.palette(["crimson"])
    for one in session.ungroup(number):
        (k,) = session.positions(one)
        assert session.document.items[k].art.fill.startswith("#dc143c")
    session.palette(None)
    assert session.document.items[k].art.fill != "#dc143c"


def test_a_session_file_keeps_groups(session: pw.Session, tmp_path: Path) -> None:
    number = session.group("heart")
    session.settle()
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork")
    assert distances(again, number) == pytest.approx(distances(session, number))
    assert len(again.ungroup(number)) == 4
    assert again.settle().certified


def test_a_replay_groups_alike(dozen: pw.Layout) -> None:
    stream = io.StringIO()
    session = Session(dozen.edit().document, log=Log(stream))
    start = session.document
    session.do("group", items=(0, 3, 5))
    session.do("move", item=12, x=300.0, y=290.0)
    session.finish()
    again = Session.replay(start, read_entries(iter(stream.getvalue().splitlines()), "log"))
    assert (again.document.poses.x == session.document.poses.x).all()
    assert (again.document.poses.scale == session.document.poses.scale).all()


def test_a_group_is_drawn_as_its_parts(
    session: pw.Session, dozen: pw.Layout, tmp_path: Path
) -> None:
    session.group("star")
    for name, layout in (("whole", session.layout), ("single", dozen)):
        layout.save(tmp_path / f"{name}.png")
    whole, single = (
        np.asarray(Image.open(tmp_path / f"{name}.png").convert("L")).astype(int)
        for name in ("whole", "single")
    )
    assert np.abs(whole - single).mean() < 0.5
    assert np.ptp(whole) > 100


def test_one_item_and_what_is_no_group_are_refused(session: pw.Session) -> None:
    with pytest.raises(RecipeError, match="at least 2 items"):
        session.group(0)
    with pytest.raises(RecipeError, match="is for groups"):
        session.ungroup("star#1")

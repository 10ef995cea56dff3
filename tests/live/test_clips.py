"""Items copied from one session to the same or another: as large, as they lay to each other."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.live import edits
from packwork.live.document import Document
from packwork.live.session import Session


def test_a_clip_comes_into_its_own_document_as_it_was(session: pw.Session) -> None:
    before = session.document
    clip = session.copy([0, 3])
    session.remove(0)
    numbers = session.paste(clip, "50%", "50%")
    now = session.document
    rows = [now.index(number) for number in numbers]
    assert [now.items[row] for row in rows] == [before.items[0], before.items[3]]
    was, found = before.poses.subset(np.array([0, 3])), now.poses.subset(np.array(rows))
    assert found.scale == pytest.approx(was.scale)
    assert found.angle == pytest.approx(was.angle)
    assert np.diff(found.x) == pytest.approx(np.diff(was.x))
    assert (found.x.mean(), found.y.mean()) == pytest.approx((300.0, 300.0))
    assert session.settle().certified
    assert session.undo()
    assert session.undo()
    assert session.document is before


def test_what_was_cut_comes_back_to_its_place(session: pw.Session) -> None:
    before = session.document
    clip = session.copy("star#1")
    session.remove("star#1")
    (number,) = session.paste(clip)
    now = session.document
    row, was = now.index(number), before.index(clip.document.ids[clip.rows[0]])
    assert (now.poses.x[row], now.poses.y[row]) == (before.poses.x[was], before.poses.y[was])


def test_a_clip_keeps_its_share_of_another_canvas(session: pw.Session) -> None:
    larger = pw.fill("heart", "moon", count=3, canvas=1200, effort="draft", levels="50").edit()
    (number,) = larger.paste(session.copy(5))
    now = larger.document
    scale = session.document.poses.scale[5]
    assert now.poses.scale[now.index(number)] == pytest.approx(2 * scale)
    assert larger.settle().certified


def test_parts_keep_their_true_size_on_another_sheet() -> None:
    tile = [(0, 0), (4, 0), (4, 2), (0, 2)]
    here, there = (
        Session(Document.from_layout(pw.nest(sheet, [(tile, 2)], passes=20).layouts[0]))
        for sheet in ("60x40mm", "10x8in")
    )
    (number,) = edits.paste(there, edits.copy(here, 0))
    areas = there.document.areas
    assert areas[there.document.index(number)] == pytest.approx(8 / 25.4**2)
    assert there.settle().certified

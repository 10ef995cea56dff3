"""An edit leaves what it does not touch nearly as it was, the more the farther away that lies."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

import packwork as pw
from packwork.arrays import FloatArray, IntArray
from packwork.live import local_solver
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.placing import Move
from packwork.live.document import Document
from packwork.live.history import Marks
from packwork.live.local_solver import ENOUGH, STAGES
from packwork.live.neighbourhood.allowance import LAST, ranges, widened, within
from packwork.live.neighbourhood.caches import LevelCache
from packwork.live.neighbourhood.contacts import RINGS, ContactGraph
from packwork.live.session import Session
from packwork.scene.pose import Poses

SEEDS = range(2)
SHAPES = ["star", "heart", "hexagon", "moon"]


@cache
def thirty(seed: int) -> pw.Layout:
    return pw.fill("circle", SHAPES, count=30, epochs=100, levels="50,100", seed=seed, padding="0")


def dragged(session: Session, item: int) -> list[int]:
    """Drag an item to where another lies; both."""
    poses, other = session.document.poses, (item + 13) % 30
    way = np.linspace([poses.x[item], poses.y[item]], [poses.x[other], poses.y[other]], 8)
    session.apply(Grab(items=(item,)))
    for x, y in way[1:]:
        session.apply(Move(item=item, x=float(x), y=float(y)))
        session.flow(epochs=4)
    session.apply(Drop())
    session.flow(epochs=100)
    return [item, other]


def grown(session: Session, item: int) -> list[int]:
    session.scale(item, 1.4)
    return [item]


def removed(session: Session, item: int) -> list[int]:
    session.remove(item)
    return [item]


def added(session: Session, item: int) -> list[int]:
    poses = session.document.poses
    session.add("star", float(poses.x[item]), float(poses.y[item]))
    return [item]


def replaced(session: Session, item: int) -> list[int]:
    session.replace(item, "circle")
    return [item]


EDITS = [dragged, grown, removed, added, replaced]


def edited(edit: Callable[[Session, int], list[int]], seed: int) -> tuple[FloatArray, FloatArray]:
    """Factors by which areas of untouched items have changed, and rings that they lie away."""
    session, item = thirty(seed).edit(), 7 + 5 * seed
    before = session.document
    places = edit(session, item)
    assert session.finish().certified
    while session.is_rough:
        session.polish(48)
    assert session.is_certified
    after = session.document
    rings = ContactGraph(before, LevelCache()).rings(np.array(places), RINGS)
    ids = np.setdiff1d(np.intersect1d(before.ids, after.ids), [item])
    rows = np.searchsorted(after.ids, ids)
    factors = (after.poses.scale[rows] / before.poses.scale[ids]) ** 2
    return np.maximum(factors, 1 / factors), rings[ids]


@pytest.mark.parametrize("edit", EDITS)
def test_what_is_not_touched_is_about_as_large_as_it_was(
    edit: Callable[[Session, int], list[int]],
) -> None:
    found = [edited(edit, seed) for seed in SEEDS]
    factors = np.concatenate([one for one, _ in found])
    rings = np.concatenate([one for _, one in found])
    assert (factors > 1.25).mean() < 0.2
    assert np.quantile(factors, 0.95) < 1.8
    far = factors[(rings < 0) | (rings == RINGS)]
    assert far.max() < 1.35
    assert far.mean() <= factors.mean()


def test_a_gesture_far_away_changes_nothing() -> None:
    layout = pw.fill("square", "hexagon", count=90, epochs=60, levels="50,100")
    session, before = layout.edit(), layout.poses
    corner = int(np.argmin(before.x + before.y))
    session.remove(corner)
    session.finish()
    while session.is_rough:
        session.polish(48)
    after = session.document
    ids = np.delete(np.arange(90), corner)
    rings = ContactGraph(layout.edit().document, LevelCache()).rings(np.array([corner]), RINGS)
    far = ids[rings[ids] < 0]
    assert len(far) > 20
    rows = np.searchsorted(after.ids, far)
    for name in ("x", "y", "angle", "scale"):
        now, then = getattr(after.poses, name)[rows], getattr(before, name)[far]
        assert now.tobytes() == then.tobytes()


def test_ranges_narrow_with_each_ring_and_are_one_size_beyond() -> None:
    least, most = ranges(np.full(5, 2.0), np.array([0, 1, 2, 3, -1]))
    widths = most / least
    assert widths[0] == widths[1] > widths[2] > widths[3] > widths[4] == 1
    assert least * most == pytest.approx(4)


def test_ranges_hold_those_of_earlier_edits() -> None:
    document = Document.from_layout(thirty(0))
    near = np.where(np.arange(30) < 3, 1, -1)
    once = widened({}, document, document, near)
    assert set(once) == {0, 1, 2}
    later = document.scaled(0, 1.1)
    assert widened(once, later, document, near) == once
    twice = widened(once, later, later, near)
    low, high = once[0]
    assert twice[0] == pytest.approx((low, 1.1 * high))
    assert twice[1] == once[1]


def test_sizes_vary_within_ranges_and_never_beyond_those_that_a_person_gave() -> None:
    document = Document.from_layout(thirty(0))
    scale = document.poses.scale
    bound = within(document, {1: (0.9 * scale[1], 1.1 * scale[1]), 2: (1e-9, 1e9)}, {3})
    rows = [1, 2, 3, 4]
    assert bound.smallest[rows] == pytest.approx(
        [max(0.9 * scale[1], document.smallest[1]), *document.smallest[[2, 3]], scale[4]]
    )
    assert bound.largest[rows] == pytest.approx(
        [min(1.1 * scale[1], document.largest[1]), *document.largest[[2, 3]], scale[4]]
    )


def test_what_is_undone_or_removed_leaves_no_trials_and_no_ranges(session: pw.Session) -> None:
    session.move(0, "50%", "50%")
    session.settle()
    assert {0, 1} <= set(session.marks.ranges)
    session.polish(4)
    assert session.marks.tried == 4
    session.undo()
    assert session.marks == Marks(polished=1)
    session.move(0, "50%", "50%")
    session.settle()
    session.remove(0)
    session.settle()
    assert 0 not in session.marks.ranges


def test_the_last_stage_of_sizes_lets_items_shrink_beyond_their_ranges() -> None:
    document = Document.from_layout(thirty(0))
    s = float(document.poses.scale[1])
    found = [within(document, {1: (0.9 * s, 1.1 * s)}, stage=k) for k in range(STAGES)]
    assert [one.smallest[1] for one in found[:3]] == pytest.approx([0.9 * s] * 3)
    assert 0.8 * s < found[3].smallest[1] < 0.82 * s
    assert found[0].largest[1] < found[1].largest[1] < found[2].largest[1]
    for later in found[LAST + 1 :]:
        assert (later.smallest == found[LAST].smallest).all()
        assert (later.largest == found[LAST].largest).all()


def test_turns_go_on_while_coverage_is_missing_and_reach_farther_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = thirty(0).edit()
    session.remove(7)
    session.settle()
    session.marks.full = 1.0  # As full as nothing is: turns go on for as long as they may.
    turned = list[int]()

    def noted(document: Document, rows: IntArray, *_: object) -> tuple[Poses, bool]:
        turned.append(len(rows))
        return document.poses, True

    monkeypatch.setattr(local_solver, "polish", noted)
    each = ENOUGH * len(session.marks.ranges)
    while session.is_rough:
        session.polish(each)
    assert len(turned) == STAGES
    assert turned == sorted(turned)
    assert turned[0] < turned[-1] == len(session.document)


def test_finish_leaves_nothing_rough(session: pw.Session) -> None:
    session.move(0, "50%", "50%")
    assert session.finish().certified
    assert not session.is_rough


def test_many_gestures_do_not_empty_a_layout() -> None:
    session = thirty(1).edit()
    first = session.document.covered
    rng = np.random.default_rng(4)
    for _ in range(4):
        dragged(session, int(rng.integers(30)))
        assert session.settle().certified
    while session.is_rough:
        session.polish(48)
    assert session.document.covered > first - 0.06

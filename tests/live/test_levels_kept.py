"""What levels see is kept, and depends on nothing that was asked before."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.arrays import IntArray
from packwork.live.document import Document
from packwork.live.neighbourhood.caches import LevelCache
from packwork.live.neighbourhood.flow import Flow
from packwork.scene.pose import Poses


def _poses(scale: float) -> Poses:
    return Poses(np.ones(1), np.ones(1), np.zeros(1), np.full(1, scale))


def test_what_was_asked_before_changes_nothing() -> None:
    outline = pw.fill("circle", "star", count=1, effort="draft", levels="50").items[0].outline
    before, fresh = LevelCache(), LevelCache()
    before.outlines([outline], _poses(1.02), 2.0, 0.3)
    one, other = (
        levels.outlines([outline], _poses(0.98), 2.0, 0.3)[0] for levels in (before, fresh)
    )
    assert np.array_equal(one.points, other.points)


def test_a_flow_that_was_made_ready_flows_as_one_that_was_not(dozen: pw.Layout) -> None:
    document = Document.from_layout(dozen)
    flows = Flow(document), Flow(document)
    flows[0].make_ready()
    for flow in flows:
        flow.begin()
        flow.activate(np.arange(3))
        flow.run(20)
    one, other = (flow.document.poses for flow in flows)
    assert np.array_equal(one.x, other.x)
    assert np.array_equal(one.scale, other.scale)


def test_what_lies_far_from_all_that_moves_is_left_out_and_changes_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    layout = pw.fill("circle", "hexagon", count=90, effort="draft", levels="50")
    document, met, left_out = Document.from_layout(layout), Flow._met, list[int]()

    def counted(flow: Flow, active: IntArray) -> IntArray:
        found = met(flow, active)
        left_out.append(len(document) - len(active) - len(found))
        return found

    def every(_: Flow, active: IntArray) -> IntArray:
        return np.setdiff1d(np.arange(len(document)), active)

    flows = Flow(document), Flow(document)
    for flow, kept in zip(flows, (counted, every), strict=True):
        monkeypatch.setattr(Flow, "_met", kept)
        flow.begin()
        flow.activate(np.array([0]))
        flow.run(12)
    one, other = (flow.document.poses for flow in flows)
    assert left_out
    assert min(left_out) > 0
    assert not np.array_equal(one.x, document.poses.x)
    for name in ("x", "y", "angle", "scale"):
        assert np.allclose(getattr(one, name), getattr(other, name), rtol=0, atol=1e-6)

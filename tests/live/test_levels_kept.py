"""What levels see is kept, and depends on nothing that was asked before."""

from __future__ import annotations

import numpy as np

import packwork as pw
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

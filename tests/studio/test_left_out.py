"""What a run could not place is told, with the reason."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

import packwork as pw
from packwork.live.document import Document
from packwork.live.face.opening import Opening
from packwork.studio.view import MOST_TOLD
from packwork.studio.workspace import Workspace

SAID = [
    {"item": "bee", "index": 12, "reason": "no void is large enough"},
    {"item": "w" * 900, "index": 13},
    "nonsense",
]


@pytest.fixture(params=[SAID, "spoilt", None], ids=["some", "spoilt", "none"])
def opening(dozen: pw.Layout, request: pytest.FixtureRequest) -> Opening:
    layout = replace(dozen, manifest={**dozen.manifest, "unplaced": request.param})
    return Opening(document=Document.from_layout(layout))


def test_pages_are_told_what_was_left_out(play, request: pytest.FixtureRequest) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified and page.frames)
        told = page.last("state")["unplaced"]
        if "some" not in request.node.name:
            assert told == []
            return
        assert told[0] == {"name": "bee", "reason": "no void is large enough"}
        assert [len(one["name"]) for one in told] == [3, MOST_TOLD]

    play(scenario)

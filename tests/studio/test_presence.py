"""Two people at one desk: the second is asked first."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, cast

import pytest
from starlette.websockets import WebSocket

from packwork.live.face.opening import Opening
from packwork.studio.app import GRACE_SECONDS, Presence, Studio
from packwork.studio.files import Uploads
from packwork.studio.proof import Secret
from packwork.studio.tab import Tab
from packwork.studio.workspace import Workspace
from studio.browsing import PHONE, Desk, Server, in_browser


def test_a_desk_is_free_again_some_time_after_the_last_page_is_gone() -> None:
    now = [0.0]
    seats = Presence(lambda: now[0])
    assert seats.take("ann")
    assert seats.take("ann")
    seats.leave("ann")
    now[0] = 10 * GRACE_SECONDS
    assert not seats.take("bob")
    seats.leave("ann")
    assert not seats.take("bob")
    now[0] += GRACE_SECONDS
    assert seats.take("bob")


def test_pages_that_do_not_say_whose_they_are_keep_nobody_out() -> None:
    seats = Presence()
    assert seats.take("")
    assert seats.take("ann")
    assert seats.take("")


class OpenSocket:
    """A page that says nothing, and stays."""

    scope: dict[str, Any]

    def __init__(self) -> None:
        self.scope = {"subprotocols": ["packwork", "person.ann"]}

    async def accept(self, protocol: str) -> None:
        """Nothing is sent by it."""

    async def receive(self) -> dict[str, str]:
        await asyncio.Event().wait()
        return {}


def test_a_page_to_which_nothing_can_be_sent_is_let_go(
    opening: Opening, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def fails(_: Tab) -> None:
        await asyncio.sleep(0)
        raise KeyError("a drawing")

    async def scenario() -> None:
        uploads, socket = Uploads(), cast(WebSocket, OpenSocket())
        studio = Studio(Workspace(opening), uploads, Secret("127.0.0.1:1"))
        route = next(one for one in studio.routes if getattr(one, "path", "") == "/socket")
        with pytest.raises(KeyError, match="a drawing"):
            await asyncio.wait_for(cast(Any, route).endpoint(socket), 60.0)
        uploads.close()

    monkeypatch.setattr(Tab, "send", fails)
    asyncio.run(scenario())


@in_browser[0]
@in_browser[1]
def test_another_person_is_told_and_may_join(
    open_desk: Callable[..., Desk], browser: Any, server: Server
) -> None:
    desk = open_desk()
    context = browser.new_context(viewport=PHONE)
    other = Desk(context.new_page(), server.address)
    other.until("!document.getElementById('taken').hidden")
    other.picture("taken")
    assert other.look("studio.collage.scene === null")
    other.page.locator("#join").click()
    other.settled()
    assert other.look("document.getElementById('taken').hidden")
    other.page.reload()
    other.settled()
    # Whoever was there before is not kept out either.
    desk.page.reload()
    desk.settled()
    assert other.faults == []
    context.close()

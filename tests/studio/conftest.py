"""A desk with a small layout, and pages that are no browsers."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Coroutine, Iterator
from contextlib import suppress
from typing import Any

import pytest

import packwork as pw
from packwork.live.document import Document
from packwork.live.face.opening import Opening
from packwork.studio.files import Uploads
from packwork.studio.importer import Importer
from packwork.studio.tab import Tab
from packwork.studio.workspace import Workspace
from studio.browsing import WIDE, Server, chromium
from studio.browsing import Desk as PageDesk

PATIENCE_SECONDS = 120.0


class Page:
    """What a page would hear; acknowledges each frame at once unless told not to."""

    def __init__(self) -> None:
        self.messages: list[dict[str, Any]] = []
        self.frames: list[bytes] = []
        self.tab: Tab | None = None
        self.acknowledges = True
        self.changed = asyncio.Event()

    async def send_text(self, data: str) -> None:
        self.messages.append(json.loads(data))
        self.changed.set()

    async def send_bytes(self, data: bytes) -> None:
        self.frames.append(data)
        if self.acknowledges:
            self.acknowledge()
        self.changed.set()

    def acknowledge(self) -> None:
        self.tell(type="ack", frame=int.from_bytes(self.frames[-1][:4], "little"))

    def tell(self, **message: Any) -> None:
        assert self.tab is not None
        self.tab.receive(json.dumps(message))

    def said(self, kind: str) -> list[dict[str, Any]]:
        return [message for message in self.messages if message["type"] == kind]

    def last(self, kind: str) -> dict[str, Any]:
        return self.said(kind)[-1]

    @property
    def is_certified(self) -> bool:
        """Whether the newest state says so."""
        states = self.said("state")
        return bool(states) and states[-1]["certified"] and not states[-1]["busy"]

    @property
    def done(self) -> int:
        """Newest command of the page that the newest frame knows."""
        return int.from_bytes(self.frames[-1][8:12], "little") if self.frames else 0

    async def until(self, is_so: Callable[[], bool]) -> None:
        """Wait until something is so."""
        async with asyncio.timeout(PATIENCE_SECONDS):
            while not is_so():
                self.changed.clear()
                await self.changed.wait()


Scenario = Callable[[Workspace, Callable[[], Page]], Coroutine[Any, Any, None]]


@pytest.fixture(scope="session")
def dozen() -> pw.Layout:
    """Twelve stars, hearts and hexagons in a circle."""
    return pw.fill("circle", ["star", "heart", "hexagon"], count=12, epochs=120, levels="50,100")


@pytest.fixture
def opening(dozen: pw.Layout) -> Opening:
    """A desk begins with the dozen."""
    return Opening(document=Document.from_layout(dozen))


@pytest.fixture
def play(opening: Opening) -> Callable[[Scenario], None]:
    """Have a scenario played on a desk, with as many pages as it opens."""

    def played(scenario: Scenario) -> None:
        asyncio.run(_played(scenario, opening))

    return played


async def _played(scenario: Scenario, opening: Opening) -> None:
    desk, uploads, sending = Workspace(opening), Uploads(), []
    importer = Importer(desk, uploads)

    def open_page() -> Page:
        page = Page()
        page.tab = Tab(desk, page, importer)
        sending.append(asyncio.create_task(page.tab.send()))
        return page

    await desk.begin()
    try:
        await scenario(desk, open_page)
    finally:
        for task in sending:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        await asyncio.to_thread(desk.close)
        uploads.close()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    pytest.importorskip("playwright")
    with chromium() as found:
        yield found


def new_page(browser: Any, size: dict[str, int], **more: Any) -> Any:
    """One person's page, which remembers nothing."""
    context = browser.new_context(viewport=size, accept_downloads=True, **more)
    # What is left for an empty page has no storage.
    context.add_init_script("try { localStorage.setItem('person', 'ann'); } catch {}")
    return context.new_page()


class WidePage:
    """A wide page that serves one test after another, for a new one loads all programs anew.

    Parameters
    ----------
    browser
        Of the module.
    """

    def __init__(self, browser: Any) -> None:
        self._browser = browser
        self.page: Any = None

    def taken(self) -> Any:
        """The page, as one that was never used; made anew where a test has closed it."""
        if self.page is None or self.page.is_closed():
            self.page = new_page(self._browser, WIDE)
        return self.page


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    made = Server("circle", "star", "heart", "moon", "-n", "14").start()
    yield made
    made.stop()


@pytest.fixture(scope="module")
def wide_page(browser: Any) -> WidePage:
    return WidePage(browser)


@pytest.fixture
def open_desk(
    browser: Any, server: Server, wide_page: WidePage
) -> Iterator[Callable[..., PageDesk]]:
    """Opens a page, by default a wide one, all one person's; at the end none has met a fault."""
    desks: list[PageDesk] = []

    def opened(size: dict[str, int] = WIDE, address: str = "", **more: Any) -> PageDesk:
        if size is WIDE and not more and not any(desk.page is wide_page.page for desk in desks):
            page = wide_page.taken()
        else:
            page = new_page(browser, size, **more)
        desk = PageDesk(page, address or server.address)
        desks.append(desk)
        desk.settled()
        return desk

    yield opened
    for desk in desks:
        desk.leave()
        if desk.page is not wide_page.page:
            desk.page.context.close()
    for desk in desks:
        assert desk.faults == []

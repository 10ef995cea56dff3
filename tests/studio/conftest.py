"""A desk with a small layout, and pages that are no browsers."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Coroutine, Iterator
from contextlib import ExitStack, suppress
from typing import Any

import pytest

import packwork as pw
from packwork.live.document import Document
from packwork.live.face.opening import Opening
from packwork.studio.files import Importer, Uploads
from packwork.studio.tab import Tab
from packwork.studio.workspace import Workspace
from studio.browsing import WIDE, Server, as_new, chromium, let_go, new_page
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
        """Whether the newest state says so, and nothing is won back any more."""
        if not (states := self.said("state")):
            return False
        return states[-1]["certified"] and not (states[-1]["busy"] or states[-1]["polishing"])

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


class KeptBrowser:
    """A browser that serves one module after another, with its wide page.

    A new browser, or page, loads all programs anew.
    """

    def __init__(self) -> None:
        self._held = ExitStack()
        self.browser: Any = None
        self._page: Any = None

    def opened(self) -> Any:
        """The browser; begun where there is none."""
        if self.browser is None:
            self.browser = self._held.enter_context(chromium())
        return self.browser

    def wide_page(self) -> Any:
        """The page, as one that was never used; made anew where a test has closed it."""
        if self._page is None or self._page.is_closed():
            self._page = new_page(self.opened(), WIDE)
        else:
            as_new(self._page)
        return self._page

    def is_wide(self, page: Any) -> bool:
        """Whether a page is the one that is kept."""
        return page is self._page

    def leave(self) -> None:
        """Close all that a module has opened beside the wide page, which lets go of its studio."""
        self.let_go()
        for context in self.browser.contexts:
            if self._page is None or context is not self._page.context:
                context.close()

    def let_go(self) -> None:
        """Have the wide page look at no studio."""
        if self._page is not None:
            let_go(self._page)

    def close(self) -> None:
        """End it, for a loop of events runs as long as it is there, beside which none can."""
        self._held.close()
        self.browser = self._page = None


KEPT = KeptBrowser()


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(nextitem: pytest.Item | None) -> None:
    """The browser ends before a test that has none."""
    if nextitem is None or "browser" not in getattr(nextitem, "fixturenames", ()):
        KEPT.close()


@pytest.fixture(scope="session")
def kept_browser() -> Iterator[KeptBrowser]:
    pytest.importorskip("playwright")
    yield KEPT
    KEPT.close()


@pytest.fixture(scope="module")
def browser(kept_browser: KeptBrowser) -> Iterator[Any]:
    yield kept_browser.opened()
    kept_browser.leave()


class KeptServer:
    """A studio that serves one module after another, from the document that it began with.

    To start one for each takes it seconds, and a browser loads the programs of another place anew.
    """

    AS_IT_LIES = (
        "(c => JSON.stringify([c.scene.name, c.items.map(one => one.shape), [...c.poses]]))"
        "(studio.collage)"
    )

    def __init__(self) -> None:
        self.server = Server("circle", "star", "heart", "moon", "-n", "14")
        self._began = ""
        self._is_looked_at = True

    def lent(self) -> Server:
        """The studio, which the next page looks at."""
        if self.server.process is None or self.server.process.poll() is not None:
            self.server.start()
        self._is_looked_at = False
        return self.server

    def as_it_began(self, desk: PageDesk) -> None:
        """Undo what modules before have left; where that is not all, it is started anew."""
        if self._is_looked_at or not desk.page.url.startswith(self.server.address):
            return
        self._is_looked_at = True
        if desk.look("studio.collage.state.can_undo"):
            desk.undo_all()
            desk.page.reload()
            desk.settled()
        lies = desk.look(self.AS_IT_LIES)
        if lies != (self._began or lies):
            let_go(desk.page)
            self.server.stop()
            self.server.start()
            desk.page.goto(self.server.address)
            desk.settled()
        self._began = self._began or lies


@pytest.fixture(scope="session")
def kept_server() -> Iterator[KeptServer]:
    kept = KeptServer()
    yield kept
    kept.server.stop()


@pytest.fixture(scope="module")
def server(kept_server: KeptServer) -> Server:
    return kept_server.lent()


@pytest.fixture
def open_desk(
    browser: Any, server: Server, kept_server: KeptServer
) -> Iterator[Callable[..., PageDesk]]:
    """Opens a page, by default a wide one, all one person's; at the end none has met a fault."""
    desks: list[PageDesk] = []

    def opened(size: dict[str, int] = WIDE, address: str = "", **more: Any) -> PageDesk:
        is_taken = any(KEPT.is_wide(desk.page) for desk in desks)
        if size is WIDE and not more and not is_taken:
            page = KEPT.wide_page()
        else:
            if not is_taken:
                KEPT.let_go()
            page = new_page(browser, size, **more)
        desk = PageDesk(page, address or server.address)
        desks.append(desk)
        desk.settled()
        kept_server.as_it_began(desk)
        return desk

    yield opened
    for desk in desks:
        desk.leave()
        if not KEPT.is_wide(desk.page):
            desk.page.context.close()
    if server is not kept_server.server:
        KEPT.let_go()
    for desk in desks:
        assert desk.faults == []

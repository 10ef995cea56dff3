"""Routes of the studio: the page, its socket, files in and out."""

from __future__ import annotations

import asyncio
import json
import time
from base64 import b64encode
from collections import Counter
from collections.abc import AsyncIterator, Callable, Iterable
from contextlib import asynccontextmanager
from dataclasses import asdict
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect

from packwork.errors import PackworkError
from packwork.live.face.offers import columns_of, offers
from packwork.studio.files import MOST_BYTES, Exporter, Importer, Uploads
from packwork.studio.guard import AGAIN, PROTOCOL, Guard
from packwork.studio.proof import Secret
from packwork.studio.tab import Tab
from packwork.studio.wording import for_page
from packwork.studio.workspace import Workspace

MOST_TABS = 8
"""Pages that look at one workspace at most. Chosen."""

TAKEN = 4409
"""Code with which a socket is closed while another person is in the workspace."""

MOST_ASKED = 10_000
"""Bytes of what an export asks for. Chosen."""

BODY_SECONDS = 300.0
"""How long a file may take to arrive. Chosen: the largest one, in a slow network."""


class Studio:
    """Application that answers requests."""

    def __init__(self, workspace: Workspace, uploads: Uploads, secret: Secret) -> None:
        self._workspace, self._uploads, self._secret = workspace, uploads, secret
        self._importer, self._exporter = (
            Importer(workspace, uploads),
            Exporter(workspace, uploads.folder),
        )
        self._tabs: set[Tab] = set()
        self._presence = Presence()

    @property
    def routes(self) -> list[BaseRoute]:
        """All that is served."""
        return [
            Route("/", self._page),
            Mount(f"/static/{version_of_page()}", LastingFiles(directory=PAGE)),
            Mount("/static", StaticFiles(directory=PAGE)),
            Route("/proof/{nonce}", self._proof),
            Route(AGAIN, self._again, methods=["POST"]),
            Route("/choices", self._choices),
            Route("/recent", self._recent),
            Route("/tables/{batch}", self._table),
            Route("/files", self._batch, methods=["POST"]),
            Route("/files/{batch}", self._file, methods=["POST"]),
            Route("/export", self._export, methods=["POST"]),
            WebSocketRoute("/socket", self._socket),
        ]

    async def _page(self, request: Request) -> Response:
        return Response(page_text(), media_type="text/html")

    async def _proof(self, request: Request) -> Response:
        return JSONResponse(self._secret.proofs(request.path_params["nonce"]))

    async def _again(self, request: Request) -> Response:
        return JSONResponse({"secret": self._secret.text})

    async def _choices(self, request: Request) -> Response:
        return JSONResponse(await asyncio.to_thread(offers))

    async def _recent(self, request: Request) -> Response:
        shelf = self._workspace.shelf
        found = [] if shelf is None else await asyncio.to_thread(shelf.recent)
        told = [{**asdict(one), "png": b64encode(one.png).decode("ascii")} for one in found]
        return JSONResponse(told)

    async def _table(self, request: Request) -> Response:
        try:
            file, shown = self._importer.file(request.path_params["batch"]), self._workspace.shown
            container = None if shown is None else shown.view.container
            return JSONResponse(await asyncio.to_thread(columns_of, file, container))
        except PackworkError as error:
            return refused(PackworkError(self._importer.without_folder(str(error))))

    async def _batch(self, request: Request) -> Response:
        return JSONResponse({"batch": self._uploads.new_batch()})

    async def _file(self, request: Request) -> Response:
        name = unquote(request.headers.get("x-name", "file"))
        try:
            data = await _body(request, MOST_BYTES)
            self._uploads.add(request.path_params["batch"], name, data)
        except PackworkError as error:
            return refused(error)
        return JSONResponse({"bytes": len(data)})

    async def _export(self, request: Request) -> Response:
        try:
            asked = json.loads(await _body(request, MOST_ASKED))
            data, media = await self._exporter.file(asked)
        except PackworkError as error:
            return refused(PackworkError(self._importer.without_folder(str(error))))
        except (ValueError, RecursionError):
            return PlainTextResponse("what is asked for cannot be read\n", 400)
        return Response(data, media_type=media)

    async def _socket(self, socket: WebSocket) -> None:
        if len(self._tabs) >= MOST_TABS:
            await socket.close(4429, f"{MOST_TABS} pages are open already; close one")
            return
        await socket.accept(PROTOCOL)
        person, joins = person_of(socket.scope.get("subprotocols", ()))
        if not self._presence.take(person, joins=joins):
            await socket.close(TAKEN, "somebody else works here")
            return
        tab = Tab(self._workspace, socket, self._importer)
        self._tabs.add(tab)
        # Whichever ends first ends the other: a page to which nothing is sent must come anew.
        both = [asyncio.create_task(one) for one in (tab.send(), _receive(socket, tab))]
        try:
            await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._tabs.discard(tab)
            self._presence.leave(person)
            for one in both:
                one.cancel()
            ended = await asyncio.gather(*both, return_exceptions=True)
        for found in ended:
            if isinstance(found, Exception) and not isinstance(found, GONE):
                raise found


PAGE = Path(__file__).with_name("static")
"""Folder of what the page is made of."""


class LastingFiles(StaticFiles):
    """Files that a browser keeps for good, for what is another file has another address."""

    def file_response(self, *given: Any, **named: Any) -> Response:
        """Answer with a file."""
        response = super().file_response(*given, **named)
        response.headers["cache-control"] = "max-age=31536000, immutable"
        return response


@cache
def version_of_page() -> str:
    """Digest of all that the page is made of, as it was when this was first asked for."""
    files = sorted(one for one in PAGE.rglob("*") if one.is_file())
    told = b"".join(one.name.encode() + one.read_bytes() for one in files)
    return sha256(told).hexdigest()[:16]


@cache
def page_text() -> str:
    """The page; all its modules are asked for at once, not one after the other that needs it."""
    names = sorted(one.name for one in PAGE.glob("*.js"))
    links = (f'<link rel="modulepreload" href="/static/{name}">' for name in names)
    page = (PAGE / "index.html").read_text(encoding="utf-8")
    page = page.replace('<link rel="modulepreload" href="/static/main.js">', "\n".join(links))
    return page.replace("/static/", f"/static/{version_of_page()}/")


GONE = (WebSocketDisconnect, RuntimeError)
"""Raised where a socket is used whose page is gone."""


async def _receive(socket: WebSocket, tab: Tab) -> None:
    while (message := await socket.receive())["type"] != "websocket.disconnect":
        text = message.get("text")
        tab.receive("" if text is None else text)


async def _body(request: Request, most: int) -> bytes:
    parts, length = [], 0
    try:
        async with asyncio.timeout(BODY_SECONDS):
            async for part in request.stream():
                length += len(part)
                if length > most:
                    raise PackworkError(f"more than {most / 1e6:g} MB are too many")
                parts.append(part)
    except TimeoutError:
        raise PackworkError(f"takes longer than {BODY_SECONDS:g} seconds; send it again") from None
    return b"".join(parts)


def refused(error: PackworkError) -> Response:
    """Answer of one clear line."""
    return PlainTextResponse(f"{for_page(' '.join(str(error).split()))}\n", 400)


def guarded(workspace: Workspace, uploads: Uploads, secret: Secret) -> Guard:
    """The studio behind its guard; its workspace begins when the server does."""

    @asynccontextmanager
    async def open_(app: Any) -> AsyncIterator[None]:
        await workspace.begin()
        try:
            yield
        finally:
            await asyncio.to_thread(workspace.close)

    app = Starlette(routes=Studio(workspace, uploads, secret).routes, lifespan=open_)
    return Guard(app, secret)


GRACE_SECONDS = 5.0
"""How long the workspace is kept for somebody whose last page is gone. Shorter gives it away while
a page is loaded anew, longer has the next one wait. Chosen."""

LONGEST = 64
"""Characters of what a person is known by at most. Chosen."""


class Presence:
    """Seats in a workspace: the person there, and who works there together.

    Examples
    --------
    >>> seats = Presence()
    >>> seats.take("ann"), seats.take("ann"), seats.take("bob"), seats.take("bob", joins=True)
    (True, True, False, True)
    >>> seats.leave("ann"), seats.take("ann"), seats.take("cid")
    (None, True, False)
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._pages: Counter[str] = Counter()
        self._left: dict[str, float] = {}
        self._together: set[str] = set()

    def take(self, person: str, *, joins: bool = False) -> bool:
        """Have one more page of a person in the workspace; False if somebody else is there.

        A page that does not say whose it is comes in, and keeps nobody out.
        """
        others = self._present - {person}
        if joins:
            self._together |= {person, *others}
        elif person and others and person not in self._together:
            return False
        self._pages[person] += 1
        return True

    def leave(self, person: str) -> None:
        """Have one page of a person less."""
        self._pages[person] -= 1
        if not self._pages[person]:
            del self._pages[person]
            self._left[person] = self._clock()

    @property
    def _present(self) -> set[str]:
        """Whoever has a page there, or had one a moment ago."""
        now = self._clock()
        self._left = {k: at for k, at in self._left.items() if now - at < GRACE_SECONDS}
        return {*self._pages, *self._left} - {""}


def person_of(offered: Iterable[str]) -> tuple[str, bool]:
    """Whose page a socket is of, by the subprotocols it offers; whether it joins whoever is there.

    Examples
    --------
    >>> person_of(["packwork", "token.abc", "person.4f"])
    ('4f', False)
    >>> person_of(["packwork", "join.4f"]), person_of(["packwork"])
    (('4f', True), ('', False))
    """
    for one in offered:
        kind, _, person = one.partition(".")
        if kind in {"person", "join"}:
            return person[:LONGEST], kind == "join"
    return "", False

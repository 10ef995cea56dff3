"""Half-sent requests, as many as there may be: they end, and the page is there meanwhile."""

from __future__ import annotations

import asyncio
import contextlib
import socket
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest
import uvicorn

from packwork.live.document import Document
from packwork.live.face.opening import Opening
from packwork.studio import app as routes
from packwork.studio import guard, serving
from packwork.studio.app import guarded
from packwork.studio.files import Uploads
from packwork.studio.proof import Secret
from packwork.studio.serving import MOST_CONNECTIONS, BoundedProtocol
from packwork.studio.workspace import Workspace

PATIENCE_SECONDS = 60.0
HALF = b"GET / HTTP/1.1\r\nhost: x\r\nx: "


class Running:
    """A studio in a thread, by the same protocol as in ``serve``."""

    def __init__(self, document: Document) -> None:
        self._bound = socket.create_server(("127.0.0.1", 0))
        self.place = self._bound.getsockname()
        self.host = f"127.0.0.1:{self.place[1]}"
        self.secret, self.uploads = Secret(self.host), Uploads()
        app = guarded(Workspace(Opening(document=document)), self.uploads, self.secret)
        config = uvicorn.Config(
            app, http=BoundedProtocol, ws="websockets-sansio", log_level="critical", lifespan="on"
        )
        self._server = uvicorn.Server(config)
        run = lambda: asyncio.run(self._server.serve(sockets=[self._bound]))  # noqa: E731
        self._thread = threading.Thread(target=run)
        self._thread.start()

    def stop(self) -> None:
        self._server.should_exit = True
        self._thread.join(PATIENCE_SECONDS)
        self.uploads.close()
        assert not self._thread.is_alive()

    def open(self, sent: bytes = b"") -> socket.socket:
        made = socket.create_connection(self.place, PATIENCE_SECONDS)
        made.sendall(sent)
        return made

    def asked(self, head: str, body: bytes = b"", **headers: str) -> bytes:
        """Answer to a whole request."""
        lines = [head, f"host: {self.host}", "connection: close"]
        lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
        with self.open("\r\n".join([*lines, "", ""]).encode() + body) as made:
            return until_closed(made)


def until_closed(made: socket.socket) -> bytes:
    parts = []
    with contextlib.suppress(ConnectionError):
        while part := made.recv(65_536):
            parts.append(part)
    return b"".join(parts)


@pytest.fixture
def running(dozen: Any) -> Iterator[Running]:
    made = Running(Document.from_layout(dozen))
    yield made
    made.stop()


def test_the_page_comes_through_hundreds_of_half_sent_requests(running: Running) -> None:
    half = [running.open(HALF) for _ in range(5 * MOST_CONNECTIONS)]
    try:
        for _ in range(3):
            assert running.asked("GET / HTTP/1.1").startswith(b"HTTP/1.1 200")
        ended = 0
        for one in half:
            one.setblocking(False)
            with contextlib.suppress(BlockingIOError):
                ended += until_closed(one) == b""
        assert ended >= 4 * MOST_CONNECTIONS
    finally:
        for one in half:
            one.close()


def test_a_request_whose_head_does_not_come_is_ended(
    running: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serving, "HEAD_SECONDS", 0.2)
    whole = f"GET /static/main.js HTTP/1.1\r\nhost: {running.host}\r\n\r\n".encode()
    for sent in (b"", HALF, whole + HALF):
        with running.open(sent) as made:
            answer = until_closed(made)
            assert (answer == b"") is (not sent.startswith(whole))
    # A byte now and then does not put it off.
    with running.open(HALF) as made, contextlib.suppress(ConnectionError):
        end = time.monotonic() + PATIENCE_SECONDS
        while time.monotonic() < end:
            made.sendall(b"a")
            time.sleep(0.02)
        raise AssertionError("the connection is still there")


def test_a_file_that_does_not_come_is_refused_in_a_line(
    running: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(routes, "BODY_SECONDS", 0.2)
    mine = {
        "origin": f"http://{running.host}", "sec_fetch_site": "same-origin",
        "x_packwork_token": running.secret.token,
    }  # fmt: skip
    answer = running.asked("POST /export HTTP/1.1", b"{", content_length="9", **mine)
    assert answer.startswith(b"HTTP/1.1 400")
    assert b"takes longer than 0.2 seconds" in answer


def test_an_answer_that_is_not_read_is_ended(
    running: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guard, "OPEN_SECONDS", 0.2)
    head = f"GET /static/studio.css HTTP/1.1\r\nhost: {running.host}\r\n\r\n".encode()
    with socket.socket() as made:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4_096)
        made.settimeout(PATIENCE_SECONDS)
        made.connect(running.place)
        for _ in range(200):
            with contextlib.suppress(ConnectionError):
                made.sendall(head)
        time.sleep(1.0)
        read = until_closed(made)
    whole = running.asked("GET /static/studio.css HTTP/1.1")
    assert len(read) < 200 * len(whole)
    assert running.asked("GET / HTTP/1.1").startswith(b"HTTP/1.1 200")

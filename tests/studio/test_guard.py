"""Nobody but the page that was opened may speak to the studio."""

from __future__ import annotations

import asyncio
import re
from typing import Any

import pytest
from starlette.applications import Starlette
from starlette.routing import Mount, Route, WebSocketRoute

from each import for_each
from packwork.live.face.opening import Opening
from packwork.studio.app import Studio, page_text
from packwork.studio.files import Uploads
from packwork.studio.guard import AGAIN, OPEN, Guard, Message
from packwork.studio.proof import Secret, mac
from packwork.studio.workspace import Workspace

HOST = "127.0.0.1:8123"
SECRET = Secret(HOST, "a-secret-that-nobody-knows", "k" * 64, nonce="n")
TOKEN = SECRET.token
ORIGIN = f"http://{HOST}"


def routes() -> list[Any]:
    uploads = Uploads()
    uploads.close()
    return Studio(Workspace(Opening()), uploads, SECRET).routes


def asked() -> list[tuple[str, str, str]]:
    """Kind, method and path of all that is served."""
    found = []
    for route in routes():
        if isinstance(route, WebSocketRoute):
            found.append(("websocket", "GET", route.path))
        elif isinstance(route, Mount):
            found.append(("http", "GET", f"{route.path}/main.js"))
        else:
            assert isinstance(route, Route)
            path = route.path.replace("{batch}", "0" * 16).replace("{nonce}", "1" * 32)
            found += [("http", method, path) for method in sorted(route.methods or ())]
    return found


ASKED = asked()
CLOSED = [
    one for one in ASKED if one[2] not in {"/", f"/proof/{'1' * 32}"} and "main.js" not in one[2]
]
PROOF_OF_PAGE = mac(SECRET.key_before, f"page {HOST} {SECRET.nonce}")


def headers_of(
    kind: str, method: str, path: str = "", **changed: str | None
) -> list[tuple[bytes, bytes]]:
    """What the studio's own page sends."""
    given: dict[str, str | None] = {"host": HOST}
    if kind == "websocket":
        given |= {"origin": ORIGIN, "sec-websocket-protocol": f"packwork, token.{TOKEN}"}
    else:
        given |= {"x-packwork-token": PROOF_OF_PAGE if path == AGAIN else TOKEN}
    if method == "POST":
        given |= {"origin": ORIGIN, "sec-fetch-site": "same-origin"}
    given |= {name.replace("_", "-"): value for name, value in changed.items()}
    return [(name.encode(), value.encode()) for name, value in given.items() if value is not None]


async def let_through(scope: Message, receive: Any, send: Any) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
    else:
        await send({"type": "http.response.start", "status": 204, "headers": []})


def answer(
    kind: str, method: str, path: str, headers: list[tuple[bytes, bytes]], app: Any = let_through
) -> list[Message]:
    """What the guard sends; what it lets through is answered by 204, unless by an application."""
    sent: list[Message] = []

    async def receive() -> Message:
        # A page that stays.
        return {"type": "websocket.connect"} if kind == "websocket" else await asyncio.Future()

    async def send(message: Message) -> None:
        sent.append(message)

    scope = {"type": kind, "method": method, "path": path, "root_path": "", "headers": headers}
    asyncio.run(Guard(app, SECRET)(scope, receive, send))
    return sent


def is_refused(sent: list[Message]) -> bool:
    first = sent[0]
    return first["type"] == "websocket.close" or first.get("status") == 403


def test_the_scan_sees_the_socket_and_all_that_is_posted() -> None:
    assert ("websocket", "GET", "/socket") in ASKED
    assert {path for _, method, path in ASKED if method == "POST"} >= {"/files", "/export"}
    assert OPEN == ("/", "/static/", "/proof/")


@for_each(ASKED)
def test_the_own_page_is_let_through(kind: str, method: str, path: str) -> None:
    assert not is_refused(answer(kind, method, path, headers_of(kind, method, path)))


@pytest.mark.parametrize("token", [None, "", "other", TOKEN[:-1], TOKEN + "x", "token.", "é"])
@for_each(CLOSED)
def test_without_the_token_all_but_the_page_is_refused(
    kind: str, method: str, path: str, token: str | None
) -> None:
    told = None if token is None else f"packwork, token.{token}"
    changed = (
        {"sec_websocket_protocol": told} if kind == "websocket" else {"x_packwork_token": token}
    )
    assert is_refused(answer(kind, method, path, headers_of(kind, method, path, **changed)))


@pytest.mark.parametrize(
    "host",
    [None, "", "evil.example", "evil.example:8123", "localhost:8123", "127.0.0.1", "127.0.0.1:80",
     "127.0.0.1:8123.evil.example", "127.0.0.1:8123 "],
)  # fmt: skip
@for_each(ASKED)
def test_another_host_is_refused_even_for_the_page(
    kind: str, method: str, path: str, host: str | None
) -> None:
    assert is_refused(answer(kind, method, path, headers_of(kind, method, path, host=host)))


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "null", "https://127.0.0.1:8123", "http://127.0.0.1:81234", ""],
)
@for_each(ASKED)
def test_another_origin_is_refused(kind: str, method: str, path: str, origin: str) -> None:
    assert is_refused(answer(kind, method, path, headers_of(kind, method, path, origin=origin)))


@for_each(ASKED)
def test_a_name_that_was_bound_to_this_machine_is_refused(
    kind: str, method: str, path: str
) -> None:
    # Host and origin agree, and even the token is known: the address is still another one.
    there = {"host": "rebound.example:8123", "origin": "http://rebound.example:8123"}
    assert is_refused(answer(kind, method, path, headers_of(kind, method, path, **there)))


def test_a_socket_without_an_origin_is_refused() -> None:
    assert is_refused(
        answer("websocket", "GET", "/socket", headers_of("websocket", "", origin=None))
    )


@pytest.mark.parametrize("site", [None, "cross-site", "same-site", "none"])
@pytest.mark.parametrize("path", ["/", "/files", "/export", "/static/main.js"])
def test_what_is_posted_comes_from_the_page(path: str, site: str | None) -> None:
    headers = headers_of("http", "POST", sec_fetch_site=site)
    assert is_refused(answer("http", "POST", path, headers))


@pytest.mark.parametrize("name", ["host", "origin", "x-packwork-token"])
def test_a_header_that_is_there_twice_is_refused(name: str) -> None:
    headers = headers_of("http", "POST")
    again = [(one, value) for one, value in headers if one == name.encode()]
    assert is_refused(answer("http", "POST", "/files", [*headers, *again]))


def test_other_kinds_of_connections_are_refused() -> None:
    guard = Guard(lambda *_: asyncio.sleep(0), SECRET)
    scope = {"type": "webtransport", "headers": headers_of("http", "GET"), "path": "/"}
    assert guard.refusal(scope) is not None


def test_answers_say_what_a_page_may_do() -> None:
    (first, *_) = answer("http", "GET", "/", headers_of("http", "GET", x_packwork_token=None))
    said = {name.decode(): value.decode() for name, value in first["headers"]}
    policy = said["content-security-policy"]
    for part in (
        "default-src 'self'",
        "object-src 'none'",
        "frame-ancestors 'none'",
        "base-uri 'none'",
    ):
        assert part in policy
    assert "unsafe" not in policy
    assert "*" not in policy
    assert said["x-content-type-options"] == "nosniff"
    assert said["referrer-policy"] == "no-referrer"


def test_the_page_names_what_browsers_keep_by_its_version_and_all_else_is_not_stored() -> None:
    app = Starlette(routes=routes())

    def kept(path: str) -> tuple[int, bytes]:
        sent = answer("http", "GET", path, headers_of("http", "GET"), app)
        return sent[0]["status"], dict(sent[0]["headers"])[b"cache-control"]

    parts = re.findall(r'"(/static/[^"]+)"', page_text())
    assert {one.rpartition("/")[2] for one in parts} >= {"icon.svg", "studio.css", "main.js"}
    assert {kept(one) for one in parts} == {(200, b"max-age=31536000, immutable")}
    # Also what there is not, lest a browser keeps that.
    others = ("/", "/choices", "/static/main.js", "/static/0123456789abcdef/main.js")
    missing = f"{parts[0].rpartition('/')[0]}/none.js"
    assert {kept(one)[1] for one in (*others, missing)} == {b"no-store"}

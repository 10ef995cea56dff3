"""Access to the studio: one gate for pages, requests and sockets, before anything is done.

A page of any other place can send requests to this machine, and by rebinding a name can even seem
to be of the same place. So all that comes in has to name the very host and port that we listen at;
whatever is not a page of ours also needs the token, which follows from the secret in the fragment
of the address that was opened, so that it is in no log and no referrer.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable, MutableMapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from packwork.studio.proof import Secret

Message: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[Message]]
Send: TypeAlias = Callable[[Message], Awaitable[None]]
App: TypeAlias = Callable[[Message, Receive, Send], Awaitable[None]]

PROTOCOL = "packwork"
"""Subprotocol that sockets speak; beside it they offer the token as another one."""

TOKEN_PREFIX = "token."  # noqa: S105
"""Of the subprotocol that carries the token."""

TOKEN_HEADER = "x-packwork-token"  # noqa: S105
"""Header of requests that carries it."""

OPEN = ("/", "/static/", "/proof/")
"""What is served without a token: the page and its parts, which hold nothing of anybody's, and the
proof that they are ours. A path that ends in a stroke stands for all below it, but the root for
itself alone."""

OPEN_SECONDS = 60.0
"""How long such an answer may take to be read. Chosen."""

AGAIN = "/again"
"""Where a page of the studio before asks for the new secret: with a proof in place of the token."""

POLICY = (
    "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws://{host}; "
    "object-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
)
"""What a page of ours may load, and who may show it: our own modules alone."""


@dataclass(frozen=True)
class Guard:
    """Lets through what comes from the page that was opened, and nothing else."""

    app: App
    secret: Secret

    @property
    def host(self) -> str:
        """Host and port as the address has them."""
        return self.secret.host

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        """Refuse what is not ours, else hand it on; answers say what browsers may do with them."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
        elif (reason := self.refusal(scope)) is not None:
            await _refuse(scope, receive, send, reason)
        elif scope["type"] == "http" and _is_open(scope["path"]):
            # Whoever reads an answer slowly is nobody whom we know.
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(OPEN_SECONDS):
                    await self.app(scope, receive, self._with_policy(send))
        else:
            await self.app(scope, receive, self._with_policy(send))

    def refusal(self, scope: Message) -> str | None:
        """Why something is refused, a line; None if it may pass."""
        headers = [(name.decode("latin-1").lower(), value) for name, value in scope["headers"]]
        if _only(headers, "host") != self.host:
            return "this address is not where the studio is"
        origins = [value for name, value in headers if name == "origin"]
        is_socket = scope["type"] == "websocket"
        if (origins or is_socket) and _only(headers, "origin") != f"http://{self.host}":
            return "this is for the studio's own page"
        if is_socket:
            has_token = any(map(self.secret.is_token, _offered(headers)))
            return None if has_token else "the token is missing"
        if scope["type"] != "http":
            return "the studio does not speak this"
        is_read = scope["method"] in {"GET", "HEAD"}
        if not is_read and _only(headers, "sec-fetch-site") != "same-origin":
            return "this is for the studio's own page"
        if is_read and _is_open(scope["path"]):
            return None
        token = _only(headers, TOKEN_HEADER) or ""
        is_known = self.secret.is_page_before if scope["path"] == AGAIN else self.secret.is_token
        return None if is_known(token) else "the token is missing"

    def _with_policy(self, send: Send) -> Send:
        """Have answers carry what browsers are to keep to, unless they say it themselves."""
        policy = _policy(self.host)

        async def sent(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*(policy | dict(message.get("headers", ()))).items()]
            await send(message)

        return sent


def _only(headers: list[tuple[str, bytes]], name: str) -> str | None:
    """Value of a header that is there once."""
    found = [value for one, value in headers if one == name]
    return found[0].decode("latin-1") if len(found) == 1 else None


def _offered(headers: list[tuple[str, bytes]]) -> list[str]:
    """Tokens among the subprotocols that a socket offers."""
    tokens = (_only(headers, "sec-websocket-protocol") or "").split(",")
    names = [one.strip() for one in tokens]
    return [one.removeprefix(TOKEN_PREFIX) for one in names if one.startswith(TOKEN_PREFIX)]


def _is_open(path: str) -> bool:
    """Whether a path is served without a token.

    Examples
    --------
    >>> _is_open("/"), _is_open("/static/main.js"), _is_open("/drawings"), _is_open("/static")
    (True, True, False, False)
    """
    root, *folders = OPEN
    return path == root or any(path.startswith(folder) for folder in folders)


def _policy(host: str) -> dict[bytes, bytes]:
    said = {
        "content-security-policy": POLICY.format(host=host),
        "x-content-type-options": "nosniff",
        "x-frame-options": "DENY",
        "referrer-policy": "no-referrer",
        "cross-origin-opener-policy": "same-origin",
        "cross-origin-resource-policy": "same-origin",
        "cache-control": "no-store",
    }
    return {name.encode(): value.encode() for name, value in said.items()}


async def _refuse(scope: Message, receive: Receive, send: Send, reason: str) -> None:
    if scope["type"] == "websocket":
        # Before it was accepted: the server answers 403.
        await receive()
        await send({"type": "websocket.close", "code": 4403, "reason": reason})
        return
    body = f"{reason}\n".encode()
    headers = [
        (b"content-type", b"text/plain; charset=utf-8"),
        (b"content-length", str(len(body)).encode()),
        (b"x-content-type-options", b"nosniff"),
        (b"connection", b"close"),
    ]
    await send({"type": "http.response.start", "status": 403, "headers": headers})
    await send({"type": "http.response.body", "body": body})

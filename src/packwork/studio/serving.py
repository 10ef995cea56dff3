"""The studio on a port of this machine, and the address that opens it."""

from __future__ import annotations

import asyncio
import html
import os
import socket
import sys
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from packwork.errors import PackworkError
from packwork.live.face.opening import Opening
from packwork.studio import kept_workspaces
from packwork.studio.app import guarded
from packwork.studio.files import Uploads
from packwork.studio.kept_workspaces import KeptWorkspace
from packwork.studio.messages import MOST_TEXT
from packwork.studio.proof import Secret
from packwork.studio.workspace import Workspace

HERE = "127.0.0.1"
"""Where nobody but this machine can reach us."""

LOOPBACK = (HERE, "::1")
"""Where browsers take a page without encryption for safe."""

SWITCH_SECONDS = 0.0005
"""How long the session's thread goes on with Python's lock while the event loop has a message to
carry. Python's own 5 ms are waited for several times between a pointer's move and its frame; much
shorter costs the session time. Tried."""


@dataclass(frozen=True, kw_only=True)
class Address:
    """Address at which the studio listens.

    ``port``: 0 for any that is free.
    """

    host: str = HERE
    port: int = 0


def serve(
    opening: Opening,
    place: Address,
    kept: KeptWorkspace | None,
    *,
    browses: bool,
    tell: Callable[[str], object],
) -> None:
    """Serve until Ctrl-C.

    Parameters
    ----------
    kept
        Where it is kept, and was served before; None for nowhere.
    tell
        Told the address, a line.
    """
    port_before, key_before = (0, "") if kept is None else kept.address
    port = place.port or port_before
    if port != port_before:
        key_before = ""
    try:
        bound = _bound(Address(host=place.host, port=port))
    except PackworkError:
        if port == place.port:
            raise
        # Another program is there by now: its page has to be opened anew.
        bound, key_before = _bound(place), ""
    host, port = bound.getsockname()[:2]
    name = f"[{host}]:{port}" if ":" in host else f"{host}:{port}"
    secret = Secret(name, key_before=key_before, is_plain=host not in LOOPBACK)
    if kept is not None:
        kept.remember(port, secret.key)
    shelf = kept_workspaces.Shelf(port, secret.key)
    address = f"http://{name}/#{secret.text}"
    with closing(Uploads()) as uploads:
        config = uvicorn.Config(
            guarded(Workspace(opening, shelf), uploads, secret),
            log_level="warning",
            access_log=False,
            server_header=False,
            date_header=False,
            http=BoundedProtocol,
            ws="websockets-sansio",
            ws_max_size=4 * MOST_TEXT,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=1,
            lifespan="on",
        )
        tell(f"the studio is open at {address}\nit ends with Ctrl-C")
        if browses:
            # Whoever sees what is running sees no more than the name of a private file.
            webbrowser.open(_leading_to(address, uploads.root).as_uri())
        sys.setswitchinterval(SWITCH_SECONDS)
        with suppress(KeyboardInterrupt):
            uvicorn.Server(config).run(sockets=[bound])
    goes_on = "" if kept is None else f"; it goes on with: packwork studio {kept.inputs}"
    tell(f"the studio has ended{goes_on}")


def _leading_to(address: str, folder: Path) -> Path:
    """Page for this user alone that leads to an address."""
    file, there = folder / "open.html", html.escape(address)
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
    with os.fdopen(os.open(file, flags, 0o600), "w", encoding="utf-8") as page:
        page.write(
            f'<!doctype html><meta charset="utf-8"><meta name="referrer" content="no-referrer">'
            f'<meta http-equiv="refresh" content="0;url={there}"><title>Packwork studio</title>'
            f'<a href="{there}">Open the studio</a>'
        )
    return file


def _bound(place: Address) -> socket.socket:
    family = socket.AF_INET6 if ":" in place.host else socket.AF_INET
    bound = socket.socket(family, socket.SOCK_STREAM)
    if sys.platform == "win32":
        # There another program may else listen at the same port.
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_EXCLUSIVEADDRUSE, 1)
    else:
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        bound.bind((place.host, place.port))
        # From now on a browser that is early waits, and is not turned away.
        bound.listen()
    except (OSError, OverflowError) as error:
        bound.close()
        raise PackworkError(
            f"port {place.port} of {place.host} cannot be used ({error}); leave --port out for "
            "one that is free"
        ) from None
    return bound


HEAD_SECONDS = 10.0
"""How long a request's head may take to arrive. Shorter cuts off slow networks. Chosen."""

MOST_CONNECTIONS = 64
"""Connections at a time, sockets not counted. Chosen: eight pages of six, and some."""


@final
class BoundedProtocol(H11Protocol):
    """HTTP/1.1 of uvicorn, with bounds."""

    _late: asyncio.TimerHandle | None = None
    _began: float = 0.0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take a connection; the one that has waited for longest gives way where there are many."""
        super().connection_made(transport)  # type: ignore[arg-type]
        self._began = self.loop.time()
        self._watch()
        if len(self.connections) > MOST_CONNECTIONS:
            oldest = min(self._waiting(), key=lambda one: one._began, default=self)
            oldest.end()

    def data_received(self, data: bytes) -> None:
        """Take a part of a request."""
        super().data_received(data)
        self._watch()

    def handle_websocket_upgrade(self, event: Any) -> None:
        """Hand the connection on to a socket."""
        self._unwatch()
        super().handle_websocket_upgrade(event)

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        self._unwatch()
        super().connection_lost(exc)

    @property
    def is_waiting(self) -> bool:
        """Whether no whole request is there that has not been answered."""
        return self.cycle is None or self.cycle.response_complete

    def end(self) -> None:
        """End the connection at once; it is counted no more."""
        self._unwatch()
        self.connections.discard(self)
        self.transport.abort()

    def _waiting(self) -> Iterator[BoundedProtocol]:
        for one in self.connections:
            if isinstance(one, BoundedProtocol) and one.is_waiting:
                yield one

    def _watch(self) -> None:
        """Give a head its time, and a whole request as long as it takes."""
        if not self.is_waiting or self.transport.get_protocol() is not self:
            self._unwatch()
        elif self._late is None:
            self._late = self.loop.call_later(HEAD_SECONDS, self.end)

    def _unwatch(self) -> None:
        if self._late is not None:
            self._late.cancel()
            self._late = None

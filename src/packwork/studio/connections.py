"""Connections to the studio, bounded in number and in the time that a request may take to arrive.

Anybody on this machine can connect and send half a request. A connection that waits for the rest is
ended after a while, and at once where another one needs its place: a browser sends what it asks for
as soon as it is connected, so that the page always comes through.
"""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any, final

from uvicorn.protocols.http.h11_impl import H11Protocol

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

"""Listeners that are told of kernels that are compiled."""

from __future__ import annotations

import contextlib
import functools
import logging
from collections.abc import Iterator
from typing import Protocol

NOTICE = "compiling kernels, once for each kind of run: up to 40 s of one processor core"

_LOG = logging.getLogger("packwork")


class Listener(Protocol):
    """Callback for kernels that are compiled."""

    def __call__(self, kernel: str, is_done: bool) -> None:
        """Called before a kernel is compiled, and after."""
        ...


_listeners: list[Listener] = []


@contextlib.contextmanager
def listening(listener: Listener) -> Iterator[None]:
    """Tell ``listener`` what is compiled while the block runs, in place of the log."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


@functools.cache
def _tell_once() -> None:
    _LOG.warning(NOTICE)


def tell(name: str, is_done: bool) -> None:
    """Tell all that listen, else the log, once, of a kernel before it is compiled, and after."""
    if not _listeners:
        _tell_once()
    for listener in _listeners:
        listener(name, is_done)

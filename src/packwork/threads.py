"""Threads of one run: how many it may use, and calls of kernels that are made at once.

Kernels run without Python's lock. What is called at once must not touch, and comes back in the
order of the calls, so that no result depends on how many threads there are.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextvars import ContextVar
from typing import Any, TypeVar

Result = TypeVar("Result")

_ASKED: ContextVar[int | None] = ContextVar("threads", default=None)

_pools: dict[int, ThreadPoolExecutor] = {}


def available() -> int:
    """Number of processor cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def thread_count() -> int:
    """Number of threads that a run may use here: what was asked for, else one a core.

    Examples
    --------
    >>> with using(3):
    ...     thread_count()
    3
    """
    return _ASKED.get() or available()


@contextlib.contextmanager
def using(count: int | None) -> Iterator[None]:
    """Let what the block runs use so many threads; None: as many as there are cores."""
    before = _ASKED.set(count)
    try:
        yield
    finally:
        _ASKED.reset(before)


def at_once(call: Callable[..., Result], arguments: Sequence[tuple[Any, ...]]) -> list[Result]:
    """Results of one call for each of some arguments, in their order, by several threads.

    Ends when all have ended, however that is; what is called makes no further calls at once.

    Examples
    --------
    >>> at_once(max, [(1, 2), (4, 3)])
    [2, 4]
    """
    helpers = min(thread_count(), len(arguments)) - 1
    if helpers < 1:
        return [call(*one) for one in arguments]
    found: dict[int, Result] = {}
    waiting = iter(range(len(arguments)))

    def work() -> None:
        # Python's lock lets one thread at a time take the next number.
        try:
            for k in waiting:
                found[k] = call(*arguments[k])
        finally:
            # Once a call has failed, none begins any more.
            for _ in waiting:
                pass

    helping = list[Future[None]]()
    try:
        # A process that ends, or one that may have no more threads, grants none: then without.
        with contextlib.suppress(RuntimeError):
            for _ in range(helpers):
                helping.append(_pool(thread_count() - 1).submit(work))
        work()
    finally:
        # Those that have not begun would find nothing left to do.
        begun = [one for one in helping if not one.cancel()]
        wait(begun)
    for one in begun:
        one.result()
    return [found[k] for k in range(len(arguments))]


def _pool(helpers: int) -> ThreadPoolExecutor:
    """Threads that help: one pool for each number that runs may use, kept for later calls."""
    if helpers not in _pools:
        _pools[helpers] = ThreadPoolExecutor(helpers, "packwork")
    return _pools[helpers]


if hasattr(os, "register_at_fork"):
    # A process that was forked has none of the threads.
    os.register_at_fork(after_in_child=_pools.clear)

"""Worker processes of this machine: tasks to outcomes, whatever becomes of a worker.

A worker that dies, as one does for which there is not enough memory, takes with it only the row
that it was at: rows that were under way are run again, one at a time, and the one that kills its
worker again has failed.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.synchronize import Event

from packwork import pipeline, threads
from packwork.batches.task import Outcome, Task, failed, make
from packwork.progress import Stop, never

AHEAD = 3
"""Tasks for each worker that wait for it. More are begun in vain when all is stopped. Chosen."""

LOOK_SECONDS = 0.2
"""Between two looks at whether to stop. Chosen."""

_stopped: Event | None = None


def outcomes(tasks: Sequence[Task], workers: int, stop: Stop = never) -> Iterator[Outcome]:
    """Outcomes of tasks, as they come; those that are not begun when it is stopped have none.

    Parameters
    ----------
    workers
        Processes; with 1 all is done in this one.
    """
    if workers == 1 or len(tasks) == 1:
        for task in tasks:
            if stop():
                return
            yield make(task, stop)
        return
    waiting = list(reversed(tasks))
    while waiting and not stop():
        lost: list[Task] = []
        yield from _some(waiting, min(workers, len(waiting)), stop, lost)
        for task in lost:
            if stop():
                return
            again: list[Task] = []
            yield from _some([task], 1, stop, again)
            for one in again:
                yield failed(one.row, one.name, "its process was ended, as where memory runs out")


def _some(waiting: list[Task], workers: int, stop: Stop, lost: list[Task]) -> Iterator[Outcome]:
    """Outcomes until all is done or a worker dies; what was under way then is lost."""
    context = multiprocessing.get_context("spawn")
    event = context.Event()
    executor = ProcessPoolExecutor(workers, context, _begin, (event,))
    under_way: dict[Future[Outcome], Task] = {}
    try:
        while (waiting and not lost) or under_way:
            while waiting and not lost and len(under_way) < workers + AHEAD and not stop():
                task = waiting.pop()
                try:
                    under_way[executor.submit(_made, task)] = task
                except BrokenProcessPool:
                    lost.append(task)
            if stop():
                event.set()
                waiting.clear()
            for future in wait(under_way, LOOK_SECONDS, FIRST_COMPLETED).done:
                task = under_way.pop(future)
                try:
                    outcome = future.result()
                except BrokenProcessPool:
                    lost.append(task)
                    continue
                except Exception as error:  # noqa: BLE001
                    outcome = failed(task.row, task.name, f"{type(error).__name__}: {error}")
                yield outcome
    finally:
        event.set()
        executor.shutdown(wait=True, cancel_futures=True)


def _begin(stopped: Event) -> None:
    """Prepare a worker: Ctrl-C is heard by the process that it works for."""
    global _stopped
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _stopped = stopped
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with threads.using(1):
        pipeline.warm_up_once()


def _end_with_parent() -> None:
    """End this process when the one that it works for has ended, however that was."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        # Half a file is no file: all are written under other names first.
        os._exit(1)


def _made(task: Task) -> Outcome:
    return make(task, never if _stopped is None else _stopped.is_set)


def worker_count(asked: int | None, tasks: int) -> int:
    """Processes for so many tasks: as many as asked for, else one a core.

    Examples
    --------
    >>> worker_count(None, 1), worker_count(4, 9)
    (1, 4)
    """
    return max(1, min(asked or threads.available(), tasks))

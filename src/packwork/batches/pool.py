"""Worker processes of this machine: calls to results, whatever becomes of a worker.

A worker that dies, as one does for which there is not enough memory, takes with it only what it
was at: tasks that were under way are tried again, one at a time, and the one that kills its worker
again has failed.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.synchronize import Event
from typing import Generic, TypeVar

from packwork import precompile, threads
from packwork.errors import PackworkError
from packwork.offspring import end_with_parent
from packwork.progress import Stop, never

AHEAD = 3
"""Tasks that wait for a worker, beside those under way. More are begun in vain when all is stopped,
and tried again when a worker dies; fewer leave workers waiting. Chosen."""

LOOK_SECONDS = 0.2
"""Between two looks at whether to stop, and at how many workers a cluster has. Chosen."""

Task = TypeVar("Task")
Result = TypeVar("Result")

Call = Callable[[Task, Stop], Result]
"""What is done for a task, until it is to stop; at the top of a module, so that workers find it."""

_stopped: Event | None = None


class WorkerDiedError(PackworkError):
    """A worker process was ended from outside, twice at the same task."""

    def __init__(self) -> None:
        super().__init__("its process was ended, as where memory runs out")


def results(
    tasks: Sequence[Task], call: Call[Task, Result], workers: int, stop: Stop = never
) -> Iterator[tuple[Task, Result | Exception]]:
    """Results of a call for each task, or what it raised, as they come.

    Tasks that are not begun when it is stopped have none. One worker is this process itself.

    Examples
    --------
    >>> [result for _, result in results([2, 3], lambda task, stop: task**2, 1)]
    [4, 9]
    """
    if workers == 1 or len(tasks) == 1:
        for task in tasks:
            if stop():
                return
            try:
                found: Result | Exception = call(task, stop)
            except Exception as error:  # noqa: BLE001
                found = error
            yield task, found
        return
    waiting = list(reversed(tasks))
    while waiting and not stop():
        pool = _Pool(call, min(workers, len(waiting)), stop)
        yield from pool.run(waiting)
        for task in pool.lost:
            if stop():
                return
            alone = _Pool(call, 1, stop)
            yield from alone.run([task])
            if alone.lost:
                yield task, WorkerDiedError()


class _Pool(Generic[Task, Result]):
    """Workers until all is done or one of them dies; what was under way then is lost."""

    def __init__(self, call: Call[Task, Result], workers: int, stop: Stop) -> None:
        context = multiprocessing.get_context("spawn")
        self._call, self._workers, self._stop = call, workers, stop
        self._event = context.Event()
        self._executor = ProcessPoolExecutor(workers, context, _begin, (self._event,))
        self._under_way: dict[Future[Result], Task] = {}
        self.lost: list[Task] = []

    def run(self, waiting: list[Task]) -> Iterator[tuple[Task, Result | Exception]]:
        """Results of those that wait, from the end of the list; what is left there is not begun."""
        try:
            while (waiting and not self.lost) or self._under_way:
                if self._stop():
                    self._event.set()
                    waiting.clear()
                while waiting and not self.lost and len(self._under_way) < self._workers + AHEAD:
                    task = waiting.pop()
                    try:
                        self._under_way[self._executor.submit(_called, self._call, task)] = task
                    except BrokenProcessPool:
                        self.lost.append(task)
                for future in wait(self._under_way, LOOK_SECONDS, FIRST_COMPLETED).done:
                    yield from self._taken(future)
        finally:
            self._event.set()
            self._executor.shutdown(wait=True, cancel_futures=True)

    def _taken(self, future: Future[Result]) -> Iterator[tuple[Task, Result | Exception]]:
        task = self._under_way.pop(future)
        try:
            yield task, future.result()
        except BrokenProcessPool:
            self.lost.append(task)
        except Exception as error:  # noqa: BLE001
            yield task, error


def _begin(stopped: Event) -> None:
    """Prepare a worker: Ctrl-C is heard by the process that it works for."""
    global _stopped
    end_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _stopped = stopped
    threading.Thread(target=_follow_parent, daemon=True).start()
    with threads.using(1):
        precompile.warm_up_once()


def _follow_parent() -> None:
    """End this process when the one that it works for has ended, on systems that do not do so."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        # Half a file is no file: all are written under other names first.
        os._exit(1)


def _called(call: Call[Task, Result], task: Task) -> Result:
    return call(task, never if _stopped is None else _stopped.is_set)


def worker_count(asked: int | None, tasks: int) -> int:
    """Processes for so many tasks: as many as asked for, else one a core."""
    return max(1, min(asked or threads.available(), tasks))

"""Workers of a running cluster of Dask: tasks to outcomes, whatever becomes of a worker.

What a task reads goes to the worker by content, what it makes comes back by content, and this
process writes it. So a task may be begun anew anywhere: the scheduler tries one whose worker died
on another, and gives it up once it has killed several. Few tasks are there at a time, so that
neither scheduler nor workers hold more of them than they are at.
"""

from __future__ import annotations

import glob
import logging
import math
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from packwork import precompile, threads
from packwork.batches.pool import LOOK_SECONDS
from packwork.batches.task import Drawn, RowOutcome, Task, draw, failed, make, write
from packwork.display.extras import import_extra
from packwork.errors import PackworkError
from packwork.installed import installed_version
from packwork.progress import Stop, never
from packwork.readers.reading import is_folder
from packwork.recipe_paths import named_files
from packwork.sources import mirrored, place_in
from packwork.temporary import TemporaryFolder

AHEAD = 2
"""Tasks for each thread of a worker that are there at a time. Fewer leave workers waiting, more are
held by the scheduler for nothing. Chosen."""

LOST_SECONDS = 10.0
"""For which a scheduler is waited for at first, and may not be heard of before it counts as lost.
Chosen."""

MOST_CARRIED = 256_000_000
"""Bytes of files that go with one task. Chosen."""

_ONE_AT_A_TIME = threading.Lock()
"""What is heard and noted of a run is of the whole process: its threads take turns."""


@dataclass(frozen=True)
class Parcel:
    """A task with what it reads.

    Content by name as its options have it, names of folders (which may be empty), and the version
    of the program that sends it.
    """

    task: Task
    files: dict[str, bytes]
    folders: tuple[str, ...]
    version: str


def run_on_cluster(
    tasks: Sequence[Task], address: str, *, in_place: bool = False, stop: Stop = never
) -> Iterator[tuple[Task, RowOutcome | Exception]]:
    """Outcomes of tasks by the workers of a cluster, as they come.

    Tasks that are not done when it is stopped, or the scheduler is lost, have none. Workers that
    see the same files as this process write the outputs themselves (``in_place``).
    """
    with ExitStack() as stack:
        stack.enter_context(_quiet())
        client = _connected(address)
        stack.callback(_closed, client)
        yield from _Dealer(client, tasks, in_place, stop).outcomes()


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep what Dask says of lost connections from the terminal: it is told in one line."""
    logger = logging.getLogger("distributed")
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(before)


def _connected(address: str) -> Any:
    distributed = import_extra("distributed", "leave --scheduler out")
    try:
        client = distributed.Client(address, timeout=LOST_SECONDS, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as error:
        why = " ".join(str(error).split())[:200] or type(error).__name__
        raise PackworkError(f"there is no scheduler at {address[:80]}: {why}") from None
    return client


def _closed(client: Any) -> None:
    try:
        client.close(timeout=LOST_SECONDS)
    except (OSError, TimeoutError):
        return


class _Dealer:
    """Deals tasks out, few at a time, and takes what comes."""

    def __init__(self, client: Any, tasks: Sequence[Task], in_place: bool, stop: Stop) -> None:
        self._client, self._in_place, self._stop = client, in_place, stop
        self._waiting = list(reversed(tasks))
        self._under_way: dict[Any, Task] = {}
        self._heard = time.monotonic()
        self._counted, self._counted_at = 0, -math.inf

    def outcomes(self) -> Iterator[tuple[Task, RowOutcome | Exception]]:
        while self._waiting or self._under_way:
            if self._stop() or self._is_lost():
                if self._client.status == "running":
                    self._client.cancel(list(self._under_way))
                return
            yield from self._dealt()
            done = [future for future in self._under_way if future.done()]
            for future in done:
                task = self._under_way.pop(future)
                found = self._taken(future, task)
                if found is None:
                    self._waiting.append(task)
                else:
                    yield task, found
            if not done:
                time.sleep(LOOK_SECONDS)

    def _is_lost(self) -> bool:
        """Whether the scheduler was not heard of for long."""
        if self._client.status == "running":
            self._heard = time.monotonic()
        is_over = self._client.status == "closed"
        return is_over or time.monotonic() - self._heard > LOST_SECONDS

    def _dealt(self) -> Iterator[tuple[Task, RowOutcome | Exception]]:
        """Send tasks as long as workers have few; outcomes of those that cannot be sent."""
        while self._waiting and len(self._under_way) < max(AHEAD * self._threads(), 1):
            if self._client.status != "running":
                return
            task = self._waiting.pop()
            try:
                sent = task if self._in_place else parcel_of(task)
            except PackworkError as error:
                yield task, failed(task.row, task.name, error)
                continue
            call = make_in_place if self._in_place else draw_there
            # Not pure: what was made of the same content before is not taken for it.
            self._under_way[self._client.submit(call, sent, pure=False)] = task

    def _threads(self) -> int:
        """Threads of all workers; asked for now and then, since each answer names all of them."""
        now = time.monotonic()
        if now - self._counted_at >= LOOK_SECONDS:
            workers = self._client.scheduler_info(n_workers=-1).get("workers", {})
            self._counted = sum(worker["nthreads"] for worker in workers.values())
            self._counted_at = now
        return self._counted

    def _taken(self, future: Any, task: Task) -> RowOutcome | Exception | None:
        """Outcome of a task that is done; None if that is lost on its way here."""
        if future.status in {"cancelled", "lost"}:
            return None
        try:
            made = future.result(timeout=LOST_SECONDS)
        except Exception as error:  # noqa: BLE001
            if future.status != "error":
                # No fault of the task's: the connection broke while its outcome was fetched.
                return None
            if type(error).__name__ == "KilledWorker":
                return failed(
                    task.row, task.name, "its workers were ended, as where memory runs out"
                )
            return error
        return write(task, made) if isinstance(made, Drawn) else made


def parcel_of(task: Task) -> Parcel:
    """A task with the content of all files that its recipe names."""
    files: dict[str, bytes] = {}
    folders = []
    for name in dict.fromkeys(named_files(task.options)):
        if not name or len(name) > 4_000:
            continue
        for path in sorted(glob.glob(name)) if glob.has_magic(name) else [name]:  # noqa: PTH207
            if is_folder(path):
                folders.append(path)
                inside = [each for each in sorted(Path(path).iterdir()) if each.is_file()]
                files |= {str(each): _content(each) for each in inside}
            elif _is_file(path):
                files[path] = _content(Path(path))
    if sum(map(len, files.values())) > MOST_CARRIED:
        raise PackworkError(
            f"its files are larger than {MOST_CARRIED / 1e6:g} MB in all; use --in-place with a "
            "folder that workers see too"
        )
    return Parcel(task, files, tuple(folders), installed_version())


def _is_file(name: str) -> bool:
    try:
        return Path(name).is_file()
    except (OSError, ValueError):
        return False


def _content(path: Path) -> bytes:
    try:
        status = path.stat()
        return _read(str(path), status.st_mtime_ns, status.st_size)
    except OSError as error:
        raise PackworkError(f"{path}: cannot be opened: {error.strerror}") from None


@lru_cache(maxsize=256)
def _read(name: str, *_: int) -> bytes:
    # What each row reads is read once.
    return Path(name).read_bytes()


def draw_there(parcel: Parcel) -> Drawn | RowOutcome:
    """Run a task on a worker, its files laid in a folder of the worker's own."""
    _check_version(parcel.version)
    with _ONE_AT_A_TIME, TemporaryFolder("cluster") as folder:
        mirror = folder.path
        for name in parcel.folders:
            place_in(mirror, name).mkdir(parents=True, exist_ok=True)
        for name, content in parcel.files.items():
            place = place_in(mirror, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        _warm_up()
        with mirrored(mirror):
            return draw(parcel.task)


def make_in_place(task: Task) -> RowOutcome:
    """Run a task on a worker that sees the same files."""
    with _ONE_AT_A_TIME:
        _warm_up()
        return make(task)


def _warm_up() -> None:
    with threads.using(1):
        precompile.warm_up_once()


def _check_version(wanted: str) -> None:
    here = installed_version()
    if here != wanted:
        raise PackworkError(
            f"a worker has packwork {here}, this machine {wanted}; install one of them"
        )

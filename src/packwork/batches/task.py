"""One row of a batch: run, drawn, written with its record, in whatever process.

The record beside a row's files says what they were made of, so that none is made twice.
"""

from __future__ import annotations

import glob
import hashlib
import json
import logging
import os
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, TypeAlias

from packwork import pipeline, threads, uses, writers
from packwork.errors import PackworkError
from packwork.installed import installed_version
from packwork.progress import NOBODY, Stop, never
from packwork.recipe import make_recipe
from packwork.recipe_paths import named_files
from packwork.sources import check_no_input, note_input, noting_inputs

Status: TypeAlias = Literal["made", "short", "kept", "failed", "stopped"]
"""State of a row: ``short`` is made, but not as asked; ``kept`` was made before."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """Request of a row; plain values, so that it goes to any process.

    ``row`` is its number from 1; ``options`` are the recipe's with the row's cells in it, files by
    paths that the process finds; ``drawing`` are fields of ``DrawingOptions``.
    """

    row: int
    name: str
    options: Mapping[str, Any]
    outputs: tuple[Path, ...]
    drawing: Mapping[str, Any] = field(default_factory=dict)

    @property
    def key(self) -> str:
        """Hash of all that is asked for."""
        return key_of(self.options, self.outputs, self.drawing)

    def outcome(self, status: Status, **found: Any) -> RowOutcome:
        """Outcome of the row; ``found`` are further fields of it."""
        return RowOutcome(row=self.row, name=self.name, status=status, **found)


@dataclass(frozen=True, kw_only=True)
class RowOutcome:
    """Outcome of a row: files that are there, metrics of its layout if there is one.

    ``said`` tells why it failed or is not as asked.
    """

    row: int
    name: str
    status: Status
    outputs: tuple[Path, ...] = ()
    metrics: Mapping[str, Any] = field(default_factory=dict)
    seconds: float = 0.0
    said: str = ""
    notices: tuple[str, ...] = ()

    @property
    def is_well(self) -> bool:
        """Whether all is there, as asked."""
        return self.status in {"made", "kept"}


def failed(row: int, name: str, why: object) -> RowOutcome:
    """Outcome of a row of which nothing was made, in one line."""
    return RowOutcome(row=row, name=name, status="failed", said=" ".join(str(why).split())[:500])


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """Result of a row before it is written; plain values, so that it comes from any machine."""

    files: tuple[bytes, ...]
    told: Mapping[str, Any]
    read: tuple[str, ...]
    notices: tuple[str, ...] = ()


def make(task: Task, stop: Stop = never) -> RowOutcome:
    """Run a row and write its files, all or none."""
    found = draw(task, stop)
    return write(task, found) if isinstance(found, Drawn) else found


def draw(task: Task, stop: Stop = never) -> Drawn | RowOutcome:
    """Run a row and draw its files; what became of it where there is nothing to draw."""
    began = time.perf_counter()
    try:
        with noting_inputs() as noted, collecting_notices() as heard, threads.using(1):
            run = pipeline.run(uses.read(make_recipe(**task.options)), NOBODY, stop)
            if stop():
                return task.outcome("stopped")
            options = writers.write_options(**task.drawing)
            files = tuple(writers.encoded(run.layout, path, options) for path in task.outputs)
            pipeline.tell_coarse(run.layout, options.dpi)
            read = tuple(dict.fromkeys(noted.values()))
        told = _told(task, run, time.perf_counter() - began)
    except PackworkError as error:
        return failed(task.row, task.name, error)
    except MemoryError:
        return failed(task.row, task.name, "there is not enough memory for this row")
    return Drawn(files=files, told=told, read=read, notices=tuple(dict.fromkeys(heard)))


def write(task: Task, found: Drawn) -> RowOutcome:
    """Write the files of a row and its record, all or none."""
    try:
        with noting_inputs():
            for name in found.read:
                note_input(name)
            for path in task.outputs:
                check_no_input(path)
        drawn = list(zip(task.outputs, found.files, strict=True))
        # Digests of all that a row read and wrote.
        told = dict(found.told) | {
            "inputs": inputs_of(task.options, found.read),
            "outputs": {
                name: hashlib.sha256(data).hexdigest()
                for name, (_, data) in zip(relative(task.outputs), drawn, strict=True)
            },
        }
        writers.write_all([*drawn, (record_path(task.outputs), writers.json_bytes(told))])
    except PackworkError as error:
        return failed(task.row, task.name, error)
    figures = {name: told[name] for name in ("metrics", "seconds", "said")}
    return task.outcome(told["status"], outputs=task.outputs, notices=found.notices, **figures)


@contextmanager
def collecting_notices() -> Iterator[list[str]]:
    """Collect what the library logs in the block, which is then told nowhere else."""
    heard: list[str] = []
    handler = _LogCollector(heard)
    logger = logging.getLogger("packwork")
    before = logger.handlers, logger.propagate
    logger.handlers, logger.propagate = [handler], False
    try:
        yield heard
    finally:
        logger.handlers, logger.propagate = before


@contextmanager
def telling_once() -> Iterator[None]:
    """Have the library's log tell each line once in the block."""
    told: set[str] = set()

    def is_new(record: logging.LogRecord) -> bool:
        before = len(told)
        told.add(record.getMessage())
        return len(told) > before

    logger = logging.getLogger("packwork")
    logger.addFilter(is_new)
    try:
        yield
    finally:
        logger.removeFilter(is_new)


class _LogCollector(logging.Handler):
    def __init__(self, heard: list[str]) -> None:
        super().__init__(logging.WARNING)
        self._heard = heard

    def emit(self, record: logging.LogRecord) -> None:
        """Keep its text."""
        self._heard.append(record.getMessage())


def _told(task: Task, run: pipeline.Run, seconds: float) -> dict[str, Any]:
    """Figures that are kept of a run."""
    report = run.report()
    lacks = [f"{one['item']} is not placed: {one['reason']}" for one in report["unplaced"]]
    lacks += [*report["broken"], *report["skipped"]]
    if not run.certified and not lacks:
        lacks.append("is not certified")
    return {
        "key": task.key,
        "row": task.row,
        "name": task.name,
        "status": "made" if run.is_as_asked else "short",
        "said": "" if run.is_as_asked else "; ".join(lacks)[:500],
        "certified": run.certified,
        "metrics": {**report["metrics"], "items": report["placed"], "seed": report["seed"]},
        "seconds": round(seconds, 3),
        "recipe": make_recipe(**task.options).plain(),
    }


ENDING = ".batch.json"
"""Of the record, beside the first of a row's files."""

MOST_BYTES = 4_000_000
"""Of a record. Chosen."""


def record_path(outputs: Iterable[Path]) -> Path:
    """Path of a row's record, beside the first of its files."""
    first = next(iter(outputs))
    return first.with_name(first.stem + ENDING)


def relative(outputs: Iterable[Path]) -> list[str]:
    """Files of a row as seen from the folder of its record."""
    outputs = list(outputs)
    home = outputs[0].parent
    return [Path(os.path.relpath(path, home)).as_posix() for path in outputs]


def key_of(options: Mapping[str, Any], outputs: Iterable[Path], drawing: Mapping[str, Any]) -> str:
    """SHA-256 of all that is asked for, and of the version that makes it."""
    asked = {
        "packwork": installed_version(),
        "options": options,
        "outputs": relative(outputs),
        "drawing": drawing,
    }
    return hashlib.sha256(json.dumps(asked, sort_keys=True, default=str).encode()).hexdigest()


def inputs_of(options: Mapping[str, Any], read: Iterable[str]) -> dict[str, str]:
    """Digests of all files that were read, and of what the folders hold that are named."""
    named = [name for name in named_files(options) if name]
    listed = [name for name in named if glob.has_magic(name) or Path(name).is_dir()]
    return {name: digest_of(name) for name in sorted({*read, *listed})}


def digest_of(name: str | Path) -> str:
    """SHA-256 of a file's content, or of what a folder or a pattern lists; empty for nothing."""
    if glob.has_magic(str(name)):
        return _of_names(glob.glob(str(name), recursive=True))  # noqa: PTH207
    try:
        status = Path(name).stat()
        return _digest(str(name), status.st_mtime_ns, status.st_size, status.st_ino)
    except OSError:
        return ""


@lru_cache(maxsize=65_536)
def _digest(name: str, *_: int) -> str:
    # A file that stands in each row is read once.
    path = Path(name)
    if path.is_dir():
        return _of_names(each.name for each in path.iterdir())
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _of_names(names: Iterable[str]) -> str:
    return hashlib.sha256(os.fsencode("\n".join(sorted(names)))).hexdigest()


def is_done(key: str, outputs: Iterable[Path]) -> dict[str, Any] | None:
    """The record of a row whose files are all there and as they would be made; None else."""
    outputs = tuple(outputs)
    path = record_path(outputs)
    try:
        if path.stat().st_size > MOST_BYTES:
            return None
        found = json.loads(path.read_bytes())
        if found["key"] != key:
            return None
        told = {path.parent / name: digest for name, digest in found["outputs"].items()}
        is_whole = all(digest_of(path) == digest for path, digest in told.items())
        is_same = all(digest_of(name) == digest for name, digest in found["inputs"].items())
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return found if is_whole and is_same and len(told) == len(outputs) else None

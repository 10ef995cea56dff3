"""A session in a file: all documents that undo and redo lead to, and what they are made of."""

from __future__ import annotations

import contextlib
import io
import logging
import re
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, replace
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from packwork.errors import RecipeError, WriteError
from packwork.live.file.documents import (
    MOST_ROWS,
    DocumentRecord,
    documents_of,
    records_of,
    rows_of,
)
from packwork.live.file.parts import MOST_FOLD, PackedPart, packed, part_of
from packwork.live.file.records import ContainerRecord, ItemRecord
from packwork.live.file.things import Shared, Things, container_of, decoded, item_of
from packwork.live.history import MOST_ENTRIES, Marks, SessionState, UndoHistory
from packwork.live.local_solver import ENOUGH, STAGES
from packwork.options import Options
from packwork.phrasing import number_of
from packwork.readers.json_text import is_read
from packwork.readers.layouts.geojson import LARGEST_SCALE, SMALLEST_SCALE
from packwork.readers.reading import UnfitError, reading_file
from packwork.recipe.rules import MAX_COUNT
from packwork.scene.container import Container
from packwork.scene.item import Item

_LOG = logging.getLogger("packwork")

_Path = Annotated[str, Field(pattern=r"^(items|containers)/[0-9a-f]{64}\.json$")]
_Scale = Annotated[float, Field(ge=SMALLEST_SCALE / 2, le=2 * LARGEST_SCALE)]
_Ids = tuple[Annotated[int, Field(ge=0)], ...]


def _ascending(scales: tuple[float, float]) -> tuple[float, float]:
    if scales[0] > scales[1]:
        raise ValueError(f"the smallest scale, {scales[0]:g}, is above the largest, {scales[1]:g}")
    return scales


_Range = Annotated[tuple[_Scale, _Scale], AfterValidator(_ascending)]

MOST_TRIED = ENOUGH * STAGES * MAX_COUNT
"""Turns that polish tries at most before it has done with all. Derived."""


class MarksRecord(Options):
    """Marks of items that were changed, as :class:`Marks`."""

    touched: _Ids = ()
    placed_by_user: _Ids = ()
    turned: _Ids = ()
    vacated: _Ids = ()
    turned_by_hand: _Ids = ()
    recent: _Ids = ()
    unpolished: _Ids = ()
    edited: _Ids = ()
    ranges: dict[Annotated[int, Field(ge=0)], _Range] = Field(default_factory=dict)
    full: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    polished: Annotated[int, Field(ge=0, le=2**53)] = 0
    tried: Annotated[int, Field(ge=0, le=MOST_TRIED)] = 0


class SessionRecord(Options):
    """First record of a session file."""

    format: Literal[1] = 1
    """Raised when older programs cannot read what newer ones write."""
    follows: Annotated[str, Field(pattern="^([0-9a-f]{64})?$")] = ""
    """SHA-256 of the file that this one has replaced."""
    items: tuple[_Path, ...]
    containers: tuple[_Path, ...]
    documents: Annotated[
        tuple[DocumentRecord, ...], Field(min_length=1, max_length=2 * MOST_ENTRIES + 2)
    ]
    present: Annotated[int, Field(ge=0)]
    """Which of the documents is the present one: undo leads to those before it."""
    unsettled: bool = False
    """Whether the last of the documents is the one in which all had been settled last; unless so,
    the present one is."""
    marks: MarksRecord = MarksRecord()


def session_bytes(kept: SessionState, things: Things, follows: str = "") -> bytes:
    """File of a session, without the farthest steps of undo and redo if it would be too large.

    ``follows``: SHA-256 of the file that it is to replace; empty for none.

    Raises
    ------
    WriteError
        If what there is now is more than can be opened again.
    """
    past, future = kept.history.past, kept.history.future
    while True:
        record = _record(replace(kept, history=UndoHistory(past, future)), things, follows)
        first = record.model_dump_json(exclude_none=True).encode()
        parts = _parts_of(record, things)
        if rows_of(record.documents) <= MOST_ROWS and _is_opened_again(first, parts):
            break
        if not (past or future):
            size = (len(first) + sum(part.size for part in parts.values())) / 1e6
            most, most_in_one = MOST_BYTES // 1_000_000, MOST_PART_BYTES // 1_000_000
            raise WriteError("the session", f"could not be opened again: it takes {size:,.0f} MB; "
                f"{most:,} go, and {most_in_one} in one item or map")  # fmt: skip
        past, future = past[1 + len(past) // 8 :], future[: len(future) * 7 // 8]
    left_out = len(kept.history.past) - len(past) + len(kept.history.future) - len(future)
    if left_out:
        steps = number_of(left_out, "step")
        _LOG.warning("the file would be too large; it is kept without %s of undo or redo", steps)
    return packed({"session.json": part_of(first), **parts})


def _parts_of(record: SessionRecord, things: Things) -> dict[str, PackedPart]:
    paths = [*record.items, *record.containers]
    needed = sorted({need for path in paths for need in things.needs[path]})
    return {path: things.part(path) for path in (*paths, *needed)}


def _is_opened_again(first: bytes, parts: Mapping[str, PackedPart]) -> bool:
    """Whether reading accepts what is written."""
    sizes = [len(first), *(max(part.size, len(part.packed)) for part in parts.values())]
    in_all = sum(sizes) + _HEAD_BYTES * len(sizes)
    is_little = len(sizes) <= MOST_PARTS and in_all <= MOST_BYTES and max(sizes) <= MOST_PART_BYTES
    return is_little and is_read(first)


def _record(kept: SessionState, things: Things, follows: str) -> SessionRecord:
    past, future = kept.history.past, kept.history.future
    is_unsettled = kept.base is not kept.document
    documents = [*past, kept.document, *future, *([kept.base] if is_unsettled else [])]
    items = _Listed(lambda item: things.item(item))
    containers = _Listed(lambda container: things.container(container))

    def place(thing: object) -> int:
        return containers.place(thing) if isinstance(thing, Container) else items.place(thing)

    columns = asdict(kept.marks).items()
    plain = {k: tuple(sorted(v)) if isinstance(v, set) else v for k, v in columns}
    return SessionRecord(
        follows=follows,
        documents=tuple(records_of(documents, place)),
        items=items.paths,
        containers=containers.paths,
        present=len(past),
        unsettled=is_unsettled,
        marks=MarksRecord.model_validate(plain),
    )


def read_session(data: bytes, name: str) -> tuple[SessionState, str]:
    """Contents of a session file, and the SHA-256 of the file that it has replaced, or nothing."""
    with reading_file(name):
        try:
            return _read(unpacked(data))
        except RecipeError as error:
            raise UnfitError(f"holds what has no meaning: {error}") from None


def _read(parts: Mapping[str, bytes]) -> tuple[SessionState, str]:
    record = decoded(SessionRecord, parts["session.json"])
    shared = Shared(lambda path: _part(parts, path))
    known = {
        path: item_of(decoded(ItemRecord, _part(parts, path)), shared) for path in set(record.items)
    }
    items: list[Item] = [known[path] for path in record.items]
    walls = [
        container_of(decoded(ContainerRecord, _part(parts, path)), shared)
        for path in record.containers
    ]
    documents = list(documents_of(record.documents, items, walls))
    base = documents.pop() if record.unsettled else None
    if record.present >= len(documents):
        raise UnfitError(f"holds {len(documents)} documents and no number {record.present}")
    document = documents[record.present]
    history = UndoHistory(documents[: record.present], documents[record.present + 1 :])
    columns: dict[str, Any] = {k: set(v) if isinstance(v, tuple) else v for k, v in record.marks}
    marks = Marks(**columns)
    marks.keep(set(document.ids.tolist()))
    return SessionState(document, base or document, history, marks), record.follows


def _part(parts: Mapping[str, bytes], path: str) -> bytes:
    if path not in parts:
        raise UnfitError(f"lacks its part {path}")
    return parts[path]


class _Listed:
    """Parts in the order in which they are met, each once."""

    def __init__(self, path_of: Callable[..., str]) -> None:
        self._path_of = path_of
        self._places: dict[str, int] = {}

    @property
    def paths(self) -> tuple[str, ...]:
        """Of the parts."""
        return tuple(self._places)

    def place(self, thing: object) -> int:
        """Index of a thing among them."""
        return self._places.setdefault(self._path_of(thing), len(self._places))


MOST_BYTES = 1_000_000_000
"""Of a session file, packed and unpacked. Chosen: two hundred photographs."""

MOST_PART_BYTES = 120_000_000
"""Of one part unpacked: the large and the small copy of a photograph, or six million numbers.
Larger takes gigabytes once it is read. Derived."""

EASILY_UNPACKED = 100_000_000
"""Bytes that any file may unpack to, and larger ones ``MOST_FOLD`` times their size. Chosen."""

MOST_PARTS = 100_010
"""As many items as a layout may have, and a few. Chosen."""

_HEAD_BYTES = 300
"""What a zip adds to each part, at most. Derived."""

PART = re.compile(r"session\.json|(items|containers)/[0-9a-f]{64}\.json|(fonts|maps)/[0-9a-f]{64}")
"""Names of parts; no others are read."""


def unpacked(data: bytes) -> Mapping[str, bytes]:
    """Parts of a zip, each unpacked whenever it is asked for, so that never all are in memory.

    Examples
    --------
    >>> dict(unpacked(packed({"session.json": part_of(b"{}")})))
    {'session.json': b'{}'}
    """
    return _Parts(data)


class _Parts(Mapping[str, bytes]):
    def __init__(self, data: bytes) -> None:
        with _refusing():
            self._archive = zipfile.ZipFile(io.BytesIO(data))
            self._infos = {info.filename: info for info in self._archive.infolist()}
            _check_parts(self._archive.infolist(), len(data))

    def __getitem__(self, name: str) -> bytes:
        info = self._infos[name]
        with _refusing():
            if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
                raise UnfitError("is packed in a way that session files are not")
            with self._archive.open(info) as part:
                data = part.read(MOST_PART_BYTES + 1)
            if len(data) > MOST_PART_BYTES:
                raise UnfitError(f"holds a part of more than {MOST_PART_BYTES // 1_000_000} MB")
            return data

    def __iter__(self) -> Iterator[str]:
        return iter(self._infos)

    def __len__(self) -> int:
        return len(self._infos)


@contextlib.contextmanager
def _refusing() -> Iterator[None]:
    try:
        yield
    except UnfitError:
        raise
    except (
        zipfile.BadZipFile, zlib.error, EOFError, ValueError, OverflowError, NotImplementedError,
        RuntimeError, OSError, KeyError, IndexError, UnicodeDecodeError,
    ) as error:  # fmt: skip
        raise UnfitError(f"is no session file, or a spoilt one ({str(error)[:80]})") from None


def _check_parts(infos: list[zipfile.ZipInfo], size: int) -> None:
    names = [info.filename for info in infos]
    if len(infos) > MOST_PARTS or len(set(names)) < len(names):
        raise UnfitError(f"holds {len(infos)} parts; {MOST_PARTS} different ones go")
    strange = next((name for name in names if not PART.fullmatch(name)), None)
    if strange is not None:
        raise UnfitError(f"holds {strange[:60]!r}, which is no part of a session")
    if any(info.flag_bits & 0x1 for info in infos):
        raise UnfitError("is locked by a password")
    if "session.json" not in names:
        raise UnfitError("is no session file: it has no session.json")
    most = min(MOST_BYTES, max(EASILY_UNPACKED, MOST_FOLD * size))
    if sum(info.file_size for info in infos) > most:
        raise UnfitError(f"unpacks to more than {most // 1_000_000} MB, the most for its size")

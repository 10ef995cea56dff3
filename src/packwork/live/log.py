"""Log: all that was done to a document, one line each, so that it can be done again.

No line holds a time: of the flow it says how many epochs were run, so that a replay gives the
same bytes.
"""

from __future__ import annotations

import base64
import contextlib
import json
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any, Protocol, TypeAlias

from pydantic import Field, TypeAdapter, ValidationError

from packwork.errors import ReadError
from packwork.live.commands.command import Library
from packwork.live.commands.together import COMMANDS
from packwork.live.file.records import ContainerRecord, ItemRecord, Key
from packwork.live.file.things import (
    Shared,
    Things,
    container_of,
    container_record,
    item_of,
    item_record,
)
from packwork.live.file.values import bytes_of
from packwork.live.neighbourhood.flow import COARSEST, FINEST
from packwork.options import Options
from packwork.readers.json_text import check_size
from packwork.readers.reading import UnfitError, reading_file
from packwork.recipe.refusals import refusal
from packwork.scene.container import Container
from packwork.scene.item import Item

Entry: TypeAlias = tuple[str, Any]
"""``do`` a command; ``flow`` of a level, so many epochs; ``settle``, or one ``broken_off``;
``polish`` by trials; ``undo``; ``redo``; ``kept`` in a file; and before a command that needs it,
an ``item`` or a ``container`` of the library by its name."""

MOST_ENTRIES = 10_000_000
"""Lines of a log at most. Chosen."""

MOST_EPOCHS = 100_000
"""Epochs of one line at most: more than an hour of a drag. Chosen."""

MOST_TRIALS = 10_000
"""Trials of one line at most. Chosen."""

_Level: TypeAlias = Annotated[int, Field(strict=True, ge=COARSEST, le=FINEST)]
_Epochs: TypeAlias = Annotated[int, Field(strict=True, ge=0, le=MOST_EPOCHS)]
_Trials: TypeAlias = Annotated[int, Field(strict=True, ge=1, le=MOST_TRIALS)]

_VALUES: Mapping[str, TypeAdapter[Any]] = {
    "do": COMMANDS,
    "flow": TypeAdapter(tuple[_Level, _Epochs]),
    "polish": TypeAdapter(_Trials),
}


class Stream(Protocol):
    """Stream that lines are written to."""

    def write(self, text: str, /) -> object:
        """Write a line, or nothing of it: OSError then."""

    def flush(self) -> object:
        """Have all lines on their way to the disk."""


class Log:
    """Entries, and the stream that they are written to, if there is one.

    ``stream``: written at the end of each gesture. Without one nothing is kept.
    """

    def __init__(self, stream: Stream | None = None) -> None:
        self._stream = stream
        self._unwritten = deque[Entry]()
        self._brought: set[str] = set()
        self._shared: set[str] = set()

    def bring(self, names: Iterable[str], library: Library) -> None:
        """Add what the next command needs of a library, unless that was added before."""
        for name in names:
            if self._stream is not None and name not in self._brought:
                self._brought.add(name)
                kind = "item" if name in library.items else "container"
                found = getattr(library, f"{kind}s")[name]
                self.note(kind, (name, found))

    def note(self, kind: str, value: Any = None) -> None:
        """Add an entry; epochs that follow on epochs of the same level are added to them."""
        if self._stream is None:
            return
        last: str
        so_far: Any
        last, so_far = self._unwritten[-1] if self._unwritten else ("", None)
        if kind == last == "flow" and so_far[0] == value[0] and so_far[1] + value[1] <= MOST_EPOCHS:
            self._unwritten[-1] = ("flow", (value[0], so_far[1] + value[1]))
        else:
            self._unwritten.append((kind, value))

    def try_flush(self) -> None:
        """As :meth:`flush` after what nobody asked for; the next gesture tells what is wrong."""
        with contextlib.suppress(OSError):
            self.flush()

    def flush(self) -> None:
        """Have all that was noted written to the stream and on its way to the disk.

        What cannot be written stays noted, for the next time.

        Raises
        ------
        OSError
            If it cannot be written.
        """
        while self._stream is not None and self._unwritten:
            shared = set(self._shared)
            self._stream.write(line_of(self._unwritten[0], shared) + "\n")
            self._shared = shared
            self._unwritten.popleft()
        if self._stream is not None:
            self._stream.flush()


def line_of(entry: Entry, shared: set[str]) -> str:
    """One entry as a line of JSON.

    ``shared``: paths of fonts and maps that are in lines before, to which those of this are added.

    Examples
    --------
    >>> line_of(("flow", (200, 12)), set()), line_of(("undo", None), set())
    ('{"flow": [200, 12]}', '{"undo": null}')
    """
    kind, value = entry
    if kind == "do":
        value = value.model_dump(mode="json")
    elif kind in BROUGHT:
        value = brought_record(value[0], value[1], shared).model_dump(
            mode="json", exclude_none=True
        )
    return json.dumps({kind: value}, allow_nan=False)


def read_entries(lines: Iterator[str], name: str) -> Iterator[Entry]:
    """Entries of a log's lines; a last line that was cut off is left out.

    Examples
    --------
    >>> list(read_entries(iter(['{"flow": [200, 12]}', '{"do": {"kind": "dr']), "a log"))
    [('flow', (200, 12))]
    """
    kept: str | None = None
    shared = Before()
    for number, line in enumerate(lines, start=1):
        if number > MOST_ENTRIES:
            raise ReadError(name, f"has more than {MOST_ENTRIES} lines")
        if kept is not None:
            yield _entry(kept, number - 1, name, shared)
        kept = line if line.strip() else None
    if kept is not None and kept.rstrip().endswith("}"):
        yield _entry(kept, number, name, shared)


def _entry(line: str, number: int, name: str, shared: Before) -> Entry:
    with reading_file(f"{name}: line {number}"):
        check_size(line.encode("utf-8", "surrogatepass"))
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        found = None
    if isinstance(found, Mapping) and len(found) == 1:
        (kind, value), *_ = found.items()
        entry = _checked(str(kind), value, name, shared)
        if entry is not None:
            return entry
    raise ReadError(name, f"line {number} is no entry of a log: {line.strip()[:60]!r}")


def _checked(kind: str, value: Any, name: str, shared: Before) -> Entry | None:
    if kind in {"settle", "broken_off", "undo", "redo", "kept"}:
        return kind, None
    if kind in _VALUES:
        try:
            return kind, _VALUES[kind].validate_python(value)
        except ValidationError:
            return None
    if kind in BROUGHT:
        with reading_file(name):
            return kind, brought_of(value, kind, shared)
    return None


BROUGHT = ("item", "container")
"""Kinds of lines."""


class Brought(Options):
    """An item or a container of the library."""

    name: Annotated[str, Field(max_length=200)]
    """By which commands call it."""
    item: ItemRecord | None = None
    container: ContainerRecord | None = None
    fonts: dict[Key, str] = Field(default_factory=dict)
    """Font files as base64, by the hash of their content, unless a line before has them."""
    maps: dict[Key, str] = Field(default_factory=dict)
    """The same of the file of a container."""


def brought_record(name: str, thing: Item | Container, shared: set[str]) -> Brought:
    """An item or a container as plain values; ``shared`` as of :func:`line_of`."""
    things = Things()
    if isinstance(thing, Container):
        made = Brought(name=name, container=container_record(thing, things))
    else:
        made = Brought(name=name, item=item_record(thing, things))
    for path in [path for path in things.encoded if path not in shared]:
        kind, _, key = path.partition("/")
        getattr(made, kind)[key] = base64.b64encode(things.encoded[path]).decode("ascii")
    shared.update(things.encoded)
    return made


class Before(Shared):
    """Fonts, maps and outlines of the lines so far."""

    def __init__(self) -> None:
        super().__init__(self._file)
        self._files: dict[str, bytes] = {}

    def add(self, kind: str, files: Mapping[str, str]) -> None:
        """Keep files as base64 by their hashes, unless a line before has them."""
        for key, text in files.items():
            if f"{kind}/{key}" not in self._files:
                self._files[f"{kind}/{key}"] = bytes_of(text)

    def _file(self, path: str) -> bytes:
        if path not in self._files:
            raise UnfitError(f"lacks {path}")
        return self._files[path]


def brought_of(value: Any, kind: str, shared: Before) -> tuple[str, Item | Container]:
    """The item or container of a line's value, and its name; its files are added to ``shared``."""
    try:
        found = Brought.model_validate(value, strict=False)
    except ValidationError as error:
        raise UnfitError(f"holds what cannot be read: {refusal(error, Brought)}") from None
    shared.add("fonts", found.fonts)
    shared.add("maps", found.maps)
    if kind == "container" and found.container is not None:
        return found.name, container_of(found.container, shared)
    if kind == "item" and found.item is not None:
        return found.name, item_of(found.item, shared)
    raise UnfitError(f"holds a line of kind {kind} without one")

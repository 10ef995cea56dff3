"""Documents between memory and files: the first in full, each later one by what differs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal, TypeAlias, get_args

import numpy as np
from pydantic import Field

from packwork.arrays import FloatArray
from packwork.live.commands.command import FARTHEST, sized
from packwork.live.document import PROPERTIES, Document
from packwork.live.file.records import Text, kept_text
from packwork.live.file.values import colour_of, matrix_of, matrix_record
from packwork.live.ground import Mosaic
from packwork.live.kinds import LiveOptions
from packwork.live.notes import Attached
from packwork.options import Options
from packwork.readers.layouts.geojson import LARGEST_SCALE, SMALLEST_SCALE, WIDEST_STRETCH
from packwork.readers.reading import UnfitError
from packwork.recipe.rules import MAX_COUNT
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.layout import Note
from packwork.scene.pose import Poses

PATH = r"^[MmZzLlHhVvCcSsQqTtAaeE\d\s+.,-]*$"
"""Path data of a note, which is written as it is: nothing else may stand in it."""

MOST_ID = 2**53
"""Numbers of items at most: larger ones are no whole numbers in JSON. Derived."""

MOST_ROWS = 4_000_000
"""Items of all documents of a file together: of each some hundred bytes are held. Larger lets a
small file fill the memory. Chosen: all that can be undone with four thousand items."""

_HELD = 2 ** np.arange(len(PROPERTIES))

_PLAIN = ("next_id", "options", "manifest", "put")

Column: TypeAlias = Literal[
    "x", "y", "angle", "scale", "stretch", "weights", "smallest", "largest", "items", "held"
]
COLUMNS: tuple[Column, ...] = get_args(Column)
_POSE, _SIZE = COLUMNS[:5], COLUMNS[5:8]

Number: TypeAlias = Annotated[float, Field(allow_inf_nan=False)]
Id: TypeAlias = Annotated[int, Field(ge=0, le=MOST_ID)]


class Changed(Options):
    """Some rows of a column."""

    rows: tuple[Annotated[int, Field(ge=0, lt=MAX_COUNT)], ...]
    values: tuple[Number, ...]


class NoteRecord(Options):
    """A label or a letter beside the items."""

    path: Annotated[str, Field(pattern=PATH)]
    matrix: tuple[Number, Number, Number, Number, Number, Number]
    fill: str
    says: Text = ""
    is_on_item: bool = False
    item: Id | None = None
    pose: tuple[Number, Number, Number, Annotated[Number, Field(gt=0)]] = (0.0, 0.0, 0.0, 1.0)


class BehindRecord(Options):
    """Pictures of a document, which stand among the items."""

    picture: Annotated[int, Field(ge=0)] | None = None
    """Of a mosaic."""
    tint: Annotated[Number, Field(ge=0, le=1)] | None = None
    behind: Annotated[int, Field(ge=0)] | None = None


class DocumentRecord(Options):
    """A document, or what differs from the one before: what is not there is as it was.

    Items and containers are called by where they stand in the file's lists.
    """

    ids: tuple[Id, ...] | None = None
    """With these everything is there in full."""
    container: Annotated[int, Field(ge=0)] | None = None
    columns: dict[Column, tuple[Number, ...] | Changed] = Field(default_factory=dict)
    """What is held as a sum: 1 for the place, 2 for the angle, 4 for the size."""
    options: LiveOptions | None = None
    next_id: Id | None = None
    manifest: dict[Text, Any] | None = None
    pictures: BehindRecord | None = None
    put: tuple[Id, ...] | None = None
    """Numbers of what a hand has put somewhere."""
    notes: tuple[NoteRecord, ...] | None = None
    """Of the first document: all others have them too."""


def records_of(
    documents: Iterable[Document], place: Callable[[object], int]
) -> Iterator[DocumentRecord]:
    """Records of documents, each but the first by what differs from the one before."""
    before: Document | None = None
    then: dict[Column, FloatArray] = {}
    was: dict[str, Any] = {}
    for document in documents:
        now, said = _columns(document, place), _said(document, place)
        if before is None or not np.array_equal(before.ids, document.ids):
            notes = tuple(map(_note_record, document.notes)) if before is None else None
            columns: dict[Column, Any] = {name: tuple(now[name].tolist()) for name in COLUMNS}
            ids = tuple(document.ids.tolist())
            yield DocumentRecord(ids=ids, columns=columns, notes=notes, **said)
        else:
            new = {name: value for name, value in said.items() if value != was[name]}
            yield DocumentRecord(columns=_changed(then, now), **new)
        before, then, was = document, now, said


def _said(document: Document, place: Callable[[object], int]) -> dict[str, Any]:
    """All of a document beside its items' columns and notes, by the names of the record."""
    mosaic, behind = document.mosaic, document.behind
    return {
        "container": place(document.container),
        "options": document.options,
        "next_id": document.next_id,
        "manifest": dict(document.manifest),
        "pictures": BehindRecord(
            picture=None if mosaic is None else place(mosaic.picture),
            tint=None if mosaic is None else mosaic.tint,
            behind=None if behind is None else place(behind),
        ),
        "put": tuple(sorted(document.put)),
    }


def rows_of(records: Iterable[DocumentRecord]) -> int:
    """Items of all documents together.

    Examples
    --------
    >>> rows_of([DocumentRecord(ids=(0, 1, 2)), DocumentRecord()])
    6
    """
    count = rows = 0
    for record in records:
        count = count if record.ids is None else len(record.ids)
        rows += count
    return rows


def documents_of(
    records: Sequence[DocumentRecord], items: Sequence[Item], containers: Sequence[Container]
) -> Iterator[Document]:
    """Documents of records."""
    if rows_of(records) > MOST_ROWS:
        raise UnfitError(f"holds documents of more than {MOST_ROWS:,} items together")
    before: Document | None = None
    then: dict[Column, FloatArray] = {}
    for record in records:
        before, then = _document(record, before, then, items, containers)
        yield before


def _columns(document: Document, place: Callable[[object], int]) -> dict[Column, FloatArray]:
    found: dict[Column, FloatArray] = {name: getattr(document.poses, name) for name in _POSE}
    found |= {name: getattr(document, name) for name in _SIZE}
    found["items"] = np.array([place(item) for item in document.items], dtype=np.float64)
    found["held"] = (document.held @ _HELD).astype(np.float64)
    return found


def _changed(
    then: Mapping[Column, FloatArray], now: Mapping[Column, FloatArray]
) -> dict[Column, tuple[Number, ...] | Changed]:
    found: dict[Column, tuple[Number, ...] | Changed] = {}
    for name in COLUMNS:
        rows = np.flatnonzero(then[name] != now[name])
        if len(rows):
            values = tuple(now[name][rows].tolist())
            found[name] = Changed(rows=tuple(rows.tolist()), values=values)
    return found


def _document(
    record: DocumentRecord,
    before: Document | None,
    then: Mapping[Column, FloatArray],
    items: Sequence[Item],
    containers: Sequence[Container],
) -> tuple[Document, dict[Column, FloatArray]]:
    was = None if record.ids is not None else before
    if record.ids is not None:
        ids, then = np.array(record.ids, dtype=np.int64), {}
    elif before is not None:
        ids = before.ids
    else:
        raise UnfitError("holds no document to begin with")
    columns = {name: _column(record, name, then, len(ids)) for name in COLUMNS}
    chosen = _indices(columns["items"], len(items), "items")
    held = _indices(columns["held"], 2 ** len(PROPERTIES), "held")
    said: dict[str, Any] = {name: getattr(record, name) for name in _PLAIN}
    if was is not None:
        said = {name: getattr(was, name) if v is None else v for name, v in said.items()}
    mosaic, behind = (None, None) if was is None else (was.mosaic, was.behind)
    if record.pictures is not None:
        mosaic, behind = _pictures_of(record.pictures, items)
    said["put"] = frozenset(said["put"] or ())
    if None in said.values():
        raise UnfitError("holds a document with something left out")
    _check_ids(ids, said["next_id"])
    document = Document(
        container=_container(record, was, containers),
        items=tuple(items[k] for k in chosen),
        ids=ids,
        poses=Poses(*(columns[name] for name in _POSE)),
        weights=columns["weights"],
        smallest=columns["smallest"],
        largest=columns["largest"],
        held=(held[:, None] & _HELD) > 0,
        notes=tuple(map(_note_of, record.notes or ())) if before is None else before.notes,
        mosaic=mosaic,
        behind=behind,
        **said,
    )
    _check_numbers(document)
    return sized(document, "item"), columns


def _pictures_of(record: BehindRecord, items: Sequence[Item]) -> tuple[Mosaic | None, Item | None]:
    picture, behind = (
        None if k is None else _picture(k, items) for k in (record.picture, record.behind)
    )
    return None if picture is None else Mosaic(picture, record.tint), behind


def _picture(k: int, items: Sequence[Item]) -> Item:
    if k >= len(items) or not isinstance(items[k].art, PhotoArt | VectorArt):
        raise UnfitError(f"holds no picture of number {k}")
    return items[k]


def _note_record(one: Attached) -> NoteRecord:
    note = one.note
    return NoteRecord(
        path=note.path, matrix=matrix_record(note.matrix), fill=note.fill,
        says=kept_text(note.says), is_on_item=note.is_on_item, item=one.item, pose=one.pose,
    )  # fmt: skip


def _note_of(record: NoteRecord) -> Attached:
    matrix, fill = matrix_of(record.matrix), colour_of(record.fill)
    note = Note(record.path, matrix, fill, record.says, record.is_on_item)
    return Attached(note, record.item, record.pose)


def _container(
    record: DocumentRecord, was: Document | None, containers: Sequence[Container]
) -> Container:
    if record.container is None:
        if was is None:
            raise UnfitError("holds a document without a container")
        return was.container
    if record.container >= len(containers):
        raise UnfitError(f"holds no container of number {record.container}")
    return containers[record.container]


def _column(
    record: DocumentRecord, name: Column, then: Mapping[Column, FloatArray], count: int
) -> FloatArray:
    given = record.columns.get(name)
    if isinstance(given, tuple):
        if len(given) != count:
            raise UnfitError(f"holds {len(given)} numbers of {name} for {count} items")
        return np.array(given, dtype=np.float64)
    if name not in then:
        raise UnfitError(f"holds a document without its {name}")
    if given is None:
        return then[name]
    column = then[name].copy()
    rows = _indices(np.array(given.rows, dtype=np.float64), count, name)
    if len(rows) != len(given.values):
        raise UnfitError(f"holds {len(given.values)} numbers of {name} for {len(rows)} rows")
    column[rows] = given.values
    return column


def _indices(values: FloatArray, most: int, name: str) -> Any:
    if not ((values >= 0) & (values < most) & (values == np.floor(values))).all():
        raise UnfitError(f"holds {name} that are none of {most}")
    return values.astype(np.int64)


def _check_ids(ids: Any, next_id: int) -> None:
    if not 0 < len(ids) <= MAX_COUNT:
        raise UnfitError(f"holds {len(ids)} items; 1 to {MAX_COUNT} go")
    if len(np.unique(ids)) < len(ids) or ids.max() >= next_id:
        raise UnfitError("holds two items of one number, or a number that is not given yet")


def _check_numbers(document: Document) -> None:
    poses, side = document.poses, document.container.side
    sizes = np.concatenate([poses.scale, document.smallest, document.largest])
    is_sound = (
        (np.abs(np.concatenate([poses.x, poses.y])) <= FARTHEST * side).all()
        and ((sizes >= SMALLEST_SCALE) & (sizes <= LARGEST_SCALE)).all()
        and (document.smallest <= document.largest).all()
        and ((poses.stretch >= 1 / WIDEST_STRETCH) & (poses.stretch <= WIDEST_STRETCH)).all()
        and (np.abs(poses.angle) <= FARTHEST).all()
        and ((document.weights >= 0) & (document.weights <= 1 / SMALLEST_SCALE)).all()
    )
    if not is_sound:
        raise UnfitError("holds items that are nowhere near the canvas, or of no size")

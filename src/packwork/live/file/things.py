"""Items and containers between memory and files, and the fonts and maps that they share."""

from __future__ import annotations

import hashlib
import logging
import zlib
from collections.abc import Callable
from dataclasses import fields, replace
from typing import Literal, TypeVar

import numpy as np
from pydantic import BaseModel, ValidationError

from packwork.geometry.outline import Outline
from packwork.live.file.parts import PackedPart, part_of
from packwork.live.file.records import (
    BackdropRecord,
    ContainerRecord,
    DatumRecord,
    ItemRecord,
    LabelRecord,
    OutlineRecord,
    PartRecord,
    RunRecord,
    WordRecord,
    kept_text,
    plain_fields,
)
from packwork.live.file.values import (
    art_of,
    art_record,
    colour_of,
    matrix_of,
    matrix_record,
    outline_of,
    outline_record,
    photo_of,
    photo_record,
    points_of,
    text_of,
)
from packwork.readers.budget.crossings import MAX_CROSSINGS, Allowance
from packwork.readers.fonts.face import checked_face
from packwork.readers.json_text import check_size
from packwork.readers.maps import MAX_MAP_BYTES
from packwork.readers.reading import UnfitError
from packwork.recipe.refusals import refusal
from packwork.scene.container import Backdrop, Container, repeating
from packwork.scene.item import Datum, FontFile, Item, Label, LiveText, Parts, TextRun
from packwork.scene.pose import Poses
from packwork.uses.tilings import is_straight

_LOG = logging.getLogger("packwork")

_Model = TypeVar("_Model", bound=BaseModel)

_OF_RUNS = ("text", "x", "y", "size", "steps", "advance", "is_leftward", "angle")


class Shared:
    """Fonts, maps and outlines of a file, each made once, so that items and containers share them.

    ``read``: bytes by their path in a file, such as ``fonts/<hash>``.
    """

    def __init__(self, read: Callable[[str], bytes]) -> None:
        self._read = read
        self._fonts: dict[tuple[str, str, int, float | None], FontFile] = {}
        self._maps: dict[str, bytes] = {}
        self._outlines: dict[OutlineRecord, Outline] = {}
        self._allowance = Allowance(MAX_CROSSINGS)

    def outline(self, record: OutlineRecord) -> Outline:
        """The outline of a record."""
        if record not in self._outlines:
            self._outlines[record] = outline_of(record, self._allowance)
        return self._outlines[record]

    def map(self, key: str) -> bytes:
        """The map of a hash, which is checked where its parts are looked up."""
        if key not in self._maps:
            data = self._read(f"maps/{key}")
            if len(data) > MAX_MAP_BYTES:
                raise UnfitError(f"holds a map of more than {MAX_MAP_BYTES // 1_000_000} MB")
            self._maps[key] = data
        return self._maps[key]

    def font(self, run: RunRecord) -> FontFile:
        """The font of a run."""
        key = (run.font, run.font_name, run.index, run.weight)
        if key not in self._fonts:
            data = self._read(f"fonts/{run.font}")
            checked_face(data, run.index)
            self._fonts[key] = FontFile(data, run.font_name, run.index, run.weight)
        return self._fonts[key]


class Things:
    """Encoded items, containers, fonts and maps by the hash of their content, each made once.

    Items are known by being the same object, so they are kept for as long as this is.
    """

    def __init__(self) -> None:
        self.encoded: dict[str, bytes] = {}
        """By their path in a file, such as ``items/<hash>.json``, until they are packed."""
        self.needs: dict[str, frozenset[str]] = {}
        """Paths of fonts and maps by that of the item or container that has them."""
        self._needed: set[str] = set()
        self._keys: dict[object, str] = {}
        self._parts: dict[str, PackedPart] = {}

    def item(self, item: Item) -> str:
        """Path of an item, which is encoded unless it has been."""
        return self._put("items", item, lambda: item_record(item, self))

    def container(self, container: Container) -> str:
        """Path of a container."""
        return self._put("containers", container, lambda: container_record(container, self))

    def shared(self, kind: Literal["fonts", "maps"], data: bytes) -> str:
        """Hash of the content of a font or a map, which is kept once."""
        key = hashlib.sha256(data).hexdigest()
        self._keep(f"{kind}/{key}", data)
        self._needed.add(f"{kind}/{key}")
        return key

    def part(self, path: str) -> PackedPart:
        """Part at a path, packed."""
        if path not in self._parts:
            # Numbers of maps are packed as well, six times as fast.
            level = 1 if path.startswith("maps/") else zlib.Z_DEFAULT_COMPRESSION
            self._parts[path] = part_of(self.encoded.pop(path), level)
        return self._parts[path]

    def _keep(self, path: str, data: bytes) -> None:
        if path not in self._parts:
            self.encoded.setdefault(path, data)

    def _put(self, kind: str, thing: object, record: Callable[[], BaseModel]) -> str:
        path = self._keys.get(thing)
        if path is None:
            self._needed.clear()
            data = record().model_dump_json(exclude_none=True).encode()
            path = f"{kind}/{hashlib.sha256(data).hexdigest()}.json"
            self._keep(path, data)
            self.needs[path] = frozenset(self._needed)
            self._keys[thing] = path
        return path


def item_record(item: Item, things: Things) -> ItemRecord:
    """An item as plain values; its fonts go to ``things``."""
    datum, own = item.datum, item.own_art
    outline, ink = outline_record(item.outline), outline_record(item.ink)
    return ItemRecord(
        **plain_fields(item, "name", "source", "halo", "weight", "coarseness"),
        outline=outline,
        ink=None if ink == outline else ink,
        art=art_record(item.art, item.outline, item.name),
        label=LabelRecord(**plain_fields(item.label)),
        text=None if item.text is None else _word_record(item.text, things),
        datum=None if datum is None else _datum_record(datum),
        own_art=None if own is None else art_record(own, item.outline, item.name),
        parts=() if item.parts is None else _part_records(item.parts, things),
    )


def item_of(record: ItemRecord, shared: Shared) -> Item:
    """The item of a record; rows of data frames are not in files."""
    outline = shared.outline(record.outline)
    label, datum, text = record.label, record.datum, record.text
    made = Item(
        record.name,
        record.source,
        outline,
        outline if record.ink is None else shared.outline(record.ink),
        art_of(record.art, outline),
        Label(label.name, label.link, label.title),
        None if text is None else _text_of(text, shared),
        colour_of(record.halo) if record.halo else "",
        None if datum is None else Datum(datum.row, datum.value, datum.category, datum.group),
        record.weight,
        own_art=None if record.own_art is None else art_of(record.own_art, outline),
        parts=_parts_of(record.parts, shared) if record.parts else None,
        coarseness=record.coarseness,
    )
    # A file's claim that an item may touch others is checked.
    is_claimed = record.coarseness == 0.0
    return made if not is_claimed or is_straight(made) else replace(made, coarseness=1.0)


def _part_records(parts: Parts, things: Things) -> tuple[PartRecord, ...]:
    columns = (getattr(parts.poses, column.name).tolist() for column in fields(Poses))
    rows = zip(parts.items, zip(*columns, strict=True), parts.weights.tolist(), strict=True)
    return tuple(
        PartRecord(item=item_record(item, things), pose=pose, weight=weight)
        for item, pose, weight in rows
    )


def _parts_of(records: tuple[PartRecord, ...], shared: Shared) -> Parts:
    if any(one.item.parts for one in records):
        raise UnfitError("has a group within a group")
    poses = Poses(*np.array([one.pose for one in records]).T)
    items = tuple(item_of(one.item, shared) for one in records)
    return Parts(items, poses, np.array([one.weight for one in records]))


def container_record(container: Container, things: Things) -> ContainerRecord:
    """A container as plain values; its map or drawing goes to ``things``."""
    behind, walls, file = container.backdrop, container.walls, container.file or b""
    if len(file) > MAX_MAP_BYTES:
        most = MAX_MAP_BYTES // 1_000_000
        _LOG.warning("the map of %s is not kept: it has more than %d MB", container.name, most)
        file = b""
    backdrop = None
    if behind is not None:
        across = float(np.hypot(*behind.matrix[:, 0]))
        art = photo_record(behind.art, container.side / across)
        backdrop = BackdropRecord(art=art, matrix=matrix_record(behind.matrix))
    return ContainerRecord(
        **plain_fields(container, "name", "source", "width", "height", "unit", "pen"),
        outline=outline_record(container.outline),
        backdrop=backdrop,
        walls=None if walls is None else tuple(text_of(wall) for wall in walls),
        repeats=None if container.lattice is None else container.lattice.kind,
        file=things.shared("maps", file) if file else None,
    )


def container_of(record: ContainerRecord, shared: Shared) -> Container:
    """The container of a record."""
    behind, walls = record.backdrop, record.walls
    made = Container(
        record.name,
        record.source,
        shared.outline(record.outline),
        record.width,
        record.height,
        record.unit,
        None if behind is None else Backdrop(photo_of(behind.art), matrix_of(behind.matrix)),
        None if walls is None else tuple(points_of(wall) for wall in walls),
        file=None if record.file is None else shared.map(record.file),
        pen=record.pen,
    )
    return made if record.repeats is None else repeating(made, record.repeats)


def decoded(model: type[_Model], data: bytes) -> _Model:
    """A record of JSON."""
    check_size(data)
    try:
        return model.model_validate_json(data)
    except ValidationError as error:
        raise UnfitError(f"holds what cannot be read: {str(refusal(error, model))[:300]}") from None


def _word_record(text: LiveText, things: Things) -> WordRecord:
    runs = [
        RunRecord(
            **plain_fields(run, *_OF_RUNS),
            **plain_fields(run.font, "index", "weight"),
            font=things.shared("fonts", run.font.data),
            font_name=run.font.name,
        )
        for run in text.runs
    ]
    return WordRecord(runs=tuple(runs), path=text.path, language=text.language)


def _text_of(record: WordRecord, shared: Shared) -> LiveText:
    runs = (TextRun(font=shared.font(run), **plain_fields(run, *_OF_RUNS)) for run in record.runs)
    return LiveText(tuple(runs), record.path, record.language)


def _datum_record(datum: Datum) -> DatumRecord:
    row = {kept_text(str(name)): _cell(value) for name, value in datum.row.items()}
    category, group = kept_text(datum.category), kept_text(datum.group)
    return DatumRecord(row=row, value=datum.value, category=category, group=group)


def _cell(value: object) -> object:
    if isinstance(value, str):
        return kept_text(value)
    is_plain = value is None or isinstance(value, bool | int)
    is_number = isinstance(value, float) and value == value and abs(value) != float("inf")
    return value if is_plain or is_number else str(value)

"""Names that stand in a recipe for values and vectors that users give."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TypeAlias

import numpy as np
from PIL import Image

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.readers.memory.items import coverage_of_array, picture_of_array, png_of_picture
from packwork.readers.memory.shapes import Columns, is_geometry, points_up, shapes_of
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.reading import UnfitError, reading_file
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.sources import MEMORY, MemoryStore


@dataclass(frozen=True, eq=False)
class GivenVectors:
    """Rows of numbers ``(n, d)`` from memory.

    Names of rows and columns, and the group of each row, stand where they are said.
    """

    names: tuple[str, ...] | None
    rows: FloatArray
    columns: tuple[str, ...] = ()
    groups: tuple[str, ...] | None = None


def vectors_of(value: Any) -> GivenVectors:
    """Vectors of an array, a row an item; or by name, of a dict or a data frame's index.

    Where a data frame's index only counts, a first column of texts, none twice, has the names, as
    in a file. Another column of texts says of what group each is.

    >>> vectors_of({"bear": [1, 0], "fox": [0, 1]}).names
    ('bear', 'fox')
    >>> vectors_of(np.eye(3)).rows.shape
    (3, 3)
    """
    names: tuple[str, ...] | None = None
    columns: tuple[str, ...] = ()
    groups: tuple[str, ...] | None = None
    if isinstance(value, Mapping):
        names, value = tuple(map(str, value)), list(value.values())
    elif hasattr(value, "columns") and hasattr(value, "index"):
        # An index of numbers only counts the rows.
        has_numbers = getattr(getattr(value.index, "dtype", None), "kind", "O") in "iuf"
        names = None if has_numbers else tuple(map(str, value.index))
        first = value.columns[0] if len(value.columns) else None
        if has_numbers and first is not None and _is_text(value[first]):
            cells = tuple(map(str, value[first]))
            if len(set(cells)) == len(cells):
                names, value = cells, value[list(value.columns[1:])]
        texts = [k for k in value.columns if _is_text(value[k])]
        if len(texts) == 1:
            groups = tuple("" if cell is None else str(cell) for cell in value[texts[0]])
            value = value[[k for k in value.columns if k not in texts]]
        columns = tuple(map(str, value.columns))
        value = value.to_numpy()
    try:
        rows = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise UnfitError(
            "is no array of numbers; give a row of as many numbers for each item"
        ) from None
    if rows.ndim != 2 or min(rows.shape) < 1:
        raise UnfitError(f"has the shape {rows.shape}; give one row of numbers an item")
    return GivenVectors(names, rows, columns, groups)


def _is_text(column: Any) -> bool:
    """Whether a column of a data frame holds texts, and none that is a number."""
    cells = [cell for cell in column if cell is not None and cell == cell]
    return bool(cells) and all(
        isinstance(cell, str) and any(map(str.isalpha, cell)) for cell in cells
    )


class Readable(Protocol):
    """An open file."""

    def read(self, size: int = ..., /) -> str | bytes:
        """Content, no more than ``size`` of it."""


class ArrayLike(Protocol):
    """An array of NumPy, PyTorch, xarray and others."""

    def __array__(self, *args: Any, **kwargs: Any) -> Any: ...


class GeoLike(Protocol):
    """A geometry or a frame of them."""

    @property
    def __geo_interface__(self) -> Any: ...


Value: TypeAlias = (
    str
    | os.PathLike[str]
    | bytes
    | bytearray
    | memoryview
    | Mapping[str, Any]
    | Readable
    | ArrayLike
    | GeoLike
    | Image.Image
    | Item
    | Container
    | Outline
)
"""What is taken wherever a path is."""

_FORMS = (
    "a path, a built-in name, an array, a picture, bytes or a file of them, a Shapely geometry, "
    "GeoJSON or a frame of geometries"
)
_PICTURES = "a path, an array, a picture of Pillow, or bytes of a picture's file"
_MARKUP = ("<svg", "<?xml", "<!--", "<!doctype")
_MOST_BLANKS = 1_000


@dataclass
class Handed:
    """Names under which values given in Python are put into memory.

    ``y_up``: whether the y of geometries points up; None: where they say their reference system.
    """

    memory: MemoryStore
    y_up: bool | None = None
    columns: Columns | None = None
    texts: set[str] = field(default_factory=set)

    def name_of(self, value: Any, key: str, name: str | None = None) -> str:
        """Name of one value: itself, if it is one; ``name`` is what people call it.

        >>> handed = Handed(MemoryStore())
        >>> handed.name_of("star", "items"), handed.name_of(np.eye(9) > 0, "items")
        ('star', 'memory:array')
        """
        if isinstance(value, str) and not _is_markup(value):
            return value
        if isinstance(value, os.PathLike):
            return str(os.fspath(value))
        if isinstance(value, Item | Container):
            return self._put_made(value)
        if isinstance(value, Image.Image):
            return self._put_picture(value, name)
        if isinstance(value, str | bytes | bytearray | memoryview) or hasattr(value, "read"):
            return self._put_file(value, name)
        if isinstance(value, Outline) or is_geometry(value):
            return self._put_geometry(value, name or "shape")
        if not hasattr(value, "__array__") or hasattr(value, "columns"):
            raise _refused(value, key)
        return self._put_array(np.asarray(value), name)

    def names_of(self, values: Any, key: str) -> list[str]:
        """Names of one value or of several, or of values by what people call them.

        >>> Handed(MemoryStore()).names_of({"dot": b"<svg/>", "old": "star"}, "items")
        ['memory:dot.svg', 'star']
        """
        if isinstance(values, Mapping) and not is_geometry(values):
            return [self.name_of(one, key, str(name)) for name, one in values.items()]
        if _is_one(values):
            return [self.name_of(values, key)]
        if not isinstance(values, Iterable):
            raise _refused(values, key)
        given = list(values)
        # An item that was read is called as its file is, unless that file is named too.
        self.texts.update(one for one in given if isinstance(one, str))
        return [self.name_of(one, key) for one in given]

    def picture_name_of(self, value: Any, key: str) -> str:
        """Name of a picture, whose arrays are light or colours, not shares of a shape.

        >>> Handed(MemoryStore()).picture_name_of(np.zeros((9, 9, 3)), "picture")
        'memory:picture.png'
        """
        if hasattr(value, "__array__") and not isinstance(value, Image.Image):
            with reading_file(f"{MEMORY}{key}"):
                value = picture_of_array(np.asarray(value))
        if isinstance(value, Item | Container | Outline) or is_geometry(value):
            raise RecipeError(key, f"is {type(value).__name__}, not a picture; give {_PICTURES}")
        return self.name_of(value, key, None if isinstance(value, str) else key)

    def vectors_name_of(self, value: Any, key: str) -> str:
        """Name of vectors: a file's, or that of an array, a dict by name or a data frame.

        >>> Handed(MemoryStore()).vectors_name_of(np.eye(3), "embeddings")
        'memory:embeddings'
        """
        if isinstance(value, str | os.PathLike):
            return os.fspath(value)
        with reading_file(f"{MEMORY}{key}"):
            return self.memory.put(vectors_of(value), key)

    def _put_made(self, value: Item | Container) -> str:
        known = self.memory.values.get(value.source)
        is_free = known is None and value.source not in self.texts
        if value.source.strip() and (is_free or known is value):
            self.memory.values[value.source] = value
            return value.source
        return self.memory.put(value, value.name)

    def _put_picture(self, picture: Image.Image, name: str | None) -> str:
        called = name or _stem(getattr(picture, "filename", "")) or "picture"
        with reading_file(f"{MEMORY}{called}"):
            return self.memory.put(png_of_picture(picture), called, ".png")

    def _put_file(self, value: Any, name: str | None) -> str:
        data = _content(value)
        called = name or _stem(getattr(value, "name", "")) or "drawing"
        is_drawing = data.startswith(b"\x1f\x8b") or data.lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"<"
        ending = ".svg" if is_drawing else ".jpg" if data.startswith(b"\xff\xd8") else ".png"
        return self.memory.put(data, called, ending)

    def _put_geometry(self, value: Any, name: str) -> str:
        y_up = points_up(value) if self.y_up is None else self.y_up
        plain = value.region if isinstance(value, Outline) else value
        with reading_file(f"{MEMORY}{name}"):
            return self.memory.put(shapes_of(plain, name, y_up=y_up, columns=self.columns), name)

    def _put_array(self, array: np.ndarray[Any, Any], name: str | None) -> str:
        called = name or "array"
        with reading_file(f"{MEMORY}{called}"):
            if array.ndim == 2 and array.shape[1] == 2 and array.dtype.kind in "iuf":
                return self._put_geometry(Outline.of(array), name or "shape")
            made = coverage_of_array(array, called)
        return self.memory.put(made, called, ".png" if isinstance(made, bytes) else "")


def _is_one(value: Any) -> bool:
    """Whether a value is one by itself, whatever it may be iterated over for."""
    if is_geometry(value) or isinstance(value, str | bytes | bytearray | memoryview):
        return True
    if getattr(value, "ndim", None) == 1:
        return False
    ways = ("read", "__fspath__", "__array__")
    return isinstance(value, Image.Image | Item | Container | Outline) or any(
        hasattr(value, way) for way in ways
    )


def _is_markup(text: str) -> bool:
    return text[:_MOST_BLANKS].lstrip("\ufeff \t\r\n").lower().startswith(_MARKUP)


def _content(value: Any) -> bytes:
    """Bytes of a text, of bytes or of an open file, one more than is read at most."""
    data = value.read(MAX_PICTURE_BYTES + 1) if hasattr(value, "read") else value
    return data.strip().encode() if isinstance(data, str) else bytes(data)


def _stem(name: object) -> str:
    return Path(name).stem if isinstance(name, str | os.PathLike) and str(name) else ""


def _refused(value: object, key: str) -> RecipeError:
    return RecipeError(key, f"is {type(value).__name__}, which cannot be read; give {_FORMS}")

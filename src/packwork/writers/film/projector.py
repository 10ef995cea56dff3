"""Frames of a film as pictures: each drawing rendered once, then laid down frame by frame."""

from __future__ import annotations

import io
from collections.abc import Hashable, Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from PIL import Image

from packwork.arrays import BoolArray, FloatArray
from packwork.errors import PackworkError, WriteError
from packwork.geometry import affine
from packwork.raster.drawing import drawn_png
from packwork.raster.overlay import FINENESS, Picture, Texture, premultiplied, straight, texture_of
from packwork.scene.item import Item
from packwork.scene.layout import without_items
from packwork.scene.track import poses_of
from packwork.writers.film.film import Film, Tell, tell_nobody
from packwork.writers.frame import PictureFrame, picture_frame
from packwork.writers.pictures import as_picture
from packwork.writers.svg import sheet_of, svg_document
from packwork.writers.svg_symbols import paint, shape_key

Frame: TypeAlias = npt.NDArray[np.uint8]
"""``(rows, columns)`` or ``(rows, columns, channels)``."""

_SMALLEST_PX = 1.0
"""Longer side of a drawing that is shown smaller than that, when it is rendered."""


class Projector:
    """Draws the frames of a film, each drawing rendered once.

    ``is_even`` lets both sides have an even number of pixels, as video needs: a row or a column of
    background may come in at the far end.
    """

    def __init__(self, film: Film, is_even: bool = False) -> None:
        self._film = film
        self.frame = _frame(film, is_even)
        self._keys = [_key(item) for item in film.items]
        try:
            self._sheet = _sheet(film, self.frame)
            self._textures = self._rendered()
        except PackworkError:
            raise
        except ValueError as error:
            raise WriteError("film", f"an item's drawing cannot be rendered ({error})") from error

    def pictures(self, tell: Tell = tell_nobody) -> Iterator[Picture]:
        """All frames one after another, ``(rows, columns, 4)``, alpha not premultiplied."""
        numbers = self._film.frames
        for k, now in enumerate(numbers):
            yield self.picture(now)
            tell((k + 1) / len(numbers))

    def picture(self, numbers: FloatArray) -> Picture:
        """One frame, of the ``(n, 5)`` numbers of all that are shown."""
        image, poses = self._sheet.copy(), poses_of(numbers)
        to_px = affine.similarity(0.0, 0.0, 0.0, self.frame.px_per_cu)
        for k, key in enumerate(self._keys):
            if poses.scale[k] > 0:
                self._textures[key].lay(image, affine.compose(to_px, poses.matrix(k)))
        return image if self._film.is_opaque else straight(image)

    def _rendered(self) -> dict[tuple[Hashable, str], Texture]:
        """Each drawing as fine as it is ever shown."""
        largest: dict[tuple[Hashable, str], float] = {}
        drawings: dict[tuple[Hashable, str], Item] = {}
        for key, item, scale in zip(self._keys, self._film.items, self._scales(), strict=True):
            drawings.setdefault(key, item)
            largest[key] = max(largest.get(key, 0.0), scale)
        return {key: _texture(item, largest[key]) for key, item in drawings.items()}

    def _scales(self) -> list[float]:
        """Largest scale at which each item is ever shown, pixels per unit of its own."""
        numbers = self._film.frames
        flat = poses_of(numbers.reshape(-1, numbers.shape[-1]))
        scales = flat.axis_scales.max(axis=1).reshape(numbers.shape[:2]).max(axis=0)
        return [float(scale) * self.frame.px_per_cu for scale in scales]


def _key(item: Item) -> tuple[Hashable, str]:
    """Same for items that look the same."""
    return shape_key(item), " ".join(paint(item).values())


def _texture(item: Item, px_per_unit: float) -> Texture:
    left, top, right, bottom = item.ink.bounds
    least = _SMALLEST_PX / max(right - left, bottom - top)
    art = as_picture(item, FINENESS * max(px_per_unit, least))
    return texture_of(_pixels(art.png), affine.inverse(art.matrix))


def _frame(film: Film, is_even: bool) -> PictureFrame:
    frame = picture_frame(film.layout.container, film.options.film_pixels)
    if not is_even:
        return frame
    return replace(
        frame, rows=frame.rows + frame.rows % 2, columns=frame.columns + frame.columns % 2
    )


def _sheet(film: Film, frame: PictureFrame) -> Picture:
    """Picture under the items of every frame, premultiplied."""
    document = svg_document(
        without_items(film.layout), film.drawing, sheet_of(frame, film.layout.container)
    )
    return premultiplied(_pixels(drawn_png(document)))


def _pixels(png: bytes) -> Picture:
    with Image.open(io.BytesIO(png)) as picture:
        return np.asarray(picture.convert("RGBA"))


@dataclass(frozen=True)
class Rectangle:
    """A rectangle of a frame, in whole pixels."""

    top: int
    left: int
    bottom: int
    right: int

    @property
    def rows(self) -> slice:
        """For an array."""
        return slice(self.top, self.bottom)

    @property
    def columns(self) -> slice:
        """For an array."""
        return slice(self.left, self.right)


def changed_part(changed: npt.NDArray[np.bool_]) -> Rectangle:
    """Smallest rectangle that holds all that changed; one pixel if nothing did."""
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if len(rows) == 0:
        return Rectangle(0, 0, 1, 1)
    return Rectangle(int(rows[0]), int(columns[0]), int(rows[-1]) + 1, int(columns[-1]) + 1)


def changes(frames: Iterator[Frame]) -> Iterator[tuple[Frame, BoolArray, Rectangle]]:
    """Frames, pixels in which each differs from the one before, and the least rectangle of these.

    All of the first are changed.
    """
    before: Frame | None = None
    for frame in frames:
        if before is None:
            changed = np.ones(frame.shape[:2], dtype=bool)
        else:
            changed = frame != before
            changed = changed.any(axis=2) if changed.ndim == 3 else changed
        before = frame
        yield frame, changed, changed_part(changed)

"""Instances of strip packing in the JSON that jagua-rs and sparrow read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import shapely
from pydantic import BaseModel, Field, ValidationError
from shapely.geometry import Polygon

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.json_text import parsed
from packwork.readers.reading import UnfitError, read_text, reading_file, stem
from packwork.scene.item import Item

MAX_INSTANCE_BYTES = 16_000_000
"""Thousands of parts with hundreds of corners each."""

MAX_COUNT = 10_000
"""Parts of one kind."""

_Number = Annotated[float, Field(ge=-1e9, le=1e9, allow_inf_nan=False)]


_Ring = Annotated[list[tuple[_Number, _Number]], Field(min_length=3, max_length=10_000)]


class _SimplePolygonModel(BaseModel):
    type: Literal["simple_polygon"]
    data: _Ring

    @property
    def polygon(self) -> Polygon:
        return Polygon(self.data)


class _HoledModel(BaseModel):
    outer: _Ring
    inner: Annotated[list[_Ring], Field(max_length=1_000)] = []


class _PolygonModel(BaseModel):
    type: Literal["polygon"]
    data: _HoledModel

    @property
    def polygon(self) -> Polygon:
        return Polygon(self.data.outer, self.data.inner)


class _BoxModel(BaseModel):
    x_min: _Number
    y_min: _Number
    width: Annotated[_Number, Field(gt=0)]
    height: Annotated[_Number, Field(gt=0)]


class _RectangleModel(BaseModel):
    type: Literal["rectangle"]
    data: _BoxModel

    @property
    def polygon(self) -> Polygon:
        x, y = self.data.x_min, self.data.y_min
        return shapely.box(x, y, x + self.data.width, y + self.data.height)


_ShapeModel = Annotated[
    _SimplePolygonModel | _PolygonModel | _RectangleModel, Field(discriminator="type")
]


class _PartModel(BaseModel):
    id: int
    demand: Annotated[int, Field(ge=0, le=MAX_COUNT)]
    allowed_orientations: Annotated[list[_Number], Field(min_length=1, max_length=360)] | None = (
        None
    )
    shape: _ShapeModel


class _InstanceModel(BaseModel):
    name: str = ""
    strip_height: Annotated[float, Field(gt=0, le=1e9, allow_inf_nan=False)]
    items: Annotated[list[_PartModel], Field(min_length=1, max_length=10_000)]


@dataclass(frozen=True)
class InstancePart:
    """An item, how many of it, and the angles in degrees at which it may lie; None: any."""

    item: Item
    count: int
    angles: tuple[float, ...] | None


@dataclass(frozen=True)
class Instance:
    """A strip of a height, which is to be as short as possible, and the parts that go on it."""

    name: str
    height: float
    parts: tuple[InstancePart, ...]


def is_instance(path: str | Path) -> bool:
    """True for a file name that an instance may have.

    Examples
    --------
    >>> is_instance("swim.json"), is_instance("600x400mm")
    (True, False)
    """
    return Path(path).suffix.lower() == ".json"


def read_instance(path: str | Path) -> Instance:
    """Instance of a file; a part is named by its ``id``.

    Raises
    ------
    ReadError
        If there is none in the file, naming the first thing that is wrong.
    """
    with reading_file(str(path)):
        try:
            said = _InstanceModel.model_validate(parsed(read_text(path, MAX_INSTANCE_BYTES)))
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(str(part) for part in first["loc"])
            why = f"{place}: {first['msg'].lower()}" if place else "it holds no object"
            raise UnfitError(f"is no strip packing instance: {why}") from None
        return Instance(
            said.name or stem(path), said.strip_height,
            tuple(_part(one, str(path)) for one in said.items if one.demand),
        )  # fmt: skip


def _part(said: _PartModel, source: str) -> InstancePart:
    polygon = said.shape.polygon
    if not polygon.is_valid or polygon.area <= 0.0:
        why = shapely.is_valid_reason(polygon) if polygon.area else "it has no area"
        raise UnfitError(f"part {said.id} is no simple polygon: {why}")
    outline = Outline.of(polygon)
    x, y = outline.centroid
    centred = outline.mapped(affine.similarity(-x, -y, 0.0, 1.0))
    turns = said.allowed_orientations
    return InstancePart(
        Item(f"part {said.id}", source, centred, art="#8fb48c"), said.demand,
        None if turns is None else tuple(turns),
    )  # fmt: skip

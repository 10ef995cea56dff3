"""Saved layouts (GeoJSON) back to layouts."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias, TypeVar

import numpy as np
import shapely
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PlainValidator, ValidationError
from shapely.errors import GEOSException
from shapely.geometry import MultiPolygon, Polygon

from packwork.arrays import FloatArray, as_points
from packwork.errors import ReadError, RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.json_text import opened_collection, parsed
from packwork.readers.layouts import MAX_LAYOUT_BYTES
from packwork.readers.layouts.assembly import as_exact
from packwork.readers.reading import UnfitError, read_text, reading_file
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.scene.colour import css_colour
from packwork.scene.container import Container, repeating
from packwork.scene.item import Datum, FlatArt, Item, Label
from packwork.scene.layout import Layout, ground_in, is_hex
from packwork.scene.pose import Poses
from packwork.units import UNITS, Unit

WIDEST_STRETCH = 1e4
"""Width over height, or height over width, of an item against its own shape at most.
Larger: numbers whose inverse drowns in rounding. Chosen."""

SMALLEST_SCALE, LARGEST_SCALE = 1e-15, 1e15
"""Scales of items: drawings of 1e-4 to 1e7 px on canvases of 1e-3 to 1e6, and room. Derived."""

MAX_ITEMS = 100_000
"""Items of a layout file, as many as a run may be asked for: each takes half a millisecond and
3 kB, however small it is."""

_DRAWN = (".svg", ".dxf", ".png", ".pdf")
"""Endings of what is written of layouts besides: shapes in place, no items and poses."""

_NUMBER = f"must be up to {MAX_COORDINATE:g}"
_MUST = {
    "features": "must be a list",
    "manifest": "must be an object",
    "canvas": "must be an object with width and height",
    "width": f"must be positive, up to {MAX_COORDINATE:g}",
    "height": f"must be positive, up to {MAX_COORDINATE:g}",
    "unit": f"must be one of {', '.join(UNITS)}",
    "walls": f"must be lines of [x, y] pairs up to {MAX_COORDINATE:g}",
    "pen": "must be a colour such as #4a5568 and a width",
    "scale": f"must be positive, {SMALLEST_SCALE:g} to {LARGEST_SCALE:g}",
    "stretch": f"must be {1 / WIDEST_STRETCH:g} to {WIDEST_STRETCH:g}",
    "weight": f"must not be negative, and up to {MAX_COORDINATE:g}",
    "fill": "must be a colour such as #4a5568",
    **dict.fromkeys(("name", "link", "title"), "must be text"),
    **dict.fromkeys(("datum", "row"), "must be an object with a row"),
}
"""Refusals of what stands under a key; of other keys it is ``_NUMBER``."""


def _lines(said: Any) -> tuple[FloatArray, ...] | None:
    try:
        lines = None if said is None else tuple(as_points(line) for line in said)
    except (TypeError, ShapeError) as error:
        raise ValueError from error
    if any(len(line) < 2 or _reach(line) > MAX_COORDINATE for line in lines or ()):
        raise ValueError
    return lines


def _pen(said: Any) -> tuple[str, float]:
    if not isinstance(said, list) or len(said) != 2:
        raise ValueError
    colour, width = map(str, said)
    if not is_hex(colour) or not 0 < float(width) <= MAX_COORDINATE:
        raise ValueError
    return colour, float(width)


def _colour(said: Any) -> str:
    # What is no colour may lead out of the file once it is written again.
    css_colour(str(said))
    return str(said)


_Number: TypeAlias = Annotated[float, Field(ge=-MAX_COORDINATE, le=MAX_COORDINATE)]
_Side: TypeAlias = Annotated[float, Field(gt=0, le=MAX_COORDINATE)]


class _Saved(BaseModel):
    model_config = ConfigDict(strict=True, arbitrary_types_allowed=True)


class _Canvas(_Saved):
    width: _Side
    height: _Side
    unit: Unit = "px"


class _Collection(_Saved):
    features: list[Any]
    canvas: _Canvas | None = None
    manifest: dict[str, Any] | None = None
    items: Any = None


class _ContainerMembers(_Saved):
    role: Literal["container"]
    name: Any = "container"
    source: Any = None
    walls: Annotated[tuple[FloatArray, ...] | None, PlainValidator(_lines)] = None
    pen: Annotated[tuple[str, float] | None, PlainValidator(_pen)] = None
    tile: Literal["square", "half-drop"] | None = None


class _DatumMembers(_Saved):
    row: dict[str, Any]
    value: Annotated[float, Field(allow_inf_nan=False)] = 1.0
    category: Any = ""
    group: Any = ""


class _ItemMembers(_Saved):
    role: Literal["item"]
    item: Any = "item"
    source: Any = None
    x: _Number
    y: _Number
    angle: _Number
    scale: Annotated[float, Field(ge=SMALLEST_SCALE, le=LARGEST_SCALE)]
    stretch: Annotated[float, Field(ge=1 / WIDEST_STRETCH, le=WIDEST_STRETCH)] = 1.0
    weight: Annotated[float, Field(ge=0, le=MAX_COORDINATE)] = 1.0
    fill: Annotated[str, BeforeValidator(_colour)] = FlatArt().fill
    name: str | None = None
    link: str | None = None
    title: str | None = None
    datum: _DatumMembers | None = None


class _Geometry(_Saved):
    type: Literal["Polygon", "MultiPolygon"]
    coordinates: Any = None


class _Feature(_Saved):
    properties: Annotated[_ContainerMembers | _ItemMembers, Field(discriminator="role")]
    geometry: _Geometry


_Model = TypeVar("_Model", bound=BaseModel)


def read_layout(path: str | Path) -> Layout:
    """Layout of a GeoJSON file as ``writers.geojson`` makes it.

    Outlines are taken as they stand in the file, so that what is measured is what was
    written; each placed item gets its own ``Item``, its art a plain fill.

    Examples
    --------
    >>> import json, tempfile
    >>> tile = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]]]}
    >>> feature = {"type": "Feature", "properties": {"role": "container"}, "geometry": tile}
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "layout.geojson")
    ...     _ = file.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    ...     read_layout(file).container.width
    4.0
    """
    if Path(path).suffix.lower() in _DRAWN:
        raise ReadError(
            path,
            "shows a layout but does not hold it; load one saved as .geojson "
            "(packwork measure reads SVG and DXF too)",
        )
    text = read_text(path, MAX_LAYOUT_BYTES)
    with reading_file(str(path)):
        return layout_of_geojson(text)


def layout_of_geojson(text: str) -> Layout:
    """Layout of such a file's text."""
    said, lines = opened_collection(text)
    if not isinstance(said, dict) or said.get("type") != "FeatureCollection":
        raise UnfitError("is not a GeoJSON FeatureCollection; give a layout saved as .geojson")
    collection = _valid(_Collection, said)
    features, manifest = collection.features or lines, collection.manifest or {}
    if len(features) > MAX_ITEMS + 1:
        raise UnfitError(f"features: holds {len(features):,}, more than {MAX_ITEMS:,} items")
    containers: list[Container] = []
    items: list[Item] = []
    rows: list[tuple[float, ...]] = []
    weights: list[float] = []
    for k, each in enumerate(features):
        where = f"features[{k}]"
        feature = _valid(_Feature, parsed(each, k + 1) if lines else each, where)
        outline, of = _outline(feature.geometry, where), feature.properties
        if isinstance(of, _ContainerMembers):
            containers.append(_container(outline, of, collection.canvas))
        else:
            items.append(_item(outline, of, where))
            rows.append((of.x, of.y, math.radians(of.angle), of.scale, of.stretch))
            weights.append(of.weight)
    if len(containers) != 1:
        raise UnfitError(f"must have one feature of role container, not {len(containers)}")
    if collection.items not in (None, len(items)):
        lost = f"{len(items)} of {str(collection.items)[:9]} items are in the file"
        manifest = {**manifest, "changed": [lost], "certified": False}
    poses = Poses(*np.array(rows, dtype=np.float64).reshape(-1, 5).T.copy())
    ground = ground_in(manifest)
    return Layout(containers[0], tuple(items), poses, np.array(weights), manifest, ground=ground)


def _valid(model: type[_Model], value: Any, where: str = "") -> _Model:
    """A model's fields, or one line about the first that is wrong."""
    try:
        return model.model_validate(value)
    except ValidationError as refused:
        raise UnfitError(_refusal(refused, where)) from None


def _refusal(refused: ValidationError, where: str) -> str:
    error = refused.errors(include_url=False)[0]
    place, met = error["loc"], error["input"]
    if place[:1] == ("geometry",):
        return f"{where}: geometry must be a Polygon or MultiPolygon"
    if error["type"].startswith("union_tag"):
        return f"{where}: role must be container or item, not {str(met.get('role'))[:20]!r}"
    if place in ((), ("properties",)):
        return f"{where}: must be a feature with properties"
    names = [where] if where else []
    # After "properties" stands the role: the tag of the union.
    names += map(str, place[2:] if place[0] == "properties" else place)
    is_number = isinstance(met, int | float) and not isinstance(met, bool)
    must = _MUST.get(names[-1], _NUMBER)
    if error["type"] == "float_type" and not is_number:
        must = "must be a number"
    if error["type"] == "missing":
        return f"{'.'.join(names)}: {must}; there is none"
    shown = f"{met:g}" if isinstance(met, float) else str(met)[:20]
    return f"{'.'.join(names)}: {must}, not {shown if is_number else repr(shown)}"


def _container(outline: Outline, of: _ContainerMembers, canvas: _Canvas | None) -> Container:
    if canvas is None:
        _, _, right, bottom = outline.bounds
        canvas = _valid(_Canvas, {"width": right, "height": bottom}, "canvas")
    name = str(of.name)
    source = name if of.source is None else str(of.source)
    size = canvas.width, canvas.height, canvas.unit
    container = Container(name, source, outline, *size, walls=of.walls, pen=of.pen)
    return container if of.tile is None else repeating(container, of.tile)


def _item(outline: Outline, of: _ItemMembers, where: str) -> Item:
    # Undo the pose: move back, turn back, scale back, stretch back.
    back = affine.compose(
        affine.similarity(0.0, 0.0, -math.radians(of.angle), 1.0 / of.scale),
        affine.similarity(-of.x, -of.y, 0.0, 1.0),
    )
    shape = outline.mapped(affine.compose(affine.stretched(1.0 / of.stretch), back))
    try:
        label = Label(of.name or "", of.link or "", of.title or "")
    except RecipeError as error:
        raise UnfitError(f"{where}.{error}") from None
    name, said = str(of.item), of.datum
    source = name if of.source is None else str(of.source)
    datum = None
    if said is not None:
        datum = Datum(said.row, said.value, str(said.category), str(said.group))
    item = Item(name, source, shape, shape, FlatArt(of.fill), label, datum=datum)
    # Its lines are straight, whatever they were before.
    return as_exact(item, is_straight=of.stretch == 1.0)


def _outline(geometry: _Geometry, where: str) -> Outline:
    parts = [geometry.coordinates] if geometry.type == "Polygon" else geometry.coordinates
    try:
        count = sum(len(ring) for part in parts for ring in part)
        if count > MAX_POINTS:
            raise UnfitError(
                f"{where}: has {count:,} points, more than {MAX_POINTS:,}; simplify it"
            )
        region = MultiPolygon([_polygon(rings) for rings in parts])
    except (TypeError, ValueError, OverflowError, GEOSException):
        raise UnfitError(
            f"{where}: coordinates must be rings of [x, y] pairs up to {MAX_COORDINATE:g}"
        ) from None
    if not region.is_valid:
        raise UnfitError(
            f"{where}: its outline is no clean region: {shapely.is_valid_reason(region)}"
        )
    if region.area <= 0:
        raise UnfitError(f"{where}: its outline has no area")
    return Outline.from_region(region)


def _polygon(rings: Any) -> Polygon:
    arrays = [as_points([point[:2] for point in ring]) for ring in rings]
    if not arrays or any(_reach(ring) > MAX_COORDINATE for ring in arrays):
        raise ValueError
    return Polygon(arrays[0], arrays[1:])


def _reach(ring: FloatArray) -> float:
    return float(np.abs(ring).max()) if len(ring) else math.inf

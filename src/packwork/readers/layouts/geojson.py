"""Saved layouts (GeoJSON) back to layouts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.errors import GEOSException
from shapely.geometry import MultiPolygon, Polygon

from packwork.arrays import FloatArray, as_points
from packwork.errors import ReadError, RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.files import read_text
from packwork.readers.json_text import parsed
from packwork.readers.regions import MAX_POINTS
from packwork.readers.svg_syntax.lengths import MAX_COORDINATE
from packwork.readers.unfit import UnfitError, naming
from packwork.scene.colour import css_colour
from packwork.scene.container import Container
from packwork.scene.datum import Datum
from packwork.scene.item import FlatArt, Item
from packwork.scene.label import Label
from packwork.scene.layout import Layout, ground_in
from packwork.scene.pose import Poses
from packwork.units import UNITS, as_unit

MAX_LAYOUT_BYTES = 64_000_000
"""Size of a layout file: thousands of items with hundreds of vertices each. Chosen."""

WIDEST_STRETCH = 1e4
"""Width over height, or height over width, of an item against its own shape at most.
Larger: numbers whose inverse drowns in rounding. Chosen."""

SMALLEST_SCALE, LARGEST_SCALE = 1e-15, 1e15
"""Scales of items: drawings of 1e-4 to 1e7 px on canvases of 1e-3 to 1e6, and room. Derived."""

MAX_ITEMS = 100_000
"""Items of a layout file: each takes half a millisecond and 3 kB, however small it is. Larger:
minutes and gigabytes. Chosen: as many as a run may be asked for. Measured: 9.9 s of the processor
and 93 MB for 20,000 squares."""

_DRAWN = (".svg", ".dxf", ".png", ".pdf")
"""Endings of what is written of layouts besides: shapes in place, no items and poses."""

_POSE = ("x", "y", "angle")
_LABEL = ("name", "link", "title")


def read_layout(path: str | Path) -> Layout:
    """Layout of a GeoJSON file as ``writers.geojson`` makes it.

    Outlines are taken as they stand in the file, so that what is measured is what was
    written; each placed item gets its own ``Item``, its art a plain fill.

    Raises
    ------
    ReadError
        Saying where, if the file was edited into something that is no layout; saying what
        to load instead, if it is a drawing of one.

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
    with naming(str(path)):
        return layout_of_geojson(text)


def layout_of_geojson(text: str) -> Layout:
    """The same of a file's text.

    Raises
    ------
    UnfitError
        If it is no layout.
    """
    collection = _parsed(text)
    containers, placed = _split_by_role(collection)
    container = _container(containers, collection)
    items = tuple(_item(feature, where) for where, feature in placed)
    rows = [_pose(feature, where) for where, feature in placed]
    columns = np.array(rows, dtype=np.float64).reshape(-1, 5).T.copy()
    weights = np.array([_weight(feature, where) for where, feature in placed])
    manifest = collection.get("manifest") or {}
    if not isinstance(manifest, dict):
        raise UnfitError("manifest: must be an object")
    stated = collection.get("items", len(items))
    if stated != len(items):
        lost = f"{len(items)} of {str(stated)[:9]} items are in the file"
        manifest = {**manifest, "changed": [lost], "certified": False}
    poses, ground = Poses(*columns), ground_in(manifest)
    return Layout(container, items, poses, weights, manifest, ground=ground)


def _parsed(text: str) -> Mapping[str, Any]:
    collection = parsed(text)
    if not isinstance(collection, dict) or collection.get("type") != "FeatureCollection":
        raise UnfitError("is not a GeoJSON FeatureCollection; give a layout saved as .geojson")
    return collection


_Posed = tuple[str, Mapping[str, Any]]


def _split_by_role(collection: Mapping[str, Any]) -> tuple[list[_Posed], list[_Posed]]:
    """Container features and item features, each with words that say where it stands."""
    features = collection.get("features")
    if not isinstance(features, list):
        raise UnfitError("features: must be a list")
    if len(features) > MAX_ITEMS + 1:
        raise UnfitError(f"features: holds {len(features):,}, more than {MAX_ITEMS:,} items")
    by_role: dict[str, list[_Posed]] = {"container": [], "item": []}
    for k, feature in enumerate(features):
        where = f"features[{k}]"
        role = _properties(feature, where).get("role")
        if not isinstance(role, str) or role not in by_role:
            raise UnfitError(f"{where}: role must be container or item, not {str(role)[:20]!r}")
        by_role[role].append((where, feature))
    return by_role["container"], by_role["item"]


def _properties(feature: Any, where: str) -> Mapping[str, Any]:
    properties = feature.get("properties") if isinstance(feature, dict) else None
    if not isinstance(properties, dict):
        raise UnfitError(f"{where}: must be a feature with properties")
    return properties


def _container(found: list[_Posed], collection: Mapping[str, Any]) -> Container:
    if len(found) != 1:
        raise UnfitError(f"must have one feature of role container, not {len(found)}")
    where, feature = found[0]
    properties = _properties(feature, where)
    outline = _outline(feature, where)
    canvas = collection.get("canvas", {"width": outline.bounds[2], "height": outline.bounds[3]})
    if not isinstance(canvas, dict):
        raise UnfitError("canvas: must be an object with width and height")
    width, height = (_positive(canvas, side, "canvas") for side in ("width", "height"))
    unit = as_unit(canvas.get("unit", "px"))
    if unit is None:
        known = ", ".join(UNITS)
        raise UnfitError(f"canvas.unit: must be one of {known}, not {str(canvas['unit'])[:20]!r}")
    name = str(properties.get("name", "container"))
    source = str(properties.get("source", name))
    walls = _walls(properties, where)
    return Container(name, source, outline, width, height, unit, walls=walls)


def _walls(properties: Mapping[str, Any], where: str) -> tuple[FloatArray, ...] | None:
    """Lines that are seen of a container with openings; None where it has none."""
    said = properties.get("walls")
    if said is None:
        return None
    try:
        lines = tuple(as_points(line) for line in said)
    except (TypeError, ValueError, ShapeError):
        lines = (np.full((1, 2), math.inf),)
    if any(len(line) < 2 or _reach(line) > MAX_COORDINATE for line in lines):
        raise UnfitError(f"{where}.walls: must be lines of [x, y] pairs up to {MAX_COORDINATE:g}")
    return lines


def _item(feature: Mapping[str, Any], where: str) -> Item:
    properties = _properties(feature, where)
    x, y, angle_rad, scale, stretch = _pose(feature, where)
    # Undo the pose: move back, turn back, scale back, stretch back.
    back = affine.compose(
        affine.similarity(0.0, 0.0, -angle_rad, 1.0 / scale), affine.similarity(-x, -y, 0.0, 1.0)
    )
    back = affine.compose(affine.stretched(1.0 / stretch), back)
    outline = _outline(feature, where).mapped(back)
    name = str(properties.get("item", "item"))
    art = FlatArt(_fill(properties, where))
    source = str(properties.get("source", name))
    return Item(
        name, source, outline, outline, art, _label(properties, where),
        datum=_datum(properties, where),
    )  # fmt: skip


def _label(properties: Mapping[str, Any], where: str) -> Label:
    said = {key: properties[key] for key in _LABEL if properties.get(key) is not None}
    for key, text in said.items():
        if not isinstance(text, str):
            raise UnfitError(f"{where}.{key}: must be text, not {str(text)[:20]!r}")
    try:
        return Label(**said)
    except RecipeError as error:
        raise UnfitError(f"{where}.{error}") from None


def _datum(properties: Mapping[str, Any], where: str) -> Datum | None:
    """What a mark of a chart stands for; None for any other item."""
    said = properties.get("datum")
    if said is None:
        return None
    if not isinstance(said, dict) or not isinstance(said.get("row"), dict):
        raise UnfitError(f"{where}.datum: must be an object with a row")
    value = said.get("value", 1.0)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UnfitError(f"{where}.datum.value: must be a number, not {str(value)[:20]!r}")
    category, group = (str(said.get(key, "")) for key in ("category", "group"))
    return Datum(said["row"], float(value), category, group)


def _fill(properties: Mapping[str, Any], where: str) -> str:
    fill = properties.get("fill", FlatArt().fill)
    try:
        # What is no colour may lead out of the file once it is written again.
        css_colour(str(fill))
    except ValueError:
        raise UnfitError(
            f"{where}.fill: must be a colour such as #4a5568, not {str(fill)[:20]!r}"
        ) from None
    return str(fill)


def _pose(feature: Mapping[str, Any], where: str) -> tuple[float, float, float, float, float]:
    """Position, angle in radians, scale and stretch."""
    properties = _properties(feature, where)
    x, y, angle = (_number(properties, key, where) for key in _POSE)
    scale = _scale(properties, where)
    return x, y, math.radians(angle), scale, _stretch(properties, where)


def _scale(properties: Mapping[str, Any], where: str) -> float:
    """Canvas units to a unit of the item's file: of tiny drawings on large sheets it is large."""
    scale = properties.get("scale")
    if isinstance(scale, bool) or not isinstance(scale, int | float):
        raise UnfitError(f"{where}.scale: must be a number, not {str(scale)[:20]!r}")
    if not SMALLEST_SCALE <= scale <= LARGEST_SCALE:
        bounds = f"{SMALLEST_SCALE:g} to {LARGEST_SCALE:g}"
        raise UnfitError(f"{where}.scale: must be positive, {bounds}, not {str(scale)[:20]}")
    return float(scale)


def _stretch(properties: Mapping[str, Any], where: str) -> float:
    stretch, least = _number({"stretch": 1.0, **properties}, "stretch", where), 1 / WIDEST_STRETCH
    if not least <= stretch <= WIDEST_STRETCH:
        raise UnfitError(
            f"{where}.stretch: must be {least:g} to {WIDEST_STRETCH:g}, not {stretch:g}"
        )
    return stretch


def _weight(feature: Mapping[str, Any], where: str) -> float:
    weight = _number({"weight": 1.0, **_properties(feature, where)}, "weight", where)
    if weight < 0:
        raise UnfitError(f"{where}.weight: must not be negative, is {weight:g}")
    return weight


def _outline(feature: Mapping[str, Any], where: str) -> Outline:
    geometry = feature.get("geometry")
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    if not isinstance(geometry, dict) or kind not in ("Polygon", "MultiPolygon"):
        raise UnfitError(f"{where}: geometry must be a Polygon or MultiPolygon")
    parts: Any = geometry.get("coordinates")
    try:
        if kind == "Polygon":
            count = sum(len(ring) for ring in parts)
        else:
            count = sum(len(ring) for part in parts for ring in part)
        if count > MAX_POINTS:
            raise UnfitError(
                f"{where}: has {count:,} points, more than {MAX_POINTS:,}; simplify it"
            )
        polygons = [parts] if kind == "Polygon" else parts
        region = MultiPolygon([_polygon(rings) for rings in polygons])
    except (TypeError, ValueError, OverflowError, GEOSException):
        raise UnfitError(
            f"{where}: coordinates must be rings of [x, y] pairs up to {MAX_COORDINATE:g}"
        ) from None
    return Outline.from_region(_checked(region, where))


def _polygon(rings: Any) -> Polygon:
    arrays = [as_points([point[:2] for point in ring]) for ring in rings]
    if not arrays or any(_reach(ring) > MAX_COORDINATE for ring in arrays):
        raise ValueError
    return Polygon(arrays[0], arrays[1:])


def _reach(ring: FloatArray) -> float:
    return float(np.abs(ring).max()) if len(ring) else math.inf


def _checked(region: Region, where: str) -> Region:
    if not region.is_valid:
        raise UnfitError(
            f"{where}: its outline is no clean region: {shapely.is_valid_reason(region)}"
        )
    if region.area <= 0:
        raise UnfitError(f"{where}: its outline has no area")
    return region


def _number(values: Mapping[str, Any], key: str, where: str) -> float:
    value = values.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UnfitError(f"{where}.{key}: must be a number, not {str(value)[:20]!r}")
    if not abs(value) <= MAX_COORDINATE:
        raise UnfitError(f"{where}.{key}: must be up to {MAX_COORDINATE:g}, not {str(value)[:20]}")
    return float(value)


def _positive(values: Mapping[str, Any], key: str, where: str) -> float:
    number = _number(values, key, where)
    if number <= 0:
        raise UnfitError(f"{where}.{key}: must be positive, not {number:g}")
    return number

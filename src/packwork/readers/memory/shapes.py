"""Geometries in memory: Shapely's, whatever has ``__geo_interface__``, GeoJSON, rows of frames."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain, repeat
from typing import Any

import numpy as np
import shapely
from shapely.errors import GEOSException
from shapely.geometry.base import BaseGeometry

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import simplify, valid
from packwork.geometry.polygon import Region, polygon_parts, united
from packwork.readers.reading import UnfitError, notice
from packwork.readers.tables.table import is_count
from packwork.scene.item import RowLabel

MAX_SHAPES = 20_000
"""Rows of one frame, features of one collection. Chosen."""

MAX_POINTS = 60_000
"""Points of one geometry beyond which it is simplified, and that it may have then. As of
drawings that are traced."""

SMALL, LARGE = 1.0, 1e4
"""Extents between which coordinates are taken for px, as of files; others are degrees, metres,
shares. Chosen."""

FARTHEST = 1e12
"""Coordinates that are taken for a mistake from here on. Chosen."""

FITTED = 100.0
"""Extent in px of the largest geometry whose coordinates are no px. Chosen."""

_FLAT = ("Polygon", "MultiPolygon", "GeometryCollection")
_THIN = ("Point", "MultiPoint", "LineString", "MultiLineString")
_GEOMETRIES = frozenset((*_FLAT, *_THIN))
GEOJSON = _GEOMETRIES | {"Feature", "FeatureCollection"}
"""Values of ``type`` by which a dict is known as GeoJSON."""

_NAMES = ("name", "title", "label", "id")
_WEIGHTS = ("weight",)
_COLOURS = ("fill", "color", "colour")


@dataclass(frozen=True)
class Columns:
    """Columns of frames, or properties of features, that say what is not geometry.

    None stands for one that is called ``name`` or so, or ``weight``, where there is one.
    """

    name: str | None = None
    weight: str | None = None


@dataclass(frozen=True, eq=False)
class GivenShape:
    """One geometry, and what is said of it.

    Parameters
    ----------
    region
        Valid, its area positive; y down.
    fill
        Its colour, as the data have it; empty for none.
    row
        Which row of a frame it is; None of one whose index only counts them, and of all else.
    """

    name: str
    region: Region
    weight: float = 1.0
    fill: str = ""
    row: RowLabel | None = None


@dataclass(frozen=True, eq=False)
class GivenShapes:
    """Geometries that were given as one value."""

    shapes: tuple[GivenShape, ...]
    name: str


def is_geometry(value: object) -> bool:
    """Whether a value is a geometry, or several with what is said of them.

    >>> is_geometry(shapely.box(0, 0, 1, 1)), is_geometry({"type": "Polygon"}), is_geometry("star")
    (True, True, False)
    """
    if isinstance(value, BaseGeometry) or hasattr(value, "__geo_interface__"):
        return True
    if isinstance(value, Mapping):
        return value.get("type") in GEOJSON
    return _as_row(value) is not None


def points_up(value: object) -> bool:
    """Whether y points up in it for sure: a frame says which reference system it is in.

    >>> points_up(shapely.box(0, 0, 1, 1))
    False
    """
    return getattr(value, "crs", None) is not None


def shapes_of(
    value: object, name: str, *, y_up: bool = False, columns: Columns | None = None
) -> GivenShapes:
    """Regions of a geometry, a frame, a row of one, or GeoJSON; y down.

    Rows without area are left out with a notice, if others have some. Coordinates that are no px
    (degrees, metres, shares) are scaled, all of one value alike. ``name`` is what people call it,
    where it does not say.

    >>> feature = {
    ...     "type": "Feature", "properties": {"name": "lake", "weight": 3},
    ...     "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 0]]]},
    ... }
    >>> (lake,) = shapes_of(feature, "shape").shapes
    >>> lake.name, lake.weight, lake.region.bounds
    ('lake', 3.0, (0.0, 0.0, 4.0, 2.0))
    """
    found: list[GivenShape] = []
    bare: list[str] = []
    rows = zip(_features(value), chain(row_labels(value), repeat(None)), strict=False)
    for number, ((geometry, said), row) in enumerate(rows, start=1):
        if number > MAX_SHAPES:
            raise UnfitError(f"has more than {MAX_SHAPES:,} geometries; give fewer rows")
        called = _name(said, columns) or name
        region = _region(geometry, y_up)
        if region is None:
            bare.append(called)
        else:
            weight = _weight(said, columns, number)
            found.append(GivenShape(called, region, weight, _fill(said), row))
    if not found:
        kind = f", as a {value.geom_type}" if isinstance(value, BaseGeometry) else ""
        raise UnfitError(f"has no area{kind}; give polygons, or lines with a buffer round")
    if bare:
        notice(f"{len(bare)} of {len(bare) + len(found)} geometries have no area and are left out")
    return GivenShapes(tuple(_fitted(_numbered(found))), name)


def _features(value: object) -> Iterator[tuple[BaseGeometry | None, Mapping[str, Any]]]:
    """Each geometry with its properties."""
    row = _as_row(value)
    if isinstance(value, BaseGeometry):
        yield value, {}
    elif row is not None:
        yield row["geometry"], row
    else:
        yield from _of_geojson(getattr(value, "__geo_interface__", value))


def row_labels(value: Any) -> list[RowLabel]:
    """Labels of the rows of a frame, or of one row; none where an index only counts them."""
    if _as_row(value) is not None:
        return [RowLabel(getattr(value, "Index", getattr(value, "name", None)))]
    index: Any = getattr(value, "index", None)
    if not hasattr(index, "nlevels") or is_count(index):
        return []
    return [RowLabel(label, tuple(index.names)) for label in index]


def _of_geojson(value: Any) -> Iterator[tuple[BaseGeometry | None, Mapping[str, Any]]]:
    kind = value.get("type") if isinstance(value, Mapping) else None
    if kind == "FeatureCollection":
        features = value.get("features")
        if not isinstance(features, list | tuple):
            raise UnfitError("is a FeatureCollection without a list of features")
        for feature in features:
            yield from _of_geojson(feature)
    elif kind == "Feature":
        said = value.get("properties")
        called = value.get("id")
        # Numbers of rows are no names.
        own = {"id": called} if isinstance(called, str) and not called.isdigit() else {}
        yield _geometry(value.get("geometry")), {**own, **(said or {})}
    elif kind in _GEOMETRIES:
        yield _geometry(value), {}
    else:
        raise UnfitError(f"is GeoJSON of the unknown type {str(kind)[:40]!r}")


def _geometry(value: Any) -> BaseGeometry | None:
    if value is None or isinstance(value, BaseGeometry):
        return value
    try:
        return shapely.geometry.shape(value)
    except (GEOSException, AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        reason = " ".join(str(error).split())[:80]
        raise UnfitError(f"holds coordinates that make no geometry ({reason})") from None


def _as_row(value: object) -> Mapping[str, Any] | None:
    """Columns of one row of a frame, as ``iloc`` and ``itertuples`` give it; None of all else."""
    if not isinstance(getattr(value, "geometry", None), BaseGeometry):
        return None
    for way in ("_asdict", "to_dict"):
        if callable(said := getattr(value, way, None)):
            return {str(key): one for key, one in said().items()}
    return None


def _region(geometry: BaseGeometry | None, y_up: bool) -> Region | None:
    """Region of a geometry, y down; None if it covers nothing."""
    if not isinstance(geometry, BaseGeometry) or geometry.is_empty:
        return None
    points = shapely.get_coordinates(geometry)
    if not (np.abs(points) < FARTHEST).all():
        raise UnfitError(f"has coordinates that are NaN, infinite or beyond {FARTHEST:g}")
    parts = polygon_parts(valid(shapely.force_2d(geometry)))
    if not parts:
        return None
    whole = united(parts)
    turned = shapely.transform(whole, lambda xy: xy * (1.0, -1.0)) if y_up else whole
    return _no_finer(turned)


def _no_finer(region: Region) -> Region:
    count = shapely.get_num_coordinates(region)
    if count <= MAX_POINTS:
        return region
    left, top, right, bottom = region.bounds
    tolerance = FLATTENING * max(right - left, bottom - top)
    plainer = valid(simplify(region, tolerance, keeps_topology=True))
    if shapely.get_num_coordinates(plainer) > MAX_POINTS:
        raise UnfitError(f"has {count:,} points; {MAX_POINTS:,} are the most, so simplify it")
    return plainer


def _said(said: Mapping[str, Any], column: str | None, usual: tuple[str, ...]) -> Any:
    """The value of a column that was named, else of the first usual one; None if there is none."""
    if column is not None:
        if column not in said:
            there = ", ".join(key for key in map(str, said) if key != "geometry") or "none"
            raise UnfitError(f"has no column {column!r}; there are {there[:200]}")
        return said[column]
    known = {str(key).casefold(): one for key, one in reversed(list(said.items()))}
    return next((known[key] for key in usual if known.get(key) is not None), None)


def _name(said: Mapping[str, Any], columns: Columns | None) -> str:
    value = _said(said, columns.name if columns else None, _NAMES)
    return "" if value is None else str(value).strip()


def _weight(said: Mapping[str, Any], columns: Columns | None, number: int) -> float:
    value = _said(said, columns.weight if columns else None, _WEIGHTS)
    if value is None and not (columns and columns.weight):
        return 1.0
    try:
        weight = float(value)
    except (TypeError, ValueError):
        weight = math.nan
    if not (math.isfinite(weight) and weight > 0):
        raise UnfitError(f"row {number}: the weight must be a positive number, not {value!r:.40}")
    return weight


def _fill(said: Mapping[str, Any]) -> str:
    value = _said(said, None, _COLOURS)
    return value if isinstance(value, str) else ""


def _numbered(shapes: list[GivenShape]) -> list[GivenShape]:
    """Shapes of one name told apart by numbers."""
    seen: dict[str, int] = {}
    found = []
    for shape in shapes:
        seen[shape.name] = number = seen.get(shape.name, 0) + 1
        found.append(shape if number == 1 else replace(shape, name=f"{shape.name} {number}"))
    return found


def _fitted(shapes: list[GivenShape]) -> list[GivenShape]:
    """Shapes in px: as they are where they are about that large, else all scaled alike."""
    bounds = np.array([shape.region.bounds for shape in shapes])
    extent = float((bounds[:, 2:] - bounds[:, :2]).max())
    if SMALL <= extent <= LARGE:
        return shapes
    if not extent > 0:
        raise UnfitError("is a single point; give polygons")
    scale = FITTED / extent
    # About its own corner: far from the origin few digits are left for the shape.
    return [
        replace(one, region=shapely.transform(one.region, lambda xy, c=corner: (xy - c) * scale))
        for one, corner in zip(shapes, bounds[:, :2], strict=True)
    ]

"""Maps: GeoJSON (RFC 7946) whose features are regions, brought onto the plane.

Longitudes and latitudes are projected so that areas keep their proportion: by Lambert's azimuthal
projection about the middle of all (Snyder 1987, Map Projections: A Working Manual, eqs. 24-2 to
24-4), and what reaches more than a quarter round the earth by Equal Earth (Savric, Patterson and
Jenny 2018, The Equal Earth map projection). Other coordinates are taken for metres of a survey,
their y upwards.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.errors import GEOSException

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.overlay import intersection, union, valid
from packwork.geometry.polygon import Region
from packwork.readers.json_text import parsed
from packwork.readers.reading import UnfitError, read_bytes, reading_file
from packwork.readers.regions import MAX_POINTS, clean_union
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE
from packwork.scene.container import Container, placed_container
from packwork.scene.item import MAX_LENGTH

ENDINGS = (".geojson", ".json")

MAX_MAP_BYTES = 50_000_000
"""Size of a map's file: more than ``MAX_POINTS`` take. Derived."""

MOST_BYTES = 200_000_000
"""Size of GeoJSON that is looked at for being a map: that of a layout. Derived."""

MOST_REGIONS = 2_000
"""Features of a map at most: each is united with its neighbours. Chosen."""

CALLED = re.compile(r"name|name_?\w{2,3}|\w*_?name(_?\d)?|title|label|id", re.IGNORECASE)
"""Properties that name a feature for people, where nothing else says which."""

_EQUAL_EARTH = (1.340264, -0.081106, 0.000893, 0.003796)
_OURS = re.compile(rb'"role"\s*:\s*"container"')


@dataclass(frozen=True, eq=False)
class Feature:
    """A region on the plane, y down, and what names it: texts and numbers of its properties."""

    names: Mapping[str, str]
    region: Region


def is_map(path: Path) -> bool:
    """Whether GeoJSON holds features, and is no layout of ours."""
    data = read_bytes(path, MOST_BYTES)
    return b'"FeatureCollection"' in data and _OURS.search(data) is None


def container_of_map(text: str, name: str, source: str, side: float) -> Container:
    """Container of all regions of a map, ``side`` long on its longer side."""
    with reading_file(source):
        whole = clean_union(*(feature.region for feature in _features(text)))
        left, top, right, bottom = whole.bounds
        box = (left, top, right - left, bottom - top)
        return placed_container(name, source, whole, box, side)


def parts_of_map(
    text: str, container: Container, asked: Collection[str] = ()
) -> list[tuple[str, Region]]:
    """Names and regions, canvas units, of the parts of a container that a map was read to.

    Features that are called alike are one part. ``asked``: names that are looked for; parts are
    called by the property that has most of them, in either case; without, by that for people.
    """
    with reading_file(container.source):
        features = list(_features(text))
        left, top, right, bottom = clean_union(*(one.region for one in features)).bounds
    key = _key(features, {name.casefold() for name in asked})
    scale = container.outline.extent / max(right - left, bottom - top)
    corner, inside = np.array(container.outline.bounds[:2]), container.outline.region
    together = dict[str, list[Region]]()
    for one in features:
        if key in one.names:
            together.setdefault(one.names[key], []).append(one.region)
    parts = []
    for name, regions in together.items():
        moved = shapely.transform(
            union(regions), lambda points: (points - (left, top)) * scale + corner
        )
        parts.append((name, intersection(moved, inside)))
    return [(name, region) for name, region in parts if region.area > 0]


def names_on_map(text: str) -> list[set[str]]:
    """Names that features of a map have, those of each property, in small letters.

    Examples
    --------
    >>> names_on_map('{"features": [{"properties": {"name": "Peru"}}]}')
    [{'peru'}]
    """
    said = parsed(text)
    listed = said.get("features") if isinstance(said, dict) else None
    found = dict[str, set[str]]()
    for one in listed if isinstance(listed, list) else ():
        for key, name in (_names(one) if isinstance(one, dict) else {}).items():
            found.setdefault(key, set()).add(name.casefold())
    return list(found.values())


def _key(features: Collection[Feature], asked: Collection[str]) -> str:
    """Property that has most of the names, or which most features have; empty for none."""
    said = dict[str, list[str]]()
    for one in features:
        for key, name in one.names.items():
            said.setdefault(key, []).append(name.casefold())

    def worth(key: str) -> tuple[int, bool, int]:
        met = set(said[key])
        return len(met.intersection(asked)), CALLED.fullmatch(key) is not None, len(met)

    best = max(said, key=worth, default="")
    return best if asked or not best or CALLED.fullmatch(best) else ""


def _features(text: str) -> Iterator[Feature]:
    """Features with an area; others are left out."""
    said = parsed(text)
    listed = said.get("features") if isinstance(said, dict) else None
    if not isinstance(listed, list):
        raise UnfitError("is no GeoJSON FeatureCollection; give a map whose features are regions")
    if len(listed) > MOST_REGIONS:
        raise UnfitError(f"holds {len(listed):,} features, more than {MOST_REGIONS:,}")
    found = list[tuple[dict[str, str], list[list[FloatArray]]]]()
    count = 0
    for number, one in enumerate(listed):
        polygons = _polygons(one, f"features[{number}]")
        count += sum(len(ring) for rings in polygons for ring in rings)
        if count > MAX_POINTS:
            raise UnfitError(f"has more than {MAX_POINTS:,} points; simplify it")
        if polygons:
            found.append((_names(one), polygons))
    if not found:
        raise UnfitError("holds no regions: none of its features is a Polygon or MultiPolygon")
    project = _projection(np.concatenate([r for _, each in found for rings in each for r in rings]))
    for names, polygons in found:
        try:
            shapes = [valid(shapely.Polygon(*_shell(map(project, rings)))) for rings in polygons]
            region = union(shapes)
        except (GEOSException, ValueError, ShapeError):
            name = next(iter(names.values()), "a feature")
            raise UnfitError(f"{name[:40]} is no region") from None
        if region.area > 0:
            yield Feature(names, region)


def _shell(rings: Iterable[FloatArray]) -> tuple[FloatArray, list[FloatArray]]:
    outer, *holes = rings
    return outer, holes


def _polygons(feature: Any, where: str) -> list[list[FloatArray]]:
    """Rings of the polygons of a feature, each ``(n, 2)``; none of other geometries."""
    geometry = feature.get("geometry") if isinstance(feature, dict) else None
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    if not isinstance(geometry, dict) or kind not in {"Polygon", "MultiPolygon"}:
        return []
    said: Any = geometry.get("coordinates")
    try:
        polygons = [said] if kind == "Polygon" else list(said)
        rings = [
            [np.array([point[:2] for point in ring], dtype=np.float64) for ring in each]
            for each in polygons
        ]
        flat = [ring for each in rings for ring in each]
        is_sound = all(
            ring.ndim == 2 and ring.shape[1] == 2 and len(ring) > 3
            and np.abs(ring).max() <= MAX_COORDINATE
            for ring in flat
        )  # fmt: skip
    except (TypeError, ValueError, OverflowError, KeyError, IndexError):
        is_sound, rings = False, []
    if not is_sound:
        raise UnfitError(
            f"{where}: coordinates must be rings of four [x, y] pairs up to {MAX_COORDINATE:g}"
        )
    return [each for each in rings if each]


def _names(feature: Mapping[str, Any]) -> dict[str, str]:
    said = feature.get("properties")
    named = {**said} if isinstance(said, dict) else {}
    if "id" not in named:
        named["id"] = feature.get("id")
    plain = {key: value for key, value in named.items() if type(value) in {str, int}}
    texts = {key: " ".join(str(value)[:MAX_LENGTH].split()) for key, value in plain.items()}
    return {key: text for key, text in texts.items() if text}


def _projection(points: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Function from ``(n, 2)`` coordinates of a file to such on a plane, y down."""
    if (np.abs(points).max(axis=0) > (360.0, 90.0)).any():
        return lambda ring: ring * (1.0, -1.0)
    east, north = np.radians(points).T
    around = np.column_stack(
        [np.cos(north) * np.cos(east), np.cos(north) * np.sin(east), np.sin(north)]
    )
    x, y, z = middle = (around.min(axis=0) + around.max(axis=0)) / 2
    length = float(np.linalg.norm(middle))
    if length == 0 or (around @ middle).min() < 0:
        return _equal_earth
    lon, lat = np.arctan2(y, x), np.arcsin(z / length)

    def lambert(ring: FloatArray) -> FloatArray:
        along, up = np.radians(ring[:, 0]) - lon, np.radians(ring[:, 1])
        cosine = np.sin(lat) * np.sin(up) + np.cos(lat) * np.cos(up) * np.cos(along)
        k = np.sqrt(2 / (1 + cosine))
        north = np.cos(lat) * np.sin(up) - np.sin(lat) * np.cos(up) * np.cos(along)
        return np.column_stack([k * np.cos(up) * np.sin(along), -k * north])

    return lambert


def _equal_earth(ring: FloatArray) -> FloatArray:
    a1, a2, a3, a4 = _EQUAL_EARTH
    t = np.arcsin(np.sqrt(3) / 2 * np.sin(np.radians(ring[:, 1])))
    slope = 9 * a4 * t**8 + 7 * a3 * t**6 + 3 * a2 * t**2 + a1
    x = 2 * np.sqrt(3) * np.radians(ring[:, 0]) * np.cos(t) / (3 * slope)
    return np.column_stack([x, -(a4 * t**9 + a3 * t**7 + a2 * t**3 + a1 * t)])

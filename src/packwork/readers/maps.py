"""Maps: GeoJSON (RFC 7946) whose features are regions, brought onto the plane.

Longitudes and latitudes are projected so that areas keep their proportion: by Lambert's azimuthal
projection about the middle of all (Snyder 1987, Map Projections: A Working Manual, eqs. 24-2 to
24-4), and what reaches more than a quarter round the earth by Equal Earth (Savric, Patterson and
Jenny 2018, The Equal Earth map projection). Other coordinates are taken for metres of a survey,
their y upwards.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.errors import GEOSException

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.distance import snap_rounded
from packwork.geometry.overlay import difference, intersection, polygon_parts, union, valid
from packwork.geometry.polygon import Region
from packwork.readers.budget.crossings import MAX_UNION_CROSSINGS, Allowance
from packwork.readers.json_text import parsed
from packwork.readers.reading import UnfitError, read_bytes, reading_file
from packwork.readers.regions import MAX_POINTS, SPECK, clean_union, large_parts
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

MAX_CROSSINGS = 1_000
"""Places where features may cross themselves, by estimate: GEOS takes a millisecond and more for
each. Measured."""

STEP = 1.0
"""Length of edges, degrees, at most: longer ones are not straight on the plane. Longer leave gaps
of .01 % of a continent between neighbours, shorter take more points. Chosen."""

OFF = 1e-6
"""Degrees by which rounding may take a place off the globe. Chosen."""

CALLED = re.compile(r"name|name_?\w{2,3}|\w*_?name(_?\d)?|title|label|id", re.IGNORECASE)
"""Properties that name a feature for people, where nothing else says which."""

_EQUAL_EARTH = (1.340264, -0.081106, 0.000893, 0.003796)
_TYPE = re.compile(rb'"(Feature|FeatureCollection|Polygon|MultiPolygon|GeometryCollection)"')
_OURS = re.compile(rb'"role"\s*:\s*"container"')


@dataclass(frozen=True, eq=False)
class Feature:
    """A region on the plane, y down, and what names it: texts and numbers of its properties."""

    names: Mapping[str, str]
    region: Region


def is_map(path: Path) -> bool:
    """Whether GeoJSON holds features or areas, and is no layout of ours."""
    return _TYPE.search(read_bytes(path, MOST_BYTES)) is not None and not is_ours(path)


def is_ours(path: Path) -> bool:
    """Whether GeoJSON holds a layout of ours."""
    return _OURS.search(read_bytes(path, MOST_BYTES)) is not None


def container_of_map(
    text: str, name: str, source: str, side: float, *, is_plane: bool = False
) -> Container:
    """Container of all regions of a map, ``side`` long on its longer side.

    ``is_plane``: whether its coordinates are lengths, however small.
    """
    with reading_file(source):
        # Called as elsewhere, so that a map is kept for its parts.
        features = _features(text, is_plane=True) if is_plane else _features(text)
        whole = clean_union(*(feature.region for feature in features))
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
        features = _features(text)
        left, top, right, bottom = clean_union(*(one.region for one in features)).bounds
        wanted = {region_key(name) for name in asked}
        key = _key(features, wanted)
        scale = container.outline.extent / max(right - left, bottom - top)
        corner, inside = np.array(container.outline.bounds[:2]), container.outline.region
        together = dict[str, tuple[str, list[Region]]]()
        for one in features:
            if key in one.names:
                name = one.names[key]
                together.setdefault(region_key(name), (name, []))[1].append(one.region)
        parts = []
        for (name, _), region in zip(
            together.values(),
            _apart([union(regions) for _, regions in together.values()]),
            strict=True,
        ):
            moved = shapely.transform(
                region, lambda points: (points - (left, top)) * scale + corner
            )
            # A ring round a pole closes there but for a pinhole and a seam.
            part = snap_rounded(intersection(moved, inside))
            if large := large_parts(part, SPECK * part.area):
                parts.append((name, large[0] if len(large) == 1 else shapely.MultiPolygon(large)))
            elif region_key(name) in wanted:
                raise UnfitError(f"{name[:40]} lies all within other regions; take one of them out")
        return parts


def region_key(name: str) -> str:
    """The same for names that mean one region: of either case, in any form of Unicode; of numbers.

    Examples
    --------
    >>> region_key("01") == region_key("1"), region_key("PERU") == region_key("Peru")
    (True, True)
    """
    plain = unicodedata.normalize("NFC", name).casefold()
    return str(int(plain)) if plain.isascii() and plain.isdigit() else plain


def _apart(regions: list[Region]) -> list[Region]:
    """The same regions without what smaller ones take: an enclave is drawn over its land."""
    tree, found = shapely.STRtree(regions), []
    areas = [(region.area, k) for k, region in enumerate(regions)]
    for k, region in enumerate(regions):
        near = tree.query(region, predicate="intersects").tolist()
        smaller = [regions[m] for m in near if areas[m] < areas[k]]
        found.append(difference(region, union(smaller)) if smaller else region)
    return found


def names_on_map(text: str) -> list[set[str]]:
    """Names that regions of a map have, those of each property, as by :func:`region_key`.

    Examples
    --------
    >>> shape = '{"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]}'
    >>> names_on_map('{"features": [{"properties": {"name": "Peru"}, "geometry": %s}]}' % shape)
    [{'peru'}]
    """
    found = dict[str, set[str]]()
    for one in _features(text):
        for key, name in one.names.items():
            found.setdefault(key, set()).add(region_key(name))
    return list(found.values())


def _key(features: Collection[Feature], asked: Collection[str]) -> str:
    """Property that has most of the names, or which most features have; empty for none."""
    said = dict[str, list[str]]()
    for one in features:
        for key, name in one.names.items():
            said.setdefault(key, []).append(region_key(name))

    def worth(key: str) -> tuple[int, bool, int]:
        met = set(said[key])
        return len(met.intersection(asked)), CALLED.fullmatch(key) is not None, len(met)

    best = max(said, key=worth, default="")
    return best if asked or not best or CALLED.fullmatch(best) else ""


def _listed(text: str) -> list[Any] | None:
    """Features of GeoJSON; a feature or a geometry by itself is the only one (RFC 7946, 2)."""
    said = parsed(text)
    if not isinstance(said, dict):
        return None
    if said.get("type") == "Feature":
        return [said]
    listed = said.get("features")
    if isinstance(listed, list):
        return listed
    return [{"geometry": said}] if "coordinates" in said or "geometries" in said else None


@lru_cache(maxsize=1)
def _features(text: str, *, is_plane: bool = False) -> tuple[Feature, ...]:
    """Features with an area, of the last map once more; others are left out."""
    listed = _listed(text)
    if listed is None:
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
    rings = [ring for _, polygons in found for each in polygons for ring in each]
    most = np.abs(np.concatenate(rings)).max(axis=0)
    is_globe = not is_plane and bool((most <= (360.0 + OFF, 90.0 + OFF)).all())
    allowance, shapes = Allowance(MAX_CROSSINGS), list[Region]()
    for names, polygons in found:
        allowance.spend([ring for each in polygons for ring in each])
        try:
            shapes.append(union([_polygon(each, is_globe=is_globe) for each in polygons]))
        except (GEOSException, ValueError, ShapeError):
            name = next(iter(names.values()), "a feature")
            raise UnfitError(f"{name[:40]} is no region") from None
    Allowance(MAX_UNION_CROSSINGS).spend(rings)
    regions = _on_plane(shapes, is_globe=is_globe)
    return tuple(
        Feature(names, region)
        for (names, _), region in zip(found, regions, strict=True)
        if region.area > 0
    )


def _polygon(rings: list[FloatArray], *, is_globe: bool) -> Region:
    """Area within the first ring without that of the others.

    Longitudes go on over the 180th meridian, where a file jumps to the other end of them.
    """
    if is_globe:
        rings = [np.column_stack([_unwrapped(ring[:, 0]), ring[:, 1]]) for ring in rings]
        middle = rings[0][:, 0].mean()
        rings = [ring - (360 * np.round((ring[:, 0].mean() - middle) / 360), 0) for ring in rings]
    return valid(shapely.Polygon(rings[0], rings[1:]))


def _unwrapped(longitudes: FloatArray) -> FloatArray:
    """The same without jumps of more than half round the earth, but for those all round it."""
    jumps = np.diff(longitudes)
    is_wide = (np.abs(jumps) > 180) & (np.abs(jumps) < 360 - OFF)
    turns = np.cumsum(np.where(is_wide, np.sign(jumps), 0))
    return np.asarray(longitudes - 360 * np.concatenate([[0], turns]))


def _on_plane(shapes: list[Region], *, is_globe: bool) -> list[Region]:
    """Regions of a file on a plane, y down: projected, or flipped as they are."""
    if not is_globe:
        return [shapely.transform(one, lambda points: points * (1.0, -1.0)) for one in shapes]
    step = max(STEP, sum(one.length for one in shapes) / MAX_POINTS)
    fine = [shapely.segmentize(one, step) for one in shapes]
    project = _projection(shapely.get_coordinates(fine))
    if project is _equal_earth:
        fine = [shapely.segmentize(_on_one_sheet(one), step) for one in fine]
    return [valid(shapely.transform(one, project)) for one in fine]


def _on_one_sheet(shape: Region) -> Region:
    """A region cut at the 180th meridian, what lies beyond on the other side."""
    left, _, right, _ = shape.bounds
    if left >= -180 and right <= 180:
        return shape
    parts = []
    for turn in range(-2, 3):
        cut = intersection(shape, shapely.box(360 * turn - 180, -91, 360 * turn + 180, 91))
        parts += [
            shapely.transform(p, lambda c, t=turn: c - (360 * t, 0)) for p in polygon_parts(cut)
        ]
    return union(parts)


def _polygons(feature: Any, where: str) -> list[list[FloatArray]]:
    """Rings of the polygons of a feature, each ``(n, 2)``; none of other geometries."""
    geometry = feature.get("geometry") if isinstance(feature, dict) else None
    kind = geometry.get("type") if isinstance(geometry, dict) else None
    if not isinstance(geometry, dict):
        return []
    if kind == "GeometryCollection" and isinstance(parts := geometry.get("geometries"), list):
        # Collections of collections are not to be used (RFC 7946, 3.1.8).
        plain = [one for one in parts if isinstance(one, dict) and "geometries" not in one]
        return [rings for one in plain for rings in _polygons({"geometry": one}, where)]
    if kind not in ("Polygon", "MultiPolygon"):
        return []
    said: Any = geometry.get("coordinates")
    try:
        polygons = [said] if kind == "Polygon" else list(said)
        rings = [
            [np.array([point[:2] for point in ring], dtype=np.float64) for ring in each]
            for each in polygons
        ]
        flat = [ring for each in rings for ring in each]
        # Texts and booleans would be read as numbers.
        kinds = {type(k) for each in polygons for ring in each for point in ring for k in point[:2]}
        is_sound = kinds <= {int, float} and all(
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
    whole = {k: int(v) for k, v in named.items() if type(v) is float and v.is_integer()}
    plain = {k: v for k, v in (named | whole).items() if type(v) in {str, int}}
    texts = {key: " ".join(str(value)[:MAX_LENGTH].split()) for key, value in plain.items()}
    return {key: text for key, text in texts.items() if text}


def _projection(points: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Function from ``(n, 2)`` degrees to places on a plane, y down."""
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
        k = np.sqrt(2 / np.maximum(1 + cosine, 1e-12))
        north = np.cos(lat) * np.sin(up) - np.sin(lat) * np.cos(up) * np.cos(along)
        return np.column_stack([k * np.cos(up) * np.sin(along), -k * north])

    return lambert


def _equal_earth(ring: FloatArray) -> FloatArray:
    a1, a2, a3, a4 = _EQUAL_EARTH
    up = np.clip(ring[:, 1], -90.0, 90.0)
    t = np.arcsin(np.sqrt(3) / 2 * np.sin(np.radians(up)))
    slope = 9 * a4 * t**8 + 7 * a3 * t**6 + 3 * a2 * t**2 + a1
    x = 2 * np.sqrt(3) * np.radians(ring[:, 0]) * np.cos(t) / (3 * slope)
    return np.column_stack([x, -(a4 * t**9 + a3 * t**7 + a2 * t**3 + a1 * t)])

"""Layouts as GeoJSON: true outlines in place, for any geometry tool to check.

Canvas units (``canvas.unit`` says what one is), y down: outer rings run clockwise on
screen, which is the right-hand rule of RFC 7946 in numbers.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from itertools import chain
from pathlib import PurePath
from typing import Any

import numpy as np
import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, polygon_parts, valid
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.notation import decimals
from packwork.scene.swatch import representative_colour
from packwork.writers.promise import finest

PRECISION = 1e-9
"""Last digit of a coordinate, as a share of the canvas's longer side: what is measured
from the file is what was measured before. Larger: shorter files that say less. Chosen."""


def geojson_text(layout: Layout) -> str:
    """GeoJSON FeatureCollection: the container, then one feature per item.

    Coordinates are rounded to ``PRECISION``, but for outlines that would then cross themselves;
    ``x``, ``y``, ``angle`` (degrees clockwise, -180 to 180), ``scale`` and ``stretch`` are written
    in full. Numbers that JSON has no word for (NaN, infinity) become null in the manifest.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> json.loads(geojson_text(blank()))["features"][0]["geometry"]["coordinates"]
    [[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]]]
    """
    container = layout.container
    digits = decimals(container.side * finest(layout, PRECISION))
    collection = {
        "type": "FeatureCollection",
        "canvas": container.canvas,
        "items": len(layout.items),
        "manifest": plain(untimed(layout.manifest)),
    }
    features = chain([_container_feature(layout, digits)], _item_features(layout, digits))
    # One feature a line: a file that people can page through and compare.
    lines = ",\n".join(_json(feature) for feature in features)
    return f'{_json(collection)[:-1]},"features":[\n{lines}\n]}}\n'


def untimed(manifest: Mapping[str, Any]) -> dict[str, Any]:
    """Manifest without its seconds, so that equal runs give equal files."""
    kept = {key: value for key, value in manifest.items() if key != "seconds"}
    levels = kept.get("levels")
    if isinstance(levels, list | tuple):
        kept["levels"] = [
            {key: value for key, value in level.items() if key != "seconds"}
            if isinstance(level, Mapping)
            else level
            for level in levels
        ]
    return kept


def plain(value: Any) -> Any:
    """Value that JSON can hold, whatever a manifest collected.

    A run that took minutes shall not be lost to an odd entry: what has no JSON form is
    written as its text.

    Examples
    --------
    >>> plain({"seconds": np.float64(0.5), "gap": float("inf"), "sizes": (1, 2)})
    {'seconds': 0.5, 'gap': None, 'sizes': [1, 2]}
    """
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, Iterable) and not isinstance(value, bytes | PurePath):
        return [plain(v) for v in value]
    return str(value)


def json_bytes(values: Mapping[str, Any]) -> bytes:
    """Indented JSON of plain values, as ``--report`` writes them."""
    return (json.dumps(plain(values), indent=2, allow_nan=False) + "\n").encode()


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"), allow_nan=False)


def _container_feature(layout: Layout, digits: int) -> dict[str, Any]:
    container = layout.container
    properties: dict[str, Any] = {"role": "container"}
    properties |= {"name": container.name, "source": container.source}
    if container.walls is not None:
        # Seen are the walls; the outline is what items lie in, and is measured.
        properties["walls"] = [np.round(line, digits).tolist() for line in container.walls]
    if container.pen is not None:
        properties["pen"] = list(container.pen)
    if container.lattice is not None:
        properties["tile"] = container.lattice.kind
    return _feature(properties, container.outline, digits)


def _item_features(layout: Layout, digits: int) -> Iterable[dict[str, Any]]:
    # By identity: copies share an art, and a picture's colour is worth one look only.
    first = {item.art: item for item in reversed(layout.items)}
    fills = {key: representative_colour(item) for key, item in first.items()}
    for k, (item, outline) in enumerate(zip(layout.items, layout.outlines, strict=True)):
        properties = _item_properties(layout, k, item) | {"fill": fills[item.art]}
        yield _feature(properties, outline, digits)


def _item_properties(layout: Layout, k: int, item: Item) -> dict[str, Any]:
    poses = layout.poses
    return {
        "role": "item",
        "item": item.name,
        "source": item.source,
        "x": float(poses.x[k]),
        "y": float(poses.y[k]),
        "angle": math.remainder(math.degrees(poses.angle[k]), 360.0),
        "scale": float(poses.scale[k]),
        "stretch": float(poses.stretch[k]),
        "weight": float(layout.weights[k]),
        # Those that are empty are left out.
        **{key: text for key, text in asdict(item.label).items() if text},
        **_stands_for(item),
    }


def _stands_for(item: Item) -> dict[str, Any]:
    """Properties of a mark of a chart; nothing for other items."""
    if item.datum is None:
        return {}
    said = {key: value for key, value in asdict(item.datum).items() if value != ""}
    return {"datum": plain(said)}


def _feature(properties: dict[str, Any], outline: Outline, digits: int) -> dict[str, Any]:
    return {
        "type": "Feature",
        "properties": properties,
        "geometry": _geometry(outline.region, digits),
    }


def _geometry(region: Region, digits: int) -> dict[str, Any]:
    rounded = shapely.transform(region, lambda points: np.round(points, digits))
    # Rings that all but touch may cross once they are rounded: then all digits are needed.
    kept = rounded if rounded.is_valid else valid(region)
    polygons = [_rings(p) for p in polygon_parts(kept)]
    if len(polygons) == 1:
        return {"type": "Polygon", "coordinates": polygons[0]}
    return {"type": "MultiPolygon", "coordinates": polygons}


def _rings(polygon: Region) -> list[Any]:
    oriented = shapely.geometry.polygon.orient(polygon, 1.0)
    return [
        shapely.get_coordinates(ring).tolist() for ring in (oriented.exterior, *oriented.interiors)
    ]

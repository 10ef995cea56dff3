"""Draws the bundled outlines of countries from public-domain maps.

Run once, by hand, when a country is added; installing the package does not need it::

    npm pack world-atlas@2 us-atlas@3
    python tools/make_countries.py countries-10m.json nation-10m.json

where the two files come from the packed archives.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.geometry import Polygon

FOLDER = Path(__file__).parents[1] / "src" / "packwork" / "bundled" / "containers"

SIDE = 600.0
"""Longer side of the canvas."""

MARGIN = 8.0
"""Free edge of the canvas."""

DETAIL = 1e-3
"""Largest distance of the outline from the map's, as a share of its extent."""

SMALLEST_ISLAND = 1e-3
"""Share of the country's area below which an island is left out: no item would fit."""


@dataclass(frozen=True)
class Country:
    """What is drawn, from where, and how the round earth is laid flat."""

    stem: str
    title: str
    fill: str
    source: str
    map_object: str
    name: str
    window: tuple[float, float, float, float]
    parallels: tuple[float, float]
    middle: tuple[float, float]


AUSTRALIA = Country(
    stem="australia",
    title="Australia",
    fill="#ee6c4d",
    source="Natural Earth 1:10m, by way of the npm package world-atlas 2.0.2",
    map_object="countries",
    name="Australia",
    window=(112.0, -44.0, 155.0, -9.0),
    parallels=(-18.0, -36.0),
    middle=(134.0, -26.0),
)

USA = Country(
    stem="usa",
    title="USA",
    fill="#22304f",
    source="US Census Bureau, cartographic boundaries 2017, by way of the npm package "
    "us-atlas 3.0.1",
    map_object="nation",
    name="United States",
    window=(-125.0, 24.0, -66.0, 50.0),
    parallels=(29.5, 45.5),
    middle=(-96.0, 37.5),
)


def main(world: str, nation: str) -> None:
    """Write one container per country."""
    for country, path in ((AUSTRALIA, world), (USA, nation)):
        topology = json.loads(Path(path).read_text(encoding="utf-8"))
        (FOLDER / f"{country.stem}.svg").write_text(drawing(country, topology), encoding="utf-8")


def drawing(country: Country, topology: dict[str, Any]) -> str:
    """SVG of a country's main land, as one path that fills its canvas."""
    land = shapely.union_all([albers(part, country) for part in parts_within(country, topology)])
    left, top, right, bottom = land.bounds
    extent = max(right - left, bottom - top)
    land = shapely.simplify(land, DETAIL * extent)
    kept = [p for p in shapely.get_parts(land) if p.area > SMALLEST_ISLAND * land.area]
    left, top, right, bottom = shapely.union_all(kept).bounds
    scale = (SIDE - 2 * MARGIN) / max(right - left, bottom - top)
    width, height = (round(side * scale + 2 * MARGIN, 1) for side in (right - left, bottom - top))
    rings = [ring for part in kept for ring in (part.exterior, *part.interiors)]
    data = [
        path_data((shapely.get_coordinates(ring)[:-1] - (left, top)) * scale + MARGIN)
        for ring in rings
    ]
    lines = "\n    ".join(line for ring in data for line in wrapped(ring))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}">\n'
        f"  <!-- {country.source}; public domain -->\n"
        f"  <title>{country.title}</title>\n"
        f'  <path fill="{country.fill}" d="\n    {lines}"/>\n'
        "</svg>\n"
    )


def parts_within(country: Country, topology: dict[str, Any]) -> list[Polygon]:
    """Polygons of the country in degrees, those that lie in its window."""
    arcs = [decoded(arc, topology["transform"]) for arc in topology["arcs"]]
    shapes = topology["objects"][country.map_object]["geometries"]
    (shape,) = (s for s in shapes if s["properties"]["name"] == country.name)
    polygons = [
        Polygon(ring_of(rings[0], arcs), [ring_of(hole, arcs) for hole in rings[1:]])
        for rings in shape["arcs"]
    ]
    window = shapely.box(*country.window)
    return [polygon for polygon in polygons if window.contains(polygon)]


def decoded(arc: list[list[int]], transform: dict[str, list[float]]) -> np.ndarray:
    """Longitudes and latitudes of an arc that holds steps on a grid."""
    steps = accumulate(arc, lambda a, b: [a[0] + b[0], a[1] + b[1]])
    return np.array(list(steps)) * transform["scale"] + transform["translate"]


def ring_of(numbers: list[int], arcs: list[np.ndarray]) -> np.ndarray:
    """Ring of arcs joined end to end; ``~k`` is arc ``k`` backwards."""
    runs = [arcs[k] if k >= 0 else arcs[~k][::-1] for k in numbers]
    return np.concatenate([runs[0], *(run[1:] for run in runs[1:])])


def albers(part: Polygon, country: Country) -> Polygon:
    """Equal-area conic projection on a unit sphere, y down (Snyder 1987, section 14)."""
    first, second = np.radians(country.parallels)
    longitude, latitude = np.radians(country.middle)
    n = (np.sin(first) + np.sin(second)) / 2
    c = np.cos(first) ** 2 + 2 * n * np.sin(first)
    rho_0 = np.sqrt(c - 2 * n * np.sin(latitude)) / n

    def flat(degrees: np.ndarray) -> np.ndarray:
        theta = n * (np.radians(degrees[:, 0]) - longitude)
        rho = np.sqrt(c - 2 * n * np.sin(np.radians(degrees[:, 1]))) / n
        return np.column_stack([rho * np.sin(theta), rho * np.cos(theta) - rho_0])

    return shapely.make_valid(shapely.transform(part, flat))


def path_data(points: np.ndarray) -> str:
    """Straight path through points, to a tenth of a unit."""
    x, y = ([f"{v:.1f}".removesuffix(".0") for v in column] for column in points.T)
    first, *others = (f"{a} {b}" for a, b in zip(x, y, strict=True))
    return f"M{first} L{' '.join(others)} Z"


def wrapped(text: str, most: int = 96) -> list[str]:
    """Words in lines of at most ``most`` characters."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > most:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


if __name__ == "__main__":
    main(*sys.argv[1:])

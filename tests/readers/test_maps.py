"""Maps in GeoJSON: areas true to those on the globe, names of any property, hostile files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from packwork.errors import ReadError
from packwork.readers.container import part_names, read_container, read_parts
from packwork.readers.maps import MOST_REGIONS, is_map

NAMED = ({"name": "Peru", "iso": "PE"}, {"name": "Chile", "iso": "CL"})


def square(west: float, south: float, side: float, steps: int = 20) -> list[list[float]]:
    """Ring of a square of degrees, its sides in steps, so that they are curves of a projection."""
    corners = [(west, south), (west + side, south), (west + side, south + side),
               (west, south + side), (west, south)]  # fmt: skip
    ends = pairwise(corners)
    ring = [np.linspace(a, b, steps, endpoint=False) for a, b in ends]
    return np.vstack([*ring, [corners[0]]]).tolist()


def written(
    folder: Path, *rings: list[list[float]], named: tuple[Mapping[str, Any], ...] = NAMED
) -> Path:
    file = folder / "land.geojson"
    features = [
        {
            "type": "Feature",
            "properties": of,
            "geometry": {"type": "Polygon", "coordinates": [ring]},
        }
        for ring, of in zip(rings, named, strict=True)
    ]
    file.write_text(
        json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8"
    )
    return file


@pytest.mark.parametrize(("west", "apart"), [(5.0, 8.0), (170.0, 12.0), (-150.0, 200.0)])
def test_areas_are_in_the_proportion_of_those_on_the_globe(
    tmp_path: Path, west: float, apart: float
) -> None:
    """Near each other, over the 180th meridian, and on both sides of the earth."""
    file = written(tmp_path, square(west, 10, 8), square(west + apart, 50, 8))
    areas = {name: region.area for name, region in read_parts(read_container(file))}
    # Of a square of degrees: the difference of the sines of its latitudes.
    south, north = (np.ptp(np.sin(np.radians([low, low + 8]))) for low in (10, 50))
    assert areas["Peru"] / areas["Chile"] == pytest.approx(south / north, rel=2e-3)


def test_edges_of_two_points_are_as_long_as_many_short_ones(tmp_path: Path) -> None:
    """A border along a parallel is curved on the plane; neighbours meet there."""
    sparse, dense = (
        read_parts(
            read_container(written(tmp_path, square(-120, 20, 30, n), square(-120, 50, 20, n)))
        )
        for n in (1, 30)
    )
    for (_, one), (_, other) in zip(sparse, dense, strict=True):
        assert one.area == pytest.approx(other.area, rel=1e-3)


def test_a_ring_round_a_pole_has_no_hole_there(tmp_path: Path) -> None:
    ring = [[-180, -90], [-180, -65], [-90, -70], [0, -68], [90, -66], [180, -65], [180, -90],
            [-180, -90]]  # fmt: skip
    ((_, region),) = read_parts(read_container(written(tmp_path, ring, named=NAMED[:1])))
    assert (region.geom_type, len(region.interiors)) == ("Polygon", 0)


def test_a_region_over_the_180th_meridian_is_no_band_round_the_earth(tmp_path: Path) -> None:
    fiji = [[175, -20], [-175, -20], [-175, -10], [175, -10], [175, -20]]
    file = written(tmp_path, fiji, square(0, -20, 10), square(-100, 0, 60), named=(*NAMED, {}))
    areas = {name: region.area for name, region in read_parts(read_container(file))}
    assert areas["Peru"] == pytest.approx(areas["Chile"], rel=1e-3)


def test_rounding_off_the_globe_leaves_degrees_what_they_are(tmp_path: Path) -> None:
    rings = square(0, -90, 20), square(0, 0, 20)
    sound = read_container(written(tmp_path, *rings)).outline
    rings[0][0][1] = -90.0000001
    assert read_container(written(tmp_path, *rings)).outline.area == pytest.approx(sound.area)


def test_regions_that_overlap_are_taken_from_the_larger(tmp_path: Path) -> None:
    """An enclave is often drawn over its land, which has no hole for it."""
    file = written(tmp_path, square(0, 0, 10), square(4, 4, 2))
    (_, land), (_, enclave) = read_parts(read_container(file))
    assert enclave.area > 0
    assert land.intersection(enclave).area == pytest.approx(0, abs=1e-6)
    with pytest.raises(ReadError, match="lies all within other regions"):
        read_parts(read_container(written(tmp_path, *[square(0, 0, 9)] * 2)), asked=["chile"])


@pytest.mark.parametrize(
    ("first", "second", "asked"),
    [("Peru", "PERU", ["peru"]), ("01", "1", ["1"]), (7.0, 7, ["7"]), ("\u00f6", "o\u0308", ["ö"])],
)
def test_names_that_mean_one_region_are_one(
    tmp_path: Path, first: object, second: object, asked: list[str]
) -> None:
    named = ({"name": first}, {"name": second})
    file = written(tmp_path, square(0, 0, 5), square(5, 0, 5), named=named)
    container = read_container(file)
    ((_, region),) = read_parts(container, asked=asked)
    assert region.area == pytest.approx(container.outline.area)


def test_polygons_of_a_collection_are_a_region(tmp_path: Path) -> None:
    shape = {"type": "Polygon", "coordinates": [square(0, 0, 5)]}
    geometry = {"type": "GeometryCollection", "geometries": [shape, {"type": ["Point"]}, 3]}
    one = {"type": "Feature", "properties": {"name": "Peru"}, "geometry": geometry}
    file = tmp_path / "land.geojson"
    file.write_text(json.dumps({"type": "FeatureCollection", "features": [one]}), encoding="utf-8")
    assert [name for name, _ in read_parts(read_container(file))] == ["Peru"]
    area = read_container(file).outline.area
    for alone in (one, geometry, shape):
        file.write_text(json.dumps(alone), encoding="utf-8")
        assert is_map(file)
        assert read_container(file).outline.area == pytest.approx(area)
    file.write_text(json.dumps(one), encoding="utf-8")
    assert [name for name, _ in read_parts(read_container(file), asked=["PERU"])] == ["Peru"]


def test_a_feature_that_crosses_itself_without_end_is_refused(tmp_path: Path) -> None:
    tangle = np.random.default_rng(0).uniform(0, 9, (500, 2)).tolist()
    with pytest.raises(ReadError, match="crosses itself"):
        read_container(written(tmp_path, [*tangle, tangle[0]], named=NAMED[:1]))


def test_north_is_up_and_a_survey_in_metres_keeps_its_shape(tmp_path: Path) -> None:
    ring = [[500e3, 0.0], [900e3, 0.0], [900e3, 300e3], [500e3, 0.0]]
    container = read_container(written(tmp_path, ring, named=NAMED[:1]))
    assert (container.width, container.height) == pytest.approx((600, 450))
    assert container.outline.region.contains_properly(
        container.outline.region.representative_point()
    )
    # The corner in the north-east is at the top right.
    assert [600.0, 0.0] in container.outline.points.round(6).tolist()


@pytest.mark.parametrize("asked", [["peru", "chile"], ["PE", "CL"], []])
def test_parts_are_called_by_the_property_that_has_the_names(
    tmp_path: Path, asked: list[str]
) -> None:
    container = read_container(written(tmp_path, square(0, 0, 5), square(5, 0, 5)))
    parts = read_parts(container, asked=asked)
    assert [name.casefold() for name, _ in parts] == [
        name.casefold() for name in asked or ["Peru", "Chile"]
    ]
    assert sum(region.area for _, region in parts) == pytest.approx(container.outline.area)


def test_features_that_are_called_alike_are_one_part(tmp_path: Path) -> None:
    named = ({"name": "Peru", "on": "America"}, {"name": "Chile", "on": "America"})
    file = written(tmp_path, square(0, 0, 5), square(5, 0, 5), named=named)
    ((name, region),) = read_parts(read_container(file), asked=["america"])
    assert (name, region.geom_type) == ("America", "Polygon")
    assert {"peru", "chile"} in part_names(read_container(file))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("[1, 2]", "is no GeoJSON FeatureCollection"),
        ('{"features": []}', "holds no regions"),
        ('{"features": [7, null, {"geometry": 3}]}', "holds no regions"),
        ('{"features": [{"geometry": {"type": "Polygon", "coordinates": 3}}]}', "rings of four"),
        ('{"features": [{"geometry": {"type": ["Polygon"]}}]}', "holds no regions"),
        ('{"features": [{"geometry": {"type": "Polygon", "coordinates": [[[0]]]}}]}', "rings of"),
        ('{"features": [{"geometry": {"type": "Polygon", "coordinates": [[[0, "x"]]]}}]}', "rings"),
        ('{"type": "Polygon", "coordinates": [[[0,0],[1,0],["1",1],[0,0]]]}', "rings of four"),
        ('{"type": "Polygon", "coordinates": [[[0,0],[1,0],[1,true],[0,0]]]}', "rings of four"),
        ('{"type": "Point", "coordinates": [0,0]}', "holds no regions"),
        (json.dumps({"features": [0] * (MOST_REGIONS + 1)}), "more than 2,000"),
        ("{", "is not JSON"),
    ],
)
def test_what_is_no_map_is_refused_in_one_line(tmp_path: Path, text: str, why: str) -> None:
    file = tmp_path / "bad.geojson"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ReadError, match=why) as refused:
        read_container(file)
    assert "\n" not in str(refused.value)


def test_members_of_no_meaning_hide_no_features(tmp_path: Path) -> None:
    file = written(tmp_path, square(0, 10, 8), square(20, 10, 8))
    said = json.loads(file.read_text(encoding="utf-8"))
    file.write_text(json.dumps({"geometries": [], **said}), encoding="utf-8")
    assert len(read_parts(read_container(file))) == 2


@pytest.mark.parametrize("spoilt", [b"", b"garbage", b'{"features": 3}', b"[" * 200_000])
def test_a_spoilt_map_in_a_session_is_refused_in_one_line(tmp_path: Path, spoilt: bytes) -> None:
    made = read_container(written(tmp_path, square(0, 10, 8), square(20, 10, 8)))
    with pytest.raises(ReadError, match=r"land\.geojson: "):
        part_names(replace(made, file=spoilt))


def test_a_layout_of_ours_is_no_map(tmp_path: Path) -> None:
    ours = tmp_path / "layout.geojson"
    ours.write_text(
        '{"type": "FeatureCollection", "features": [{"role" : "container"}]}', encoding="utf-8"
    )
    assert not is_map(ours)
    assert is_map(written(tmp_path, square(0, 0, 5), named=NAMED[:1]))

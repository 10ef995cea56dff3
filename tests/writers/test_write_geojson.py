from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from shapely.geometry import shape

from packwork.geometry.outline import Outline
from packwork.geometry.polygon import signed_area
from packwork.scene.colour import css_colour
from packwork.scene.item import Art, FlatArt, Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.swatch import NEUTRAL, representative_colour
from packwork.writers.geojson import PRECISION, geojson_text, plain


def parsed(layout: Layout) -> dict[str, Any]:
    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    return dict(json.loads(geojson_text(layout), parse_constant=refuse))


def test_members(three: Layout) -> None:
    found = parsed(three)
    assert found["type"] == "FeatureCollection"
    assert found["canvas"] == {"width": 80.0, "height": 60.0, "unit": "px"}
    assert found["manifest"] == {"seed": 7}
    roles = [f["properties"]["role"] for f in found["features"]]
    assert roles == ["container", "item", "item", "item"]


def test_properties_say_where_an_item_is(three: Layout) -> None:
    properties = parsed(three)["features"][1]["properties"]
    assert properties == {
        "role": "item",
        "item": "ring",
        "source": "ring.svg",
        "x": 15.0,
        "y": 20.0,
        "angle": math.degrees(0.3),
        "scale": 0.9,
        "stretch": 1.0,
        "weight": 1.0,
        "fill": "#008080",
    }


def test_turns_are_brought_home(three: Layout) -> None:
    layout = replace(three, poses=replace(three.poses, angle=np.array([7.0, -7.0, 0.0])))
    angles = [f["properties"]["angle"] for f in parsed(layout)["features"][1:]]
    assert np.allclose(angles, [math.degrees(7) - 360, 360 - math.degrees(7), 0])


def test_a_stretch_is_in_the_properties_and_in_the_outline(three: Layout) -> None:
    upright = replace(three.poses, angle=np.zeros(3), stretch=np.array([4.0, 1.0, 0.25]))
    ring = parsed(replace(three, poses=upright))["features"][1]
    assert ring["properties"]["stretch"] == 4.0
    left, top, right, bottom = shape(ring["geometry"]).bounds
    assert (right - left, bottom - top) == pytest.approx((36.0, 9.0))


def test_areas_come_back(three: Layout) -> None:
    features = parsed(three)["features"]
    container, *items = (shape(f["geometry"]) for f in features)
    assert all(s.is_valid for s in (container, *items))
    assert container.area == pytest.approx(76 * 56, rel=1e-9)
    assert [s.area for s in items] == pytest.approx(three.areas.tolist(), rel=1e-9)


def test_points_come_back(crowd: Layout) -> None:
    side = crowd.container.side
    pairs = list(zip(parsed(crowd)["features"][1:], crowd.outlines, strict=True))
    for feature, outline in pairs[::50]:
        got = shape(feature["geometry"])
        assert shapely.hausdorff_distance(got, outline.region) <= PRECISION * side


def test_holes_and_parts(make_layout: Callable[..., Layout], ring_item: Item) -> None:
    parts = Outline.from_region(
        (shapely.box(-9, -9, 9, 9) - shapely.box(-6, -6, 6, 6)) | shapely.box(-2, -2, 2, 2)
    )
    geometry = parsed(make_layout([replace(ring_item, outline=parts)]))["features"][1]["geometry"]
    assert geometry["type"] == "MultiPolygon"
    assert sorted(len(p) for p in geometry["coordinates"]) == [1, 2]
    for outer, *holes in geometry["coordinates"]:
        assert signed_area(np.array(outer[:-1])) > 0
        assert all(signed_area(np.array(hole[:-1])) < 0 for hole in holes)
        assert all(ring[0] == ring[-1] for ring in (outer, *holes))


def test_rings_that_all_but_touch_stay_apart(
    make_layout: Callable[..., Layout], ring_item: Item
) -> None:
    """Rounding would make them meet along an edge, and readers refuse the outline."""
    hair = 1e-9
    holed = shapely.difference(shapely.box(-9, -9, 9, 9), shapely.box(-9 + hair, -3, 3, 3))
    item = replace(ring_item, outline=Outline.from_region(holed))
    geometry = parsed(make_layout([item]))["features"][1]["geometry"]
    assert shape(geometry).is_valid
    assert shape(geometry).area == pytest.approx(holed.area)


def test_no_items(make_layout: Callable[..., Layout]) -> None:
    assert len(parsed(make_layout([]))["features"]) == 1


@pytest.mark.parametrize(
    "name", ["<script>", "R&D", 'a"b\\', "nul\0bell\x07", "\ud800", "🦊 fox", "n" * 5000]
)
def test_hostile_names_come_back(three: Layout, name: str) -> None:
    layout = replace(three, items=tuple(replace(i, name=name, source=name) for i in three.items))
    text = geojson_text(layout)
    assert json.loads(text.encode())["features"][1]["properties"]["item"] == name


def test_odd_manifests_are_written(make_layout: Callable[..., Layout]) -> None:
    layout = make_layout(
        [],
        gap=float("inf"),
        lost=np.float64("nan"),
        counts=np.arange(2),
        where=Path("a") / "b",
        nested={1: (np.int64(3), None, True)},
        raw=b"x",
    )
    assert parsed(layout)["manifest"] == {
        "gap": None,
        "lost": None,
        "counts": [0, 1],
        "where": str(Path("a") / "b"),
        "nested": {"1": [3, None, True]},
        "raw": "b'x'",
    }


def test_plain_leaves_json_as_it_is() -> None:
    value = {"a": [1, 2.5, "x", None, False], "b": {"c": []}}
    assert plain(value) == value


def coloured(art: Art) -> str:
    ink = Outline.from_region(shapely.box(0, 0, 10, 10))
    return representative_colour(Item("a", "a", ink, ink, art))


class TestColour:
    def test_of_ink(self) -> None:
        assert coloured(FlatArt("rgb(1, 2, 3)")) == "#010203"
        assert coloured(FlatArt("none")) == NEUTRAL
        assert coloured(FlatArt("currentColor")) == NEUTRAL

    @pytest.mark.parametrize(
        ("markup", "colour"),
        [
            ('<path d="M0 0h10v10" fill="#0a64c8"/>', "#0a64c8"),
            ('<path d="M0 0h10v10" stroke="none"/>', "#000000"),
            ('<g fill="red"><path d="M0 0h10v10H0z"/><path d="M2 2h6v6z" fill="#fff"/></g>', None),
            ('<path d="M0 0h10v10" fill="white"/>', "#ffffff"),
            (
                '<g fill="none" style="fill:#123"/><text fill="red">a<tspan fill="red"/></text>',
                "#ff0000",
            ),
            ("<path/>", NEUTRAL),
            ("<broken", NEUTRAL),
        ],
    )
    def test_of_a_drawing(self, markup: str, colour: str | None) -> None:
        found = coloured(VectorArt(markup, np.eye(2, 3)))
        if colour is not None:
            assert found == colour
        else:  # soft edges are paler
            assert found[:2] == "#f"
            assert int(found[3:5], 16) < 40

    def test_of_a_gradient(self, star_item: Item) -> None:
        found = css_colour(representative_colour(star_item))[:3]
        assert found[0] >= 0xD6
        assert 0x27 < found[1] < 0xBF

    def test_of_a_gradient_that_begins_in_white(self) -> None:
        stops = '<stop offset="0" stop-color="#fff"/><stop offset="1" stop-color="#05f"/>'
        markup = f'<radialGradient id="r">{stops}</radialGradient>'
        markup += '<circle cx="5" cy="5" r="5" fill="url(#r)"/>'
        found = coloured(VectorArt(markup, np.eye(2, 3)))
        assert int(found[1:3], 16) < 0xA0
        assert found.endswith("ff")

    def test_of_a_picture(self, photo_item: Item) -> None:
        assert representative_colour(photo_item) == "#433549"

    @pytest.mark.parametrize("png", [b"", b"\x89PNG\r\n\x1a\n1234", b"GIF89a"])
    def test_of_a_broken_picture(self, png: bytes) -> None:
        assert coloured(PictureArt(png, 1, 1, np.eye(2, 3))) == NEUTRAL

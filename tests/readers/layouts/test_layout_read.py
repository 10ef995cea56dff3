"""Saved layouts, as written and as hand-edited into nonsense."""

from __future__ import annotations

import copy
import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.readers import json_text
from packwork.readers.builtin import builtin_container, builtin_item
from packwork.readers.layouts.geojson import read_layout
from packwork.scene.container import on_canvas
from packwork.scene.item import FlatArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.units import canvas_size
from packwork.writers.geojson import geojson_text

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]
ITEM = {
    "type": "Feature",
    "properties": {
        "role": "item",
        "item": "tile",
        "source": "tile.svg",
        "x": 5,
        "y": 5,
        "angle": 90,
        "scale": 2,
        "stretch": 4,
        "weight": 3,
        "fill": "#123456",
    },
    "geometry": {"type": "Polygon", "coordinates": [SQUARE]},
}
CONTAINER = {
    "type": "Feature",
    "properties": {"role": "container", "name": "box", "source": "box.svg"},
    "geometry": {"type": "MultiPolygon", "coordinates": [[SQUARE]]},
}
LAYOUT = {
    "type": "FeatureCollection",
    "canvas": {"width": 20, "height": 10},
    "manifest": {"seed": 7},
    "features": [CONTAINER, ITEM],
}


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    path = tmp_path_factory.mktemp("layouts") / "a.geojson"

    def read(content: object) -> Layout:
        path.write_text(
            content if isinstance(content, str) else json.dumps(content), encoding="utf-8"
        )
        return read_layout(path)

    return read


def edited(place: tuple[object, ...], value: object) -> dict:
    layout = copy.deepcopy(LAYOUT)
    target = layout
    for key in place[:-1]:
        target = target[key]
    target[place[-1]] = value
    return layout


def test_members(saved):
    layout = saved(LAYOUT)
    item = layout.items[0]
    assert (layout.container.name, layout.container.width, layout.container.height) == (
        "box",
        20,
        10,
    )
    assert (item.name, item.source, item.art) == ("tile", "tile.svg", FlatArt("#123456"))
    assert (layout.poses.x[0], layout.poses.angle[0], layout.poses.scale[0]) == (5, np.pi / 2, 2)
    assert layout.poses.stretch.tolist() == [4]
    assert (layout.weights.tolist(), layout.manifest) == ([3.0], {"seed": 7})
    assert item.outline.bounds == pytest.approx((-1.25, -5, 1.25, 5))
    assert layout.outlines[0].bounds == pytest.approx((0, 0, 10, 10))


def test_round_trip(saved):
    items = tuple(builtin_item(name, "keep") for name in ("ring", "heart", "stripe:3"))
    places = [[90.0, 300, 400], [80, 200, 500], [0.3, -2.0, 3.0]]
    poses = Poses(*np.array([*places, [0.9, 0.5, 1.5], [1.0, 1.5, 0.4]]))
    layout = Layout(builtin_container("heart"), items, poses, np.array([1.0, 2.0, 3.0]), {"a": [1]})
    again = saved(geojson_text(layout))
    assert again.manifest == {"a": [1]}
    assert again.weights.tolist() == [1.0, 2.0, 3.0]
    assert again.poses.angle == pytest.approx(layout.poses.angle)
    assert again.poses.stretch.tolist() == [1.0, 1.5, 0.4]
    assert [item.outline.bounds for item in again.items] == [
        pytest.approx(item.outline.bounds, abs=1e-6) for item in items
    ]
    for before, after in zip(layout.outlines, again.outlines, strict=True):
        gap = before.region.symmetric_difference(after.region).area
        assert gap < 1e-6 * before.area


def crowd(count: int) -> Layout:
    """Owls in a row."""
    poses = Poses(*(np.full(count, value) for value in (0, 2.0, 0.3, 0.01, 1.0)))
    items = (builtin_item("owl"),) * count
    layout = Layout(builtin_container("square"), items, poses, np.ones(count))
    return replace(layout, poses=replace(poses, x=np.linspace(1, 3, count)))


def test_what_is_written_may_hold_more_numbers_than_may_be_read_at_once(saved, monkeypatch):
    layout = crowd(9)
    text = geojson_text(layout)
    monkeypatch.setattr(json_text, "MAX_PARTS", text.count(",") // 3)
    again = saved(text)
    for got, expected in zip(again.outlines, layout.outlines, strict=True):
        assert got.area == pytest.approx(expected.area, rel=1e-6)
    with pytest.raises(ReadError, match="numbers and lists; simplify it"):
        saved(json.loads(text))


def test_of_all_features_there_are_so_many_numbers_at_most(saved, monkeypatch):
    text = geojson_text(crowd(9))
    monkeypatch.setattr(json_text, "MAX_PARTS_IN_LINES", text.count(","))
    with pytest.raises(ReadError, match="numbers and lists; simplify it"):
        saved(text)


def test_a_feature_that_is_no_json_is_named(saved):
    lines = geojson_text(crowd(2)).split("\n")
    lines[2] = lines[2].replace('"role"', "role")
    with pytest.raises(ReadError, match=r"is not JSON \(line 3"):
        saved("\n".join(lines))


def test_layout_without_items(saved):
    layout = saved(edited(("features",), [CONTAINER]))
    assert len(layout.items) == len(layout.poses) == len(layout.weights) == 0


def test_canvas_weights_and_stretches_may_be_missing(saved):
    plain = copy.deepcopy(LAYOUT)
    del plain["canvas"], plain["manifest"]
    for key in ("weight", "stretch"):
        del plain["features"][1]["properties"][key]
    layout = saved(plain)
    assert (layout.container.width, layout.container.height) == (10, 10)
    assert layout.weights.tolist() == layout.poses.stretch.tolist() == [1.0]


def test_the_unit_of_the_canvas_comes_back(saved):
    assert saved(LAYOUT).container.unit == "px"
    assert saved(edited(("canvas", "unit"), "mm")).container.unit == "mm"
    container = on_canvas(builtin_container("heart"), canvas_size("8x9in"))
    none = np.zeros(0)
    again = saved(geojson_text(Layout(container, (), Poses(none, none, none, none), none)))
    assert again.container.canvas == container.canvas == {"width": 8, "height": 9, "unit": "in"}


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("", "not JSON"),
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("[]", "FeatureCollection"),
        ('{"type": "Feature"}', "FeatureCollection"),
        (json.dumps(LAYOUT).replace('"x": 5', '"x": NaN'), "holds the number NaN"),
        (json.dumps(LAYOUT).replace('"x": 5', '"x": 1e999'), r"features\[1\]\.x: must be up to"),
        (json.dumps(LAYOUT).replace('"x": 5', '"x": ' + "1" * 5000), "not JSON|must be up to"),
        (json.dumps(LAYOUT).replace('"x": 5', '"x": ' + "1" * 4000), "must be up to"),
        (edited(("features",), 5), "features: must be a list"),
        (edited(("features",), [ITEM]), "one feature of role container, not 0"),
        (edited(("features",), [CONTAINER] * 2), "one feature of role container, not 2"),
        (edited(("features", 1), 5), r"features\[1\]: must be a feature"),
        (edited(("features", 1, "properties", "role"), "x"), r"features\[1\]: role must be"),
        (edited(("features", 1, "properties", "role"), []), r"features\[1\]: role must be"),
        (edited(("features", 1, "properties", "x"), "5"), r"features\[1\]\.x: must be a number"),
        (edited(("features", 1, "properties", "angle"), None), r"\.angle: must be a number"),
        (edited(("features", 1, "properties", "scale"), 0), r"\.scale: must be positive"),
        (edited(("features", 1, "properties", "scale"), True), r"\.scale: must be a number"),
        (edited(("features", 1, "properties", "weight"), -1), r"\.weight: must not be negative"),
        (edited(("features", 1, "properties", "stretch"), 0), r"\.stretch: must be 0\.0001 to"),
        (edited(("features", 1, "properties", "stretch"), 2e4), r"\.stretch: must be .* 20000$"),
        (edited(("features", 1, "properties", "stretch"), "x"), r"\.stretch: must be a number"),
        (
            edited(("features", 1, "properties", "fill"), "url(http://evil)"),
            r"features\[1\]\.fill: must be a colour such as #4a5568, not 'url\(http://evil\)'",
        ),
        (edited(("features", 1, "properties", "fill"), ["red"]), r"\.fill: must be a colour"),
        (edited(("features", 1, "geometry"), None), "geometry must be a Polygon"),
        (edited(("features", 1, "geometry", "type"), "Point"), "geometry must be a Polygon"),
        (edited(("features", 1, "geometry", "coordinates"), []), "coordinates must be"),
        (edited(("features", 1, "geometry", "coordinates"), [[[0, 0]]]), "coordinates must be"),
        (edited(("features", 1, "geometry", "coordinates"), [[1, 2, 3]]), "coordinates must be"),
        (edited(("features", 1, "geometry", "coordinates"), "abc"), "coordinates must be"),
        (
            edited(("features", 1, "geometry", "coordinates"), [SQUARE[:2] * 3]),
            "no clean region|area",
        ),
        (
            edited(
                ("features", 1, "geometry", "coordinates"),
                [[[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]],
            ),
            r"features\[1\]: its outline is no clean region: Self-intersection",
        ),
        (edited(("canvas",), 5), "canvas: must be an object"),
        (edited(("canvas", "width"), 0), r"canvas\.width: must be positive"),
        (edited(("canvas", "unit"), "ell"), r"canvas\.unit: must be one of px, mm.*not 'ell'"),
        (edited(("canvas", "unit"), None), r"canvas\.unit: must be one of"),
        (edited(("manifest",), [1]), "manifest: must be an object"),
    ],
)
def test_nonsense(content, problem, saved):
    with pytest.raises(ReadError, match=problem):
        saved(content)


VALUES = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=2)
    ),
    max_leaves=6,
)
PLACES = st.sampled_from(
    [
        ("features",),
        ("canvas",),
        ("manifest",),
        ("features", 1),
        ("canvas", "width"),
        *((("features", 1, "properties", key)) for key in ITEM["properties"]),
        ("features", 1, "geometry"),
        ("features", 1, "geometry", "coordinates"),
        ("features", 1, "geometry", "coordinates", 0),
        ("features", 1, "geometry", "coordinates", 0, 0),
        ("features", 0, "geometry", "coordinates", 0),
    ]
)


@settings(deadline=None, max_examples=150)
@given(PLACES, VALUES)
def test_any_edit(saved, place, value):
    try:
        layout = saved(edited(place, value))
    except ReadError:
        return
    assert isinstance(layout, Layout)


def test_missing_layout():
    with pytest.raises(ReadError, match="no such file"):
        read_layout("nowhere.geojson")


@pytest.mark.parametrize("ending", [".svg", ".DXF", ".png", ".pdf"])
def test_drawings_of_layouts_are_not_loaded(ending, tmp_path):
    file = tmp_path / f"a{ending}"
    file.write_bytes(b"\x89PNG")
    with pytest.raises(ReadError, match=r"load one saved as \.geojson") as caught:
        read_layout(file)
    assert "\n" not in str(caught.value)

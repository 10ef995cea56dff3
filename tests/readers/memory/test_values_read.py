"""Values in memory are read as files are: once as a container, once as items."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

import packwork as pw
from packwork.geometry import affine
from packwork.readers.memory.shapes import MAX_POINTS, MAX_SHAPES
from packwork.scene.item import FlatArt, PictureArt, VectorArt

ROWS, COLUMNS = np.mgrid[:80, :120]
DISC = (COLUMNS - 60) ** 2 / 50**2 + (ROWS - 40) ** 2 / 30**2 < 1
GREY = np.where(DISC, 0, 255).astype(np.uint8)
"""Black on white: a mask as files have it, and an item on a plain background."""

SVG = '<svg viewBox="0 0 120 80"><ellipse cx="60" cy="40" rx="50" ry="30" fill="red"/></svg>'
TRIANGLE = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 0]]]}
LAKE = {"type": "Feature", "properties": {"name": "lake", "weight": 2}, "geometry": TRIANGLE}


def rgba() -> np.ndarray[Any, Any]:
    """The disc in red on nothing."""
    pixels = np.zeros((80, 120, 4), np.uint8)
    pixels[DISC] = (200, 30, 30, 255)
    return pixels


def png() -> bytes:
    file = io.BytesIO()
    Image.fromarray(GREY).save(file, "PNG")
    return file.getvalue()


DISCS: dict[str, Any] = {
    "bools": DISC,
    "shares": DISC.astype(np.float32),
    "zeros and ones": DISC.astype(np.int64),
    "grey": GREY,
    "one channel": GREY[:, :, None],
    "colours": np.repeat(GREY[:, :, None], 3, axis=2),
    "colours in shares": np.repeat(GREY[:, :, None] / 255.0, 3, axis=2),
    "transparent": rgba(),
    "picture": Image.fromarray(GREY),
    "picture in another mode": Image.fromarray(GREY).convert("CMYK"),
    "bytes": png(),
    "view of bytes": memoryview(png()),
    "text of an SVG": SVG,
    "text with a header": f"\n<?xml version='1.0'?>\n{SVG}",
    "bytes of an SVG": SVG.encode(),
}


@pytest.mark.parametrize("value", DISCS.values(), ids=DISCS)
def test_a_disc_in_memory_is_a_container_and_an_item(value: Any) -> None:
    container = pw.read_container(value)
    assert (container.width, container.height) == (600.0, 400.0)
    assert container.outline.area == pytest.approx(np.pi * 50 * 30 * 25, rel=0.01)
    (item,) = pw.read_items(value)
    assert item.outline.area == pytest.approx(np.pi * 50 * 30, rel=0.02)
    assert abs(item.outline.centroid).max() < 1e-6


@pytest.mark.parametrize(("content", "name"), [(png(), "disc.png"), (SVG.encode(), "disc.svg")])
def test_open_files_are_named_as_they_are(content: bytes, name: str, tmp_path: Path) -> None:
    file = tmp_path / name
    file.write_bytes(content)
    with file.open("rb") as opened:
        assert pw.read_items([opened])[0].name == "disc"
    assert pw.read_container(io.BytesIO(content)).width == 600.0
    assert pw.read_items(file)[0].source == str(file)


def test_an_open_picture_is_named_as_its_file(tmp_path: Path) -> None:
    file = tmp_path / "moon.png"
    file.write_bytes(png())
    with Image.open(file) as picture:
        assert pw.read_items(picture)[0].name == "moon"


def test_what_items_look_like() -> None:
    red, mask, drawing = pw.read_items([rgba(), DISC, SVG])
    assert isinstance(red.art, PictureArt)
    assert isinstance(mask.art, FlatArt)
    assert isinstance(drawing.art, VectorArt)


def test_names_come_from_a_dict() -> None:
    items = pw.read_items({"bear": DISC, "fox": SVG, "old": "star", "lake": TRIANGLE})
    assert [item.name for item in items] == ["bear", "fox", "star", "lake"]


def test_values_of_one_kind_are_told_apart() -> None:
    items = pw.read_items([DISC, ~DISC, rgba()])
    assert [item.source for item in items] == ["memory:array", "memory:array 2", "memory:array.png"]


def test_geometries_are_fitted_and_y_may_point_up() -> None:
    land = shapely.Polygon([(7.0, 46.0), (9.0, 46.0), (7.0, 47.0)])
    down, up = pw.read_container(land), pw.read_container(land, y_up=True)
    assert (down.width, down.height) == (up.width, up.height) == (600.0, 300.0)
    assert down.outline.region.covers(shapely.Point(10, 10))
    assert up.outline.region.covers(shapely.Point(10, 290))
    assert not up.outline.region.covers(shapely.Point(590, 10))


@pytest.mark.parametrize("factor", [1e-5, 1.0, 1e3, 1e7])
def test_degrees_metres_and_shares_give_one_layout(factor: float) -> None:
    plain = np.array([(0, 0), (4, 0), (4, 3), (1, 3)]) + 20.0
    one, other = (
        # Few epochs: what rounding differs by grows with each.
        pw.fill(shapely.Polygon(corners), [corners, "star"], count=4, epochs=3, levels="50")
        for corners in (plain, plain * factor)
    )
    assert other.metrics["exact"]["OO"] == 0
    assert other.metrics["LC"] == pytest.approx(one.metrics["LC"], rel=1e-2)


def test_features_bring_names_weights_and_colours() -> None:
    features = [
        LAKE,
        {**LAKE, "properties": {"NAME": "pond", "color": "teal"}},
        {**LAKE, "properties": None, "id": "puddle"},
        {**LAKE, "geometry": {"type": "Point", "coordinates": [1, 2]}},
    ]  # fmt: skip
    items = pw.read_items({"type": "FeatureCollection", "features": features})
    assert [item.name for item in items] == ["lake", "pond", "puddle"]
    assert [item.weight for item in items] == [2.0, 1.0, 1.0]
    assert items[1].art == FlatArt("teal")


def test_columns_may_be_named() -> None:
    lake = {**LAKE, "properties": {"lago": "Como", "km2": "146"}}
    (item,) = pw.read_items(lake, name_by="lago", weight_by="km2")
    assert (item.name, item.weight) == ("Como", 146.0)


def test_weights_of_items_are_shares_of_area() -> None:
    small, large = (
        pw.Item("small", outline=DISC_RING),
        pw.Item("large", outline=DISC_RING, weight=3),
    )
    layout = pw.fill("circle", [small, large], sizes="shared", effort="draft", levels="50")
    assert layout.areas[1] / layout.areas[0] == pytest.approx(3)
    layout = pw.fill(
        "circle", [small, large], sizes="shared", weights={"large": 1}, effort="draft", levels="50"
    )
    assert layout.areas[1] == pytest.approx(layout.areas[0])


DISC_RING = shapely.Point(40, 40).buffer(5)


class Frame:
    """As GeoPandas gives its frames to others."""

    crs = "EPSG:4326"
    columns = ("name", "geometry")

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        rows = (("a", shapely.box(0, 0, 2, 1)), ("b", shapely.Polygon([(0, 0), (2, 0), (0, 3)])))
        return {
            "type": "FeatureCollection",
            "features": [
                {
                    "id": str(k),
                    "properties": {"name": name},
                    "type": "Feature",
                    "geometry": geometry,
                }
                for k, (name, geometry) in enumerate(rows)
            ],
        }


def test_each_row_of_a_frame_is_an_item_and_all_are_a_container() -> None:
    assert [item.name for item in pw.read_items(Frame())] == ["a", "b"]
    # A frame with a reference system points up: b is widest at the bottom.
    container = pw.read_container(Frame())
    assert (container.width, container.height) == (400.0, 600.0)
    assert container.outline.region.covers(shapely.Point(390, 590))
    assert not pw.read_container(Frame(), y_up=False).outline.region.covers(shapely.Point(390, 590))


def test_frames_and_rows_of_geopandas() -> None:
    geopandas = pytest.importorskip("geopandas")
    shapes = [shapely.box(7, 46, 8, 47), DISC_RING, None]
    table = {"name": ["a", "b", "c"], "weight": [1, 2, 3]}
    frame = geopandas.GeoDataFrame(table, geometry=shapes, crs=4326)
    assert [item.weight for item in pw.read_items(frame)] == [1.0, 2.0]
    assert pw.read_items(frame.iloc[1])[0].name == "b"
    assert pw.read_items(next(frame.itertuples()))[0].name == "a"
    assert len(pw.read_items(frame.geometry)) == len(pw.read_items(frame.geometry.values[:2])) == 2
    assert pw.read_container(frame).name == "shape"


def test_outlines_off_their_centre_are_recentred() -> None:
    (item,) = pw.read_items(pw.Item("tile", outline=shapely.box(100, 50, 104, 52), art="teal"))
    assert item.outline.bounds == (-2.0, -1.0, 2.0, 1.0)
    picture = pw.read_items(rgba())[0]
    place = np.array([[1.0, 0.0, 50.0], [0.0, 1.0, 0.0]])
    moved = pw.Item(
        "far", outline=picture.outline.mapped(place), ink=picture.ink.mapped(place),
        art=PictureArt(picture.art.png, 120, 80, affine.compose(place, picture.art.matrix)),
    )  # fmt: skip
    (back,) = pw.read_items(moved)
    np.testing.assert_allclose(back.art.matrix, picture.art.matrix, atol=1e-9)


def test_items_keep_the_names_of_their_files_in_the_recipe() -> None:
    items = [*pw.read_items(["star", "heart"]), pw.Item("mine", outline=DISC_RING)]
    layout = pw.fill("circle", [*items, "owl"], effort="draft", levels="50")
    assert layout.manifest["recipe"]["items"] == ["star", "heart", "memory:mine", "owl"]


def test_two_items_of_one_source_stay_two() -> None:
    star = pw.read_items("star")[0]
    wide = pw.Item("wide", "star", star.outline)
    assert [item.name for item in pw.read_items([star, wide, "star"])] == ["star", "wide", "star"]


def test_whatever_is_a_path_may_be_in_memory() -> None:
    quick: dict[str, Any] = {"effort": "draft", "levels": "50"}
    words = pw.words(DISC, {"a": 2, "b": 1}, add=[SVG, "star"], **quick)
    assert [item.name for item in words.items] == ["a", "b", "drawing", "star"]
    chart = pw.chart(DISC, {"kg": [3, 1]}, size_by="kg", mark=SVG, **quick)
    assert {item.name for item in chart.items} == {"drawing"}
    pile = pw.pile(shapely.box(0, 0, 3, 2), [shapely.box(0, 0, 2, 1)], count=3, size="10%")
    assert len(pile.items) == 3
    filled = pw.fill(DISC, "circle", count=3, filler=[TRIANGLE], max_items=6, **quick)
    assert {item.name for item in filled.items} == {"circle", "shape"}
    rules = [{"items": "star", "region": shapely.box(0, 0, 1, 1)}]
    assert len(pw.fill("square", "star", count=2, rules=rules, **quick).items) == 2


def test_photographs_in_memory_are_printed_when_the_run_is_over(tmp_path: Path) -> None:
    teal = Image.new("RGB", (300, 200), "teal")
    layout = pw.photos("heart", [teal, np.asarray(teal)], effort="draft", levels="50")
    assert [item.name for item in layout.items] == ["picture", "array"]
    layout.save(tmp_path / "heart.png", pixels=400)
    layout.save(tmp_path / "heart.svg")


REFUSED: dict[str, tuple[Any, str]] = {
    "a number": (3, "is int, which cannot be read; give a path"),
    "nothing": (None, "is NoneType, which cannot be read"),
    "all false": (np.zeros((9, 9), bool), "is False, or 0, all over"),
    "nan": (np.full((9, 9), np.nan), "NaN or infinite"),
    "too large numbers": (np.full((9, 9), 300), "has numbers from 300 to 300"),
    "negative": (np.full((9, 9), -0.5), "has numbers from -0.5 to -0.5"),
    "text": (np.full((9, 9), "a"), "is an array of <U1"),
    "four sides": (np.zeros((3, 3, 3, 3)), r"is an array of shape \(3, 3, 3, 3\)"),
    "no pixels": (np.zeros((0, 9)), "has 9 x 0 pixels; give some"),
    "too many": (np.broadcast_to(True, (9_000, 9_000)), "9000 x 9000 pixels; 64 million"),
    "a point": (shapely.Point(1, 2), "has no area, as a Point; give polygons"),
    "no geometry": (shapely.Polygon(), "has no area"),
    "infinite": (shapely.Polygon([(0, 0), (1, np.inf), (1, 0)]), "NaN, infinite or beyond"),
    "no coordinates": ({"type": "Polygon"}, "make no geometry"),
    "text as coordinates": ({"type": "Polygon", "coordinates": "abc"}, "make no geometry"),
    "no features": ({"type": "FeatureCollection", "features": []}, "has no area"),
    "features of nothing": ({"type": "FeatureCollection"}, "without a list of features"),
    "half a feature": ({"type": "Feature"}, "has no area"),
    "no bytes": (b"", "is not a picture that can be read"),
    "other bytes": (b"abc", "is not a picture that can be read"),
    "broken SVG": ("<svg", "is not well-formed|cut short|not an SVG|is no SVG"),
}


@pytest.mark.parametrize(("value", "said"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_read_is_refused_in_one_line(value: Any, said: str) -> None:
    for read in (pw.read_container, pw.read_items):
        with pytest.raises(pw.PackworkError, match=said) as refused:
            read(value)
        assert "\n" not in str(refused.value)


def test_weights_and_columns_are_checked() -> None:
    with pytest.raises(pw.ReadError, match="row 1: the weight must be a positive number, not -1"):
        pw.read_items({**LAKE, "properties": {"weight": -1}})
    with pytest.raises(pw.ReadError, match="has no column 'km'; there are name, weight"):
        pw.read_items(LAKE, weight_by="km")


def test_there_are_bounds() -> None:
    # Those without a shape count as well, and are read faster.
    bare = {**LAKE, "geometry": None}
    many = {"type": "FeatureCollection", "features": [LAKE] + [bare] * MAX_SHAPES}
    with pytest.raises(pw.ReadError, match="more than 20,000 geometries"):
        pw.read_items(many)
    turns = np.linspace(0, 2 * np.pi, 2 * MAX_POINTS)
    smooth = np.column_stack([np.cos(turns), np.sin(turns)])
    assert len(pw.read_items(shapely.Polygon(smooth))[0].outline.points) < MAX_POINTS
    left, top = 2 * np.mgrid[:111, :111]
    tiles = shapely.MultiPolygon(list(shapely.box(left, top, left + 1, top + 1).ravel()))
    said = "61,605 points; 60,000 are the most, so simplify it"
    with pytest.raises(pw.ReadError, match=said):
        pw.read_items(tiles)


def test_a_recipe_of_another_program_is_told_so() -> None:
    with pytest.raises(pw.ReadError, match="was in the memory of the program that wrote"):
        pw.fill("circle", "memory:bear.svg")


@pytest.mark.parametrize("kind", [bool, np.uint8, np.int64, float])
def test_ones_are_inside_whatever_their_kind(kind: type) -> None:
    """What the page says of arrays: zeros and ones are no greys, whole or not."""
    array = np.zeros((40, 60), kind)
    array[5:20, 10:30] = 1
    container = pw.read_container(array, canvas=60)
    assert container.outline.region.covers(shapely.Point(20, 12))
    assert not container.outline.region.covers(shapely.Point(50, 30))
    assert container.outline.area == pytest.approx(15 * 20, rel=0.01)
    # Of greys the dark ones are.
    greys = pw.read_container(array.astype(np.uint8) * 200, canvas=60)
    assert greys.outline.region.covers(shapely.Point(50, 30))
    assert not greys.outline.region.covers(shapely.Point(20, 12))

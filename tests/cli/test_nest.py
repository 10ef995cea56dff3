"""The verb ``nest``: real files in, certified sheets out, one clear line for what cannot be."""

from __future__ import annotations

import contextlib
import json
import math
import re
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from typer.testing import Result

import packwork as pw
from packwork.errors import ReadError
from packwork.readers.instances import read_instance
from packwork.uses.nest_request import read_sheets
from packwork.uses.nest_work import PLACES

Command = Callable[..., Result]

BRACKET = """<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="50mm" viewBox="0 0 80 50">
<path d="M0 0h80v15h-60v35h-20z"/></svg>"""
DISC = """<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30">
<circle cx="15" cy="15" r="15"/></svg>"""
SQUARES = {
    "name": "squares",
    "strip_height": 4.001,
    "items": [
        {"id": 0, "demand": 6, "allowed_orientations": [0.0, 90.0],
         "shape": {"type": "simple_polygon", "data": [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]}},
        {"id": 1, "demand": 2,
         "shape": {"type": "simple_polygon", "data": [[0, 0], [1, 0], [0.5, 1]]}},
    ],
}  # fmt: skip


@pytest.fixture
def shop(folder: Path) -> Path:
    (folder / "bracket.svg").write_text(BRACKET, encoding="utf-8")
    (folder / "disc.svg").write_text(DISC, encoding="utf-8")
    (folder / "hide.geojson").write_text(
        '{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": []}}', encoding="utf-8"
    )
    (folder / "squares.json").write_text(json.dumps(SQUARES), encoding="utf-8")
    return folder


def test_parts_lie_on_the_sheet_in_true_size_at_the_distance_of_the_tool(
    shop: Path, packwork: Command
) -> None:
    line = "nest 300x200mm bracket.svg*8 disc.svg*3 --kerf 2mm --passes 150 -o a.geojson -o a.dxf"
    result = packwork(f"{line} --report a.json")
    assert result.exit_code == 0, result.output
    assert "certified" in result.output
    layout = pw.Layout.load(shop / "a.geojson")
    assert layout.container.unit == "mm"
    assert sorted(placed.name for placed in layout) == ["bracket"] * 8 + ["disc"] * 3
    outlines = [outline.region for outline in layout.outlines]
    areas = sorted({round(region.area) for region in outlines})
    assert areas == [round(outlines[-1].area), 80 * 15 + 20 * 35]
    assert min(
        a.distance(b) for k, a in enumerate(outlines) for b in outlines[:k]
    ) > 2 - 1e-9  # fmt: skip
    sheet = shapely.box(0, 0, layout.container.width, 200)
    assert all(sheet.buffer(-2 + 1e-9, join_style="mitre").covers(region) for region in outlines)
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    assert (said["parts"], said["certified"], said["sheet_length"]) == (11, True, 300)
    assert said["length"] < 200 < 300 == layout.container.width
    assert packwork("measure a.dxf").exit_code == 0


@pytest.mark.parametrize("work", ["--passes 40", "--effort draft"])
def test_the_same_work_gives_the_same_bytes(work: str, shop: Path, packwork: Command) -> None:
    for name in ("a", "b"):
        packwork(f"nest squares.json {work} --seed 2 -o {name}.svg -q")
    assert (shop / "a.svg").read_bytes() == (shop / "b.svg").read_bytes()


@pytest.mark.parametrize(
    ("asked", "effort", "most"),
    [("", "normal", 2_500), ("--effort draft", "draft", 320), ("--time 0.2", None, 100_000),
     ("--passes 7", None, 7), ("--effort best --passes 5", None, 5)],
)  # fmt: skip
def test_an_effort_bounds_the_passes(
    asked: str, effort: str | None, most: int, shop: Path, packwork: Command,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    for name, places in PLACES.items():
        monkeypatch.setitem(PLACES, name, places // 8)
    assert packwork(f"nest 40mm disc.svg {asked} -o a.svg --report a.json").exit_code == 0
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    assert said["effort"] == effort
    assert 0 < said["passes"] <= most


def test_an_instance_is_nested_as_its_parts_may_lie(shop: Path, packwork: Command) -> None:
    assert packwork("nest squares.json --passes 120 -o a.geojson").exit_code == 0
    layout = pw.Layout.load(shop / "a.geojson")
    assert [placed.name for placed in layout].count("part 0") == 6
    assert 6.0 < layout.container.width < 8.6


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("nest 300x40mm bracket.svg --rotate 90,270", "bracket is 50.0012 x 80.0012 mm"),
        ("nest 40mm bracket.svg --rotate none", "bracket is 50.0004297 mm high"),
        ("nest 300x40mm disc.svg --margin 1mm --kerf 2mm", "whose sides are 2 mm longer"),
        ("nest 300,5x200mm disc.svg", "a number with decimals has a point, as 600.5x400mm"),
        ("nest hide.geojson disc.svg", "say how long its longer side is: hide.geojson@1200mm"),
        ("nest 300x40mm disc.svg --margin 25mm", "no room within its margin"),
        ("nest 300mm,200x100mm disc.svg", "a strip of open length has no end"),
        ("nest nowhere.svg disc.svg", "nowhere.svg"),
        ("nest 300mm bracket.svg --optional disc.svg", "a strip of open length has always room"),
        ("nest squares.json --optional disc.svg", "an instance holds its parts"),
        ("nest 300mm", "there is nothing to nest"),
        ("nest wide bracket.svg", "wide: "),
        ("nest 300 x 200 mm bracket.svg", "sheet: 300 x ... has spaces; write it as 600x400mm"),
        ("nest 300x200mm star 12 moon", "12: is no part; star*12 asks for so many"),
        ("nest 300x200mm 12 star", "12: is no part; bracket.dxf*12 asks for so many"),
        ("nest 300x200 mm bracket.svg", "sheet: 300x200 mm ... has spaces"),
        ("nest 30x20 disc.svg", "or state its unit, as 600x400mm"),
        ("nest squares.json bracket.svg", "an instance holds its parts"),
        ("nest squares.json --mirror", "--mirror: an instance says how its parts lie"),
        ("nest squares.json --rotate 0,180", "--rotate: an instance says how its parts lie"),
        ("nest squares.json --engrave red", "--engrave: an instance says how its parts lie"),
        ("nest none.json", "no such file"),
        ("nest square*3 bracket.svg", "square: is one sheet, the smallest that holds all"),
        ("nest 600x400mm, bracket.svg", "sheet: '600x400mm,' names an empty one"),
        ("nest , bracket.svg", "sheet: ',' names an empty one"),
        ("nest 600x400mm*1000000 bracket.svg", "a count has 6 digits at most, not 1000000"),
        ("nest 300mm bracket.svg*1000000", "a count has 6 digits at most, not 1000000"),
        (
            "nest 300mm bracket.svg*12x",
            "a count is a whole number, as in bracket.svg*12, not '12x'",
        ),
        ("nest 300mm*2x bracket.svg", "300mm: a count is a whole number"),
        ("nest 300mm bracket.svg*0", "there is nothing to nest"),
        ("nest square bracket.svg*2001", "2,001 parts are more than 2,000"),
        ("nest 300mm nowhere.svg*3", "no such file"),
        ("nest 300mm bracket.svg --rotate round", "rotate"),
        ("nest 300mm bracket.svg --rotate 22,5", "--rotate: 22,5 may be 22.5 degrees"),
        ("nest 300mm bracket.svg --kerf wide", "wide"),
        ("nest 300mm bracket.svg -o a.doc", "a.doc"),
    ],
)
def test_what_cannot_be_is_one_line(shop: Path, packwork: Command, line: str, said: str) -> None:
    result = packwork(line)
    assert result.exit_code == 2
    assert said in " ".join(result.output.split())
    assert not (shop / "nest.svg").exists()


def test_parts_without_room_are_told_and_the_others_written(shop: Path, packwork: Command) -> None:
    result = packwork("nest 90x80mm*2 bracket.svg*6 --passes 60 -o a.svg --report a.json")
    assert result.exit_code == 1
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    (missing,) = said["unplaced"]
    assert missing["part"] == "bracket"
    assert f"no room for bracket*{missing['count']}" in result.output
    written = [len(pw.Layout.load(shop / f"a-{k}.svg")) for k in (1, 2)]
    assert sum(written) == said["parts"] == 6 - missing["count"] >= 2


def test_sheets_are_taken_as_needed_one_file_each(shop: Path, packwork: Command) -> None:
    line = "nest 100x90mm bracket.svg*6 disc.svg*4 --kerf 1mm --margin 3mm --passes 99 -o a.geojson"
    result = packwork(f"{line} --report a.json")
    assert result.exit_code == 0, result.output
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    count = len(said["sheets"])
    assert 2 <= count <= 5
    sheet = shapely.box(3, 3, 97, 87).buffer(1e-9)
    names = []
    for k in range(1, count + 1):
        layout = pw.Layout.load(shop / f"a-{k}.geojson")
        assert (layout.container.width, layout.container.height) == (100, 90)
        regions = [outline.region for outline in layout.outlines]
        assert all(sheet.covers(region) for region in regions)
        assert all(a.distance(b) >= 1 - 1e-9 for n, a in enumerate(regions) for b in regions[:n])
        names += [placed.name for placed in layout]
    assert sorted(names) == ["bracket"] * 6 + ["disc"] * 4


def test_sheets_of_any_outline_come_before_bought_ones(shop: Path, packwork: Command) -> None:
    (shop / "offcut.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="6in" height="100mm" '
        'viewBox="0 0 152.4 100">'
        '<path fill-rule="evenodd" d="M0 0h152.4v50l-60 50h-92.4zM60 30h20v20h-20z"/></svg>',
        encoding="utf-8",
    )
    line = (
        "nest offcut.svg,200x100mm bracket.svg*6 disc.svg*3 --rotate free --passes 99 -o a.geojson"
    )
    assert packwork(line).exit_code == 0
    first, second = (pw.Layout.load(shop / f"a-{k}.geojson") for k in (1, 2))
    assert len(first) + len(second) == 9
    assert first.container.name == "offcut"
    offcut = first.container.outline.region.buffer(1e-9)
    assert all(offcut.covers(outline.region) for outline in first.outlines)
    scale = first.container.width / second.container.width
    assert scale == pytest.approx(152.4 / 200 if first.container.unit == "mm" else 6 / (200 / 25.4))


def test_parts_are_turned_over_only_where_they_may_be(shop: Path, packwork: Command) -> None:
    (shop / "flag.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="40mm" viewBox="0 0 30 40">'
        '<path d="M0 0h30l-20 15v25h-10z" fill="teal"/></svg>',
        encoding="utf-8",
    )
    hands = {}
    for flag in ("", "--mirror"):
        assert packwork(f"nest 81mm flag.svg*12 --passes 60 {flag} -o a.geojson").exit_code == 0
        layout = pw.Layout.load(shop / "a.geojson")
        # The thin arm lies clockwise of the thick one, or the other way round.
        hands[flag] = {_hand(outline.region) for outline in layout.outlines}
        assert len(layout) == 12
    assert len(hands[""]) == 1
    assert len(hands["--mirror"]) == 2


def _hand(region: shapely.Polygon) -> bool:
    """Side of the line from the centre to the farthest corner on which the next farthest lies."""
    points = shapely.get_coordinates(region)[:-1] - region.centroid.coords[0]
    first, second = points[(-(points**2).sum(1)).argsort()[:2]]
    return bool(first[0] * second[1] - first[1] * second[0] > 0)


def test_the_smallest_square_is_as_long_as_high(shop: Path, packwork: Command) -> None:
    line = "nest square disc.svg*4 bracket.svg*2 --rotate free --passes 80"
    assert packwork(f"{line} -o a.geojson --report a.json").exit_code == 0
    layout = pw.Layout.load(shop / "a.geojson")
    side = layout.container.width
    assert layout.container.height == side == pytest.approx(layout.manifest["nest"]["length"])
    assert len(layout) == 6
    area = sum(outline.region.area for outline in layout.outlines)
    assert area < side**2 < 2.2 * area
    sides = []
    for seed in range(3):
        line = f"nest square disc.svg*9 --passes 150 --seed {seed} -o a.geojson"
        assert packwork(line).exit_code == 0
        sides.append(pw.Layout.load(shop / "a.geojson").container.width)
    assert min(sides) < 92
    assert all(side >= 90 for side in sides)


def test_optional_parts_fill_what_the_others_leave(shop: Path, packwork: Command) -> None:
    line = "nest 130x90mm bracket.svg*3 --optional disc.svg*30 --passes 150"
    assert packwork(f"{line} -o a.geojson --report a.json").exit_code == 0
    layout = pw.Layout.load(shop / "a.geojson")
    names = [placed.name for placed in layout]
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    assert names.count("bracket") == 3
    assert 1 <= names.count("disc") < 30
    assert said["optional_left"] == [{"part": "disc", "count": 30 - names.count("disc")}]


def test_optional_parts_lie_beside_the_others_so_that_the_rest_is_one_piece(
    shop: Path, packwork: Command
) -> None:
    line = "nest 600x90mm bracket.svg*4 --optional disc.svg*6 --passes 200"
    assert packwork(f"{line} -o a.geojson --report a.json").exit_code == 0
    layout = pw.Layout.load(shop / "a.geojson")
    names = [placed.name for placed in layout]
    assert names.count("disc") == 6
    ends = {name: max(outline.bounds[2] for outline, own in
                      zip(layout.outlines, names, strict=True) if own == name)
            for name in set(names)}  # fmt: skip
    # Two columns of three discs.
    assert ends["disc"] < ends["bracket"] + 65.0


def test_lengths_of_lines_and_what_is_left_over_are_told(shop: Path, packwork: Command) -> None:
    ring = shop / "ring.svg"
    ring.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">'
        '<g fill="none" stroke="#000" stroke-width="0.1"><circle cx="20" cy="20" r="15"/>'
        '<circle cx="20" cy="20" r="5"/><g id="engrave"><path d="M12 20h2"/></g></g></svg>',
        encoding="utf-8",
    )
    result = packwork("nest 100x40mm*1 ring.svg*4 --passes 20 -o a.pdf --report a.json")
    said = json.loads((shop / "a.json").read_text(encoding="utf-8"))
    assert said["parts"] == 3
    assert said["cut_length"] == pytest.approx(3 * 2 * math.pi * 20, rel=1e-6)
    assert said["engraved_length"] == pytest.approx(6.0)
    assert said["unplaced_area"] == pytest.approx(math.pi * 200, rel=1e-4)
    assert said["sheets"][0]["rest_area"] == pytest.approx(40 * (100 - said["length"]))
    told = " ".join(result.output.split())
    rest = f"{100 - said['length']:.6g} x 40 mm"
    assert f"to cut: 377.0 mm; to engrave: 6.0 mm; left over: {rest}" in told
    assert "no room for ring*1, 628.3 mm² in all" in told


def test_parts_that_touch_have_edges_in_a_picture(shop: Path, packwork: Command) -> None:
    (shop / "tile.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">'
        '<path fill="#fc0" d="M0 0H20V20H0z"/></svg>',
        encoding="utf-8",
    )
    packwork("nest 40x20mm tile.svg*2 --passes 1 -o a.png")
    with Image.open(shop / "a.png") as picture:
        row = np.asarray(picture.convert("RGB"))[picture.height // 2]
    middle = len(row) // 2
    assert row[middle - 3 : middle + 3].min(axis=0).max() < 60
    assert row[middle // 2].tolist() == [255, 204, 0]


def test_rows_stand_together_so_that_the_rest_is_one_piece(shop: Path, packwork: Command) -> None:
    """The fourth row lay at the sheet's far edge; a strip between it and the others was lost."""
    (shop / "rect.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="180mm" height="90mm" viewBox="0 0 180 90">'
        '<path d="M0 0H180V90H0z"/></svg>',
        encoding="utf-8",
    )
    result = packwork("nest 600x400mm rect.svg*12 --kerf 2mm --passes 1 -o a.svg")
    assert "left over: 52 x 400 mm and 548 x 30 mm" in " ".join(result.output.split())


@pytest.mark.parametrize(
    ("sheet", "size", "unit"),
    [
        ("12.5x8.25in", (12.5, 8.25), "in"),
        ("300x200.5mm*2", (300.0, 200.5), "mm"),
        ("300.25mm", (math.inf, 300.25), "mm"),
        ("300X.5mm", (300.0, 0.5), "mm"),
        ("A4", (210.0, 297.0), "mm"),
    ],
)
def test_a_size_may_have_decimals(sheet: str, size: tuple[float, float], unit: str) -> None:
    read = read_sheets(sheet)[0]
    assert ((read.length, read.height), read.unit) == (size, unit)


def test_files_of_an_earlier_nest_are_kept_and_named(shop: Path, packwork: Command) -> None:
    assert packwork("nest 90x60mm bracket.svg*3 --passes 30 -o a.svg").exit_code == 0
    assert (shop / "a-3.svg").exists()
    result = packwork("nest 90x60mm bracket.svg --passes 9 -o a.svg")
    assert "of an earlier nest: a-1.svg, a-2.svg, a-3.svg" in " ".join(result.output.split())
    result = packwork("nest a-1.svg,90x60mm bracket.svg --passes 9 -o a.svg")
    assert result.exit_code == 2
    assert "a-1.svg" in result.output
    assert packwork("nest 90x60mm bracket.svg --passes 9 -o a.svg --no-clobber").exit_code == 2


def test_shapes_of_an_instance_may_have_holes_or_be_rectangles(
    shop: Path, packwork: Command
) -> None:
    frame = {"outer": [[0, 0], [4, 0], [4, 4], [0, 4]], "inner": [[[1, 1], [3, 1], [3, 3], [1, 3]]]}
    box = {"x_min": 2.0, "y_min": 1.0, "width": 1.5, "height": 1.0}
    shapes = [{"type": "polygon", "data": frame}, {"type": "rectangle", "data": box}]
    items = [{"id": k, "demand": 1, "shape": shape} for k, shape in enumerate(shapes)]
    said = {"name": "holed", "strip_height": 4.01, "items": items}
    (shop / "holed.json").write_text(json.dumps(said), encoding="utf-8")
    assert packwork("nest holed.json --passes 200 -o a.geojson").exit_code == 0
    layout = pw.Layout.load(shop / "a.geojson")
    assert sorted(outline.region.area for outline in layout.outlines) == pytest.approx([1.5, 12])
    assert layout.container.width < 4.2


@pytest.mark.parametrize("ending", ["geojson", "svg"])
def test_parts_of_an_earlier_nest_stay_where_they_are(
    shop: Path, packwork: Command, ending: str
) -> None:
    line = f"nest 200x100mm bracket.svg*4 --kerf 1mm --passes 12 -o a.{ending}"
    assert packwork(line).exit_code == 0
    line = f"nest a.{ending},200x100mm disc.svg*14 --kerf 1mm --passes 12 -o b.{ending}"
    result = packwork(line)
    assert result.exit_code == 0
    assert "its parts go into a DXF as outlines" not in " ".join(result.output.split())
    before = pw.Layout.load(shop / f"a.{ending}")
    after = [pw.Layout.load(shop / f"b-{k}.{ending}") for k in (1, 2)]
    for old, new in zip(before.outlines, after[0].outlines[:4], strict=True):
        assert old.region.symmetric_difference(new.region).area < 1e-3
    assert sum(map(len, after)) == 18
    result = packwork(f"nest b-1.{ending} bracket.svg --kerf 1mm --passes 10 -o c.{ending}")
    # In an SVG the arcs are still there.
    is_told = "its parts go into a DXF as outlines" in " ".join(result.output.split())
    assert is_told is (ending == "geojson")
    assert len(after[0]) > 4


def test_parts_lie_in_the_holes_of_others_unless_holes_are_filled(
    shop: Path, packwork: Command
) -> None:
    (shop / "frame.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
        '<path fill-rule="evenodd" d="M0 0h60v60h-60zM5 5v50h50v-50z"/></svg>',
        encoding="utf-8",
    )
    lengths = []
    for holes in ("keep", "fill"):
        line = f"nest 61mm frame.svg disc.svg --holes {holes} --passes 200 --report a.json"
        assert packwork(line).exit_code == 0
        lengths.append(json.loads((shop / "a.json").read_text(encoding="utf-8"))["length"])
    assert lengths[0] < 61 < 89 < lengths[1]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"strip_height": -1}, "strip_height"),
        ({"items": []}, "items"),
        ({"items": [{**SQUARES["items"][0], "allowed_orientations": []}]}, "allowed_orientations"),
        ({"items": [{**SQUARES["items"][0], "demand": 10**9}]}, "demand"),
        ({"items": [{**SQUARES["items"][0], "shape": {"type": "circle"}}]}, "shape"),
        ({"items": [{"id": 4, "demand": 1, "shape": {
            "type": "simple_polygon", "data": [[0, 0], [2, 2], [2, 0], [0, 2]]}}]}, "part 4"),
    ],
)  # fmt: skip
def test_an_instance_that_is_none_is_one_line(
    shop: Path, packwork: Command, change: dict, said: str
) -> None:
    (shop / "bad.json").write_text(json.dumps({**SQUARES, **change}), encoding="utf-8")
    result = packwork("nest bad.json")
    assert result.exit_code == 2
    assert said in result.output
    assert result.output.count("\n") == 1


def test_a_strip_far_longer_than_high_is_certified(shop: Path, packwork: Command) -> None:
    result = packwork("nest 55mm bracket.svg*14 --rotate none --passes 3 -o a.svg")
    assert result.exit_code == 0, result.output
    assert pw.Layout.load(shop / "a.svg").container.width > 10 * 55


def test_a_part_that_is_wanted_zero_times_stands_in_no_way(shop: Path, packwork: Command) -> None:
    assert packwork("nest 35mm disc.svg*3 bracket.svg*0 --passes 3 -o a.svg").exit_code == 0


def test_a_file_that_was_not_written_as_measured_is_not_certified(
    shop: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.cli.running.verify.faults_in_file", lambda *_: ["moved"])
    result = packwork("nest 100mm disc.svg --passes 3 -o a.svg --report a.json")
    assert result.exit_code == 1
    assert "a.svg: moved" in result.output
    assert not json.loads((shop / "a.json").read_text(encoding="utf-8"))["certified"]


@given(st.binary(max_size=200) | st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(max_size=5) | st.integers(),
    lambda inner: st.lists(inner, max_size=4)
    | st.dictionaries(st.sampled_from(["items", "strip_height", "demand", "shape", "id"]), inner),
    max_leaves=20,
).map(lambda value: json.dumps(value).encode()))  # fmt: skip
def test_any_bytes_are_an_instance_or_refused(data: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "any.json")
        path.write_bytes(data)
        with contextlib.suppress(ReadError):
            assert read_instance(path).parts


def test_parts_that_come_apart_when_they_are_cut_are_named(folder: Path, packwork: Command) -> None:
    (folder / "bike.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="12mm" viewBox="0 0 30 12">'
        '<circle cx="6" cy="6" r="5"/><circle cx="24" cy="6" r="5"/></svg>', encoding="utf-8"
    )  # fmt: skip
    result = packwork("nest 300x200mm bike.svg*3 builtin:star@40mm --passes 9 -o a.geojson")
    said = "packwork: of several pieces, which come apart when they are cut: bike (2)\n"
    assert (result.exit_code, said in result.stderr) == (0, True)


def test_a_tool_is_a_distance_of_parts(folder: Path, packwork: Command) -> None:
    result = packwork("nest 300x200mm builtin:star --tool 150mm --passes 3")
    assert result.exit_code == 2
    assert "with the distance that it keeps" in result.output
    assert packwork("nest 300x200mm builtin:star --tool wide --passes 3").exit_code == 2


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (
            "nest 400mm plain.svg bracket.svg",
            "no unit is stated in plain.svg, and the sheet is in mm",
        ),
        ("nest 400 plain.svg bracket.svg", "the sheet is in px, and bracket.svg in real units"),
        ("nest 400 plain.svg", ""),
        ("nest 400mm bracket.svg", ""),
    ],
)
def test_a_unit_that_is_taken_is_told(shop: Path, packwork: Command, line: str, said: str) -> None:
    plain = BRACKET.replace('width="80mm" height="50mm" ', "")
    (shop / "plain.svg").write_text(plain, encoding="utf-8")
    result = packwork(f"{line} --passes 2")
    assert result.exit_code == 0
    told = " ".join(result.output.split())
    assert ("a px is taken for 1/96 inch" in told) is bool(said)
    assert said in told


def test_a_part_is_as_large_as_is_asked_for(shop: Path, packwork: Command) -> None:
    icon = BRACKET.replace(' width="80mm" height="50mm"', "")
    (shop / "icon@2x.svg").write_text(icon, encoding="utf-8")
    (shop / "list.csv").write_text("file;count;size\ndisc.svg;2;2,4 cm\nbracket.svg;1;\n", "utf-8")
    line = "nest 300x200mm icon@2x.svg@60mm*3 list.csv --rotate none --passes 50 -o a.geojson"
    result = packwork(line)
    assert result.exit_code == 0, result.output
    assert "no unit" not in " ".join(result.output.split())
    layout = pw.Layout.load(shop / "a.geojson")
    sides = [(one.name, round(one.outline.extent, 3)) for one in layout]
    assert sorted(sides) == [("bracket", 80.0)] + [("disc", 24.0)] * 2 + [("icon@2x", 60.0)] * 3


@pytest.mark.parametrize("side", ["0mm", "0"])
def test_a_size_that_is_none_is_one_line(shop: Path, packwork: Command, side: str) -> None:
    result = packwork(f"nest 300x200mm disc.svg@{side} --passes 5 -o a.svg")
    assert result.exit_code == 2
    assert "size: is a length above 0, as 80mm" in " ".join(result.output.split())


def test_rectangles_tile_a_sheet_and_others_are_told_how_much_it_has_to_be_larger(
    shop: Path, packwork: Command
) -> None:
    (shop / "tile.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">'
        '<rect width="30" height="20"/></svg>', encoding="utf-8",
    )  # fmt: skip
    # Round corners are none that rows are told of exactly.
    (shop / "round.svg").write_text(
        (shop / "tile.svg").read_text(encoding="utf-8").replace("<rect", '<rect rx="4"'),
        encoding="utf-8",
    )
    told = " ".join(
        packwork("nest 66x46mm round.svg*8 --kerf 2mm --passes 5 -o a.svg").output.split()
    )
    assert "their parts fill 2 to the edge: a thousandth more room (66.066x46.046mm)" in told
    for file in ("a.svg", "a.dxf", "a.geojson", "a.packwork"):
        told = packwork(f"nest 60x40mm tile.svg*4 -o {file}").output
        assert "4 parts on 60 x 40 mm, 100.0% covered; certified" in told
        assert "certified: nothing overlaps" in packwork(f"measure {file}").output
        line = f"nest 75.2x55.2mm tile.svg*4 --kerf .2mm --margin 7.5mm -o {file}"
        assert "4 parts on 75.2 x 55.2 mm" in packwork(line).output
        assert "certified: nothing overlaps" in packwork(f"measure {file}").output
    assert "on 60 x 40 mm" in packwork("nest 40mm tile.svg*4 -o a.svg").output


@pytest.mark.parametrize("line", ["50x50mm disc.svg@40mm*35", "50x51mm disc.svg@40mm*2"])
def test_parts_that_exclude_each_other_are_promised_no_fewer_sheets(
    shop: Path, packwork: Command, line: str
) -> None:
    told = " ".join(packwork(f"nest {line} --passes 2 -o a.svg").output.split())
    assert f"{line.rpartition('*')[2]} sheets" in told
    assert "may do with" not in told


def test_more_sheets_than_the_parts_ask_for_are_told(shop: Path, packwork: Command) -> None:
    line = "nest 300x200mm bracket.svg*17 disc.svg*14 --passes 1 -o a.dxf --report a.json"
    result = packwork(line)
    told = " ".join(result.output.split())
    assert "but 2 sheets; their parts cover 70 % of one: more time may do with 1" in told, told
    assert "(--passes 3)" in told
    assert len(json.loads((shop / "a.json").read_text(encoding="utf-8"))["advice"]) == 1
    assert packwork(f"{line} -q").output == ""
    # No two of these lie on one sheet, whatever their areas are.
    (shop / "board.svg").write_text(
        BRACKET.replace("M0 0h80v15h-60v35h-20z", "M0 0h80v25h-80z"), encoding="utf-8"
    )
    large = packwork("nest 99x40mm board.svg*2 --passes 20 -o a.dxf")
    assert "2 sheets" in large.output
    assert "may do" not in large.output


def test_an_outline_without_a_size_is_as_long_as_is_told(shop: Path, packwork: Command) -> None:
    ring = [[0, 0], [300, 10], [350, 150], [40, 210], [0, 0]]
    hide = {"type": "Polygon", "coordinates": [ring]}
    (shop / "skin.geojson").write_text(
        json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "geometry": hide}]}), encoding="utf-8",
    )  # fmt: skip
    result = packwork("nest skin.geojson disc.svg*2 --passes 2 -o a.svg")
    assert result.exit_code == 2
    assert "say how long its longer side is: skin.geojson@1200mm" in result.output
    assert packwork("nest skin.geojson@700mm disc.svg*2 --passes 2 -o a.svg").exit_code == 0
    ground = pw.Layout.load(shop / "a.svg").container
    assert (ground.width, ground.height, ground.unit) == (700.0, 420.0, "mm")
    (sheet,) = read_sheets(f"{shop / 'bracket.svg'}@16in*3")
    assert (sheet.length, sheet.height) == pytest.approx((16.0, 10.0))
    assert (sheet.unit, sheet.count) == ("in", 3)
    (heart,) = read_sheets("heart@300MM")
    assert max(heart.length, heart.height) == pytest.approx(300.0)


def test_small_coordinates_of_a_sheet_are_lengths_and_no_degrees(tmp_path: Path) -> None:
    ring = [[0, 0], [60, 0], [60, 40], [0, 40], [0, 0]]
    file = tmp_path / "flat.geojson"
    file.write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}), encoding="utf-8")
    (sheet,) = read_sheets(f"{file}@120mm")
    assert (sheet.length, sheet.height) == pytest.approx((120.0, 80.0))


@pytest.mark.parametrize(
    "side", ["0mm", "12furlong", "300x200mm", "1e9mm", "", "5%", "-3mm", "nan"]
)
def test_a_longer_side_that_is_none_is_refused_by_the_name_of_its_sheet(
    side: str, shop: Path
) -> None:
    with pytest.raises(ReadError) as refused:
        read_sheets(f"{shop / 'bracket.svg'}@{side}")
    assert f"bracket.svg@{side}: " in str(refused.value)
    assert re.search(r"its longer side is one length|a side is \S+ to", str(refused.value))


@pytest.mark.parametrize("ending", ["geojson", "dxf", "svg", "packwork"])
def test_an_earlier_nest_has_its_size(ending: str, shop: Path, packwork: Command) -> None:
    assert packwork(f"nest 120x80mm disc.svg --passes 2 -o a.{ending}").exit_code == 0
    with pytest.raises(ReadError, match="is an earlier nest, whose parts have their sizes"):
        read_sheets(f"{shop / 'a'}.{ending}@120mm")

"""DXFs as CAD programs write them: parts of true size, arcs kept, faults in one line."""

from __future__ import annotations

import io
import logging
import math
from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.document import Drawing
from ezdxf.layouts import Modelspace
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.geometry.arcs import ArcLine
from packwork.geometry.outline import Outline
from packwork.readers.container import read_container
from packwork.readers.dxf import entities
from packwork.readers.dxf.entities import read_drawing
from packwork.readers.dxf.item import CadPart, cad_parts, read_dxf
from packwork.readers.engraving import Engraving
from packwork.readers.items import read_items
from packwork.readers.reading import UnfitError
from packwork.scene.line_art import LineArt

MM = 96 / 25.4
"""Px of a millimetre."""

Draw = Callable[[Modelspace], object]


def drawing(draw: Draw, version: str = "R2010", unit: int = 4) -> Drawing:
    document = ezdxf.new(version, setup=True)
    document.header["$INSUNITS"] = unit
    draw(document.modelspace())
    return document


def data_of(document: Drawing) -> bytes:
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode()


def parts(draw: Draw, **about: object) -> list[CadPart]:
    return cad_parts(read_drawing(data_of(drawing(draw, **about))))  # type: ignore[arg-type]


def area_mm2(part: CadPart) -> float:
    """Area within the true curves: the polygon's by its arcs' segments."""
    return sum(_area(line) for line in part.cut) / MM**2


def _area(line: ArcLine) -> float:
    """Shoelace sum of the corners, and the segments of circles on the sides."""
    x, y = (line.points - line.points[0]).T
    area = 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    for start, end, bulge in zip(line.points, line.ends, line.bulges.tolist(), strict=False):
        if bulge:
            angle = 4 * math.atan(bulge)
            radius = math.dist(start, end) * (1 + bulge**2) / (4 * bulge)
            area += radius**2 / 2 * (angle - math.sin(angle))
    return area


def plate(space: Modelspace) -> None:
    """Lines and arcs in no order, hardly touching, two holes, and what is no outline."""
    gap = 1e-7
    space.add_line((0, 0), (80 + gap, 0))
    space.add_line((80, 15), (80, 0))
    space.add_line((80, 15), (25, 15 + gap))
    space.add_arc((25, 20), 5, 180, 270)
    space.add_line((20, 20), (20, 50))
    space.add_line((20, 50), (5, 50))
    space.add_arc((5, 45), 5, 90, 180)
    space.add_line((0, 45), (0, 0))
    space.add_circle((70, 7.5), 3)
    space.add_circle((10, 40), 3)


PLATE_MM2 = 80 * 15 + 20 * 35 - 2 * math.pi * 9 - 25 * (1 - math.pi / 4) + 25 * (1 - math.pi / 4)


def test_lines_and_arcs_that_hardly_touch_are_one_outline() -> None:
    (part,) = parts(plate)
    assert len(part.cut) == 3
    assert area_mm2(part) == pytest.approx(PLATE_MM2, abs=1e-5)
    assert part.region.area / MM**2 == pytest.approx(PLATE_MM2, rel=1e-4)
    left, top, right, bottom = part.region.bounds
    assert (right - left, bottom - top) == pytest.approx((80 * MM, 50 * MM), abs=1e-6)


def test_y_points_up_there_and_down_here() -> None:
    (part,) = parts(lambda space: space.add_lwpolyline([(0, 0), (9, 0), (0, 5)], close=True))
    assert shapely.get_coordinates(part.region.centroid)[0] == pytest.approx([3 * MM, -5 / 3 * MM])


def test_outlines_lie_around_the_true_curves_and_hardly_off_them() -> None:
    def draw(space: Modelspace) -> None:
        space.add_circle((0, 0), 50)
        space.add_circle((0, 0), 20)

    (part,) = parts(draw)
    outer, hole = part.region.exterior, part.region.interiors[0]  # type: ignore[union-attr]
    far, near = np.hypot(*np.array(outer.coords).T), np.hypot(*np.array(hole.coords).T)
    middles = [
        (np.array(ring.coords)[1:] + np.array(ring.coords)[:-1]) / 2 for ring in (outer, hole)
    ]
    assert np.hypot(*middles[0].T).min() > 50 * MM * (1 - 1e-12)
    assert near.max() < 20 * MM * (1 + 1e-12)
    assert far.max() < 50 * MM * (1 + 1e-4)
    assert np.hypot(*middles[1].T).min() > 20 * MM * (1 - 2e-4)


@pytest.mark.parametrize(
    ("unit", "millimetres"), [(1, 25.4), (2, 304.8), (4, 1), (5, 10), (6, 1000), (9, 0.0254)]
)
def test_units_of_a_drawing_count(unit: int, millimetres: float) -> None:
    (part,) = parts(lambda space: space.add_circle((3, 3), 2), unit=unit)
    assert area_mm2(part) == pytest.approx(4 * math.pi * millimetres**2)


def test_a_drawing_without_a_unit_is_in_mm_or_as_it_measures(
    caplog: pytest.LogCaptureFixture,
) -> None:
    document = drawing(lambda space: space.add_circle((0, 0), 2), unit=0)
    document.header["$MEASUREMENT"] = 1
    assert area_mm2(cad_parts(read_drawing(data_of(document)))[0]) == pytest.approx(4 * math.pi)
    assert "states no unit; it is taken for mm" in caplog.text
    document.header["$MEASUREMENT"] = 0
    assert area_mm2(cad_parts(read_drawing(data_of(document)))[0]) == pytest.approx(
        4 * math.pi * 25.4**2
    )
    assert "it is taken for inches" in caplog.text


def test_old_polylines_with_bulges(caplog: pytest.LogCaptureFixture) -> None:
    corners = [(0, 0, 0), (20, 0, 1), (20, 10, 0), (0, 10, 1)]
    (part,) = parts(
        lambda space: space.add_polyline2d(corners, format="xyb", close=True), version="R12"
    )
    assert area_mm2(part) == pytest.approx(200 + math.pi * 25)
    assert "it is taken for mm" in caplog.text


def test_ellipses_and_splines_become_arcs_within_a_millionth() -> None:
    (part,) = parts(lambda space: space.add_ellipse((5, 5), (30, 10), 0.4))
    (line,) = part.cut
    assert area_mm2(part) == pytest.approx(math.pi * 0.4 * 1000, rel=1e-6)
    # In the frame of its axes.
    turn = math.atan2(10, 30)
    points = line.flattened(1e-6) / MM * (1, -1) - (5, 5)
    x = points @ (math.cos(turn), math.sin(turn)) / math.sqrt(1000)
    y = points @ (-math.sin(turn), math.cos(turn)) / (0.4 * math.sqrt(1000))
    assert np.abs(np.hypot(x, y) - 1).max() < 1e-6
    controls = [(0, 0), (40, -10), (50, 30), (10, 60), (-20, 30), (0, 0)]
    document = drawing(lambda space: space.add_open_spline(controls))
    (round_one,) = cad_parts(read_drawing(data_of(document)))
    (spline,) = document.modelspace()
    tool = spline.construction_tool()  # type: ignore[attr-defined]
    truth = np.array([(point.x, point.y) for point in tool.approximate(20_000)])
    flat = shapely.LinearRing(round_one.cut[0].flattened(1e-6) / MM * (1, -1))
    shapely.prepare(flat)
    assert shapely.dwithin(flat, shapely.points(truth), 2e-5).all()
    assert len(round_one.cut[0].points) < 500


def test_blocks_are_put_in_their_places_stretched_and_mirrored() -> None:
    document = ezdxf.new(units=4)
    block = document.blocks.new("HOLE")
    block.add_circle((1, 0), 1)
    frame = document.blocks.new("FRAME")
    frame.add_lwpolyline([(0, 0), (50, 0), (50, 30), (0, 30)], close=True)
    frame.add_blockref("HOLE", (10, 10))
    frame.add_blockref("HOLE", (30, 10), {"xscale": 2.0, "yscale": -1.0})
    document.modelspace().add_blockref("FRAME", (7, 7), {"rotation": 30, "xscale": -1.0})
    (part,) = cad_parts(read_drawing(data_of(document)))
    assert area_mm2(part) == pytest.approx(1500 - math.pi - 2 * math.pi, rel=1e-8)
    assert len(part.cut) == 3


def test_rows_of_a_block_are_as_many_parts() -> None:
    document = ezdxf.new(units=4)
    document.blocks.new("DISC").add_circle((0, 0), 1)
    rows = {"row_count": 3, "column_count": 4, "row_spacing": 5, "column_spacing": 5}
    document.modelspace().add_blockref("DISC", (0, 0), rows)
    assert len(cad_parts(read_drawing(data_of(document)))) == 12


def test_entities_seen_from_below_are_mirrored() -> None:
    below = {"extrusion": (0, 0, -1)}
    (part,) = parts(
        lambda space: space.add_lwpolyline(
            [(0, 0, 0), (10, 0, 0.5), (10, 5, 0)], format="xyb", close=True, dxfattribs=below
        )
    )
    assert area_mm2(part) > 25
    assert part.region.bounds[0] < -11 * MM


def test_each_outline_is_an_item_and_rings_inside_are_holes(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        for radius in (20, 15, 10, 5):
            space.add_circle((0, 0), radius)
        space.add_circle((50, 0), 4)

    drawing(draw).saveas(tmp_path / "rings.dxf")
    items = read_items(tmp_path / "rings.dxf", holes="keep").items
    assert [item.name for item in items] == ["rings 1", "rings 2", "rings 3"]
    areas = [item.outline.area / MM**2 / math.pi for item in items]
    assert areas == pytest.approx([400 - 225, 100 - 25, 16], rel=1e-3)
    filled = read_items(tmp_path / "rings.dxf").items
    assert filled[0].outline.area / MM**2 / math.pi == pytest.approx(400, rel=1e-4)
    assert filled[0].ink.has_holes
    assert all(np.hypot(*item.outline.centroid) < 1e-9 for item in items)
    art = items[0].art
    assert isinstance(art, LineArt)
    assert [len(line.points) for line in art.cut] == [2, 2]


def test_a_plate_may_have_thousands_of_holes() -> None:
    def draw(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (99, 0), (99, 99), (0, 99)], close=True)
        for k in range(1500):
            space.add_circle((1 + k % 40 * 2, 1 + k // 40 * 2), 0.5)

    (part,) = parts(draw)
    assert len(part.cut) == 1501


def test_the_drawing_of_an_item_covers_its_outline(
    tmp_path: Path, art_iou: Callable[..., float]
) -> None:
    drawing(plate).saveas(tmp_path / "plate.dxf")
    (item,) = read_items(tmp_path / "plate.dxf", holes="keep").items
    assert art_iou(item) > 0.995


def test_a_container_lies_within_its_curves_in_mm(tmp_path: Path) -> None:
    def draw(space: Modelspace) -> None:
        space.add_lwpolyline(
            [(0, 0, -0.3), (100, 0, 0), (100, 60, 0.3), (0, 60, 0)], format="xyb", close=True
        )
        space.add_circle((50, 40), 10)

    drawing(draw, unit=5).saveas(tmp_path / "hide.dxf")
    container = read_container(tmp_path / "hide.dxf")
    assert container.unit == "mm"
    assert container.width == pytest.approx(1000)
    (part,) = cad_parts(read_drawing((tmp_path / "hide.dxf").read_bytes()))
    true = Outline.from_rings([
        line.flattened(1e-5) / MM for line in part.cut
    ]).region  # fmt: skip
    left, top, _, _ = true.bounds
    moved = shapely.affinity.translate(true, -left, -top)
    region = container.outline.region
    assert shapely.difference(region, moved).area < 1e-4 * region.length
    assert moved.area - region.area < 2e-5 * 1000 * region.length
    assert read_container(tmp_path / "hide.dxf", 300.0).width == 300


def test_a_frame_around_all_parts_is_told_and_is_none(caplog: pytest.LogCaptureFixture) -> None:
    def draw(space: Modelspace) -> None:
        for x in (10, 100):
            space.add_lwpolyline(
                [(x, 10), (x + 50, 10), (x + 50, 60), (x, 60)], close=True,
                dxfattribs={"layer": "Cut"},
            )  # fmt: skip
        space.add_circle((35, 35), 5, dxfattribs={"layer": "Cut"})
        for edge in (0, 5):
            corners = [(edge, edge), (210 - edge, edge), (210 - edge, 90), (edge, 90)]
            space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "Rahmen_A4"})

    assert len(parts(draw)) == 2
    assert "left out: 2 around all else on layer 'Rahmen_A4' (a frame;" in caplog.text


@pytest.mark.parametrize(
    ("layer", "inner", "rings", "is_told"),
    [
        ("FRAME", [((20, 30), 8), ((80, 30), 8)], 3, True),
        ("FRAME", [((50, 30), 20), ((50, 30), 8)], 2, True),
        ("bike_subframe", [((20, 30), 8), ((80, 30), 8)], 3, False),
        ("bike_subframe", [((30, 30), 18), ((30, 30), 8), ((80, 30), 8)], 3, False),
    ],
)
def test_the_contour_of_a_part_is_no_frame(
    layer: str, inner: list[tuple[tuple[int, int], int]], rings: int, is_told: bool,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    def draw(space: Modelspace) -> None:
        corners = [(0, 0), (100, 0), (100, 60), (0, 60)]
        space.add_lwpolyline(corners, close=True, dxfattribs={"layer": layer})
        for middle, radius in inner:
            space.add_circle(middle, radius, dxfattribs={"layer": "HOLES"})

    assert len(max(parts(draw), key=area_mm2).cut) == rings
    assert ("layer 'FRAME': the outline around all else is taken" in caplog.text) == is_told
    assert "left out" not in caplog.text


@pytest.mark.parametrize("place", [(60.0, 20.0), (300.0, 20.0)])
def test_a_part_on_a_layer_called_frame_stays_one(place: tuple[float, float]) -> None:
    def draw(space: Modelspace) -> None:
        corners = [(0, 0), (100, 0), (100, 50), (0, 50)]
        space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "Frame"})
        if place[0] > 100:
            space.add_circle(place, 5, dxfattribs={"layer": "Cut"})
        else:
            space.add_circle(place, 5, dxfattribs={"layer": "Frame"})

    assert len(parts(draw)) == (2 if place[0] > 100 else 1)


def test_layers_and_open_lines_are_engraved(caplog: pytest.LogCaptureFixture) -> None:
    def draw(space: Modelspace) -> None:
        plate(space)
        mark = {"layer": "Engrave_deep"}
        space.add_circle((40, 7.5), 4, dxfattribs=mark)
        space.add_line((30, 7.5), (200, 7.5), dxfattribs=mark)
        space.add_line((300, 0), (400, 0), dxfattribs=mark)
        space.add_line((5, 5), (15, 5))
        space.add_text("A1", dxfattribs=mark)
        space.add_line((-9, 9), (99, 9), dxfattribs={"linetype": "CENTER"})

    (part,) = parts(draw)
    assert len(part.cut) == 3
    ring, *lines = part.engraved
    assert ring.bulges.tolist() == [-1, -1]
    lengths = sorted(float(np.hypot(*(line.points[-1] - line.points[0]))) / MM for line in lines)
    # The line over the hole is in two, none beyond the edge.
    assert lengths == pytest.approx([7, 10, 37], abs=0.01)
    for said in ("1 open line inside parts", "1 TEXT", "1 engraved beyond an edge",
                 "1 to engrave beside all parts", "1 hidden or construction"):  # fmt: skip
        assert said in caplog.text


def test_colours_of_layer_0_of_blocks_and_of_layers_so_called_are_engraved(tmp_path: Path) -> None:
    drawing = ezdxf.new(units=4)
    drawing.layers.get("0").color = 1
    drawing.layers.add("Plate", color=7)
    drawing.layers.add("Marks", color=1)
    drawing.layers.add("Red", color=7)
    space = drawing.modelspace()
    outline = [(0, 0), (60, 0), (60, 40), (0, 40)]
    space.add_lwpolyline(outline, close=True, dxfattribs={"layer": "Plate"})
    space.add_circle((10, 10), 2)
    space.add_circle((20, 10), 2, dxfattribs={"layer": "Red"})
    drawing.blocks.new("mark").add_circle((0, 0), 2, dxfattribs={"layer": "Plate", "color": 0})
    space.add_blockref("mark", (30, 10), dxfattribs={"layer": "Marks"})
    drawing.saveas(tmp_path / "plate.dxf")
    engraving = Engraving(["red"])
    (part,) = cad_parts(read_drawing((tmp_path / "plate.dxf").read_bytes()), engraving)
    engraving.check_met()
    assert (len(part.cut), len(part.engraved)) == (1, 3)


def test_what_is_by_layer_on_layer_0_of_a_block_takes_the_layer_of_its_insert() -> None:
    """As the DXF reference has it: by block is the insert's own colour, by layer its layer's."""
    document = ezdxf.new(units=4)
    document.layers.get("0").color = 6
    document.layers.add("Blue", color=5)
    inner = document.blocks.new("inner")
    for k, own in enumerate(({}, {"color": 0}, {"color": 3}, {"layer": "Blue"})):
        inner.add_line((k, 0), (k, 1), {"layer": "0", **own})
    document.blocks.new("outer").add_blockref("inner", (0, 0), {"layer": "0", "color": 0})
    for k, name in enumerate(("inner", "outer")):
        document.modelspace().add_blockref(name, (0, 9 * k), {"layer": "Blue", "color": 1})
        document.modelspace().add_blockref(name, (90, 9 * k), {"layer": "0"})
    stream = io.StringIO()
    document.write(stream)
    found = [one.colour for one in read_drawing(stream.getvalue().encode()).pieces]
    red, green, blue, magenta = "#ff0000", "#00ff00", "#0000ff", "#ff00ff"
    assert found == 2 * [blue, red, green, blue, magenta, magenta, green, blue]


def test_layers_that_are_off_are_left_out() -> None:
    document = drawing(plate)
    document.layers.add("NOTES").off()
    for layer in ("NOTES", "Defpoints", "Construction"):
        document.modelspace().add_line((0, -9), (9, -9), {"layer": layer})
    assert len(cad_parts(read_drawing(data_of(document)))) == 1


def test_what_lies_twice_is_taken_once(caplog: pytest.LogCaptureFixture) -> None:
    def draw(space: Modelspace) -> None:
        plate(space)
        space.add_line((80, 0), (0, 0))
        space.add_circle((10, 40), 3)

    (part,) = parts(draw)
    assert len(part.cut) == 3
    assert "1 outline that lay on another was taken once" in caplog.text


def opened(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (9, 0), (9, 9), (0, 0.3)], dxfattribs={"layer": "CUT"})


def speckled(space: Modelspace) -> None:
    space.add_circle((0, 0), 5)
    space.add_circle((7, 4), 1e-4, {"layer": "TRIM"})


def crossing(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (8, 8), (8, 0), (0, 8)], close=True, dxfattribs={"layer": "CUT"})


def overlapping(space: Modelspace) -> None:
    space.add_circle((0, 0), 5, {"layer": "A"})
    space.add_circle((5, 0), 5, {"layer": "B"})


def branching(space: Modelspace) -> None:
    for x in (0, 10):
        for start, end in (
            ((0, 0), (10, 0)),
            ((10, 0), (10, 9)),
            ((10, 9), (0, 9)),
            ((0, 9), (0, 0)),
        ):
            space.add_line((x + start[0], start[1]), (x + end[0], end[1]), {"layer": "CUT"})


def endless(space: Modelspace) -> None:
    document = space.doc
    assert document is not None
    for one, other in ("AB", "BA"):
        document.blocks.new(one)
        document.blocks[one].add_blockref(other, (0, 0))
    space.add_blockref("A", (0, 0))


def doubling(space: Modelspace) -> None:
    document = space.doc
    assert document is not None
    document.blocks.new("B0").add_circle((0, 0), 1)
    for k in range(40):
        block = document.blocks.new(f"B{k + 1}")
        block.add_blockref(f"B{k}", (0, 0))
        block.add_blockref(f"B{k}", (3, 0))
    space.add_blockref("B40", (0, 0))


TIGHT = {"row_spacing": 3, "column_spacing": 3}


def rows(space: Modelspace) -> None:
    assert space.doc is not None
    space.doc.blocks.new("DISC").add_circle((0, 0), 1)
    space.add_blockref("DISC", (0, 0), {**TIGHT, "row_count": 30_000, "column_count": 30_000})


def concentric(space: Modelspace) -> None:
    for k in range(600):
        space.add_circle((0, 0), 1 + k / 100)


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (concentric, "has 600 outlines inside one another"),
        (lambda space: None, "holds no outline; export lines and curves"),
        (lambda space: space.add_text("A"), "holds no outline, but 1 TEXT"),
        (opened, "layer 'CUT': the LWPOLYLINE at (0, 0) is open; the next end is 0.3 away"),
        (crossing, "layer 'CUT': the LWPOLYLINE crosses or meets itself at (4, 4)"),
        (overlapping, "layer 'B': the CIRCLE crosses another one, on layer 'A', at (2.5, "),
        (branching, "layer 'CUT': 3 lines meet at (10, 0), so that no outline is clear"),
        (lambda space: space.add_lwpolyline([(0, 0), (5, 0)], close=True), "has no area"),
        (
            lambda space: space.add_circle((0, 0), 5, {"layer": "etch"}),
            "to engrave alone, on layer 'etch' in #",
        ),
        (speckled, "layer 'TRIM': the CIRCLE at (7.0001, 4) is a part of 0.0002 mm; take it out"),
        (lambda space: space.add_circle((1e12, 0), 1), "beyond 1e+09"),
        (lambda space: space.add_blockref("NONE", (0, 0)), "holds no outline"),
        (endless, "that holds itself"),
        (doubling, "has more than 400,000 points"),
        (rows, "inserts blocks more than 10,000 times"),
    ],
)
def test_what_cannot_be_cut_is_one_line(draw: Draw, said: str, tmp_path: Path) -> None:
    drawing(draw).saveas(tmp_path / "a.dxf")
    with pytest.raises(ReadError) as caught:
        read_dxf(tmp_path / "a.dxf", "keep")
    assert said in str(caught.value)
    assert str(caught.value).startswith(f"{tmp_path / 'a.dxf'}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"AC1032\0\0\0", "is a DWG"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "is a binary DXF"),
        (b"<svg/>", "is no DXF that can be read"),
        (b"", "holds no outline"),
        (b"0\n" * (entities.MOST_LINES + 2), "lines of text"),
    ],
)
def test_what_is_no_dxf_is_one_line(data: bytes, said: str) -> None:
    with pytest.raises(UnfitError, match=said):
        cad_parts(read_drawing(data))


def test_far_too_many_points_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entities, "MOST_POINTS", 50)
    with pytest.raises(UnfitError, match="has more than 50 points"):
        parts(lambda space: space.add_lwpolyline([(x, x % 7) for x in range(51)], close=True))


def test_references_to_other_files_are_not_followed(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "other.dxf").write_bytes(data_of(drawing(plate)))
    document = drawing(plate)
    document.add_xref_def(str(tmp_path / "other.dxf"), "OTHER")
    document.modelspace().add_blockref("OTHER", (200, 0))
    picture = document.add_image_def(str(tmp_path / "a.png"), (9, 9))
    document.modelspace().add_image(picture, (0, 0), (9, 9))
    document.saveas(tmp_path / "a.dxf")
    monkeypatch.setattr(ezdxf, "readfile", None)
    assert len(read_dxf(tmp_path / "a.dxf", "keep")) == 1
    assert "1 INSERT of another drawing" in caplog.text
    assert "1 IMAGE" in caplog.text


def test_without_the_package_that_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.dxf").write_bytes(data_of(drawing(plate)))
    monkeypatch.setitem(__import__("sys").modules, "ezdxf", None)
    with pytest.raises(ReadError, match=r"needs the package ezdxf; .*packwork.dxf"):
        read_dxf(tmp_path / "a.dxf")


corner = st.tuples(st.floats(5, 50), st.floats(-0.4, 0.4))


@given(
    corners=st.lists(corner, min_size=3, max_size=9),
    turn=st.floats(0, 6), x=st.floats(-1e4, 1e4), as_pieces=st.booleans(),
)  # fmt: skip
@settings(deadline=None, max_examples=30)
def test_rings_of_lines_and_arcs_come_back(
    corners: list[tuple[float, float]], turn: float, x: float, as_pieces: bool
) -> None:
    """Stars of any radii: joined from pieces or in one, the same points and bulges."""
    turns = turn + 2 * np.pi * np.arange(len(corners)) / len(corners)
    radii, bulges = np.array(corners).T
    bulges = np.where(np.abs(bulges) < 1e-3, 0, bulges)
    points = radii[:, None] * np.column_stack([np.cos(turns), np.sin(turns)]) + (x, 7)
    ring = ArcLine(points, bulges, is_closed=True)
    flat = shapely.Polygon(ring.flattened(1e-3))
    if not flat.is_valid or shapely.minimum_clearance(flat) < 0.1:
        return

    def draw(space: Modelspace) -> None:
        rows = np.column_stack([points, bulges])
        if not as_pieces:
            space.add_lwpolyline(rows, format="xyb", close=True)
            return
        for k in range(len(rows)):
            side = np.array([rows[k], rows[(k + 1) % len(rows)]])
            space.add_lwpolyline(side[:: 1 if k % 2 else -1] * (1, 1, 0) + [
                (0, 0, side[0, 2] if k % 2 else -side[0, 2]), (0, 0, 0)
            ], format="xyb")  # fmt: skip

    (part,) = parts(draw)
    (found,) = part.cut
    back = found.mapped(np.array([[1 / MM, 0, 0], [0, -1 / MM, 0]]), 0.0)
    apart = np.hypot(*(back.points[:, None] - points[None]).transpose(2, 0, 1))
    assert apart.min(axis=1).max() < 1e-9 * max(abs(x), 100)
    assert len(back.points) == len(points)
    assert abs(area_mm2(part)) == pytest.approx(abs(_area(ring)), rel=1e-7)


VALID = data_of(drawing(plate, version="R12")).split(b"\n")
ENTITIES = VALID.index(b"ENTITIES")


@given(
    edits=st.lists(st.tuples(
        st.integers(ENTITIES, len(VALID) - 1),
        st.sampled_from(
            [b"nan", b"inf", b"-1", b"0", b"1e308", b"", b"abc", b"10", b"LINE", b"999999"]
        ),
    ), max_size=6)
)  # fmt: skip
@settings(deadline=None, max_examples=30)
def test_any_change_of_tags_gives_parts_or_one_line(edits: list[tuple[int, bytes]]) -> None:
    lines = list(VALID)
    for place, text in edits:
        lines[place] = text
    parts_or_one_line(b"\n".join(lines))


@given(st.binary(max_size=200))
@settings(deadline=None, max_examples=30)
def test_any_bytes_give_parts_or_one_line(data: bytes) -> None:
    parts_or_one_line(data)


def parts_or_one_line(data: bytes) -> None:
    logging.getLogger("packwork").setLevel(logging.CRITICAL)
    found, refused = list[CadPart](), ""
    try:
        found = cad_parts(read_drawing(data))
    except UnfitError as refusal:
        refused = str(refusal)
    finally:
        logging.getLogger("packwork").setLevel(logging.NOTSET)
    assert bool(found) != bool(refused)
    assert "\n" not in refused
    assert all(part.region.is_valid and part.region.area > 0 for part in found)


def test_flaws_that_were_mended_are_told(caplog: pytest.LogCaptureFixture) -> None:
    def draw(space: Modelspace) -> None:
        plate(space)
        space.add_blockref("NONE", (0, 0))

    assert len(parts(draw)) == 1
    assert "is damaged; 1 flaw was mended" in caplog.text


def test_flaws_beside_the_lines_are_not_told(caplog: pytest.LogCaptureFixture) -> None:
    def draw(space: Modelspace) -> None:
        plate(space)
        space[0].dxf.linetype = "NONE"
        # As in all files that Inkscape writes.
        assert space.doc is not None
        space.doc.rootdict._data["STANDARD"] = "FFFF"

    assert len(parts(draw)) == 1
    assert "damaged" not in caplog.text

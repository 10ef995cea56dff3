"""Parts from DXFs on sheets that are DXFs: units, true curves, layers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from typer.testing import Result

import packwork as pw
from packwork.geometry.arcs import ArcLine
from packwork.readers.layouts.dxf import lines_of, tags_of

Command = Callable[..., Result]


@pytest.fixture
def shop(folder: Path) -> Path:
    """A washer, an oblong hole, and a mark, of mm; a disc of inches."""
    washer = ezdxf.new(units=4)
    space = washer.modelspace()
    space.add_circle((100, 50), 12)
    space.add_circle((100, 50), 4.25)
    space.add_lwpolyline([(92, 48, 0), (93, 48, 1), (93, 50, 0), (92, 50, 1)], "xyb", close=True)
    space.add_arc((100, 50), 8, 20, 110, dxfattribs={"layer": "ETCH"})
    (folder / "parts").mkdir()
    washer.saveas(folder / "parts" / "washer.dxf")
    disc = ezdxf.new(units=1)
    disc.modelspace().add_circle((0, 0), 0.5)
    disc.saveas(folder / "disc.dxf")
    return folder


def circles_of(path: Path) -> list[tuple[float, float, float]]:
    """Centre and radius of each circle that is cut."""
    found = ezdxf.readfile(path).modelspace().query('CIRCLE[layer=="cut"]')
    return [(one.dxf.center.x, one.dxf.center.y, one.dxf.radius) for one in found]


def bent(path: Path, layer: str) -> list[np.ndarray]:
    """Rows x, y and bulge of each line of a layer."""
    lines = ezdxf.readfile(path).modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
    return [np.array(line.get_points("xyb")) for line in lines]  # type: ignore[attr-defined]


def radii(rows: np.ndarray) -> np.ndarray:
    """Radius of each arc of a closed line."""
    sides = np.hypot(*(np.roll(rows[:, :2], -1, axis=0) - rows[:, :2]).T)
    with np.errstate(divide="ignore"):
        return np.asarray(sides * (1 + rows[:, 2] ** 2) / (4 * np.abs(rows[:, 2])))


def test_circles_stay_circles_to_a_millionth_of_a_millimetre(shop: Path, packwork: Command) -> None:
    result = packwork("nest 200x100mm parts*5 --rotate free --kerf 1mm --passes 300 -o a.dxf")
    assert result.exit_code == 0, result.output
    assert len(bent(shop / "a.dxf", "cut")) == 5
    circles = np.array(circles_of(shop / "a.dxf"))
    assert sorted(circles[:, 2]) == pytest.approx([4.25] * 5 + [12] * 5, abs=1e-6)
    centres = circles[:, :2]
    pairs = zip(centres[::2], centres[1::2], strict=True)
    assert max(float(np.hypot(*(one - other))) for one, other in pairs) < 1e-6
    marks = bent(shop / "a.dxf", "ETCH")
    assert len(marks) == 5
    for mark, centre in zip(marks, centres[::2], strict=True):
        assert np.hypot(*(mark[:, :2] - centre).T) == pytest.approx([8] * 3, abs=1e-6)
    assert packwork("measure a.dxf").exit_code == 0


@pytest.mark.parametrize(
    ("sheet", "unit", "radius"),
    [("4x3in", 1, 12 / 25.4), ("10x8cm", 5, 1.2), ("100x80mm", 4, 12)],
)
def test_parts_are_as_large_on_sheets_of_any_unit(
    shop: Path, packwork: Command, sheet: str, unit: int, radius: float
) -> None:
    result = packwork(f"nest {sheet} parts disc.dxf --passes 300 -o a.dxf -o a.geojson")
    assert result.exit_code == 0, result.output
    assert ezdxf.readfile(shop / "a.dxf").header["$INSUNITS"] == unit
    share = radius / 12
    found = [round(one / share, 6) for *_, one in circles_of(shop / "a.dxf")]
    assert found == [12, 4.25, 12.7]
    areas = pw.Layout.load(shop / "a.geojson").areas / share**2
    assert areas[1] == pytest.approx(np.pi * 12.7**2, rel=1e-4)


def test_what_a_drawing_shows_is_on_pictures_and_drawings_too(
    shop: Path, packwork: Command
) -> None:
    result = packwork("nest 100x60mm parts*2 --passes 300 -o a.svg -o a.pdf")
    assert result.exit_code == 0, result.output
    assert "certified" in result.output
    assert 'inkscape:label="ETCH"' in (shop / "a.svg").read_text(encoding="utf-8")
    assert packwork("measure a.svg").exit_code == 0


def test_a_file_that_cannot_be_cut_is_one_line(shop: Path, packwork: Command) -> None:
    open_one = ezdxf.new(units=4)
    open_one.modelspace().add_lwpolyline([(0, 0), (9, 0), (9, 9)], dxfattribs={"layer": "CUT"})
    open_one.saveas(shop / "open.dxf")
    result = packwork("nest 100x60mm open.dxf*3 --passes 5 -o a.dxf")
    assert result.exit_code == 2
    assert "open.dxf: layer 'CUT': the LWPOLYLINE at (0, 0) is open" in result.output
    assert result.output.count("\n") == 1
    assert not (shop / "a.dxf").exists()


def test_icons_may_be_dxfs_as_well(shop: Path, packwork: Command) -> None:
    result = packwork("fill circle parts -n 6 --effort draft --levels 50 -o a.dxf")
    assert result.exit_code == 0, result.output
    assert packwork("measure a.dxf").exit_code == 0


def test_a_sheet_may_be_a_dxf(shop: Path, packwork: Command) -> None:
    hide = ezdxf.new(units=5)
    hide.modelspace().add_ellipse((0, 0), (6, 0), 0.6)
    hide.modelspace().add_circle((2, 0), 0.5)
    hide.saveas(shop / "hide.dxf")
    result = packwork("nest hide.dxf parts*4 --rotate none --passes 300 -o a.dxf")
    assert result.exit_code == 0, result.output
    layout = pw.Layout.load(shop / "a.dxf")
    assert (layout.container.width, layout.container.unit) == (pytest.approx(120), "mm")
    assert packwork("measure a.dxf").exit_code == 0


def hook(folder: Path) -> None:
    """A part that is another one turned over."""
    document = ezdxf.new(units=4)
    corners = [(0, 0, 0), (30, 0, 0.4), (30, 8, 0), (8, 8, 0), (8, 20, 0), (0, 20, 0)]
    document.modelspace().add_lwpolyline(corners, "xyb", close=True)
    document.saveas(folder / "hook.dxf")


def is_turned(points: np.ndarray) -> bool:
    """Whether the shorter neighbour of its longest side comes before that, counter-clockwise."""
    ring = points if shapely.is_ccw(shapely.LinearRing(points)) else points[::-1]
    sides = np.hypot(*(np.roll(ring, -1, axis=0) - ring).T)
    first = int(sides.argmax())
    return bool(sides[first - 1] < sides[(first + 1) % len(sides)])


def test_parts_that_are_turned_over_are_written_so(shop: Path, packwork: Command) -> None:
    hook(shop)
    found = 0
    for seed in range(3):
        line = f"nest 40mm hook.dxf*9 --mirror --kerf 1mm --passes 100 --seed {seed}"
        result = packwork(f"{line} -o a.dxf -o a.geojson")
        assert result.exit_code == 0, result.output
        layout, turned = pw.Layout.load(shop / "a.geojson"), 0
        for rows, outline in zip(bent(shop / "a.dxf", "cut"), layout.outlines, strict=True):
            line_there = ArcLine(rows[:, :2] * (1, -1) + (0, 40), -rows[:, 2], is_closed=True)
            true = shapely.Polygon(line_there.flattened(1e-4))
            assert shapely.symmetric_difference(true, outline.region).area < 0.05
            turned += is_turned(rows[:, :2])
        assert turned == len(layout.manifest["nest"]["mirrored"])
        found += turned
    assert 0 < found < 27


def test_more_parts_go_on_a_sheet_that_is_a_dxf_of_ours(shop: Path, packwork: Command) -> None:
    hook(shop)
    assert packwork("nest 120x60mm parts*2 --passes 100 -o a.dxf").exit_code == 0
    result = packwork("nest a.dxf hook.dxf --passes 900 -o b.dxf")
    assert result.exit_code == 0, result.output
    assert packwork("measure b.dxf").exit_code == 0
    assert len(bent(shop / "b.dxf", "cut")) == 3


def test_parts_that_lie_on_a_sheet_are_written_again_as_they_were(
    shop: Path, packwork: Command
) -> None:
    hook(shop)
    line = "nest 120x60mm parts*2 hook.dxf --rotate free --passes 200 -o a.dxf"
    assert packwork(line).exit_code == 0
    result = packwork("nest a.dxf hook.dxf --passes 900 -o b.dxf -o b.svg")
    assert result.exit_code == 0, result.output
    before, after = (lines_of(tags_of((shop / f"{k}.dxf").read_text("cp1252"))) for k in "ab")
    assert {one.layer for one in before} == {"container", "cut", "ETCH"}
    for old, new in zip(before[1:], after[1:], strict=False):
        assert (old.layer, old.line.is_closed) == (new.layer, new.line.is_closed)
        assert new.line.points == pytest.approx(old.line.points, abs=1e-6)
        assert new.line.bulges == pytest.approx(old.line.bulges, abs=1e-12)
    assert len(after) == len(before) + 1
    assert (shop / "b.svg").read_text(encoding="utf-8").count("data-item=") == 2


def test_engraved_lines_keep_colours_and_layers_of_their_own(
    folder: Path, packwork: Command
) -> None:
    drawing = ezdxf.new(units=4)
    for name, colour in (("Score", 3), ("ENGRAVE", 1), ("etch", 7), ("Etch 2", 30)):
        drawing.layers.add(name, color=colour)
    space = drawing.modelspace()
    space.add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 40)], close=True)
    for k, layer in enumerate(("Score", "ENGRAVE", "etch", "Etch 2", "Etch 2"), start=1):
        more = {"true_color": 0x2A6F97} if k == 5 else {}
        space.add_circle((10 * k, 10), k / 2, dxfattribs={"layer": layer, **more})
    drawing.saveas(folder / "plate.dxf")
    assert packwork("nest 90x90mm plate.dxf --passes 3 -o a.dxf").exit_code == 0
    # Red is for what is cut, and black is how all is drawn.
    wanted = {0.5: ("Score", (0, 255, 0)), 1: ("engrave", None), 1.5: ("etch", None),
              2: ("Etch 2", (255, 127, 0)), 2.5: ("Etch 2", (42, 111, 151))}  # fmt: skip
    for earlier, name in (("90x90mm", "a.dxf"), ("a.dxf", "b.dxf")):
        if name == "b.dxf":
            assert packwork(f"nest {earlier} plate.dxf --passes 900 -o {name}").exit_code == 0
        document = ezdxf.readfile(folder / name)
        assert {"cut", "engrave"} <= {layer.dxf.name for layer in document.layers}
        for one in document.modelspace().query('CIRCLE[layer!="cut"]'):
            layer, colour = wanted[round(one.dxf.radius, 6)]
            assert one.dxf.layer == layer
            assert document.layers.get(layer).dxf.color == 5
            assert one.dxf.color != 1
            assert (one.dxf.color == 256) is (colour is None)
            if colour is not None:
                assert (one.rgb or ezdxf.colors.aci2rgb(one.dxf.color)) == colour
    assert packwork("measure a.dxf").exit_code == 0


def test_colours_and_layers_that_are_named_are_engraved(folder: Path, packwork: Command) -> None:
    drawing = ezdxf.new(units=4)
    drawing.layers.add("inner", color=1)
    drawing.layers.add("other", color=4)
    mark = drawing.blocks.new("mark")
    mark.add_circle((0, 0), 2, dxfattribs={"color": 0})
    space = drawing.modelspace()
    space.add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 40)], close=True)
    space.add_circle((50, 30), 3)
    space.add_circle((10, 10), 4, dxfattribs={"layer": "inner"})
    space.add_circle((25, 10), 5, dxfattribs={"layer": "other", "true_color": 0x00AAFF})
    space.add_circle((40, 10), 6, dxfattribs={"layer": "other"})
    space.add_blockref("mark", (10, 30), dxfattribs={"color": 3})
    drawing.saveas(folder / "plate.dxf")
    for asked, engraved in [
        ("red", [4]), ("lime", [2]), ("#0af", [5]), ("OTHER", [5, 6]),
        ("red --engrave cyan", [4, 6]),
    ]:  # fmt: skip
        result = packwork(f"nest 90x60mm plate.dxf --passes 3 --engrave {asked} -o a.dxf")
        assert result.exit_code == 0, result.output
        of_layer = {
            layer: sorted(
                one.dxf.radius
                for one in ezdxf.readfile(folder / "a.dxf").modelspace().query("CIRCLE")
                if one.dxf.layer == layer
            )
            for layer in ("cut", "other" if asked == "OTHER" else "engrave")
        }
        cut, others = of_layer.values()
        assert others == pytest.approx(engraved)
        assert sorted(cut + others) == pytest.approx([2, 3, 4, 5, 6])
    result = packwork("nest 90x60mm plate.dxf --passes 3 --engrave green -o b.dxf")
    assert result.exit_code == 2
    assert "no part has lines in the colour or on the layer 'green'; others have" in result.output
    assert "#00ff00" in result.output
    assert not (folder / "b.dxf").exists()

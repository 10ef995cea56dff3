"""Measures of one layout are the same in every format, however wild its shapes are."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.geometry.polygon import Region
from packwork.metrics.exact import exact_metrics
from packwork.readers.layouts.read import read_written
from packwork.readers.svg.container import container_of_svg
from packwork.readers.svg.item import item_of_svg
from packwork.recipe.piles import Side
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.uses.piles.opening import opened
from packwork.writers import write
from packwork.writers.registry import WriteOptions
from packwork.writers.svg import SvgOptions
from scenes import box, flat_item, poses, square, square_container

FORMATS = ("geojson", "svg", "dxf")


def jug(mouth: float, lip: float, tilt: float) -> Region:
    """A vessel of extent 10 with a mouth so wide at its top, its lips so deep, turned."""
    inside = shapely.affinity.rotate(shapely.box(-3, -3, 3, 3), 20)
    neck = shapely.Polygon([(-mouth / 2, -9), (mouth / 2, -9), (lip, 0), (-lip, 0)])
    return shapely.affinity.rotate(shapely.box(-5, -5, 5, 5) - inside - neck, tilt, origin=(0, 0))


def drawing(region: Region) -> bytes:
    data = "".join(
        "M" + "L".join(f"{x!r} {y!r}" for x, y in shapely.get_coordinates(ring).tolist()) + "Z"
        for part in shapely.get_parts(region)
        for ring in (part.exterior, *part.interiors)
    )
    box_text = "-8 -8 16 16"
    return f'<svg viewBox="{box_text}"><path fill-rule="evenodd" d="{data}"/></svg>'.encode()


def covered(layout: Layout) -> list[float]:
    """Share that is covered, as each format's file has it."""
    found = []
    with TemporaryDirectory() as folder:
        for ending in FORMATS:
            file = Path(folder, f"a.{ending}")
            write(layout, file)
            written = read_written(file)
            exact = exact_metrics(written.outlines, written.container.outline)
            assert exact.overlap_area == exact.outside_area == 0
            found.append(exact.coverage)
    return found


mouths = st.floats(-7, 0).map(lambda power: 10.0**power)
lips = st.floats(0, 0.5)
tilts = st.floats(0, 360)


@given(mouth=mouths, lip=lips, tilt=tilts)
@settings(max_examples=25, deadline=None)
def test_items_with_bays_that_are_all_but_closed(mouth: float, lip: float, tilt: float) -> None:
    item = item_of_svg(drawing(jug(mouth, lip, tilt)), "jug", "jug.svg")
    sheet = Container("sheet", "sheet", box(0, 0, 60, 30), 60.0, 30.0)
    places = poses([15.0, 45.0], [15.0, 15.0], [0.3, 2.0], [1.0, 1.3])
    found = covered(Layout(sheet, (item, item), places, np.ones(2)))
    assert found == pytest.approx([found[0]] * len(FORMATS), abs=1e-4)


@given(mouth=mouths, lip=lips, tilt=tilts)
@settings(max_examples=25, deadline=None)
def test_containers_with_bays_that_are_all_but_closed(
    mouth: float, lip: float, tilt: float
) -> None:
    container = container_of_svg(drawing(jug(mouth, lip, tilt)), "jug", "jug.svg")
    x, y = container.outline.region.representative_point().coords[0]
    tile = flat_item("tile", square())
    places = poses([x], [y], [0.0], [0.02 * container.side / 100])
    found = covered(Layout(container, (tile,), places, np.ones(1)))
    assert found == pytest.approx([found[0]] * len(FORMATS), rel=1e-4)


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("sides", [["top"], ["left", "right"], []])
def test_walls_of_opened_containers_come_back(
    ending: str, sides: list[Side], tmp_path: Path
) -> None:
    closed = Container("tile", "tile", box(30, 20, 70, 80), 100.0, 100.0, "mm")
    container = opened(closed, sides, None, 50.0).container
    layout = Layout(container, (flat_item("tile", square()),), poses([50.0], [50.0]), np.ones(1))
    write(layout, tmp_path / f"a.{ending}", WriteOptions(svg=SvgOptions(show_container=True)))
    found = read_written(tmp_path / f"a.{ending}").container
    assert found.outline.area == pytest.approx(container.outline.area, rel=1e-6)
    if container.walls is None:
        assert found.walls is None
        return
    assert found.walls is not None
    assert len(found.walls) == len(container.walls)
    for got, expected in zip(found.walls, container.walls, strict=True):
        assert got == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("ending", ["svg", "geojson"])
def test_the_line_of_a_container_keeps_its_pen(ending: str, tmp_path: Path) -> None:
    jar = replace(opened(square_container(), ["top"], None, 50.0).container, pen=("#22304f", 1.5))
    layout = Layout(jar, (flat_item("tile", square()),), poses([50.0], [50.0]), np.ones(1))
    file = tmp_path / f"a.{ending}"
    write(layout, file)
    assert read_written(file).container.pen == ("#22304f", pytest.approx(1.5))
    write(replace(layout, container=replace(jar, pen=None)), file)
    assert read_written(file).container.pen is None


def test_pens_that_are_none_are_refused(tmp_path: Path) -> None:
    jar = replace(square_container(), pen=("#22304f", 1.5))
    write(Layout(jar, (), poses([], []), np.ones(0)), tmp_path / "a.geojson")
    text = (tmp_path / "a.geojson").read_text(encoding="utf-8")
    begin = text.index('"pen":') + len('"pen":')
    end = text.index("]", begin) + 1
    for bad in ("7", "[]", '["#22304f"]', '["ink",1]', '["#22304f",-1]', '["#22304f",1e99]'):
        (tmp_path / "b.geojson").write_text(text[:begin] + bad + text[end:], encoding="utf-8")
        with pytest.raises(ReadError, match="pen: must be a colour"):
            read_written(tmp_path / "b.geojson")


def test_numbers_of_a_drawing_that_mean_nothing_are_not_written_on(tmp_path: Path) -> None:
    jar = replace(square_container(), pen=("#22304f", 1.5))
    layout = Layout(jar, (flat_item("tile", square()),), poses([50.0], [50.0]), np.ones(1))
    write(layout, tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert 'stroke-width="1.5"' in text
    for bad in ("-5", "0"):
        file = tmp_path / "b.svg"
        file.write_text(text.replace('stroke-width="1.5"', f'stroke-width="{bad}"'), "utf-8")
        assert read_written(file).container.pen is None
    ground = '<rect id="background" fill="#ff0000" fill-opacity="nan"/>'
    file.write_text(text.replace('<g id="container"', f'{ground}<g id="container"'), "utf-8")
    assert read_written(file).ground == ""
    file.write_text(
        text.replace('data-name="tile"', 'data-name="tile" data-weight="1e99"'), "utf-8"
    )
    with pytest.raises(ReadError, match="no number from 0 to 1e"):
        read_written(file)


def test_walls_that_are_none_are_refused(tmp_path: Path) -> None:
    layout = Layout(
        opened(square_container(), ["top"], None, 50.0).container, (), poses([], []), np.ones(0)
    )
    write(layout, tmp_path / "a.geojson")
    text = (tmp_path / "a.geojson").read_text(encoding="utf-8")
    begin = text.index('"walls":') + len('"walls":')
    end = text.index("]]]", begin) + 3
    for bad in ("7", "[[1,2]]", "[[[1,2]]]", "[[[1,2],[3,null]]]", "[[[1,2],[3,1e99]]]"):
        (tmp_path / "b.geojson").write_text(text[:begin] + bad + text[end:], encoding="utf-8")
        with pytest.raises(ReadError, match="walls: must be lines"):
            read_written(tmp_path / "b.geojson")

"""One sheet, 200 x 150 mm, in every format that knows real units."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import ezdxf
import pytest
from defusedxml.ElementTree import fromstring

from packwork.errors import WriteError
from packwork.readers.container import read_container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.writers import check_output, encoded, write
from printed import read_pdf
from scenes import flat_item, poses, square


@pytest.fixture
def sheet() -> Layout:
    """A square of 30 mm, its centre 60 mm from the left and 50 mm from the top."""
    placed: Poses = poses([60.0], [50.0])
    item = flat_item("tile", square(15.0))
    return Layout(read_container("circle", "200x150mm"), (item,), placed, placed.scale)


def test_svg(sheet: Layout) -> None:
    root = fromstring(encoded(sheet, "a.svg"))
    assert (root.get("width"), root.get("height")) == ("200mm", "150mm")
    assert root.get("viewBox") == "0 0 200 150"


def test_an_svg_in_mm_is_a_container_of_that_size(sheet: Layout, tmp_path: Path) -> None:
    write(sheet, tmp_path / "a.svg")
    container = read_container(tmp_path / "a.svg")
    assert (container.width, container.height) == pytest.approx((200, 150), rel=1e-12)
    assert container.unit == "mm"
    assert container.outline.bounds == pytest.approx((45, 35, 75, 65))


def test_pdf(sheet: Layout) -> None:
    page = read_pdf(encoded(sheet, "a.pdf"))
    assert (page.width, page.height) == pytest.approx((200, 150), abs=1e-4)
    (tile,) = page.regions
    assert tile.bounds == pytest.approx((45, 35, 75, 65), abs=1e-4)


def test_dxf(sheet: Layout) -> None:
    drawing = ezdxf.read(io.StringIO(encoded(sheet, "a.dxf").decode()))
    assert drawing.header["$INSUNITS"] == 4
    assert drawing.header["$LIMMAX"] == (200, 150)
    (tile,) = drawing.modelspace().query('LWPOLYLINE[layer=="cut"]')
    assert sorted(tile.get_points("xy")) == [(45, 85), (45, 115), (75, 85), (75, 115)]


def test_geojson(sheet: Layout) -> None:
    found = json.loads(encoded(sheet, "a.geojson"))
    assert found["canvas"] == {"width": 200, "height": 150, "unit": "mm"}
    assert found["features"][1]["properties"]["x"] == 60


@pytest.mark.parametrize(("ending", "package"), [("pdf", "typst"), ("dxf", "ezdxf")])
def test_a_missing_package_is_named_before_the_run_and_at_writing(
    ending: str, package: str, sheet: Layout, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    path, told = tmp_path / f"a.{ending.upper()}", f'needs the package {package}; .*{ending}]"$'
    for act in (check_output, lambda file: write(sheet, file)):
        with pytest.raises(WriteError, match=told):
            act(path)
    assert not list(tmp_path.iterdir())
    check_output(tmp_path / "a.svg")

"""Lines for cutters: where they lie, that none meet, and how each format holds them."""

from __future__ import annotations

import ctypes
import io
import shutil
import subprocess
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pikepdf
import pypdfium2 as pdfium
import pypdfium2.raw as raw
import pytest
import shapely
from shapely import Polygon

from packwork.errors import RecipeError
from packwork.geometry.polygon import region
from packwork.readers.builtin import builtin_item
from packwork.readers.layouts.read import read_written
from packwork.readers.svg.item import item_of_svg
from packwork.scene.layout import Layout
from packwork.writers.cutting import CutOptions, cut_rings
from packwork.writers.registry import encoded, write, write_options

DOTS = (
    b'<svg viewBox="0 0 30 30"><circle cx="7" cy="8" r="5"/><circle cx="20" cy="20" r="8"/>'
    b'<path d="M20 17v3h3z" fill="white"/></svg>'
)


@pytest.fixture
def stickers(make_layout: Callable[..., Layout]) -> Layout:
    """A ring with a hole, a star, and a drawing in two parts, far apart."""
    items = (builtin_item("ring", "keep"), builtin_item("star"), item_of_svg(DOTS, "dots", "d.svg"))
    return make_layout(items, x=[15, 40, 65], y=[20, 30, 20], scale=[0.1, 0.1, 0.5])


def lines(layout: Layout, **asked: object) -> list[Polygon]:
    return [Polygon(ring) for ring in cut_rings(layout, CutOptions(**asked))]  # type: ignore[arg-type]


def test_a_silhouette_is_one_closed_line_round_each_item(stickers: Layout) -> None:
    as_they_are = lines(stickers, line="outlines")
    assert len(as_they_are) == sum(len(outline.rings) for outline in stickers.outlines) > 4
    around = lines(stickers, line="silhouette")
    assert len(around) == 3
    for shape, outline in zip(around, stickers.outlines, strict=True):
        assert shape.is_valid
        assert shape.buffer(1e-6).contains(outline.region)


def test_parts_that_cannot_be_joined_keep_a_line_each(
    stickers: Layout, caplog: pytest.LogCaptureFixture
) -> None:
    # A star between the two dots is in the way of whatever would join them.
    middle = np.array([0.5 * sum(stickers.outlines[2].bounds[k::2]) for k in (0, 1)])
    places = {"x": np.array([15, middle[0], 65.0]), "y": np.array([20, middle[1], 20.0])}
    poses = replace(stickers.poses, **places, scale=np.array([0.1, 0.005, 0.5]))
    assert len(lines(replace(stickers, poses=poses), line="silhouette")) == 4
    assert "1 item in several parts has" in caplog.text


def test_a_kiss_cut_lies_at_its_distance_and_meets_no_other(stickers: Layout) -> None:
    around = lines(stickers, kiss="2")
    for shape, outline in zip(around[:2], stickers.outlines, strict=False):
        assert shape.exterior.distance(outline.region) == pytest.approx(2.0, rel=2e-3)
        assert not shape.interiors
    tree = shapely.STRtree(around)
    assert all(a == b for a, b in tree.query(around, predicate="intersects").T)


def test_cuts_that_would_cross_become_one(
    stickers: Layout, caplog: pytest.LogCaptureFixture
) -> None:
    assert len(lines(stickers, kiss="20")) == 1
    assert "would cross have become one" in caplog.text


@pytest.mark.parametrize(("asked", "said"), [("0", "more than nothing"), ("wide", "use a length")])
def test_a_distance_that_is_none_is_refused(asked: str, said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        CutOptions(kiss=asked)


@pytest.mark.parametrize("ending", ["svg", "dxf"])
@pytest.mark.parametrize("asked", [{"kiss_cut": "2"}, {"cut": "silhouette"}, {"cut": "outlines"}])
def test_files_measure_as_before(
    stickers: Layout, tmp_path: Path, ending: str, asked: dict[str, str]
) -> None:
    write(stickers, tmp_path / f"plain.{ending}")
    write(stickers, tmp_path / f"cut.{ending}", write_options(**asked))  # type: ignore[arg-type]
    plain, cut = (read_written(tmp_path / f"{name}.{ending}") for name in ("plain", "cut"))
    for one, other in zip(plain.outlines, cut.outlines, strict=True):
        assert one.region.equals(other.region)


def test_a_dxf_has_the_lines_on_the_layer_that_is_cut(stickers: Layout) -> None:
    import ezdxf

    text = encoded(stickers, "a.dxf", write_options(kiss_cut="2")).decode()
    space = ezdxf.read(io.StringIO(text)).modelspace()
    cut = [Polygon(np.array(line.get_points("xy"))) for line in space.query('*[layer=="cut"]')]
    assert sum(shape.area for shape in cut) == pytest.approx(
        sum(shape.area for shape in lines(stickers, kiss="2")) * (25.4 / 96) ** 2, rel=1e-6
    )
    assert len(space.query('*[layer=="items"]')) == sum(len(o.rings) for o in stickers.outlines)
    plain = ezdxf.read(io.StringIO(encoded(stickers, "a.dxf").decode()))
    assert "items" not in plain.layers


def test_a_pdf_strokes_the_lines_in_the_spot_colour(stickers: Layout) -> None:
    pdf = encoded(stickers, "a.pdf", write_options(kiss_cut="2"))
    with pikepdf.open(io.BytesIO(pdf)) as read:
        ink = read.pages[0].Resources.ColorSpace.CutContour
        assert [str(one) for one in ink[:3]] == ["/Separation", "/CutContour", "/DeviceCMYK"]
        assert read.pages[0].Resources.ExtGState.Overprint.OP
        drawn = read.pages[0].Contents[1].read_bytes()
    assert pdf == encoded(stickers, "a.pdf", write_options(kiss_cut="2"))
    asked = lines(stickers, kiss="2")
    found = stroked(pdf)
    assert len(found) == len(asked)
    height = stickers.container.height
    for (left, low, right, top), shape in zip(found, asked, strict=True):
        px = np.array([left, height * 0.75 - top, right, height * 0.75 - low]) / 0.75
        assert np.abs(px - shape.bounds).max() < 0.4
    plain = encoded(stickers, "a.pdf")
    assert b"Separation" not in plain
    with pikepdf.open(io.BytesIO(plain)) as read:
        assert read.pages[0].Contents.read_bytes() == drawn


@pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="poppler is not installed")
@pytest.mark.parametrize("asked", [{}, {"cut": "outlines"}, {"kiss_cut": "2", "bleed": "3mm"}])
def test_poppler_has_nothing_to_say(
    stickers: Layout, tmp_path: Path, asked: dict[str, str]
) -> None:
    write(stickers, tmp_path / "a.pdf", write_options(**asked))  # type: ignore[arg-type]
    for command in (["pdfinfo", "a.pdf"], ["pdftoppm", "-png", "a.pdf", "a"]):
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
        assert done.stderr == ""


def test_a_bleed_is_beyond_the_trimmed_sheet(stickers: Layout) -> None:
    options = write_options(bleed="3mm", background="#ff8000", cut="outlines")
    with closing(pdfium.PdfDocument(encoded(stickers, "a.pdf", options))) as document:
        page = document[0]
        width, height = 0.75 * stickers.container.width, 0.75 * stickers.container.height
        bleed = 3 * 72 / 25.4
        assert page.get_size() == pytest.approx((width + 2 * bleed, height + 2 * bleed), abs=1e-3)
        trim = (bleed, bleed, width + bleed, height + bleed)
        assert page.get_trimbox() == pytest.approx(trim, abs=1e-3)
        assert page.get_bleedbox() == pytest.approx((0, 0, *page.get_size()), abs=1e-3)
        picture = np.asarray(page.render(scale=2).to_pil().convert("RGB"))
    assert picture[2, 2].tolist() == [255, 128, 0]
    assert picture[-3, -3].tolist() == [255, 128, 0]


@pytest.mark.parametrize("bleed", ["-3mm", "wide", "900%"])
def test_a_bleed_that_is_none_is_refused(stickers: Layout, bleed: str) -> None:
    with pytest.raises(RecipeError, match="bleed"):
        encoded(stickers, "a.pdf", write_options(bleed=bleed))


def stroked(pdf: bytes) -> list[tuple[float, float, float, float]]:
    """Bounds of the paths that are stroked in magenta, points, y up."""
    found = []
    with closing(pdfium.PdfDocument(pdf)) as document:
        page = document[0]
        for k in range(raw.FPDFPage_CountObjects(page)):
            one = raw.FPDFPage_GetObject(page, k)
            colour = [ctypes.c_uint() for _ in range(4)]
            raw.FPDFPageObj_GetStrokeColor(one, *map(ctypes.byref, colour))
            red, green, blue, _ = (channel.value for channel in colour)
            mode, is_stroked = ctypes.c_int(), ctypes.c_int()
            raw.FPDFPath_GetDrawMode(one, ctypes.byref(mode), ctypes.byref(is_stroked))
            if is_stroked.value and red > 180 and green < 60 and blue > 100:
                box = [ctypes.c_float() for _ in range(4)]
                raw.FPDFPageObj_GetBounds(one, *map(ctypes.byref, box))
                found.append(tuple(side.value for side in box))
    return found  # type: ignore[return-value]


def test_regions_of_lines_are_sound(stickers: Layout) -> None:
    rings = cut_rings(stickers, CutOptions(kiss="2"))
    assert region(rings, "evenodd").is_valid

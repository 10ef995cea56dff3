"""SVG and DXF files of ours, back to the layouts that they show."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageDraw

from packwork.errors import ReadError
from packwork.metrics.certificate import Promise
from packwork.readers.builtin import builtin_item
from packwork.readers.layouts.read import read_written
from packwork.readers.pictures.silhouette import item_of_picture
from packwork.readers.svg.item import item_of_svg
from packwork.scene.container import brought_over, on_canvas
from packwork.scene.item import Item, Label
from packwork.scene.layout import Layout
from packwork.units import canvas_size, convert
from packwork.writers import write
from packwork.writers.registry import WriteOptions
from packwork.writers.svg import SvgOptions
from scenes import box, flat_item, poses, square_container

FLAT = WriteOptions(svg=SvgOptions(flatten=True))
MASKED = b"""<svg viewBox="0 0 90 90"><mask id="m"><rect width="90" height="50" fill="#fff"/></mask>
<circle cx="45" cy="45" r="40" mask="url(#m)"/></svg>"""


def picture_item() -> Item:
    image = Image.new("RGBA", (120, 90), (0, 0, 0, 0))
    ImageDraw.Draw(image).ellipse((20, 10, 100, 70), fill="tomato")
    file = io.BytesIO()
    image.save(file, "PNG")
    return item_of_picture(file.getvalue(), "blob", "blob.png")


def photographed() -> Image.Image:
    """A soft-edged thing before a plain sheet."""
    image = Image.new("RGB", (960, 800), "#f4f1e8")
    ImageDraw.Draw(image).rounded_rectangle((130, 90, 830, 690), 150, fill="#1d78c7")
    return image.resize((240, 200), Image.Resampling.LANCZOS)


def framed() -> Image.Image:
    """A disc on an opaque tile of one colour, with nothing round it."""
    image = Image.new("RGBA", (120, 90), (0, 0, 0, 0))
    ImageDraw.Draw(image).rectangle((20, 10, 99, 69), fill="ivory")
    ImageDraw.Draw(image).ellipse((40, 20, 80, 60), fill="tomato")
    return image


def layout_of(*items: Item, size: str = "200x150mm", **manifest: object) -> Layout:
    """Items in two rows, each turned and scaled otherwise."""
    n = len(items)
    scales = np.array([14.0 / item.outline.extent for item in items]) * np.linspace(0.7, 1, n)
    placed = poses(np.linspace(10, 90, n), np.resize([30.0, 70.0], n), np.linspace(0, 5, n), scales)
    layout = Layout(square_container(), items, placed, np.ones(n), manifest)
    container = on_canvas(layout.container, canvas_size(size))
    return replace(
        layout, container=container, poses=brought_over(placed, layout.container, container)
    )


def assert_alike(found: Layout, layout: Layout, share: float) -> None:
    """Outlines within a share of the canvas; a DXF of a canvas in px is in mm."""
    scale = found.container.side / layout.container.side
    assert [item.name for item in found.items] == [item.name for item in layout.items]
    pairs = [(found.container.outline, layout.container.outline)]
    pairs += zip(found.outlines, layout.outlines, strict=True)
    for got, expected in pairs:
        placed = shapely.transform(expected.region, lambda points: points * scale)
        for one, other in ((got.region, placed), (placed, got.region)):
            line, corners = other.boundary, shapely.points(shapely.get_coordinates(one))
            shapely.prepare(line)
            assert shapely.dwithin(corners, line, share * found.container.side).all()


@pytest.mark.parametrize("size", ["200x150mm", "8in", "600"])
@pytest.mark.parametrize(
    ("file", "options", "share"),
    [
        ("a.svg", None, 1e-5),
        ("a.svg", FLAT, 1e-5),
        ("a.dxf", None, 1e-8),
        ("a.geojson", None, 1e-8),
    ],
    ids=["svg", "flat svg", "dxf", "geojson"],
)
def test_outlines_come_back(
    file: str, options: WriteOptions | None, share: float, size: str, tmp_path: Path
) -> None:
    items = [builtin_item(name) for name in ("owl", "bicycle", "donut", "star", "smile")]
    items += [picture_item(), item_of_svg(MASKED, "masked", "masked.svg")]
    layout = layout_of(*items, *items, size=size)
    write(layout, tmp_path / file, options)
    found = read_written(tmp_path / file)
    unit = layout.container.unit
    assert found.container.width == pytest.approx(
        convert(layout.container.width, unit, found.container.unit), rel=1e-9
    )
    assert_alike(found, layout, share)


@pytest.mark.parametrize(("picture", "kind"), [(photographed, "JPEG"), (framed, "PNG")])
def test_pictures_are_followed_as_they_were_placed(
    picture: Callable[[], Image.Image], kind: str, tmp_path: Path
) -> None:
    file = io.BytesIO()
    picture().save(file, kind)
    item = item_of_picture(file.getvalue(), "thing", "thing.file")
    layout = layout_of(item, item)
    write(layout, tmp_path / "a.svg")
    assert_alike(read_written(tmp_path / "a.svg"), layout, 1e-6)


@pytest.mark.parametrize("file", ["a.svg", "a.dxf"])
def test_promises_and_weights_come_back(file: str, tmp_path: Path) -> None:
    promised = {"gap": 1.25, "areas_in_shares": True}
    layout = layout_of(*[flat_item("tile", box(-1, -2, 1, 2))] * 2, promised=promised)
    layout = replace(layout, weights=np.array([1.0, 2.5]))
    write(layout, tmp_path / file)
    found = read_written(tmp_path / file)
    assert Promise.of(found.manifest) == Promise(1.25, areas_in_shares=True)
    assert found.weights.tolist() == [1.0, 2.5]


@pytest.mark.parametrize("file", ["a.svg", "a.dxf"])
def test_without_a_promise_there_is_none(file: str, tmp_path: Path) -> None:
    write(layout_of(builtin_item("heart")), tmp_path / file)
    assert Promise.of(read_written(tmp_path / file).manifest) is None


@pytest.mark.parametrize("holes", ["keep", "fill"])
@pytest.mark.parametrize("file", ["a.svg", "a.dxf"])
def test_holes_are_kept_where_the_run_kept_them(file: str, holes: str, tmp_path: Path) -> None:
    ring = builtin_item("ring", "keep" if holes == "keep" else "fill")
    write(layout_of(ring, builtin_item("star")), tmp_path / file)
    found = read_written(tmp_path / file)
    assert [outline.has_holes for outline in found.outlines] == [holes == "keep", False]


def test_links_tooltips_and_odd_names(tmp_path: Path) -> None:
    item = builtin_item("star")
    labels = [Label(link="a.html"), Label(title="a & b"), Label(link="b.html", title="ü 名")]
    layout = layout_of(*[replace(item, name="ü 名 <", label=label) for label in labels])
    for file in ("a.svg", "a.dxf"):
        write(layout, tmp_path / file)
        assert len(read_written(tmp_path / file).items) == 3
    write(layout, tmp_path / "a.svg")
    assert_alike(read_written(tmp_path / "a.svg"), layout, 1e-5)


def test_an_empty_layout(tmp_path: Path) -> None:
    for file in ("a.svg", "a.dxf"):
        write(layout_of(), tmp_path / file)
        assert read_written(tmp_path / file).items == ()


def test_what_was_enlarged_afterwards_is_measured_as_it_is(tmp_path: Path) -> None:
    write(layout_of(builtin_item("heart")), tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    larger = text.replace('width="200mm" height="150mm"', 'width="400mm" height="300mm"')
    (tmp_path / "a.svg").write_text(larger, encoding="utf-8")
    found = read_written(tmp_path / "a.svg")
    assert found.container.width == pytest.approx(400)
    expected = layout_of(builtin_item("heart")).outlines[0].area
    assert found.outlines[0].area == pytest.approx(4 * expected, rel=1e-4)


def test_groups_that_were_moved_are_measured_where_they_are(tmp_path: Path) -> None:
    layout = layout_of(builtin_item("heart"))
    write(layout, tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    moved = text.replace('<g id="items"', '<g id="items" transform="translate(7 -3)"')
    (tmp_path / "a.svg").write_text(moved, encoding="utf-8")
    found = read_written(tmp_path / "a.svg")
    shift = found.outlines[0].centroid - layout.outlines[0].centroid
    assert shift == pytest.approx([7, -3], abs=1e-4)
    assert found.container.outline.bounds == pytest.approx(layout.container.outline.bounds)


@pytest.mark.parametrize(
    ("file", "old", "new", "problem"),
    [
        ("a.svg", 'id="shape-1"', 'id="shape-9"', "has an item that shows nothing"),
        ("a.svg", "scale(", "scale(0)scale(", "has an item without any size"),
        ("a.svg", "viewBox", "viewbox", "has no canvas"),
        ("a.svg", "</svg>", "", "is not well-formed XML"),
        ("a.svg", 'data-gap="2"', 'data-gap="wide"', "states the gap 'wide', which is no length"),
        ("a.dxf", "container", "frame", "has no line on the layer container"),
        ("a.dxf", "PACKWORK", "OTHER", "has lines on the layer cut that name no item"),
        ("a.dxf", "$INSUNITS", "$OUNITS", "states no size and unit"),
        ("a.dxf", "  0\nSECTION", "zero\nSECTION", "is not DXF in text form"),
        ("a.dxf", " 70\n1\n", " 70\n0\n", "that is open"),
    ],
)  # fmt: skip
def test_files_that_are_not_ours(
    file: str, old: str, new: str, problem: str, tmp_path: Path
) -> None:
    promised = {"gap": 2, "areas_in_shares": False}
    path = tmp_path / file
    write(layout_of(builtin_item("heart"), promised=promised), path)
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(ReadError, match=problem) as caught:
        read_written(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("bulge", ["1e9", "nan", "wide"])
def test_sides_that_are_bent_beyond_all_sense_are_refused(bulge: str, tmp_path: Path) -> None:
    path = tmp_path / "a.dxf"
    write(layout_of(builtin_item("heart")), path)
    head, _, lines = path.read_text(encoding="utf-8").rpartition("LWPOLYLINE")
    bent = re.sub(r"( 20\n[^\n]+\n)", rf"\1 42\n{bulge}\n", lines, count=1)
    path.write_text(f"{head}LWPOLYLINE{bent}", encoding="utf-8")
    with pytest.raises(ReadError, match="whose points are none"):
        read_written(path)


def test_other_endings(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="has no outlines to measure"):
        read_written(tmp_path / "a.pdf")


@pytest.fixture(scope="module", params=["a.svg", "a.dxf"])
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path: Path = tmp_path_factory.mktemp("written") / request.param
    write(layout_of(builtin_item("heart"), picture_item()), path)
    return path


@settings(deadline=None, max_examples=40)
@given(place=st.integers(0, 10**7), put=st.text(max_size=6), cut=st.integers(0, 30))
def test_any_edit(written: Path, place: int, put: str, cut: int) -> None:
    text = written.read_text(encoding="utf-8")
    place %= len(text)
    edited = written.with_name(f"edited{written.suffix}")
    edited.write_bytes((text[:place] + put + text[place + cut :]).encode("utf-8", "replace"))
    with suppress(ReadError):
        read_written(edited)


def test_the_command_says_whether_the_file_keeps_its_promise(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from typer.testing import CliRunner

    from packwork.cli import app

    monkeypatch.chdir(tmp_path)
    run: Callable[[str], int] = lambda line: CliRunner().invoke(app, line.split()).exit_code  # noqa: E731
    fill = "fill heart star circle -n 6 --padding 4 --levels 50 --effort draft -q"
    assert run(f"{fill} -o a.svg -o a.dxf") == 0
    assert run("measure a.svg") == run("measure a.dxf") == 0
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    (tmp_path / "b.svg").write_text(text.replace('data-gap="4"', 'data-gap="9"'), encoding="utf-8")
    assert run("measure b.svg") == 1

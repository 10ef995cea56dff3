"""Whatever names a container."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from each import for_each
from packwork.errors import ReadError, RecipeError
from packwork.readers import builtin
from packwork.readers.container import read_container

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" {}>{}</svg>'


@pytest.fixture
def svg_file(tmp_path):
    def save(body: str, page: str = 'viewBox="0 0 40 20"') -> str:
        path = tmp_path / "shape.svg"
        path.write_text(PAGE.format(page, body), encoding="utf-8")
        return str(path)

    return save


@for_each(builtin.container_names())
def test_builtin_containers_lie_on_their_canvas(name):
    container = read_container(name, canvas=300)
    left, top, right, bottom = container.outline.bounds
    assert container.side == pytest.approx(300)
    assert min(left, top) >= -1e-6
    assert right <= container.width + 1e-6
    assert bottom <= container.height + 1e-6
    assert container.outline.region.is_valid


def test_circle_fills_its_canvas():
    circle = read_container("circle", canvas=200)
    assert circle.outline.area == pytest.approx(np.pi * 100**2, rel=1e-4)


def test_page_is_the_canvas(svg_file):
    container = read_container(svg_file('<rect x="10" y="5" width="10" height="10"/>'), 400)
    assert (container.width, container.height) == (400, 200)
    assert container.outline.bounds == (100, 50, 200, 150)
    assert container.name == "shape"


def test_without_a_page_the_box_is_the_canvas(svg_file):
    container = read_container(svg_file('<rect x="10" y="5" width="10" height="20"/>', ""), 400)
    assert (container.width, container.height) == (200, 400)
    assert container.outline.bounds == (0, 0, 200, 400)


def test_holes_and_parts_stay(svg_file):
    body = '<path d="M0 0h18v18h-18z M5 5v5h5v-5z"/><circle cx="30" cy="10" r="5"/>'
    assert len(read_container(svg_file(body)).outline.rings) == 3


def test_strokes_of_filled_shapes_do_not_count(svg_file):
    body = '<rect x="10" y="5" width="10" height="10" stroke="red" stroke-width="4"/>'
    assert read_container(svg_file(body), 40).outline.area == pytest.approx(100)


def test_line_drawing_is_filled(svg_file):
    body = '<rect x="10" y="5" width="10" height="10" fill="none" stroke="red" stroke-width="2"/>'
    container = read_container(svg_file(body), 40)
    assert container.outline.area == pytest.approx(144)
    assert len(container.outline.rings) == 1


@pytest.mark.parametrize(
    ("inner", "left"),
    [
        ('<circle r="10"/>', 6400 - np.pi * 100),
        ('<circle r="20"/><circle r="10"/>', 6400 - np.pi * 300),
        ('<circle r="10"/><path d="M-30 0h15M-5 0h10"/>', 6400 - np.pi * 100),
        ('<path d="M0 0h10v10h-10v-10"/>', 6300),
        ('<path d="M-30 0h60"/>', 6400),
        ('<circle r="10"/><circle r="10" cx="5"/>', 6400),
        ('<circle r="10" stroke-width="9"/>', 6400),
        ('<rect x="60" y="-40" width="20" height="80"/>', 8000),
    ],
)
def test_thin_closed_lines_within_lines_are_holes(svg_file, caplog, inner, left):
    line = f'<g fill="none" stroke="#000" stroke-width=".02"><path d="M-40-40h80v80h-80z"/>{inner}'
    source = svg_file(f"{line}</g>", 'viewBox="-100 -100 200 200"')
    assert read_container(source, 200).outline.area == pytest.approx(left, rel=1e-3)
    assert any("are holes" in one for one in caplog.messages) == (left not in {6400, 8000})


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        ("nowhere.svg", "no such file"),
        ("nowhere.png", "no such file"),
        ("hart", "no built-in container of that name; did you mean heart"),
        ("around:a.png", "no such file"),
        ("\0", "no built-in container"),
    ],
)
def test_unknown_containers(source, problem):
    with pytest.raises(ReadError, match=problem):
        read_container(source)


@pytest.mark.parametrize("canvas", [0.0, -1.0, float("nan"), float("inf"), "5parsec", "0x5mm"])
def test_canvas_needs_a_size(canvas):
    with pytest.raises(RecipeError, match=r"^canvas: .*not "):
        read_container("circle", canvas)


@pytest.mark.parametrize(
    ("page", "canvas"),
    [
        ('width="200mm" height="150mm"', (200, 150, "mm")),
        ('width="20cm" viewBox="0 0 40 20"', (20, 10, "cm")),
        ('height="1.5in" viewBox="0 0 40 20"', (3, 1.5, "in")),
        ('width="72pt" height="1in" viewBox="0 0 40 20"', (72, 72, "pt")),
        ('width="40px" height="20" viewBox="0 0 40 20"', (600, 300, "px")),
        ('width="100%" viewBox="0 0 40 20"', (600, 300, "px")),
        ('width="4em" height="2em"', (600, 300, "px")),
        ('viewBox="0 0 40 20"', (600, 300, "px")),
    ],
)
def test_a_drawing_in_real_units_keeps_its_size(svg_file, page, canvas):
    container = read_container(svg_file('<rect width="20" height="10"/>', page))
    assert (container.width, container.height) == pytest.approx(canvas[:2], rel=1e-12)
    assert container.unit == canvas[2]


def test_a_drawing_in_real_units_yields_to_the_canvas_asked_for(svg_file):
    file = svg_file('<rect width="20" height="10"/>', 'width="200mm" viewBox="0 0 40 20"')
    assert read_container(file, 100).canvas == {"width": 100, "height": 50, "unit": "px"}
    sheet = read_container(file, "8x8in")
    assert sheet.canvas == {"width": 8, "height": 8, "unit": "in"}
    assert sheet.outline.bounds == pytest.approx((0, 2, 4, 4))


@pytest.mark.parametrize("source", ["bear", "circle", "stripe:6", "text:OX", "mask.png"])
def test_any_container_is_fitted_onto_a_sheet(source, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Image.fromarray(np.zeros((50, 100), np.uint8)).save("mask.png")
    own, sheet = read_container(source), read_container(source, "200x150mm")
    assert sheet.canvas == {"width": 200, "height": 150, "unit": "mm"}
    left, top, right, bottom = sheet.outline.bounds
    own_left, own_top, own_right, own_bottom = own.outline.bounds
    scale = min(200 / own.width, 150 / own.height)
    assert right - left == pytest.approx(scale * (own_right - own_left))
    assert (left + right) / 2 == pytest.approx(100 + scale * (own_left + own_right - own.width) / 2)
    assert (top + bottom) / 2 == pytest.approx(75 + scale * (own_top + own_bottom - own.height) / 2)


def test_folder_is_no_container(tmp_path):
    with pytest.raises(ReadError, match="is a folder"):
        read_container(tmp_path)


def test_unknown_ending(tmp_path):
    (tmp_path / "shape.txt").write_text("x", encoding="utf-8")
    with pytest.raises(ReadError, match=r"unknown ending '\.txt'"):
        read_container(tmp_path / "shape.txt")


def test_empty_drawing_is_no_container(svg_file):
    with pytest.raises(ReadError, match="paints no area"):
        read_container(svg_file(""))


def test_mask_scales_to_its_side(tmp_path):
    mask = np.full((50, 100), 255, np.uint8)
    mask[10:40, 20:80] = 0
    Image.fromarray(mask).save(tmp_path / "mask.png")
    container = read_container(tmp_path / "mask.png", canvas=1000)
    assert (container.width, container.height) == (1000, 500)
    assert container.outline.bounds == pytest.approx((200, 100, 800, 400))

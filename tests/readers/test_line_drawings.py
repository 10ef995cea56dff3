"""SVGs as drawings for a machine: what is cut and engraved, and curves that are true."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine
from packwork.geometry.bezier import FLATTENING
from packwork.readers.engraving import Engraving
from packwork.readers.items import read_items
from packwork.readers.line_drawings import CURVES_PX, arc_line
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.item import Item
from packwork.scene.line_art import LineArt

MM = 96 / 25.4
"""Px of a millimetre."""

HAIRLINE = 'fill="none" stroke="#f00" stroke-width=".1"'


def parts(folder: Path, drawn: str, holes: str = "keep", engrave: Sequence[str] = ()) -> list[Item]:
    """Parts of an SVG of 100 x 80 mm, one user unit a millimetre."""
    path = folder / "a.svg"
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm"'
    path.write_text(f'{head} viewBox="0 0 100 80">{drawn}</svg>', encoding="utf-8")
    return list(read_items(path, holes=holes, engraving=Engraving(engrave)).items)  # type: ignore[arg-type]


def cut(item: Item) -> list[ArcLine]:
    """Lines to cut in px of the item."""
    assert isinstance(item.art, LineArt)
    return [line.mapped(item.art.matrix, 0.0) for line in item.art.cut]


def true_points(data: str, count: int = 33) -> np.ndarray:
    """Points of a path's cubics, as its formula has them."""
    cubics = np.concatenate([piece.segments for piece in parse_path(data)])
    t = np.linspace(0, 1, count)[None, :, None]
    first, second, third, last = (cubics[:, None, k] for k in range(4))
    points = (1 - t) ** 3 * first + 3 * t * (1 - t) ** 2 * second
    points = points + 3 * t**2 * (1 - t) * third + t**3 * last
    return np.asarray(points.reshape(-1, 2))


def is_near(line: ArcLine, points: np.ndarray, within: float) -> bool:
    """Whether no point is farther from a line."""
    flat = line.flattened(1e-7)
    flat = shapely.LineString(np.vstack([flat, flat[:1]]) if line.is_closed else flat)
    shapely.prepare(flat)
    return bool(shapely.dwithin(flat, shapely.points(points), within).all())


places = st.tuples(st.integers(-60, 60), st.integers(-60, 60)).map(lambda p: f"{p[0]} {p[1]}")
steps = st.one_of(
    st.tuples(places, places, places).map(lambda one: f"C{' '.join(one)}"),
    st.tuples(places, places).map(lambda one: f"Q{' '.join(one)}"),
    places.map(lambda one: f"L{one}"),
    st.tuples(st.integers(3, 50), st.integers(3, 50), st.integers(0, 90), places).map(
        lambda one: f"A{one[0]} {one[1]} {one[2]} 0 1 {one[3]}"
    ),
)


@given(start=places, drawn=st.lists(steps, min_size=1, max_size=4), closes=st.booleans())
@settings(deadline=None, max_examples=60)
def test_arcs_lie_on_the_true_curves(start: str, drawn: list[str], closes: bool) -> None:
    data = f"M{start}{''.join(drawn)}{'z' if closes else ''}"
    pieces = parse_path(data)
    assume(pieces and len(pieces[0].segments))
    assume(np.ptp(pieces[0].segments.reshape(-1, 2), axis=0).max() > 1)
    (piece,) = pieces
    line = arc_line(piece, CURVES_PX)
    assert is_near(line, true_points(data), 2 * CURVES_PX + 1e-6)


@pytest.mark.parametrize("drawn", [
    '<circle cx="30" cy="40" r="11"/>', '<ellipse cx="30" cy="40" rx="11" ry="11"/>',
    '<path d="M19 40a11 11 0 1 0 22 0a11 11 0 1 0-22 0z"/>',
    '<g transform="rotate(30) scale(2)"><circle cx="30" cy="4" r="5.5"/></g>',
])  # fmt: skip
@pytest.mark.parametrize("style", [HAIRLINE, 'fill="teal"'])
def test_round_parts_are_circles(tmp_path: Path, drawn: str, style: str) -> None:
    (item,) = parts(tmp_path, f"<g {style}>{drawn}</g>")
    (line,) = cut(item)
    assert np.abs(line.bulges).tolist() == [1.0, 1.0]
    assert np.hypot(*np.diff(line.points, axis=0)[0]) == pytest.approx(22 * MM, rel=1e-6)


def test_outlines_lie_around_the_true_curves(tmp_path: Path) -> None:
    data = "M10 10C40 0 60 30 90 10L80 70C60 50 40 80 20 70z"
    for style in (HAIRLINE, 'fill="teal"', 'fill="teal" stroke="black" stroke-width=".3"'):
        (item,) = parts(tmp_path, f'<path d="{data}" {style}/>')
        (line,) = cut(item)
        true = shapely.Polygon(line.flattened(1e-6))
        assert item.outline.region.buffer(1e-6).covers(true)
        assert item.outline.area == pytest.approx(true.area, rel=1e-3)
        assert shapely.hausdorff_distance(item.outline.region, true) < 4 * FLATTENING * 90 * MM
        drawn = affine.apply(item.art.matrix, true_points(data))  # type: ignore[union-attr]
        if "stroke" in style and "teal" not in style:
            drawn = true_points(data, 3_001) * MM
            drawn = drawn - drawn.min(axis=0) + line.flattened(1e-6).min(axis=0)
        assert is_near(line, drawn, 3 * CURVES_PX)


def test_a_plate_of_hairlines_is_a_plate(tmp_path: Path) -> None:
    plate = (
        f'<g {HAIRLINE}><rect x="1" y="1" width="90" height="60" rx="10"/>'
        '<circle cx="40" cy="30" r="12"/><path d="M60 20h10"/></g>'
        '<path d="M70 40h6v6h-6z" fill="black"/><circle cx="20" cy="50" r="3" stroke="blue" '
        'stroke-width=".1" stroke-dasharray="1" fill="none"/>'
    )
    (item,) = parts(tmp_path, plate)
    area = 90 * 60 - (4 - math.pi) * 100 - math.pi * 144
    assert item.outline.area / MM**2 == pytest.approx(area, rel=1e-4)
    assert isinstance(item.art, LineArt)
    assert len(item.art.cut) == 2
    assert len(item.art.engraved) == 3


@pytest.mark.parametrize(
    "layer",
    ['inkscape:label="Gravur" id="layer2"', 'id="Engrave_fine"', 'id="g7" data-name="score"'],
)
def test_lines_of_layers_to_engrave_are_not_cut(tmp_path: Path, layer: str) -> None:
    namespace = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    style = "fill:none;stroke:#00f;stroke-width:.1;stroke-dasharray:none"
    drawn = (
        f'<g {HAIRLINE} id="cut"><rect x="1" y="1" width="90" height="60"/></g>'
        f'<g {namespace} {layer}><circle cx="40" cy="30" r="12" style="{style}"/>'
        f'<g><path d="M60 20h10v9z" style="{style}"/></g></g>'
    )
    (item,) = parts(tmp_path, drawn)
    assert isinstance(item.art, LineArt)
    assert (len(item.art.cut), len(item.art.engraved)) == (1, 2)
    assert item.outline.area / MM**2 == pytest.approx(90 * 60, rel=1e-4)


def test_groups_that_programs_name_are_cut(tmp_path: Path) -> None:
    inner = '<g id="text12"><circle r="9" cx="40" cy="30"/></g>'
    (item,) = parts(tmp_path, f'<g {HAIRLINE}><rect width="90" height="60"/>{inner}</g>')
    assert len(cut(item)) == 2


def test_each_outline_of_lines_is_a_part(tmp_path: Path) -> None:
    three = "".join(f'<rect x="{20 * k}" width="15" height="{9 + k}"/>' for k in range(3))
    assert len(parts(tmp_path, f"<g {HAIRLINE}>{three}</g>")) == 3
    (one,) = parts(tmp_path, f'<g fill="teal">{three}</g>')
    assert len(cut(one)) == 3


def test_lines_in_pieces_are_joined(tmp_path: Path) -> None:
    drawn = '<path d="M0 0h30v20"/><line x1="30" y1="20" x2="0" y2="20"/><path d="M0 20V0"/>'
    (item,) = parts(tmp_path, f"<g {HAIRLINE}>{drawn}</g>")
    assert item.outline.area / MM**2 == pytest.approx(600)


def test_colours_that_may_mean_something_are_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    drawn = '<rect width="30" height="20"/><rect x="5" y="5" width="9" height="9" stroke="blue"/>'
    with caplog.at_level(logging.WARNING):
        parts(tmp_path, f"<g {HAIRLINE}>{drawn}</g>")
    assert (
        "lines in several colours: #f00 (1), blue (1); outlines of all are cut, but for colours "
        "that are given as --engrave 'COLOUR'" in caplog.text
    )


def test_an_open_outline_is_named(tmp_path: Path) -> None:
    told = (
        r"a\.svg: the path in (\S+) at \(0, 0\) mm is open; the next end is 20 mm away; "
        r"close it, or engrave it: --engrave '?\1'?$"
    )
    with pytest.raises(ReadError, match=told):
        parts(tmp_path, f'<path d="M0 0h30v20h-30" {HAIRLINE}/>')


def test_thick_lines_and_what_is_traced_are_what_ink_covers(tmp_path: Path) -> None:
    (frame,) = parts(tmp_path, '<rect x="5" y="5" width="50" height="40" fill="none" '
                     'stroke="black" stroke-width="4"/>')  # fmt: skip
    assert frame.outline.area / MM**2 == pytest.approx(54 * 44 - 46 * 36, rel=1e-6)
    clip = '<clipPath id="c"><circle cx="20" cy="20" r="9"/></clipPath>'
    (disc,) = parts(tmp_path, f'{clip}<rect width="50" height="40" clip-path="url(#c)"/>')
    assert disc.outline.area / MM**2 == pytest.approx(81 * math.pi, rel=1e-3)


def test_holes_are_cut_where_none_may_lie_in_them(tmp_path: Path) -> None:
    ring = '<path fill-rule="evenodd" d="M0 0h40v30h-40zM10 10h9v9h-9z"/>'
    (item,) = parts(tmp_path, ring, "fill")
    assert item.outline.area / MM**2 == pytest.approx(1200)
    assert sorted(_areas(cut(item))) == pytest.approx([81, 1200], rel=1e-6)


def _areas(lines: list[ArcLine]) -> Iterator[float]:
    for line in lines:
        yield shapely.Polygon(line.flattened(1e-6)).area / MM**2


MARKED = (
    '<path d="M22 20h36M60 12a8 8 0 0 1 8 9" stroke="{0}"/><circle cx="40" cy="40" r="6" '
    'style="stroke:{0}"/><path d="M20 50l4 0v4z" fill="{0}" stroke="none"/>'
)
"""Open lines, an arc, a circle and an area of one colour."""


@pytest.mark.parametrize("written", ["red", "rgb(255,0,0)", "#F00"])
@pytest.mark.parametrize("asked", ["red", "#ff0000"])
def test_what_has_a_colour_is_engraved_true_to_a_millionth(
    tmp_path: Path, written: str, asked: str
) -> None:
    plate = f'<rect x="2" y="2" width="80" height="60" stroke="black"/>{MARKED.format(written)}'
    thin = f'<g fill="none" stroke-width=".1">{plate}</g>'
    whole, filled = (
        parts(tmp_path, drawn, engrave=[asked])
        for drawn in (thin, thin.replace('stroke="black"', 'fill="black" stroke="none"'))
    )
    for (item,) in (whole, filled):
        assert isinstance(item.art, LineArt)
        assert item.outline.area / MM**2 == pytest.approx(80 * 60, rel=1e-6)
        lines = [line.mapped(item.art.matrix, 0.0) for line in item.art.engraved]
        corner = cut(item)[0].points.min(axis=0) - 2 * MM
        _, bent, ring, area = (replace(one, points=(one.points - corner) / MM) for one in lines)
        assert np.hypot(*(ring.points - [40, 40]).T) == pytest.approx([6, 6], abs=1e-6)
        assert np.abs(ring.bulges) == pytest.approx([1, 1])
        assert is_near(bent, true_points("M60 12a8 8 0 0 1 8 9"), 1e-6)
        assert shapely.Polygon(area.points).area == pytest.approx(8)


def test_what_has_no_such_colour_is_cut(tmp_path: Path) -> None:
    drawn = '<rect width="30" height="20"/><rect x="5" y="5" width="9" height="9" stroke="blue"/>'
    (item,) = parts(tmp_path, f"<g {HAIRLINE}>{drawn}</g>", engrave=["green"])
    assert len(cut(item)) == 2


def test_a_layer_of_any_name_may_be_engraved(tmp_path: Path) -> None:
    drawn = '<rect width="30" height="20"/><g id="Inner"><circle cx="9" cy="9" r="5"/></g>'
    (item,) = parts(tmp_path, f"<g {HAIRLINE}>{drawn}</g>", engrave=["inner"])
    assert isinstance(item.art, LineArt)
    assert (len(item.art.cut), len(item.art.engraved)) == (1, 1)


@pytest.mark.parametrize("name", ["Inner", "engrave", "Blue"])
@pytest.mark.parametrize("body", ['fill="black"', HAIRLINE])
def test_lines_and_areas_on_a_layer_to_engrave_lie_on_parts_of_either_kind(
    tmp_path: Path, name: str, body: str
) -> None:
    marks = f'<path {HAIRLINE} d="M5 5h9"/><rect x="20" y="5" width="5" height="5"/>'
    drawn = f'<rect width="30" height="20" {body}/><g id="{name}">{marks}</g>'
    (item,) = parts(tmp_path, drawn, engrave=[name])
    assert isinstance(item.art, LineArt)
    assert (len(item.art.cut), len(item.art.engraved)) == (1, 2)


def test_what_is_traced_has_no_colours_to_engrave_and_that_is_told(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    clip = '<clipPath id="c"><circle cx="20" cy="20" r="9"/></clipPath>'
    drawn = f'{clip}<rect width="50" height="40" clip-path="url(#c)"/>{MARKED.format("red")}'
    with caplog.at_level(logging.WARNING):
        parts(tmp_path, drawn, engrave=["red"])
    assert "what is to be engraved cannot be told apart" in caplog.text


def test_marks_beyond_a_filled_part_are_counted(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    plate = '<rect width="30" height="20"/>'
    mark = '<path d="M50 5h9M20 9h20" fill="none" stroke="red" stroke-width=".1"/>'
    with caplog.at_level(logging.WARNING):
        (item,) = parts(tmp_path, plate + mark, engrave=["red"])
    assert isinstance(item.art, LineArt)
    assert [len(line.points) for line in item.art.engraved] == [2]
    assert "1 engraved beyond an edge, 1 to engrave beside all parts" in caplog.text


@pytest.mark.parametrize(
    "drawn",
    [
        '<rect width="30" height="20" fill="red"/><path d="M5 5h9" stroke="red" fill="none"/>',
        f'<rect width="30" height="20" {HAIRLINE} style="stroke:red"/>',
        '<g id="engrave"><rect width="30" height="20"/></g>',
    ],
)
def test_what_is_engraved_all_over_is_refused_in_these_words(tmp_path: Path, drawn: str) -> None:
    with pytest.raises(ReadError, match="is engraved all over, by the colours or layers"):
        parts(tmp_path, drawn, engrave=["red"])


def test_a_body_whose_edge_alone_is_engraved_is_cut(tmp_path: Path) -> None:
    body = '<rect width="30" height="20" fill="silver" stroke="red" stroke-width=".1"/>'
    (item,) = parts(tmp_path, f'{body}<path d="M5 5h9" stroke="red"/>', engrave=["red"])
    assert isinstance(item.art, LineArt)
    assert item.outline.area / MM**2 == pytest.approx(600)
    assert (len(item.art.cut), len(item.art.engraved)) == (1, 2)
    assert {line.colour for line in item.art.engraved} == {"red"}

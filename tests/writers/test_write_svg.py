from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from defusedxml.ElementTree import fromstring
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.notation import decimals, number, with_fresh_ids, xml_text
from packwork.writers.svg import PRECISION, SvgOptions, svg_text

SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"

HOSTILE = ["<script>", "R&D", 'a"b', "nul\0bell\x07", "\ud800", "\uffff", "🦊 fox", "n" * 5000]


def by_id(root: Element, name: str) -> Element:
    (found,) = [e for e in root.iter() if e.get("id") == name]
    return found


def placed_points(root: Element, copy: Element) -> np.ndarray:
    """Points of a flat item's path as a reader of the file would place them."""
    path = by_id(root, copy.get(f"{XLINK}href", "")[1:])
    numbers = [float(v) for v in re.findall(r"-?[\d.]+", path.get("d", ""))]
    values = dict(re.findall(r"(\w+)\(([^)]*)\)", copy.get("transform", "")))
    x, y = (float(v) for v in values["translate"].split())
    scales = [float(v) for v in values.get("scale", "1").split()]
    matrix = affine.similarity(x, y, np.radians(float(values.get("rotate", 0))), 1.0)
    return affine.apply(matrix, np.reshape(numbers, (-1, 2)) * scales)


def test_golden(three: Layout, golden_text: Callable[[str], str]) -> None:
    options = SvgOptions(background="#fffaf0", show_container=True)
    assert svg_text(three, options) == golden_text("three.svg")


def test_groups_and_names(three: Layout) -> None:
    root = fromstring(svg_text(three))
    assert root.get("viewBox") == "0 0 80 60"
    assert (root.get("width"), root.get("height")) == ("80", "60")
    assert by_id(root, "container").get("display") == "none"
    items = list(by_id(root, "items"))
    assert [e.get("id") for e in items] == ["item-1", "item-2", "item-3"]
    assert [e.get("data-name") for e in items] == ["ring", "star", "photo"]


@pytest.mark.parametrize("unit", ["mm", "cm", "in", "pt"])
def test_real_units_are_those_of_the_canvas(three: Layout, unit: str) -> None:
    layout = replace(three, container=replace(three.container, unit=unit))
    root = fromstring(svg_text(layout))
    assert (root.get("width"), root.get("height")) == (f"80{unit}", f"60{unit}")
    assert root.get("viewBox") == "0 0 80 60"
    assert svg_text(layout).split("\n")[2:] == svg_text(three).split("\n")[2:]


def test_container_shown_on_demand(three: Layout) -> None:
    root = fromstring(svg_text(three, SvgOptions(show_container=True)))
    assert by_id(root, "container").get("display") is None


@pytest.mark.parametrize("background", [None, "none", "transparent"])
def test_no_background(three: Layout, background: str | None) -> None:
    root = fromstring(svg_text(three, SvgOptions(background=background)))
    assert not list(root.iter(f"{SVG}rect"))


def test_half_clear_colours(three: Layout, ring_item: Item) -> None:
    glass = replace(ring_item, art=FlatArt("#ff000080"))
    layout = replace(three, items=(glass, *three.items[1:]))
    root = fromstring(svg_text(layout, SvgOptions(background="rgba(0, 0, 255, 0.2)")))
    assert by_id(root, "item-1").get("fill") == "#ff0000"
    assert by_id(root, "item-1").get("fill-opacity") == "0.502"
    assert by_id(root, "background").get("fill-opacity") == "0.2"


def test_colours_beyond_our_grammar_pass_through(three: Layout, ring_item: Item) -> None:
    odd = replace(ring_item, art=FlatArt('oklch(60% 0.1 50)"/>'))
    root = fromstring(svg_text(replace(three, items=(odd, *three.items[1:]))))
    assert by_id(root, "item-1").get("fill") == 'oklch(60% 0.1 50)"/>'


def test_bad_background_is_refused() -> None:
    with pytest.raises(RecipeError, match="background: 'vermilionish' is no colour"):
        SvgOptions(background="vermilionish")


def test_copies_stay_small(crowd: Layout) -> None:
    text = svg_text(crowd)
    root = fromstring(text)
    assert len(list(root.iter(f"{SVG}use"))) == 1000
    assert len(list(by_id(root, "items"))) == 1000
    assert len(text) < 400_000


def test_flattened_has_no_use(crowd: Layout) -> None:
    root = fromstring(svg_text(crowd, SvgOptions(flatten=True)))
    assert not list(root.iter(f"{SVG}use"))
    assert not list(root.iter(f"{SVG}defs"))
    assert len(list(by_id(root, "items"))) == 1000


def test_flattened_ids_are_unique(make_layout: Callable[..., Layout], star_item: Item) -> None:
    root = fromstring(svg_text(make_layout([star_item] * 3), SvgOptions(flatten=True)))
    ids = [e.get("id") for e in root.iter() if e.get("id")]
    assert len(ids) == len(set(ids))
    fills = {e.get("fill") for e in root.iter(f"{SVG}polygon")}
    assert fills == {"url(#star-a-1)", "url(#star-a-2)", "url(#star-a-3)"}


def test_pictures_are_embedded_once(make_layout: Callable[..., Layout], photo_item: Item) -> None:
    text = svg_text(make_layout([photo_item] * 3))
    assert text.count("data:image/png;base64,") == 1


def test_marks_of_many_colours_share_one_path(
    make_layout: Callable[..., Layout], ring_item: Item
) -> None:
    marks = [replace(ring_item, art=FlatArt(c)) for c in ("red", "lime", "blue")]
    root = fromstring(svg_text(make_layout(marks)))
    uses = list(root.iter(f"{SVG}use"))
    assert {u.get(f"{XLINK}href") for u in uses} == {"#shape-1"}
    assert [u.get("fill") for u in uses] == ["#ff0000", "#00ff00", "#0000ff"]


@pytest.mark.parametrize("flatten", [False, True])
def test_no_items(make_layout: Callable[..., Layout], flatten: bool) -> None:
    root = fromstring(svg_text(make_layout([]), SvgOptions(flatten=flatten)))
    assert not list(by_id(root, "items"))


@pytest.mark.parametrize("side", [1e-3, 1.0, 1000.0, 1e7])
@pytest.mark.parametrize("unit", [1e-4, 1.0, 1e5])
def test_points_are_where_they_belong(crowd: Layout, side: float, unit: float) -> None:
    """Whatever the units of the canvas and of the items."""
    grow = affine.similarity(0, 0, 0, side / 1000)
    poses = replace(
        crowd.poses,
        stretch=np.geomspace(0.25, 4.0, 1000),
        x=crowd.poses.x * side / 1000,
        y=crowd.poses.y * side / 1000,
        scale=crowd.poses.scale * side / 1000 / unit,
    )
    old = crowd.items[:20]
    new = [replace(i, ink=i.ink.mapped(affine.similarity(0, 0, 0, unit))) for i in old]
    new = [replace(i, outline=i.ink) for i in new]
    room = Container("room", "", crowd.container.outline.mapped(grow), side, side)
    layout = replace(
        crowd, container=room, poses=poses, items=tuple(new[k % 20] for k in range(1000))
    )
    root = fromstring(svg_text(layout))
    for copy, ink in list(zip(by_id(root, "items"), layout.inks, strict=True))[::50]:
        error = np.hypot(*(placed_points(root, copy) - ink.points).T).max()
        assert error <= PRECISION * side


def test_only_a_stretched_copy_has_two_scales(
    make_layout: Callable[..., Layout], ring_item: Item
) -> None:
    text = svg_text(make_layout([ring_item] * 3, scale=[1, 3, 3], stretch=[1, 1, 4]))
    transforms = [use.get("transform") for use in fromstring(text).iter(f"{SVG}use")]
    assert transforms == [
        "translate(10 30)",
        "translate(30 30)scale(3)",
        "translate(50 30)scale(6 1.5)",
    ]


@pytest.mark.parametrize("name", HOSTILE)
@pytest.mark.parametrize("flatten", [False, True])
def test_hostile_names(three: Layout, name: str, flatten: bool) -> None:
    items = tuple(replace(i, name=name) for i in three.items)
    layout = replace(three, items=items, container=replace(three.container, name=name))
    text = svg_text(layout, SvgOptions(flatten=flatten))
    root = fromstring(text.encode())
    expected = re.sub("[\0\x07\ud800\uffff]", "\ufffd", name)[:80]
    assert by_id(root, "item-1").get("data-name") == expected
    assert root.findtext(f"{SVG}title") == expected
    assert len(list(by_id(root, "items"))) == 3


@given(st.text(st.characters(), max_size=40))
def test_any_text_survives_xml(text: str) -> None:
    element = fromstring(f'<a b="{xml_text(text)}">{xml_text(text)}</a>'.encode())
    assert len(element.get("b", "")) == len(text)
    assert len(element.text or "") == len(text)


@given(st.floats(-1e6, 1e6), st.integers(0, 12))
@settings(deadline=None)
def test_numbers_are_rounded_and_short(value: float, digits: int) -> None:
    text = number(value, digits)
    assert re.fullmatch(r"-?\d+(\.\d*[1-9])?", text)
    assert abs(float(text) - value) <= 0.5 * 10.0**-digits * (1 + 1e-6) + 1e-9 * abs(value)


@given(st.floats(1e-12, 1e12))
def test_digits_are_enough_and_no_more(step: float) -> None:
    digits = decimals(step)
    assert 10.0**-digits <= step * (1 + 1e-6)
    assert digits == 0 or 10.0 ** (1 - digits) > step * (1 - 1e-6)


def test_fresh_ids_leave_colours_and_longer_ids_alone() -> None:
    markup = '<g id="a"/><g id=\'a-b\'/><p fill="#abc" clip-path="url(\'#a-b\')" href="#a"/>'
    assert with_fresh_ids(markup, "-9") == (
        '<g id="a-9"/><g id=\'a-b-9\'/><p fill="#abc" clip-path="url(\'#a-b-9\')" href="#a-9"/>'
    )
    assert with_fresh_ids("<g/>", "-9") == "<g/>"

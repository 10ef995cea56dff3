"""Files are held against their promise from their own text, and painted."""

from __future__ import annotations

import json
import re
from dataclasses import replace

import pytest

import packwork as pw
from packwork.readers.layouts.read import read_content
from packwork.readers.reading import UnfitError
from packwork.readers.svg.item import item_of_svg
from packwork.verify.paint import painted_pixels, sets_apart
from packwork.verify.text import faults_in_file
from packwork.writers.registry import encoded

QUICK = {"effort": "draft", "levels": "24", "epochs": 6, "seed": 1}
ENDINGS = ("svg", "geojson", "dxf")


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("circle", ["star", "heart", "moon"], count=9, **QUICK)


def text_of(layout: pw.Layout, ending: str) -> str:
    if ending == "dxf":
        pytest.importorskip("ezdxf")
    return encoded(layout, f"layout.{ending}").decode("cp1252" if ending == "dxf" else "utf-8")


def moved(text: str, ending: str) -> str:
    """The file, an item of which lies half a canvas to the right."""
    if ending == "svg":
        return re.sub(
            r"translate\(([\d.]+) ", lambda m: f"translate({float(m[1]) + 300:g} ", text, count=1
        )
    if ending == "geojson":
        read = json.loads(text)
        feature = next(f for f in read["features"] if f["properties"]["role"] == "item")
        geometry = json.dumps(feature["geometry"]["coordinates"])
        numbers = re.sub(r"\[([-\d.e]+), ", lambda m: f"[{float(m[1]) + 300}, ", geometry)
        feature["geometry"]["coordinates"] = json.loads(numbers)
        return json.dumps(read)
    # The last line's first points.
    head, mark, tail = text.rpartition("\nLWPOLYLINE\n")
    return head + mark + re.sub(r"(\n 10\n)([-\d.]+)", lambda m: f"{m[1]}{float(m[2]) + 300}", tail)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_as_it_is_written_keeps_the_promise(layout: pw.Layout, ending: str) -> None:
    assert faults_in_file(text_of(layout, ending).encode(), f"a.{ending}", layout) == ()


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_with_an_item_elsewhere_does_not(layout: pw.Layout, ending: str) -> None:
    text = text_of(layout, ending)
    changed = moved(text, ending)
    assert changed != text
    assert faults_in_file(changed.encode(), f"a.{ending}", layout)


def test_a_file_that_lost_an_item_does_not(layout: pw.Layout) -> None:
    lost = re.sub(r'<use id="item-3".*\n', "", text_of(layout, "svg"))
    assert faults_in_file(lost.encode(), "a.svg", layout) == ("8 of 9 items are written",)


def test_outlines_alone_are_those_of_the_whole_reading(layout: pw.Layout) -> None:
    data = text_of(layout, "svg").encode()
    whole, bare = read_content(data, "a.svg"), read_content(data, "a.svg", outlines_only=True)
    for one, other in zip(whole.outlines, bare.outlines, strict=True):
        assert one.area == pytest.approx(other.area, rel=1e-9)
        assert one.bounds == pytest.approx(other.bounds)


def test_what_shows_of_a_drawing_is_followed_as_finely_as_a_whole_one() -> None:
    """Of two large circles, a lens: it was followed as coarsely as these are large."""
    lens = '<path d="M0 -14.106736A100 100 0 0 1 0 14.106736A100 100 0 0 1 0 -14.106736Z"/>'
    cut = (
        '<clipPath id="c"><circle cx="99" r="100"/></clipPath>'
        '<circle cx="-99" r="100" clip-path="url(#c)"/>'
    )
    whole, part = (
        item_of_svg(f"<svg>{body}</svg>".encode(), "lens", "lens.svg", is_compared=True)
        for body in (lens, cut)
    )
    assert part.outline.area == pytest.approx(whole.outline.area, rel=1e-4)
    assert len(part.outline.points) >= 0.8 * len(whole.outline.points)


def test_paint_outside_and_of_two_items_is_counted(layout: pw.Layout) -> None:
    data = text_of(layout, "svg")
    clean = painted_pixels(data.encode(), layout)
    assert (clean.outside, clean.double) == (0, 0)
    assert painted_pixels(data.encode(), layout, is_own=True) == clean
    x = layout.poses.x.copy()
    x[0] = x[1]
    y = layout.poses.y.copy()
    y[0] = y[1]
    twice = replace(layout, poses=replace(layout.poses, x=x, y=y))
    painted = painted_pixels(text_of(twice, "svg").encode(), twice)
    assert painted.double > 20
    beyond = replace(layout, poses=replace(layout.poses, x=layout.poses.x + 200))
    assert painted_pixels(text_of(beyond, "svg").encode(), beyond).outside > 20


def test_paint_of_another_layout_is_not_counted(layout: pw.Layout) -> None:
    lost = re.sub(r'<use id="item-3".*\n', "", text_of(layout, "svg"))
    with pytest.raises(UnfitError, match="8 of 9 items"):
        painted_pixels(lost.encode(), layout)


def test_sets_hold_each_item_once_and_apart(layout: pw.Layout) -> None:
    sets = sets_apart(layout, 5.0)
    assert sorted(k for one in sets for k in one.tolist()) == list(range(9))
    boxes = [outline.bounds for outline in layout.outlines]
    for one in sets:
        for a in one:
            for b in one[one > a]:
                apart = (
                    max(boxes[a][k] - boxes[b][k + 2] for k in (0, 1)),
                    max(boxes[b][k] - boxes[a][k + 2] for k in (0, 1)),
                )
                assert max(apart) > 5.0

"""Objects of an open drawing: where they come to lie, and what stays as it was."""

from __future__ import annotations

import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np
import pytest
import shapely

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.inkscape import arranging
from packwork.progress import never
from packwork.readers.svg.objects import OpenDrawing
from packwork.scene.item import VectorArt

DRAWING = b"""
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
     width="100mm" height="80mm" viewBox="0 0 100 80">
 <defs><linearGradient id="fade"><stop stop-color="red"/></linearGradient></defs>
 <style>.warm { fill: url(#fade) }</style>
 <g id="ground-layer" transform="translate(10 5)">
  <path id="ground" d="M0 0H60V50H0Z" fill="#fec"/>
 </g>
 <g id="layer" transform="translate(3 3) scale(2)">
  <path id="star" class="warm" transform="rotate(10)" d="M5 0L6 4 10 5 6 6 5 10 4 6 0 5 4 4Z"/>
  <g id="group" transform="translate(15 3)"><circle r="3"/><rect x="2" y="1" width="5" height="3"/>
  </g>
  <use id="clone" xlink:href="#star" x="2" y="-1px" transform="translate(20 20) scale(.7)"/>
  <use id="bystander" xlink:href="#star" x="3" transform="translate(30 20)"/>
  <image id="photo" x="25" y="40" width="8" height="4" xlink:href="elsewhere.png"/>
 </g>
</svg>
"""
OBJECTS = ["star", "group", "clone", "photo"]
QUICK = {"effort": "draft", "seed": 1}


def region(drawing: OpenDrawing, name: str) -> shapely.Geometry:
    """What an object covers, in user units of the drawing's root."""
    item = drawing.object(name).item()
    assert isinstance(item.art, VectorArt)
    return item.ink.mapped(affine.inverse(item.art.matrix)).region


def changed(transforms: Any) -> OpenDrawing:
    root = ET.fromstring(DRAWING)  # noqa: S314 - written above
    for element in root.iter():
        if element.get("id") in transforms:
            element.set("transform", transforms[element.get("id")])
    return OpenDrawing(ET.tostring(root))


def test_objects_fill_another_one_and_neither_overlap_nor_stick_out() -> None:
    found = arranging.fill(OpenDrawing(DRAWING), "ground", OBJECTS, QUICK)
    assert not found.remarks
    after = changed(found.transforms)
    ground = region(after, "ground")
    assert ground.equals(region(OpenDrawing(DRAWING), "ground"))
    covered = [region(after, name) for name in OBJECTS]
    assert all(one.difference(ground).area < 1e-6 for one in covered)
    pairs = [(a, b) for k, a in enumerate(covered) for b in covered[k + 1 :]]
    assert max(a.intersection(b).area for a, b in pairs) < 1e-6
    assert sum(one.area for one in covered) > 0.4 * ground.area


def test_sizes_stay_when_they_are_to_stay() -> None:
    found = arranging.fill(OpenDrawing(DRAWING), "ground", OBJECTS, QUICK | {"sizes": "fixed"})
    before, after = OpenDrawing(DRAWING), changed(found.transforms)
    for name in OBJECTS:
        assert region(after, name).area == pytest.approx(region(before, name).area, rel=1e-4)


def test_a_clone_that_was_not_chosen_stays_where_it_is() -> None:
    found = arranging.fill(OpenDrawing(DRAWING), "ground", ["star", "group"], QUICK)
    assert set(found.transforms) == {"star", "group", "clone", "bystander"}
    before, after = OpenDrawing(DRAWING), changed(found.transforms)
    assert not region(before, "star").equals_exact(region(after, "star"), 1.0)
    for name in ("clone", "bystander"):
        assert region(before, name).equals_exact(region(after, name), 1e-6)


def test_parts_keep_their_size_on_the_page_and_what_finds_no_room_is_named() -> None:
    options = {"passes": 60, "margin": 2.0, "kerf": 1.0, "seed": 0}
    page = (-5.0, -5.0, 60.0, 40.0)
    found = arranging.nest(OpenDrawing(DRAWING), None, page, OBJECTS, options, never)
    before, after = OpenDrawing(DRAWING), changed(found.transforms)
    room = shapely.box(-3.0, -3.0, 53.0, 33.0).buffer(1e-6)
    for name in OBJECTS:
        assert room.covers(region(after, name))
        assert region(after, name).area == pytest.approx(region(before, name).area, rel=1e-4)
    small = arranging.nest(
        OpenDrawing(DRAWING), None, (0.0, 0.0, 40.0, 30.0), OBJECTS, options, never
    )
    assert small.remarks
    assert small.remarks[0].startswith("found no room: ")
    left = set(small.remarks[0].removeprefix("found no room: ").split(", "))
    assert set(OBJECTS) - left == set(OBJECTS) & set(small.transforms) - left


@pytest.mark.parametrize("parent", [None, "layer"])
def test_words_are_paths_in_the_group_that_they_are_put_into(parent: str | None) -> None:
    drawing = OpenDrawing(DRAWING)
    options = QUICK | {"count": 3}
    found = arranging.words(drawing, "ground", parent, "bear bear bear fox fox owl", options)
    assert [name for name, _, _ in found.new] == ["bear", "fox", "owl"]
    outer = affine.identity() if parent is None else drawing.object(parent).inner
    drawn = "".join(f'<g id="{n}" transform="{t}">{m}</g>' for n, m, t in found.new)
    numbers = " ".join(map(str, outer.T.ravel()))
    inner = f'<g transform="matrix({numbers})">{drawn}</g>'
    whole = f'<svg xmlns="http://www.w3.org/2000/svg">{inner}</svg>'
    there = OpenDrawing(whole.encode())
    ground = region(drawing, "ground").buffer(1e-6)
    assert all(ground.covers(region(there, name)) for name, _, _ in found.new)


@pytest.mark.parametrize(
    ("name", "said"), [("nobody", "is no object"), ("inner", "an <svg> inside the drawing")]
)
def test_what_cannot_be_moved_is_refused(name: str, said: str) -> None:
    drawing = OpenDrawing(b'<svg><svg viewBox="0 0 2 2"><rect id="inner" width="1"/></svg></svg>')
    with pytest.raises(ReadError, match=said):
        drawing.object(name)


def test_a_process_answers_in_lines_of_json() -> None:
    request = {"verb": "fill", "drawing": DRAWING.decode(), "container": "ground"}
    request |= {"objects": ["star", "group"], "options": QUICK}
    lines = asked(request)
    assert all(0 <= line["progress"] <= 1 for line in lines[:-1])
    assert len(lines) > 2
    again = arranging.fill(OpenDrawing(DRAWING), "ground", ["star", "group"], QUICK)
    assert lines[-1]["transforms"] == again.transforms
    (line,) = asked(request | {"objects": ["nobody"]})
    assert line == {"error": "nobody: is no object of the drawing"}


def asked(request: dict[str, Any]) -> list[dict[str, Any]]:
    done = subprocess.run(
        [sys.executable, "-m", "packwork.inkscape"],
        input=json.dumps(request), capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    return [json.loads(line) for line in done.stdout.splitlines()]


def test_moves_are_exact_in_nested_groups() -> None:
    move = affine.similarity(7.0, -3.0, 0.4, 1.7)
    before, moved = OpenDrawing(DRAWING), {"group": move, "clone": move}
    after = changed(before.moved(moved))
    for name in moved:
        whole = shapely.transform(region(before, name), lambda points: affine.apply(move, points))
        points = shapely.get_coordinates(region(after, name))
        np.testing.assert_allclose(points, shapely.get_coordinates(whole), atol=1e-6)

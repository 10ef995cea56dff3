"""Charts on maps: marks lie in the region that their row names, at one scale."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import uses
from packwork.errors import RecipeError
from packwork.geometry.overlay import polygon_parts
from packwork.readers.layouts.read import read_written

QUICK: dict[str, Any] = {"epochs": 30, "levels": "32,64", "effort": "draft"}
ROWS = {
    "farm": list("abcdefgh"),
    "acres": [30, 20, 10, 25, 5, 12, 8, 9],
    "land": ["West", "west", "Isle", "East", "East", "Isle", "Moon", "West"],
}


@pytest.fixture
def land(tmp_path: Path) -> Path:
    """Two regions that touch, one of two parts, and one without rows."""
    boxes = {"West": [(0, 0, 3, 4)], "East": [(3, 0, 6, 4)], "Isle": [(0, 5, 2, 8), (4, 5, 6, 8)],
             "Bare": [(7, 0, 8, 2)]}  # fmt: skip
    features = [
        {
            "type": "Feature",
            "properties": {"name": name},
            "geometry": {
                "type": "MultiPolygon",
                "coordinates": [[[[a, b], [c, b], [c, d], [a, d], [a, b]]] for a, b, c, d in parts],
            },
        }
        for name, parts in boxes.items()
    ]
    file = tmp_path / "land.geojson"
    file.write_text(
        json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8"
    )
    return file


@pytest.mark.parametrize("padding", [None, 12])
def test_each_mark_lies_in_the_region_of_its_row(land: Path, padding: float | None) -> None:
    layout = pw.chart(
        land, ROWS, by="land", in_regions=True, size_by="acres", label_by="farm",
        padding=padding, **QUICK,
    )  # fmt: skip
    assert layout.certified
    # The rows of no region, and nothing else, are left out.
    assert [item.name for item in layout.items] == list("abcdefh")
    per_acre = layout.areas / [item.datum.value for item in layout.items]
    assert per_acre == pytest.approx(np.full(7, per_acre[0]))
    bounds = np.reshape(layout.container.outline.bounds, (2, 2))
    groups = [item.datum.group for item in layout.items]
    middles = np.column_stack([layout.poses.x, layout.poses.y])
    west, east, isle = (
        middles[[k for k, one in enumerate(groups) if one == name]]
        for name in ("West", "East", "Isle")
    )
    assert west[:, 0].max() < bounds[:, 0].mean() < east[:, 0].min()
    assert isle[:, 1].max() < min(west[:, 1].min(), east[:, 1].min())
    assert {note.says for note in layout.notes} >= {"West", "East"}


@pytest.mark.parametrize("ending", [".svg", ".geojson", ".packwork"])
def test_what_is_written_is_read_again_and_rooms_are_not_drawn(
    land: Path, tmp_path: Path, ending: str
) -> None:
    layout = pw.chart(land, ROWS, by="land", in_regions=True, size_by="acres", **QUICK)
    file = tmp_path / f"chart{ending}"
    layout.save(file)
    again = read_written(file) if ending != ".packwork" else pw.Session.open(file).layout
    assert again.container.outline.area == pytest.approx(layout.container.outline.area, rel=1e-4)
    assert again.areas == pytest.approx(layout.areas, rel=1e-3)
    assert ending == ".svg" or again.container.walls == ()


def test_a_small_full_region_is_named_and_leaves_marks_to_be_seen(tmp_path: Path) -> None:
    """Widths of gaps and borders that suit the whole map would leave it no room."""
    file = tmp_path / "plot.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 600 300">'
        '<rect id="Field" width="590" height="300"/><rect id="Yard" x="592" width="5" height="5"/>'
        "</svg>",
        encoding="utf-8",
    )
    rows = {"plot": ["Yard"] * 3 + ["Field"] * 30}
    done = uses.fill(uses.chart_recipe(str(file), rows, by="plot", in_regions=True, **QUICK))
    assert done.certified
    assert done.layout.areas.min() > 1.0
    assert any("Yard is the fullest: without it" in said for said in done.remarks)


def test_marks_keep_out_of_small_enclaves(tmp_path: Path) -> None:
    """Holes of less than a hundredth of the part that they lie in."""
    file = tmp_path / "land.svg"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 700 600"><path id="US" '
        'fill-rule="evenodd" d="M0 0h600v600h-600zM300 300v40h40v-40z"/>'
        '<rect id="Cuba" x="640" width="60" height="60"/></svg>',
        encoding="utf-8",
    )
    rows = {"land": ["US"] * 60}
    done = uses.fill(uses.chart_recipe(str(file), rows, by="land", in_regions=True, **QUICK))
    assert done.certified
    (room,) = polygon_parts(done.layout.container.outline.region)
    assert len(room.interiors) == 1


def test_names_keep_clear_of_marks(land: Path) -> None:
    layout = pw.chart(land, ROWS, by="land", in_regions=True, size_by="acres", **QUICK)
    names = [note for note in layout.notes if note.says in {"West", "East", "Isle", "Bare"}]
    assert names
    for note in names:
        x, y = note.matrix[:, 2]
        assert not any(
            one.region.buffer(1).contains(shapely.Point(x, y)) for one in layout.outlines
        )


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ({"in_regions": True}, "needs the column"),
        ({"in_regions": True, "by": "farm"}, "no part of land is named"),
    ],
)
def test_what_names_no_region_is_refused(land: Path, options: dict[str, Any], why: str) -> None:
    with pytest.raises(RecipeError, match=why):
        pw.chart(land, ROWS, **options, **QUICK)


@pytest.mark.parametrize(("container", "why"), [("none", "not none"), ("heart", "names no parts")])
def test_other_containers_have_no_regions(container: str, why: str) -> None:
    with pytest.raises(RecipeError, match=why):
        pw.chart(container, ROWS, by="land", in_regions=True, **QUICK)


def test_a_small_region_with_room_to_spare_has_its_name(tmp_path: Path) -> None:
    names = {"Full": (0, 40), "Roomy": (41, 45.5)}
    shapes = "".join(
        f'<rect id="{name}" x="{10 * a}" width="{10 * (b - a)}" height="60"/>'
        for name, (a, b) in names.items()
    )
    file = tmp_path / "land.svg"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 600">{shapes}</svg>',
        encoding="utf-8",
    )
    # Its name takes an eighth of it and more; of a full one that would be too much.
    asked = {"by": "land", "in_regions": True, **QUICK}
    for roomy, is_named in ((1, True), (40, False)):
        rows = {"land": ["Full"] * 200 + ["Roomy"] * roomy}
        layout = pw.chart(str(file), rows, **asked)
        assert ("Roomy" in {note.says for note in layout.notes}) == is_named


@pytest.mark.parametrize("count", [300, 2])
def test_the_key_to_a_unit_is_at_scale_or_no_larger_than_letters(count: int) -> None:
    layout = pw.chart("circle", {"n": [10.0 * count]}, size_by="n", unit=10, **QUICK)
    key = next(note for note in layout.notes if not note.says)
    mark, scale = layout.items[0], float(key.matrix[0, 0])
    is_at_scale = scale == pytest.approx(float(layout.poses.scale[0]), rel=1e-6)
    assert is_at_scale == (count == 300)
    assert scale * mark.outline.extent <= layout.container.side / 10

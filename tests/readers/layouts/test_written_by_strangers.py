"""Files that another program saved again, or that state what is not so: said, and bounded."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import ReadError
from packwork.metrics.certificate import taken_on_trust
from packwork.readers import json_text
from packwork.readers.layouts import assembly, dxf
from packwork.readers.layouts import geojson as saved
from packwork.readers.layouts.read import read_written
from packwork.scene.item import FlatArt, VectorArt

WALL = '<g id="container" display="none"><path d="M0 0h9v9h-9z"/></g>'
TILES = (
    '<path data-name="a" d="M1 1h2v2h-2z"/><path data-name="b" transform="translate(4)" '
    'd="M1 1h2v2h-2z"/>'
)


def _svg(tmp_path: Path, inside: str) -> Path:
    file = tmp_path / "found.svg"
    file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{inside}</svg>',
        encoding="utf-8",
    )
    return file


def test_what_the_file_states_is_taken_on_trust_and_said(tmp_path: Path) -> None:
    small = '<path data-name="a" data-outline="M1 1h1v1h-1z" d="M1 1h7v7h-7z"/>'
    found = read_written(
        _svg(tmp_path, f'{WALL}<g id="items" data-gap="0" data-count="1">{small}</g>')
    )
    (said,) = taken_on_trust(found.manifest)
    assert "data-outline" in said


@pytest.mark.parametrize(
    "more", ['<g id="items"><path d="M0 0h9v9h-9z"/></g>', '<rect width="9" height="9"/>']
)
def test_paint_outside_the_items_is_said(tmp_path: Path, more: str) -> None:
    items = f'<g id="items" data-gap="0" data-count="2">{TILES}</g>'
    found = read_written(_svg(tmp_path, f"{WALL}{items}{more}"))
    assert taken_on_trust(found.manifest) == ("1 drawing outside the group items is not measured",)


def test_files_of_ours_say_nothing(tmp_path: Path) -> None:
    layout = pw.fill("circle", "star", count=2, epochs=9, levels="24", effort="draft")
    layout.save(tmp_path / "own.svg", background="ivory")
    assert taken_on_trust(read_written(tmp_path / "own.svg").manifest) == ()


def test_what_lost_its_groups_is_measured_as_it_stands(tmp_path: Path) -> None:
    # As an optimiser leaves it: hidden paths, names and groups are gone.
    found = read_written(_svg(tmp_path, f'<g transform="scale(.5)">{TILES}</g>'))
    assert [outline.area for outline in found.outlines] == pytest.approx([1.0, 1.0])
    assert found.container.outline.area == 81
    assert found.manifest["promised"] is None
    assert ["no group named" in said for said in taken_on_trust(found.manifest)] == [True, True]


def test_a_container_that_is_still_there_is_used(tmp_path: Path) -> None:
    found = read_written(_svg(tmp_path, f'{WALL}<g id="layer1">{TILES}</g>'))
    assert len(found.items) == 2
    assert len(taken_on_trust(found.manifest)) == 1


def _geojson(tmp_path: Path, **properties: object) -> Path:
    tile = {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 0]]]}
    said = {"role": "item", "x": 1, "y": 1, "angle": 0, "scale": 1.0, **properties}
    features = [
        {"type": "Feature", "properties": {"role": "container"}, "geometry": tile},
        {"type": "Feature", "properties": said, "geometry": tile},
    ]
    file = tmp_path / "found.geojson"
    file.write_text(
        json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8"
    )
    return file


def test_large_scales_are_read(tmp_path: Path) -> None:
    assert read_written(_geojson(tmp_path, scale=3e9)).poses.scale.tolist() == [3e9]
    with pytest.raises(ReadError, match="scale: must be positive"):
        read_written(_geojson(tmp_path, scale=0))


def test_work_and_memory_are_bounded_before_they_are_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = _geojson(tmp_path)
    monkeypatch.setattr(json_text, "MAX_PARTS", 20)
    with pytest.raises(ReadError, match="more than 20 numbers and lists"):
        read_written(file)
    monkeypatch.setattr(json_text, "MAX_PARTS", 1_000)
    monkeypatch.setattr(saved, "MAX_ITEMS", 0)
    with pytest.raises(ReadError, match="holds 2, more than 0 items"):
        read_written(file)
    monkeypatch.setattr(saved, "MAX_ITEMS", 9)
    monkeypatch.setattr(saved, "MAX_POINTS", 3)
    with pytest.raises(ReadError, match="4 points, more than 3"):
        read_written(file)
    monkeypatch.setattr(assembly, "MAX_POINTS", 3)
    with pytest.raises(ReadError, match="points, more than 3"):
        read_written(_svg(tmp_path, f'{WALL}<g id="items">{TILES}</g>'))


def test_a_dxf_of_millions_of_lines_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "found.dxf"
    file.write_text("0\nEOF\n" * 30, encoding="utf-8")
    monkeypatch.setattr(dxf, "MOST_LINES", 40)
    with pytest.raises(ReadError, match="has more than 40 lines"):
        read_written(file)


@pytest.mark.parametrize(
    ("paint", "art"),
    [
        ('fill="#ff0000"', FlatArt),
        ('style="fill:#ff0000"', FlatArt),
        ('fill="[1"', VectorArt),
        ('fill="none"', VectorArt),
        ('fill="#ff0000" stroke="blue"', VectorArt),
    ],
)
def test_copies_of_one_path_in_paints_of_all_kinds(
    tmp_path: Path, paint: str, art: type[FlatArt | VectorArt]
) -> None:
    defined = '<defs><path id="s" d="M0 0h2v2h-2z"/></defs>'
    copies = '<use href="#s" fill="teal"/>' + f'<use href="#s" {paint} transform="translate(4)"/>'
    items = f'{defined}{WALL}<g id="items" data-gap="0">{copies}</g>'
    found = read_written(_svg(tmp_path, items))
    assert isinstance(found.items[0].art, FlatArt)
    assert isinstance(found.items[1].art, art)


def test_mirrored_and_skewed_items_lie_where_they_are_seen(tmp_path: Path) -> None:
    shape = 'd="M0 0h3v1h-2v1h-1z"'
    bent = "".join(
        f'<path {shape} transform="{how}"/>'
        for how in ("matrix(-1 0 0 1 4 1)", "matrix(1 0 .5 1 4 4)", "rotate(30 5 5)")
    )
    found = read_written(_svg(tmp_path, f'{WALL}<g id="items" data-gap="0">{bent}</g>'))
    assert found.outlines[0].bounds == pytest.approx((1, 1, 4, 3))
    assert found.outlines[1].bounds == pytest.approx((4, 4, 7.5, 6))
    assert found.poses.angle[:2].tolist() == [0.0, 0.0]
    assert np.degrees(found.poses.angle[2]) == pytest.approx(30)
    assert [item.outline.area for item in found.items] == pytest.approx([4.0] * 3)


@pytest.mark.parametrize(
    ("inside", "said"),
    [
        ('<g id="labels"><path d="M0 0&quot;" fill="red"/></g>', "a label that is no path"),
        ('<g id="halos"><path d="M1 1h2v2h-2z" fill="url(#a)"/></g>', "a halo of the colour"),
    ],
)
def test_what_would_be_written_as_it_is_must_be_as_we_write_it(
    tmp_path: Path, inside: str, said: str
) -> None:
    with pytest.raises(ReadError, match=said):
        read_written(_svg(tmp_path, f'{WALL}<g id="items" data-gap="0">{TILES}</g>{inside}'))


@pytest.mark.parametrize("limit", ['data-words="[1"', 'data-words="7"', 'data-size-ratio="much"'])
def test_limits_in_another_form_are_refused_in_a_line(tmp_path: Path, limit: str) -> None:
    with pytest.raises(ReadError, match="in another form than ours"):
        read_written(_svg(tmp_path, f"{WALL}<g id='items' {limit}>{TILES}</g>"))

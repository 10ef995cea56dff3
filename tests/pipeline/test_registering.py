"""Runs that go on from a drawing or a cut sheet, as another program may have saved it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.geometry import affine
from packwork.pipeline.registration import turn_of
from packwork.readers.builtin import builtin_item

QUICK = {"count": 8, "epochs": 40, "levels": "32,64", "effort": "draft", "seed": 3}
NAMES = ["owl", "moon", "arrow"]


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[pw.Layout, Path]:
    """A layout, and a folder with its files."""
    folder = tmp_path_factory.mktemp("first")
    layout = pw.fill("heart", NAMES, **QUICK)
    for ending in ("svg", "dxf"):
        layout.save(folder / f"first.{ending}")
    return layout, folder


@pytest.mark.parametrize("ending", ["svg", "dxf"])
def test_a_run_goes_on_from_a_drawing(first: tuple[pw.Layout, Path], ending: str) -> None:
    before, folder = first
    unit = {"canvas": "158.75mm"} if ending == "dxf" else {}
    after = pw.fill(
        "heart", NAMES, start=str(folder / f"first.{ending}"), stay=True, **QUICK, **unit
    )
    ratio = after.container.side / before.container.side
    x, y = (after.poses.x / ratio - before.poses.x, after.poses.y / ratio - before.poses.y)
    assert (np.hypot(x, y) < 0.5 * np.sqrt(before.areas)).all()
    factors = after.poses.scale / (before.poses.scale * ratio)
    turn = np.remainder(after.poses.angle - before.poses.angle + np.pi, 2 * np.pi) - np.pi
    # One of free sizes may give way: which, and how far, differs among machines.
    as_before = (np.abs(factors - 1) < 0.25) & (np.abs(turn) < np.radians(20))
    assert as_before.sum() >= len(before) - 1
    assert after.manifest["certified"]


def test_what_was_moved_by_hand_stays_where_it_was_put(
    first: tuple[pw.Layout, Path], tmp_path: Path
) -> None:
    before, folder = first
    text = (folder / "first.svg").read_text("utf-8")
    # What an editor makes of it: a layer with a transform, one copy with a matrix of its own.
    text = text.replace('<g id="items"', '<g id="items" transform="translate(0 0)"')
    found = re.search(r'(<use id="item-2"[^>]*transform=")([^"]*)"', text)
    assert found is not None
    x, y = before.container.width / 2, before.container.height / 2
    moved = f"matrix(0 1 -1 0 {x} {y})scale({before.poses.scale[1]})"
    edited = tmp_path / "edited.svg"
    edited.write_text(text.replace(found.group(2), moved, 1), "utf-8")
    after = pw.fill("heart", NAMES, start=str(edited), stay=True, **QUICK)
    reach = 2 * before.items[1].outline.radius * before.poses.scale[1]
    assert np.hypot(after.poses.x[1] - x, after.poses.y[1] - y) < reach


@pytest.mark.parametrize("name", ["owl", "arrow", "moon", "star"])
def test_turns_are_found(name: str) -> None:
    outline = builtin_item(name).outline
    rng = np.random.default_rng(1)
    for turn in rng.uniform(-np.pi, np.pi, 5):
        placed = outline.mapped(affine.similarity(7.0, -3.0, float(turn), 2.5))
        back = outline.mapped(affine.similarity(7.0, -3.0, turn_of(outline, placed), 2.5))
        beyond = back.region.symmetric_difference(placed.region).area
        assert beyond < 0.02 * placed.area


def test_a_disc_is_not_turned() -> None:
    outline = builtin_item("circle").outline
    assert abs(turn_of(outline, outline.mapped(affine.similarity(1.0, 2.0, 1.0, 3.0)))) < 0.3


def test_few_new_items_make_nobody_jump(tmp_path: Path) -> None:
    before = pw.fill("circle", NAMES, **(QUICK | {"count": 24, "epochs": 100}))
    before.save(tmp_path / "before.geojson")
    options = QUICK | {"count": 26, "epochs": 100}
    after = pw.fill("circle", NAMES, start=str(tmp_path / "before.geojson"), stay=True, **options)
    known = [(k, j) for k, j in enumerate(_who(after, before)) if j >= 0]
    now, then = (np.array(part) for part in zip(*known, strict=True))
    way = np.hypot(
        after.poses.x[now] - before.poses.x[then], after.poses.y[now] - before.poses.y[then]
    )
    across = 2 * np.sqrt(before.areas[then] / np.pi)
    assert (way < across).all()
    assert after.manifest["certified"]


def _who(after: pw.Layout, before: pw.Layout) -> list[int]:
    from packwork.pipeline.registration import matched

    names = ([item.name for item in layout.items] for layout in (after, before))
    return [int(k) for k in matched(*names)]

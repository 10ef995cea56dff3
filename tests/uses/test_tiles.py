"""Tiles: certified on the torus, repeated in every file without a seam, refused where they must."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork import uses
from packwork.errors import PackworkError, RecipeError
from packwork.metrics.measure import measure
from packwork.metrics.torus import torus_metrics
from packwork.raster.drawing import drawn_png
from packwork.readers.layouts.read import read_written
from packwork.scene.layout import Layout
from packwork.scene.neighbours import side_by_side
from packwork.steps.appearance import beside
from packwork.writers.bitmaps import png_bytes

KINDS = ["square", "half-drop", "hexagon"]


ITEMS = ["star", "heart", "bolt"]


@cache
def drafted(kind: str, count: int = 9, seed: int = 0, **options: object) -> Layout:
    return pw.fill("page", ITEMS, tile=kind, count=count, seed=seed, effort="draft", **options)


@pytest.mark.parametrize(("kind", "seed"), [*zip(KINDS, range(3), strict=True), ("hexagon", 0)])
def test_tiles_are_certified_on_the_torus(kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    layout = drafted(kind, int(rng.integers(1, 20)), seed, padding=float(rng.integers(3)))
    assert layout.manifest["certified"]
    lattice = layout.container.lattice
    assert lattice is not None
    assert torus_metrics(layout.outlines, lattice).overlap_area == 0
    assert len({(p, q) for p, q in zip(layout.poses.x, layout.poses.y, strict=True)}) == len(
        layout.items
    )


@pytest.mark.parametrize("kind", KINDS)
def test_files_of_a_tile_are_read_back_as_one(kind: str, tmp_path: Path) -> None:
    layout = drafted(kind)
    for name in ("tile.svg", "tile.geojson"):
        layout.save(tmp_path / name)
        again = read_written(tmp_path / name)
        assert again.container.lattice == layout.container.lattice
        assert not again.manifest.get("changed")
        seen = measure(again).exact
        assert seen.is_clean
        assert seen.coverage == pytest.approx(measure(layout).exact.coverage, abs=1e-4)


@pytest.fixture(scope="module")
def text_of_a_tile(tmp_path_factory: pytest.TempPathFactory) -> str:
    layout = pw.fill("page", ["star", "owl"], tile="square", count=8, effort="draft", seed=1)
    path = tmp_path_factory.mktemp("tile") / "a.svg"
    layout.save(path)
    assert pw.Layout.load(path).certified
    return path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("found", "put"),
    [
        (r"<use[^>]*translate\([^>]*/>\n(?=</g>)", ""),
        (r'<g id="images".*?</g>', ""),
        (r'(<g id="images")', r'\1 opacity="0"'),
        (r'(<g id="images")', r'\1 transform="translate(37 0)"'),
        (r'(<g id="images"[^>]*>\n)(<use[^>]*/>\n)', r"\1\2\2"),
    ],
    ids=["one is gone", "all are gone", "hidden", "moved", "one is there twice"],
)
def test_images_that_were_changed_by_hand_are_told(
    found: str, put: str, text_of_a_tile: str, tmp_path: Path
) -> None:
    changed = re.sub(found, put, text_of_a_tile, count=1, flags=re.DOTALL)
    assert changed != text_of_a_tile
    (tmp_path / "b.svg").write_text(changed, encoding="utf-8")
    assert not pw.Layout.load(tmp_path / "b.svg").certified


def test_an_image_that_was_moved_by_hand_is_told(tmp_path: Path) -> None:
    drafted("square").save(tmp_path / "tile.svg")
    text = (tmp_path / "tile.svg").read_text(encoding="utf-8")
    assert "translate(600 0)" in text
    (tmp_path / "tile.svg").write_text(
        text.replace("translate(600 0)", "translate(590 0)", 1), encoding="utf-8"
    )
    (told,) = read_written(tmp_path / "tile.svg").manifest["changed"]
    assert "an image beyond the edge: its place changes what is drawn" in told


@pytest.mark.parametrize("kind", KINDS)
def test_a_picture_goes_on_on_its_other_side(kind: str) -> None:
    # Where the seam is must not be seen: the same layout cut elsewhere is the same picture, rolled.
    layout = drafted(kind)
    lattice = layout.container.lattice
    assert lattice is not None
    there = replace(layout.poses, x=layout.poses.x + lattice.width / 2, y=layout.poses.y + 40.0)
    x, y = lattice.wrapped(np.column_stack([there.x, there.y])).T
    cut_elsewhere = replace(layout, poses=replace(there, x=x, y=y))
    here, moved = (
        np.array(Image.open(BytesIO(png_bytes(one, 600))).convert("RGB")).astype(int)
        for one in (layout, cut_elsewhere)
    )
    off = 40, round(lattice.width / 2)
    # A renderer counts edges by rows of a quarter of a pixel: it may be off by one of them.
    assert np.abs(np.roll(here, off, axis=(0, 1)) - moved).max() <= 64


def test_words_and_photos_make_tiles_too(tmp_path: Path) -> None:
    words = pw.words("page", {"one": 9, "two": 4, "three": 2}, tile="square", effort="draft")
    assert words.manifest["certified"]
    for k in range(4):
        Image.new("RGB", (60 + 9 * k, 80), (40 * k, 90, 120)).save(tmp_path / f"{k}.png")
    photos = pw.photos("page", tmp_path, tile="half-drop", effort="draft")
    assert photos.manifest["certified"]


def test_one_giant_of_a_tile_is_said_to_show_the_repeat() -> None:
    def advice(weights: dict[str, float]) -> tuple[str, ...]:
        recipe = uses.words_recipe("page", weights, tile="square", effort="draft", levels="50")
        return uses.fill(recipe).advice

    small = {f"word{k}": 1.0 for k in range(8)}
    (told,) = [one for one in advice({"giant": 20.0, **small}) if "the tile repeats" in one]
    assert told.startswith("giant is ")
    assert "weights that differ less would hide it" in told
    assert not any("the tile repeats" in one for one in advice(small))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"hero": "star"}, "hero: says where items lie, and a tile has no places"),
        ({"force": "down"}, "force: says where"),
        ({"target_coverage": 0.9}, "target_coverage: goes by the room in a container"),
        ({"start": "scatter"}, "start: says where"),
        ({"apart": True}, "apart: looks at neighbours"),
        ({"rules": [{"items": "star", "pin": {"x": 1, "y": 1}}]}, "rules: pin and region"),
    ],
)
def test_what_needs_walls_or_places_is_refused(options: dict[str, object], said: str) -> None:
    with pytest.raises(RecipeError, match=said):
        pw.fill("page", ITEMS, tile="square", effort="draft", **options)


def test_a_container_with_a_shape_is_no_tile() -> None:
    with pytest.raises(PackworkError, match="a tile has no walls, but circle has a shape"):
        pw.fill("circle", "star", tile="square", effort="draft")


def test_what_a_tile_has_not_is_said_before_it_is_written(tmp_path: Path) -> None:
    layout = drafted("square")
    for name, options in (
        ("a.svg", {"cut": "outlines"}),
        ("a.svg", {"flatten": True}),
        ("a.dxf", {}),
    ):
        with pytest.raises(RecipeError, match="a tile goes on over its edge: it has no "):
            layout.save(tmp_path / name, **options)
    with pytest.raises(RecipeError, match="tiles: draws them side by side; this is none"):
        pw.fill("page", "star", count=2, effort="draft").save(tmp_path / "a.svg", tiles=2)


def test_a_preview_is_the_tile_side_by_side(tmp_path: Path) -> None:
    layout = drafted("half-drop")
    layout.save(tmp_path / "one.png", pixels=200)
    layout.save(tmp_path / "nine.png", pixels=600, tiles=3)
    one, nine = (np.array(Image.open(tmp_path / f"{name}.png")) for name in ("one", "nine"))
    assert np.array_equal(nine, np.tile(one, (3, 3, 1)))
    layout.save(tmp_path / "nine.svg", tiles=3, background="#fff")
    text = (tmp_path / "nine.svg").read_text(encoding="utf-8")
    assert '<pattern id="tile" width="600" height="600" patternUnits="userSpaceOnUse">' in text
    assert 'viewBox="0 0 1800 1800"' in text
    drawn = np.array(Image.open(BytesIO(drawn_png(text))).convert("RGB").resize((600, 600)))
    assert np.abs(drawn.astype(int) - nine[..., :3]).mean() < 3
    layout.save(tmp_path / "nine.pdf", tiles=3)


def test_neighbours_over_the_edge_take_other_colours_too() -> None:
    layout = drafted("square", 12, palette=("#111111", "#888888", "#dddddd"))
    pairs = beside(layout)
    within = side_by_side(layout.outlines)
    assert {tuple(pair) for pair in pairs.tolist()} - {tuple(pair) for pair in within.tolist()}

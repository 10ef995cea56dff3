"""Photos that cover the container's edge and are cut at its line."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from packwork import uses
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.pipeline.result import Run
from packwork.readers.layouts.read import read_written
from packwork.scene.item import PhotoArt
from packwork.scene.pose import Poses
from packwork.uses.photos import crop, rim
from packwork.writers.bitmaps import png_bytes
from packwork.writers.svg import SheetSize, SvgOptions, svg_document
from scenes import square

QUICK = {"effort": "draft", "levels": "50", "edge": "crop"}


@pytest.fixture(scope="module")
def album(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("album")
    for k in range(8):
        Image.new("RGB", (90, 60) if k % 2 else (60, 80), "teal").save(folder / f"photo-{k}.jpg")
    return folder


@pytest.fixture(scope="module")
def run(album: Path) -> Run:
    return uses.fill(uses.photos_recipe("circle", [str(album)], **QUICK), record=True)


def rim_covered(run: Run) -> float:
    """Share of the container's line that has an item within a thousandth of the canvas."""
    container = run.layout.container
    near = shapely.union_all([o.region.buffer(1e-3 * container.side) for o in run.layout.outlines])
    line = container.outline.region.boundary
    return float(line.intersection(near).length / line.length)


def test_photos_cover_the_edge_and_stay_inside(run: Run, album: Path) -> None:
    assert run.certified
    assert not run.unplaced
    assert run.metrics.exact.exceeding == 0
    inside = uses.photos_recipe("circle", [str(album)], **{**QUICK, "edge": "inside"})
    assert rim_covered(run) > 1.5 * rim_covered(uses.fill(inside))


def test_files_hold_what_is_seen(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    size = (run.layout.container.width, run.layout.container.height)
    sheet = SheetSize(size=size, unit="px", view=size)
    path.write_text(svg_document(run.layout, SvgOptions(), sheet), encoding="utf-8")
    read = read_written(str(path))
    assert np.allclose(np.sort(read.areas), np.sort(run.layout.areas), rtol=1e-4)
    picture = tmp_path / "a.png"
    picture.write_bytes(png_bytes(run.layout, 200))
    with Image.open(picture) as drawn:
        teal = np.asarray(drawn.convert("RGB"))[:, :, 0] < 128
    share = run.layout.areas.sum() / run.layout.container.width / run.layout.container.height
    assert teal.mean() == pytest.approx(share, abs=0.02)


def test_what_is_printed_is_cut_like_the_small_copy(run: Run) -> None:
    arts = [item.art for item in run.layout.items if isinstance(item.art, PhotoArt)]
    cut = [art for art in arts if 'id="edge-' in art.preview.markup]
    assert cut
    for art in cut:
        printed = art.original.printed(1.0)
        assert printed.markup.split("</clipPath>")[0] == art.preview.markup.split("</clipPath>")[0]


def test_a_film_ends_where_the_photos_lie(run: Run) -> None:
    assert run.layout.track is not None
    end = run.layout.track.at(1.0)
    assert np.allclose(end.x, run.layout.poses.x)
    assert np.allclose(end.y, run.layout.poses.y)


def test_words_among_cut_photos_are_refused(album: Path) -> None:
    photos = {"sources": [str(album)], "edge": "crop"}
    recipe = uses.words_recipe("circle", {"bear": 2}, photos=photos, effort="draft")
    with pytest.raises(RecipeError, match="edge: crop words are read whole"):
        uses.read(recipe)


@pytest.mark.parametrize(
    ("options", "match"),
    [
        ({"finish": "none"}, "edge: crop needs --finish exact"),
        ({"sizes": "shared"}, "edge: crop enlarges photos at the edge"),
    ],
)
def test_what_cannot_be_cut_is_refused(album: Path, options: dict[str, str], match: str) -> None:
    with pytest.raises(RecipeError, match=match):
        uses.fill(uses.photos_recipe("circle", [str(album)], **QUICK, **options))


def test_items_round_which_nothing_changes_are_looked_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tries: list[int] = []
    usual = rim._tried

    def counted(outline: Outline, poses: Poses, k: int, largest: float) -> Iterator[Poses]:
        tries.append(k)
        return usual(outline, poses, k, largest)

    monkeypatch.setattr(rim, "_tried", counted)
    count = 40
    x, y = 12.0 * (np.arange(count) % 8) + 6, 12.0 * (np.arange(count) // 8) + 6
    tiles = [square(2.5)] * count
    start = Poses(x, y, np.zeros(count), np.ones(count))
    most, free = np.full(count, 1.5), np.ones(count, dtype=bool)
    rim.spread_to(shapely.box(0, 0, 96, 60), tiles, start, most, free, 0.01, 0.3)
    # Each grows once or twice; six rounds would be six tries for each.
    assert len(tries) < 4 * count


def test_each_photo_is_placed_where_less_of_a_rim_does(
    album: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Of a photo that is cut at all, less than this is seen.
    monkeypatch.setattr(crop, "LEAST_SEEN", 0.999)
    recipe = uses.photos_recipe("circle", [str(album)], **QUICK)
    assert not uses.fill(recipe).unplaced
    monkeypatch.setattr(crop, "DEPTHS", crop.DEPTHS[:1])
    lost = uses.fill(recipe).unplaced
    assert lost
    assert all("--edge inside" in one.reason for one in lost)


def test_few_photos_that_do_not_show_the_shape_are_told_of_the_cut(album: Path) -> None:
    run = uses.fill(uses.photos_recipe("usa", [str(album)], **{**QUICK, "edge": "inside"}))
    assert "--edge crop" in " ".join(run.advice)
    assert "-n " in " ".join(run.advice)


def test_a_bare_edge_is_told_with_the_number_that_covers_it(
    album: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(crop, "MOST_BARE_EDGE", 0.0)
    cut = uses.fill(uses.photos_recipe("usa", [str(album)], **QUICK))
    assert 0 < crop.bare_edge(cut.layout, 0.0) < 1
    (line,) = cut.advice
    assert re.fullmatch(
        r"\d+ % of the container's edge lies bare; -n \d+ would cover more of it", line
    )

"""Lines of one width on items of all sizes."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork import uses
from packwork.errors import RecipeError
from packwork.metrics.exact import exact_metrics
from packwork.readers.layouts.read import read_written
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.thinner import line_drawing
from packwork.recipe import make_recipe
from packwork.scene.item import Item, VectorArt
from packwork.scene.layout import Layout

HEAD = '<svg viewBox="0 0 24 24" fill="none" stroke="currentColor" stroke-width="2" '
ROUND = HEAD + 'stroke-linecap="round" stroke-linejoin="round">'
HOUSE = ROUND + '<path d="M3 12 12 3l9 9"/><path d="M5 12v9h14v-9"/></svg>'
RING = ROUND + '<circle cx="12" cy="12" r="9"/><path d="M12 7v5l3 3"/></svg>'
SPIKES = HEAD + 'stroke-linecap="square"><path d="M2 20 8 4l4 14 4-14 6 16"/></svg>'
DOTS = ROUND + '<path d="M4 12h16" stroke-dasharray="3 4"/><path d="M12 4v.01"/></svg>'
BARE = '<svg viewBox="0 0 24 24"><path d="M3 3h18v18" fill="none" stroke="red"/></svg>'
USED = (
    '<svg viewBox="0 0 24 24"><defs><path id="a" d="M2 2h8v8" stroke-width="3"/></defs>'
    '<g fill="none" stroke="red"><use href="#a"/><use href="#a" x="10" y="9"/></g></svg>'
)
SHEARED = (
    '<svg viewBox="0 0 24 24"><g transform="scale(2 1) rotate(20)">'
    '<path d="M2 2h7l-3 9" fill="none" stroke="red" style="stroke-width:1.5px"/></g></svg>'
)
DRAWINGS = {
    "house": HOUSE, "ring": RING, "spikes": SPIKES, "dots": DOTS, "bare": BARE, "used": USED,
    "sheared": SHEARED,
}  # fmt: skip
FILLED = '<svg><path d="M0 0h20v20z" stroke="red"/></svg>'


def test_lines_of_unlike_widths_are_told_where_sizes_are_free(tmp_path: Path) -> None:
    def told(*drawings: str, **options: object) -> bool:
        for k, svg in enumerate(drawings):
            (tmp_path / f"{k}.svg").write_text(svg, encoding="utf-8")
        items = [str(tmp_path / f"{k}.svg") for k in range(len(drawings))]
        recipe = make_recipe(container="square", items=items, count=9, effort="draft", **options)
        return any("--stroke-width even" in one for one in uses.fill(recipe).advice)

    wide = HOUSE.replace('stroke-width="2"', 'stroke-width="9"')
    assert told(HOUSE, RING, wide)
    assert not told(HOUSE, RING, wide, stroke_width="even")
    assert not told(HOUSE, RING, wide, sizes="shared")
    assert not told(HOUSE, RING, size_ratio=1.2)
    assert not told(FILLED)


def item_of(svg: str, name: str = "it") -> Item:
    return item_of_svg(svg.encode(), name, f"{name}.svg")


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("factor", [0.97, 0.5, 0.1])
def test_thinner_lines_lie_within_the_wider_ones(name: str, factor: float) -> None:
    item = item_of(DRAWINGS[name])
    drawn = line_drawing(item)
    assert drawn is not None
    for holes in ("fill", "keep"):
        thinner = drawn.thinner(factor, holes)  # type: ignore[arg-type]
        assert thinner is not None
        beyond = shapely.difference(thinner.outline.region, item.outline.region)
        assert beyond.area < 1e-12 * item.outline.area
        assert thinner.ink.area < item.ink.area
        # What is drawn is what is measured.
        assert isinstance(thinner.art, VectorArt)
        again = line_drawing(thinner)
        assert again is not None
        assert again.width == pytest.approx(factor * drawn.width, rel=0.05)


def test_widths_are_counted_in_the_items_own_units() -> None:
    nested = '<svg width="48" height="48" viewBox="0 0 24 24"><g transform="scale(3)">'
    nested += '<path d="M1 1h6" stroke="red" stroke-width="2"/></g></svg>'
    drawn = line_drawing(item_of(nested))
    assert drawn is not None
    assert drawn.width == pytest.approx(2 * 3 * 2)


def test_what_is_filled_is_no_line_drawing() -> None:
    assert line_drawing(item_of(FILLED)) is None
    [star] = pw.read_items("star")
    assert line_drawing(star) is None


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    folder = tmp_path_factory.mktemp("lines")
    for name in ("house", "ring", "spikes"):
        (folder / f"{name}.svg").write_text(DRAWINGS[name], encoding="utf-8")
    return [str(path) for path in sorted(folder.iterdir())]


def filled(files: list[str], **options: object) -> Layout:
    return pw.fill(
        "circle", files, count=9, size_ratio=4, effort="draft", levels="50", canvas=300, **options
    )


def drawn_widths(layout: Layout) -> list[float]:
    drawings = [line_drawing(item) for item in layout.items]
    return [
        0.0 if drawn is None else drawn.width * float(scale)
        for drawn, scale in zip(drawings, layout.poses.scale, strict=True)
    ]


def test_lines_are_alike_on_all_items_and_in_all_files(files: list[str], tmp_path: Path) -> None:
    scaled, even = filled(files), filled(files, stroke_width="even")
    assert np.ptp(drawn_widths(scaled)) > 5 * np.ptp(drawn_widths(even))
    assert drawn_widths(even) == pytest.approx([drawn_widths(even)[0]] * 9, rel=0.03)
    assert min(drawn_widths(even)) > min(drawn_widths(scaled)) / 2
    assert even.manifest["certified"]
    assert even.manifest["metrics"]["LC_ink"] < scaled.manifest["metrics"]["LC_ink"]
    for ending in ("svg", "geojson", "dxf"):
        even.save(tmp_path / f"even.{ending}")
        written = read_written(tmp_path / f"even.{ending}")
        to_px = even.container.side / written.container.side
        areas = [outline.area * to_px**2 for outline in written.outlines]
        assert areas == pytest.approx([outline.area for outline in even.outlines], rel=1e-3)
        exact = exact_metrics(written.outlines, written.container.outline)
        assert exact.overlap_area == exact.outside_area == 0


def test_items_grow_into_the_room_that_thinner_lines_leave(files: list[str]) -> None:
    scaled, even = filled(files), filled(files, stroke_width="even")
    common = min(drawn_widths(scaled))
    left = 0.0
    for item, scale in zip(scaled.items, scaled.poses.scale.tolist(), strict=True):
        drawn = line_drawing(item)
        assert drawn is not None
        factor = common / (drawn.width * scale)
        thinner = drawn.thinner(factor, "fill") if factor < 0.98 else item
        assert thinner is not None
        left += thinner.outline.area * scale**2
    covered = even.manifest["metrics"]["exact"]["LC"]
    assert covered > left / even.container.outline.area


def test_shares_are_promised_no_more(files: list[str]) -> None:
    even = filled([*files, "star"], stroke_width="even", sizes="shared")
    assert even.manifest["certified"]
    assert not even.manifest["promised"]["areas_in_shares"]


def test_voids_may_be_filled_with_thinner_lines(files: list[str]) -> None:
    even = filled(files, stroke_width="even", max_items=14)
    assert even.manifest["certified"]


def test_a_pile_has_lines_alike(files: list[str]) -> None:
    heap = pw.pile("square", files, count=6, size="20%", canvas=300, stroke_width="even")
    assert heap.manifest["certified"]
    assert np.ptp(drawn_widths(heap)) <= 0.03 * max(drawn_widths(heap))


def test_it_is_told_where_nothing_is_drawn_in_lines(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        filled(["star"], stroke_width="even")
    assert "stroke_width: even changes nothing, for no item is drawn in lines" in caplog.text


def test_marks_of_a_chart_keep_their_areas(tmp_path: Path) -> None:
    table = tmp_path / "a.csv"
    table.write_text("name,value\na,1\nb,2\n", encoding="utf-8")
    with pytest.raises(RecipeError, match="stroke_width: even changes the areas of marks"):
        pw.chart("circle", table, size_by="value", stroke_width="even")


def test_drawings_that_are_traced_are_named(
    files: list[str], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    masked = ROUND + '<mask id="m"><path d="M0 0h24v24H0z" fill="#fff" stroke="none"/></mask>'
    masked += '<path mask="url(#m)" d="M3 3h18v18H3z"/></svg>'
    (tmp_path / "masked.svg").write_text(masked, encoding="utf-8")
    with caplog.at_level(logging.WARNING):
        filled([*files, str(tmp_path / "masked.svg")], stroke_width="even")
    said = [text for text in caplog.messages if "traced from their pictures" in text]
    assert len(said) == 1
    assert said[0].endswith("masked.svg")

"""A chart on the desk: of a table that is dropped, its keys shown, its marks under the hand."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest

import packwork as pw
from studio.browsing import PHONE, Desk, in_browser
from studio.test_incoming import give, names

pytestmark = in_browser

EXCEL = (
    "Land;Tassen;Kontinent\nFinnland;12,0;Europa\nIsland;9,0;Europa\nBrasilien;5,8;Amerika\n"
    "Kanada;6,5;Amerika\nJapan;3,4;Asien\nVietnam;1,9;Asien\nTschad;;Afrika\n"
)
TITLE = "Kaffee je Kopf"


@pytest.fixture
def table(tmp_path: Path) -> Path:
    file = tmp_path / "kaffee.csv"
    file.write_text(EXCEL, encoding="utf-8-sig")
    return file


def draw(desk: Desk, file: Path) -> None:
    """Have the chart that the dialog offers for a table."""
    give(desk, file)
    desk.page.locator("dialog.asking[open]").get_by_role("button", name="A chart").click()
    desk.page.get_by_role("button", name="Draw the chart").click()
    desk.until("studio.collage.scene?.kind === 'chart'")
    desk.settled()


def saved(desk: Desk, kept: Path) -> pw.Layout:
    """The certified layout of a document that is saved to a file."""
    with desk.page.expect_download() as waiting:
        desk.page.keyboard.press("Control+s")
    waiting.value.save_as(kept)
    layout = pw.Session.open(kept).layout
    assert layout.certified
    return layout


def areas(desk: Desk) -> list[float]:
    """Areas of the marks over that of the first."""
    scales = desk.look("studio.collage.items.map(item => studio.collage.pose(item.id).scale)")
    return [(scale / scales[0]) ** 2 for scale in scales]


def test_a_table_of_excel_becomes_a_chart_under_the_hand(
    open_desk: Callable[..., Desk], table: Path, tmp_path: Path
) -> None:
    desk = open_desk()
    give(desk, table)
    asked = desk.page.locator("dialog.asking[open]")
    asked.get_by_role("button", name="A chart").click()
    assert [asked.get_by_label(one).input_value() for one in ("Size", "Colour", "Names")] == [
        "Tassen", "Kontinent", "Land"
    ]  # fmt: skip
    asked.get_by_label("Title").fill(TITLE)
    desk.picture("chart-asked")
    asked.get_by_label("Title").press("Enter")
    # Waited for first: such a line goes after some seconds.
    desk.page.get_by_text("kaffee.csv: left out 1 row of 7", exact=False).wait_for()
    desk.until("studio.collage.scene?.kind === 'chart'")
    desk.settled()
    assert desk.page.get_by_text("packwork-studio").count() == 0
    assert names(desk) == ["Finnland", "Island", "Brasilien", "Kanada", "Japan", "Vietnam"]
    assert areas(desk) == pytest.approx([1, 9 / 12, 5.8 / 12, 6.5 / 12, 3.4 / 12, 1.9 / 12])
    on_marks = desk.look("studio.collage.scene.notes.filter(note => note.item !== null).length")
    assert 0 < on_marks < desk.look("studio.collage.scene.notes.length")
    assert desk.page.locator("#title").input_value() == TITLE
    desk.page.mouse.click(*desk.place(0))
    assert desk.page.locator(".editor label:has-text('Weight')").is_hidden()
    assert desk.look("studio.stage.handles().map(handle => handle.kind)") == ["turn"]
    before = desk.look("studio.collage.pose(0).x")
    x, y = desk.place(0)
    desk.drag((x, y), (x + 60, y + 40))
    desk.settled()
    desk.page.keyboard.press("h")
    desk.until("studio.areHeld")
    desk.settled()
    assert desk.look("studio.collage.pose(0).x") != before
    sizes = areas(desk)
    desk.pour(lambda: desk.page.keyboard.press("r"))
    assert areas(desk) == pytest.approx(sizes)
    desk.picture("chart")
    # What is saved opens as the same chart, and what was written shows its keys.
    kept = tmp_path / "chart.packwork"
    layout = saved(desk, kept)
    assert any(note.says == TITLE for note in layout.notes)
    document = desk.look("studio.document")
    give(desk, kept)
    desk.until(f"studio.document !== {document}")
    desk.settled()
    assert areas(desk) == pytest.approx(sizes)


def test_each_group_of_a_chart_has_a_container_of_its_own(
    open_desk: Callable[..., Desk], table: Path
) -> None:
    desk = open_desk()
    give(desk, table)
    asked = desk.page.locator("dialog.asking[open]")
    asked.get_by_role("button", name="A chart").click()
    asked.get_by_label("Groups").select_option("Tassen")
    assert asked.get_by_label("In steps of").is_visible()
    asked.get_by_label("Groups").select_option("Kontinent")
    assert asked.get_by_label("In steps of").is_hidden()
    desk.picture("chart-groups-asked")
    asked.get_by_role("button", name="Draw the chart").click()
    parts = "(studio.collage.scene?.outline.match(/M/g) ?? []).length"
    desk.until(f"studio.collage.scene?.kind === 'chart' && {parts} === 3")
    desk.settled()
    desk.picture("chart-groups")
    # The last two marks are Asia's: poured anew they lie beside each other, far from the first.
    desk.pour(lambda: desk.page.keyboard.press("r"))
    places = [desk.look(f"(p => [p.x, p.y])(studio.collage.pose({k}))") for k in (4, 5, 0)]
    near, far = (math.dist(places[0], other) for other in places[1:])
    assert near < 0.5 * desk.look("studio.collage.scene.width") < 2 * far
    desk.picture("chart-groups-anew")
    # Another chart begins in the container of one of them.
    desk = open_desk()
    draw(desk, table)
    desk.until(f"{parts} === 1")
    desk.settled()


LAND = {
    "Nord": [[8, 52], [14, 52], [14, 54], [8, 54], [8, 52]],
    "Sued": [[8, 48], [14, 48], [14, 52], [8, 52], [8, 48]],
}
FARMS = "hof,land,hektar\nA,Nord,30\nB,Nord,12\nC,Sued,40\nD,Sued,22\nE,sued,9\nF,Meer,7\n"


def test_marks_lie_in_the_regions_of_a_map_that_was_dropped(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    features = [
        {
            "type": "Feature",
            "properties": {"name": name},
            "geometry": {"type": "Polygon", "coordinates": [ring]},
        }
        for name, ring in LAND.items()
    ]
    land, farms = tmp_path / "land.geojson", tmp_path / "farms.csv"
    land.write_text(
        json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8"
    )
    farms.write_text(FARMS, encoding="utf-8")
    desk = open_desk()
    give(desk, land)
    desk.page.get_by_text("to fill its regions, drop a table", exact=False).wait_for()
    desk.until("studio.collage.scene?.name === 'land'")
    desk.settled()
    give(desk, farms)
    asked = desk.page.locator("dialog.asking[open]")
    asked.get_by_role("button", name="A chart").click()
    assert asked.get_by_label("Groups").input_value() == "land"
    assert asked.get_by_label("Each in its region of the map").is_checked()
    desk.picture("chart-map-asked")
    asked.get_by_role("button", name="Draw the chart").click()
    desk.page.get_by_text("is no part of the map: F", exact=False).wait_for()
    desk.until("studio.collage.scene?.kind === 'chart'")
    desk.settled()
    assert names(desk) == list("ABCDE")
    north, south = desk.place(0), desk.place(2)
    assert north[1] < south[1]
    before = desk.look("JSON.stringify([...studio.collage.poses])")
    desk.drag(south, north)
    desk.answered()
    assert desk.rested() == before
    desk.picture("chart-map")
    kept = tmp_path / "map.packwork"
    layout = saved(desk, kept)
    assert layout.manifest["group_parts"] == [1, 1]
    assert {note.says for note in layout.notes} >= {"Nord", "Sued"}
    # Opened again it has its map, for another chart.
    document = desk.look("studio.document")
    give(desk, kept)
    desk.until(f"studio.document !== {document}")
    desk.settled()
    give(desk, farms)
    asked.get_by_role("button", name="A chart").click()
    assert asked.get_by_label("Each in its region of the map").is_checked()
    asked.get_by_role("button", name="Cancel").click()


def test_a_table_without_numbers_is_a_chart_of_its_rows(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    (tmp_path / "pets.csv").write_text(
        "name,kind\nRex,dog\nTom,cat\nIda,cat\nBo,dog\n", encoding="utf-8"
    )
    desk = open_desk()
    draw(desk, tmp_path / "pets.csv")
    # The desk is shared: a chart may have been there before.
    desk.until("studio.collage.items.length === 4")
    desk.settled()
    assert areas(desk) == pytest.approx([1, 1, 1, 1])
    assert len(set(desk.look("studio.collage.items.map(item => item.shape)"))) == 2


def test_a_table_that_is_none_is_refused_in_one_line(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    (tmp_path / "no.csv").write_bytes(b"\0\1\2\3" * 99)
    desk = open_desk()
    give(desk, tmp_path / "no.csv")
    line = desk.page.locator(".toast.error").first
    line.wait_for()
    assert "no.csv" in line.inner_text()
    assert not desk.page.locator("dialog.asking[open]").count()
    # The browser notes each answer that refuses.
    desk.faults = [one for one in desk.faults if "400" not in one]


def test_the_dialog_of_a_table_fits_a_phone(open_desk: Callable[..., Desk], table: Path) -> None:
    desk = open_desk(PHONE)
    give(desk, table)
    desk.page.locator("dialog.asking[open]").get_by_role("button", name="A chart").click()
    box = desk.page.locator("dialog.asking[open]").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= PHONE["width"]
    desk.picture("chart-asked-phone")

"""Files of a nest: a table of places, a PDF with a list of parts, others one for each sheet."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

import pypdfium2
import pytest
from typer.testing import Result

import packwork as pw

Command = Callable[..., Result]

HOOK = """<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="20mm" viewBox="0 0 30 20">
<path d="M0 0h30v8h-22v12h-8z"/></svg>"""
TILE = """<svg xmlns="http://www.w3.org/2000/svg" width="18mm" height="12mm" viewBox="0 0 18 12">
<path d="M0 0h18v12h-18z"/></svg>"""


@pytest.fixture
def shop(folder: Path) -> Path:
    (folder / "hook.svg").write_text(HOOK, encoding="utf-8")
    (folder / "=tile.svg").write_text(TILE, encoding="utf-8")
    return folder


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def test_the_table_says_where_each_part_lies(shop: Path, packwork: Command) -> None:
    line = "nest 45mm hook.svg*7 =tile.svg*2 --mirror --kerf 1mm --passes 60"
    result = packwork(f"{line} -o a.csv -o a.geojson")
    assert result.exit_code == 0, result.output
    layout = pw.Layout.load(shop / "a.geojson")
    found = rows(shop / "a.csv")
    assert [row["number"] for row in found] == [str(k) for k in range(1, 10)]
    assert {row["sheet"] for row in found} == {"1"}
    # A spreadsheet would take it for a formula.
    assert sorted({row["part"] for row in found}) == ["'=tile", "hook"]
    said = json.loads((shop / "a.geojson").read_text(encoding="utf-8"))
    numbers = said["manifest"]["nest"]["mirrored"]
    assert numbers
    assert [int(row["number"]) for row in found if row["mirrored"] == "yes"] == numbers
    for row, outline, angle in zip(found, layout.outlines, layout.poses.angle, strict=True):
        left, top, right, bottom = outline.bounds
        told = [float(row[f"{name}_mm"]) for name in ("left", "top", "width", "height")]
        assert told == pytest.approx([left, top, right - left, bottom - top], abs=1e-5)
        assert [float(row["x_mm"]), float(row["y_mm"])] == pytest.approx(
            outline.centroid.tolist(), abs=1e-5
        )
        turn = math.radians(float(row["angle_deg"]))
        assert math.cos(turn - angle) == pytest.approx(1)


def test_one_pdf_has_all_sheets_and_a_list_of_parts(shop: Path, packwork: Command) -> None:
    line = "nest 65x45mm hook.svg*6 =tile.svg*5 --kerf 1mm --passes 40"
    result = packwork(f"{line} -o a.pdf -o a.csv -o a.dxf -o b.pdf")
    assert result.exit_code == 0, result.output
    assert "certified" in result.output
    sheets = sorted({int(row["sheet"]) for row in rows(shop / "a.csv")})
    assert len(sheets) > 1
    assert [(shop / f"a-{k}.dxf").exists() for k in sheets] == [True] * len(sheets)
    assert not (shop / "a-1.pdf").exists()
    document = pypdfium2.PdfDocument(shop / "a.pdf")
    assert len(document) == len(sheets) + 1
    sizes = [tuple(25.4 / 72 * side for side in page.get_size()) for page in document]
    assert sizes[:-1] == [pytest.approx((65, 45))] * len(sheets)
    text = document[len(sheets)].get_textpage().get_text_range()
    assert f"11 parts on {len(sheets)} sheets of 65 x 45 mm" in text
    assert "hook" in text
    assert "=tile" in text
    assert "30 x 20 mm" in text
    document.close()
    assert (shop / "a.pdf").read_bytes() == (shop / "b.pdf").read_bytes()


def test_names_are_no_markup_of_the_list(shop: Path, packwork: Command) -> None:
    name = "#read(sys.inputs.list) $x$ *b*"
    (shop / "list.csv").write_text(f'file,name\nhook.svg,"{name}"\n', encoding="utf-8")
    assert packwork("nest 45mm list.csv --passes 5 -o a.pdf").exit_code == 0
    document = pypdfium2.PdfDocument(shop / "a.pdf")
    assert name in document[1].get_textpage().get_text_range()
    document.close()


def test_the_help_names_what_is_written_and_no_other(shop: Path, packwork: Command) -> None:
    said = packwork("nest --help").output
    assert ".csv" in said
    assert ".packwork" in said
    result = packwork("nest 45mm hook.svg -o a.step")
    assert result.exit_code == 2
    assert "the ending '.step' is not known" in result.output
    assert "use one of .svg" in result.output
    assert ".csv" in result.output


def test_each_sheet_is_a_session_too(shop: Path, packwork: Command) -> None:
    result = packwork("nest 100x60mm hook.svg*9 --kerf 2mm --passes 40 -o a.packwork -o a.dxf")
    assert result.exit_code == 0, result.output
    sessions = sorted(shop.glob("a*.packwork"))
    assert [one.stem for one in sessions] == [one.stem for one in sorted(shop.glob("a*.dxf"))]
    assert sum(len(pw.Layout.load(one).items) for one in sessions) == 9
    assert packwork(f"measure {sessions[0].name}").exit_code == 0
    held = pw.Layout.load(sessions[0])
    line = f"nest {sessions[0].name},200x60mm hook.svg*2 --kerf 2mm --passes 40 -o c.packwork"
    assert packwork(line).exit_code == 0
    again = pw.Layout.load(next(iter(sorted(shop.glob("c*.packwork")))))
    for old, new in zip(held.outlines, again.outlines, strict=False):
        assert old.region.symmetric_difference(new.region).area < 1e-9
    line = "nest 100x60mm hook.svg --passes 5 -o b.packwork --no-clobber"
    assert [packwork(line).exit_code for _ in range(2)] == [0, 2]


def test_a_table_that_is_there_is_kept(shop: Path, packwork: Command) -> None:
    (shop / "a.csv").write_text("mine", encoding="utf-8")
    result = packwork("nest 45mm hook.svg --passes 5 -o a.csv --no-clobber")
    assert result.exit_code == 2
    assert (shop / "a.csv").read_text(encoding="utf-8") == "mine"

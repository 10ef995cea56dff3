"""Tables of parts: files from their folder, counts, names and rules of each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

import packwork as pw

Command = Callable[..., Result]

TILE = """<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="10mm" viewBox="0 0 30 10">
<path d="M0 0h30v4l-20 6h-10z"/></svg>"""


@pytest.fixture
def shop(folder: Path) -> Path:
    (folder / "job" / "parts").mkdir(parents=True)
    (folder / "job" / "parts" / "tile.svg").write_text(TILE, encoding="utf-8")
    (folder / "other.svg").write_text(TILE, encoding="utf-8")
    return folder


def listed(shop: Path, text: str, name: str = "list.csv") -> None:
    # Excel saves "Unicode text" so.
    encoding = "utf-16" if name.endswith(".txt") else "utf-8"
    (shop / "job" / name).write_text(text, encoding=encoding)


def names(path: Path) -> list[str]:
    return [placed.name for placed in pw.Layout.load(path)]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("list.csv", "file,count\nparts/tile.svg,3\n"),
        ("list.csv", "Part;Qty;File\n;3;parts/tile.svg\n"),
        ("list.tsv", "drawing\tquantity\nparts/tile.svg\t3.0\n\n"),
        ("list.txt", "drawing\tquantity\nparts/tile.svg\t3\n"),
    ],
)
def test_files_are_found_from_the_folder_of_the_table(
    shop: Path, packwork: Command, name: str, text: str
) -> None:
    listed(shop, text, name)
    result = packwork(f"nest 40mm job/{name} --passes 5 -o a.geojson")
    assert result.exit_code == 0, result.output
    assert names(shop / "a.geojson") == ["tile"] * 3


def test_rows_have_names_and_rules_and_the_list_may_be_wanted_twice(
    shop: Path, packwork: Command
) -> None:
    listed(
        shop,
        'file,count,name,rotate,mirror,priority\nparts/tile.svg,1,left,"90,",no,2\n'
        'parts/tile.svg,2,,"0,180",,\nparts/tile.svg,0,never,,,\n',
    )
    result = packwork("nest 40mm job/list.csv*2 --rotate none --passes 5 -o a.geojson")
    assert result.exit_code == 0, result.output
    layout = pw.Layout.load(shop / "a.geojson")
    assert sorted(placed.name for placed in layout) == ["left"] * 2 + ["tile"] * 4
    sizes = {
        placed.name: outline.bounds[2] - outline.bounds[0]
        for placed, outline in zip(layout, layout.outlines, strict=True)
    }
    assert sizes["tile"] == pytest.approx(30, abs=1e-6)
    assert sizes["left"] == pytest.approx(10, abs=1e-6)


def test_what_is_optional_may_be_left_out(shop: Path, packwork: Command) -> None:
    listed(shop, "file,count,optional\nparts/tile.svg,1,no\nparts/tile.svg,30,yes\n")
    result = packwork("nest 40x30mm*1 job/list.csv --passes 60 -o a.geojson")
    assert result.exit_code == 0, result.output
    assert "optional, left out: tile*" in result.output
    assert len(names(shop / "a.geojson")) >= 1


def test_a_kit_lies_on_one_sheet_and_two_kits_are_two(shop: Path, packwork: Command) -> None:
    listed(
        shop,
        "file,count,name,together\nparts/tile.svg,2,arm,kit\nparts/tile.svg,1,foot,kit\n"
        "parts/tile.svg,1,tag,\n",
    )
    result = packwork("nest 34x44mm job/list.csv*2 --passes 60 -o a.geojson --report r.json")
    assert result.exit_code == 0, result.output
    kits = [names(path) for path in sorted(shop.glob("a-*.geojson"))]
    assert [Counter(one)["arm"] for one in kits] == [2, 2]
    assert [Counter(one)["foot"] for one in kits] == [1, 1]
    listed(shop, "file,count,together\nparts/tile.svg,9,kit\n")
    result = packwork("nest 34x44mm job/list.csv --passes 60 -o b.geojson")
    assert result.exit_code == 1
    assert "no room for tile*9" in result.output


def test_columns_that_say_nothing_and_files_elsewhere_are_named(
    shop: Path, packwork: Command
) -> None:
    listed(shop, "file,count,thickness,cost\n../other.svg,1,3,9\n")
    result = packwork("nest 40mm job/list.csv --passes 5 -o a.geojson")
    assert result.exit_code == 0, result.output
    said = " ".join(result.output.split())
    assert "columns that say nothing here: thickness, cost; known are file, count, name," in said
    assert "names files outside its folder: job/../other.svg" in said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "has no column 'file'"),
        ("part,count\nparts/tile.svg,1\n", "has no column 'file', but part, count"),
        ("file,count\n", "lists no parts"),
        ("file,count\nparts/tile.svg,\n", "line 2: a count is a whole number from 0, not ''"),
        ('file,count\nparts/tile.svg,"1,000"\n', "a count is a whole number from 0, not '1,000'"),
        ("file,count\nparts/tile.svg,-2\n", "line 2: a count is a whole number from 0, not '-2'"),
        ("file,count\nparts/tile.svg,2.5\n", "not '2.5'"),
        ("file,count\n\n,7\n", "line 3: names no file"),
        ("file,count\nnone.dxf,1\n", "line 2: there is no file 'job/none.dxf'"),
        ("file,count,count\nparts/tile.svg,1,1\n", "has the column 'count' twice"),
        ("file,count\nparts/tile.svg,1,2\n", "line 2: has 3 cells, the first line names 2"),
        ("file,rotate\nparts/tile.svg,wild\n", "line 2: rotate: use free"),
        ("file,mirror\nparts/tile.svg,perhaps\n", "line 2: mirror: is yes or no, not 'perhaps'"),
        ("file,rotate,rotate\nparts/tile.svg,0,0\n", "has the column 'rotate' twice"),
        ("file,priority\nparts/tile.svg,high\n", "priority: is a whole number, not 'high'"),
        ("file\n" + "parts/tile.svg\n" * 4001, "has more than 4,000 rows"),
    ],
)
def test_a_table_that_cannot_be_is_one_line(
    shop: Path, packwork: Command, text: str, said: str
) -> None:
    listed(shop, text)
    result = packwork("nest 40mm job/list.csv --passes 2 -o a.svg")
    assert result.exit_code == 2
    assert said in result.output
    assert result.output.count("\n") == 1
    assert result.output.startswith("packwork: job/list.csv: ")


def test_another_spreadsheet_is_to_be_saved_as_csv(shop: Path, packwork: Command) -> None:
    listed(shop, "PK", "list.ods")
    result = packwork("nest 40mm job/list.ods --passes 2")
    assert result.exit_code == 2
    assert "is a spreadsheet; save it as .xlsx or CSV" in result.output


@pytest.mark.parametrize(
    ("sheet", "columns", "row", "said"),
    [
        ("40mm", "optional", "1,yes", "items: tile is optional, and a strip of open length"),
        ("40x30mm", "optional,together", "1,yes,kit", "items: column 'together' of tile: parts"),
        ("40x30mm", "together", "2001,kit", "items: column 'together' of tile: more than 2,000"),
    ],
)
def test_columns_that_do_not_go_together_are_named(
    shop: Path, packwork: Command, sheet: str, columns: str, row: str, said: str
) -> None:
    listed(shop, f"file,count,{columns}\nparts/tile.svg,{row}\n")
    result = packwork(f"nest {sheet} job/list.csv --passes 2")
    assert result.exit_code == 2
    assert result.output.startswith(f"packwork: {said}")
    assert result.output.count("\n") == 1


def test_a_list_with_sets_that_is_wanted_too_often_names_the_column(
    shop: Path, packwork: Command
) -> None:
    listed(shop, "file,together\nparts/tile.svg,kit\n")
    result = packwork("nest 40x30mm job/list.csv*1001 --passes 2")
    assert result.exit_code == 2
    assert result.output.startswith("packwork: job/list.csv: column 'together': parts go together")


def test_sheets_that_do_not_go_together_are_told_without_a_flag(
    shop: Path, packwork: Command
) -> None:
    result = packwork("nest 40mm,40x30mm other.svg --passes 2")
    assert result.exit_code == 2
    assert result.output.startswith("packwork: sheet: a strip of open length has no end")

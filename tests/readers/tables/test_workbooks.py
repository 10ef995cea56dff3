"""Workbooks of Excel as tables: what their sheets show, and files that mean harm."""

import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from packwork.errors import PackworkError, ReadError
from packwork.readers.charts import ChartOptions
from packwork.readers.cut_list import read_cut_list
from packwork.readers.tables import workbook
from packwork.readers.tables.durations import durations
from packwork.readers.tables.pairs import read_weights
from packwork.readers.tables.shown import BUILT_IN, shown_by, written
from packwork.readers.tables.table import read_table
from packwork.readers.tables.workbook import MOST_BESIDES
from packwork.readers.words.options import WordOptions
from packwork.readers.words.source import read_words
from packwork.uses.charts.marks import read_chart

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
RELATIONS = "http://schemas.openxmlformats.org/package/2006/relationships"

STYLES = (
    '<numFmts><numFmt numFmtId="164" formatCode="dd/mm/yyyy\\ hh:mm"/></numFmts>'
    '<cellStyleXfs><xf numFmtId="14"/></cellStyleXfs>'
    '<cellXfs><xf numFmtId="0"/><xf numFmtId="10"/><xf numFmtId="164"/></cellXfs>'
)
ROWS = (
    "<row><c t='s'><v>0</v></c><c t='s'><v>1</v></c></row>"
    "<row><c t='inlineStr'><is><r><t>Pe</t></r><r><t>ru</t></r></is></c><c><v>2</v></c></row>"
    "<row r='4'><c r='A4' t='str'><f>A2</f><v>Chad</v></c><c r='B4'><v>0.5</v></c></row>"
)
TEXTS = "<si><t>name</t><rPh><t>spoken</t></rPh></si><si><r><t>k</t></r><r><t>g</t></r></si>"


def _relations(targets: Mapping[str, tuple[str, str]]) -> str:
    told = "".join(
        f'<Relationship Id="{key}" Type="{OFFICE}/{kind}" Target="{target}"/>'
        for key, (kind, target) in targets.items()
    )
    return f'<Relationships xmlns="{RELATIONS}">{told}</Relationships>'


def _book(file: Path, sheets: Mapping[str, str], *, before: str = "", **other: str) -> str:
    """A workbook of sheets by their names, of the elements of their rows."""
    parts = {f"s{k}": ("worksheet", f"/xl/sheets/{k}.xml") for k in range(len(sheets))}
    named = other.get("named", "") + "".join(
        f'<sheet name="{name}" r:id="s{k}" state="{"hidden" if name == "Secret" else "visible"}"/>'
        for k, name in enumerate(sheets)
    )
    written = {
        "_rels/.rels": _relations({"a": ("officeDocument", "xl/workbook.xml")}),
        "xl/_rels/workbook.xml.rels": _relations(
            {**parts, "t": ("sharedStrings", "texts.xml"), "y": ("styles", "styles.xml")}
        ),
        "xl/workbook.xml": (
            f'<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}">{other.get("properties", "")}'
            f"<sheets>{named}</sheets></workbook>"
        ),
        "xl/texts.xml": f'<sst xmlns="{MAIN}">{other.get("texts", TEXTS)}</sst>',
        "xl/styles.xml": f'<styleSheet xmlns="{MAIN}">{STYLES}</styleSheet>',
    }
    for k, rows in enumerate(sheets.values()):
        written[f"xl/sheets/{k}.xml"] = (
            f'{before}<worksheet xmlns="{MAIN}"><sheetData>{rows}</sheetData></worksheet>'
        )
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in written.items():
            archive.writestr(name, text)
    return str(file)


def test_texts_formulas_and_gaps_of_the_first_sheet_that_is_shown(tmp_path: Path) -> None:
    file = _book(tmp_path / "a.xlsx", {"Secret": "", "Sales": ROWS})
    table = read_table(file)
    assert table.rows == ({"name": "Peru", "kg": "2"}, {"name": "Chad", "kg": "0.5"})


def test_formulas_that_nothing_has_computed_are_told(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text("<svg/>", encoding="utf-8")
    rows = (
        "<row><c t='inlineStr'><is><t>file</t></is></c><c t='inlineStr'><is><t>count</t></is></c>"
        "</row><row><c r='A2' t='inlineStr'><is><t>a.svg</t></is></c><c r='B2'><f>1+1</f><v/></c>"
        "<c r='C2' t='str'><f>\"\"</f><v></v></c></row>"
    )
    file = _book(tmp_path / "a.xlsx", {"Sales": rows})
    said = "1 cell is a formula without a saved value, as B2: open it in Excel or LibreOffice"
    assert said in read_table(file).notices[0]
    refusals = (
        lambda: read_chart(ChartOptions(data=file, size_by="count")),
        lambda: read_words(WordOptions(source=file)),
        lambda: read_weights(file),
        lambda: read_cut_list(file),
    )
    for refusal in refusals:
        with pytest.raises(PackworkError, match=said):
            refusal()


def test_a_sheet_by_its_name_wherever_tables_are_read(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text("<svg/>", encoding="utf-8")
    parts = (
        "<row><c t='str'><v>file</v></c><c t='str'><v>count</v></c></row>"
        "<row><c t='str'><v>a.svg</v></c><c><v>12</v></c></row>"
    )
    file = _book(tmp_path / "a.xlsx", {"Parts": parts, "Sales": ROWS})
    assert read_weights(f"{file}#Sales") == {"Peru": 2.0, "Chad": 0.5}
    words = read_words(WordOptions(source=f"{file}#Sales"))
    assert [(word.text, word.weight) for word in words] == [("Peru", 2.0), ("Chad", 0.5)]
    (part,) = read_cut_list(f"{file}#Parts")
    assert (Path(part.file).name, part.count) == ("a.svg", 12)
    with pytest.raises(ReadError, match="has no sheet 'May'; there are Parts, Sales"):
        read_table(f"{file}#May")


@pytest.mark.parametrize(
    ("properties", "day"), [("", "2024-03-01 12:30"), ('<workbookPr date1904="1"/>', "2028-03-02")]
)
def test_days_and_shares_are_as_they_are_shown(tmp_path: Path, properties: str, day: str) -> None:
    rows = (
        "<row><c t='str'><v>share</v></c><c t='str'><v>day</v></c><c t='str'><v>kg</v></c></row>"
        "<row><c s='1'><v>0.125</v></c><c s='2'><v>45352.520833333336</v></c>"
        "<c s='0'><v>1.234</v></c></row>"
    )
    file = _book(tmp_path / "a.xlsx", {"S": rows}, properties=properties)
    table = read_table(file)
    (row,) = table.rows
    assert (row["share"], row["day"][: len(day)]) == ("12.5%", day)
    # No reader may take it for 1234.
    (row,) = table.with_numbers("kg", None, whole=True).rows
    assert row["kg"].number == 1.234


@pytest.mark.parametrize(
    ("code", "number", "text"),
    [
        ("[h]:mm", "1.5208333333333333", "36:30"),
        ("[h]:mm:ss", "1.5208333333333333", "36:30:00"),
        ("[h]:mm:ss", "0.00011574074", "0:00:10"),
        ("mm:ss", "1.75", "42:00:00"),
        ("hh:mm", "1.75", "18:00"),
        ("[hh]", "-0.5", "-0.5"),
        ("[$-409][Red]d mmm", "45352", "2024-03-01"),
        ("0\\ h", "1.75", "1.75"),
        ('0" d;"', "1.75", "1.75"),
        ("h:mm:ss.00", "0.5", "12:00:00"),
        ("h:mm:ss AM/PM", "0.16736111111111", "04:01:00"),
        ("h:mm AM/PM", "0.16736111111111", "04:01"),
        ("yyyy-mm-dd", "1", "1900-01-01"),
        ("yyyy-mm-dd", "59", "1900-02-28"),
        ("yyyy-mm-dd", "61", "1900-03-01"),
        ("yyyy-mm-dd", "2958465.9999", "9999-12-31 23:59:51"),
        ("yyyy-mm-dd", "2958465.9999999", "2958465.9999999"),
        ("General", "1234567890123456789", "1234567890123456789"),
        ("0", "1234567890123456.0", "1234567890123456"),
        ("0", " 0.30000000000000004 ", "0.3"),
    ],
)
def test_a_number_is_as_excel_shows_it(code: str, number: str, text: str) -> None:
    assert written(number, shown_by(code)) == text


def test_days_past_the_last_one_of_1904_are_numbers() -> None:
    assert written("2957003", "date", since_1904=True) == "9999-12-31"
    assert written("2957004", "date", since_1904=True) == "2957004"


def test_built_in_formats_of_lengths_of_time() -> None:
    assert [BUILT_IN[k] for k in range(18, 22)] == ["time", "clock"] * 2
    assert [BUILT_IN[k] for k in (45, 46, 47)] == ["seconds"] * 3


def test_one_time_of_full_minutes_is_alike_those_of_its_column() -> None:
    cells = [written(number, BUILT_IN[21]) for number in ("0.13339120370370", "0.16736111111111")]
    assert list(durations(cells)) == ["03:12:05", "04:01:00"]


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        ("<c t='s'><v/></c>", ""),
        ("<c t='s'><v> 1 </v></c>", "kg"),
        ("<c t='b'><v>true</v></c>", "TRUE"),
        ("<c t='b'><v>0</v></c>", "FALSE"),
        ("<c s='-1'><v>0.5</v></c>", "0.5"),
        ("<c t='inlineStr'><is><t>a</t><rPh sb='0' eb='1'><t>x</t></rPh></is></c>", "a"),
        ("<c r='A2' t='inlineStr'><is><t>a</t></is></c>" * 2, "a"),
    ],
)
def test_a_rare_cell_is_read_as_it_is_shown(tmp_path: Path, cell: str, text: str) -> None:
    names = "<row><c t='str'><v>a</v></c><c t='str'><v>b</v></c></row>"
    rows = f"{names}<row>{cell}<c r='B2'><v>1</v></c></row>"
    (row,) = read_table(_book(tmp_path / "a.xlsx", {"S": rows})).rows
    assert row == {"a": text, "b": "1"}


def test_a_sheet_that_lies_outside_of_the_file_is_passed_over(tmp_path: Path) -> None:
    file = _book(tmp_path / "a.xlsx", {"Sales": ROWS}, named='<sheet name="Far" r:id="far"/>')
    assert len(read_table(file).rows) == 2
    with pytest.raises(ReadError, match="has no sheet 'Far'; there are Sales"):
        read_table(f"{file}#Far")


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ({"sheets": {"S": ROWS}, "before": "<!DOCTYPE a [<!ENTITY b 'c'>]>"}, "declares a type"),
        ({"sheets": {"S": "<row r='9999999'/>"}}, "its row 9999999 follows row 0"),
        ({"sheets": {"S": "<row r='2'/><row r='2'/>"}}, "its row 2 follows row 2"),
        ({"sheets": {"S": "<row><c r='ZZZ1'><v>1</v></c></row>"}}, "has a column 18,278"),
        ({"sheets": {"S": "<row><c t='s'><v>7</v></c></row>"}}, "is no workbook of Excel"),
        ({"sheets": {"S": "<row><c t='s'><v>-1</v></c></row>"}}, "a cell has text -1 of 2"),
        ({"sheets": {"S": "<row><c t='s'><v>0_0</v></c></row>"}}, "a cell has text 0_0 of 2"),
        ({"sheets": {"S": "<row><c><v>x</v></c></row>"}}, "holds 'x', which is no number"),
        ({"sheets": {"S": "<row><c><v>1_0</v></c></row>"}}, "holds '1_0', which is no number"),
        ({"sheets": {"S": "<row><c><v>nan</v></c></row>"}}, "holds 'nan', which is no number"),
        ({"sheets": {"S": "<row><c><v>1e999</v></c></row>"}}, "holds '1e999', which is no number"),
        ({"sheets": {}}, "it has no sheet of cells"),
        ({"sheets": {"S": "<row>"}}, "is no workbook of Excel"),
    ],
)
def test_a_workbook_that_cannot_be_is_one_line(
    tmp_path: Path, made: dict[str, Any], said: str
) -> None:
    file = _book(tmp_path / "a.xlsx", **made)
    with pytest.raises(ReadError, match=said) as met:
        read_table(file)
    assert "\n" not in str(met.value)


def test_what_unpacks_or_repeats_to_much_is_refused(tmp_path: Path) -> None:
    wide = "<row><c r='XFD1'><v>1</v></c></row>" + "<row><c r='XFD9'><v>1</v></c></row>" * 300
    with pytest.raises(ReadError, match="more than 4,000,000 cells"):
        read_table(_book(tmp_path / "a.xlsx", {"S": wide}))
    texts = f"<si><t>{'a' * 30_000}</t></si>"
    many = "<row><c t='s'><v>0</v></c></row>" * 5_000
    with pytest.raises(ReadError, match="more than 128,000,000 letters"):
        read_table(_book(tmp_path / "a.xlsx", {"S": many}, texts=texts))
    texts = " " * (MOST_BESIDES + 1)
    with pytest.raises(ReadError, match="unpacks to more than"):
        read_table(_book(tmp_path / "a.xlsx", {"S": ROWS}, texts=texts))


@pytest.mark.parametrize(
    ("limit", "made", "said"),
    [
        ("DEEPEST", {"sheets": {"S": "<a>" * 9 + "</a>" * 9}}, "nests elements more than 8 deep"),
        ("MOST_PARTS", {"sheets": dict.fromkeys("abcdefghi", ROWS)}, "more than 8 sheets or parts"),
        ("LONGEST_TAG", {"sheets": {"S": f"<row b='{'a' * 200_000}'/>"}}, "more than 8 bytes"),
        ("MOST_NAMES", {"sheets": {"S": "<a/><b/><d/><e/><f/><g/><h/>"}}, "more than 8 names"),
    ],
)
def test_what_the_parser_keeps_is_bounded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str, made: dict[str, Any], said: str
) -> None:
    file = _book(tmp_path / "a.xlsx", **made)
    monkeypatch.setattr(workbook, limit, 8)
    with pytest.raises(ReadError, match=said):
        read_table(file)


def test_an_archive_that_names_no_workbook_is_told_as_such(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.xlsx", "w") as archive:
        archive.writestr("_rels/.rels", "<Relationships/>")
    with pytest.raises(ReadError, match="it names no part as its workbook"):
        read_table(str(tmp_path / "a.xlsx"))


def test_a_number_format_is_read_as_far_as_excel_keeps_one() -> None:
    assert (shown_by("0" * 254 + "%"), shown_by("0" * 255 + "%")) == ("share", "number")


def test_a_file_with_a_password_is_told_as_such(tmp_path: Path) -> None:
    (tmp_path / "a.xlsx").write_bytes(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(512))
    with pytest.raises(ReadError, match="has a password or is an old"):
        read_table(str(tmp_path / "a.xlsx"))

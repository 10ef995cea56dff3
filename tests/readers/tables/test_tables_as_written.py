"""Tables as spreadsheets write them: letters, delimiters, numbers."""

from __future__ import annotations

import io
import json
import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from packwork.errors import ReadError, RecipeError, RowsLostError
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.cells import is_number_like, written_numbers
from packwork.readers.tables.decoding import decoded
from packwork.readers.tables.delimited import delimiter_of
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import read_weights
from packwork.readers.tables.table import read_table
from packwork.readers.tables.totals import total_rows
from packwork.readers.words.items import read_word_items
from packwork.readers.words.options import WordOptions
from packwork.readers.words.source import read_words
from packwork.readers.words.table import read_word_table
from packwork.recipe import make_recipe
from packwork.uses.charts.marks import ChartRead, read_chart

EXCEL = "Land;Menge\r\n\r\nPerú;1.234,5\r\nMalí;12,25\r\n;;\r\nKenia;0,75;\r\n"
AMOUNTS = {"Perú": 1234.5, "Malí": 12.25, "Kenia": 0.75}


def marks(file: Path | str, asked: TableFormat | None = None, **options: str) -> ChartRead:
    said = {"size_by": "Menge", "label_by": "Land", **options}
    return read_chart(ChartOptions(data=str(file), **said), asked=asked)


def amounts(read: ChartRead) -> dict[str, float]:
    return dict(zip((item.name for item in read.items), read.values.tolist(), strict=True))


@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp1252"]
)
def test_all_readers_read_what_excel_writes(encoding: str, tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_bytes(EXCEL.encode(encoding))
    assert amounts(marks(file)) == AMOUNTS
    assert {word.text: word.weight for word in read_words(WordOptions(source=str(file)))} == AMOUNTS
    assert read_weights(file) == AMOUNTS


def test_unicode_text_of_excel_is_a_table_everywhere(tmp_path: Path) -> None:
    file = tmp_path / "t.txt"
    file.write_bytes("Land\tUmsatz\r\nSüd\t1.200,5\r\nOst\t87,25\r\n".encode("utf-16"))
    sums = {"Süd": 1200.5, "Ost": 87.25}
    asked = ChartOptions(data=str(file), size_by="Umsatz", label_by="Land")
    assert amounts(read_chart(asked)) == sums
    assert {word.text: word.weight for word in read_words(WordOptions(source=str(file)))} == sums
    assert read_weights(file) == sums
    # Indented prose is none, whatever its numbers.
    file.write_text("\tA bear of 2\n\tand 7 bees\n", encoding="utf-8")
    assert [word.text for word in read_words(WordOptions(source=str(file)))] == ["bear", "bees"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
@pytest.mark.parametrize(
    "above",
    [
        "Umsatz 2024, vorläufig\r\n\r\n",
        "Umsatz 2024, vorläufig;;\r\n;;\r\n",
        "Umsatz;\r\nStand: Mai;\r\n",
        "Umsatz 2024\r\n",
    ],
)
def test_titles_above_a_table_are_left_out_and_named(
    encoding: str, above: str, tmp_path: Path
) -> None:
    file = tmp_path / "t.csv"
    file.write_bytes((above + EXCEL).encode(encoding))
    table = read_table(str(file))
    assert amounts(marks(file)) == AMOUNTS
    assert {word.text: word.weight for word in read_words(WordOptions(source=str(file)))} == AMOUNTS
    assert read_weights(file) == AMOUNTS
    assert "above the table" in table.notices[-1]
    assert "Umsatz" in table.notices[-1]


@pytest.mark.parametrize(
    ("text", "columns"),
    [
        ("Report;Sales\nDate;2024-01-01\n\nLand;2023;2024\nPeru;1;2\n", ("Land", "2023", "2024")),
        ("Sales 2024\nAs of May; draft\n\nLand;t;EUR\nPeru;1;2\n", ("Land", "t", "EUR")),
        ("land;kg\nPeru, south;1,5\nMali, north;2,5\n", ("land", "kg")),
        ("a;b\n1;2\n\n3;4\n", ("a", "b")),
        (
            "T;;;\n;;;\nLand;2023;;2024\n;kg;EUR;kg\nPeru;1;2;3\n",
            ("Land", "2023 kg", "2023 EUR", "2024 kg"),
        ),
    ],
)
def test_headings_are_told_from_titles(text: str, columns: tuple[str, ...], tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text(text, encoding="utf-8")
    found = read_table(str(file)).columns
    assert tuple(name for name in found if name in columns) == columns


NAMES = "".join(f"name{k}\n" for k in range(100))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("name,value,\n\nbear,2,x\nfox,3,y\n", {"bear": 2.0, "fox": 3.0}),
        ("bear\nfox,2\nowl,3", {"fox": 2.0, "owl": 3.0}),
        ("bear\nfox,2000\nowl,3", {"fox": 2000.0, "owl": 3.0}),
        (NAMES + "fox,3\n", {"fox": 3.0}),
        (NAMES + "\nword,weight\nfox,3\n", {"fox": 3.0}),
        ("my list\n\nfox,2\nowl,3", {"fox": 2.0, "owl": 3.0}),
    ],
)
def test_rows_of_a_table_are_no_titles(text: str, words: dict[str, float], tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text(text, encoding="utf-8")
    table = read_word_table(str(file), TableFormat())
    assert {word.text: word.weight for word in table.words} == words
    assert "above" not in " ".join(table.notices)


@pytest.mark.parametrize(
    "text", ["Anna,5\nBert,6\n\nCarl,7,late\n", "a,b\n1,2\n3,4\n\nx,y,z\n1,2,3"]
)
def test_a_table_above_another_is_refused(text: str, tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ReadError, match=r"line \d: has 3 cells, not 2"):
        read_word_table(str(file), TableFormat())


def test_lines_are_numbered_as_in_the_file(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Title\n\nland,kg\nPeru,2\nMali,x,y\n", encoding="utf-8")
    with pytest.raises(ReadError, match="line 5: has 3 cells"):
        read_table(str(file))


@pytest.mark.parametrize(
    ("encoding", "text"),
    [
        ("cp1252", "Österreich;Dänemark;Türkei;Großbritannien"),
        ("cp1252", "Müller;García;Søren;François;Ångström"),
        ("cp1252", "Crème brûlée;€ 12"),
        ("cp1250", "Wejście;Łódź;Kraków;ilość"),
        ("cp1250", "Česko;Řecko;Německo;množství"),
        ("cp1251", "Страна;Россия;Соединённые Штаты"),
        ("cp1251", "УКРАЇНА;НІМЕЧЧИНА"),
        ("cp1253", "Ελλάδα;Γερμανία;Ισπανία"),
        ("cp1254", "Türkiye;İspanya;Kıbrıs;Bağdat"),
    ],
)
def test_the_encodings_of_windows_are_told_by_their_letters(encoding: str, text: str) -> None:
    read = decoded(text.encode(encoding), "t.csv")
    assert read.text == text
    assert f"Windows-{encoding[2:]}" in read.notice


@pytest.mark.parametrize("text", ["GIF89a, a format of pictures", "gif87a\tolder", "GIF89a\n"])
def test_a_text_may_begin_as_a_picture_does(text: str) -> None:
    assert decoded(text.encode(), "a.txt").text == text


@pytest.mark.parametrize("format", ["GIF", "PNG", "JPEG"])
def test_pictures_are_no_text(format: str) -> None:
    Image.new("RGB", (300, 200), "teal").save(content := io.BytesIO(), format)
    with pytest.raises(ReadError, match="is a picture, not text"):
        decoded(content.getvalue(), "a.txt")


@pytest.mark.parametrize("encoding", ["koi8-r", "shift_jis", "gb18030", "cp437"])
def test_other_encodings_are_asked_for_and_taken_when_named(encoding: str) -> None:
    text = {"shift_jis": "日本;ドイツ", "gb18030": "德国;中国", "cp437": "España;México"}.get(
        encoding, "Россия;Германия"
    )
    with pytest.raises(ReadError, match=r"not text in UTF-8; .* --encoding cp1252"):
        decoded(text.encode(encoding), "t.csv")
    assert decoded(text.encode(encoding), "t.csv", encoding).text == text
    with pytest.raises(ReadError, match="not text in ASCII"):
        decoded(text.encode(encoding), "t.csv", "ascii")


@pytest.mark.parametrize(
    ("text", "delimiter"),
    [
        ("a;b\n1,5;2\n", ";"),
        ("bear;1,5\nfox;2,5\n", ";"),
        ("bear\t1,5\nfox\t2,5\n", "\t"),
        ("a|b\n1|2\n", "|"),
        ('a,b\n"1;2",3\n', ","),
        ("a;b;\n1;2;\n3;4;\n", ";"),
        ("a;b\n1\n2;3\n", ";"),
        ("land;kg, net\nPeru;1,5\nMali;2,5\n", ";"),
        ("word\nbear\n", ","),
        ('a;b\n"Côte\nd\'Ivoire";2\n', ";"),
    ],
)
def test_the_delimiter_parts_all_lines_alike(text: str, delimiter: str) -> None:
    assert delimiter_of(text, "t.csv", ",") == delimiter


def test_delimiters_that_part_lines_alike_are_asked_for(tmp_path: Path) -> None:
    text = "a,b;c\nx,y;z\nu,v;w\n"
    with pytest.raises(ReadError, match=r'commas or semicolons; .* --delimiter , or .* ";"'):
        delimiter_of(text, "t.csv", ",")
    file = tmp_path / "t.csv"
    file.write_text(text, encoding="utf-8")
    assert read_table(str(file), TableFormat(delimiter=";")).columns == ("a,b", "c")
    assert read_table(str(file), TableFormat(delimiter="comma")).columns == ("a", "b;c")


def test_a_first_line_may_say_the_delimiter(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text('sep=|\nLand|Menge\n"a|b"|2\n', encoding="utf-8")
    assert amounts(marks(file)) == {"a|b": 2.0}
    file.write_text("sep=|\nLand|Menge\na|2|3\n", encoding="utf-8")
    with pytest.raises(ReadError, match="line 3: has 3 cells, the first line names 2; quote"):
        read_table(str(file))


@pytest.mark.parametrize(
    ("cells", "numbers"),
    [
        (["1.234,5", "2"], [1234.5, 2.0]),
        (["1,234.5", "1,234"], [1234.5, 1234.0]),
        (["1 234,5", "7 000", "1\u202f000"], [1234.5, 7000.0, 1000.0]),
        (["1'234.50", "2\u2019000"], [1234.5, 2000.0]),
        (["1.234.567", "1.000"], [1234567.0, 1000.0]),
        (["12,34,567.5"], [1234567.5]),
        (["€ 12,50", "3,00 €", "4"], [12.5, 3.0, 4.0]),
        (["CHF 1'200.-", "R$ 5", "$1"][:1], [1200.0]),
        (["12 %", "3,5%"], [12.0, 3.5]),
        (["(1,234.50)", "-5", "\u22127", "8-"], [-1234.5, -5.0, -7.0, -8.0]),
        (["0,123", "1,234"], [0.123, 1.234]),
        ([" 5\u00a0", "+3", "1e3", ".5"], [5.0, 3.0, 1000.0, 0.5]),
        ([2, 3.5, True], [2.0, 3.5, float("nan")]),
    ],
)
def test_numbers_as_people_write_them(cells: list[object], numbers: list[float]) -> None:
    assert written_numbers(cells, "t.csv", "n") == pytest.approx(numbers, nan_ok=True)


@pytest.mark.parametrize(
    "cell",
    ["1.2.2024", "2024-03-01", "3/2024", "12:30", "5 kg", "1,23,45", "--5", "k.A.", "1_000", "(5"],
)
def test_what_is_no_number_is_none(cell: str) -> None:
    assert written_numbers([cell, "2"], "t.csv", "n") == pytest.approx(
        [float("nan"), 2.0], nan_ok=True
    )


def test_months_are_no_numbers() -> None:
    cells = ["03.2024", "11.2023"]
    assert written_numbers(cells, "t.csv", "n") == pytest.approx([float("nan")] * 2, nan_ok=True)


@pytest.mark.parametrize(
    ("cells", "problem"),
    [
        (["1.200", "3.400"], r"'1.200' in column 'n' may be 1.2 or 1,200; .* --decimal"),
        (["1,5", "2.5"], r"holds both '1,5' and '2.5'; .* --decimal , or --decimal \."),
        (["12 %", "0,3"], "holds both '12 %' and '0,3'; write all in one unit"),
        (["€ 5", "$ 3"], "holds both '€ 5' and '\\$ 3'; write all in one unit"),
    ],
)
def test_what_may_be_read_in_two_ways_is_asked(cells: list[str], problem: str) -> None:
    with pytest.raises(ReadError, match=problem):
        written_numbers(cells, "t.csv", "n")


def test_the_answer_is_taken() -> None:
    assert written_numbers(["1.200"], "t", "n", asked=",") == [1200.0]
    assert written_numbers(["1.200"], "t", "n", asked=".") == [1.2]
    # Between commas a point parts the fraction: else most tables would have to be asked about.
    assert written_numbers(["1.200"], "t", "n", usual=".") == [1.2]


def test_cells_of_json_and_frames_keep_the_same_rules(tmp_path: Path) -> None:
    rows = [{"Land": "Peru", "Menge": "1.234,5"}, {"Land": "Mali", "Menge": "€ 2"}]
    file = tmp_path / "t.json"
    file.write_text(json.dumps(rows), encoding="utf-8")
    assert amounts(marks(file)) == {"Peru": 1234.5, "Mali": 2.0}
    framed = read_chart(ChartOptions(data=rows, size_by="Menge", label_by="Land"))
    assert amounts(framed) == {"Peru": 1234.5, "Mali": 2.0}
    assert framed.rows[0]["Menge"] == "1.234,5"
    file.write_text(json.dumps({"bear": "1.234,5", "fox": 2}), encoding="utf-8")
    assert read_weights(file) == {"bear": 1234.5, "fox": 2.0}


def test_colours_and_groups_are_numbers_by_the_same_rules(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Menge;g\nA;1;1,5\nB;2;0,5\nC;3;1,5\n", encoding="utf-8")
    assert marks(file, color_by="g").is_ramp
    assert marks(file, by="g").groups == ("0.5", "1.5")
    # Categories that only look a little like numbers need no answer.
    file.write_text("Land;Menge;g\nA;1;1.200\nB;2;none\n", encoding="utf-8")
    assert not marks(file, color_by="g").is_ramp


def test_numbers_are_shown_as_the_table_writes_them(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Menge\nA;1,5\nB;2\n", encoding="utf-8")
    assert marks(file).decimal == ","
    file.write_text("Land;Menge\nA;1.5\nB;2\n", encoding="utf-8")
    assert marks(file).decimal == "."
    file.write_text("Land;Menge\nA;1.500\nB;2\n", encoding="utf-8")
    assert marks(file, TableFormat(decimal=",")).decimal == ","


def test_rows_with_data_that_are_left_out_are_named_and_count(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Menge\nA;1\nB;\nC;0\nD;many\nE;(5)\nF;1.2.2024\nG;2\n", encoding="utf-8")
    read = marks(file)
    lost = [str(error) for error in read.told if isinstance(error, RowsLostError)]
    assert [text.rpartition("whose ")[2] for text in lost] == [
        "Menge is no number: D", "Menge is negative: E", "Menge is a date: F"
    ]  # fmt: skip
    assert len(read.told) == 5
    words = read_word_items(WordOptions(source=str(file)))
    assert [item.name for item in words.items] == ["G", "A"]
    lost = [str(error) for error in words.told if isinstance(error, RowsLostError)]
    assert len(lost) == 2
    assert "whose weight is no number: D (line 5), F (line 7)" in lost[0]
    file.write_text("Land;Menge\nA;1\nB;k. A.\nC;-\nD;n/a\nG;2\n", encoding="utf-8")
    for told in (marks(file).told, read_word_items(WordOptions(source=str(file))).told):
        assert not [error for error in told if isinstance(error, RowsLostError)]


def test_rows_that_repeat_others_are_told_and_totals_left_out(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Menge\nA;1\nB;2\nA;1\nSumme:;4\n", encoding="utf-8")
    read = marks(file)
    told = " | ".join(read.notices)
    assert "1 row says the same as another in all columns, and is shown too: A" in told
    assert "left out 1 row of 4 whose Menge is the total of others: Summe:; --keep-totals" in told
    assert [item.name for item in read.items] == ["A", "B", "A"]
    assert read.lost == ()
    words = read_word_items(WordOptions(source=str(file)))
    assert {item.name for item in words.items} == {"A", "B"}
    assert any("that is the total of others: Summe: (line 5)" in str(e) for e in words.told)


def test_totals_are_kept_on_demand(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Menge\nA;1\nB;2\nSumme;3\n", encoding="utf-8")
    asked = TableFormat(keep_totals=True)
    assert [item.name for item in marks(file, asked).items] == ["A", "B", "Summe"]
    words = read_word_items(WordOptions(source=str(file)), asked=asked)
    assert "Summe" in {item.name for item in words.items}


@pytest.mark.parametrize(
    ("rows", "totals"),
    [
        ([("A", 60), ("B", 40), ("Total 2024", 100)], [2]),
        ([("Total", 100), ("A", 60), ("B", 40)], [0]),
        ([("Total", 120), ("A", 60), ("B", 40)], []),
        ([("All", 100), ("A", 60), ("B", 40)], []),
        ([("A", 60), ("Subtotal", 70), ("B", 40)], []),
        ([("A", 60), ("Returns", -20), ("B", 40), ("Total", 80)], [3]),
        (
            [
                ("N", 2),
                ("N", 3),
                ("N Ergebnis", 5),
                ("S", 4),
                ("S Ergebnis", 4),
                ("Gesamtergebnis", 9),
            ],
            [2, 4, 5],
        ),
        (
            [
                ("a", 2),
                ("b", 3),
                ("Jan Total", 5),
                ("c", 4),
                ("Feb Total", 4),
                ("N Total", 9),
                ("d", 1),
                ("Jan Total", 1),
                ("S Total", 1),
                ("Grand Total", 10),
            ],
            [2, 4, 5, 7, 8, 9],
        ),
        ([("Berlin Shell", 30), ("Total", 30), ("BP", 10)], []),
        ([("A", 6), ("Subtotal", 6), ("B", 4), ("Subtotal", 4), ("Grand total", 10)], [1, 3, 4]),
        ([("A", 33), ("B", 33), ("C", 33), ("Gesamt", 98)], [3]),
        ([("Shell", 60), ("Total", 70), ("BP", 40)], []),
        ([("A", 1), ("B", 2), ("C", 3), ("D", 4), ("World", 10)], []),
        ([("A", 1), ("B", 2), ("C", 3), ("D", 4), ("", 10)], [4]),
        ([("", 1), ("", 2), ("", 3), ("", 4), ("", 10)], []),
        ([("All Saints", 10), ("B", 2)], []),
        ([("Total", 10)], []),
        ([("A", math.nan), ("Total", math.nan)], []),
        ([], []),
    ],
)
def test_a_total_is_called_one_and_comes_to_the_others(
    rows: list[tuple[str, float]], totals: list[int]
) -> None:
    found = total_rows([[name] for name, _ in rows], [number for _, number in rows])
    assert found == {k: rows[k][0] for k in totals}


PIVOT = (
    "Region;Monat;Umsatz\nNord;Jan;120,5\nNord;Feb;99,5\nNord Ergebnis;;220\n"
    "Süd;Jan;300\nSüd;Feb;250,25\nStorno;Feb;-10\nSüd Ergebnis;;540,25\nGesamtergebnis;;760,25\n"
)


def test_totals_of_a_pivot_table_are_named_by_what_calls_them_so(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text(PIVOT, encoding="utf-8")
    read = marks(file, size_by="Umsatz", label_by="Monat")
    assert [item.name for item in read.items] == ["Jan", "Feb", "Jan", "Feb"]
    named = "is the total of others: Nord Ergebnis, Süd Ergebnis, Gesamtergebnis; --keep-totals"
    assert any(named in told for told in read.notices)
    asked = WordOptions(source=str(file), label_by="Region", size_by="Umsatz")
    assert {item.name for item in read_word_items(asked).items} == {"Nord", "Süd"}


def test_a_value_of_another_column_is_no_total(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("Land;Art;Menge\nA;x;1\nB;y;2\nC;Total;3\n", encoding="utf-8")
    assert [item.name for item in marks(file).items] == ["A", "B", "C"]
    file.write_text("Land;Menge\nA;1\nB;2\nTotal;9\n", encoding="utf-8")
    read = marks(file)
    assert [item.name for item in read.items] == ["A", "B", "Total"]
    assert any("shown though called a total" in told for told in read.notices)


def test_a_weight_may_stand_there_twice_if_it_is_the_same(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file = tmp_path / "t.csv"
    file.write_text("name;weight\na;1,5\nb;2\na;1,5\n", encoding="utf-8")
    assert read_weights(file) == {"a": 1.5, "b": 2.0}
    assert "says the same again of 'a' (line 4); that counts once" in caplog.text


def test_numbers_with_a_comma_are_not_cut_at_it(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text("bear,1,5\nfox,2,5\n", encoding="utf-8")
    with pytest.raises(ReadError, match="has 3 cells, not 2; quote those"):
        read_words(WordOptions(source=str(file)))


def test_names_of_columns_are_one_line_and_empty_ones_have_numbers(tmp_path: Path) -> None:
    file = tmp_path / "t.csv"
    file.write_text('"Menge\nkg";;Land;\n1;x;A;\n', encoding="utf-8")
    assert read_table(str(file)).columns == ("Menge kg", "column 2", "Land")


def test_spreadsheets_are_named_as_such() -> None:
    with pytest.raises(ReadError, match="is a spreadsheet; save it as"):
        read_table("numbers.ods")


@pytest.mark.parametrize(
    ("key", "value", "problem"),
    [
        ("delimiter", ";;", "use one character"),
        ("decimal", "x", r"'\.' or ','"),
        ("encoding", "utf-99", "use a name such as"),
        ("encoding", "base64", "use a name such as"),
    ],
)
def test_formats_without_a_meaning_are_refused(key: str, value: str, problem: str) -> None:
    with pytest.raises(RecipeError, match=f"{key}: .*{problem}"):
        make_recipe(container="circle", **{key: value})


@settings(deadline=None, max_examples=200)
@given(st.lists(st.text("0123456789., '%€-()+eE ", max_size=12), max_size=6))
def test_any_cells_are_numbers_or_refused(cells: list[str]) -> None:
    try:
        found = written_numbers(cells, "t.csv", "n")
    except ReadError:
        return
    assert len(found) == len(cells)
    for cell, number in zip(cells, found, strict=True):
        assert number != number or is_number_like(cell)


@settings(deadline=None, max_examples=100)
@given(st.floats(1e-6, 1e12), st.sampled_from(".,"), st.sampled_from(["", " ", "\u00a0"]))
def test_what_is_written_with_groups_is_read_back(number: float, decimal: str, group: str) -> None:
    text = f"{number:,.4f}".replace(",", "g").replace(".", decimal).replace("g", group)
    assert written_numbers([text], "t", "n", asked=decimal) == [float(f"{number:.4f}")]

"""Workbooks of Excel (.xlsx): the cells of one sheet as lines of text, as they are shown.

Parts are streamed, so that memory goes by what is kept, and bounded by what their archive states,
beyond which nothing is unpacked. Formulas have the values that were saved with them, macros are
never run. Elements are those of ECMA-376, part 1 (SpreadsheetML), of any namespace.
"""

from __future__ import annotations

import csv
import io
import posixpath
import re
import zipfile
import zlib
from collections.abc import Callable, Mapping, Sequence, Sized
from pathlib import Path
from typing import NamedTuple, NoReturn, TypeAlias, final
from xml.parsers import expat

from packwork.errors import ReadError
from packwork.phrasing import enumerated, number_of
from packwork.readers.reading import exists
from packwork.readers.tables.shown import BUILT_IN, Shown, shown_by, written

ENDINGS = (".xlsx", ".xlsm")

MOST_UNPACKED = 256_000_000
"""Bytes of a sheet: a million rows of four cells. Chosen."""

MOST_BESIDES = 64_000_000
"""Bytes of any other part: texts take four times that in memory. Derived."""

MOST_LETTERS = 128_000_000
"""Letters of a sheet's cells, of which many may have one text. Chosen."""

LONGEST_CELL = 32_767
"""Letters of a cell, as Excel has it."""

MOST_COLUMNS = 16_384
"""Columns of a sheet, as Excel has it."""

DEEPEST = 100
"""Elements within each other. Chosen."""

MOST_PARTS = 10_000
"""Sheets, and other parts that one part names. Chosen."""

MOST_NAMES = 10_000
"""Names of elements and attributes, which the parser keeps. Chosen."""

LONGEST_TAG = 1 << 20
"""Bytes of a tag or a remark, which the parser keeps whole. Chosen."""

_REFERENCE = re.compile(r"([A-Z]{1,3})[0-9]+")

_Start: TypeAlias = Callable[[str, Mapping[str, str]], None]


class _Cell(NamedTuple):
    column: int
    kind: str
    style: int
    name: str = ""


def parted(file: str) -> tuple[str, str]:
    """A file's own name, and that of the sheet behind it; empty for the first one.

    Examples
    --------
    >>> parted("sales.xlsx#May"), parted("sales.xlsx"), parted("a#b.csv")
    (('sales.xlsx', 'May'), ('sales.xlsx', ''), ('a#b.csv', ''))
    """
    path, mark, sheet = file.rpartition("#")
    is_sheet = mark and path.lower().endswith(ENDINGS) and not exists(file)
    return (path, sheet) if is_sheet else (file, "")


def ending_of(file: str) -> str:
    """Ending of a file's name, in small letters, without a sheet's.

    Examples
    --------
    >>> ending_of("sales.XLSX#May"), ending_of("a.csv")
    ('.xlsx', '.csv')
    """
    return Path(parted(file)[0]).suffix.lower()


def text_of_sheet(
    data: bytes, file: str, sheet: str, check: Callable[[str, int, int], None]
) -> tuple[str, str]:
    """Cells of one sheet, parted by tabs, in the rows in which they stand; what has to be told.

    That is empty, or names cells of formulas that no program has computed yet.

    Parameters
    ----------
    sheet
        Name; empty for the first that is shown.
    check
        Is given the file and how many rows and cells there are so far, and refuses too many.

    Raises
    ------
    ReadError
        If it is no workbook, is too large, or has no such sheet.
    """
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        raise ReadError(file, "has a password or is an old .xls; save it as .xlsx without one")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return _Workbook(archive, file).text(sheet, check)
    except (zipfile.BadZipFile, zlib.error, expat.ExpatError, EOFError, LookupError,
            ValueError, OverflowError, RuntimeError) as error:  # fmt: skip
        why = " ".join(str(error).split())[:80]
        raise ReadError(
            file, f"is no workbook of Excel ({why}); save the sheet as CSV (UTF-8) and give that"
        ) from None


@final
class _Workbook:
    def __init__(self, archive: zipfile.ZipFile, file: str) -> None:
        self._archive, self._file = archive, file

    def text(self, wanted: str, check: Callable[[str, int, int], None]) -> tuple[str, str]:
        """Lines of a sheet by its name, and a sentence about its formulas."""
        main = next(
            (part for kind, part in self._targets("").values() if kind == "officeDocument"), ""
        )
        if not main:
            raise ValueError("it names no part as its workbook")
        sheets: list[Mapping[str, str]] = []
        since_1904 = False

        def start(name: str, told: Mapping[str, str]) -> None:
            nonlocal since_1904
            if name == "sheet" and "name" in told:
                sheets.append(told)
                self._count(sheets)
            elif name == "workbookPr":
                since_1904 = told.get("date1904") in {"1", "true"}

        self._parse(main, start)
        targets = self._targets(main)
        # Others are charts, or lie outside of the file.
        tables = {one["name"]: targets.get(one.get("id", ""), ("", "")) for one in sheets}
        parts = {name: part for name, (kind, part) in tables.items() if kind == "worksheet"}
        if not parts:
            raise ValueError("it has no sheet of cells")
        hidden = {one["name"] for one in sheets if one.get("state", "visible") != "visible"}
        first = next((name for name in parts if name not in hidden), next(iter(parts)))
        if (wanted or first) not in parts:
            raise ReadError(
                self._file, f"has no sheet {wanted[:40]!r}; there are {enumerated([*parts], 6)}"
            )
        others = dict(targets.values())
        texts = self._texts(others["sharedStrings"]) if "sharedStrings" in others else []
        shown = self._shown(others["styles"]) if "styles" in others else []
        reader = _SheetReader(self._file, texts, shown, since_1904, check)
        self._parse(parts[wanted or first], reader.start, reader.end, reader.letters, MOST_UNPACKED)
        return reader.text, reader.notice

    def _targets(self, part: str) -> dict[str, tuple[str, str]]:
        """Kinds and names of parts that a part refers to, by their marks."""
        folder, name = posixpath.split(part)
        found: dict[str, tuple[str, str]] = {}

        def start(element: str, told: Mapping[str, str]) -> None:
            is_whole = told.keys() >= {"Id", "Type", "Target"}
            if element == "Relationship" and is_whole and told.get("TargetMode") != "External":
                target = posixpath.normpath(posixpath.join("/", folder, told["Target"]))[1:]
                found[told["Id"]] = told["Type"].rpartition("/")[2], target
                self._count(found)

        self._parse(posixpath.join(folder, "_rels", f"{name}.rels"), start)
        return found

    def _texts(self, part: str) -> list[str]:
        """Texts that cells share, without how they are spoken."""
        found: list[str] = []
        now: list[str] = []
        within: list[str] = []

        def start(name: str, _: Mapping[str, str]) -> None:
            within.append(name)
            if name == "si":
                now.clear()

        def end(name: str) -> None:
            within.pop()
            if name == "si":
                found.append("".join(now))

        def letters(text: str) -> None:
            if within[-1] == "t" and "rPh" not in within[-3:]:
                now.append(text)

        self._parse(part, start, end, letters)
        return found

    def _shown(self, part: str) -> list[Shown]:
        """Kinds of what the styles of cells show numbers as."""
        own: dict[int, Shown] = {}
        found: list[Shown] = []
        is_of_cells = False

        def start(name: str, told: Mapping[str, str]) -> None:
            nonlocal is_of_cells
            if name == "numFmt":
                own.setdefault(int(told["numFmtId"]), shown_by(told["formatCode"]))
            elif name in {"cellXfs", "cellStyleXfs"}:
                is_of_cells = name == "cellXfs"
            elif name == "xf" and is_of_cells:
                number = int(told.get("numFmtId", 0))
                found.append(own.get(number, BUILT_IN.get(number, "number")))

        self._parse(part, start)
        return found

    def _parse(
        self, part: str, start: _Start, end: Callable[[str], None] = lambda _: None,
        letters: Callable[[str], None] = lambda _: None, most: int = MOST_BESIDES,
    ) -> None:  # fmt: skip
        info = self._archive.getinfo(part)
        if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise ValueError("it is packed in an unknown way")
        # The archive's reader ends where the file's own account does.
        if info.file_size > most:
            raise ReadError(
                self._file, f"unpacks to more than {most / 1e6:g} MB; give fewer rows, or CSV"
            )
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = _refuse
        depth = 0

        # "namespace name", of elements and attributes alike.
        def begin(name: str, told: Mapping[str, str]) -> None:
            nonlocal depth
            depth += 1
            if depth > DEEPEST:
                raise ValueError(f"it nests elements more than {DEEPEST} deep")
            if told:
                told = {key.rpartition(" ")[2]: value for key, value in told.items()}
            start(name.rpartition(" ")[2], told)

        def close(name: str) -> None:
            nonlocal depth
            depth -= 1
            end(name.rpartition(" ")[2])

        parser.StartElementHandler, parser.EndElementHandler = begin, close
        parser.CharacterDataHandler = letters
        given = 0
        with self._archive.open(info) as stream:
            while data := stream.read(1 << 16):
                given += len(data)
                parser.Parse(data)
                if given - parser.CurrentByteIndex > LONGEST_TAG:
                    raise ValueError(f"it has a tag of more than {LONGEST_TAG:,} bytes")
                if len(parser.intern) > MOST_NAMES:
                    raise ValueError(f"it has more than {MOST_NAMES:,} names of elements")
        parser.Parse(b"", True)

    @staticmethod
    def _count(parts: Sized) -> None:
        if len(parts) > MOST_PARTS:
            raise ValueError(f"it has more than {MOST_PARTS:,} sheets or parts")


def _refuse(*_: object) -> NoReturn:
    raise ValueError("it declares a type of document, as no workbook does")


@final
class _SheetReader:
    """Handlers of a sheet's elements, which write its rows as they end."""

    def __init__(
        self, file: str, texts: Sequence[str], shown: Sequence[Shown], since_1904: bool,
        check: Callable[[str, int, int], None],
    ) -> None:  # fmt: skip
        self._file, self._texts, self._shown, self._check = file, texts, shown, check
        self._since_1904 = since_1904
        self._lines = io.StringIO(newline="")
        self._writer = csv.writer(self._lines, delimiter="\t", lineterminator="\n")
        self._row: dict[int, str] = {}
        self._cell = _Cell(0, "n", 0)
        self._parts: list[str] | None = None
        self._is_value = self._is_spoken = False
        self._at = self._rows = self._cells = self._letters = self._room = 0
        self._has_formula = False
        self._uncomputed, self._first_uncomputed = 0, ""

    @property
    def text(self) -> str:
        """Lines so far."""
        return self._lines.getvalue()

    @property
    def notice(self) -> str:
        """Sentence about formulas without a saved value; empty if there are none."""
        if not self._uncomputed:
            return ""
        cells = number_of(self._uncomputed, "cell is a formula", "cells are formulas")
        return (
            f"{cells} without a saved value, as {self._first_uncomputed}: open it in Excel or "
            "LibreOffice, and save it there"
        )

    def start(self, name: str, told: Mapping[str, str]) -> None:
        """Begin a row, a cell, or a cell's value."""
        if name == "row":
            number = int(told.get("r", self._at + 1))
            # Lines have the numbers of their rows.
            if not self._at < number <= 1 << 20:
                raise ValueError(f"its row {number} follows row {self._at}")
            self._lines.write("\n" * (number - 1 - self._at))
            self._row, self._at, self._cell = {}, number, _Cell(0, "n", 0)
        elif name == "c":
            column = self._cell.column + 1
            if met := _REFERENCE.fullmatch(told.get("r", "")):
                column = 0
                for letter in met[1]:
                    column = 26 * column + ord(letter) - ord("A") + 1
            if column > MOST_COLUMNS:
                raise ValueError(f"it has a column {column:,}")
            name = told.get("r", "")[:10] or f"one of row {self._at}"
            self._cell = _Cell(column, told.get("t", "n"), int(told.get("s", 0)), name)
            self._has_formula, self._parts, self._room = False, None, LONGEST_CELL
        elif name == "rPh":
            self._is_spoken = True
        elif name == "f":
            self._has_formula = True
        elif name in {"v", "t"} and not self._is_spoken:
            self._is_value, self._parts = True, self._parts or []

    def letters(self, text: str) -> None:
        """Take letters of a value."""
        if self._parts is not None and self._is_value and self._room > 0:
            self._parts.append(text[: self._room])
            self._room -= len(text)

    def end(self, name: str) -> None:
        """End a value, or write a row."""
        if name in {"v", "t"}:
            self._is_value = False
        elif name == "rPh":
            self._is_spoken = False
        elif name == "c":
            if self._parts is not None:
                text = self._row[self._cell.column] = self._meant("".join(self._parts))
                self._letters += len(text)
            if self._letters > MOST_LETTERS:
                raise ReadError(self._file, f"has more than {MOST_LETTERS:,} letters; give fewer")
            # A formula may give an empty text, whose kind is told.
            is_empty = self._cell.kind != "str" and not self._row.get(self._cell.column)
            if self._has_formula and is_empty:
                self._uncomputed += 1
                self._first_uncomputed = self._first_uncomputed or self._cell.name
            self._parts, self._has_formula = None, False
        elif name == "row":
            width = max(self._row, default=0)
            self._rows, self._cells = self._rows + bool(width), self._cells + width
            self._check(self._file, self._rows - 1, self._cells)
            self._writer.writerow([self._row.get(k, "") for k in range(1, width + 1)])

    def _meant(self, text: str) -> str:
        """A value as the sheet shows it, in one line."""
        kind, style = self._cell.kind, self._cell.style
        if kind in {"s", "b", "n"} and not text.strip():
            return ""
        if kind == "s":
            if not text.strip().isdecimal() or int(text) >= len(self._texts):
                raise ValueError(f"a cell has text {text[:20]} of {len(self._texts):,}")
            text = self._texts[int(text)]
        elif kind == "b":
            text = "TRUE" if text.strip() in {"1", "true"} else "FALSE"
        elif kind == "n":
            shown = self._shown[style] if 0 <= style < len(self._shown) else "number"
            text = written(text, shown, since_1904=self._since_1904)
        return " ".join(text.split("\n")).replace("\r", " ").replace("\0", "")

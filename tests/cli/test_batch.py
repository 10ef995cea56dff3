"""``packwork batch``: what is told, what is written beside the rows, which exit code."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

RECIPE = 'container = "{shape}"\nitems = ["star"]\ncount = 4\nepochs = 20\nlevels = "50"\n'
TABLE = "name,shape\nAnn,heart\n=1+1,circle\nMax,nonesuch.svg\n<b>Li</b>,moon\n"


@pytest.fixture(autouse=True)
def files(folder: Path) -> None:
    (folder / "poster.toml").write_text(RECIPE, encoding="utf-8")
    (folder / "people.csv").write_text(TABLE, encoding="utf-8")


def test_rows_are_made_and_told_of(packwork: Callable[..., Result], folder: Path) -> None:
    line = "batch poster.toml --table people.csv -o out/{row}.svg --workers 1"
    beside = "--report out/r.csv --contact-sheet out/sheet.png --index out/index.html"
    done = packwork(f"{line} {beside}")
    assert done.exit_code == 1
    assert "row 3 (Max): nonesuch.svg: there is no such file" in done.output
    assert "4 rows: 3 made, 1 failed" in done.output
    rows = list(csv.DictReader(io.StringIO((folder / "out/r.csv").read_text("utf-8-sig"))))
    assert [row["status"] for row in rows] == ["made", "made", "failed", "made"]
    assert rows[1]["name"] == "'=1+1"
    assert 0 < float(rows[0]["exact_LC"]) <= 1
    with Image.open(folder / "out/sheet.png") as sheet:
        assert sheet.width > 400
        assert len(sheet.convert("RGB").getcolors(1 << 20) or []) > 2
    page = (folder / "out/index.html").read_text(encoding="utf-8")
    assert page.count("<img") == 3
    assert "&lt;b&gt;Li" in page
    assert "<b>" not in page
    again = packwork(f"{line} --dry-run")
    assert "1 row to make, 3 made already, 0 that cannot be" in again.output


def test_what_is_beside_is_checked_first(packwork: Callable[..., Result], folder: Path) -> None:
    line = "batch poster.toml --table people.csv -o {row}.svg"
    for more, said in (
        ("--report r.xlsx", "is no table"),
        ("--index 2.svg", "is a row's file too"),
        ("--report a.csv --index a.csv", "is the same file"),
        ("--pixels 0", "pixels"),
    ):
        done = packwork(f"{line} {more}")
        assert done.exit_code == 2, done.output
        assert said in done.output
    done = packwork("batch poster.toml --table people.csv -o {row}.pdf --contact-sheet s.png")
    assert "needs rows' files of .png" in done.output
    assert {path.name for path in folder.iterdir()} == {"poster.toml", "people.csv"}

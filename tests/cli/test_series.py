"""``--series`` of words and charts: files, film, sheet, report; refusals, in one line."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

TABLE = """year,word,count
2000,bear,9
2000,fox,6
2000,owl,4
2001,bear,7
2001,fox,7
2001,hare,3
2002,lynx,8
2002,fox,5
2002,hare,4
"""


def write_table(folder: Path) -> None:
    (folder / "t.csv").write_text(TABLE, encoding="utf-8")


def test_the_command_writes_files_a_film_a_sheet_and_a_report(
    packwork: Callable[..., Result], folder: Path
) -> None:
    write_table(folder)
    line = "words circle --series t.csv:year -o out/{year}.svg -o out/{row}.png --pixels 64"
    beside = (
        "--film f.gif --fps 4 --seconds 1 --film-pixels 64 --contact-sheet s.png --report r.json"
    )
    done = packwork(f"{line} {beside}")
    assert done.exit_code == 0, done.output
    assert "3 steps, all certified" in done.output
    assert sorted(path.name for path in (folder / "out").iterdir()) == [
        "1.png", "2.png", "2000.svg", "2001.svg", "2002.svg", "3.png",
    ]  # fmt: skip
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    assert [step["step"] for step in report["steps"]] == ["2000", "2001", "2002"]
    with Image.open(folder / "f.gif") as film:
        assert film.n_frames > 2


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("-o all.svg", "names not each step's file"),
        ("-o {month}.svg", "names not each step's file"),
        ("-o {year}.docx", "docx"),
        ("--best-of 2", "--best-of: is of one layout"),
        ("--save-recipe r.toml", "--save-recipe: is of one layout"),
        ("--sizes graded", "--sizes: has no meaning in a series"),
    ],
)
def test_what_a_series_cannot_do_is_one_line(
    packwork: Callable[..., Result], folder: Path, more: str, said: str
) -> None:
    write_table(folder)
    done = packwork(f"words circle --series t.csv:year {more}")
    assert done.exit_code == 2, done.output
    assert said in done.output
    assert sorted(path.name for path in folder.iterdir()) == ["t.csv"]


def test_a_table_without_that_column_and_a_source_besides_are_refused(
    packwork: Callable[..., Result], folder: Path
) -> None:
    write_table(folder)
    assert "there are year" in packwork("words circle --series t.csv:month").output
    assert "names no column" in packwork("words circle --series t.csv").output
    assert "in place of SOURCE" in packwork("words circle t.csv --series t.csv:year").output
    assert "--source: is missing" in packwork("words circle").output


HARVESTS = """year,land,t
2000,Peru,4
2000,Togo,2
2000,Fiji,1
2001,Peru,5
2001,Laos,2
"""


def test_a_chart_of_steps_is_written_as_files_a_sheet_and_a_report(
    packwork: Callable[..., Result], folder: Path
) -> None:
    (folder / "t.csv").write_text(HARVESTS, encoding="utf-8")
    done = packwork(
        "chart circle t.csv --series year --size-by t --label-by land"
        " -o {year}.png --pixels 80 --contact-sheet s.png --report r.json"
    )
    assert done.exit_code == 0, done.output
    assert "2 steps, all certified" in done.output
    assert "a mark moves by" in done.output
    with Image.open(folder / "2001.png") as image:
        assert max(image.size) == 80
    assert (folder / "s.png").exists()
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    assert [one["step"] for one in report["steps"]] == ["2000", "2001"]
    line = "chart circle t.csv --series year"
    assert "names not each step's file" in packwork(f"{line} -o a.svg").output
    assert "--best-of: is of one layout" in packwork(f"{line} --best-of 2").output
    assert "--by: has no meaning in a series" in packwork(f"{line} --by land").output

"""The other package's command line: same options, same kinds of files."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from packwork.wordcloud.colours import ImageColorGenerator, random_color_func
from packwork.wordcloud.wordcloud_cli import main, parse_args

TEXT = "The bear and the honey bear: bears like honey, and bees make it."


@pytest.fixture
def text(tmp_path: Path) -> Path:
    file = tmp_path / "bears.txt"
    file.write_text(TEXT, encoding="utf-8")
    return file


def test_a_picture_is_written(text: Path, tmp_path: Path) -> None:
    made = tmp_path / "cloud.png"
    line = f"--text {text} --imagefile {made} --width 120 --height 80 --random_state 1"
    main(*parse_args(line.split()))
    with Image.open(made) as picture:
        assert picture.size == (120, 80)
        assert np.asarray(picture).sum() > 1_000


def test_without_files_it_is_a_filter(monkeypatch: pytest.MonkeyPatch) -> None:
    class Stream:
        buffer = io.BytesIO(TEXT.encode())

    monkeypatch.setattr(sys, "stdin", Stream)
    args, text, image = parse_args(["--stopwords", "", "--background", "None"])
    assert text == TEXT
    assert image is sys.stdout.buffer
    assert args["background_color"] is None


def test_options_are_the_arguments_of_the_class(text: Path, tmp_path: Path) -> None:
    picture = tmp_path / "p.png"
    Image.new("RGB", (20, 10), "navy").save(picture)
    common = ["--text", str(text), "--imagefile", str(tmp_path / "c.png")]
    args, _, image = parse_args([
        *common, "--mask", str(picture), "--colormask", str(picture), "--stopwords", str(text),
        "--no_collocations", "--no_normalize_plurals", "--include_numbers", "--repeat",
        "--max_words", "7", "--fontfile", "some.ttf", "--relative_scaling", "1",
    ])  # fmt: skip
    image.close()
    assert args["mask"].shape == (10, 20, 3)
    assert isinstance(args["color_func"], ImageColorGenerator)
    assert args["stopwords"] == {TEXT}
    assert (args["collocations"], args["normalize_plurals"]) == (False, False)
    assert (args["include_numbers"], args["repeat"]) == (True, True)
    assert (args["max_words"], args["font_path"]) == (7, "some.ttf")
    plain, _, image = parse_args(common)
    image.close()
    assert plain["color_func"] is random_color_func
    assert plain["relative_scaling"] == 0


@pytest.mark.parametrize(
    ("more", "problem"),
    [
        ("--width 1.5", "invalid int value"),
        ("--relative_scaling c", "invalid float value"),
        ("--regexp (", "Invalid regular expression"),
        ("--text missing.txt", "No such file"),
        ("--mask missing.png", "No such file"),
    ],
)
def test_bad_options_end_with_one_line(
    more: str, problem: str, text: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        parse_args(["--text", str(text), *more.split()])
    assert ended.value.code == 2
    assert problem in capsys.readouterr().err.splitlines()[-1]


def test_words_have_one_source_of_colours(text: Path) -> None:
    with pytest.raises(ValueError, match="specify either"):
        parse_args(["--text", str(text), "--color", "red", "--colormask", "p.png"])


def test_a_text_without_words_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="at least 1 word"):
        main({}, "", (tmp_path / "c.png").open("wb"))

"""Wrong use is one line on standard error and exit code 2."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

Command = Callable[..., Result]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("fill", "missing argument 'CONTAINER'"),
        ("fill heart --sizes huge", "'huge' is not one of 'free', 'shared', 'fixed'"),
        ("fill heart --preset papper", "'papper' is not one of 'default', 'paper'"),
        ("fill heart --cuont 3", "no such option: --cuont"),
        ("fill heart -n", "requires an argument"),
        ("fill heart --hero owl --hero bear=20%", "--hero: is given twice; there is one hero"),
        ("fill heart --palette red --palette blue", "--palette: is given twice; write all"),
        ("fill heart --pixels many", "'--pixels': must be a whole number, not 'many'; see"),
        ("fill heart --pixels 1,000", "not '1,000'; write 1000; see"),
        ("chart heart a.csv --unit 0,5", "'--unit': must be a number, not '0,5'; write 0.5; see"),
        ("fill heart --padding 0,5mm", "0.1in or 1%, not '0,5mm'; write 0.5mm"),
        ("fill heart --canvas 10,5x7cm", "or a name such as A4, not '10,5x7cm'; write 10.5x7cm"),
        ("fill heart --tint 0,5", "--tint: must be a number, not '0,5'; write 0.5"),
        ("fill heart --loss evenness=0,5", "write evenness=0.5"),
        ("fill heart -n 1,5", "must be a whole number or auto, not '1,5'"),
        ("fil heart", "no such command 'fil'; did you mean fill?"),
        ("fill heart --outline hull", '--outline is no flag; write outline = "hull" into a recipe'),
        ("pile heart --shades=keep", '--shades is no flag; write shades = "nearest" into a recipe'),
        ("fill --help outline", "outline is no flag"),
        ("fill --help gap", "there is no topic 'gap'; did you mean --padding?"),
        ("fill --help qqqq", "there is no topic 'qqqq'; use all, written, "),
        ("fill heart --gap 3", "no such option: --gap; did you mean --padding?"),
        ("fill heart --colors red", "did you mean --palette?"),
        ("fill heart --number 3", "did you mean --count?"),
        ("fill heart --equal", "did you mean --sizes shared?"),
        ("fill heart --coverage .9", "did you mean --target-coverage?"),
        ("fill --mask a.png", "did you mean the first argument, CONTAINER?"),
        ("words heart a.txt --max-words 9", "did you mean --count?"),
        ("words heart a.txt --background_color red", "did you mean --background?"),
        ("words heart a.txt --collocations", "did you mean --phrases?"),
        ("chart heart a.csv --group-by x", "did you mean --by?"),
        ("pile square --width 9", "did you mean --canvas?"),
        ("collage heart", "did you mean fill?"),
        ("wordcloud a.txt", "did you mean words?"),
        ("pack heart", "did you mean fill?"),
        ("qqqq heart", "no such command 'qqqq'; see packwork --help"),
        ("measure", "missing argument"),
        ("chart t.csv", "missing argument 'DATA'; use "),
        ("fill heart 100", "100: is no item; -n 100 asks for so many"),
        ("fill A4", "A4: is a sheet; the whole of it is: page --canvas A4"),
        ("fill heart -o a.ai", ".pdf or .svg does for the same"),
        ("fill . heart", ".: is a folder; the container comes first"),
    ],
)
def test_wrong_use_is_one_line(packwork: Command, line: str, said: str) -> None:
    result = packwork(line)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.startswith("packwork: ")
    assert result.stderr.count("\n") == 1
    assert "--help" in result.stderr or "no such" not in said


def test_no_command_shows_the_help(packwork: Command) -> None:
    assert "Usage: packwork" in packwork("").output


@pytest.mark.parametrize("share", ["1%", "0.01", ".01", "1 %"])
def test_a_share_may_be_in_percent(packwork: Command, share: str) -> None:
    line = "fill circle star -n 2 --levels 16 --epochs 2 -q --report a.json --target-coverage"
    result = packwork(line, share)
    assert result.exit_code == 0, result.output
    assert json.loads(Path("a.json").read_text(encoding="utf-8"))["filling"]["target"] == 0.01


def test_a_share_of_more_than_all_is_refused(packwork: Command) -> None:
    result = packwork("fill circle star --target-coverage 94")
    assert result.exit_code == 2
    assert "--target-coverage: must be less than 1, not 94" in result.stderr

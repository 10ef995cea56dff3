"""Commands of a page, run as in a clone of the project, but small."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

from typer.testing import CliRunner, Result

from packwork.cli import app

ROOT = Path(__file__).parents[1]
SMALL = ["--levels", "32", "--epochs", "40", "--effort", "draft"]
TAKES_LEVELS = {"fill", "words", "chart", "photos"}


def sections(page: str) -> dict[str, str]:
    """Text of a page of the guide by second-level heading."""
    text = (ROOT / "docs" / "guide" / page).read_text(encoding="utf-8")
    return dict(re.findall(r"^## (.*?)\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL))


def commands(section: str) -> list[list[str]]:
    """Command lines of its shell blocks, cut into words."""
    blocks = re.findall(r"```sh\n(.*?)```", section, re.DOTALL)
    lines = [line for block in blocks for line in block.replace("\\\n", " ").splitlines()]
    return [shlex.split(line, comments=True) for line in lines if line.strip()]


def prepare(section: str, folder: Path) -> None:
    """Make the folder look like a clone, with the files that the section shows."""
    (folder / "examples").symlink_to(ROOT / "examples")
    for name, text in re.findall(r"```\w+\n# (\S+\.\w+)\n(.*?)```", section, re.DOTALL):
        (folder / name).write_text(text, encoding="utf-8")


def run_all(section: str) -> list[Result]:
    """Results of all packwork commands, one after another, in the working folder."""
    results = []
    for program, *arguments in commands(section):
        if program != "packwork":
            continue
        small = SMALL if arguments[0] in TAKES_LEVELS else []
        result = CliRunner().invoke(app, [*arguments, *small])
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        results.append(result)
    return results

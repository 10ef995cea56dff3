"""Counts what the source is made of, so that it cannot grow back unseen.

    python tools/house.py

Prints each count with the most that ``tests/test_house.py`` allows. A change that needs more raises
the limit in the same commit, and says why; one that makes do with less lowers it.
"""

from __future__ import annotations

import ast
import re
import statistics
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "src" / "packwork"

ROAD = ("pipeline", "run", "steps", "uses")
"""Packages between a recipe and the stages."""

DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)

_QUESTION = re.compile(r"(What|How|Where|Which|When|Who|Whether)\b")
_CHOSEN = re.compile(r"\b[Cc]hosen[.:,]")

_ENTERED = f"""
import contextlib, io, os, sys, tempfile
from packwork.cli import app

road = [os.sep + os.path.join("packwork", name) + os.sep for name in {ROAD!r}]
entered = set()

def on_call(frame, event, argument):
    code = frame.f_code
    if event == "call" and any(part in code.co_filename for part in road):
        if not code.co_name.startswith("<") and (code.co_flags & 3) == 3:
            entered.add((code.co_filename, code.co_qualname))

folder = tempfile.mkdtemp()
os.chdir(folder)
sys.setprofile(on_call)
with contextlib.suppress(SystemExit):
    app("fill heart -n 60 --effort draft --threads 1 --quiet -o a.svg".split())
sys.setprofile(None)
print(len(entered), len({{file for file, _ in entered}}))
"""


class Count(NamedTuple):
    """One figure of the source, and the most that it may be."""

    what: str
    value: int
    limit: int


LIMITS = {
    "lines of code": 73_614,
    "lines of docstrings": 20_447,
    "files": 613,
    "functions of the road in one plain fill": 94,
    "files of the road in one plain fill": 19,
    "calls of id()": 0,
    "context variables": 3,
    "docstrings that begin with a question word": 0,
    "class names that occur twice": 3,
    "constants chosen by hand": 806,
}
"""Most of each count. They are what is so, not what is aimed at."""


def modules() -> Iterator[tuple[str, list[ast.AST]]]:
    """Text and nodes of each module of the package."""
    for path in sorted(SOURCE.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        yield text, list(ast.walk(ast.parse(text)))


def docstring_lines(nodes: Iterable[ast.AST]) -> set[int]:
    """Lines that docstrings of modules, classes and functions take; those of fields are code."""
    lines: set[int] = set()
    for node in nodes:
        if isinstance(node, DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            lines.update(_lines_of(node.body[0]))
    return lines


def code_lines(text: str, nodes: Iterable[ast.AST]) -> set[int]:
    """Lines with something besides comments and blanks; docstrings count."""
    stripped = (line.strip() for line in text.split("\n"))
    lines = {k for k, line in enumerate(stripped, 1) if line and not line.startswith("#")}
    for node in nodes:
        if isinstance(node, (ast.Constant, ast.JoinedStr)):
            lines.update(_lines_of(node))
    return lines


def _lines_of(node: ast.expr | ast.stmt) -> range:
    return range(node.lineno, (node.end_lineno or node.lineno) + 1)


def begins_with_question(node: ast.AST) -> bool:
    """Whether the docstring says "What ..." in place of what the thing is."""
    if not isinstance(node, DOCUMENTED):
        return False
    if isinstance(node, ast.FunctionDef) and ast.unparse(node.returns or node) == "bool":
        return False  # "Whether ..." is what a claim is.
    return bool(_QUESTION.match(ast.get_docstring(node) or ""))


def calls_of(nodes: Iterable[ast.AST], name: str) -> int:
    """Number of calls of a plain name."""
    return sum(
        isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == name
        for node in nodes
    )


def functions_entered() -> tuple[int, int]:
    """Functions of the road, and files of theirs, that one ``fill`` without options enters."""
    printed = subprocess.run(  # noqa: S603
        [sys.executable, "-c", _ENTERED], capture_output=True, text=True, check=True
    ).stdout
    functions, files = printed.split()[-2:]
    return int(functions), int(files)


def counts() -> list[Count]:
    """All figures, in the order of ``LIMITS``."""
    code, docs, per_file = 0, 0, []
    of_id = variables = questions = chosen = 0
    classes: Counter[str] = Counter()
    for text, nodes in modules():
        described = docstring_lines(nodes)
        per_file.append(len(code_lines(text, nodes) - described))
        code += per_file[-1]
        docs += len(described)
        of_id += calls_of(nodes, "id")
        variables += calls_of(nodes, "ContextVar")
        questions += sum(map(begins_with_question, nodes))
        classes.update(node.name for node in nodes if isinstance(node, ast.ClassDef))
        chosen += len(_CHOSEN.findall(text))
    functions, files = functions_entered()
    twice = sum(number > 1 for number in classes.values())
    values = [code, docs, len(per_file), functions, files]
    values += [of_id, variables, questions, twice, chosen]
    return [
        Count(what, value, limit)
        for value, (what, limit) in zip(values, LIMITS.items(), strict=True)
    ]


def median_file() -> float:
    """Lines of code of the median file."""
    return statistics.median(
        len(code_lines(text, nodes) - docstring_lines(nodes)) for text, nodes in modules()
    )


if __name__ == "__main__":
    for count in counts():
        print(f"{count.what:45} {count.value:8,} of {count.limit:,}")  # noqa: T201
    print(f"{'lines of code, median file':45} {median_file():8.0f}")  # noqa: T201

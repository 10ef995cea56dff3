"""What type checkers say of calls: all that is right passes, each wrong one is refused."""

from __future__ import annotations

import ast
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import get_type_hints

import pytest

from packwork.api.parts import measures
from packwork.metrics.exact import ExactMetrics
from packwork.metrics.measure import (
    ExactShares,
    LayoutMetrics,
    Metrics,
)
from packwork.metrics.pixel import PixelMetrics, ShapeMetrics

ROOT = Path(__file__).resolve().parents[2]
CALLS = Path(__file__).with_name("calls.py")
WRONG = {
    number
    for number, line in enumerate(CALLS.read_text(encoding="utf-8").splitlines(), start=1)
    if line.endswith("# wrong")
}


def test_the_types_are_those_of_the_fields(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    import write_keywords

    kept = write_keywords.TARGET.read_text(encoding="utf-8")
    assert _without_layout(kept) == _without_layout(write_keywords.written()), (
        "an option has changed: run python tools/write_keywords.py"
    )


def _without_layout(source: str) -> list[str]:
    """Statements of a module but for imports that nothing uses, whatever their layout."""
    tree = ast.parse(source)
    return [
        re.sub(r"\s+", " ", ast.unparse(node))
        for node in tree.body
        if not isinstance(node, ast.ImportFrom)
    ]


def test_mypy_refuses_what_is_wrong_and_nothing_else() -> None:
    pytest.importorskip("mypy")
    said = _run(sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(CALLS))
    lines = [line for line in said.splitlines() if Path(line.partition(":")[0]).name == CALLS.name]
    met = {int(line.split(":")[1]): line for line in lines if ": error:" in line}
    assert met.keys() == WRONG, "\n".join(met.values())


def test_pyright_refuses_what_is_wrong_and_nothing_else(tmp_path: Path) -> None:
    places = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    found = (shutil.which(name, path=places) for name in ("basedpyright", "pyright"))
    name = next(filter(None, found), None)
    if name is None:
        pytest.skip("pyright is not installed")
    asked = tmp_path / "pyrightconfig.json"
    settings = {"include": [str(CALLS)], "extraPaths": [str(ROOT / "src")]}
    asked.write_text(json.dumps({**settings, "typeCheckingMode": "standard"}), encoding="utf-8")
    said = _run(name, "--outputjson", "--project", str(asked), "--pythonpath", sys.executable)
    if not said.startswith("{"):
        pytest.skip(f"{name} does not run here, as where it cannot download itself")
    errors = [one for one in json.loads(said)["generalDiagnostics"] if one["severity"] == "error"]
    met = {one["range"]["start"]["line"] + 1: one["message"] for one in errors}
    assert met.keys() == WRONG, met


def _run(*command: str) -> str:
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip()


def test_measures_have_the_names_that_are_reported() -> None:
    square = PixelMetrics(1.0, 2.0, 0.0, 0.0, 0.0)
    exact = ExactMetrics(
        coverage=1.0, overlap=0.0, exceeding=0.0, overlap_area=0.0, outside_area=0.0, min_gap=0.0
    )
    said = LayoutMetrics(square, exact, 1.0, ShapeMetrics(0.0, 1.0, 1, 0)).as_dict()
    assert list(said)[:4] == ["coverage", "overlap", "outside", "unevenness"]
    assert said["coverage"] == said["LC"]
    named = measures(said)
    assert named.keys() == get_type_hints(Metrics).keys()
    assert named["exact"].keys() == get_type_hints(ExactShares).keys()
    own = {*get_type_hints(PixelMetrics), *get_type_hints(ShapeMetrics), "LC_ink", "exact"}
    assert said.keys() == own | {"coverage", "overlap", "outside", "unevenness"}


def test_types_are_shipped() -> None:
    assert (ROOT / "src" / "packwork" / "py.typed").exists()

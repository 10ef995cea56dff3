"""The page on security: each sentence stands in a table beside the tests that try it."""

from __future__ import annotations

import ast
import functools
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import packwork as pw
from each import for_each
from packwork.batches import cluster
from packwork.errors import PackworkError

TESTS = Path(__file__).parent
ROOT = TESTS.parent
SOURCE = ROOT / "src" / "packwork"
PAGE = ROOT / "docs" / "security.md"

_END = re.compile(r"(?<=[.?])\s+(?=[A-Z`])")


def sentences(page: str) -> list[str]:
    """Sentences of a page, without marks, headings and what stands in bold before a promise."""
    found: list[str] = []
    for block in re.split(r"\n\s*\n|\n(?=- |#)", page):
        text = " ".join(re.sub(r"\*\*[^*]+\.\*\*", "", block).split()).removeprefix("- ")
        if text and not text.startswith("#"):
            found += [one.replace("*", "").strip() for one in _END.split(text)]
    return [one for one in found if one]


def table() -> Iterator[tuple[str, str]]:
    """Sentences and what tries them: tests, ``page`` for advice and words about the page."""
    for block in (TESTS / "security.txt").read_text(encoding="utf-8").strip().split("\n\n"):
        said, _, tried = block.rpartition("\n    ")
        yield " ".join(said.split()), tried.strip()


TABLE = dict(table())


def test_each_sentence_of_the_page_is_in_the_table_and_no_other() -> None:
    said = sentences(PAGE.read_text(encoding="utf-8"))
    assert [one for one in said if one not in TABLE] == []
    assert [one for one in TABLE if one not in said] == []
    assert len(said) > 60


def test_a_sentence_that_nobody_tries_is_seen() -> None:
    page = "# A\n\nIt is so. `It` is *not* so\nat all.\n\n- **Safe.** What is\n  it? Nothing.\n"
    assert sentences(page) == [
        "It is so.", "`It` is not so at all.", "What is it?", "Nothing.",
    ]  # fmt: skip


def test_words_about_the_page_promise_nothing() -> None:
    advice = [said for said, tried in TABLE.items() if tried == "page"]
    promises = r"\b(never|nothing|refused|bounded|closed|checked|escaped|no other)\b"
    assert len(advice) < 25
    assert [one for one in advice if re.search(promises, one, re.IGNORECASE)] == []


def _names(file: str) -> set[str]:
    tree = ast.parse((TESTS / file).read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}


@for_each(said for said, tried in TABLE.items() if tried != "page")
def test_what_is_promised_is_tried(said: str) -> None:
    for test in TABLE[said].split():
        file, _, name = test.partition("::")
        assert name.startswith("test_")
        assert name in _names(file), f"{test} is gone; what tries: {said}"


@functools.cache
def imports() -> list[tuple[str, str]]:
    """Modules of ours, and what they import."""
    return sorted(set(_imports()))


def _imports() -> Iterator[tuple[str, str]]:
    for path in SOURCE.rglob("*.py"):
        module = ".".join(path.relative_to(SOURCE.parent).with_suffix("").parts)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from ((module, one.name) for one in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module:
                yield module, node.module


def test_only_the_studio_and_the_cluster_open_connections() -> None:
    nets = {"socket", "ssl", "urllib.request", "http.client", "requests", "uvicorn", "distributed"}
    found = {module for module, other in imports() if other in nets or other.split(".")[0] in nets}
    # Of a socket pair inside one process: a way to hear of signals.
    found.discard("packwork.cli.failure")
    assert found <= {"packwork.studio.serving", "packwork.batches.cluster"}


def test_only_kernels_are_unpickled() -> None:
    risky = {"pickle", "marshal", "shelve", "cloudpickle", "joblib", "dill"}
    assert {m for m, other in imports() if other.split(".")[0] in risky} == {
        "packwork.compiled.cache"
    }
    for path in SOURCE.rglob("*.py"):
        assert "allow_pickle=True" not in path.read_text(encoding="utf-8")


def test_what_is_measured_shares_no_code_with_what_places() -> None:
    placing = {
        "solve", "start", "assignment", "finish", "settle", "separation", "compaction", "forces",
        "losses", "pipeline",
    }  # fmt: skip
    found = {
        (module, other)
        for module, other in imports()
        if module.startswith("packwork.metrics") and other.split(".")[1:2]
        and other.split(".")[0] == "packwork" and other.split(".")[1] in placing
    }  # fmt: skip
    assert found == set()


def test_a_studio_that_others_reach_has_to_be_meant(tmp_path: Path) -> None:
    line = [sys.executable, "-m", "packwork", "studio", "--no-browser", "--host", "0.0.0.0"]  # noqa: S104
    done = subprocess.run(line, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 2
    assert "lets others reach the studio; add --i-know" in done.stderr


def test_a_worker_of_another_version_is_refused() -> None:
    with pytest.raises(PackworkError, match=r"a worker has packwork .*, this machine 0\.0\.0"):
        cluster._check_version("0.0.0")


def test_a_run_writes_nothing_into_the_installation(tmp_path: Path) -> None:
    def state() -> dict[Path, float]:
        found = (path for path in SOURCE.rglob("*") if "__pycache__" not in path.parts)
        return {path: path.stat().st_mtime for path in found if path.is_file()}

    before = state()
    pw.fill("circle", "star", count=3, effort="draft", levels="50").save(tmp_path / "a.svg")
    assert state() == before


HOSTILE = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'viewBox="0 0 9 9" onload="alert(1)"><script>alert(2)</script><style>@import "x.css"; '
    'path {{ fill: url(https://example.org/a.svg#b) }}</style><a xlink:href="javascript:alert(3)">'
    '<path onclick="alert(4)" d="M0 0h9v9z"/></a><image href="file:///etc/passwd" width="3" '
    'height="3"/><use href="other.svg#c"/><foreignObject><b onmouseover="x()">b</b></foreignObject>'
    '<path id="x&quot; onload=&quot;alert(5)" d="M0 0h4v9z"/></svg>'
)


def test_what_is_written_runs_nothing_and_leads_nowhere(tmp_path: Path) -> None:
    name = 'a" onload="alert(6)<script>.svg' if sys.platform != "win32" else "a' onload='x.svg"
    (tmp_path / name).write_text(HOSTILE.replace("{{", "{").replace("}}", "}"), encoding="utf-8")
    layout = pw.fill("circle", str(tmp_path / name), count=2, effort="draft", levels="50")
    for file in ("a.svg", "a.pdf", "a.geojson", "a.packwork"):
        if file.endswith(".packwork"):
            session = layout.edit()
            session.save(tmp_path / file)
            layout = pw.Session.open(tmp_path / file).layout
            continue
        layout.save(tmp_path / file)
    written = layout.to_svg()
    for svg in (written, (tmp_path / "a.svg").read_text(encoding="utf-8")):
        bare = re.sub(r'"[^"]*"', lambda met: '""' if "href" not in met[0] else met[0], svg)
        assert "<script" not in svg
        assert "foreignObject" not in svg
        assert not re.search(r"\son[a-z]+\s*=", bare)
        assert "@import" not in svg
        links = re.findall(r'(?:href|src)="([^"]*)"|url\(([^)]*)\)', svg)
        assert all((a or b).strip("'\"").startswith(("#", "data:image/")) for a, b in links)

"""The house rules that no linter holds: who imports numba, what is public."""

from __future__ import annotations

import ast
import importlib
from collections.abc import Iterator
from pathlib import Path

import pytest

import packwork
from packwork.compiled import called_by, holds_kernels

SOURCE = Path(packwork.__file__).parent
MODULES = sorted(SOURCE.rglob("*.py"))
LONGEST_FUNCTION = 60
LONGEST_KERNEL = 80
LONGEST_FILE = 400


def imported(tree: ast.AST) -> Iterator[str]:
    """Names of the modules that a module imports, wherever in it."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            # From a package its modules: that is an import of the modules.
            inner = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from inner if all(map(holds_kernels, inner)) else [node.module]


def is_compiled(path: Path) -> bool:
    """Whether compiled code may lie in a file."""
    return path.stem != "__init__" and holds_kernels(".".join(path.with_suffix("").parts))


def parse(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


each_module = pytest.mark.parametrize(
    "path", MODULES, ids=[str(path.relative_to(SOURCE)) for path in MODULES]
)


def test_the_scan_sees_a_forbidden_import() -> None:
    tree = ast.parse("def f():\n    from numba import njit\n    import numba.typed\n")
    assert [name.split(".")[0] for name in imported(tree)] == ["numba", "numba"]


@pytest.mark.parametrize("path", [path for path in MODULES if is_compiled(path)])
def test_no_import_of_a_kernel_escapes_its_fingerprint(path: Path) -> None:
    name = ".".join(("packwork", *path.relative_to(SOURCE).with_suffix("").parts))
    importlib.import_module(name)
    expected = set(filter(holds_kernels, imported(parse(path))))
    assert called_by(path.read_text(encoding="utf-8")) == expected


@each_module
def test_only_kernels_are_compiled(path: Path) -> None:
    names = set(imported(parse(path)))
    assert ("numba" in {name.split(".")[0] for name in names}) == (path.stem == "compiled")
    decorators = {
        alias.name
        for node in ast.walk(parse(path))
        if isinstance(node, ast.ImportFrom) and node.module == "packwork.compiled"
        for alias in node.names
    } & {"kernel", "helper"}
    assert bool(decorators) == (is_compiled(path))


@each_module
def test_kernels_import_nothing_of_the_package_but_kernels_and_their_decorator(path: Path) -> None:
    if is_compiled(path):
        ours = [name for name in imported(parse(path)) if name.startswith("packwork")]
        assert all(holds_kernels(name) or name == "packwork.compiled" for name in ours)


@each_module
def test_files_and_functions_stay_short(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    is_written = "Written by ``tools/" in text
    assert is_written or text.count("\n") <= LONGEST_FILE
    longest = LONGEST_KERNEL if is_compiled(path) else LONGEST_FUNCTION
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef) and node.body:
            # The docstring is not what makes a function long.
            first = node.body[1] if ast.get_docstring(node) and len(node.body) > 1 else node.body[0]
            assert (node.end_lineno or 0) - first.lineno < longest, node.name


@pytest.mark.parametrize("name", packwork.__all__)
def test_every_public_name_loads(name: str) -> None:
    assert getattr(packwork, name).__doc__


def test_public_names_are_sorted_and_unique() -> None:
    assert packwork.__all__ == sorted(set(packwork.__all__))
    assert dir(packwork) == packwork.__all__


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'magic'"):
        packwork.magic  # noqa: B018


@each_module
def test_every_module_loads_by_itself_and_says_what_it_is(path: Path) -> None:
    relative = path.relative_to(SOURCE).with_suffix("")
    if relative.name == "__main__":
        return
    parts = [part for part in relative.parts if part != "__init__"]
    assert importlib.import_module(".".join(["packwork", *parts])).__doc__

"""The house rules that no linter holds: who imports numba, what is public."""

from __future__ import annotations

import ast
import importlib
import re
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

import packwork
from packwork.compiled import called_by, holds_kernels

SOURCE = Path(packwork.__file__).parent
# Inkscape runs the extension in its own Python, with packages of its own.
MODULES = sorted(path for path in SOURCE.rglob("*.py") if path.parent.name != "extension")
TOP = Path(__file__).parents[1]
OURS = ("src", "tests", "benchmarks", "tools", "examples")
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


def name_of(path: Path) -> str:
    """Dotted name of a module or package."""
    parts = path.relative_to(SOURCE).with_suffix("").parts
    return ".".join(("packwork", *(part for part in parts if part != "__init__")))


def parse(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def test_the_scan_sees_a_forbidden_import() -> None:
    tree = ast.parse("def f():\n    from numba import njit\n    import numba.typed\n")
    assert [name.split(".")[0] for name in imported(tree)] == ["numba", "numba"]


def test_no_import_of_a_kernel_escapes_its_fingerprint() -> None:
    unseen = {}
    for path in filter(is_compiled, MODULES):
        importlib.import_module(name_of(path))
        expected = set(filter(holds_kernels, imported(parse(path))))
        unseen[path] = expected ^ called_by(path.read_text(encoding="utf-8"))
    assert not {path: names for path, names in unseen.items() if names}


def has_compiled_code(tree: ast.Module) -> bool:
    """Whether a module decorates kernels or helpers."""
    return any(
        alias.name in {"kernel", "helper", "leaf", "shared"}
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module == "packwork.compiled"
        for alias in node.names
    )


def parsed(paths: Iterable[Path], *words: str) -> dict[Path, ast.Module]:
    """Trees of the modules that hold one of these words: what lacks them has no such name."""
    texts = {path: path.read_text(encoding="utf-8") for path in paths}
    return {
        path: ast.parse(text) for path, text in texts.items() if any(map(text.__contains__, words))
    }


def test_only_kernels_are_compiled() -> None:
    trees = parsed(MODULES, "numba", "packwork.compiled")
    importers = {
        path.relative_to(SOURCE).as_posix()
        for path, tree in trees.items()
        if any(name.split(".")[0] == "numba" for name in imported(tree))
    }
    assert {name.partition("/")[0] for name in importers} == {"compiled"}
    compiled = {path for path, tree in trees.items() if has_compiled_code(tree)}
    assert compiled == set(filter(is_compiled, MODULES))


def test_kernels_import_nothing_of_the_package_but_kernels_and_their_decorator() -> None:
    strangers = [
        (path, name)
        for path in filter(is_compiled, MODULES)
        for name in imported(parse(path))
        if name.startswith("packwork")
        if not (holds_kernels(name) or name == "packwork.compiled")
    ]
    assert not strangers


def lengths(tree: ast.Module) -> Iterator[tuple[str, int]]:
    """Names of functions and their lines, without the docstring: it does not make them long."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node.body:
            first = node.body[1] if ast.get_docstring(node) and len(node.body) > 1 else node.body[0]
            yield node.name, (node.end_lineno or 0) - first.lineno + 1


def test_files_and_functions_stay_short() -> None:
    too_long = []
    for path in MODULES:
        text = path.read_text(encoding="utf-8")
        is_generated = "Written by ``tools/" in text
        if text.count("\n") > LONGEST_FILE and not is_generated:
            too_long.append((path, text.count("\n")))
        longest = LONGEST_KERNEL if is_compiled(path) else LONGEST_FUNCTION
        too_long += [(path, name) for name, n in lengths(ast.parse(text)) if n > longest]
    assert not too_long


def without_encoding(tree: ast.AST) -> list[int]:
    """Lines of calls that read or write a file's text as the locale has it."""
    most = {"read_text": 0, "write_text": 1}
    return [
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and len(node.args) <= most.get(node.func.attr, -1)
        and "encoding" not in {word.arg for word in node.keywords}
    ]


def test_files_are_utf_8_in_any_locale() -> None:
    assert without_encoding(ast.parse("a.read_text()\na.write_text(b)\na.read_text('utf-8')")) == [
        1,
        2,
    ]
    ours = [path for name in OURS for path in (TOP / name).rglob("*.py")]
    trees = parsed(ours, "read_text", "write_text")
    found = {path: without_encoding(tree) for path, tree in trees.items()}
    assert not {path: lines for path, lines in found.items() if lines}


def test_every_public_name_loads() -> None:
    assert not [name for name in packwork.__all__ if not getattr(packwork, name).__doc__]


def test_public_names_are_sorted_and_unique() -> None:
    assert packwork.__all__ == sorted(set(packwork.__all__))
    assert dir(packwork) == packwork.__all__


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'magic'"):
        packwork.magic  # noqa: B018


def test_every_module_loads_by_itself_and_says_what_it_is() -> None:
    names = [name_of(path) for path in MODULES if path.stem != "__main__"]
    assert not [name for name in names if not importlib.import_module(name).__doc__]


def test_the_page_of_the_architecture_has_the_layers_that_contracts_hold() -> None:
    project = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))
    held, *_ = project["tool"]["importlinter"]["contracts"]
    page = (TOP / "docs" / "architecture.md").read_text(encoding="utf-8")
    lines = re.findall(r"^    (\w.*)$", page, flags=re.MULTILINE)
    shown = " ; ".join(re.split(r"  +", line)[0] for line in lines).replace("| ;", "|")
    layers = [sorted(layer.split(" | ")) for layer in shown.split(" ; ")]
    assert layers == [sorted(layer.split(" | ")) for layer in held["layers"]]

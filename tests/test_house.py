"""The source does not grow back unseen: counts of ``tools/house.py`` keep to their limits."""

from __future__ import annotations

import ast
import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

TOOL = Path(__file__).resolve().parent.parent / "tools" / "house.py"


@pytest.fixture(scope="module")
def house() -> ModuleType:
    spec = importlib.util.spec_from_file_location("house", TOOL)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_counts_are_at_their_limits_and_not_above(house: ModuleType) -> None:
    counts = house.counts()
    assert not [count for count in counts if count.value > count.limit]
    assert not [count for count in counts if count.limit > 1.05 * count.value + 5]


def test_docstrings_and_comments_are_no_code(house: ModuleType) -> None:
    text = '"""Says\n\nmuch."""\n# a comment\n\nX = 1\n"""Of a\n\n# field."""\n'
    nodes = list(ast.walk(ast.parse(text)))
    described = house.docstring_lines(nodes)
    assert described == {1, 2, 3}
    assert house.code_lines(text, nodes) - described == {6, 7, 8, 9}


def test_a_docstring_that_asks_is_counted(house: ModuleType) -> None:
    asks, answers = ast.parse(
        'def f():\n    """How it is."""\ndef g():\n    """Height of it."""\n'
    ).body
    assert house.begins_with_question(asks)
    assert not house.begins_with_question(answers)

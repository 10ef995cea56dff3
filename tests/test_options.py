"""What all options have in common."""

from __future__ import annotations

import subprocess
import sys
from typing import ClassVar

import pytest
from pydantic import ValidationError

from packwork.options import Options
from packwork.recipe import Recipe
from packwork.recipe.piles import MotionOptions


class Kept(Options):
    size: float = 1.0
    """Longer side,
    in px."""

    bare: int = 0

    shared: ClassVar[int] = 3
    """No field."""


class Wider(Kept):
    size: float = 2.0
    """Another side."""

    depth: float = 1.0
    """How deep."""


def test_docstrings_are_descriptions() -> None:
    said = {name: field.description for name, field in Kept.model_fields.items()}
    assert said == {"size": "Longer side,\nin px.", "bare": None}


def test_a_subclass_keeps_or_replaces_them() -> None:
    said = {name: field.description for name, field in Wider.model_fields.items()}
    assert said == {"size": "Another side.", "bare": None, "depth": "How deep."}
    force = MotionOptions.model_fields["force"].description
    assert force
    assert Recipe.model_fields["force"].description == force


def test_the_schema_has_them_too() -> None:
    assert Wider.model_json_schema()["properties"]["depth"]["description"] == "How deep."


def test_they_are_frozen_and_refuse_unknown_keys() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        Kept().size = 3.0  # type: ignore[misc]
    with pytest.raises(ValidationError, match="Extra inputs"):
        Kept(height=1)  # type: ignore[call-arg]


def test_a_class_without_a_source_has_no_descriptions() -> None:
    code = (
        "from packwork.options import Options\n"
        "class Typed(Options):\n"
        "    size: float = 1.0\n"
        "    'Longer side.'\n"
        "assert Typed.model_fields['size'].description is None\n"
        "assert Typed(size=2).size == 2\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr

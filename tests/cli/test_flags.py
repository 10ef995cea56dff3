"""A field is all that there is of an option: commands make flags of fields."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest
import typer
from typer.testing import CliRunner

from each import for_each
from packwork.cli.options import by_name, flag, typed
from packwork.options import NOT_OFFERED, Group, Offer, Options, Verbs, offered
from packwork.recipe import Recipe


class Parts(Options):
    offers = Offer(group=Group.TYPE, verbs=Verbs.WORDS)

    tint: str | None = None
    """Of a part."""

    second: Annotated[int, Offer(after="first")] = 2
    """Listed elsewhere."""

    third: Annotated[int, Offer(after="second")] = 3
    """After one that is listed elsewhere."""


class Kinds(Parts):
    """Options of every type."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.EVERY)

    first: int = 1
    """A number."""

    length: str | float | None = None
    """Of several forms."""

    names: Annotated[tuple[str, ...], Offer(flags="-s --some")] = ()
    """Several."""

    files: tuple[Path, ...] = ()
    """Several files."""

    choice: Literal["a", "b"] = "a"
    """One of two."""

    is_on: bool = True
    """On by itself."""

    is_off: bool = False
    """Off by itself."""

    is_open: Annotated[bool | None, Offer(flags="--yes/--no")] = None
    """Neither."""

    table: Annotated[dict[str, int] | None, Offer(typed=list[str], help="Typed.")] = None
    """In a file."""

    hidden: Annotated[str, NOT_OFFERED] = ""
    """No option."""


OPTIONS = {option.name: option for option in offered(Kinds)}


def test_own_options_come_first_and_each_after_the_one_it_names() -> None:
    assert list(OPTIONS) == [
        "first", "second", "third", "length", "names", "files", "choice", "is_on", "is_off",
        "is_open", "table", "tint",
    ]  # fmt: skip


def test_an_option_without_its_neighbour_stands_where_it_is() -> None:
    assert [option.name for option in offered(Parts)] == ["tint", "second", "third"]


def test_group_and_verbs_are_the_fields_or_those_of_its_class() -> None:
    assert (OPTIONS["first"].offer.group, OPTIONS["first"].verbs) == (Group.PLACED, Verbs.EVERY)
    assert (OPTIONS["second"].offer.group, OPTIONS["second"].verbs) == (Group.TYPE, Verbs.WORDS)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("first", int),
        ("length", str),
        ("names", list[str]),
        ("files", list[Path]),
        ("choice", Literal["a", "b"]),
        ("is_open", bool),
        ("table", list[str]),
    ],
)
def test_what_is_typed_follows_from_the_type(name: str, kind: Any) -> None:
    assert typed(OPTIONS[name]) == kind


@for_each(offered(Recipe), name=lambda option: option.name)
def test_every_neighbour_that_a_recipes_option_names_is_there(option: Any) -> None:
    assert option.offer.after in {None, *(other.name for other in offered(Recipe))}


def parsed(line: str) -> dict[str, Any]:
    """What a command of these options is called with."""
    asked: dict[str, Any] = {}

    def command(**options: Any) -> None:
        asked.update(options)

    parameters = [flag(option, option.default) for option in OPTIONS.values()]
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    app = typer.Typer()
    app.command()(command)
    result = CliRunner().invoke(app, line.split())
    assert result.exit_code == 0, result.output
    return asked


def test_a_command_line_gives_values_by_field() -> None:
    plain = parsed("")
    assert plain == {
        "first": 1, "second": 2, "third": 3, "length": None, "names": None, "files": None,
        "choice": "a", "is_on": True, "is_off": False, "is_open": None, "table": None, "tint": None,
    }  # fmt: skip
    asked = parsed("--first 4 --length 2mm -s x --some y --files a.b --no-is-on --is-off --no")
    changed = {key: value for key, value in asked.items() if value != plain[key]}
    assert changed == {
        "first": 4, "length": "2mm", "names": ["x", "y"], "files": [Path("a.b")],
        "is_on": False, "is_off": True, "is_open": False,
    }  # fmt: skip


def test_a_command_with_few_options_names_them_and_no_more() -> None:
    @by_name
    def command(thing: str, *, pixels: int, quiet: bool) -> None:
        """Do it."""

    app = typer.Typer()
    app.command()(command)
    options = {p.name: p for p in typer.main.get_command(app).params}
    assert options["pixels"].default == 1_600
    assert options["quiet"].opts == ["-q", "--quiet"]

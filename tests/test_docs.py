"""Documents against code: every option, command, loss and measure is written down."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
import typer.main

from packwork.cli import app
from packwork.cli.options import Choosing, LayoutFiles, Serial, SerialMarks, SideFiles, Terminal
from packwork.losses.registry import LOSSES
from packwork.metrics.exact import ExactMetrics
from packwork.metrics.measure import LayoutMetrics
from packwork.metrics.pixel import PixelMetrics, ShapeMetrics
from packwork.options import Offered, offered
from packwork.recipe import Recipe
from packwork.recipe.verbs import VERBS, default_of, options_of
from packwork.writers.film.options import FilmOptions
from packwork.writers.film.registry import FILMS

ROOT = Path(__file__).parents[1]
DOCS = "\n".join(page.read_text(encoding="utf-8") for page in sorted((ROOT / "docs").rglob("*.md")))
README = (ROOT / "README.md").read_text(encoding="utf-8")
COMMANDS: Mapping[str, Any] = typer.main.get_command(app).commands  # type: ignore[attr-defined]
PARAMETERS = [
    (f"{name} {parameter.opts[-1]}", parameter)
    for name, command in COMMANDS.items()
    for parameter in command.params
]
VERB_OF = {str(verb.name).lower(): verb for verb in VERBS}
OFFERED = [(name, option) for name, verb in VERB_OF.items() for option in options_of(verb)]
FILES = [
    option
    for model in (LayoutFiles, Serial, SerialMarks, Choosing, SideFiles, Terminal)
    for option in offered(model)
]

IN_ITS_OWN_WORDS = {
    "--count", "--font", "--color-by", "--add", "--hold", "--output", "--report", "--contact-sheet",
    "--sizes", "--series", "--picture", "--rotate", "--time", "--seed", "--margin",
    "--effort", "--preflight",
}  # fmt: skip
"""Options of words that say the same thing as elsewhere, of words; what an edit adds, and holds,
which a film does with its last picture; files of each row of a table, and a table of all;
sizes of a layout that is there, and a picture under it; a table and its column, and a column of the
chart's; angles, seconds, seeds, effort and margin of a nest;
a look at a file that is there."""


def defines(page: str, name: str) -> bool:
    """Whether a name stands in code quotes or as a table's first cell, not just in prose."""
    return bool(re.search(rf"`{name}`|^\| `?{name}(\.\*)?`? \|", page, flags=re.MULTILINE))


def metric_names() -> list[str]:
    """Names of the report's measures, those in exact geometry together under ``exact``."""
    zeros = [
        dict.fromkeys((field.name for field in dataclasses.fields(kind)), 0.0)
        for kind in (PixelMetrics, ExactMetrics, ShapeMetrics)
    ]
    pixel, exact = PixelMetrics(**zeros[0]), ExactMetrics(**zeros[1])
    return list(LayoutMetrics(pixel, exact, 0.0, ShapeMetrics(**zeros[2])).as_dict())


def test_every_command_says_what_it_does_and_shows_an_example() -> None:
    helps = {name: command.help for name, command in COMMANDS.items()}
    assert not [name for name, text in helps.items() if not text.split("\n")[0].endswith(".")]
    assert not [name for name, text in helps.items() if f"packwork {name}" not in text]


def test_every_parameter_has_a_help_text() -> None:
    assert not [name for name, parameter in PARAMETERS if not getattr(parameter, "help", None)]


def test_every_recipe_field_says_what_it_means() -> None:
    descriptions = {name: field.description for name, field in Recipe.model_fields.items()}
    assert not [name for name, text in descriptions.items() if not (text or "").endswith(".")]


@pytest.mark.parametrize("name", VERB_OF)
def test_a_command_offers_what_the_fields_say(name: str) -> None:
    there = {p.name for p in COMMANDS[name].params if p.param_type_name == "option"}
    files = {option.name for option in FILES if VERB_OF[name] in option.verbs}
    flags = {o.name for command, o in OFFERED if command == name and o.offer.is_flag}
    assert there == files | flags


def test_every_field_of_a_recipe_is_offered_or_said_not_to_be() -> None:
    somewhere = {option.name for _, option in OFFERED}
    elsewhere = {"container", "rules", "words", "chart", "pile", "film"}
    assert set(Recipe.model_fields) == (somewhere & set(Recipe.model_fields)) | elsewhere
    assert not somewhere & elsewhere


def is_as_its_field_says(name: str, option: Offered) -> bool:
    """Whether help, default and group of a command's flag are those of the option's field."""
    (flag,) = (p for p in COMMANDS[name].params if p.name == option.name)
    is_open = flag.multiple or option.name in FilmOptions.model_fields
    default = None if is_open else default_of(VERB_OF[name], option)
    found = (flag.help, flag.default, flag.rich_help_panel)
    return found == (option.help, default, option.offer.group)


def test_help_and_default_of_an_option_are_its_fields() -> None:
    flags = [(name, option) for name, option in OFFERED if option.offer.is_flag]
    assert not [(name, o.name) for name, o in flags if not is_as_its_field_says(name, o)]


OWN = {option.name: option for verb in VERBS.values() if verb.part for option in offered(verb.part)}


def test_every_option_that_one_verb_has_alone_is_documented() -> None:
    assert not [option.flag for option in OWN.values() if f"`{option.flag}" not in DOCS]


@pytest.mark.parametrize("command", ["fill", "words", "photos", "run"])
def test_every_option_of_films_is_offered_and_documented(command: str) -> None:
    there = {p.name: p for p in COMMANDS[command].params if p.name in FilmOptions.model_fields}
    helps = {name: field.description for name, field in FilmOptions.model_fields.items()}
    assert {name: option.help for name, option in there.items()} == helps
    assert {option.default for option in there.values()} == {None}
    page = (ROOT / "docs" / "guide" / "films.md").read_text(encoding="utf-8")
    assert not [name for name, option in there.items() if f"`{option.opts[0]}" not in page]


def test_every_format_of_films_is_documented() -> None:
    page = (ROOT / "docs" / "guide" / "films.md").read_text(encoding="utf-8")
    assert not [ending for ending in FILMS if f"| `{ending}` |" not in page]


def test_one_option_means_one_thing_in_all_commands() -> None:
    helps: dict[str, set[str]] = {}
    for command in COMMANDS.values():
        for parameter in command.params:
            if parameter.param_type_name == "option":
                helps.setdefault(parameter.opts[-1], set()).add(str(parameter.help))
    assert {name for name, texts in helps.items() if len(texts) > 1} == IN_ITS_OWN_WORDS


def test_every_loss_and_measure_is_documented() -> None:
    assert not [name for name in (*LOSSES, *metric_names()) if not defines(DOCS, name)]


def test_every_command_is_in_the_readme_or_the_docs() -> None:
    assert not [name for name in COMMANDS if f"packwork {name}" not in README + DOCS]


def commands_in(page: str) -> list[str]:
    """Lines of the fenced blocks of a page, prompts taken off."""
    blocks = re.findall(r"```[a-z]*\n(.*?)```", page, flags=re.DOTALL)
    lines = [line.strip().removeprefix("$ ") for block in blocks for line in block.splitlines()]
    return [line.split("#")[0].strip() for line in lines if line]


def make_targets() -> set[str]:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z][a-z-]*):", makefile, flags=re.MULTILINE))


@pytest.mark.parametrize("target", ["demo", "test"])
def test_the_two_commands_that_matter_are_in_the_readme(target: str) -> None:
    assert f"make {target}" in commands_in(README)
    assert target in make_targets()


def test_every_make_command_of_the_readme_exists() -> None:
    asked = {line.split()[1] for line in commands_in(README) if line.startswith("make ")}
    assert asked <= make_targets()


def test_every_packwork_command_of_the_readme_can_be_parsed() -> None:
    for line in commands_in(README):
        if line.startswith("packwork "):
            _, name, *arguments = line.split()
            COMMANDS[name].make_context(name, arguments)


PAGES_THAT_INSTALL = [
    page
    for folder in ("", "docs", "docs/guide", "examples/network", "examples/torch_loss")
    for page in sorted((ROOT / folder).glob("*.md"))
]


def test_extras_are_added_to_the_clone_and_do_not_replace_it() -> None:
    replaced = [
        f"{page}: {line}"
        for page in PAGES_THAT_INSTALL
        for line in re.findall(r"pip install [^`\n]*\[[a-z,]+\]", page.read_text(encoding="utf-8"))
        if not re.match(r"pip install -e '(\.\./)*\.{1,2}\[", line)
    ]
    assert not replaced

"""Help answers at once, and shows how."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from typer.testing import Result

import packwork.cli
from packwork.cli.commands import SUMMARIES, Commands
from packwork.options import Verbs
from packwork.recipe.verbs import COMMON, VERBS, named

Command = Callable[..., Result]

PHRASES = {
    "": ["fill", "measure", "demo", "bench", "--version", "packwork demo"],
    "fill": [
        "packwork fill heart", "packwork fill bear.png icons/ -n 100", "--rotate none",
        "packwork fill text:HELLO",
        "What is placed", "How it is solved", "What is written", "all built-in icons",
        "packwork fill --help all",
    ],
    "words": ["packwork words heart speech.txt", "SOURCE", "How words are set", "--color-by"],
    "chart": ["packwork chart circle coffee.csv", "DATA", "What marks say", "--size-by"],
    "photos": ["packwork photos heart holidays/", "PHOTO", "What becomes of edges", "--border"],
    "pile": ["packwork pile square icons", "--open", "--size", "open path"],
    "measure": ["packwork measure bear.geojson", "LAYOUT", "--diagnose"],
    "demo": ["packwork demo", "bear", "dragon", "--folder"],
    "bench": ["packwork bench engine", "NAME"],
}  # fmt: skip


@pytest.mark.parametrize("flag", ["--help", "-h"])
@pytest.mark.parametrize("command", PHRASES)
def test_help_shows_examples(command: str, flag: str, packwork: Command) -> None:
    result = packwork(f"{command} {flag}")
    assert result.exit_code == 0
    text = " ".join(result.stdout.split())
    for phrase in PHRASES[command]:
        assert phrase in text


def flags_in(shown: str) -> list[str]:
    """Long names of the options that a help shows; of switches the first."""
    return re.findall(r"^[│ ]+(?:-\w +)?(--[a-z-]+)", shown, flags=re.MULTILINE)


@pytest.mark.parametrize("name", ["fill", "words", "photos", "chart", "pile", "run"])
def test_help_shows_the_twenty_options_that_matter(name: str, packwork: Command) -> None:
    flags = flags_in(packwork(f"{name} --help").output)
    common = {*COMMON, *VERBS[named(name)].common}  # type: ignore[index]
    options = {p.name: p.opts for p in Commands()[name].params if p.param_type_name == "option"}
    assert set(flags) == {options[n][-1] for n in common if n in options} | {"--help"}
    assert 18 <= len(flags) <= 21


@pytest.mark.parametrize("verb", VERBS)
def test_what_matters_to_a_verb_is_an_option_of_it(verb: Verbs) -> None:
    command = Commands()[str(verb.name).lower()]
    assert set(VERBS[verb].common) <= {param.name for param in command.params}


def test_every_option_is_in_the_help_of_all_and_in_that_of_its_topic(packwork: Command) -> None:
    options = {p.opts[-1] for p in Commands()["fill"].params if p.param_type_name == "option"}
    assert set(flags_in(packwork("fill --help all").output)) == options | {"--help"}
    (more,) = re.findall(r"a topic: (.*), or an option", packwork("fill --help").output)
    shown = [flags_in(packwork(f"fill --help {topic}").output) for topic in more.split(", ")]
    assert {flag for flags in shown for flag in flags} == options - {"--quiet"}


@pytest.mark.parametrize("typed", ["best_of", "best-of", "--best-of"])
def test_help_of_one_option_shows_that_alone(typed: str, packwork: Command) -> None:
    assert flags_in(packwork(f"fill --help {typed}").output) == ["--best-of"]
    assert flags_in(packwork("fill heart star -h -n 4").output) == ["--count"]


def test_what_follows_help_of_the_program_is_a_command_or_a_topic(packwork: Command) -> None:
    assert flags_in(packwork("--help palette").output) == ["--palette"]
    assert flags_in(packwork("-h --font").output) == ["--font"]
    assert packwork("--help chart").output == packwork("chart --help").output
    assert packwork("--help words type").output == packwork("words --help type").output
    wrong = packwork("--help qqqq")
    assert wrong.exit_code == 2
    assert "there is no topic 'qqqq'" in wrong.stderr


def test_the_topic_of_colours_has_background_and_halo(packwork: Command) -> None:
    for name in ("fill", "words", "photos", "chart", "pile"):
        shown = flags_in(packwork(f"{name} --help colours").output)
        assert {"--background", "--halo"} <= set(shown)
    assert "--background" in flags_in(packwork("fill --help written").output)


def test_the_bare_name_shows_the_help(packwork: Command) -> None:
    result = packwork("")
    assert "Usage: packwork" in result.output


def test_the_version_is_one_line(packwork: Command) -> None:
    result = packwork("--version")
    assert result.exit_code == 0
    assert result.stdout.startswith("packwork ")
    assert result.stdout.count("\n") == 1


HEAVY = {"numpy", "numba", "scipy", "shapely", "contourpy", "PIL"}
OURS = {"packwork.recipe", "packwork.cli.options", "packwork.cli.verbs"}
MODELS = {"pydantic", *OURS}


@pytest.mark.parametrize(
    ("line", "kept_out"),
    [
        ("--help", HEAVY | MODELS),
        ("--version", HEAVY | MODELS),
        ("", HEAVY | MODELS),
        ("fil heart", HEAVY | OURS),
        ("fill --help", HEAVY | {"packwork.cli.running"}),
    ],
)
def test_help_loads_nothing_heavy(line: str, kept_out: set[str]) -> None:
    script = (
        "import sys, packwork.cli\n"
        f"sys.argv = ['packwork', *{line.split()!r}]\n"
        "try:\n    packwork.cli.app()\n"
        "except SystemExit:\n    pass\n"
        f"sys.exit(', '.join({kept_out!r} & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name", SUMMARIES)
def test_the_summary_of_a_command_is_its_own_first_line(name: str) -> None:
    command = Commands()[name]
    assert command.name == name
    assert SUMMARIES[name] == command.help.split("\n")[0]


def test_every_command_has_a_summary() -> None:
    def commands_of(module: ModuleType) -> set[str]:
        about = (inspect.getdoc(module) or "").split("\n")[0]
        return set(re.findall(r"``(?:packwork )?(\w+)``", about))

    modules = [
        importlib.import_module(f"packwork.cli.{found.name}")
        for found in pkgutil.iter_modules(packwork.cli.__path__)
    ]
    assert set().union(*map(commands_of, modules)) == set(SUMMARIES)


@pytest.mark.parametrize("more", [[], ["--effort", "draft"]])
def test_a_plain_fill_waits_for_no_library_that_only_some_need(
    more: list[str], tmp_path: Path
) -> None:
    heavy = {"scipy.spatial", "scipy.ndimage", "scipy.optimize", "scipy.special", "scipy.linalg"}
    heavy |= {"contourpy", "pandas", "packwork.readers.fonts.face", "packwork.readers.photos"}
    heavy |= {"packwork.readers.layouts.geojson"}
    heavy |= {"packwork.start.first_fit.first_fit", "packwork.separation.discs"}
    line = ["packwork", "fill", "bear", "-n", "5", *more, "-o", str(tmp_path / "bear.svg")]
    script = (
        "import sys, packwork.cli\n"
        f"sys.argv = {line!r}\n"
        "try:\n    packwork.cli.app()\n"
        "except SystemExit as end:\n    assert not end.code\n"
        f"sys.exit(', '.join({heavy!r} & set(sys.modules)) or 0)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_help_keeps_its_brackets(packwork: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "500")
    for name, command in Commands().items():
        shown = " ".join(packwork(f"{name} --help all").output.split())
        said = [param.help for param in command.params if getattr(param, "help", None)]
        said += [line.split("[/]")[-1] for line in (command.help or "").split("\n")]
        plain = shown.replace("│ ", "").replace(" │", "")
        lost = [text for text in said if "[" in text and " ".join(text.split()) not in plain]
        assert not lost, name
    assert 'pip install "packwork[studio]"' in packwork("studio --help").output
    assert r"[#@]\w+" in packwork("words --help regexp").output


def test_names_with_brackets_are_shown_whole(packwork: Command) -> None:
    Path("[red]tile.svg").write_text(
        '<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>', encoding="utf-8"
    )
    line = "fill square [red]tile.svg -n 4 --effort draft --levels 50"
    made = packwork(line, "-o", "[bold]a.geojson")
    assert "wrote [bold]a.geojson" in made.output
    edited = packwork("edit [bold]a.geojson --turn [red]tile#1=9 -o [dim]b.svg")
    assert "wrote [dim]b.svg" in edited.output

"""The reference, written from the code: commands, recipe files, Python."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import typer.main
from pydantic import BaseModel
from pydantic.fields import FieldInfo

import packwork
from packwork.cli import app
from packwork.readers.charts import ChartOptions
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.recipe.piles import PileOptions
from packwork.recipe.rules import Pin, Rule
from packwork.writers.film.options import FilmOptions

TABLES = {
    "At the top": Recipe,
    "`[[rules]]`": Rule,
    "`pin` of a rule": Pin,
    "`[words]`": WordOptions,
    "`[chart]`": ChartOptions,
    "`[photos]`": PhotoOptions,
    "`[pile]`": PileOptions,
    "`[film]`": FilmOptions,
}
"""Parts of a recipe file, and whose fields they are."""


def commands_page() -> str:
    """Every command with its arguments and options, as ``--help`` has them."""
    group: Any = typer.main.get_command(app)
    parts = ["# Commands", "What `packwork COMMAND --help all` says."]
    parts += [_command(name, command) for name, command in group.commands.items()]
    return "\n\n".join(parts) + "\n"


def _command(name: str, command: Any) -> str:
    arguments = [p for p in command.params if p.param_type_name == "argument"]
    options = [p for p in command.params if p.param_type_name == "option" and not p.hidden]
    names = [p.metavar or p.name.upper() for p in arguments]
    usage = " ".join(["packwork", name, *names])
    help_text = re.sub(r"\[/?bold\]|\[/\]", "`", command.help or "")
    parts = [f"## `packwork {name}`", f"```text\n{usage} [OPTION...]\n```", help_text.strip()]
    if arguments:
        rows = [(f"`{said}`", p.help) for said, p in zip(names, arguments, strict=True)]
        parts.append(_table(("argument", "meaning"), rows))
    for group in dict.fromkeys(p.rich_help_panel for p in options):
        rows = [
            (
                ", ".join(f"`{flag}`" for flag in [*p.opts, *p.secondary_opts]),
                _shown(p.default),
                p.help,
            )
            for p in options
            if p.rich_help_panel == group
        ]
        parts += [f"**{group or 'In general'}**", _table(("option", "default", "meaning"), rows)]
    return "\n\n".join(parts)


def recipes_page() -> str:
    """Every key of a recipe file, from the models that check it."""
    parts = [
        "# Recipe files",
        "A recipe is TOML; `packwork fill ... --save-recipe FILE.toml` writes one, "
        "`packwork run FILE.toml` runs it. Keys that are left out have their defaults.",
    ]
    for title, model in TABLES.items():
        own = [name for name in model.model_fields if name in model.__annotations__]
        fields = {**{name: model.model_fields[name] for name in own}, **model.model_fields}
        rows = [
            (f"`{name}`", "must be given" if field.is_required() else _default(field), _said(field))
            for name, field in fields.items()
        ]
        parts += [f"## {title}", _table(("key", "default", "meaning"), rows)]
    return "\n\n".join(parts) + "\n"


def _said(field: FieldInfo) -> str:
    tables = [part for part in TABLES.values() if _holds(field.annotation, part)]
    where = [title for title, model in TABLES.items() if model in tables and title.startswith("`")]
    return (field.description or "") + (f" See {where[0]}." if where else "")


def _holds(annotation: Any, model: type[BaseModel]) -> bool:
    return model.__name__ in str(annotation).replace(".", " ").replace("'", " ").split()


def _default(field: FieldInfo) -> str:
    return _shown(field.get_default(call_default_factory=True))


def python_page() -> str:
    """Every public name of the package, its docstring laid out by Sphinx."""
    parts = ["# Python", "All that `import packwork as pw` offers."]
    for name in packwork.__all__:
        thing = getattr(packwork, name)
        kind = "autofunction" if callable(thing) else "autodata"
        kind = "autoclass" if isinstance(thing, type) else kind
        members = "   :members:\n" if kind == "autoclass" else ""
        block = f".. {kind}:: packwork.{name}\n{members}"
        parts.append(f"## `{name}`\n\n```{{eval-rst}}\n{block}```")
    return "\n\n".join(parts) + "\n"


def _shown(value: Any) -> str:
    if value is None or value == () or value is ...:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple | list):
        return ", ".join(f"`{one}`" for one in value)
    return f"`{value}`"


def _table(header: tuple[str, ...], rows: list[tuple[Any, ...]]) -> str:
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join("| " + " | ".join(_cell(cell) for cell in row) + " |" for row in lines)


def _cell(text: Any) -> str:
    """Text on one line, in which nothing counts as a table's line or a tag."""
    plain = " ".join(str(text or "").replace("``", "`").split())
    return plain.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*")


REFERENCE: Mapping[str, Callable[[], str]] = MappingProxyType(
    {"commands": commands_page, "recipes": recipes_page, "python-api": python_page}
)
"""Pages by name, and who writes them."""

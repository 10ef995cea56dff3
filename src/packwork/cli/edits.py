"""Flags of edits, made of their declarations, and the edits that texts of flags ask for."""

from __future__ import annotations

import contextlib
import inspect
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from packwork.errors import RecipeError
from packwork.live.edit_flags import Edit, Flag
from packwork.live.edits import EDITS
from packwork.options import offered
from packwork.recipe import Recipe
from packwork.writers.options import DrawingOptions

if TYPE_CHECKING:
    from packwork.live.session import Session
    from packwork.scene.item import Item

Command = Callable[..., None]


def with_edits(command: Command) -> Command:
    """Replace a command's ``**asked`` by the flags of all edits."""
    own = inspect.signature(command, eval_str=True).parameters.values()
    before = [each for each in own if each.kind is each.POSITIONAL_OR_KEYWORD]
    after = [each for each in own if each.kind is each.KEYWORD_ONLY]
    flags = [_parameter(edit, flag) for edit in EDITS for flag in edit.flags]
    changed: Any = command
    changed.__signature__ = inspect.Signature([*before, *flags, *after])
    return command


def _parameter(edit: Edit, flag: Flag) -> inspect.Parameter:
    own = inspect.signature(edit.apply).parameters.get(flag.name)
    settings: dict[str, Any] = {"metavar": flag.form, "help": flag.help or _help_of(flag.name)}
    kind: Any = str
    if flag.is_an_edit_each or flag.is_repeated:
        kind = list[str]
    elif own is not None and own.annotation == "int":
        kind, settings["min"] = int, 1
    if flag.is_an_edit_each:
        settings["help"] += " May be given several times."
    option = typer.Option(*flag.names.split(), **settings)
    return inspect.Parameter(
        flag.name,
        inspect.Parameter.KEYWORD_ONLY,
        default=None,
        annotation=Annotated[kind | None, option],
    )


def _help_of(name: str) -> str:
    known = (*offered(Recipe), *offered(DrawingOptions))
    return next(option.help for option in known if option.name == name)


def planned(session: Session, asked: Mapping[str, Any]) -> list[Callable[[], object]]:
    """Edits that flags ask for, of items that are there now, in the order of :data:`EDITS`."""
    if asked["arrange"] is not None and asked["embeddings"] is not None:
        raise RecipeError("embeddings", "and --arrange both say where items lie; leave one out")
    if asked["anchors"] and asked["embeddings"] is None:
        raise RecipeError("anchors", "are of vectors; say which: --embeddings FILE or auto")
    return [make for edit in EDITS for make in _planned(session, edit, asked)]


def _planned(
    session: Session, edit: Edit, asked: Mapping[str, Any]
) -> Iterator[Callable[[], object]]:
    first = edit.flags[0]
    if first.is_an_edit_each:
        for text in asked[first.name] or ():
            with about(first.name):
                values = _values(session, edit, first, text)
            yield partial(_make, first.name, partial(edit.apply, session, *values))
        return
    given = {flag.name: asked[flag.name] for flag in edit.flags}
    given = {name: value for name, value in given.items() if value not in (None, [])}
    given = {name: tuple(v) if isinstance(v, list) else v for name, v in given.items()}
    _, *parameters = inspect.signature(edit.apply).parameters.values()
    if parameters[0].kind is inspect.Parameter.VAR_KEYWORD:
        # An empty text leaves what holds for all as it is.
        yield partial(edit.apply, session, **{name: v for name, v in given.items() if v})
    elif first.name in given:
        values = [_of_text(session, parameters[0], given.pop(first.name)), *given.values()]
        yield partial(edit.apply, session, *values)


def _make(flag: str, make: Callable[[], object]) -> None:
    with about(flag):
        make()


def _values(session: Session, edit: Edit, flag: Flag, text: str) -> list[Any]:
    form = flag.form or ""
    shown = form.replace("[=", " or ITEM=").rstrip("]")
    shown += f" such as {flag.example}" if flag.example else ""
    _, _item, *parameters = inspect.signature(edit.apply).parameters.values()
    if form.startswith("FILE"):
        source, place = _placed(text)
        return [read_drawings([source]), *place]
    which, sign, value = _parted(session, text)
    if ("ITEM=" in form and not (sign and which and value)) or (
        sign and not (value and "=" in form)
    ):
        raise RecipeError(flag.name, f"must be {shown}, not {text[:60]!r}")
    item = session.find(which) if flag.of_many else session.one(which)
    if parameters and parameters[0].kind is inspect.Parameter.VAR_POSITIONAL:
        return [item, *(end.strip() for end in value.split(",") if end)]
    texts = value.split(",", max(len(parameters) - 1, 0)) if value and parameters else []
    least = sum(one.default is one.empty for one in parameters)
    if not least <= len(texts) <= len(parameters):
        raise RecipeError(flag.name, f"must be {shown}, not {value[:40]!r}")
    return [item, *(_of_text(session, *pair) for pair in zip(parameters, texts, strict=False))]


def _of_text(session: Session, parameter: inspect.Parameter, text: Any) -> Any:
    kind = parameter.annotation
    if kind == "float":
        return _number(text)
    if kind == "Which":
        return session.one(text)
    if kind == "Item":
        found = read_drawings([text])
        if len(found) != 1:
            raise RecipeError("item", f"takes one item, not {len(found)}")
        return found[0]
    if kind == "Container":
        from packwork.readers.container import read_container

        return read_container(text, session.canvas)
    return text


def _parted(session: Session, text: str) -> tuple[str, str, str]:
    """An item's name, ``=`` and what is asked of it; names may hold such signs too."""
    names = {item.name for item in session.document.items}
    ends = [k for k, letter in enumerate(text) if letter == "="]
    for end in (len(text), *reversed(ends)):
        which = text[:end].strip()
        if re.sub("#[0-9]+$", "", which) in names:
            return which, text[end : end + 1], text[end + 1 :].strip()
    which, sign, value = text.partition("=")
    return which.strip(), sign, value.strip()


def _placed(text: str) -> tuple[str, list[str]]:
    """File and place that ``FILE`` or ``FILE@X,Y`` names."""
    source, sign, place = text.rpartition("@")
    x, comma, y = place.partition(",")
    if sign and source and comma and not Path(text).exists():
        return source, [x, y]
    return text, []


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise RecipeError("number", f"must be a number, not {text[:40]!r}")
    return number


def read_drawings(sources: list[str]) -> Sequence[Item]:
    """Items of files, folders and built-in names."""
    from packwork.readers.items import read_items

    return read_items(sources).items


@contextlib.contextmanager
def about(flag: str) -> Iterator[None]:
    """Have errors be about the flag that people have typed."""
    try:
        yield
    except RecipeError as error:
        raise RecipeError(flag, error.problem) from error

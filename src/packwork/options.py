"""Base of all options: frozen values that refuse unknown keys and say what they mean.

A field is the only place of an option: name, type, bounds, default, docstring and, where it is
offered otherwise than its neighbours, a :class:`packwork.options.Offer`. Command lines, signatures
in Python, the reference and forms are made of :func:`offered`.

An offer is heading, verbs and flags; and type, bounds and default for faces.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import Flag, StrEnum, auto
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, ClassVar, Literal, TypeAlias, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict
from pydantic.fields import FieldInfo


class Group(StrEnum):
    """Headings under which options stand in help and forms, in their order."""

    WRITTEN = "What is written"
    PRINTED = "What a print shop needs"
    MARKS = "What marks say"
    PLACED = "What is placed"
    ORDER = "What lies where"
    COLOURS = "Which colours there are"
    TYPE = "How words are set"
    EDGES = "What becomes of edges"
    READ = "How files are read"
    TABLES = "How tables are written"
    VOIDS = "What fills the voids"
    SOLVED = "How it is solved"
    FILM = "What is filmed"

    @property
    def topic(self) -> str:
        """Word that is typed after ``--help`` for its options.

        Examples
        --------
        >>> Group.ORDER.topic
        'order'
        """
        return self.name.lower()


class Verbs(Flag):
    """Commands that run something, as they are called in Python too, and sets of them."""

    FILL = auto()
    WORDS = auto()
    PHOTOS = auto()
    CHART = auto()
    PILE = auto()
    COLLAGES = FILL | WORDS | PHOTOS
    """Those that size items freely and fill voids."""
    LEVELLED = COLLAGES | CHART
    """Those that are solved by levels."""
    EVERY = LEVELLED | PILE


@dataclass(frozen=True, kw_only=True)
class Offer:
    """Offer of an option on the command line; type, default and bounds stand in its field.

    Parameters
    ----------
    group
        Heading that it stands under; None for that of its model, if it has one.
    also
        Heading whose topic of the help lists it too.
    verbs
        Commands that have it; None for those of its model. An empty set: it is an argument, a
        table of options, or for recipe files and Python only.
    flags
        Names on a command line, as ``-n --count`` or ``--trim/--no-trim``; None for its own name.
    metavar
        What stands for its value in help; None for the name of its type.
    typed
        Type on a command line, ``str`` or ``list[str]``; None derives it from the field's type.
    help
        Description on a command line; None for the field's docstring.
    after
        Name of the option that it is listed after, if the model has that; None keeps the order
        of the fields.
    is_flag
        Whether command lines have it; if not, recipe files and Python alone do.
    takes
        Type that Python takes, where a validator makes the field's of more than that; None
        derives it from the field's.
    """

    group: Group | None = None
    also: Group | None = None
    verbs: Verbs | None = None
    flags: str | None = None
    metavar: str | None = None
    typed: Any = None
    help: str | None = None
    after: str | None = None
    is_flag: bool = True
    takes: Any = None


NOT_OFFERED = Offer(verbs=Verbs(0))
"""Marks a field that is no option of commands and forms."""


@dataclass(frozen=True, kw_only=True)
class Offered:
    """An option as command lines, Python's signatures and forms use it.

    Parameters
    ----------
    offer
        Where and how it is offered; group and verbs of its model are filled in.
    """

    name: str
    offer: Offer
    field: FieldInfo

    @property
    def verbs(self) -> Verbs:
        """Commands that have it."""
        return Verbs.EVERY if self.offer.verbs is None else self.offer.verbs

    @property
    def flag(self) -> str:
        """Long name on a command line.

        Examples
        --------
        >>> from packwork.options import offered
        >>> from packwork.recipe import Recipe
        >>> asked = {option.name: option for option in offered(Recipe)}
        >>> asked["count"].flag, asked["losses"].flag, asked["keep_page"].flag
        ('--count', '--loss', '--keep-page')
        """
        plain = f"--{self.name.replace('_', '-')}"
        return plain if self.offer.flags is None else self.offer.flags.split()[-1].split("/")[0]

    @property
    def help(self) -> str:
        """Description, of one or more sentences."""
        return self.offer.help or self.field.description or ""

    @property
    def default(self) -> Any:
        """Value if none is given."""
        return self.field.get_default(call_default_factory=True)

    @property
    def forms(self) -> tuple[Any, ...]:
        """Alternatives of the type, without annotations and None."""
        plain = _plain(self.field.annotation)
        forms = get_args(plain) if _is_union(plain) else (plain,)
        return tuple(form for form in forms if form is not NoneType)

    @property
    def choices(self) -> tuple[Any, ...]:
        """Values of its ``Literal`` types; empty if it has none."""
        named = (form for form in self.forms if get_origin(form) is Literal)
        return tuple(choice for form in named for choice in get_args(form))

    @property
    def checks(self) -> tuple[Any, ...]:
        """Annotations of the field and of the alternatives of its type."""
        return (*self.field.metadata, *_annotations(self.field.annotation))

    @property
    def bounds(self) -> dict[str, float]:
        """Range of a number, by pydantic's names: ``ge`` or ``gt`` below, ``le`` or ``lt`` above.

        Examples
        --------
        >>> from packwork.options import offered
        >>> from packwork.recipe import Recipe
        >>> asked = {option.name: option for option in offered(Recipe)}
        >>> asked["size_ratio"].bounds, asked["time"].bounds, asked["effort"].choices
        ({'ge': 1, 'le': 100}, {'gt': 0, 'le': 86400.0}, ('draft', 'normal', 'best'))
        """
        keys = ("ge", "gt", "le", "lt")
        return {key: getattr(one, key) for key in keys for one in self.checks if hasattr(one, key)}


def _is_union(annotation: Any) -> bool:
    return get_origin(annotation) in (Union, UnionType)


def _plain(annotation: Any) -> Any:
    """The type without ``Annotated``, in unions too."""
    if get_origin(annotation) is Annotated:
        return _plain(get_args(annotation)[0])
    if _is_union(annotation):
        return Union[tuple(_plain(part) for part in get_args(annotation))]  # noqa: UP007
    return annotation


def _annotations(annotation: Any) -> Iterator[Any]:
    """Annotations of a type and of the alternatives of a union."""
    if get_origin(annotation) is Annotated:
        plain, *said = get_args(annotation)
        for one in said:
            yield from one.metadata if isinstance(one, FieldInfo) else (one,)
        yield from _annotations(plain)
    if _is_union(annotation):
        for part in get_args(annotation):
            yield from _annotations(part)


SizeMode: TypeAlias = Literal["free", "shared", "fixed"]
"""How sizes of items may vary: each within bounds, all by one factor, or not at all."""


class Options(BaseModel):
    """Options whose descriptions are the docstrings of their fields.

    Pydantic would read the docstrings too, but by tokenising each class in Python; and it would
    build at once what checks each model, also where only the recipe, which holds them all, is
    made. Without sources there are no descriptions.

    Examples
    --------
    >>> from packwork.recipe.piles import PileOptions
    >>> PileOptions.model_fields["compact"].description
    'Report how tight the pile is: shares of its hull, its smallest circle and its box.'
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    offers: ClassVar[Offer] = NOT_OFFERED
    """Group and verbs of fields that have no offer of their own."""

    @classmethod
    def __pydantic_init_subclass__(cls, **settings: Any) -> None:
        """Describe the fields of a new class of options."""
        super().__pydantic_init_subclass__(**settings)
        for name, text in _docstrings(cls.__module__).get(cls.__qualname__, {}).items():
            if name in cls.model_fields:
                cls.model_fields[name].description = text


@cache
def offered(model: type[Options]) -> tuple[Offered, ...]:
    """Options of a model in the order of help: its own fields, then those of its base classes.

    Examples
    --------
    >>> from packwork.recipe.piles import PileOptions
    >>> [option.name for option in offered(PileOptions)]
    ['open', 'size', 'emit', 'release', 'compact']
    """
    classes = [c for c in model.__mro__ if issubclass(c, Options) and c is not Options]
    found = {
        name: _offered(name, model.model_fields[name], owner.offers)
        for owner in classes
        for name in vars(owner).get("__annotations__", {})
        if name in model.model_fields
    }
    listed: list[Offered] = []
    for first in (option for option in found.values() if option.offer.after not in found):
        listed += _with_followers(first, found)
    return tuple(option for option in listed if option.verbs)


def _offered(name: str, field: FieldInfo, common: Offer) -> Offered:
    own = next((said for said in field.metadata if isinstance(said, Offer)), common)
    return Offered(
        name=name,
        field=field,
        offer=replace(
            own,
            group=common.group if own.group is None else own.group,
            verbs=common.verbs if own.verbs is None else own.verbs,
        ),
    )


def _with_followers(option: Offered, found: Mapping[str, Offered]) -> Iterator[Offered]:
    yield option
    for other in found.values():
        if other.offer.after == option.name:
            yield from _with_followers(other, found)


@cache
def _docstrings(module: str) -> dict[str, dict[str, str]]:
    """Docstrings of annotated names, by class and name, of a module."""
    loaded = vars(sys.modules[module])
    source = "".join(linecache.getlines(loaded.get("__file__") or "", loaded))
    classes = (node for node in ast.parse(source).body if isinstance(node, ast.ClassDef))
    return {node.name: dict(_described(node)) for node in classes}


def _described(body: ast.ClassDef) -> list[tuple[str, str]]:
    return [
        (field.target.id, inspect.cleandoc(below.value.value))
        for field, below in zip(body.body, body.body[1:], strict=False)
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant)
        if isinstance(below.value.value, str)
    ]


_WHOLE = re.compile(r"[+-]?[0-9]{1,12}")


def number_or_auto(value: object) -> object:
    """Whole number of a text, or ``auto``; what is no text stays as it is.

    Examples
    --------
    >>> number_or_auto(" 12"), number_or_auto("auto"), number_or_auto(None)
    (12, 'auto', None)
    """
    if not isinstance(value, str) or value == "auto":
        return value
    if not _WHOLE.fullmatch(value.strip()):
        raise ValueError(f"must be a whole number or auto, not {value[:60]!r}")
    return int(value)

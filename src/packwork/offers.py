"""Offers of options: heading, verbs, flags; and type, bounds and default for faces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Flag, StrEnum, auto
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

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
    def type(self) -> Any:
        """Type of the value, without annotations."""
        return _plain(self.field.annotation)

    @property
    def forms(self) -> tuple[Any, ...]:
        """Alternatives of the type, without None."""
        forms = get_args(self.type) if _is_union(self.type) else (self.type,)
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

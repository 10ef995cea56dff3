"""Where options are offered: under which heading, by which verbs, and how faces see them."""

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
    SHOWN = "What marks say"
    PLACED = "What is placed"
    TYPE = "How words are set"
    EDGES = "What becomes of edges"
    TABLES = "How tables are written"
    VOIDS = "What fills the voids"
    SOLVED = "How it is solved"
    FILMED = "What is filmed"


class Verbs(Flag):
    """What may be asked for, and sets of that."""

    FILL = auto()
    WORDS = auto()
    PHOTOS = auto()
    CHART = auto()
    PILE = auto()
    COLLAGES = FILL | WORDS | PHOTOS
    """All in which sizes and voids are left to the run."""
    LEVELLED = COLLAGES | CHART
    """All that are solved by levels."""
    EVERY = LEVELLED | PILE


@dataclass(frozen=True, kw_only=True)
class Offer:
    """Where and how an option is offered, beyond what its field says anyway.

    Parameters
    ----------
    group
        Heading that it stands under; None for that of its class, or none.
    verbs
        Which offer it; None for those of its class. Of none: it is an argument, part of another
        option or for files and Python only.
    flags
        Names on a command line, as ``-n --count`` or ``--trim/--no-trim``; None for its own name.
    metavar
        What stands for its value in help; None for the name of its type.
    typed
        Type of what is typed, where the field's own one does not tell: a text or several.
    help
        What it does, where that is other than in a file; None for the field's docstring.
    after
        Name of the option that it is listed after, where the model has that; None: as fields stand.
    """

    group: Group | None = None
    verbs: Verbs | None = None
    flags: str | None = None
    metavar: str | None = None
    typed: Any = None
    help: str | None = None
    after: str | None = None


NOT_OFFERED = Offer(verbs=Verbs(0))
"""Of a field that is no option of commands and forms."""


@dataclass(frozen=True, kw_only=True)
class Offered:
    """An option as faces see it.

    Parameters
    ----------
    name
        Of the field.
    offer
        Where and how it is offered; what its class says is filled in.
    field
        Type, default and docstring.
    """

    name: str
    offer: Offer
    field: FieldInfo

    @property
    def verbs(self) -> Verbs:
        """Which verbs offer it."""
        return Verbs.EVERY if self.offer.verbs is None else self.offer.verbs

    @property
    def flag(self) -> str:
        """Its long name on a command line.

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
        """What it does."""
        return self.offer.help or self.field.description or ""

    @property
    def default(self) -> Any:
        """What counts where nobody says anything."""
        return self.field.get_default(call_default_factory=True)

    @property
    def type(self) -> Any:
        """Type of its value, without what checks it."""
        return _plain(self.field.annotation)

    @property
    def forms(self) -> tuple[Any, ...]:
        """The types that its value may have, but for None."""
        forms = get_args(self.type) if _is_union(self.type) else (self.type,)
        return tuple(form for form in forms if form is not NoneType)

    @property
    def choices(self) -> tuple[Any, ...]:
        """The values that are known by name; none if there are no such."""
        named = (form for form in self.forms if get_origin(form) is Literal)
        return tuple(choice for form in named for choice in get_args(form))

    @property
    def checks(self) -> tuple[Any, ...]:
        """What reads and checks its value, as the field is annotated."""
        return (*self.field.metadata, *_annotations(self.field.annotation))

    @property
    def bounds(self) -> dict[str, float]:
        """Of a number: at least ``ge``, more than ``gt``, at most ``le``, less than ``lt``.

        Examples
        --------
        >>> from packwork.options import offered
        >>> from packwork.recipe import Recipe
        >>> asked = {option.name: option for option in offered(Recipe)}
        >>> asked["size_ratio"].bounds, asked["time"].bounds, asked["sizes"].choices
        ({'ge': 1, 'le': 100}, {'gt': 0, 'le': 86400.0}, ('free', 'shared', 'fixed'))
        """
        keys = ("ge", "gt", "le", "lt")
        return {key: getattr(one, key) for key in keys for one in self.checks if hasattr(one, key)}


def _is_union(annotation: Any) -> bool:
    return get_origin(annotation) in (Union, UnionType)


def _plain(annotation: Any) -> Any:
    """A type without what it is annotated with, in unions too."""
    if get_origin(annotation) is Annotated:
        return _plain(get_args(annotation)[0])
    if _is_union(annotation):
        return Union[tuple(_plain(part) for part in get_args(annotation))]  # noqa: UP007
    return annotation


def _annotations(annotation: Any) -> Iterator[Any]:
    """What a type and the parts of a union are annotated with."""
    if get_origin(annotation) is Annotated:
        plain, *said = get_args(annotation)
        for one in said:
            yield from one.metadata if isinstance(one, FieldInfo) else (one,)
        yield from _annotations(plain)
    if _is_union(annotation):
        for part in get_args(annotation):
            yield from _annotations(part)

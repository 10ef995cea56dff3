"""Declarations of edits: functions of a session, and the flags of ``packwork edit`` for each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

_Function = TypeVar("_Function", bound=Callable[..., Any])


@dataclass(frozen=True)
class Flag:
    """Flag of ``packwork edit``.

    Parameters
    ----------
    form
        Of its text; None for one word. Where it begins with ``ITEM`` or ``FILE``, each text is an
        edit of its own: ``ITEM=`` and the edit's other parameters, with commas between.
    help
        Empty for that of the option of a run that is called so.
    example
        Of the text, where its form alone does not tell.
    of_many
        Whether it is an edit of all items of a name.
    is_repeated
        Whether several texts go, as one value.
    """

    names: str
    form: str | None = None
    help: str = ""
    example: str = ""
    of_many: bool = False
    is_repeated: bool = False

    @property
    def name(self) -> str:
        """The long one of its names, without strokes."""
        return self.names.rpartition("--")[2]

    @property
    def is_an_edit_each(self) -> bool:
        """Whether each text is an edit of its own."""
        return self.form is not None and self.form.startswith(("ITEM", "FILE"))


@dataclass(frozen=True)
class Edit:
    """Edit with flags: one for each parameter, or one for an item and all that is asked of it."""

    apply: Callable[..., Any]
    flags: tuple[Flag, ...]


def declared_in(edits: list[Edit]) -> Callable[..., Callable[[_Function], _Function]]:
    """Decorator of edits, given their flags, that adds them to a list."""

    def edit(*flags: Flag) -> Callable[[_Function], _Function]:

        def declared(function: _Function) -> _Function:
            edits.append(Edit(function, flags))
            return function

        return declared

    return edit

"""The error tree: one root, one line per message.

A message says what is wrong, what was met and what would do. Errors are also what Python's own
are: of files an ``OSError``, of options and shapes a ``ValueError``. They can be sent from one
process to another.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


class PackworkError(Exception):
    """Root of every error this package raises on purpose."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled and copied by its contents, whatever it was made of."""
        return _again, (type(self), self.args, self.__dict__)


def _again(kind: type[PackworkError], args: tuple[Any, ...], held: Mapping[str, Any]) -> Any:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(held)
    return error


class _AboutAFileError(PackworkError, OSError):
    """A file could not be read or written; ``errno`` is None, for no call of the system failed.

    Parameters
    ----------
    file
        The file (or built-in name) as the user gave it.
    problem
        What is wrong, what was met, what would do.
    """

    def __init__(self, file: str | Path, problem: str) -> None:
        self.file = str(file)
        self.problem = problem
        super().__init__(f"{self.file}: {problem}")


class ReadError(_AboutAFileError):
    """A file could not be used as what it was given for."""


class RowsLostError(ReadError):
    """Rows of a table that hold data, but none that could be used: the others were read."""


class WriteError(_AboutAFileError):
    """An output could not be written; nothing was left half-written."""


class RecipeError(PackworkError, ValueError):
    """An option has no meaning as it was given.

    Parameters
    ----------
    key
        The option's name, as in the recipe (``count``, ``sizes`` ...).
    problem
        What is wrong, what was met, what would do.
    """

    def __init__(self, key: str, problem: str) -> None:
        self.key = key
        self.problem = problem
        super().__init__(f"{key}: {problem}")


class ShapeError(PackworkError, ValueError):
    """An array or a geometry does not have the form that is needed."""


class UnresolvedError(ShapeError):
    """Outlines so close that no set operation tells them apart, on the coarsest grid neither."""

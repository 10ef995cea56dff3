"""The error tree: one root, one line per message.

A message says what is wrong, what was met and what would do.
"""

from __future__ import annotations

from pathlib import Path


class PackworkError(Exception):
    """Root of every error this package raises on purpose."""


class ReadError(PackworkError):
    """A file could not be used as what it was given for.

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


class RowsLostError(ReadError):
    """Rows of a table that hold data, but none that could be used: the others were read."""


class WriteError(PackworkError):
    """An output could not be written; nothing was left half-written."""

    def __init__(self, file: str | Path, problem: str) -> None:
        self.file = str(file)
        self.problem = problem
        super().__init__(f"{self.file}: {problem}")


class RecipeError(PackworkError):
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

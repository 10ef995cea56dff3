"""Files of sessions that begin with layouts in Python."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from packwork.errors import RecipeError

if TYPE_CHECKING:
    from packwork.api.session import Session


def keep_session(session: Session, path: str | Path, options: Collection[str]) -> None:
    """Write a session's file, which has no ways of being drawn.

    Raises
    ------
    RecipeError
        If any was given.
    WriteError
        If it cannot be written.
    """
    if options:
        names = ", ".join(options)
        raise RecipeError("path", f"{path}: a session's file is no drawing; leave out {names}")
    session.save(path)

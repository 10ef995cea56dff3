"""Files of layouts in Python: whatever holds one is read, and sessions are begun in files."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from packwork.errors import RecipeError
from packwork.readers.layouts.read import is_session, read_written
from packwork.scene import layout as scene

if TYPE_CHECKING:
    from packwork.api.session import Session


def read_saved(path: str | Path) -> scene.Layout:
    """Layout of a file of any kind that holds one, a session's among them.

    Raises
    ------
    ReadError
        If it cannot be read.
    """
    if not isinstance(path, str | Path) or not is_session(path):
        return read_written(path)
    # All of a session is loaded only where there is one.
    from packwork.live.file.disk import layout_in

    return layout_in(path)


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

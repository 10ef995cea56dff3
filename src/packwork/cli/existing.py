"""Files that are there before a run."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from packwork.errors import WriteError


def check_new(paths: Iterable[Path]) -> None:
    """Refuse files that are there already.

    Raises
    ------
    WriteError
        About the first.
    """
    for path in paths:
        if os.path.lexists(path):
            raise WriteError(path, "is there already, and --no-clobber keeps it; use another name")

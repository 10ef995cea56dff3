"""Packages that only some ways of showing need: imported when used, named when missing."""

from __future__ import annotations

import importlib
from typing import Any

from packwork.errors import PackworkError


def found(module: str, otherwise: str) -> Any:
    """Module that is an extra of ours.

    ``otherwise``: what does without it.

    Raises ``PackworkError`` if it is not installed, saying what to install.

    >>> found("no_such_package", "save a picture")
    Traceback (most recent call last):
        ...
    packwork.errors.PackworkError: this needs no_such_package, which is not installed; install it:
    pip install no_such_package, or save a picture
    """
    package = module.partition(".")[0]
    try:
        importlib.import_module(package)
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise PackworkError(
            f"this needs {package}, which is not installed; install it: "
            f"pip install {package}, or {otherwise}"
        ) from None

"""PyTorch itself, where it is installed."""

from __future__ import annotations

import importlib
from typing import Any

from packwork.errors import PackworkError


def found_torch() -> Any:
    """Module ``torch``.

    Raises
    ------
    PackworkError
        If it is not installed, saying what to install.

    Examples
    --------
    >>> found_torch().__name__
    'torch'
    """
    try:
        return importlib.import_module("torch")
    except ModuleNotFoundError as error:
        if error.name != "torch":
            raise
        raise PackworkError(
            "this needs PyTorch, which is not installed; install it: pip install torch"
        ) from None

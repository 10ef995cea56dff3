"""Errors of drawings that cannot be used, raised where the file's name is not known."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from shapely.errors import GEOSException

from packwork.errors import ReadError, ShapeError

_reading: ContextVar[str] = ContextVar("reading", default="")
"""The file whose content is being read, for notices about it."""


class UnfitError(Exception):
    """A fault of the content being read; the reader adds the file's name."""


class TooRichError(UnfitError):
    """A drawing that takes too long to be computed from shapes; its picture may still be traced.

    Parameters
    ----------
    what
        What is too much of it, as in "has 9,000 shapes".
    """

    def __init__(self, what: str) -> None:
        super().__init__(f"{what}; simplify it")
        self.what = what


@contextmanager
def naming(file: str) -> Iterator[None]:
    """Turn refusals inside the block into a ``ReadError`` about ``file``.

    Raises
    ------
    ReadError
        For a refusal, for a geometry without area and for one that GEOS gives up on.

    Examples
    --------
    >>> with naming("a.svg"):
    ...     raise UnfitError("is empty")
    Traceback (most recent call last):
    packwork.errors.ReadError: a.svg: is empty
    """
    before = _reading.set(file)
    try:
        yield
    except UnfitError as refusal:
        raise ReadError(file, str(refusal)) from None
    except ShapeError as error:
        raise ReadError(file, f"holds a shape that cannot be used: {error}") from error
    except GEOSException as error:
        raise ReadError(file, f"holds a shape that cannot be resolved: {error}") from error
    finally:
        _reading.reset(before)


def notice(text: str) -> None:
    """Log that something of the file being read was left out, so that nothing is silent."""
    logging.getLogger("packwork").warning("%s: %s", _reading.get() or "drawing", text)

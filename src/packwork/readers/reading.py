"""The file that is being read: its name in errors and notices, and its budget of counted work.

Both are one value of a context, since whatever reads a part of a file may refuse it, tell of it or
pay for it, down to the parser of path data. Work is counted, never timed: an account in nanoseconds
of estimate, the same on every machine and under any load. What would take longer than its account
holds is not begun.

Files are read up to a stated bound.
"""

from __future__ import annotations

import contextlib
import logging
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, TypeAlias

from shapely.errors import GEOSException

from packwork.errors import PackworkError, ReadError, ShapeError
from packwork.sources import MEMORY, here_of, note_input, stored


class UnfitError(Exception):
    """A fault of the content being read; the reader adds the file's name."""


class TooRichError(UnfitError):
    """A drawing that takes too long to be computed from shapes; its picture may still be traced.

    ``what`` says what is too much of it, as in "has 9,000 shapes".
    """

    def __init__(self, what: str) -> None:
        super().__init__(f"{what}; simplify it")
        self.what = what


Account: TypeAlias = Literal["shapes", "pictures"]

SHAPES_NS = 2e9
"""For styles, shapes and outlines of one file. Larger lets hostile files be slow, smaller
traces rich drawings from their pictures. Chosen: with ``PICTURES_NS`` about five seconds."""

PICTURES_NS = SHAPES_NS
"""For all renderings of one file. Larger lets hostile files be slow, smaller makes the
pictures of rich drawings coarse, or refuses them."""


@dataclass
class Budget:
    """Counted work that is left for one file.

    >>> budget = Budget({"shapes": 5.0, "pictures": 5.0})
    >>> budget.spend(4.0, "has edges", "shapes"); budget.left("shapes")
    1.0
    >>> budget.spend(4.0, "has 9 edges", "shapes")
    Traceback (most recent call last):
    packwork.readers.reading.TooRichError: has 9 edges; simplify it
    """

    accounts: dict[Account, float] = field(
        default_factory=lambda: {"shapes": SHAPES_NS, "pictures": PICTURES_NS}
    )

    def left(self, account: Account) -> float:
        """Nanoseconds that are left, 0 at least."""
        return max(0.0, self.accounts[account])

    def spend(self, nanoseconds: float, what: str, account: Account) -> None:
        """Take work off an account before it is done; refuse it if that is more than is left."""
        if nanoseconds > self.accounts[account]:
            raise TooRichError(what)
        self.accounts[account] -= nanoseconds


@dataclass(frozen=True)
class _FileContext:
    """Name of the file being read, empty if not known; without a budget nothing is counted."""

    file: str = ""
    budget: Budget | None = None


_NO_FILE = _FileContext()
_current: ContextVar[_FileContext] = ContextVar("reading", default=_NO_FILE)


@contextmanager
def reading_file(file: str) -> Iterator[None]:
    """Turn refusals inside the block into a ``ReadError`` about ``file``.

    Those are refusals of ours, geometries without area and what GEOS gives up on.

    >>> with reading_file("a.svg"):
    ...     raise UnfitError("is empty")
    Traceback (most recent call last):
    packwork.errors.ReadError: a.svg: is empty
    """
    before = _current.set(replace(_current.get(), file=file))
    try:
        yield
    except UnfitError as refusal:
        raise ReadError(file, str(refusal)) from None
    except ShapeError as error:
        raise ReadError(file, f"holds a shape that cannot be used: {error}") from error
    except GEOSException as error:
        raise ReadError(file, f"holds a shape that cannot be resolved: {error}") from error
    finally:
        _current.reset(before)


def notice(text: str) -> None:
    """Log that something of the file being read was left out, so that nothing is silent."""
    logging.getLogger("packwork").warning("%s: %s", _current.get().file or "drawing", text)


@contextmanager
def one_budget(largesse: float = 1.0) -> Iterator[Budget]:
    """Everything inside the block shares one budget, also with a block around it.

    ``largesse`` is the factor by which a new budget's accounts are larger than those of an item.
    """
    outer = _current.get()
    if outer.budget is not None:
        yield outer.budget
        return
    budget = Budget({"shapes": largesse * SHAPES_NS, "pictures": largesse * PICTURES_NS})
    before = _current.set(replace(outer, budget=budget))
    try:
        yield budget
    finally:
        _current.reset(before)


def spend(nanoseconds: float, what: str, account: Account = "shapes") -> None:
    """Take work off the budget of the file being read, before it is done.

    ``TooRichError`` says of what there is too much.

    >>> with one_budget():
    ...     spend(1e12, "has far too much of it")
    Traceback (most recent call last):
    packwork.readers.reading.TooRichError: has far too much of it; simplify it
    """
    budget = _current.get().budget
    if budget is not None and nanoseconds > 0:
        budget.spend(nanoseconds, what, account)


def left(account: Account) -> float:
    """Nanoseconds left of an account; all of it where nothing is counted."""
    return (_current.get().budget or Budget()).left(account)


def read_bytes(path: str | Path, most: int) -> bytes:
    """Content of a file of at most ``most`` bytes."""
    value = stored(str(path))
    data = value if isinstance(value, bytes) else _read_file(path, most)
    if len(data) > most:
        raise _too_large(path, most)
    return data


def _too_large(path: str | Path, most: int) -> ReadError:
    return ReadError(path, f"is larger than {most / 1e6:g} MB, the most for such a file")


def _read_file(path: str | Path, most: int) -> bytes:
    """Content of a file, one byte more than ``most`` if it grows beyond that meanwhile."""
    if str(path).startswith(MEMORY):
        raise ReadError(
            path, "was in the memory of the program that wrote this recipe; give a file"
        )
    with _telling(path):
        here = here_of(path)
        _check_file(path, most)
        note_input(here, str(path))
        with here.open("rb") as file:
            return file.read(most + 1)


def read_lines(path: str | Path, most: int, longest: int) -> Iterator[str]:
    """Lines of a UTF-8 file of at most ``most`` bytes that this program goes on writing.

    What is no UTF-8 is replaced by a mark of that; ``longest`` bounds the characters of a line.
    """
    with _telling(path):
        _check_file(path, most)
        with Path(path).open(encoding="utf-8", errors="replace", newline="\n") as file:
            while line := file.readline(longest + 1):
                if len(line) > longest:
                    raise ReadError(path, f"has a line of more than {longest:,} characters")
                yield line


def _check_file(path: str | Path, most: int) -> None:
    # Opening a pipe waits for its writer, and a device never ends.
    status = here_of(path).stat()
    mode = status.st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise ReadError(path, "is a pipe or a device; give a file on disk")
    if stat.S_ISREG(mode) and status.st_size > most:
        raise _too_large(path, most)


@contextlib.contextmanager
def _telling(path: str | Path) -> Iterator[None]:
    """Have what the system says of a file be told as ours."""
    try:
        yield
    except PackworkError:
        raise
    except FileNotFoundError:
        raise ReadError(path, "there is no such file") from None
    except IsADirectoryError:
        raise ReadError(path, "is a folder where a file was expected") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise ReadError(path, f"cannot be opened: {reason}") from None


def read_text(path: str | Path, most: int) -> str:
    """Text of a UTF-8 file of at most ``most`` bytes, with or without a byte order mark."""
    return file_text(read_bytes(path, most), path)


def file_text(data: bytes, path: str | Path) -> str:
    """The same of a file that was read."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ReadError(path, "is not text in UTF-8; save it with that encoding") from None


def exists(path: str | Path) -> bool:
    """Whether there is a file or a folder of that name, or a value in memory.

    Text that can be no name has none.

    Examples
    --------
    >>> exists("no such file.svg"), exists("a" * 10_000)
    (False, False)
    """
    if stored(str(path)) is not None:
        return True
    try:
        return here_of(path).exists()
    except (OSError, ValueError):
        return False


def is_folder(path: str | Path) -> bool:
    """Whether a path is that of a folder; text that can be no name is none.

    Examples
    --------
    >>> is_folder("."), is_folder("a" * 10_000)
    (True, False)
    """
    try:
        return here_of(path).is_dir()
    except (OSError, ValueError):
        return False


def stem(path: str | Path) -> str:
    """Name without folder and ending: what people call the item.

    Examples
    --------
    >>> stem("icons/bear.svg")
    'bear'
    """
    return Path(path).stem.removeprefix(MEMORY)

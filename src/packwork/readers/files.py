"""Bytes from disk, never more than a stated bound."""

from __future__ import annotations

import contextlib
import stat
from collections.abc import Iterator
from pathlib import Path

from packwork.errors import PackworkError, ReadError
from packwork.sources import MEMORY, here_of, note_input, stored


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
    try:
        return read_bytes(path, most).decode("utf-8-sig")
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

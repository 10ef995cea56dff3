"""Record beside the files of a row: its inputs, so that it is not made twice."""

from __future__ import annotations

import glob
import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from packwork.installed import installed_version
from packwork.recipe_paths import named_files

ENDING = ".batch.json"
"""Of the record, beside the first of a row's files."""

MOST_BYTES = 4_000_000
"""Of a record. Chosen."""


def record_path(outputs: Iterable[Path]) -> Path:
    """Path of the record of a row.

    Examples
    --------
    >>> record_path([Path("out/Ann.svg"), Path("out/Ann.pdf")]).name
    'Ann.batch.json'
    """
    first = next(iter(outputs))
    return first.with_name(first.stem + ENDING)


def relative(outputs: Iterable[Path]) -> list[str]:
    """Files of a row as seen from the folder of its record.

    Examples
    --------
    >>> relative([Path("svg/Ann.svg"), Path("pdf/Ann.pdf")])
    ['Ann.svg', '../pdf/Ann.pdf']
    """
    outputs = list(outputs)
    home = outputs[0].parent
    return [Path(os.path.relpath(path, home)).as_posix() for path in outputs]


def key_of(options: Mapping[str, Any], outputs: Iterable[Path], drawing: Mapping[str, Any]) -> str:
    """SHA-256 of all that is asked for, and of the version that makes it."""
    asked = {
        "packwork": installed_version(),
        "options": options,
        "outputs": relative(outputs),
        "drawing": drawing,
    }
    return hashlib.sha256(json.dumps(asked, sort_keys=True, default=str).encode()).hexdigest()


def inputs_of(options: Mapping[str, Any], read: Iterable[str]) -> dict[str, str]:
    """Digests of all files that were read, and of what stands in the folders that are named."""
    named = [name for name in named_files(options) if name]
    listed = [name for name in named if glob.has_magic(name) or Path(name).is_dir()]
    return {name: digest_of(name) for name in sorted({*read, *listed})}


def digest_of(name: str | Path) -> str:
    """SHA-256 of a file's content, or of what a folder or a pattern lists; empty for nothing."""
    if glob.has_magic(str(name)):
        return _of_names(glob.glob(str(name), recursive=True))  # noqa: PTH207
    try:
        status = Path(name).stat()
        return _digest(str(name), status.st_mtime_ns, status.st_size, status.st_ino)
    except OSError:
        return ""


@lru_cache(maxsize=65_536)
def _digest(name: str, *_: int) -> str:
    # A file that stands in each row is read once.
    path = Path(name)
    if path.is_dir():
        return _of_names(each.name for each in path.iterdir())
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _of_names(names: Iterable[str]) -> str:
    return hashlib.sha256(os.fsencode("\n".join(sorted(names)))).hexdigest()


def is_done(key: str, outputs: Iterable[Path]) -> dict[str, Any] | None:
    """The record of a row whose files are all there and as they would be made; None else."""
    outputs = tuple(outputs)
    path = record_path(outputs)
    try:
        if path.stat().st_size > MOST_BYTES:
            return None
        found = json.loads(path.read_bytes())
        if found["key"] != key:
            return None
        told = {path.parent / name: digest for name, digest in found["outputs"].items()}
        is_whole = all(digest_of(path) == digest for path, digest in told.items())
        is_same = all(digest_of(name) == digest for name, digest in found["inputs"].items())
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return found if is_whole and is_same and len(told) == len(outputs) else None

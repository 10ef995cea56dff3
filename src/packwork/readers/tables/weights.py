"""Tables of weights: which share of the area each item asks for."""

from __future__ import annotations

import logging
from pathlib import Path

from packwork.errors import ReadError
from packwork.phrasing import enumerated
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import MOST_NAMED, read_pairs

MAX_TABLE_BYTES = 5_000_000
"""Size of a table. Chosen."""

_LOG = logging.getLogger("packwork")


def read_weights(path: str | Path, asked: TableFormat | None = None) -> dict[str, float]:
    r"""Weights by item name, in the file's order.

    The file has two columns, ``name,weight``; a line that names them may stand on top.

    Parameters
    ----------
    asked
        How it is written, where that was said.

    Raises
    ------
    ReadError
        With the line's number, if a weight is not a positive finite number, a name is
        missing or stands there with two weights.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "weights.csv")
    ...     _ = file.write_text("name,weight\nbear,2\nfox,0.5\n")
    ...     read_weights(file)
    {'bear': 2.0, 'fox': 0.5}
    """
    table = read_pairs(str(path), MAX_TABLE_BYTES, asked or TableFormat())
    weights: dict[str, float] = {}
    twice = []
    for pair in table.rows:
        if not pair.is_sound:
            raise ReadError(path, f"{pair.where}: {pair.wanted('name')}")
        if pair.name in weights:
            twice.append(f"{pair.name[:40]!r} ({pair.where})")
        known = weights.setdefault(pair.name, pair.number)
        if known != pair.number:
            raise ReadError(
                path,
                f"{pair.where}: {pair.name!r} stands there twice, as {known:g} and as "
                f"{pair.number:g}; give it one weight",
            )
    if not weights:
        raise ReadError(path, "holds no weights; give lines such as bear,2")
    repeated = f"says the same again of {enumerated(twice, MOST_NAMED)}; that counts once"
    for notice in (*table.notices, *([repeated] if twice else [])):
        _LOG.warning("%s: %s", path, notice)
    return weights

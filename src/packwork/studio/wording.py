"""Messages as the page says them: options by their names there, files without our folders."""

from __future__ import annotations

import re
from collections.abc import Mapping

LABELS: Mapping[str, str] = {
    "padding": "gap", "rotate": "turns", "count": "items in all", "canvas": "sheet",
}  # fmt: skip
"""Names on the page of options that have others there."""

_FLAG = re.compile(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)")
_COUNT = re.compile(r"(?<=\w) -n (\d+)")
_KEY = re.compile(r"^([a-z]+(?:_[a-z]+)*): ")


def for_page(text: str) -> str:
    """A message in which command lines' names of options are those of the page.

    Examples
    --------
    >>> for_page("2 items are smaller than --size-ratio 2 allows")
    '2 items are smaller than size ratio 2 allows'
    >>> for_page("--sizes free -n 40 would show it"), for_page("size_ratio: must be at least 1")
    ('sizes free, 40 items, would show it', 'size ratio: must be at least 1')
    >>> for_page("little shows; -n 40 would show it")
    'little shows; 40 items would show it'
    >>> for_page(": holds no drawing")
    'holds no drawing'
    """
    text = _COUNT.sub(r", \1 items,", text.removeprefix(": "))
    text = re.sub(r"(?<!\S)-n (\d+)", r"\1 items", text)
    text = _FLAG.sub(lambda found: _label(found[1]), text)
    return _KEY.sub(lambda found: f"{_label(found[1])}: ", text)


def _label(name: str) -> str:
    return LABELS.get(name, re.sub("[-_]", " ", name))

"""Lengths of time, as people and spreadsheets write them."""

from __future__ import annotations

import re
from collections.abc import Iterable

_DURATION = re.compile(r"(\d{1,6}):([0-5]\d)(?::([0-5]\d(?:[.,]\d{1,6})?))?")


def durations(texts: Iterable[str]) -> dict[str, float]:
    """Hours of lengths of time, by their texts; none where one of the texts is no such length.

    All have as many figures: ``57:00`` beside ``1:02:00`` would be minutes, but alone hours.

    Examples
    --------
    >>> durations(["8:00", "0:45"]), durations(["1:30:36"]), durations(["1:02:00", "57:00"])
    ({'8:00': 8.0, '0:45': 0.75}, {'1:30:36': 1.51}, {})
    """
    held = {text: _DURATION.fullmatch(text.strip()) for text in texts}
    hours = dict[str, float]()
    for text, found in held.items():
        if found is None:
            return {}
        hour, minute, second = found.groups("0")
        hours[text] = int(hour) + int(minute) / 60 + float(second.replace(",", ".")) / 3600
    return hours if len({text.count(":") for text in hours}) == 1 else {}

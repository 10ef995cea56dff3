"""Cache of what was computed of a font's glyphs, by the content of the font's file.

A typeface is opened anew for each run, so results that were kept by the object would never be
found again, and would keep its file in memory.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from functools import wraps
from threading import Lock
from typing import Any, Concatenate, ParamSpec, TypeVar

from packwork.readers.fonts.face import Typeface

P = ParamSpec("P")
R = TypeVar("R")

_OfFont = Callable[Concatenate[Typeface, P], R]


def remembered_by_font(most: int) -> Callable[[_OfFont[P, R]], _OfFont[P, R]]:
    """Keep the ``most`` results of a function of a typeface that were last asked for.

    Typefaces of the same content are one; none is kept itself.

    Examples
    --------
    >>> from packwork.readers.fonts.face import bundled_typeface
    >>> asked = []
    >>> @remembered_by_font(2)
    ... def count_of(face: Typeface, text: str) -> int:
    ...     asked.append(text)
    ...     return len(face.shaped(text).glyphs)
    >>> [count_of(bundled_typeface(), text) for text in ("bear", "fox", "bear", "owl", "fox")]
    [4, 3, 4, 3, 3]
    >>> asked
    ['bear', 'fox', 'owl', 'fox']
    """

    def remembering(compute: _OfFont[P, R]) -> _OfFont[P, R]:
        known: OrderedDict[Any, R] = OrderedDict()
        lock = Lock()

        @wraps(compute)
        def told(face: Typeface, /, *args: P.args, **options: P.kwargs) -> R:
            key = (face.identity, args, *sorted(options.items()))
            with lock:
                if key in known:
                    known.move_to_end(key)
                    return known[key]
            found = compute(face, *args, **options)
            with lock:
                known[key] = found
                while len(known) > most:
                    known.popitem(last=False)
            return found

        return told

    return remembering

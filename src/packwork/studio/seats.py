"""Seats at a desk: all tabs of one browser are one person's, another is asked first.

No secret and no guard: all who come so far know the token. It keeps two people from pulling at one
collage without knowing of each other.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable

GRACE_SECONDS = 5.0
"""How long the desk is kept for somebody whose last page is gone. Shorter gives it away while a
page is loaded anew, longer has the next one wait. Chosen."""

LONGEST = 64
"""Characters of what a person is known by at most. Chosen."""


class Seats:
    """Seats at a desk: the person there, and who works there together.

    Examples
    --------
    >>> seats = Seats()
    >>> seats.take("ann"), seats.take("ann"), seats.take("bob"), seats.take("bob", joins=True)
    (True, True, False, True)
    >>> seats.leave("ann"), seats.take("ann"), seats.take("cid")
    (None, True, False)
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._pages: Counter[str] = Counter()
        self._left: dict[str, float] = {}
        self._together: set[str] = set()

    def take(self, person: str, *, joins: bool = False) -> bool:
        """Have one more page of a person at the desk; False if somebody else is there.

        A page that does not say whose it is comes in, and keeps nobody out.
        """
        others = self._present - {person}
        if joins:
            self._together |= {person, *others}
        elif person and others and person not in self._together:
            return False
        self._pages[person] += 1
        return True

    def leave(self, person: str) -> None:
        """Have one page of a person less."""
        self._pages[person] -= 1
        if not self._pages[person]:
            del self._pages[person]
            self._left[person] = self._clock()

    @property
    def _present(self) -> set[str]:
        """Whoever has a page there, or had one a moment ago."""
        now = self._clock()
        self._left = {k: at for k, at in self._left.items() if now - at < GRACE_SECONDS}
        return {*self._pages, *self._left} - {""}


def person_of(offered: Iterable[str]) -> tuple[str, bool]:
    """Whose page a socket is of, by the subprotocols it offers; whether it joins whoever is there.

    Examples
    --------
    >>> person_of(["packwork", "token.abc", "person.4f"])
    ('4f', False)
    >>> person_of(["packwork", "join.4f"]), person_of(["packwork"])
    (('4f', True), ('', False))
    """
    for one in offered:
        kind, _, person = one.partition(".")
        if kind in {"person", "join"}:
            return person[:LONGEST], kind == "join"
    return "", False

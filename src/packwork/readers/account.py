"""Budget of work for each file that is read, shared by all stages of reading.

Work is counted, never timed: an account in nanoseconds of estimate, the same on every machine
and under any load. What would take longer than its account holds is not begun.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from packwork.readers.unfit import TooRichError

Account: TypeAlias = Literal["shapes", "pictures"]

SHAPES_NS = 2e9
"""For styles, shapes and outlines of one file. Larger lets hostile files be slow, smaller
traces rich drawings from their pictures. Chosen: with ``PICTURES_NS`` about five seconds."""

PICTURES_NS = 2e9
"""For all renderings of one file. Larger lets hostile files be slow, smaller makes the
pictures of rich drawings coarse, or refuses them. Chosen."""


@dataclass
class Budget:
    """Counted work that is left for one file.

    Examples
    --------
    >>> budget = Budget({"shapes": 5.0, "pictures": 5.0})
    >>> budget.spend(4.0, "has edges", "shapes"); budget.left("shapes")
    1.0
    >>> budget.spend(4.0, "has 9 edges", "shapes")
    Traceback (most recent call last):
    packwork.readers.unfit.TooRichError: has 9 edges; simplify it
    """

    accounts: dict[Account, float] = field(
        default_factory=lambda: {"shapes": SHAPES_NS, "pictures": PICTURES_NS}
    )

    def left(self, account: Account) -> float:
        """Nanoseconds that are left, 0 at least."""
        return max(0.0, self.accounts[account])

    def spend(self, nanoseconds: float, what: str, account: Account) -> None:
        """Take work off an account, before it is done.

        Raises
        ------
        TooRichError
            If that is more than is left; ``what`` says of what there is too much.
        """
        if nanoseconds > self.accounts[account]:
            raise TooRichError(what)
        self.accounts[account] -= nanoseconds


_current: ContextVar[Budget | None] = ContextVar("budget", default=None)


@contextmanager
def one_budget(largesse: float = 1.0) -> Iterator[Budget]:
    """Everything inside the block shares one budget, also with a block around it.

    Parameters
    ----------
    largesse
        By how much the accounts are larger than those of an item.
    """
    outer = _current.get()
    if outer is not None:
        yield outer
        return
    budget = Budget({"shapes": largesse * SHAPES_NS, "pictures": largesse * PICTURES_NS})
    before = _current.set(budget)
    try:
        yield budget
    finally:
        _current.reset(before)


def spend(nanoseconds: float, what: str, account: Account = "shapes") -> None:
    """Take work off the budget of the file being read; without one, nothing is counted.

    Raises
    ------
    TooRichError
        If that is more than is left.

    Examples
    --------
    >>> with one_budget():
    ...     spend(1e12, "has far too much of it")
    Traceback (most recent call last):
    packwork.readers.unfit.TooRichError: has far too much of it; simplify it
    """
    budget = _current.get()
    if budget is not None and nanoseconds > 0:
        budget.spend(nanoseconds, what, account)


def left(account: Account) -> float:
    """Nanoseconds left of an account; all of it where nothing is counted."""
    budget = _current.get()
    return (budget or Budget()).left(account)

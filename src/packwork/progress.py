"""Progress of a stage: steps, observers, stopping."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import factorial, gcd, nan
from numbers import Integral
from typing import Literal, Protocol, TypeAlias, cast

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.scene.pose import Poses

Shares: TypeAlias = tuple[float, float, float]
"""Image-space shares of the container: covered, covered twice, covered outside it."""


Stage: TypeAlias = Literal["levels", "finish", "gaps", "pile", "done"]
"""Parts of a run, as its steps name them."""


@dataclass(frozen=True)
class ObjectiveTerms:
    """Value of what the levels minimise, and of its terms.

    Parameters
    ----------
    total
        Sum of all terms, each by its weight at that epoch; not a number where nothing is minimised.
    terms
        Value of each loss by name, not weighed; ``recall`` and ``forces`` too, where they act.
    weights
        Factor of each term in the total.
    """

    total: float = nan
    terms: Mapping[str, float] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Step:
    """One moment of a run.

    Parameters
    ----------
    level, levels
        Index of the level (from 0) and how many there are.
    resolution
        Pixels on the longer side at this level.
    epoch
        Epochs done, over all levels.
    progress
        How far the run is, 0 to 1.
    poses
        Where the items are now.
    measured
        Computes ``coverage``, ``overlap`` and ``outside`` when one of them is first read: that
        takes about as long as an epoch.
    is_finish
        Whether this is of the exact finish, after the last level.
    is_last
        Whether it is the last one of its level; all are told of that.
    ids
        ``(n,)`` what each item is called by, from 0, where fillers have joined the run and some
        of them have left it, or some of a pile are yet to come; None: their places in
        ``poses``.
    stage
        Which part of the run this is of: levels, finish, gaps (that voids are filled), pile, or
        done, once at its end.
    priced
        Computes ``objective`` when that is first read: about as long as two epochs.
    """

    level: int
    levels: int
    resolution: int
    epoch: int
    progress: float
    poses: Poses
    measured: Callable[[], Shares]
    is_finish: bool = False
    is_last: bool = False
    ids: IntArray | None = None
    stage: Stage = "levels"
    priced: Callable[[], ObjectiveTerms] = ObjectiveTerms

    @cached_property
    def objective(self) -> ObjectiveTerms:
        """Objective that the levels minimise, after this epoch; of other stages no terms."""
        return self.priced()

    @cached_property
    def _shares(self) -> Shares:
        return self.measured()

    @property
    def coverage(self) -> float:
        """Share of the container that is covered, at this level's resolution."""
        return self._shares[0]

    @property
    def overlap(self) -> float:
        """Share of the container that is covered twice."""
        return self._shares[1]

    @property
    def outside(self) -> float:
        """Area that is covered outside the container, as a share of it."""
        return self._shares[2]


class Observer(Protocol):
    """Receiver of the steps of a run: a progress bar, a film, a log."""

    every: int
    """Epochs between two steps that it is told; the last of a level is always told."""

    def on_step(self, step: Step) -> None:
        """Receive a step; must not change it."""
        ...


Listener: TypeAlias = Observer | Callable[[Step], object]
"""What users give to be told: an observer, or a function of a step."""

EPOCHS_BETWEEN = 10
"""Epochs between two steps that a function is told. Larger tells less, smaller takes longer if it
reads what steps measure. Chosen."""


def as_observer(listener: Listener) -> Observer:
    """The observer that a listener is; of a function, one that calls it.

    Raises
    ------
    RecipeError
        If it is neither, or would be told every so many epochs that are none.

    Examples
    --------
    >>> as_observer(NOBODY) is NOBODY, as_observer(print).every
    (True, 10)
    """
    if hasattr(listener, "on_step"):
        every = getattr(listener, "every", None)
        if not (isinstance(every, Integral) and int(every) >= 1):
            raise RecipeError(
                "observer", f"every must be a whole number of epochs such as 10, not {every!r}"
            )
        return cast(Observer, listener)
    if not callable(listener):
        raise RecipeError(
            "observer", f"is {type(listener).__name__}; give a function of a step, or an observer"
        )
    return _Calling(listener)


class _Calling:
    """Calls a function of every step."""

    every = EPOCHS_BETWEEN

    def __init__(self, function: Callable[[Step], object]) -> None:
        self._function = function

    def on_step(self, step: Step) -> None:
        """Call it."""
        self._function(step)


class _Nobody:
    """Hears nothing."""

    every = factorial(20)

    def on_step(self, step: Step) -> None:
        """Forget it."""


NOBODY: Observer = _Nobody()
"""Observer of runs that nobody follows. Its ``every`` is a multiple of all others', so that an
audience that it is in is told no more often for it."""


class Audience:
    """Several observers as one, each told as often as it wants to be.

    Parameters
    ----------
    observers
        At least one.

    Examples
    --------
    >>> class Watch:
    ...     def __init__(self, every):
    ...         self.every = every
    >>> Audience([Watch(20), Watch(50)]).every
    10
    """

    def __init__(self, observers: Sequence[Observer]) -> None:
        self._observers = tuple(observers)
        self.every = gcd(*(observer.every for observer in self._observers))

    def on_step(self, step: Step) -> None:
        """Tell those that are due."""
        for observer in self._observers:
            is_due = (step.epoch - 1) % observer.every == 0
            if is_due or step.is_last or step.is_finish:
                observer.on_step(step)


def together(*observers: Observer) -> Observer:
    """One observer for several, without those that are nobody.

    Examples
    --------
    >>> together(NOBODY, NOBODY) is NOBODY
    True
    """
    there = [observer for observer in observers if observer is not NOBODY]
    return Audience(there) if len(there) > 1 else (there[0] if there else NOBODY)


Stop: TypeAlias = Callable[[], bool]
"""Asked before every epoch; True ends the run with what it has."""


def never() -> bool:
    """Let the run go to its end."""
    return False


def until_over(stop: Stop, seconds: float | None) -> Stop:
    """Stop when asked to, or when the time is over."""
    if seconds is None:
        return stop
    ends = time.perf_counter() + seconds
    return lambda: stop() or time.perf_counter() >= ends

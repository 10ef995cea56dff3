"""Progress of all stages as one, from 0 to 1, never backwards."""

from __future__ import annotations

from dataclasses import replace

from packwork.progress import Observer, Step

LEVELS = 0.4
"""How far a run is when its levels are done, where an exact finish follows. Tried."""

BEFORE_VOIDS = 0.5
"""How far it is when voids begin to be filled. Tried."""


class Onward:
    """Passes steps of stages on as those of one run.

    Parameters
    ----------
    observer
        Told of progress.
    """

    def __init__(self, observer: Observer) -> None:
        self.every = observer.every
        self._observer, self._most = observer, 0.0

    def on_step(self, step: Step) -> None:
        """Tell of a step, as far on as any before it."""
        self._most = max(self._most, min(step.progress, 1.0))
        self._observer.on_step(replace(step, progress=self._most))


class Stretch:
    """Passes steps of one stage on, whose progress is a part of that of another."""

    def __init__(self, observer: Observer, begin: float, end: float) -> None:
        self.every = observer.every
        self._observer, self._begin, self._end = observer, begin, end

    def on_step(self, step: Step) -> None:
        """Tell of a step."""
        progress = self._begin + (self._end - self._begin) * min(step.progress, 1.0)
        self._observer.on_step(replace(step, progress=progress))


class Turn:
    """Passes steps of one start of several on, its progress a part of that of all.

    Parameters
    ----------
    observer
        Told of progress.
    number, count
        Which of how many, from 0.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> Turn(SimpleNamespace(every=20), 1, 3).every
    20
    """

    def __init__(self, observer: Observer, number: int, count: int) -> None:
        self._observer, self._number, self._count = observer, number, count
        self.every = observer.every

    def on_step(self, step: Step) -> None:
        """Tell of it."""
        progress = (self._number + step.progress) / self._count
        self._observer.on_step(replace(step, progress=progress))


def onward(observer: Observer | None) -> Observer | None:
    """Observer that sees one run; None for none.

    Examples
    --------
    >>> onward(None) is None
    True
    """
    return None if observer is None else Onward(observer)


def stretch(observer: Observer | None, begin: float, end: float) -> Observer | None:
    """Observer of one stage of several, which goes from ``begin`` to ``end``; None for none."""
    return None if observer is None else Stretch(observer, begin, end)

"""Losses of a run by epoch, kept on request: what researchers plot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import nan
from numbers import Integral
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from packwork.api.parts import ReadOnly
from packwork.display.extras import import_extra
from packwork.errors import RecipeError
from packwork.progress import ObjectiveTerms, Step

if TYPE_CHECKING:
    from pandas import DataFrame
else:
    DataFrame = Any

TAKEN = "loss_"
"""What the column of a loss begins with whose name another column has."""

WEIGHT = "weight_"
"""What the column of a term's weight begins with."""


@dataclass(frozen=True, eq=False, repr=False)
class History:
    """Losses of a run by epoch: ``layout.history`` of what was made with ``history=True``.

    Parameters
    ----------
    columns
        Read-only arrays by name, each with an entry for each moment that was kept: ``stage``
        (levels, finish, gaps, pile, done), ``solve`` (from 1; several starts, attempts and groups
        of a chart are solved one after another), ``level`` (from 0), ``level_px``, ``epoch``
        (of that solve; in other stages rounds), ``progress`` (0 to 1); ``LC``, ``OO`` and ``EA``,
        in the levels as their pixels show them; ``total``, what the levels minimise: the sum of
        all terms, each by its weight at that epoch (most weights grow over a run); a column for
        each term, not weighed, and one for its weight, as ``overlap`` and ``weight_overlap``. Terms
        of the image and the total are means over the canvas; after the levels terms are not a
        number.

    Examples
    --------
    >>> from packwork import fill
    >>> history = fill("circle", "star", count=3, epochs=20, levels="50", history=True).history
    >>> bool(history["filling"][0] > history["filling"][19]), next(iter(history))["stage"]
    (True, 'levels')
    """

    columns: Mapping[str, npt.NDArray[Any]]

    def __post_init__(self) -> None:
        held = {name: np.array(cells) for name, cells in self.columns.items()}
        for cells in held.values():
            cells.flags.writeable = False
        object.__setattr__(self, "columns", ReadOnly(held))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self.columns),)

    def __len__(self) -> int:
        return len(self.columns["epoch"])

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self.columns[name]

    def __iter__(self) -> Iterator[dict[str, Any]]:
        cells = zip(*(column.tolist() for column in self.columns.values()), strict=True)
        return (dict(zip(self.columns, row, strict=True)) for row in cells)

    def __repr__(self) -> str:
        return f"<History: {len(self)} moments, {', '.join(self.columns)}>"

    def to_dataframe(self) -> DataFrame:
        """Pandas data frame: one row per moment.

        Raises
        ------
        PackworkError
            If pandas is not installed.
        """
        frame: DataFrame = import_extra("pandas", "use the arrays in columns").DataFrame(
            self.columns
        )
        return frame


class HistoryKeeper:
    """Observer that keeps the losses of a run, of each ``every``-th epoch."""

    def __init__(self, every: int) -> None:
        self.every = every
        self._rows: list[dict[str, Any]] = []
        self._met: list[ObjectiveTerms] = []
        self._solve, self._epoch = 1, 0

    def on_step(self, step: Step) -> None:
        """Keep what it tells."""
        if step.stage == "levels":
            self._solve += step.epoch <= self._epoch
            self._epoch = step.epoch
        self._rows.append(
            {
                "stage": step.stage,
                "solve": self._solve,
                "level": step.level,
                "level_px": step.resolution,
                "epoch": step.epoch,
                "progress": step.progress,
                "LC": step.coverage,
                "OO": step.overlap,
                "EA": step.outside,
                "total": step.objective.total,
            }
        )
        self._met.append(step.objective)

    def history(self) -> History:
        """All that was kept."""
        rows, met = self._rows, self._met
        columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        names = dict.fromkeys(name for one in met for name in one.terms)
        weights = {}
        for name in names:
            free = f"{TAKEN}{name}" if name in columns else name
            columns[free] = np.array([one.terms.get(name, nan) for one in met])
            weights[WEIGHT + free] = np.array([one.weights.get(name, nan) for one in met])
        return History(columns | weights)


def keeper(history: bool | int) -> HistoryKeeper | None:
    """Keeper of a history, as it is asked for; None if it is not.

    Examples
    --------
    >>> keeper(False) is None, keeper(True).every, keeper(10).every
    (True, 1, 10)
    """
    if not isinstance(history, Integral | np.bool_) or history < 0:
        raise RecipeError(
            "history",
            f"must be True, False or a number of epochs between two that are kept, not {history!r}",
        )
    return HistoryKeeper(int(history)) if history else None

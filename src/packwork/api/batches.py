"""Many runs at once in Python: a recipe for each row of a table."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from packwork.batches.batch import (
    batch_progress,
    plan_batch,
    read_request,
    run_batch,
)
from packwork.batches.report import rows_of
from packwork.batches.task import RowOutcome
from packwork.display.extras import import_extra
from packwork.errors import RecipeError
from packwork.progress import Stop, never

if TYPE_CHECKING:
    from pandas import DataFrame
else:
    DataFrame = Any


@dataclass(frozen=True, repr=False)
class Batch:
    """Outcome of a batch: its rows, and what became of each.

    Parameters
    ----------
    outcomes
        Of all rows, in their order: ``row``, ``name``, ``status`` (``made``, ``short`` for what
        is not as asked, ``kept`` for what was made before, ``failed``, ``stopped``), ``outputs``,
        ``metrics``, ``seconds``, ``said``.
    """

    outcomes: tuple[RowOutcome, ...]

    def __len__(self) -> int:
        return len(self.outcomes)

    def __iter__(self) -> Iterator[RowOutcome]:
        return iter(self.outcomes)

    @property
    def failed(self) -> tuple[RowOutcome, ...]:
        """Rows of which nothing was made."""
        return tuple(one for one in self.outcomes if one.status == "failed")

    @property
    def is_well(self) -> bool:
        """Whether all rows are made as asked."""
        return all(one.is_well for one in self.outcomes)

    def to_dataframe(self) -> DataFrame:
        """Rows with their metrics as columns.

        Raises
        ------
        PackworkError
            If pandas is not installed.
        """
        frame: DataFrame = import_extra("pandas", "use the outcomes").DataFrame(
            rows_of(self.outcomes)
        )
        return frame

    def __repr__(self) -> str:
        counts: dict[str, int] = {}
        for one in self.outcomes:
            counts[one.status] = counts.get(one.status, 0) + 1
        said = ", ".join(f"{count} {status}" for status, count in counts.items())
        return f"<Batch: {len(self)} rows, {said}>"


def batch(
    recipe: str | Path | Mapping[str, Any],
    table: str | Path | Sequence[Mapping[str, Any]] | Any = None,
    output: str | Path | Sequence[str | Path] = (),
    *,
    workers: int | None = 1,
    scheduler: str | None = None,
    in_place: bool = False,
    anew: bool = False,
    allow_code: bool = False,
    stop: Stop = never,
    **drawing: Any,
) -> Batch:
    """Run a recipe for each row of a table, and write the files of each.

    What was made before and would be the same is kept. A row that cannot be made is named in
    what comes back; all others are made.

    Parameters
    ----------
    recipe
        A recipe file or options as a dict, in which ``{column}`` stands for a cell; or a folder of
        recipe files.
    table
        A table's file, rows as dicts, or a data frame.
    output
        Files of a row, such as ``"out/{name}.svg"``; ``{row}`` is its number, ``{recipe}`` the
        name of the recipe's file.
    workers
        Processes; None for one a core. With more than one a script has to call this under ``if
        __name__ == "__main__":``, as for all of Python's processes.
    scheduler
        Address of the scheduler of a running cluster of Dask, as ``"tcp://10.0.0.1:8786"``, whose
        workers make the rows; needs ``packwork[cluster]``.
    in_place
        Whether those see the same files, and write the outputs themselves.
    anew
        Make what is made already, too.
    allow_code
        Run code that the recipe names, as losses ``module:function``.
    stop
        Asked on the way; True ends with what there is.
    drawing
        How files are drawn, as for :meth:`Layout.save`.

    Raises
    ------
    ReadError
        If the recipe or the table cannot be read.
    RecipeError
        If no row could be made.
    WriteError
        If the ending of a file is none of ours.

    Examples
    --------
    >>> import tempfile
    >>> poster = {"container": "{shape}", "items": ["star"], "count": 3, "levels": "50"}
    >>> rows = [{"shape": "heart"}, {"shape": "circle"}, {"shape": "no such"}]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     batch(poster, rows, folder + "/{shape}.svg")
    <Batch: 3 rows, 2 made, 1 failed>
    """
    if workers != 1 and multiprocessing.parent_process() is not None:
        raise RecipeError(
            "workers",
            'is asked for in a worker process: call this under if __name__ == "__main__":, or with '
            "workers=1",
        )
    outputs = [output] if isinstance(output, str | Path) else list(output)
    request = read_request(recipe, table, list(map(str, outputs)), drawing, allow_code=allow_code)
    plan = plan_batch(request)
    now = batch_progress(plan, anew=anew)
    return Batch(
        tuple(run_batch(plan, now, workers, stop=stop, scheduler=scheduler, in_place=in_place))
    )

"""A batch: what is not made yet, made; what was, kept."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from packwork.batches.plan import BatchPlan
from packwork.batches.pool import results, worker_count
from packwork.batches.record import is_done
from packwork.batches.task import RowOutcome, Task, failed, make
from packwork.progress import Stop, never

Told = Callable[[RowOutcome], object]


@dataclass(frozen=True)
class BatchProgress:
    """Progress of a batch.

    Parameters
    ----------
    to_do
        Tasks that are not made, or not any more as they would be.
    kept
        Of rows that are.
    """

    to_do: tuple[Task, ...]
    kept: tuple[RowOutcome, ...]


def standing(plan: BatchPlan, *, anew: bool = False) -> BatchProgress:
    """Progress of a plan before it is run: rows whose files are made already."""
    to_do, kept = [], []
    for task in plan.tasks:
        found = None if anew else is_done(task.key, task.outputs)
        if found is None:
            to_do.append(task)
        else:
            kept.append(
                RowOutcome(
                    row=task.row,
                    name=task.name,
                    status="kept" if found.get("status") == "made" else "short",
                    outputs=task.outputs,
                    metrics=dict(found.get("metrics") or {}),
                    seconds=0.0,
                    said=str(found.get("said", "")),
                )
            )
    return BatchProgress(tuple(to_do), tuple(kept))


def carried_out(
    plan: BatchPlan,
    now: BatchProgress,
    workers: int | None = None,
    told: Told = lambda _: None,
    stop: Stop = never,
    scheduler: str | None = None,
    in_place: bool = False,
) -> list[RowOutcome]:
    """Outcomes of all rows, in their order; of those that were stopped too.

    Parameters
    ----------
    workers
        Processes; None for one a core.
    scheduler
        Address of that of a cluster, whose workers make all; None for processes of this machine.
    in_place
        Whether those see the same files, and write the outputs themselves.
    """
    found: list[RowOutcome] = [*plan.bad, *now.kept]
    made_by: Iterable[tuple[Task, RowOutcome | Exception]]
    if scheduler is None or not now.to_do:
        made_by = results(now.to_do, make, worker_count(workers, len(now.to_do)), stop)
    else:
        from packwork.batches.cluster import clustered

        made_by = clustered(now.to_do, scheduler, in_place=in_place, stop=stop)
    for task, made in made_by:
        outcome = failed(task.row, task.name, made) if isinstance(made, Exception) else made
        found.append(outcome)
        told(outcome)
    met = {one.row for one in found}
    found += _stopped(task for task in now.to_do if task.row not in met)
    return sorted(found, key=lambda one: one.row)


def _stopped(tasks: Iterable[Task]) -> list[RowOutcome]:
    return [RowOutcome(row=task.row, name=task.name, status="stopped") for task in tasks]

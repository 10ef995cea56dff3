"""The best of several runs that differ in their seeds alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from packwork import pipeline, threads, uses
from packwork.batches.pool import results, worker_count
from packwork.batches.report import flat_metrics
from packwork.batches.task import collecting_notices
from packwork.errors import PackworkError, RecipeError
from packwork.metrics.measure import ExactShares, Metrics
from packwork.phrasing import enumerated
from packwork.pipeline import Run
from packwork.progress import NOBODY, Stop, never
from packwork.recipe import Recipe, make_recipe

COVERAGE, EVENNESS = "coverage", "evenness"

_MEANT = {
    COVERAGE: "exact_LC", EVENNESS: "-LnU",
    "-overlap": "-exact_OO", "-outside": "-exact_EA", "-unevenness": "-LnU",
}  # fmt: skip
"""What words stand for: a metric of the report; with a minus, less of it is better."""

METRICS = (
    *(name for name in Metrics.__annotations__ if name != "exact"),
    *(f"exact_{name}" for name in ExactShares.__annotations__),
)
"""Of a report, by one name each."""

Told = Callable[[int], object]


@dataclass(frozen=True)
class Seeded:
    """A recipe, and whether its track is recorded."""

    recipe: Mapping[str, Any]
    record: bool


def best_of(
    recipe: Recipe,
    count: int,
    by: str = COVERAGE,
    record: bool = False,
    workers: int | None = None,
    told: Told = lambda _: None,
    stop: Stop = never,
) -> tuple[Run, ...]:
    """Runs of a recipe's seed and those after it, the best first.

    Each gives the same bytes as a run of its seed alone. ``by`` is ``coverage``, ``evenness`` or a
    metric of the report, with a minus where less is better. If all seeds are refused, the first
    refusal is raised; a failure that is none is raised as it is.
    """
    check_metric(by)
    plain = recipe.plain()
    tasks = [Seeded({**plain, "seed": recipe.seed + k}, record) for k in range(count)]
    made = results(tasks, run_seed, worker_count(workers, count), stop)
    return best_first((one for _, one in made), by, told)


def best_first(
    made: Iterable[Run | Exception], by: str = COVERAGE, told: Told = lambda _: None
) -> tuple[Run, ...]:
    """Runs of several seeds, the best first; refused ones are passed over unless all are.

    What is not as asked comes after all that is.
    """
    check_metric(by)
    found: list[Run] = []
    failed: list[PackworkError] = []
    for one in made:
        if isinstance(one, PackworkError):
            failed.append(one)
        elif isinstance(one, Exception):
            raise one
        else:
            found.append(one)
        told(len(found) + len(failed))
    if not found:
        raise failed[0] if failed else PackworkError("stopped before there was anything to write")

    def rank(run: Run) -> tuple[bool, float, int]:
        return not run.is_as_asked, -score_of(run, by), run.layout.manifest["seed"]

    return tuple(sorted(found, key=rank))


def run_seed(task: Seeded, stop: Stop) -> Run:
    """A run of one seed; what it tells on the way was told of the first already."""
    with collecting_notices(), threads.using(1):
        return pipeline.run(uses.read(make_recipe(**task.recipe)), NOBODY, stop, task.record)


def check_metric(by: str) -> None:
    """Refuse what no report has, naming all there are."""
    if not isinstance(by, str) or _MEANT.get(by, by).removeprefix("-") not in METRICS:
        there = enumerated(list(dict.fromkeys((COVERAGE, EVENNESS, *METRICS))), 30)
        raise RecipeError("best_by", f"must be one of {there}, not {str(by)[:40]!r}")


def score_of(run: Run, by: str) -> float:
    """Score of a run, more is better."""
    check_metric(by)
    meant = _MEANT.get(by, by)
    value = float(flat_metrics(run.metrics.as_dict())[meant.removeprefix("-")])
    return -value if meant.startswith("-") else value

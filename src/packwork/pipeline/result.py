"""Result of a run: the layout, its measures, and what was asked but not met."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import PackworkError, RowsLostError
from packwork.installed import installed_version
from packwork.losses.registry import by_name
from packwork.metrics.measure import LayoutMetrics
from packwork.phrasing import one_of
from packwork.pipeline.findings import Filling, Sentence, Told, Unplaced, WordsFound, told_as
from packwork.pipeline.plan.resolution import photo_pixels
from packwork.pipeline.state import RunState
from packwork.scene.layout import Layout
from packwork.scene.pose import NO_LIMITS, Limits
from packwork.solve.level import Level
from packwork.solve.outlines import simplify_for_level
from packwork.solve.relocate_trapped import violation_shares
from packwork.solve.solver import Ending

CHECK_RESOLUTION = 600
"""Pixels on the longer side of the image on which unplaced items are found. Chosen."""

ROUGH_SHARE = 0.03
"""Share of the container that may be overlapped or outside before a run counts as rough.
A run that went well stays a hundred times below. Chosen."""

UNPLACED_SHARE = 0.5
"""Share of an item that is overlapped or outside from which it counts as not placed."""


@dataclass(frozen=True, eq=False)
class Run:
    """Result of a run.

    Parameters
    ----------
    kept
        Which of the items that were placed are in the layout.
    beside
        Pairs of one kind that lie side by side; None if they may.
    certified
        Whether exact measures find that nothing overlaps, nothing sticks out and all gaps are as
        asked.
    broken
        What of that does not hold although it was promised, and what else was asked and is not
        met, as shares of area; a sentence each.
    words
        How many different words the source holds, and how many of them were to be set; None
        if there are none.
    pile
        How the items lie; empty unless they were heaped.
    remarks
        What the run chose by itself, a sentence each.
    advice
        What is poor although all that was asked holds, and what would do, a sentence each.
    """

    layout: Layout
    metrics: LayoutMetrics
    seconds: Mapping[str, float]
    ending: Ending
    unplaced: tuple[Unplaced, ...]
    kept: IntArray
    skipped: tuple[PackworkError, ...]
    beside: int | None = None
    certified: bool = False
    broken: tuple[str, ...] = ()
    filling: Filling | None = None
    words: WordsFound | None = None
    left_out: int = 0
    pile: Mapping[str, Any] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    advice: tuple[str, ...] = ()

    @classmethod
    def of(cls, state: RunState) -> Run:
        """Result of a run that has been measured."""
        job, (layout, metrics) = state.job, state.measured
        return cls(
            layout=replace(layout, manifest=manifest(state)),
            metrics=metrics,
            seconds=job.clock.seconds,
            ending=state.ending,
            unplaced=state.unplaced,
            kept=state.kept,
            skipped=job.skipped,
            beside=state.beside,
            certified=state.certified,
            broken=told_as(Told.FAULT, state.findings),
            filling=state.filling,
            words=state.words,
            left_out=state.left_out,
            pile=state.pile,
            remarks=told_as(Told.REMARK, state.findings),
            advice=told_as(Told.ADVICE, state.findings),
        )

    @property
    def is_as_asked(self) -> bool:
        """Whether all that was asked is met."""
        has_lost = any(isinstance(error, RowsLostError) for error in self.skipped)
        is_short = self.filling is not None and self.filling.is_short
        is_missed = bool(self.unplaced or self.broken)
        return self.certified and not (is_missed or has_lost or is_short)

    @property
    def is_rough(self) -> bool:
        """Whether far more is overlapped or outside than a run that went well leaves."""
        exact = self.metrics.exact
        return exact.overlap + exact.exceeding > ROUGH_SHARE

    def complaints(self, was_cut_short: bool) -> list[str]:
        """Sentences about what was asked and does not hold, but for single items."""
        recipe, exact = self.layout.manifest["recipe"], self.metrics.exact
        is_free = recipe["pile"] or recipe["chart"] or recipe["sizes"] == "free"
        others = [] if is_free else ["--sizes free"]
        found = list(self.broken)
        times = float(self.layout.areas.sum()) / self.layout.container.outline.area
        if self.unplaced and times > 1:
            smaller = ["a smaller --size"] if recipe["pile"] else others
            remedy = one_of("fewer", "a larger --canvas", *smaller)
            found.insert(0, Sentence.CROWDED.of(times=times, remedy=remedy))
        if self.is_rough:
            longer = "more --effort" if recipe["time"] is None else "more --time"
            remedy = f"try {one_of(longer, 'fewer items', *others)}"
            found.append(
                Sentence.ROUGH.of(
                    double=100 * exact.overlap,
                    outside=100 * exact.exceeding,
                    remedy="let it run to its end" if was_cut_short else remedy,
                )
            )
        return found

    @property
    def asked_for(self) -> int:
        """Items that were to be placed; words that no font could draw are among them."""
        placed = len(self.layout.items) + self.left_out
        return max([placed, *(one.index + 1 for one in self.unplaced)])

    def report(
        self, since: Mapping[str, float] | None = None, start_up_seconds: float = 0.0
    ) -> dict[str, Any]:
        """Plain values for ``--report``; ``since`` is seconds of parts after the run's own."""
        seconds = {"start-up": start_up_seconds, **self.seconds, **(since or {"write": 0.0})}
        seconds.setdefault("finish", 0.0)
        seconds["total"] = sum(seconds.values())
        return {
            "canvas": self.layout.container.canvas,
            "metrics": self.metrics.as_dict(),
            "seconds": seconds,
            "items": self.asked_for,
            "placed": self.asked_for - len(self.unplaced),
            "unplaced": [asdict(u) for u in self.unplaced],
            "beside": self.beside,
            "skipped": [str(error) for error in self.skipped],
            "certified": self.certified,
            "promised": self.layout.manifest["promised"] is not None,
            "broken": list(self.broken),
            "filling": self.filling and asdict(self.filling),
            "words": self.words and asdict(self.words),
            "pile": dict(self.pile) or None,
            "photos": [asdict(photo) for photo in photo_pixels(self.layout)],
            "remarks": list(self.remarks),
            "advice": list(self.advice),
            "ending": self.ending.value,
            "seed": self.layout.manifest["seed"],
        }


def find_unplaced(layout: Layout, limits: Limits = NO_LIMITS) -> tuple[Unplaced, ...]:
    """Items of which most is overlapped or outside the container or their zone."""
    outlines = [item.outline for item in layout.items]
    px_per_cu = CHECK_RESOLUTION / layout.container.side
    seen = simplify_for_level(outlines, layout.poses, px_per_cu)
    level = Level(layout.container, seen, CHECK_RESOLUTION, limits=limits)
    shares = violation_shares(level, layout.poses, level.density(layout.poses))
    return tuple(
        Unplaced(
            layout.items[k].name,
            int(k),
            Sentence.MOSTLY_OUTSIDE.of(percent=100 * shares[k]),
        )
        for k in np.flatnonzero(shares > UNPLACED_SHARE)
    )


def manifest(state: RunState) -> dict[str, Any]:
    """Manifest of a measured state: what repeats the run, and what it measured."""
    job, (layout, metrics) = state.job, state.measured
    solved = None
    if state.levels:
        options = job.plan.solve_options()
        # Losses by their names.
        solved = options.model_dump(mode="json", exclude={"losses"})
        solved["losses"] = by_name(options.losses)
    said: dict[str, Any] = {
        "packwork": installed_version(),
        "recipe": job.recipe.plain(),
        "seed": job.recipe.seed,
        "start": state.method,
        "ending": state.ending.value,
        "levels": [asdict(level) for level in state.levels],
        "solve": solved,
        "metrics": metrics.as_dict(),
        "seconds": dict(job.clock.seconds),
        "unplaced": [asdict(u) for u in state.unplaced],
        "beside": state.beside,
        "skipped": [str(error) for error in job.skipped],
        "certified": state.certified,
        "promised": asdict(state.promise) if job.plan.is_exact else None,
        "filling": state.filling and asdict(state.filling),
        "words": state.words and asdict(state.words),
    }
    if state.pile:
        said["pile"] = dict(state.pile)
    if layout.ground:
        said["ground"] = layout.ground
    return {**said, **job.use.inner.stated}

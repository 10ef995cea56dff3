"""Items that came out smaller than they were asked to be, each in a sentence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.objective import SIZE_TOLERANCE
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.hero import HERO
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules
from packwork.pipeline.plan.counts import lines_width, widest_cu
from packwork.pipeline.plan.limits import pinned_scales
from packwork.pipeline.run import RunContext, RunStep
from packwork.pipeline.state import RunState
from packwork.scene.layout import Layout

WIDEST_TOLERANCE = 0.01
"""How exactly a container's widest place is found, as a share of its extent. Smaller takes
longer and is not seen. Chosen."""

SPECK = 3e-4
"""Square root of an item's area, as a share of the canvas's side, below which it counts as not to
be seen: 0.3 mm on a poster of a metre. Larger blames the smallest of a hundred thousand, smaller
passes letters that nobody can read. Chosen."""


@final
class TellShortfalls(RunStep):
    """Sentences about items that came out smaller than they were asked to be."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with these faults."""
        return replace(state, faults=(*state.faults, *shortfalls(state)))


def shortfalls(state: RunState) -> tuple[str, ...]:
    """A sentence about each size that was asked for and not met."""
    job, nominal = state.job, state.nominal
    side, scales = job.container.side, state.poses.scale
    pinned = pinned_scales(job)
    said: list[str] = []
    dwarfs: list[int] = []
    widest = ""
    for k, one in enumerate(job.asked):
        item = job.items[k]
        if scales[k] < pinned[k] * (1 - SIZE_TOLERANCE):
            widest = widest or _widest(job)
            sizes = scales[k] * item.outline.extent / side, pinned[k] * item.outline.extent / side
            said.append(
                f"{item.name} (item {k + 1}) came out at {_percent(sizes[0])}, "
                f"{_percent(sizes[1])} asked; {_no_place(one)}{widest}"
            )
        elif "scale" in one.values and "size" not in one.pin:
            least, ratio = one.values["scale"][0], float(scales[k] / nominal[k])
            if ratio < least * (1 - SIZE_TOLERANCE):
                said.append(
                    f"{item.name} (item {k + 1}) came out at {ratio:.2g} times the typical size, "
                    f"{least:g} asked at least"
                )
        elif k in state.undersized:
            dwarfs.append(k)
    return (*said, *_dwarfs(job, dwarfs, nominal, scales))


def _no_place(one: ItemRules) -> str:
    """Reason why an item has no place at its size, for the pinned hero; else empty."""
    is_free_hero = one.sources.get("pin.size") == HERO and not one.is_put
    return "it has no place at that size, turned as it may be; " if is_free_hero else ""


def _dwarfs(
    job: Job, items: Sequence[int], nominal: FloatArray, scales: FloatArray
) -> tuple[str, ...]:
    """Sizes that are far smaller than free sizes go, in a sentence; or nothing."""
    if not items:
        return ()
    order = sorted(items, key=lambda k: scales[k] / nominal[k])
    names = enumerated(list(dict.fromkeys(job.items[k].name for k in order)))
    short = float(nominal[order[0]] / scales[order[0]])
    many = number_of(len(items), "item")
    return (
        f"{many} ({names}) came out up to {short:.0f} times smaller than the typical item, "
        f"--size-ratio {job.plan.size_ratio:g} allows less; use fewer items",
    )


def specks(layout: Layout) -> tuple[str, ...]:
    """Items too small to be seen at any scale, in a sentence; or nothing."""
    sizes = np.sqrt(layout.areas)
    small = np.flatnonzero(sizes < SPECK * layout.container.side)
    if len(small) == 0:
        return ()
    order = small[np.argsort(sizes[small], kind="stable")]
    names = enumerated(list(dict.fromkeys(layout.items[k].name for k in order)))
    unit = layout.container.unit
    many = number_of(len(small), "item is", "items are")
    lines = lines_width(layout.container)
    remedy = "weights that differ less, fewer items or --smallest for words would do"
    if lines is not None:
        remedy = f"the container is lines {lines:.2g} {unit} wide; wider ones would do"
    return (f"{many} too small to be seen ({names}: {sizes[order[0]]:.2g} {unit} wide); {remedy}",)


def _percent(share: float) -> str:
    return f"{100 * share:.2g} % of the canvas" if share < 0.1 else f"{100 * share:.0f} %"


def _widest(job: Job) -> str:
    """Width of the container's widest place, in words."""
    outline = job.container.outline
    widest = widest_cu(outline, WIDEST_TOLERANCE * outline.extent)
    return f"the container's widest place is {_percent(widest / job.container.side)} across"

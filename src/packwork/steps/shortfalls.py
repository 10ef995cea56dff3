"""Shortfalls of a result: sizes not met, specks, a container's shape that does not show."""

from __future__ import annotations

import functools
import logging
from collections.abc import Sequence
from typing import final

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.objective import SIZE_TOLERANCE
from packwork.geometry.outline import regions as regions_of
from packwork.metrics.pixel import ShapeMetrics
from packwork.phrasing import enumerated, number_of
from packwork.pipeline.findings import Finding, Sentence
from packwork.pipeline.hero import HERO
from packwork.pipeline.job import Job
from packwork.pipeline.plan.counts import MOST, items_needed, lines_width, widest_cu
from packwork.pipeline.plan.limits import pinned_scales
from packwork.pipeline.plan.plan import VoidPlan
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.layout import Layout
from packwork.scene.recolour import run_together

_LOG = logging.getLogger("packwork")

WIDEST_TOLERANCE = 0.01
"""How exactly a container's widest place is found, as a share of its extent. Smaller takes
longer and is not seen."""

SPECK = 3e-4
"""Square root of an item's area, as a share of the canvas's side, below which it counts as not to
be seen: 0.3 mm on a poster of a metre. Larger blames the smallest of a hundred thousand, smaller
passes letters that nobody can read. Chosen."""

MOST_BARE = 0.05
"""Share of the container far from any item from which its shape is said not to show. Larger
passes a cat without its tail, smaller blames a heart of twelve icons. By eye, of 40 layouts."""

LEAST_SHAPE = 0.8
"""Overlap of container and closed layout below which the same is said. Larger blames a heart of
twelve icons (0.88), smaller passes a guitar without its head (0.72). By eye, of 40 layouts."""

TOUCHING = 2e-3
"""Distance of two items, as a share of the canvas's side, up to which they look like one if they
have one colour: a millimetre on a poster of half a metre. Chosen."""

CLEARLY_MORE = 1.15
"""How many times as many items must be needed for more of them to be the advice. Chosen."""


@final
class TellShortfalls(RunStep):
    """Findings of items that came out smaller than they were asked to be, or usually are."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with these findings."""
        if state.small is not None:
            _LOG.warning("%s", state.small)
        job, nominal = state.job, state.nominal
        side, scales = job.container.side, state.poses.scale
        pinned, outline = pinned_scales(job), job.container.outline
        widest = functools.cache(lambda: widest_cu(outline, WIDEST_TOLERANCE * outline.extent))
        dwarfs: list[int] = []
        for k, one in enumerate(job.asked):
            item = job.items[k]
            if scales[k] < pinned[k] * (1 - SIZE_TOLERANCE):
                share = item.outline.extent / side
                is_free_hero = one.sources.get("pin.size") == HERO and not one.is_put
                state = state.with_finding(
                    Sentence.SMALLER_THAN_PINNED,
                    item=item.name,
                    number=k + 1,
                    size=_percent(scales[k] * share),
                    asked=_percent(pinned[k] * share),
                    why=Sentence.NO_PLACE.of() if is_free_hero else "",
                    widest=_percent(widest() / side),
                )
            elif "scale" in one.values and "size" not in one.pin:
                least, ratio = one.values["scale"][0], float(scales[k] / nominal[k])
                if ratio < least * (1 - SIZE_TOLERANCE):
                    state = state.with_finding(
                        Sentence.SMALLER_THAN_RULED,
                        item=item.name, number=k + 1, ratio=ratio, least=least,
                    )  # fmt: skip
            elif k in state.undersized:
                dwarfs.append(k)
        return _with_dwarfs(state, dwarfs, scales / nominal) if dwarfs else state


LOOSE = 1.5
"""Times as large as others, for their weights, that areas have to be to be told. Larger passes
pictures that seem to say the opposite of the weights, smaller blames what nobody sees. By eye."""


@final
class TellLooseWeights(RunStep):
    """Advice on areas of free sizes that are far from the shares of the weights given."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice."""
        asked = state.job.weights > 0
        sizes = (state.poses.scale / state.nominal)[asked] ** 2
        times = float(sizes.max() / sizes.min()) if asked.any() else 1.0
        return state.with_finding(Sentence.LOOSE_WEIGHTS, times=times) if times > LOOSE else state


def _with_dwarfs(state: RunState, items: Sequence[int], sizes: FloatArray) -> RunState:
    """State with a finding of items that are far smaller than free sizes go."""
    order = sorted(items, key=lambda k: sizes[k])
    names = dict.fromkeys(state.job.items[k].name for k in order)
    return state.with_finding(
        Sentence.DWARFS,
        many=number_of(len(items), "item"),
        names=enumerated(list(names)),
        factor=float(1 / sizes[order[0]]),
        ratio=state.job.plan.size_ratio,
    )


def _percent(share: float) -> str:
    return f"{100 * share:.2g} % of the canvas" if share < 0.1 else f"{100 * share:.0f} %"


def specks(layout: Layout) -> tuple[Finding, ...]:
    """Finding of items too small to be seen at any scale; or nothing."""
    sizes = np.sqrt(layout.areas)
    small = np.flatnonzero(sizes < SPECK * layout.container.side)
    if len(small) == 0:
        return ()
    order = small[np.argsort(sizes[small], kind="stable")]
    unit, lines = layout.container.unit, lines_width(layout.container)
    remedy = Sentence.LESS_DIFFERENCE.of()
    if lines is not None:
        remedy = Sentence.WIDER_LINES.of(width=lines, unit=unit)
    values = {
        "many": number_of(len(small), "item is", "items are"),
        "names": enumerated(list(dict.fromkeys(layout.items[k].name for k in order))),
        "width": sizes[order[0]],
        "unit": unit,
        "remedy": remedy,
    }
    return (Finding(Sentence.SPECKS, values),)


@final
class Advise(RunStep):
    """Advice on a layout that does not show the container's shape."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice."""
        layout, metrics = state.measured
        seen = metrics.seen
        if seen.bare <= MOST_BARE and seen.shape >= LEAST_SHAPE:
            return state
        found = advice(state.job, len(layout.items), seen)
        return state if found is None else state.with_finding(found.sentence, **found.values)


@final
class TellOneColour(RunStep):
    """Advice on items of one colour, which run together where they touch."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the advice."""
        layout, _ = state.measured
        is_one = run_together(layout.items) and _touch(layout)
        return state.with_finding(Sentence.RUN_TOGETHER) if is_one else state


def _touch(layout: Layout) -> bool:
    """Whether two items lie side by side without a gap that can be seen."""
    regions = regions_of(layout.outlines)
    reach = TOUCHING * layout.container.side
    first, second = shapely.STRtree(regions).query(regions, "dwithin", reach)
    return bool((first != second).any())


def advice(job: Job, count: int, seen: ShapeMetrics) -> Finding | None:
    """Advice on a layout of ``count`` items that does not show its container, if any helps."""
    if seen.bare_parts > 1:
        poor = Sentence.EMPTY_PARTS.of(empty=seen.bare_parts, parts=seen.parts)
    elif seen.bare > MOST_BARE:
        poor = Sentence.BARE.of(percent=100 * seen.bare)
    else:
        poor = Sentence.SHAPE.of(percent=100 * seen.shape)
    lines = lines_width(job.container)
    if lines is not None:
        remedy = Sentence.OTHER_CONTAINER.of(width=lines, unit=job.container.unit)
    else:
        own = job.use.inner.remedy(job)
        remedy = usual_remedy(job, count) if own is None else own
    return Finding(Sentence.POOR_SHAPE, {"poor": poor, "remedy": remedy}) if remedy else None


def usual_remedy(job: Job, count: int) -> str:
    """Remedy for a shape that does not show, in the words of the options; empty if none helps."""
    plan = job.plan
    needed = items_needed(job.container, "free", plan.size_ratio).count
    if plan.sizes == "free" and needed > CLEARLY_MORE * count:
        # As many as are ever advised may not do, as of a photograph whose dark specks are filled.
        is_too_fine = needed == MOST
        return Sentence.PLAINER.of() if is_too_fine else Sentence.MORE_ITEMS.of(count=needed)
    if plan.sizes == "fixed":
        return Sentence.FREE_SIZES.of()
    if plan.sizes == "shared":
        return Sentence.FREE_AND_MORE.of(count=max(needed, count))
    if job.container.lattice is not None:
        # Between items that repeat no copies are laid.
        return ""
    if plan.voids.target is None:
        # Copies in the voids may not come to cover what was asked, and then count as a fault.
        return Sentence.MORE_OF_THEM.of(count=2 * count)
    return more_copies(plan.voids)


def more_copies(voids: VoidPlan) -> str:
    """Advice about copies in voids that leave the container bare."""
    if voids.most is not None:
        return Sentence.MORE_COPIES.of(count=np.ceil(2 * voids.most))
    return Sentence.SMALLER_COPIES.of()

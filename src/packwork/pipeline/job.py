"""A recipe and all that it names, read and found usable: what the road takes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import PackworkError
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.plan.asked import ItemRules
from packwork.pipeline.plan.forces import forces_of
from packwork.pipeline.plan.plan import Plan
from packwork.pipeline.plan.regions import Region
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.pipeline.use import Use
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.target import TargetPicture
from packwork.solve.stand_ins import stand_ins


@dataclass
class Clock:
    """Seconds per part of a run."""

    seconds: dict[str, float] = field(default_factory=dict)
    now: Callable[[], float] = time.perf_counter

    @contextmanager
    def time(self, part: str) -> Iterator[None]:
        """Add what the block takes to ``part``."""
        began = self.now()
        try:
            yield
        finally:
            self.seconds[part] = self.seconds.get(part, 0.0) + self.now() - began


@dataclass(frozen=True, eq=False, kw_only=True)
class Job:
    """Job of a run: what was asked, what was read, and the plan for it.

    Parameters
    ----------
    recipe
        What was asked, kept for the manifest; stages read the plan.
    items, asked, weights
        One entry per copy: what it is, what rules ask of it, its share of area.
    regions
        Parts of the container that copies have to stay in.
    fillers
        What may be put into the voids that are left, one of each sort.
    target
        The picture that the layout shows from afar, if any.
    is_counted
        Whether the number of items was found by the run.
    """

    recipe: Recipe
    plan: Plan
    use: Use
    container: Container
    items: tuple[Item, ...]
    asked: tuple[ItemRules, ...]
    weights: FloatArray
    regions: tuple[Region, ...] = ()
    fillers: tuple[Item, ...] = ()
    earlier: Layout | None = None
    target: TargetPicture | None = None
    vectors: ItemVectors | None = None
    is_counted: bool = False
    skipped: tuple[PackworkError, ...] = ()
    clock: Clock = field(default_factory=Clock)

    @property
    def is_limited(self) -> bool:
        """Whether anything is asked of single items."""
        plan = self.plan
        return (
            plan.keeps_apart or plan.least_dpi is not None or any(one.voices for one in self.asked)
        )

    @cached_property
    def forces(self) -> Forces:
        """Forces on these items on this canvas.

        Raises
        ------
        ReadError
            If a curve cannot be used.
        RecipeError
            If a force names no item, or a length has no meaning.
        """
        return forces_of(self.plan.forces, self.items, self.weights, self.container)

    @property
    def tints(self) -> FloatArray:
        """``(n,)`` how far each item takes on the colours of the picture, 0..1."""
        asked = self.plan.tint
        usual = [0.0 if isinstance(item.art, PhotoArt) else 1.0 for item in self.items]
        tints = np.array(usual) if asked is None else np.full(len(self.items), asked)
        tints[[("color" in one.values) for one in self.asked]] = 0.0
        return tints

    @property
    def keeps_order(self) -> bool:
        """Whether items are put in an order that later stages have to keep."""
        is_asked = self.recipe.arrange is not None or self.vectors is not None
        return is_asked and not self.plan.stays

    @property
    def seated(self) -> IntArray:
        """Items that change places until their colours show the picture; none without one."""
        if self.target is None:
            return np.arange(0)
        is_free = np.array([not one.voices for one in self.asked], dtype=bool)
        return np.flatnonzero(is_free & (self.tints < 1))

    @property
    def solid_outlines(self) -> list[Outline]:
        """Outlines that items are taken for until they are measured."""
        return stand_ins([item.outline for item in self.items], self.plan.outline)

    def subset(self, kept: Sequence[int] | IntArray) -> Job:
        """The same job of some of its items, by their indices ``(m,)``."""
        rows = np.asarray(kept, dtype=np.int64)
        return replace(
            self,
            items=tuple(self.items[k] for k in rows),
            asked=tuple(self.asked[k] for k in rows),
            weights=self.weights[rows],
            use=self.use.subset(rows),
        )

    def replanned(self, **fields: Any) -> Job:
        """The same job, some fields of its plan replaced."""
        return replace(self, plan=replace(self.plan, **fields))

    def seconds_left(self, share: float) -> float | None:
        """That share of the time that the plan allows and nothing has used; None if any."""
        if self.plan.seconds is None:
            return None
        return share * max(self.plan.seconds - sum(self.clock.seconds.values()), 0.0)

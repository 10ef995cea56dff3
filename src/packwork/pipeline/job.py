"""A recipe and all that it names, read and found usable; and the role of its use."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import PackworkError, RecipeError
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.plan.copies import ItemRules, RuleSource, kinds
from packwork.pipeline.plan.forces import forces_of
from packwork.pipeline.plan.plan import Plan
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.recipe import Recipe
from packwork.recipe.order import unknown_measure
from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.pose import Zone
from packwork.scene.target import TargetPicture
from packwork.solve.outlines import stand_ins

if TYPE_CHECKING:
    from packwork.pipeline.state import RunStep
    from packwork.scene.item import Item
    from packwork.scene.layout import Layout


class Use(ABC):
    """Use of the program: its way with a job, and what it has besides items and weights."""

    palette_tints: bool = True
    """Whether drawings of several colours take on shades of the palette's."""

    has_nearest: bool = True
    """Whether drawings of several colours may take on the palette's nearest colours."""

    matches_by_name: bool = False
    """Whether a run that begins from an earlier layout tells its items by their names."""

    @abstractmethod
    def steps(self, job: Job) -> Sequence[RunStep]:
        """All steps of a run, in their order."""

    @abstractmethod
    def report(self, job: Job) -> Sequence[RunStep]:
        """The last of them: what measures, dresses and describes items in their places."""

    @property
    def inner(self) -> Use:
        """The use that read the items: itself, but for a pile of what another one read."""
        return self

    @property
    def words(self) -> Sequence[Item]:
        """Those of the items that are read as words."""
        return ()

    @property
    def stated(self) -> Mapping[str, Any]:
        """Plain values that the manifest has besides."""
        return {}

    def subset(self, kept: IntArray) -> Use:
        """The same of some of the items, by their indices ``(m,)``."""
        del kept
        return self

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that data give to items; None if palette and rules give them."""
        del job, layout
        return None

    def column(self, job: Job, name: str) -> FloatArray:
        """``(n,)`` numbers of the items in a column of the data that the use reads."""
        del job
        raise unknown_measure(name)

    def remedy(self, job: Job) -> str | None:
        """Remedy for a shape that does not show, in words of the options; None if as for icons."""
        del job
        return None

    def vectors(self, recipe: Recipe) -> ItemVectors:
        """Vectors that say which items are alike, made by the use itself."""
        del recipe
        raise RecipeError("embeddings", "auto is of words of a text; give a file of vectors")

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """Drawings of items of an earlier layout that are no more, as this run would have them."""
        del job, gone
        return ()


@dataclass(frozen=True, eq=False)
class UseOf(Use):
    """A way of placing what another use reads, which goes on to answer for it."""

    content: Use

    @property
    def inner(self) -> Use:
        """The use that read the items."""
        return self.content

    @property
    def words(self) -> Sequence[Item]:
        """Words among the items."""
        return self.content.words

    def subset(self, kept: IntArray) -> Use:
        """The same of some of the items."""
        return replace(self, content=self.content.subset(kept))

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that the content's data give."""
        return self.content.colours(job, layout)

    @property
    def palette_tints(self) -> bool:  # type: ignore[override]
        """As the content has it."""
        return self.content.palette_tints

    @property
    def has_nearest(self) -> bool:  # type: ignore[override]
        """As the content has it."""
        return self.content.has_nearest

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """As the content draws them."""
        return self.content.redrawn(job, gone)


@dataclass(frozen=True, eq=False)
class Region:
    """A zone, and the option that asked for it.

    Parameters
    ----------
    zone
        The part of the container, and which items stay in it.
    """

    zone: Zone
    source: RuleSource
    words: str


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
    numbers
        What items are put in order by, by their names, where a file says so.
    is_counted, is_recorded
        Whether the number of items was found by the run, and whether their way is kept.
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
    numbers: Mapping[str, float] | None = None
    is_counted: bool = False
    is_recorded: bool = False
    skipped: tuple[PackworkError, ...] = ()
    clock: Clock = field(default_factory=Clock)

    @property
    def is_limited(self) -> bool:
        """Whether anything is asked of single items."""
        plan = self.plan
        return (
            plan.keeps_apart or plan.least_dpi is not None or any(one.sources for one in self.asked)
        )

    @cached_property
    def forces(self) -> Forces:
        """Forces on these items on this canvas."""
        if not self.plan.forces:
            return Forces([], [], kinds(self.items), self.container.side)
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
    def seated(self) -> IntArray:
        """Items that change places until their colours show the picture; none without one."""
        if self.target is None:
            return np.arange(0)
        is_free = np.array([not one.sources for one in self.asked], dtype=bool)
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

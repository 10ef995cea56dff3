"""A recipe and all that it names, read and found usable."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

from packwork.arrays import FloatArray
from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.losses.registry import POSE_LOSSES, find_loss
from packwork.pipeline.asking import Asked
from packwork.pipeline.casting import cast, cast_chart, cast_words
from packwork.pipeline.chart_colours import chart_colours
from packwork.pipeline.framing import Frame, framed
from packwork.pipeline.regions import Region, read_regions
from packwork.pipeline.word_colours import check_colours
from packwork.readers.charts.chart import ChartRead, read_chart
from packwork.readers.container import read_container
from packwork.readers.items import read_items
from packwork.readers.layout import read_layout
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.recipe import Recipe
from packwork.refusals import length_asked
from packwork.scene.canvas import on_canvas
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout


@dataclass
class Clock:
    """Seconds per part of a run."""

    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def time(self, part: str) -> Iterator[None]:
        """Add what the block takes to ``part``."""
        began = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[part] = self.seconds.get(part, 0.0) + time.perf_counter() - began


@dataclass(frozen=True)
class Letters:
    """Bounds of the font size of words, canvas units; None where there is none.

    Examples
    --------
    >>> Letters(smallest=8.0).largest is None
    True
    """

    smallest: float | None = None
    largest: float | None = None


@dataclass(frozen=True, eq=False)
class Job:
    """A recipe and all that it names, read and found usable.

    Parameters
    ----------
    recipe
        What to do.
    container
        On its canvas.
    items, asked, weights
        One entry per copy: what it is, what rules ask of it, its share of area.
    regions
        Parts of the container that copies have to stay in.
    skipped
        Files that were left out, with the reason.
    clock
        What has been used so far.
    earlier
        The layout to start from, if any.
    fillers
        What may be put into the voids that are left, one of each sort.
    words
        The words among the items, if any.
    letters
        How large words may be; None if as it comes.
    chart
        What the items stand for, if they are marks of a chart.
    frame
        Where that chart's title and legend go.
    """

    recipe: Recipe
    container: Container
    items: tuple[Item, ...]
    asked: tuple[Asked, ...]
    weights: FloatArray
    regions: tuple[Region, ...]
    skipped: tuple[PackworkError, ...]
    clock: Clock
    earlier: Layout | None = None
    fillers: tuple[Item, ...] = ()
    words: WordsRead | None = None
    letters: Letters | None = None
    chart: ChartRead | None = None
    frame: Frame | None = None

    @property
    def is_limited(self) -> bool:
        """Whether anything is asked of single items."""
        return self.recipe.keeps_apart or any(one.voices for one in self.asked)

    def seconds_left(self, share: float) -> float | None:
        """That share of the time that the recipe allows and nothing has used; None if any."""
        if self.recipe.time is None:
            return None
        return share * max(self.recipe.time - sum(self.clock.seconds.values()), 0.0)


def read(
    recipe: Recipe, items: Sequence[Item] | None = None, container: Container | None = None
) -> Job:
    """Read what a recipe names; the first half of :func:`fill`."""
    clock = Clock()
    skipped: tuple[PackworkError, ...] = ()
    with clock.time("read"):
        if container is None:
            region = read_container(recipe.container, recipe.canvas_size, recipe.font)
        else:
            region = on_canvas(container, recipe.canvas_size)
        words = None if recipe.words is None else read_word_items(recipe.words, recipe.holes)
        check_colours(recipe, () if words is None else words.words)
        # Items are mixed in with words only if they were named.
        named = "items" in recipe.model_fields_set and recipe.items
        chart, frame = None, None
        if recipe.chart is not None:
            chart = _chart(recipe)
            region, frame = framed(region, recipe.chart, chart, recipe.canvas_size)
        if items is None and chart is None and (words is None or named):
            found = read_items(recipe.items, holes=recipe.holes, strict=recipe.strict)
            items, skipped = found.items, found.skipped
        if chart is not None:
            chosen = cast_chart(recipe, chart)
            skipped += tuple(ReadError(chart.table.name, notice) for notice in chart.notices)
        elif words is not None:
            chosen = cast_words(recipe, words, items)
        else:
            chosen = cast(recipe, items or ())
        regions = read_regions(chosen.asked, region)
        earlier = read_layout(recipe.start) if recipe.starts_from_layout else None
        fillers, more = _fillers(recipe, items or () if words is None else words.items)
        skipped += more
        recipe.start_options()
        for loss in recipe.losses:
            if loss not in POSE_LOSSES:
                find_loss(loss)
    return Job(
        recipe,
        region,
        chosen.items,
        chosen.asked,
        chosen.weights,
        regions,
        skipped,
        clock,
        earlier,
        fillers,
        words,
        _letters(recipe, region),
        chart,
        frame,
    )


def _chart(recipe: Recipe) -> ChartRead:
    """Marks of the recipe's chart, whose colours are known to be enough."""
    assert recipe.chart is not None  # noqa: S101 - who asks has a chart
    chart = read_chart(recipe.chart, recipe.holes)
    chart_colours(recipe, chart)
    return chart


def _letters(recipe: Recipe, container: Container) -> Letters | None:
    """Bounds of the font size that a recipe asks for.

    Raises
    ------
    RecipeError
        If one is no length, they cross, or sizes are not shared.
    """
    if recipe.words is None:
        return None
    found: dict[str, float | None] = {}
    for key in ("smallest", "largest"):
        asked = getattr(recipe.words, key)
        if asked is None:
            continue
        found[key] = size = length_asked(key, asked, container.unit, container.side)
        if size <= 0:
            raise RecipeError(key, f"must be more than nothing, not {asked}")
        if recipe.sizes != "shared":
            raise RecipeError(
                key, f"bounds words in proportion to each other, not --sizes {recipe.sizes}"
            )
    letters = Letters(**found)
    if letters.smallest and letters.largest and letters.smallest > letters.largest:
        raise RecipeError(
            "smallest", f"is {letters.smallest:g}, more than the {letters.largest:g} of --largest"
        )
    return letters if found else None


def _fillers(
    recipe: Recipe, items: Sequence[Item]
) -> tuple[tuple[Item, ...], tuple[PackworkError, ...]]:
    """What voids are filled with, and files that were left out."""
    if not recipe.fills_gaps:
        return (), ()
    if not recipe.filler:
        return tuple(items), ()
    found = read_items(recipe.filler, holes=recipe.holes, strict=recipe.strict)
    return found.items, found.skipped

"""A recipe and all that it names, read and found usable."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import PackworkError, RecipeError
from packwork.losses.registry import POSE_LOSSES, find_loss
from packwork.pipeline.asking import Asked
from packwork.pipeline.casting import cast, cast_chart, cast_words
from packwork.pipeline.cells import Cell
from packwork.pipeline.chart_colours import chart_colours
from packwork.pipeline.counting import counted, words_counted
from packwork.pipeline.forcing import forces_of
from packwork.pipeline.framing import Frame
from packwork.pipeline.given import no_container
from packwork.pipeline.regions import Region, read_regions
from packwork.pipeline.registering import registered
from packwork.pipeline.sharing import shared_out
from packwork.pipeline.spreading import spread_out
from packwork.pipeline.word_colours import check_colours
from packwork.readers.charts.chart import ChartRead, read_chart
from packwork.readers.container import read_container
from packwork.readers.items import read_items
from packwork.readers.photos.read import read_photos
from packwork.readers.quiet.container import QuietOptions
from packwork.readers.svg.walls import walled_container
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.readers.written.read import is_drawn, read_written
from packwork.recipe import Recipe
from packwork.refusals import length_asked
from packwork.scene.canvas import on_canvas
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout

NO_CONTAINER = "none"
"""Name for no container at all: a pile lies anywhere, a chart's groups are bars."""


@dataclass
class Clock:
    """Seconds per part of a run.

    Parameters
    ----------
    seconds
        By the part's name.
    now
        Tells the time: by the clock, or the processor's.
    """

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
    cells
        Where its groups go, if it has some.
    single
        The container of which each of them has a copy; None where they are bars.
    mouths
        ``(m, 2, 2)`` ends of the openings that a container of open paths has; None if none.
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
    cells: tuple[Cell, ...] | None = None
    single: Container | None = None
    mouths: FloatArray | None = None

    @property
    def has_bars(self) -> bool:
        """Whether marks lie in bars."""
        return self.cells is not None and self.single is None

    @property
    def is_limited(self) -> bool:
        """Whether anything is asked of single items."""
        recipe = self.recipe
        return (
            recipe.keeps_apart
            or recipe.least_dpi is not None
            or any(one.voices for one in self.asked)
        )

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
        room, mouths = _container(recipe, container)
        words = None
        if recipe.words is not None:
            wanted = words_counted(recipe, recipe.words, room)
            words = read_word_items(wanted, recipe.holes, recipe)
        check_colours(recipe, () if words is None else words.words)
        chart = None if recipe.chart is None else _chart(recipe)
        items, skipped = (None, ()) if chart is not None else _items(recipe, items)
        if chart is not None:
            chosen = cast_chart(recipe, chart)
            skipped += chart.told
        elif words is not None:
            chosen = cast_words(recipe, words, items)
            skipped += words.told
        else:
            chosen = cast(counted(recipe, room, items or ()), items or ())
        frame, cells, single = None, None, None
        if chart is not None:
            spread = spread_out(recipe, chart, room)
            region, frame, cells, single = (
                spread.container,
                spread.frame,
                spread.cells,
                spread.single,
            )
        else:
            region = no_container(recipe, chosen) if room is None else room
        spoken = () if words is None else words.items
        weights = shared_out(chosen.items, chosen.weights, spoken, recipe.share)
        forces_of(recipe.force or (), chosen.items, weights, region)
        regions = read_regions(chosen.asked, region)
        earlier = _earlier(recipe, chosen.items)
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
        weights,
        regions,
        skipped,
        clock,
        earlier,
        fillers,
        words,
        _letters(recipe, region),
        chart,
        frame,
        cells,
        single,
        mouths,
    )


def _earlier(recipe: Recipe, items: Sequence[Item]) -> Layout | None:
    """The earlier layout that a run begins from; None if it begins anew."""
    if recipe.layout_file is None:
        return None
    layout = read_written(recipe.layout_file)
    # GeoJSON holds poses; of drawings they are found from the shapes.
    return registered(layout, items) if is_drawn(recipe.layout_file) else layout


def _chart(recipe: Recipe) -> ChartRead:
    """Marks of the recipe's chart, whose colours are known to be enough."""
    assert recipe.chart is not None  # noqa: S101 - who asks has a chart
    if recipe.stroke_width == "even":
        raise RecipeError(
            "stroke_width", "even changes the areas of marks, which stand for numbers; leave it out"
        )
    chart = read_chart(recipe.chart, recipe.holes, recipe, recipe.read_options)
    chart_colours(recipe, chart)
    return chart


def _items(
    recipe: Recipe, given: Sequence[Item] | None
) -> tuple[tuple[Item, ...] | None, tuple[PackworkError, ...]]:
    """Photos and items; None where words come alone, and files that were left out.

    Items that were given are in place of the recipe's names.
    """
    items: tuple[Item, ...] = ()
    skipped: tuple[PackworkError, ...] = ()
    if recipe.photos is not None:
        threshold = recipe.alpha_threshold
        photos = read_photos(recipe.photos, strict=recipe.strict, threshold=threshold)
        items, skipped = photos.items, photos.skipped
    if given is not None:
        return (*items, *given), skipped
    # Items are mixed in with words and photos only if they were named.
    is_alone = recipe.words is None and recipe.photos is None
    if is_alone or ("items" in recipe.model_fields_set and recipe.items):
        found = read_items(
            recipe.items, holes=recipe.holes, strict=recipe.strict, reading=recipe.read_options
        )
        items, skipped = (*items, *found.items), (*skipped, *found.skipped)
    return items or None, skipped


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


def _container(
    recipe: Recipe, given: Container | None
) -> tuple[Container | None, FloatArray | None]:
    """The container, None for none at all, and its openings if it is drawn with some."""
    if given is not None:
        return on_canvas(given, recipe.canvas_size), None
    if recipe.container == NO_CONTAINER and (recipe.pile or recipe.chart):
        return None, None
    if recipe.pile is not None and Path(recipe.container).suffix.lower() in {".svg", ".svgz"}:
        size = recipe.canvas_size
        walled = walled_container(
            recipe.container, None if size is None else size.side, recipe.read_options
        )
        if walled is not None:
            placed = on_canvas(walled[0], size)
            return placed, _brought_along(walled[1], walled[0], placed)
    quiet = QuietOptions(recipe.quiet_share, recipe.keep_clear or ())
    size, how = recipe.canvas_size, recipe.read_options
    return read_container(recipe.container, size, recipe.font, quiet, how), None


def _brought_along(points: FloatArray, before: Container, after: Container) -> FloatArray:
    """Points of a container that has been put on another canvas."""
    scale = after.outline.extent / before.outline.extent
    old, new = (np.array(c.outline.bounds[:2]) for c in (before, after))
    return np.asarray(new + (points - old) * scale)


def _fillers(
    recipe: Recipe, items: Sequence[Item]
) -> tuple[tuple[Item, ...], tuple[PackworkError, ...]]:
    """What voids are filled with, and files that were left out."""
    if not recipe.fills_gaps:
        return (), ()
    if not recipe.filler:
        return tuple(items), ()
    found = read_items(
        recipe.filler, holes=recipe.holes, strict=recipe.strict, reading=recipe.read_options
    )
    return found.items, found.skipped

"""What a run chose by itself, and what would make a poor result a good one."""

from __future__ import annotations

import numpy as np

from packwork.metrics.shape import ShapeMetrics
from packwork.pipeline.counting import AUTO, items_needed, words_needed
from packwork.pipeline.job import Job
from packwork.recipe import Recipe
from packwork.scene.layout import Layout

MOST_BARE = 0.05
"""Share of the container far from any item from which its shape is said not to show. Larger
passes a cat without its tail, smaller blames a heart of twelve icons. By eye, of 40 layouts."""

LEAST_SHAPE = 0.8
"""Overlap of container and closed layout below which the same is said. Larger blames a heart of
twelve icons (0.88), smaller passes a guitar without its head (0.72). By eye, of 40 layouts."""

ITEMS_REACH, WORDS_REACH = 0.85, 0.6
"""Shares of a container that smaller copies of items and of words come to cover. Larger are not
always reached, and then count as not met. Tried."""

CLEARLY_MORE = 1.15
"""How many times as many items must be needed for more of them to be the advice. Chosen."""


def remarks(job: Job) -> tuple[str, ...]:
    """What was chosen where the recipe left it open, a sentence each."""
    recipe, container = job.recipe, job.container
    if recipe.words is not None and recipe.words.count == AUTO:
        return (f"auto chose {len(job.items)} words",)
    if recipe.count != AUTO:
        return ()
    chosen = f"auto chose {len(job.items)} items"
    if recipe.pile is not None:
        return (chosen,)
    width = items_needed(container, recipe).width_cu
    return (f"{chosen}, to reach into parts {width:.3g} {container.unit} wide",)


def advice(job: Job, layout: Layout, seen: ShapeMetrics) -> tuple[str, ...]:
    """What is poor, and what would do, a sentence each."""
    is_shape = job.recipe.pile is None and job.cells is None
    if not is_shape or (seen.bare <= MOST_BARE and seen.shape >= LEAST_SHAPE):
        return ()
    return (f"{_poor(seen)}; {remedy(job, layout)}",)


def _poor(seen: ShapeMetrics) -> str:
    """What of the shape does not show."""
    if seen.bare_parts > 1:
        return f"{seen.bare_parts} of the container's {seen.parts} parts are empty"
    if seen.bare > MOST_BARE:
        return f"{100 * seen.bare:.0f} % of the container lies far from any item"
    return f"the container's shape shows to {100 * seen.shape:.0f} % only"


def remedy(job: Job, layout: Layout) -> str:
    """What would show the shape, in the words of the options."""
    if job.chart is not None:
        return "a container without thin parts, such as circle, would show"
    if job.words is not None:
        return _remedy_of_words(job)
    recipe, count = job.recipe, len(layout.items)
    needed = items_needed(job.container, recipe).count
    if recipe.sizes == "free" and needed > CLEARLY_MORE * count:
        return f"-n {needed} would show it"
    if recipe.sizes == "fixed":
        return "--sizes free would show it"
    if recipe.sizes == "shared":
        free = recipe.model_copy(update={"sizes": "free"})
        needed = max(items_needed(job.container, free).count, count)
        return f"--sizes free -n {needed} would show it"
    return _smaller_copies(recipe)


def _remedy_of_words(job: Job) -> str:
    assert job.words is not None  # noqa: S101 - who asks has words
    words, recipe = job.words, job.recipe
    count = len(words.items)
    if words.found > count:
        needed = words_needed(job.container, recipe)
        return f"-n {min(max(needed, 2 * count), words.found)} would show more of it"
    return _smaller_copies(recipe)


def _smaller_copies(recipe: Recipe) -> str:
    """Advice about what fills voids."""
    if recipe.target_coverage is None:
        share = WORDS_REACH if recipe.words is not None else ITEMS_REACH
        return f"--target-coverage {share:g}, smaller copies in the voids, would show it"
    if recipe.max_items is not None:
        return f"--max-items {np.ceil(2 * recipe.max_items):.0f} would show more of it"
    return "--smallest 0.3%, smaller copies yet, would show more of it"

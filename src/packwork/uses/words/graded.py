"""Words whose sizes give way, with hierarchy: each as large as it finds a place in its turn.

Proportions are kept as far as there is room: the first size is such that all words in proportion
would cover more than they can, and what comes later gives way. Where the container is so thin
that the heaviest word is held down and all others with it, and much room is left, sizes come nearer
to each other: no word is larger than a heavier one, but it may be as large.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.geometry.affine import similarity
from packwork.phrasing import enumerated
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.plan.counts import lines_width
from packwork.pipeline.plan.limits import check_padding
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import Stop, never
from packwork.readers.words.shaping import EM_PX
from packwork.recipe import Recipe
from packwork.recipe.rules import Rotation
from packwork.scene.pose import Limits, Poses
from packwork.start.angles_and_sizes import spread_angles, start_angles
from packwork.start.first_fit.graded import Graded, graded_fit
from packwork.start.first_fit.greedy_board import Candidate
from packwork.steps.starts import needs_levels
from packwork.uses.words.copies import words_of
from packwork.uses.words.sizes import (
    Letters,
    without,
)

FULL = 0.62
"""Share of the container that words would cover in proportion to the first. Larger gives the
first words more and lets the last give way more; with 0.5 hardly any has to. Tried, by eye."""

NEARER = (1.0, 0.75, 0.5, 0.25, 0.0)
"""How much of the step from one weight to the next a size keeps, tried in turn: 1 all of it, 0
none. As ``relative_scaling`` of the ``wordcloud`` package."""

LEGIBLE, MOST = 0.005, 0.9
"""Height of an em, as a share of the canvas' longer side, that most words are to have, and what
share of them is most. Larger keeps less of the proportions. By eye: weights of a novel's thousand
words are 400 to 1, and half of the words were specks."""

ENOUGH = 0.5
"""Ink, as a share of the container, from which no step is made smaller. Smaller leaves the tips of
shapes bare that hold the heaviest word down. By eye: what a fat shape comes to."""

MOST_SPECKS = 0.3
"""How much words may lack of that height on average, those without a place all of it, before they
are placed again, all but the first ones held down so that the last find larger places. Larger
leaves specks among thousands of words, smaller makes few of them alike. Tried, by eye."""

DWARF = 0.1
"""Size, as a share of its proportion, below which a word is left out unless a least size is given.
Larger leaves out more, smaller leaves specks. Chosen."""

GROWN = 1.5
"""How many times as large the heaviest word may become in the finish. Larger grows it alone where
it is held by nothing. Chosen."""

ANGLES = 7
"""Angles tried for a word that may turn by any angle within a limit. More take longer. Chosen."""


@dataclass(frozen=True, eq=False)
class Places:
    """Places of words, and their sizes.

    Parameters
    ----------
    placed
        ``(m,)`` which of the items have found a place, in their order.
    limits
        Sizes that they may have in the finish: no smaller, and none larger than the one before.
    """

    placed: IntArray
    poses: Poses
    limits: Limits


def graded_places(job: Job, letters: Letters, stop: Stop = never) -> Places:
    """Places of words, and of what is mixed in, the heaviest first."""
    _check(job)
    words = _Ranked.of(job)
    tried = list[tuple[float, Graded]]()
    readable = LEGIBLE * job.container.side / EM_PX
    kept = words.readable_share(readable)
    sizes = words.sizes(kept)
    ways = [(share, False) for share in dict.fromkeys((kept, kept / 2, 0.0))]
    while ways:
        (share, is_held), *ways = ways
        found = _placed(job, letters, words, sizes, share, is_held, stop)
        ink = float((words.inks[found.placed] * found.poses.scale**2).sum())
        shown = float(np.minimum(found.poses.scale / readable, 1).sum()) / len(words.order)
        tried.append((ink * shown, found))
        if stop() or is_held:
            break
        if shown < 1 - MOST_SPECKS and letters.largest is None:
            # Sizes nearer to each other leave the last ones yet less, unless the first is bounded.
            ways = [(share, True)]
        elif ink >= ENOUGH * job.container.outline.area:
            break
    _, found = max(tried, key=lambda one: one[0])
    if len(found.placed) == 0:
        raise RecipeError("container", _no_place(job))
    return words.places(found, letters, job.plan.rotation)


def _no_place(job: Job) -> str:
    """Why no word was placed, and what would do."""
    width = lines_width(job.container)
    said = f"{job.container.source} has no place for any word at a size that could be read"
    if width is None:
        return f"{said}; use a larger canvas, or fewer words"
    unit = job.container.unit
    return f"{said}: it is lines {width:.2g} {unit} wide; use wider ones, or what they enclose"


def can_give_way(job: Job) -> bool:
    """Whether nothing is asked of places or single items that this cannot heed."""
    plan = job.plan
    is_told_where = job.earlier is not None or plan.method or plan.share or job.forces.acts
    is_told = is_told_where or job.plan.keeps_order or job.is_limited
    return not (is_told or needs_levels(job))


_UNHEEDED = (
    "hero", "rules", "start", "force", "arrange", "embeddings", "share", "apart", "stretch",
    "losses", "levels", "epochs", "preset", "finish", "least_dpi",
)  # fmt: skip


def unheeded(job: Job) -> str:
    """Options that are asked for and that this cannot heed, as flags."""
    fields = {key: Recipe.model_fields[key] for key in _UNHEEDED}
    asked = [
        f"--{key.replace('_', '-')}"
        for key, field in fields.items()
        if getattr(job.recipe, key) != field.get_default(call_default_factory=True)
    ]
    return enumerated(asked or ["what is asked of places or single items"], len(_UNHEEDED))


def _check(job: Job) -> None:
    if not can_give_way(job):
        raise RecipeError(
            "sizes",
            f"graded sets words one after another; leave out {unheeded(job)}, or use sizes shared",
        )


@dataclass(frozen=True, eq=False)
class _Ranked:
    """Items with the heaviest first, and their sizes as heights of an em.

    The em of what is no word is the side of a square of its area.

    Parameters
    ----------
    order
        ``(n,)`` numbers of the items.
    unit
        ``(n,)`` scale of each at which its em is ``EM_PX``.
    ratios
        ``(n,)`` true sizes over the one before, the first 1.
    inks
        ``(n,)`` area drawn at that scale.
    widths
        ``(n,)`` width of the outlines at that scale.
    room
        Area that all are to cover, ``FULL`` of the container.
    """

    order: IntArray
    unit: FloatArray
    ratios: FloatArray
    inks: FloatArray
    widths: FloatArray
    room: float

    @classmethod
    def of(cls, job: Job) -> _Ranked:
        """All items of a job."""
        areas = np.array([item.outline.area for item in job.items])
        left, _, right, _ = np.array([item.outline.bounds for item in job.items]).T
        inks = np.array([item.ink.area for item in job.items])
        words = set(job.use.words)
        is_word = np.array([item in words for item in job.items])
        unit = np.where(is_word, 1.0, EM_PX / np.sqrt(areas))
        scales = np.sqrt(job.weights / areas)
        true = scales / unit
        # Words of one weight keep their order, whatever the last digits are.
        order = np.argsort(-np.round(true / true.max(), 9), kind="stable")
        ratios = np.append(1.0, true[order][1:] / true[order][:-1])
        room = FULL * job.container.outline.area
        widths = (right - left)[order] * unit[order]
        return cls(order, unit[order], ratios, inks[order] * unit[order] ** 2, widths, room)

    def steps(self, share: float) -> FloatArray:
        """``(n,)`` sizes over the one before with ``share`` of the steps of weights kept."""
        return share * self.ratios + 1 - share

    def sizes(self, share: float) -> FloatArray:
        """``(n,)`` sizes of such steps, with which all cover the room."""
        own = np.cumprod(self.steps(share))
        return np.asarray(own * math.sqrt(self.room / float((self.inks * own**2).sum())))

    def readable_share(self, least: float) -> float:
        """Share of the steps that is kept where most words can be read."""
        kept = (share for share in NEARER if np.mean(self.sizes(share) >= least) >= MOST)
        return next(kept, NEARER[-1])

    def places(self, found: Graded, letters: Letters, rotation: Rotation) -> Places:
        """The same in the items' own order, in their own units."""
        numbers, unit, size = self.order[found.placed], self.unit[found.placed], found.poses.scale
        # Each may grow to where the one before is now, which itself gets no smaller.
        most = math.inf if letters.largest is None else letters.largest / EM_PX
        before = np.concatenate([GROWN * size[:1], size[:-1]])
        largest = np.maximum(np.minimum(before, most), size)
        back = np.argsort(numbers, kind="stable")
        limits = replace(
            Limits.free(len(numbers)),
            turn_limit=np.full(len(numbers), rotation.farthest),
            smallest=(size * unit)[back],
            largest=(largest * unit)[back],
        )
        poses = replace(found.poses, scale=size * unit).subset(back)
        return Places(numbers[back], poses, limits)


def _placed(
    job: Job,
    letters: Letters,
    words: _Ranked,
    sizes: FloatArray,
    share: float,
    is_held: bool,
    stop: Stop,
) -> Graded:
    """Items put one after another, ``share`` of the steps between their weights kept.

    ``is_held``: none so large that those after it would find no place.
    """
    first = float(sizes[0])
    if letters.largest is not None:
        first = min(first, letters.largest / EM_PX)
    least = letters.smallest / EM_PX if letters.smallest else DWARF * float(sizes[-1])
    return graded_fit(
        job.container,
        _candidates(job, words, first, share),
        len(words.order),
        np.random.default_rng(job.plan.seed),
        smallest=least,
        margin_cu=job.plan.gap + HAIR * job.container.side,
        lengths=words.widths.tolist() if is_held else (),
        stop=stop,
    )


def _candidates(job: Job, words: _Ranked, first: float, share: float) -> Iterator[Candidate]:
    """Items in their order, each with the angles that it may have."""
    rng = np.random.default_rng(job.plan.seed)
    steps = words.steps(share)
    steps[0] = first
    has_kinds = len(set(job.items)) > 1
    for k, unit, step in zip(words.order, words.unit, steps, strict=True):
        outline = job.items[k].outline
        if unit != 1:
            outline = outline.mapped(similarity(0.0, 0.0, 0.0, float(unit)))
        kind = job.items[k] if has_kinds else None
        yield Candidate(outline, float(step), angles_of(job.plan.rotation, rng), kind=kind)


def angles_of(rotation: Rotation, rng: np.random.Generator) -> tuple[float, ...]:
    """Angles to try: one as likely as asked, then all others that there are."""
    if rotation.is_still or rotation.choices:
        first = float(start_angles(1, rotation.limit, rotation.choices, rng)[0])
        others = dict.fromkeys(float(angle) for angle in rotation.choices or () if angle != first)
        return (first, *others)
    return tuple(spread_angles(ANGLES, rotation.limit, rng).tolist())


@final
class GradedPlaces(RunStep):
    """Words whose sizes give way: each as large as it finds a place in its turn."""

    def __init__(self, letters: Letters) -> None:
        self._letters = letters

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the words that find a place; the others count as not drawn."""
        job, words = state.job, words_of(state.job)
        with job.clock.time("start"):
            places = graded_places(job, self._letters, context.stop)
        gone = np.setdiff1d(np.arange(len(job.items)), places.placed)
        kept = places.placed[places.placed < len(words.read.items)]
        lost = without([job.items[k] for k in gone], [job.items[k] for k in kept])
        undrawn = {item.name: Sentence.UNREADABLE_WORD.of() for item in lost}
        read = replace(
            words.read,
            items=tuple(words.read.items[k] for k in kept),
            areas=words.read.areas[kept],
            words=tuple(words.read.words[k] for k in kept),
            undrawn={**undrawn, **words.read.undrawn},
        )
        smaller = replace(
            job.subset(places.placed),
            use=replace(words, read=read, gives_way=True),
            fillers=without(job.fillers, lost),
        )
        check_padding(job.container, job.plan.gap, len(smaller.items))
        return replace(
            RunState.of(smaller), poses=places.poses, nominal=places.poses.scale,
            limits=places.limits, method="first-fit", is_tight=True, is_only_refined=True,
        )  # fmt: skip

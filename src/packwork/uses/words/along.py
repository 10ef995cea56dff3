"""Words along the limbs of a container, and an ordinary cloud in what is wide of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import final

import numpy as np
from shapely.geometry import Polygon

from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.geometry.curves import Curve
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, buffered, difference, union, valid
from packwork.phrasing import number_of
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules
from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps
from packwork.readers.reading import UnfitError
from packwork.readers.words.items import WordsRead
from packwork.readers.words.options import Along
from packwork.readers.words.shaping import EM_PX
from packwork.readers.words.word import Word, sound
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.start.lane_sizes import in_order
from packwork.start.lanes import FILLED, WordOnLine
from packwork.start.limbs import SLENDER, Limb, edges_of, limbs_of
from packwork.uses.words.copies import words_of
from packwork.uses.words.graded import LEGIBLE, can_give_way, unheeded
from packwork.uses.words.line_of_words import SLACK, LineOfWords
from packwork.uses.words.sizes import Letters, without

WIDE = 0.05
"""Share of a container that is a cloud of its own where it is no limb. Smaller puts words into
joints and tips. Chosen."""

LARGER_PART = 0.4
"""Share of words in such a cloud from which it has the heaviest, and the limbs have the others;
else it has the lightest. Chosen."""

BAND = 0.09
"""Width of the band along the edge, over the side of a square of the container's area. By eye."""

RING, MOST_ROUND = 0.13, 0.42
"""The same of rings of text at most, and the share of the edge that one of two texts takes at most.
Larger leaves the words inside less room, smaller is read from less far. By eye."""


@final
class SetAlong(RunStep):
    """Words along limbs, set again until these are full, and a cloud in what is wide.

    Parameters
    ----------
    along
        Whether limbs are those of the container, or bands along its edge.
    cloud
        Steps of an ordinary cloud.
    """

    share = 1.0

    def __init__(
        self, along: Along, letters: Letters, cloud: Callable[[Job], Sequence[RunStep]]
    ) -> None:
        self._along, self._letters, self._cloud = along, letters, cloud

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of these words; what finds no place counts as not drawn."""
        job, read = state.job, words_of(state.job).read
        _check(job, "along")
        gap = job.plan.gap + HAIR * job.container.side
        with job.clock.time("start"):
            limbs = self._limbs(job.container, gap)
            wide = _wide_part(job.container, limbs, gap)
        clouded, poses, rows, found = list[Item](), list[Poses](), list[int](), state
        share = 0.0 if wide is None else wide.area / (wide.area + sum(one.area for one in limbs))
        inside = min(round(share * len(read.items)), len(read.items) - 1)
        if wide is not None and inside:
            # The heaviest lie where most room is.
            heavy = range(inside) if share > LARGER_PART else range(len(read.items))[-inside:]
            found = run_steps(*self._inside(state, heavy, wide), context)
            clouded, poses = list(found.job.items), [found.poses]
            rows = [read.items.index(item) for item in clouded]
        elif not job.plan.rotation.is_still:
            raise RecipeError("rotate", "turns no word that follows a line; leave it out")
        with job.clock.time("start"):
            rest = np.setdiff1d(np.arange(len(read.items)), rows)
            heights = np.sqrt(job.weights / [item.outline.area for item in job.items])
            least = max(self._letters.smallest or 0.0, LEGIBLE * job.container.side)
            line = LineOfWords.of([read.words[k] for k in rest], words_of(job), job.plan.holes)
            lines = line.set_along(limbs, heights[rest], least / SLACK, gap, self._letters.largest)
            settings = in_order(lines, heights[rest])
            bent = line.bent(settings, job.container, gap, context.stop, heights[rest])
        large = np.flatnonzero(bent.poses.scale * EM_PX >= least)
        rows += [int(rest[settings[k].word]) for k in large]
        poses.append(bent.poses.subset(large))
        if not rows:
            raise RecipeError("along", f"leaves no word to be read in {job.container.source}")
        return _joined(found, job, rows, (*clouded, *(bent.items[k] for k in large)), poses)

    def _limbs(self, container: Container, gap: float) -> list[Limb]:
        """Limbs that have room beside the gap, without half of it; one at least."""
        width = BAND * math.sqrt(container.outline.area)
        found = edges_of(container, width) if self._along == "edge" else limbs_of(container)
        if not found:
            raise RecipeError(
                "along",
                f"{container.source} has no limbs: no part of it is {SLENDER:g} times as long as "
                "wide; use edge, or leave it out",
            )
        roomy = [one for one in found if np.median(one.half) > gap]
        if not roomy:
            raise RecipeError("along", f"no limb of {container.source} is wider than the padding")
        return [replace(one, half=np.maximum(one.half - gap / 2, 0.0)) for one in roomy]

    def _inside(
        self, state: RunState, rows: Sequence[int], wide: Region
    ) -> tuple[Sequence[RunStep], RunState]:
        """Steps of a cloud of some words in a part of the container; its first state."""
        job, use = state.job, words_of(state.job)
        read = _subset(use.read, rows, [use.read.items[k] for k in rows])
        part = replace(
            job.subset(rows),
            use=replace(use, read=read),
            container=replace(job.container, outline=Outline.from_region(wide)),
        )
        return self._cloud(part), replace(RunState.of(part), findings=state.findings)


@final
class RoundTheEdge(RunStep):
    """Texts round the inside of a container's edge, top and bottom, and words within.

    Parameters
    ----------
    texts
        One or two.
    words
        Steps that place the words.
    """

    share = 1.0

    def __init__(self, texts: Sequence[str], words: Callable[[Job], Sequence[RunStep]]) -> None:
        self._texts, self._words = texts, words

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the words, and of the texts, which come last."""
        job, use = state.job, words_of(state.job)
        _check(job, "ring")
        gap = job.plan.gap + HAIR * job.container.side
        with job.clock.time("start"):
            texts = [Word(sound(text), 1.0) for text in self._texts]
            width = RING * math.sqrt(job.container.outline.area)
            try:
                line = LineOfWords.of(texts, use, job.plan.holes)
                band, size = self._band(line, job.container, width, gap)
                bent = line.bent(self._settings(line, band, size), job.container, gap, context.stop)
            except UnfitError as error:
                raise RecipeError("ring", f"cannot be set: it {error}") from None
            inner = _wide_part(job.container, [band], gap)
        if inner is None:
            raise RecipeError("ring", f"leaves no room for words in {job.container.source}")
        part = replace(job, container=replace(job.container, outline=Outline.from_region(inner)))
        start = replace(RunState.of(part), findings=state.findings)
        found = run_steps(self._words(part), start, context)
        whole = replace(
            found.job,
            container=job.container,
            items=(*found.job.items, *map(_untold, bent.items)),
            asked=(*found.job.asked, *[ItemRules()] * len(bent.items)),
            weights=np.append(found.job.weights, [item.outline.area for item in bent.items]),
        )
        poses = found.poses.followed_by(bent.poses)
        return replace(
            RunState.of(whole), poses=poses, nominal=poses.scale, method="along", is_tight=True,
            findings=found.findings, conflicts=found.conflicts,
        )  # fmt: skip

    def _band(
        self, line: LineOfWords, container: Container, width: float, gap: float
    ) -> tuple[Limb, float]:
        """Band along the edge, and the size at which all texts have room there."""
        bands = edges_of(container, width)
        if not bands:
            raise RecipeError("ring", f"has no room in {container.source}, which is too thin")
        size = FILLED * (width - gap) / max(shape.height for shape in line.shapes)
        axis = bands[0].axis.length
        most = MOST_ROUND * (2 if len(line.shapes) == 1 else 1) * axis
        longest = max(shape.length_round(axis, size) for shape in line.shapes)
        if longest > most:
            return self._band(line, container, width * max(most / longest, 0.5), gap)
        return replace(bands[0], half=bands[0].half - gap / 2), size

    def _settings(self, line: LineOfWords, band: Limb, size: float) -> list[WordOnLine]:
        """The first text round the top, a second one round the bottom, read from left to right."""
        points = band.axis.points[:-1]
        is_above = points[:, 1] < points[:, 1].mean()
        away = np.where(is_above, np.abs(points[:, 0] - points[0, 0]), np.inf)
        from_above = np.roll(points, -int(np.argmin(away)), axis=0)
        found = list[WordOnLine]()
        for k, shape in enumerate(line.shapes):
            # Round the bottom anticlockwise, from above to above.
            ring = points if k == 0 else from_above[::-1]
            curve = Curve(np.concatenate([ring, ring[:1]]))
            middle = from_above[0] if k == 0 else points[0]
            along = curve.lengths[int(np.argmin(np.hypot(*(curve.points - middle).T)))]
            half = shape.length_round(band.axis.length, size) / 2
            found.append(WordOnLine(k, curve, float(along) - half, float(along) + half, size))
        return found


def _untold(item: Item) -> Item:
    """A text of a ring, whose tooltip tells no weight as a word's does."""
    return replace(item, label=replace(item.label, title=item.name))


def _check(job: Job, key: str) -> None:
    if key == "along" and len(job.use.words) < len(job.items):
        raise RecipeError("along", "sets words alone; leave out what is mixed in with them")
    is_shared = job.recipe.sizes == "shared"
    if is_shared or not can_give_way(job):
        idle = "--sizes shared" if is_shared else unheeded(job)
        raise RecipeError(key, f"gives words the sizes that have room; leave out {idle}")


def _wide_part(container: Container, limbs: Sequence[Limb], gap: float) -> Region | None:
    """Part of a container that is no limb, nor half as thin as one; None where it is little."""
    bands = union([_band(limb, gap) for limb in limbs])
    thin = min(float(np.median(limb.half)) for limb in limbs) / 2
    left = difference(container.outline.region, bands)
    wide = buffered(buffered(left, -thin), thin)
    return wide if wide.area > WIDE * container.outline.area else None


def _band(limb: Limb, gap: float) -> Region:
    """Region of a limb's words, and of half of the gap round them."""
    right, left = (limb.axis.shifted(side * limb.half).points for side in (1.0, -1.0))
    return buffered(valid(Polygon(np.concatenate([right, left[::-1]]))), gap / 2)


def _subset(read: WordsRead, rows: Sequence[int], items: Sequence[Item]) -> WordsRead:
    """Some words, in any order, as other items."""
    return replace(
        read,
        items=tuple(items),
        areas=read.areas[list(rows)],
        words=tuple(read.words[k] for k in rows),
    )


def _joined(
    inner: RunState, job: Job, rows: Sequence[int], items: Sequence[Item], poses: Sequence[Poses]
) -> RunState:
    """State of words in place, each with what was asked of its word; ``inner`` is of a cloud.

    The last of ``poses`` are those on lines.
    """
    use = words_of(job)
    kept = set(rows)
    gone = [item for k, item in enumerate(use.read.items) if k not in kept]
    undrawn = {item.name: Sentence.UNREADABLE_WORD.of() for item in gone}
    read = _subset(use.read, rows, items)
    placed = replace(
        job.subset(rows),
        items=tuple(items),
        use=replace(use, read=replace(read, undrawn={**undrawn, **read.undrawn}), gives_way=True),
        fillers=without(job.fillers, gone),
    )
    whole = poses[0]
    for more in poses[1:]:
        whole = whole.followed_by(more)
    found = replace(
        RunState.of(placed), poses=whole, nominal=whole.scale, method="along", is_tight=True,
        findings=inner.findings, conflicts=inner.conflicts,
    )  # fmt: skip
    if len(rows) == len(kept):
        return found
    many = number_of(len(rows) - len(kept), "word is", "words are")
    elsewhere = "" if use.options.repeat == "auto" else ", and --repeat auto what lies beside it"
    once = len(poses[-1])
    return found.with_finding(Sentence.SET_AGAIN, many=many, count=once, elsewhere=elsewhere)

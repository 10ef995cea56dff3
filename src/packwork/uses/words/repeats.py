"""Words set again, smaller and grey, where nothing else finds a place."""

from __future__ import annotations

from typing import final

import numpy as np

from packwork.compaction.options import HAIR
from packwork.pipeline.findings import Filling, Sentence
from packwork.pipeline.plan.copies import ItemRules
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.progress import Stop, until_over
from packwork.readers.words.shaping import EM_PX, INK
from packwork.recipe.rules import OWN_COLOURS
from packwork.scene.contrast import between, contrast
from packwork.scene.item import Item
from packwork.scene.recolour import recoloured
from packwork.start.first_fit.between import fit_between
from packwork.start.first_fit.greedy_board import Candidate
from packwork.steps.voids import joined_by
from packwork.uses.words.graded import LEGIBLE, angles_of
from packwork.uses.words.sizes import Letters

REPEATED = 0.75
"""Height of a repeated word over that of the word itself, at most: so no weight is told
wrong. Larger fills more. Chosen."""

EACH, AT_LEAST = 3, 100
"""Copies of each word at most, on average, and of few words in all before that counts. More fill
smaller gaps. Chosen: eight words show an apple."""

PALE = 0.6
"""How far the colour of repeated words is from that of ink to that of the paper. Larger hides
them, smaller competes with the words themselves. By eye."""

LIGHT = "#ffffff"
"""Ink on dark paper."""


@final
class RepeatWords(RunStep):
    """Copies of words, smaller and grey, where nothing else finds a place."""

    def __init__(self, letters: Letters, paper: str) -> None:
        self._letters, self._paper = letters, paper

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the copies last among its items; as it is where that is not clean."""
        if not state.is_clean:
            return state
        job, count = state.job, len(state.job.use.words)
        with job.clock.time("gaps"):
            stop = until_over(context.stop, job.seconds_left(1.0))
            return with_repeats(state, count, self._letters, self._paper, stop)


def with_repeats(state: RunState, words: int, letters: Letters, paper: str, stop: Stop) -> RunState:
    """State with copies of its first items, the words, between them."""
    job = state.job
    least = max(letters.smallest or 0.0, LEGIBLE * job.container.side)
    most = max(EACH * words, AT_LEAST)
    own = state.poses.scale[:words]
    rng = np.random.default_rng(job.plan.seed)
    # Light words first: the heavy ones are seen as it is.
    order = np.argsort(own, kind="stable")
    fitting = [int(k) for k in order if REPEATED * own[k] * EM_PX >= least]
    found = fit_between(
        job.container,
        [i.outline.mapped(state.poses.matrix(k)) for k, i in enumerate(job.items)],
        [
            Candidate(
                job.items[k].outline,
                REPEATED * own[k],
                angles_of(job.plan.rotation, rng),
                kind=job.items[k],
            )
            for k in fitting
        ],
        np.full(len(fitting), least / EM_PX),
        rng,
        kinds=job.items,
        margin_cu=job.plan.gap + HAIR * job.container.side,
        most=most,
        stop=stop,
    )
    ink = max((INK, LIGHT), key=lambda one: contrast(one, paper))
    grey = between((ink, paper), PALE)
    known: dict[int, Item] = {}
    for k in map(int, np.unique(found.placed)):
        known[k] = recoloured(job.items[fitting[k]], grey)
    new = [known[int(k)] for k in found.placed]
    numbers = state.numbers
    after = int(numbers.max(initial=-1)) + 1
    poses = state.poses.followed_by(found.poses)
    areas = np.array([i.outline.area for i in (*job.items, *new)]) * poses.scale**2
    covered = float(areas.sum()) / job.container.outline.area
    said = Sentence.MOST_REPEATS if len(new) == most else Sentence.NO_GAP
    ending = said.of(least=least, unit=job.container.unit, most=most)
    return joined_by(
        state,
        new,
        [ItemRules(values={"color": OWN_COLOURS})] * len(new),
        poses,
        np.append(numbers, after + np.arange(len(new))),
        Filling(len(new), ending, covered, None),
    )

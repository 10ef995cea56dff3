"""Clouds of words whose words or weights changed: poured anew where settling left them emptier."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import PackworkError
from packwork.live.anew import job_again, poured_again
from packwork.live.certificate import Certificate
from packwork.live.commands.command import Library
from packwork.live.composed import is_word
from packwork.live.document import PROPERTIES, Document
from packwork.metrics.shape import shape_metrics
from packwork.progress import Stop
from packwork.steps.advice import LEAST_SHAPE, MOST_BARE, advice

MOST_LOST = 0.02
"""Share of the container by which less may be covered after a change than before it, and by which
more has to be covered by a run. Smaller moves all words for what is hardly seen. Chosen."""

MOST_NEW = 0.5
"""Share of the words that are new from which on nothing is settled first: it takes as long as
several runs, and leaves all of them small. Chosen."""


@dataclass(frozen=True)
class Refilled:
    """A cloud that was poured anew.

    Parameters
    ----------
    document
        With the new poses.
    said
        That it was, in a sentence.
    """

    document: Document
    said: str


def is_other_cloud(before: Document, now: Document) -> bool:
    """Whether most words of a cloud are others than before."""
    if not _is_cloud(now):
        return False
    known = {item.outline for item in before.items}
    return sum(item.outline not in known for item in now.items) > MOST_NEW * len(now)


def refilled(before: Document, settled: Document, given: IntArray, stop: Stop) -> Refilled | None:
    """What a run makes of a cloud, where that covers plainly more than it did; else None.

    Parameters
    ----------
    before
        As it was before words, weights or letters changed.
    settled
        As it is now.
    given
        ``(m,)`` rows of what the hand has put where it is.
    stop
        Asked by the run; None where it comes true.
    """
    if not _is_cloud(settled) or not _is_reweighed(before, settled):
        return None
    is_other = is_other_cloud(before, settled)
    if not is_other and covered(settled) >= covered(before) - MOST_LOST:
        return None
    held = settled.held.copy()
    held[given, PROPERTIES.index("place")] = True
    try:
        arranged = poured_again(replace(settled, held=held), 0, stop=stop)
        poured = arranged.applied(settled, Library())
    except PackworkError:
        # What is held leaves no room for a run: what was settled stands.
        return None
    is_wrong, was_wrong = (bool(Certificate().violations(one)) for one in (poured, settled))
    is_fuller = was_wrong or covered(poured) > covered(settled) + MOST_LOST
    if stop() or is_wrong or not is_fuller:
        return None
    share = f"{100 * covered(poured):.0f} % of the container"
    return Refilled(poured, f"the words were poured anew, for they would not fill it else: {share}")


def advice_of(document: Document) -> tuple[str, ...]:
    """What is poor in a layout as it stands, and what would do, as after a run."""
    if len(document) == 0:
        return ()
    layout = document.layout
    seen = shape_metrics(layout.outlines, document.container)
    if seen.bare <= MOST_BARE and seen.shape >= LEAST_SHAPE:
        # No job is read for nothing.
        return ()
    try:
        return advice(job_again(document, 0, {}), len(layout.items), seen)
    except PackworkError:
        return ()


def covered(document: Document) -> float:
    """Share of the container that items cover."""
    areas = document.own_areas * document.poses.scale**2
    return float(areas.sum()) / document.container.outline.area


def _is_cloud(document: Document) -> bool:
    """Whether there are words, in proportion to each other."""
    has_words = any(is_word(document, k) for k in range(len(document)))
    return has_words and document.options.sizes == "shared"


def _is_reweighed(before: Document, now: Document) -> bool:
    """Whether words are others, or weigh otherwise."""
    outlines = [[item.outline for item in one.items] for one in (before, now)]
    return outlines[0] != outlines[1] or not np.array_equal(now.weights, before.weights)

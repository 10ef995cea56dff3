"""Clouds of words whose words or weights changed: poured anew where settling left them emptier."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import PackworkError
from packwork.live.certificate import Certificate, promise_of
from packwork.live.chart_groups import sent_home, stray
from packwork.live.commands.command import Library
from packwork.live.document import Document
from packwork.live.ground import advice_on_picture
from packwork.live.macros import word_rows
from packwork.live.relayout import gives_way, job_again, poured_again
from packwork.metrics.pixel import shape_metrics
from packwork.progress import Stop
from packwork.steps.shortfalls import LEAST_SHAPE, MOST_BARE, advice

MOST_LOST = 0.02
"""Share of the container by which less may be covered after a change than before it, and by which
more has to be covered by a run. Smaller moves all words for what is hardly seen. Chosen."""

MOST_RUINED = 0.1
"""Share of the container by which less may be covered after a gesture that is kept. Larger lets one
word that is moved make specks of all others, smaller takes back what people want all the same.
Chosen."""

ROUNDING = 1e-3
"""The same, of what they covered, of marks of a chart. Derived: far above the digits of files."""

SEEDS = 3
"""Runs that are tried at most until one places all and fills it as before. More take longer.
Chosen."""

MOST_NEW = 0.5
"""Share of the words that are new from which on nothing is settled first: it takes as long as
several runs, and leaves all of them small. Chosen."""


OF_ITEMS = ("items", "ids", "poses", "weights", "smallest", "largest", "held")
"""Names of what a document has for each item."""


@dataclass(frozen=True)
class Refilled:
    """Document that was poured anew, or whose step was taken back, and what is said of it."""

    document: Document
    message: str


def is_other_cloud(before: Document, now: Document) -> bool:
    """Whether most words of a cloud are others than before."""
    if now.options.sizes != "shared" or not word_rows(now):
        return False
    known = {item.outline for item in before.items}
    return sum(item.outline not in known for item in now.items) > MOST_NEW * len(now)


def refilled(
    before: Document, asked: Document, settled: Document, by_hand: IntArray, stop: Stop
) -> Refilled | None:
    """Cloud as a run makes it anew, where that covers plainly more than it did; else None.

    Parameters
    ----------
    before
        As it was before gestures, or words, weights or letters changed.
    by_hand
        ``(m,)`` rows of what the hand has put where it is in ``asked``, turned or sized: it stays.
    """
    is_other = (
        before.container is not asked.container
        or _has_other_outlines(before, asked)
        or not np.array_equal(asked.weights, before.weights)
    )
    if asked.options.sizes != "shared" or asked.kind.refusal or not (len(by_hand) or is_other):
        return None
    was_wrong = bool(Certificate().violations(settled))
    is_fuller = settled.covered >= before.covered - MOST_LOST and not was_wrong
    if is_fuller and not is_other_cloud(before, asked):
        return None
    held = asked.held.copy()
    # Where sizes are promised to be in shares, those of the hand stay so beside all others.
    held[by_hand] |= [True, True, not promise_of(asked).areas_in_shares]
    # In proportion as they are, unless a run may find what else sizes gave way to.
    weights = asked.weights if gives_way(asked) and is_other else asked.areas
    pinned = replace(asked, held=held, weights=weights)
    # Of other words nobody knows how far they can fill it.
    aim = 0.0 if is_other_cloud(before, asked) else before.covered - MOST_LOST
    fullest = None
    for seed in range(SEEDS):
        try:
            poured = poured_again(pinned, seed, stop=stop).applied(pinned, Library())
        except PackworkError:
            # What is held leaves no room for this run.
            break
        if stop():
            return None
        kept = replace(poured, held=asked.held, weights=asked.weights)
        if Certificate().in_the_way(kept):
            continue
        if fullest is None or kept.covered > fullest.covered:
            fullest = kept
        # Of few words one run may fill less by a fifth than the next.
        if fullest.covered >= aim:
            break
    if fullest is None:
        return None
    if not was_wrong and fullest.covered <= settled.covered + MOST_LOST:
        return None
    what = "words" if word_rows(asked) else "items"
    share = f"{100 * fullest.covered:.0f} % of the container"
    message = f"the {what} were poured anew, for they would not fill it else: {share}"
    return Refilled(fullest, message)


def sent_back(before: Document, asked: Document) -> Refilled | None:
    """Marks of a chart in other groups' parts put back, where items came or went; else None.

    Where none did, all of them are taken back once they are settled.
    """
    if not _has_others(before, asked) or (home := sent_home(before, asked)) is asked:
        return None
    return Refilled(home, f"taken back, for {stray(before, asked)}")


def taken_back(before: Document, now: Document, *, is_wrong: bool) -> Refilled | None:
    """Layout without a gesture for which all items would become much smaller; None if none would.

    Marks of a chart do not become smaller at all, for their keys say how large they are. Where
    items that keep their sizes find no room (``is_wrong``), that is taken back too. Where a mark
    is left in another group's part although items came or went, these do not either.
    """
    has_no_room = is_wrong and now.kind.keeps_all
    is_shared = now.options.sizes == "shared"
    if not (is_shared or has_no_room) or before.container is not now.container:
        return None
    elsewhere = stray(before, now)
    if _has_others(before, now):
        # Other letters do not lie where those before did.
        columns = {name: getattr(before, name) for name in OF_ITEMS}
        message = f"taken back, for {elsewhere}"
        return Refilled(replace(now, **columns), message) if elsewhere else None
    share = [100 * one.covered for one in (before, now)]
    least = 1 - ROUNDING if now.kind.refusal else (share[0] - 100 * MOST_RUINED) / share[0]
    if share[1] >= share[0] * least and not (has_no_room or elsewhere):
        return None
    names = ("poses", "weights", "smallest", "largest", *["options"] * has_no_room)
    columns = {name: getattr(before, name) for name in names}
    # Words say how often they were counted, which is theirs with their weights.
    columns["items"] = tuple(
        item if item.label.title == was.label.title else replace(item, label=was.label)
        for item, was in zip(now.items, before.items, strict=True)
    )
    why = f"all would become smaller: {share[0]:.0f} to {share[1]:.0f} % covered"
    if has_no_room:
        why = "there is no room for it at these sizes"
    return Refilled(replace(now, **columns), f"taken back, for {elsewhere or why}")


def advice_of(document: Document) -> tuple[str, ...]:
    """Advice on a layout as it stands: what is poor and what would do, as after a run."""
    return (*_advice_on_shape(document), *advice_on_picture(document))


def _advice_on_shape(document: Document) -> tuple[str, ...]:
    if len(document) == 0 or not document.kind.shows_shape:
        return ()
    layout = document.layout
    seen = shape_metrics(layout.outlines, document.container)
    if seen.bare <= MOST_BARE and seen.shape >= LEAST_SHAPE:
        # No job is read for nothing.
        return ()
    try:
        found = advice(job_again(document, 0, {}), len(layout.items), seen)
        return () if found is None else (str(found),)
    except PackworkError:
        return ()


def _has_others(before: Document, now: Document) -> bool:
    """Whether items came, went or changed their outlines."""
    return not np.array_equal(before.ids, now.ids) or _has_other_outlines(before, now)


def _has_other_outlines(before: Document, now: Document) -> bool:
    outlines = [[item.outline for item in one.items] for one in (before, now)]
    return outlines[0] != outlines[1]

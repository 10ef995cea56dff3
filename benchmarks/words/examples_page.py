"""The peer's examples by either package: that part of docs/benchmarks/words.md."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from benchmarks.kit.manifests import Manifest
from benchmarks.kit.measuring import lasting, markdown_table, plainly
from benchmarks.words.composition import BLUR
from packwork.metrics.pixel import REACH

NONE = "-"
SLOWER, FLATTER, FULLER = 4.0, 0.8, 1.1
"""What is sought: at most so many times the peer's seconds, at least such shares of its largest
size over the median, and of its ink in the same font."""

HEADER = [
    "example", "words", "the peer's", "largest / median", "the peer's", "ink", "the peer's",
    "in our font", "first", "the peer's", "ratio", "again", "the peer's", "ratio",
]  # fmt: skip

COMPOSED = {"inwards": "{:.2f}", "uneven": "{:.2f}", "near": "{:.1%}", "gap": "{:.2f}"}
"""Columns of the second table, and how they are written."""

COMPOSITION_TEXT = f"""Composition: "inwards" is the mean distance of ink, weighed by the size of
its word, from where the free area is widest, over that of the free area itself (1 is spread evenly,
less is nearer to the middle); "uneven" the standard deviation of the share of ink round each free
pixel, over its mean, in a window of {100 * BLUR:g} % of the side of a square of that area. The
shape: "near" is the share of the free area within {100 * REACH:g} % of its longer side from ink,
"gap" the radius of the largest empty disc over that of the free area's largest."""

Pair: TypeAlias = tuple[Manifest, Manifest]
"""Ours and the peer's."""


def body(section: Manifest) -> str:
    """Table, what is reached, and what did not run."""
    found = section["examples"]
    alike = {name: pair for name, one in section.get("one_font", {}).items() if (pair := done(one))}
    pairs = {name: pair for name, one in found.items() if (pair := done(one))}
    rows = [_row(name, *pair, alike.get(name)) for name, pair in pairs.items()]
    parts = [markdown_table(HEADER, rows), reached(list(pairs.values()), list(alike.values()))]
    parts += composed(pairs)
    lines = [
        f"- {name}, {program}: {_why_not(one)}"
        for name, programs in found.items()
        for program, one in programs.items()
        if name not in pairs
    ]
    return "\n\n".join([*parts, *(["\n".join(lines)] if lines else [])])


def done(programs: Manifest) -> Pair | None:
    """Ours and the peer's, if both came to an end."""
    if any("clouds" not in one for one in programs.values()):
        return None
    return programs["packwork"], programs["wordcloud"]


def reached(pairs: Sequence[Pair], alike: Sequence[Pair]) -> str:
    """In how many what is sought is reached, clouds of a program counted each by itself."""
    slower = [own["seconds"][0] / peer["seconds"][0] for own, peer in pairs]
    flatter = [_hierarchy(own) / _hierarchy(peer) for own, peer in _clouds(pairs)]
    fuller = [own["ink"] / peer["ink"] for own, peer in _clouds(alike)]
    said = [
        f"the first run at most {SLOWER:g} times the peer's in "
        f"{sum(one <= SLOWER for one in slower)} of {len(slower)} programs",
        f"largest / median at least {FLATTER:g} of the peer's in "
        f"{sum(one >= FLATTER for one in flatter)} of {len(flatter)} clouds",
        f"ink in one font at least {FULLER:g} times the peer's in "
        f"{sum(one >= FULLER for one in fuller)} of {len(fuller)}",
    ]
    return f"Ours: {'; '.join(said)}."


def composed(pairs: Mapping[str, Pair]) -> list[str]:
    """Where weight lies and whether the shape shows, a cloud a row; nothing if not measured."""
    rows = [
        [name, *(form.format(one[key]) for key, form in COMPOSED.items() for one in cloud)]
        for name, pair in pairs.items()
        for cloud in _clouds([pair])
        if all(COMPOSED.keys() <= one.keys() for one in cloud)
    ]
    header = ["example", *(said for key in COMPOSED for said in (key, "the peer's"))]
    return [COMPOSITION_TEXT, markdown_table(header, rows)] if rows else []


def _clouds(pairs: Sequence[Pair]) -> Iterator[Pair]:
    for own, peer in pairs:
        yield from zip(own["clouds"], peer["clouds"], strict=False)


def _hierarchy(cloud: Manifest) -> float:
    return float(cloud["largest"] / cloud["median"])


def _why_not(one: Manifest) -> str:
    if "lacks" in one:
        return f"not run: lacks {one['lacks']}"
    if "fails" in one:
        return f"stops with `{one['fails']}`"
    return f"runs, {lasting(one['seconds'])}, words: {_each(one, _words)}"


def _row(name: str, own: Manifest, peer: Manifest, alike: Pair | None) -> list[str]:
    def both(said: Callable[[Manifest], str]) -> list[str]:
        return [_each(own, said), _each(peer, said)]

    def spent(part: slice) -> list[str]:
        ours, theirs = own["seconds"][part], peer["seconds"][part]
        if not ours:
            return [NONE] * 3
        ratio = float(np.median(ours)) / float(np.median(theirs))
        return [lasting(ours), lasting(theirs), plainly(ratio)]

    return [
        name, *both(_words), *both(lambda cloud: f"{_hierarchy(cloud):.1f}"), *both(_ink),
        NONE if alike is None else _each(alike[1], _ink), *spent(slice(1)), *spent(slice(1, None)),
    ]  # fmt: skip


def _each(one: Manifest, said: Callable[[Manifest], str]) -> str:
    return "; ".join(said(cloud) for cloud in one["clouds"])


def _words(cloud: Manifest) -> str:
    return f"{cloud['words']:,}"


def _ink(cloud: Manifest) -> str:
    return f"{cloud['ink']:.3f}"

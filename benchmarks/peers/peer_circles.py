"""Circles round each other: d3-hierarchy, packcircles, circlify."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from benchmarks.kit import node
from benchmarks.kit.circles import RADII, deepest, density, front_chain, packed
from benchmarks.kit.manifests import Manifest
from benchmarks.peers.peering import RUNS, entry, limited, missing, repeated, timed_out, version
from packwork.arrays import FloatArray

COUNTS = (10, 100, 1_000)
LIMIT = 60.0
"""Seconds of the processor for one run of a peer."""


def measure(counts: Sequence[int] = COUNTS) -> list[Manifest]:
    """All programs on all radii."""
    absent = [missing(name, f"pip install {name}") for name in PEERS if version(name) is None]
    if node.version("d3-hierarchy") is None:
        absent.append(missing("d3-hierarchy", "packwork bench peers install"))
    packed(np.ones(3), 0)
    return [
        *absent,
        *(one for task in RADII for count in counts for one in _on(task, count)),
    ]


def _on(task: str, count: int) -> Iterator[Manifest]:
    """All programs on the radii of one seed; ours with five seeds of its own."""
    radii = RADII[task](0, count)
    found, seconds = repeated(lambda seed: packed(radii, seed))
    yield _entry("packwork", str(version("packwork")), task, found, seconds)
    for name, pack in PEERS.items():
        known = version(name)
        if known is not None:
            yield _peer(name, known, task, radii, pack)
    known = node.version("d3-hierarchy")
    if known is not None:
        done = node.run("circles.mjs", {"radii": radii.tolist(), "runs": RUNS})
        circles = [np.array(done["circles"])]
        yield _entry("d3-hierarchy", known, task, circles, done["seconds"])


def _peer(
    name: str,
    known: str,
    task: str,
    radii: FloatArray,
    pack: Callable[[FloatArray], FloatArray],
) -> Manifest:
    """A peer in Python; none of them takes a seed."""

    def call(seed: int) -> tuple[FloatArray, float]:
        del seed
        began = time.process_time()
        circles = pack(radii)
        return circles, time.process_time() - began

    try:
        # Not timed: while a limit is set the processor's clock goes by ticks.
        with limited(LIMIT):
            pack(radii)
    except TimeoutError:
        return timed_out(name, known, task, len(radii), LIMIT)
    found, seconds = repeated(call)
    return _entry(name, known, task, found[:1], seconds)


def _circlified(radii: FloatArray) -> FloatArray:
    """Circles whose areas are as the radii's: in a unit circle, their sizes its own choice."""
    import circlify

    return np.array([(c.x, c.y, c.r) for c in circlify.circlify((radii**2).tolist())])


PEERS = {"packcircles": front_chain, "circlify": _circlified}


def _entry(
    program: str, known: str, task: str, found: list[FloatArray], seconds: list[float]
) -> Manifest:
    figures = {
        "density": [density(circles) for circles in found],
        "deepest": [deepest(circles) for circles in found],
    }
    return entry(program, known, task, len(found[0]), seconds, figures)

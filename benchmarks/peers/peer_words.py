"""Clouds of the same words: ``wordcloud`` in any container, ``d3-cloud`` in rectangles."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.kit import node
from benchmarks.kit.manifests import Manifest
from benchmarks.peers.peering import RUNS, entry, missing, version
from benchmarks.words.clouds import (
    FONT,
    FREE_SIZES,
    SIDE_PX,
    Cloud,
    figures,
    our_free,
    ours,
    peer,
    proportional_peer,
    vocabulary,
)
from packwork import precompile
from packwork.readers.container import read_container
from packwork.scene.container import Container

COUNT = 100
CONTAINERS = ("square", "heart")
RECTANGLE = "square"
"""The container that d3-cloud can fill."""

FAMILY = "Inter Display Black"
HALVINGS = 7
"""Of the range in which the largest size of d3-cloud's letters is sought."""

ALONE = 100
"""Grey of a pixel that one word covers; two words give twice as much."""


def measure() -> list[Manifest]:
    """All programs, the same words."""
    weights = vocabulary(COUNT)
    precompile.warm_up()
    found = []
    peers: dict[str, Callable[[Container, dict[str, float]], Cloud]] = {}
    if version("wordcloud") is None:
        found.append(missing("wordcloud", "pip install packwork[bench]"))
    else:
        peers = {"wordcloud": peer, "wordcloud (scaling 1)": proportional_peer}
    for name in CONTAINERS:
        container = read_container(name)
        mine = {"packwork": ours, f"packwork ({FREE_SIZES})": our_free}
        for program, make in mine.items():
            found.append(_entry(program, str(version("packwork")), container, weights, make))
        for program, make in peers.items():
            known = str(version("wordcloud"))
            found.append(_entry(program, known, container, weights, make))
    known = node.version("d3-cloud")
    if known is None:
        found.append(missing("d3-cloud", "packwork bench peers install"))
    else:
        found.append(_d3(read_container(RECTANGLE), weights, known))
    return found


def _entry(
    program: str,
    known: str,
    container: Container,
    weights: dict[str, float],
    make: Callable[[Container, dict[str, float]], Cloud],
) -> Manifest:
    """The same seed in each run: what differs is the time alone."""
    clouds = [make(container, weights) for _ in range(RUNS)]
    found = figures(container, weights, clouds[0])
    if clouds[0].overlap is not None:
        found["overlap"] = clouds[0].overlap
    return entry(
        program, known, container.name, len(weights), [cloud.seconds for cloud in clouds],
        {key: [value] for key, value in found.items()},
    )  # fmt: skip


def _d3(container: Container, weights: dict[str, float], known: str) -> Manifest:
    """At the largest size of letters at which it places all words: it takes sizes as given."""
    low, high = 0.0, 0.5 * SIDE_PX
    with tempfile.TemporaryDirectory() as folder:
        drawing = Path(folder, "cloud.png")
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            done = _placed(weights, middle, 0, drawing)
            low, high = (middle, high) if len(done["words"]) == len(weights) else (low, middle)
        done = _placed(weights, low, RUNS, drawing)
        with Image.open(drawing) as image:
            grey = np.asarray(image.convert("L"), dtype=np.int64)
    heights = {text: size for text, size, *_ in done["words"]}
    cloud = Cloud("d3-cloud", len(heights), grey > ALONE / 2, heights, done["seconds"][0])
    found = figures(container, weights, cloud)
    found["overlap"] = float((grey > 1.5 * ALONE).sum() / grey.size)
    return entry(
        "d3-cloud", known, container.name, len(weights), done["seconds"],
        {key: [value] for key, value in found.items()},
    )  # fmt: skip


def _placed(weights: dict[str, float], size: float, runs: int, drawing: Path) -> Manifest:
    largest = max(weights.values())
    return node.run(
        "words.mjs",
        {
            "words": [[word, size * weight / largest] for word, weight in weights.items()],
            "width": SIDE_PX, "height": SIDE_PX, "font": str(FONT), "family": FAMILY,
            "runs": runs, "drawing": str(drawing), "alone": ALONE,
        },
    )  # fmt: skip

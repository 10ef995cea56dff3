"""Clouds of the same words by ours and by the ``wordcloud`` package, and their measures."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy import ndimage

from benchmarks.kit.manifests import Manifest
from packwork import uses
from packwork.geometry.outline import joined
from packwork.metrics.pixel import REACH
from packwork.raster.membership import centre_count
from packwork.readers.container import read_container
from packwork.readers.words.options import WordOptions
from packwork.readers.words.source import read_words
from packwork.scene.container import Container

ROOT = Path(__file__).parents[2]
FONT = ROOT / "src" / "packwork" / "bundled" / "fonts" / "InterDisplay-Black.otf"
SIDE_PX = 1_200
CANVAS_PX = 600
"""Side of the canvas on which gaps are told."""

ZIPF = 0.35
FREE_SIZES, SIZE_RATIO = "sizes free", 4.0
GRADED_SIZES, AUTO_SIZES = "sizes graded", "sizes auto"
SYLLABLES = ("ba", "den", "fo", "gri", "lo", "mar", "nu", "pes", "qua", "ri", "sto", "ven")


@dataclass(frozen=True)
class Cloud:
    """One result: which program, what it drew and what it took.

    Parameters
    ----------
    placed
        How many words are there.
    ink
        ``(rows, columns)`` pixels that are drawn on.
    heights
        Of the words that are there, in any unit.
    seconds
        Of the processor.
    overlap, outside
        Exact areas, shares of the container; None where they are not known.
    certified
        Whether the run's certificate holds; None where there is none.
    """

    program: str
    placed: int
    ink: np.ndarray
    heights: dict[str, float]
    seconds: float
    overlap: float | None = None
    outside: float | None = None
    certified: bool | None = None


def vocabulary(count: int) -> dict[str, float]:
    """Lower-case words of the gallery, then made-up ones, with Zipf-like weights."""
    examples = ROOT / "examples"
    sources = [*sorted(examples.glob("words-*/words.csv")), examples / "words-bird" / "raven.txt"]
    texts = [
        word.text.lower()
        for source in sources
        for word in read_words(WordOptions(source=str(source), count=5_000))
    ]
    plain = [text for text in dict.fromkeys(texts) if text.isascii() and text.isalpha()]
    rng = np.random.default_rng(0)
    mixed = [str(word) for word in rng.permutation(sorted(plain))[:count]]
    while len(mixed) < count:
        made_up = "".join(rng.choice(SYLLABLES, size=rng.integers(2, 5)))
        mixed += [made_up] if made_up not in mixed else []
    return {word: (rank + 1.0) ** -ZIPF for rank, word in enumerate(mixed)}


def ours(container: Container, weights: dict[str, float], **options: Any) -> Cloud:
    """Ours without padding, one word in four vertical; sizes true unless asked otherwise."""
    began = time.process_time()
    recipe = uses.words_recipe(
        container.name,
        weights,
        count=len(weights),
        padding="0",
        rotate="mixed",
        **{"sizes": "shared", **options},
    )
    run = uses.fill(recipe, container=container)
    seconds = time.process_time() - began
    layout, exact = run.layout, run.metrics.exact
    names = [item.name for item in layout.items]
    return Cloud(
        f"packwork, sizes {options['sizes']}" if "sizes" in options else "packwork",
        len(layout.items) - len(run.unplaced),
        pixels(layout.inks, container),
        dict(zip(names, layout.poses.scale.tolist(), strict=True)),
        seconds,
        exact.overlap,
        exact.exceeding,
        run.certified,
    )


def our_free(container: Container, weights: dict[str, float]) -> Cloud:
    """Ours with sizes that give way as it comes."""
    return ours(container, weights, sizes="free", size_ratio=SIZE_RATIO)


def our_graded(container: Container, weights: dict[str, float]) -> Cloud:
    """Ours with sizes that give way in rank order, as the peer's do."""
    return ours(container, weights, sizes="graded")


def our_choice(container: Container, weights: dict[str, float]) -> Cloud:
    """Ours with the default of ``packwork words``."""
    return ours(container, weights, sizes="auto")


def peer(container: Container, weights: dict[str, float], relative_scaling: Any = "auto") -> Cloud:
    """The peer with its defaults, in the same font."""
    import wordcloud

    inside = pixels([container.outline], container)
    began = time.process_time()
    cloud = wordcloud.WordCloud(
        font_path=str(FONT),
        mask=np.where(inside, 0, 255).astype(np.uint8),
        max_words=len(weights),
        random_state=0,
        relative_scaling=relative_scaling,
        mode="RGB",
        background_color="white",
        color_func=lambda *_, **__: "black",
    ).generate_from_frequencies(weights)
    shown = np.asarray(cloud.to_array())[..., 0] < 128
    seconds = time.process_time() - began
    heights = {word: float(size) for (word, _), size, *_ in cloud.layout_}
    name = "wordcloud" if relative_scaling == "auto" else f"wordcloud, scaling {relative_scaling}"
    return Cloud(name, len(heights), shown, heights, seconds)


def proportional_peer(container: Container, weights: dict[str, float]) -> Cloud:
    """The peer asked for sizes in proportion, as ours are."""
    return peer(container, weights, 1)


def pixels(outlines: Sequence[Any], container: Container) -> np.ndarray:
    """``(rows, columns)`` which pixels some of the outlines have, the longer side ``SIDE_PX``."""
    scale = SIDE_PX / container.side
    shape = (round(container.height * scale), round(container.width * scale))
    points, starts = joined(outlines)
    return np.asarray(centre_count(points * scale, starts, shape)) > 0


def figures(container: Container, weights: dict[str, float], cloud: Cloud) -> dict[str, float]:
    """What a cloud is worth: ink, sizes, gaps, and how much of the container is near a word."""
    inside = pixels([container.outline], container)
    shown = cloud.ink & inside
    px_per_canvas = CANVAS_PX / SIDE_PX
    distance = ndimage.distance_transform_edt(~shown) * px_per_canvas
    room = np.minimum(distance, ndimage.distance_transform_edt(inside) * px_per_canvas)
    ratios = np.array([height / weights[word] for word, height in cloud.heights.items()])
    # Against the largest word's, as a reader compares.
    first = next(iter(weights))
    off = ratios / (cloud.heights.get(first, np.nan) / weights[first]) - 1
    reach = REACH * container.outline.extent / container.side * CANVAS_PX
    return {
        "placed": cloud.placed,
        "ink": float(shown.sum() / inside.sum()),
        "off": float(np.median(np.abs(off))),
        "gap": float(room.max()),
        "LnU": float(np.mean(distance[inside & ~shown] ** 2)),
        "near": float(np.mean(distance[inside] <= reach)),
    }


def record(container: Container, weights: dict[str, float], cloud: Cloud) -> Manifest:
    """A cloud's row, as manifests hold it; printed as it comes."""
    found = {
        "container": container.name,
        "words": len(weights),
        "program": cloud.program,
        **figures(container, weights, cloud),
        "overlap": cloud.overlap,
        "outside": cloud.outside,
        "certified": cloud.certified,
        "seconds": cloud.seconds,
    }
    print(found, flush=True)
    return found


def records(
    containers: Sequence[Container | str], count: int, programs: Sequence[Any]
) -> list[Manifest]:
    """Rows of several containers, each by all programs in turn."""
    weights = vocabulary(count)
    found = []
    for one in containers:
        container = read_container(one) if isinstance(one, str) else one
        found += [record(container, weights, make(container, weights)) for make in programs]
    return found

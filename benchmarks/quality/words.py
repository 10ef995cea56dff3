"""Word clouds beside the ``wordcloud`` package: ``packwork bench words [CONTAINER...] [100|400]``.

Same words, weights, font and container in one run; ours with ``padding 0`` and one word in four
vertical, once more with sizes that give way, the peer with its defaults, and once more asked for
sizes in proportion. Without
arguments all rows are run and the tables are written to docs/benchmarks-words.md. The peer
comes with ``pip install '.[bench]'``.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from scipy import ndimage

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from packwork import pipeline, uses
from packwork.geometry.outline import joined
from packwork.raster.membership import centre_count
from packwork.readers.container import read_container
from packwork.readers.words.options import WordOptions
from packwork.readers.words.source import read_words
from packwork.scene.container import Container

ROOT = Path(__file__).parents[2]
FONT = ROOT / "src" / "packwork" / "bundled" / "fonts" / "InterDisplay-Black.otf"
CONTAINERS = ("bird", "bear", "dragon", "cat", "heart")
COUNTS = (100, 400)
SIDE_PX = 1_200
ZIPF = 0.35
FREE_SIZES, SIZE_RATIO = "sizes free", 4.0

HEADER = [
    "container", "words", "program", "placed", "ink", "sizes off by", "largest gap", "L-nU",
    "overlap", "outside", "seconds",
]  # fmt: skip

PAGE = """# Word clouds

Made by `packwork bench words` on {date}.
{machine}.

Weights are 1 / rank^0.35, heights of letters. "ink" is the share of the container's pixels that is
drawn on, at 1,200 px; "sizes off by" the median distance of a word's height from its share, in
percent of it. The peer shrinks words that find no place; in "sizes free" ours give way too
(`--sizes free --size-ratio {ratio}`); "scaling 1" is the peer with `relative_scaling=1`, which asks
for sizes in proportion. The largest gap is the radius of the largest empty disc and L-nU the mean
squared distance from empty pixels to the nearest ink, both on a canvas of 600 px. Overlap and
outside are exact areas of ours, shares of the container; the peer writes pixels. Seconds are
the processor's, reading and measuring taken in, on a machine that others use too.

{table}
"""


@dataclass(frozen=True)
class Cloud:
    """One result."""

    program: str
    placed: int
    ink: np.ndarray
    heights: dict[str, float]
    seconds: float
    overlap: str = "-"
    outside: str = "-"


def vocabulary(count: int) -> dict[str, float]:
    """Lower-case words of the gallery, with Zipf-like weights."""
    examples = ROOT / "examples"
    sources = [*sorted(examples.glob("words-*/words.csv")), examples / "words-bird" / "raven.txt"]
    texts = [
        word.text.lower()
        for source in sources
        for word in read_words(WordOptions(source=str(source), count=5_000))
    ]
    plain = [text for text in dict.fromkeys(texts) if text.isascii() and text.isalpha()]
    assert len(plain) >= count, len(plain)
    mixed = np.random.default_rng(0).permutation(sorted(plain))[:count]
    return {str(word): (rank + 1.0) ** -ZIPF for rank, word in enumerate(mixed)}


def ours(container: Container, weights: dict[str, float], **options: Any) -> Cloud:
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
        f"packwork, {FREE_SIZES}" if options else "packwork",
        len(layout.items) - len(run.unplaced),
        pixels(layout.inks, container),
        dict(zip(names, layout.poses.scale.tolist(), strict=True)),
        seconds,
        f"{exact.overlap:.0e}",
        f"{exact.exceeding:.0e}",
    )


def our_free(container: Container, weights: dict[str, float]) -> Cloud:
    """Ours with sizes that give way, as the peer's do."""
    return ours(container, weights, sizes="free", size_ratio=SIZE_RATIO)


def peer(container: Container, weights: dict[str, float], relative_scaling: Any = "auto") -> Cloud:
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
    scale = SIDE_PX / container.side
    shape = (round(container.height * scale), round(container.width * scale))
    points, starts = joined(outlines)
    return np.asarray(centre_count(points * scale, starts, shape)) > 0


def figures(container: Container, weights: dict[str, float], cloud: Cloud) -> dict[str, float]:
    """What a cloud is worth: ink, sizes, gaps."""
    inside = pixels([container.outline], container)
    shown = cloud.ink & inside
    distance = ndimage.distance_transform_edt(~shown) * (600 / SIDE_PX)
    room = np.minimum(distance, ndimage.distance_transform_edt(inside) * (600 / SIDE_PX))
    ratios = np.array([height / weights[word] for word, height in cloud.heights.items()])
    # Against the largest word's, as a reader compares.
    first = next(iter(weights))
    off = ratios / (cloud.heights.get(first, np.nan) / weights[first]) - 1
    return {
        "placed": cloud.placed,
        "ink": float(shown.sum() / inside.sum()),
        "off": float(np.median(np.abs(off))),
        "gap": float(room.max()),
        "LnU": float(np.mean(distance[inside & ~shown] ** 2)),
    }


def row(container: Container, weights: dict[str, float], cloud: Cloud) -> list[str]:
    found = figures(container, weights, cloud)
    return [
        container.name,
        str(len(weights)),
        cloud.program,
        str(cloud.placed),
        f"{found['ink']:.3f}",
        f"{100 * found['off']:.2g} %",
        f"{found['gap']:.1f}",
        f"{found['LnU']:.1f}",
        cloud.overlap,
        cloud.outside,
        f"{cloud.seconds:.1f}",
    ]


def rows(names: Sequence[str], counts: Sequence[int]) -> Iterator[list[str]]:
    for count in counts:
        weights = vocabulary(count)
        for name in names:
            container = read_container(name)
            for program in (ours, our_free, peer, proportional_peer):
                found = row(container, weights, program(container, weights))
                print(" | ".join(found), file=sys.stderr, flush=True)
                yield found


def main(words: Sequence[str]) -> None:
    names = [name for name in CONTAINERS if name in words] or list(CONTAINERS)
    counts = [count for count in COUNTS if str(count) in words] or list(COUNTS)
    pipeline.warm_up()
    table = markdown_table(HEADER, list(rows(names, counts)))
    print(table)
    if not words:
        write_page("benchmarks-words.md", PAGE, table=table, ratio=f"{SIZE_RATIO:g}")


if __name__ == "__main__":
    main(sys.argv[1:])

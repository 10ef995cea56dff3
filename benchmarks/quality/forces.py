"""Piles, round packs, forces in a crowd, stable words: ``packwork bench forces [short|crowd]``.

Peers: ``packcircles`` (front chain) on the same radii, ``wordcloud`` on the same words. Both
are left out where they are not installed (``pip install packcircles wordcloud``).
"""

from __future__ import annotations

import importlib.util
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

import packwork as pw
from benchmarks.kit.circles import RADII, density, front_chain, packed
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table, ranged
from benchmarks.kit.rest import lowered_at_random, lowered_by_programmes, mean_depth
from packwork.arrays import FloatArray
from packwork.scene.item import Item

ICONS, CIRCLES, WORDS = 300, 200, 100
SIZE = "5.7%"
FAR = 1 / 30
"""Share of the canvas beyond which a word counts as moved."""

PAIR = ("star", "heart")
MIXED = {"cat": 6.0, "owl": 4.0, "fish": 5.0}
MILD = 0.35
"""Power of the weights where words are to be drawn: with 0.6 the largest is as wide as the disc,
and there is no nearer place for the others."""
STRENGTHS = (0.0, 1.0, 10.0)

PAGE = """# Forces

Made by `packwork bench forces` on {date}.
{machine}. Seconds are the processor's; one thread.

## A pile of 300 icons in an open bin, down

`packwork pile square icons -n 300 --size 5.7% --open top --seed S`. "Lower" is by how much two
judges that share no code with the pile (`benchmarks/kit/rest.py`: linear programmes, and small
moves at random, both exact by Shapely) still bring down the area-weighted mean height, in
shares of the canvas; the aim is below 0.1 %.

{piles}

## 200 circles without a container

Share of the smallest enclosing circle that is covered, median and range over the seeds.
packcircles is a front-chain packer.

{circles}

## Forces in a full container

What a force asks for, in a run without it and at two strengths; median and range over seeds 0
to 2, and below it the share of the container that is covered. Centres of mass and distances are
shares of the canvas' height; the rank correlation is between a word's weight and its distance
from the centre. Seconds are those of all three runs of a seed.

{crowd}

## 100 words, one weight up by 5 %

Words in a circle; the weight of the word at each place up by 5 %, then `--start earlier --stay`.
Moved are those that lie farther than 1/30 of the canvas from where they were.

{words}
"""


def piles(seeds: Sequence[int]) -> str:
    """Table of piles and what the judges make of them."""
    rows = []
    for seed in seeds:
        began = time.process_time()
        layout = pw.pile("square", "icons", count=ICONS, size=SIZE, open="top", seed=seed)
        seconds = time.process_time() - began
        side, room = layout.container.side, layout.container.outline.region
        regions = [outline.region for outline in layout.outlines]
        before = mean_depth(regions)
        judged = (
            lowered_by_programmes(regions, room, side),
            lowered_at_random(regions, room, side, np.random.default_rng(seed)),
        )
        lower = [100 * (mean_depth(found) - before) / side for found in judged]
        certified = "yes" if layout.manifest["certified"] else "no"
        rows.append(
            [str(seed), str(len(layout.items)), certified, f"{seconds:.1f}"]
            + [f"{share:.4f} %" for share in lower]
        )
        print(rows[-1], flush=True)
    header = ["seed", "placed", "certified", "s", "lower by programmes", "lower at random"]
    return markdown_table(header, rows)


def circles(seeds: Sequence[int]) -> str:
    """Table of round packs beside the peer's."""
    rows = []
    for name, radii_of in RADII.items():
        ours, peer, seconds = [], [], []
        for seed in seeds:
            radii = radii_of(seed, CIRCLES)
            found, spent = packed(radii, seed)
            seconds.append(spent)
            ours.append(density(found))
            if importlib.util.find_spec("packcircles") is not None:
                peer.append(density(front_chain(radii)))
        rows.append([name, ranged(ours, ".4f"), ranged(peer, ".4f") if peer else "-"])
        rows[-1].append(ranged(seconds, ".1f"))
        print(rows[-1], flush=True)
    return markdown_table(["radii", "Packwork", "packcircles", "s"], rows)


def words(places: Sequence[int]) -> str:
    """Table of re-runs with one weight changed."""
    weights = _weights()
    first = pw.words("circle", weights)
    fresh = 100 * pw.words("circle", _raised(weights, places[0])).metrics["LC_ink"]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        earlier = Path(folder, "earlier.geojson")
        first.save(earlier)
        for place in places:
            changed = _raised(weights, place)
            began = time.process_time()
            again = pw.words("circle", changed, start=str(earlier), stay=True)
            seconds = time.process_time() - began
            scales = dict(zip((i.name for i in again.items), again.poses.scale, strict=True))
            ratios = np.array([scales[name] / changed[name] for name in changed])
            rows.append([
                str(place + 1),
                f"{100 * _moved(first, again):.0f} %",
                f"{100 * (ratios.max() / ratios.min() - 1):.1e} %",
                "yes" if again.manifest["certified"] else "no",
                f"{100 * again.metrics['LC_ink']:.2f} %",
                f"{seconds:.1f}",
            ])  # fmt: skip
            print(rows[-1], flush=True)
    ink = 100 * first.metrics["LC_ink"]
    table = markdown_table(["word", "moved", "sizes off by", "certified", "ink", "s"], rows)
    said = f"Ink of the earlier layout: {ink:.2f} %; of a fresh run: {fresh:.2f} %."
    return f"{table}\n\n{said}{_peer_words(weights, places)}"


def _hearts(layout: pw.Layout, names: Sequence[str]) -> FloatArray:
    """``(m, 3)`` x, y and area of the items of some names, in shares of the canvas' height."""
    own = [k for k, item in enumerate(layout.items) if not names or item.name in names]
    areas = [layout.outlines[k].area for k in own]
    high = layout.container.height
    poses = layout.poses
    return np.column_stack([poses.x[own] / high, poses.y[own] / high, np.array(areas) / high**2])


def _mass(layout: pw.Layout, names: Sequence[str]) -> FloatArray:
    found = _hearts(layout, names)
    return np.asarray(np.average(found[:, :2], axis=0, weights=found[:, 2]))


def _rank(layout: pw.Layout) -> float:
    from scipy.stats import spearmanr

    far = np.hypot(*(_hearts(layout, ())[:, :2] - 0.5).T)
    return float(spearmanr(layout.weights, far).statistic)


CROWDS: dict[str, tuple[str, Callable[..., pw.Layout], Callable[[pw.Layout], float]]] = {
    "centre of mass of the hearts, from the top: 15 and 15 stars in a disc": (
        "balance 50%,80% items=heart",
        lambda **how: pw.fill("circle", PAIR, count=30, **how),
        lambda layout: float(_mass(layout, ("heart",))[1]),
    ),
    "standard deviation of the hearts' height, the same": (
        "align horizontal items=heart",
        lambda **how: pw.fill("circle", PAIR, count=30, **how),
        lambda layout: float(_hearts(layout, ("heart",))[:, 1].std()),
    ),
    "standard deviation of x of the apples, owls and leaves: 100 icons in a square": (
        "align vertical items=apple,owl,leaf",
        lambda **how: pw.fill("square", "icons", count=100, **how),
        lambda layout: float(_hearts(layout, ("apple", "owl", "leaf"))[:, 0].std()),
    ),
    "mean distance of apples and owls from the centre: 100 icons in a heart": (
        "towards centre items=apple,owl",
        lambda **how: pw.fill("heart", "icons", count=100, **how),
        lambda layout: float(np.hypot(*(_hearts(layout, ("apple", "owl"))[:, :2] - 0.5).T).mean()),
    ),
    "centre of mass from the centre, mixed weights, shared sizes: 40 icons in a disc": (
        "balance centre",
        lambda **how: pw.fill("circle", "icons", count=40, weights=MIXED, sizes="shared", **how),
        lambda layout: float(np.hypot(*(_mass(layout, ()) - 0.5))),
    ),
    "rank correlation of weight and distance: 100 words in a disc": (
        "towards centre by=weight",
        lambda **how: pw.words("circle", _weights(MILD), **how),
        _rank,
    ),
}
"""Force, run and measure, by what is measured."""


def crowd(seeds: Sequence[int]) -> str:
    """Table of what forces reach where all is full."""
    rows = []
    for title, (force, run, measure) in CROWDS.items():
        began = time.process_time()
        cells = []
        for strength in STRENGTHS:
            asked = f"{force} strength={strength:g}" if strength else None
            layouts = [run(force=asked, seed=seed) for seed in seeds]
            assert all(layout.manifest["certified"] for layout in layouts)
            found = ranged([measure(layout) for layout in layouts], ".3f")
            covered = ranged([layout.metrics["LC"] for layout in layouts], ".3f")
            cells.append(f"{found}<br>LC {covered}")
        seconds = (time.process_time() - began) / len(seeds)
        rows.append([title, f"`{force}`", *cells, f"{seconds:.1f}"])
        print(rows[-1], flush=True)
    header = ["measure", "force", "without", *(f"strength={s:g}" for s in STRENGTHS[1:]), "s"]
    return markdown_table(header, rows)


def _weights(power: float = 0.6) -> dict[str, float]:
    return {name: 100.0 * (k + 1) ** -power for k, name in enumerate(_names())}


def _raised(weights: dict[str, float], place: int) -> dict[str, float]:
    name = list(weights)[place]
    return {**weights, name: 1.05 * weights[name]}


def _moved(before: pw.Layout, after: pw.Layout) -> float:
    """Share of words that have moved far."""
    at = {i.name: (x, y) for i, x, y in _placed(before)}
    far = [np.hypot(x - at[i.name][0], y - at[i.name][1]) for i, x, y in _placed(after)]
    return float(np.mean(np.array(far) > FAR * before.container.side))


def _placed(layout: pw.Layout) -> list[tuple[Item, float, float]]:
    return list(zip(layout.items, layout.poses.x, layout.poses.y, strict=True))


def _peer_words(weights: dict[str, float], places: Sequence[int]) -> str:
    if importlib.util.find_spec("wordcloud") is None:
        return ""
    from wordcloud import WordCloud

    def spots(changed: dict[str, float]) -> dict[str, FloatArray]:
        cloud = WordCloud(width=600, height=600, random_state=0, prefer_horizontal=1.0)
        cloud.generate_from_frequencies(changed)
        return {word[0]: np.array(position) for word, _, position, _, _ in cloud.layout_}

    before, shares = spots(weights), []
    for place in places:
        after = spots(_raised(weights, place))
        both = [name for name in after if name in before]
        far = [np.hypot(*(after[name] - before[name])) > FAR * 600 for name in both]
        shares.append(float(np.mean(far)))
    return f" wordcloud with one seed, same changes: {100 * np.mean(shares):.0f} % moved."


def _names() -> list[str]:
    """Made-up words of three to nine letters."""
    rng = np.random.default_rng(0)
    names: list[str] = []
    while len(names) < WORDS:
        length = int(rng.integers(3, 10))
        letters = ["bcdfglmnprst"[rng.integers(12)] + "aeiou"[rng.integers(5)] for _ in range(5)]
        word = "".join(letters)[:length]
        if word not in names:
            names.append(word)
    return names


def main(arguments: Sequence[str]) -> None:
    """Measure all, print, and write the page unless asked to be short."""
    is_short = "short" in arguments
    if "crowd" in arguments:
        print(crowd([0, 1, 2]))
        return
    seeds = [0] if is_short else [0, 1, 2]
    pw.pile("square", "star", count=2, size="20%")
    parts = {
        "circles": circles(seeds if is_short else range(5)),
        "piles": piles(seeds),
        "crowd": crowd(seeds),
        "words": words([9] if is_short else [0, 9, 49, 89]),
    }
    for part in parts.values():
        print(part)
    if not is_short:
        write_page("forces.md", PAGE, **parts)


if __name__ == "__main__":
    import sys

    main(sys.argv[1:])

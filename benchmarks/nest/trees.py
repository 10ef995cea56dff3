"""One to 200 equal trees in the smallest square, at any angle: sum of side² / n.

    packwork bench trees [seconds=3600] [most=200] [workers=2] [kept=FILE.json]

The problem of a public competition of 2025 (Santa): its best known sum is about 69. ``seconds`` are
for all of them together, more for more trees; a third of them goes to other seeds of the numbers
that came out worst beside their neighbours. What is found goes to ``kept`` at once, and a run
that was broken off goes on from there. Each square is held against the exact polygons by Shapely.
Where n + 1 trees came out smaller than n, n of those are n's answer.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import shapely
from scipy.ndimage import median_filter

from packwork.scene.item import Item
from packwork.separation.strip import WorkBound
from packwork.uses.nested import Sheet, SheetPart
from packwork.uses.nesting import nest

TREE = [
    (0.0, 0.8), (0.125, 0.5), (0.0625, 0.5), (0.2, 0.25), (0.1, 0.25), (0.35, 0.0), (0.075, 0.0),
    (0.075, -0.2), (-0.075, -0.2), (-0.075, 0.0), (-0.35, 0.0), (-0.1, 0.25), (-0.2, 0.25),
    (-0.0625, 0.5), (-0.125, 0.5),
]  # fmt: skip
"""Corners of one, of height 1."""

SCALE = 100.0
"""Pixels of a tree's height."""

SHARE_AGAIN = 1 / 3
"""Share of the time for other seeds."""

NEIGHBOURS = 15
"""Numbers of trees whose median says what a number of trees might reach."""

TRIES = 3
"""Most other seeds of one number."""

MOST_OVERLAP = 1e-9
"""Share of a tree that rounding may make two of them share."""


def side_of(count: int, seconds: float, workers: int, seed: int = 0) -> float:
    """Side of a square that holds so many trees; infinite where they do not hold."""
    tree = Item("tree", outline=shapely.Polygon(SCALE * np.asarray(TREE)))
    found = nest(
        [SheetPart(item=tree, count=count, angles=None)], [Sheet(height=np.inf, name="square")],
        seed=seed, workers=workers, work=WorkBound(seconds=seconds),
    )  # fmt: skip
    regions = [outline.region for outline in found.sheets[0].layout.outlines]
    left, top, right, bottom = shapely.total_bounds(regions)
    first, second = shapely.STRtree(regions).query(regions)
    pairs = [(a, b) for a, b in zip(first, second, strict=True) if a < b]
    shared = max((regions[a].intersection(regions[b]).area for a, b in pairs), default=0.0)
    is_whole = len(regions) == count and shared <= MOST_OVERLAP * regions[0].area
    return max(right - left, bottom - top) / SCALE if is_whole else np.inf


def shares(sides: dict[str, float]) -> np.ndarray:
    """Side² / n of each number of trees, n of n + 1 where those came out smaller."""
    found = np.array([sides[str(count)] for count in range(1, len(sides) + 1)])
    least = np.minimum.accumulate(found[::-1])[::-1]
    return least**2 / np.arange(1, len(sides) + 1)


def main(arguments: list[str]) -> None:
    """Print the side for each number of trees and the sum."""
    asked = {"seconds": "3600", "most": "200", "workers": "2", "kept": ""}
    asked |= dict(one.split("=", 1) for one in arguments)
    most, workers, seconds = int(asked["most"]), int(asked["workers"]), float(asked["seconds"])
    kept = Path(asked["kept"]) if asked["kept"] else None
    sides: dict[str, float] = {}
    if kept and kept.exists():
        sides = json.loads(kept.read_text(encoding="utf-8"))
    weights = 0.3 + np.arange(1, most + 1) / most
    each = seconds * weights / weights.sum()

    def search(count: int, share: float, seed: int) -> None:
        side = side_of(count, share * each[count - 1], workers, seed)
        sides[str(count)] = min(side, sides.get(str(count), np.inf))
        print(f"{count}: {side:.4f}", flush=True)
        if kept:
            kept.write_text(json.dumps(sides, indent=1) + "\n", encoding="utf-8")

    for count in range(1, most + 1):
        if str(count) not in sides:
            search(count, 1.0 - SHARE_AGAIN, 0)
    tries, left = np.zeros(most, dtype=int), SHARE_AGAIN * seconds
    while left > 0.0 and np.any(tries < TRIES):
        found = shares(sides)
        excess = found - median_filter(found, NEIGHBOURS)
        worst = int(np.argmax(np.where(tries < TRIES, excess / (1 + tries), -np.inf)))
        tries[worst] += 1
        search(worst + 1, 1.0 - SHARE_AGAIN, int(tries[worst]))
        left -= (1.0 - SHARE_AGAIN) * each[worst]
    times = os.times()
    print(
        f"sum of side² / n for 1 to {most} trees: {shares(sides).sum():.3f};"
        f" {sum(times[:4]):.0f} s of processor"
    )


if __name__ == "__main__":
    main(sys.argv[1:])

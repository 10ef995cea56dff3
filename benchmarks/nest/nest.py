"""Strip packing instances of a folder, beside spyrrow where it is installed.

    packwork bench nest FOLDER [seconds=60] [seeds=3] [only=swim,shirts] [workers=2]

Both get the same seconds and cores. Density is the parts' true area over the used strip; what
either gives is held against the exact polygons by Shapely.
"""

from __future__ import annotations

import math
import statistics
import sys
from pathlib import Path
from typing import Any

import shapely
from shapely.affinity import rotate, translate

from benchmarks.peers.peering import version
from packwork.readers.instances import Instance, read_instance
from packwork.separation.strip import WorkBound
from packwork.uses.nested import Nest, Sheet, SheetPart
from packwork.uses.nesting import nest

MOST_OVERLAP = 1e-9
"""Share of the parts' area that rounding may make of touching ones."""


def sheet_parts(instance: Instance) -> list[SheetPart]:
    """Parts of an instance as they are nested."""
    return [
        SheetPart(item=one.item, count=one.count,
              angles=None if one.angles is None else tuple(map(math.radians, one.angles)))
        for one in instance.parts
    ]  # fmt: skip


def ours(instance: Instance, seconds: float, seed: int, workers: int) -> float:
    """Density of our nest, 0 if it does not hold."""
    sheet = Sheet(height=instance.height, name=instance.name)
    made: Nest = nest(
        sheet_parts(instance), [sheet], seed=seed, workers=workers, work=WorkBound(seconds=seconds)
    )
    regions = [outline.region for outline in made.sheets[0].layout.outlines]
    return _checked(regions, made.length, instance.height)


def theirs(instance: Instance, seconds: float, seed: int, workers: int) -> float:
    """Density of spyrrow's, 0 if it does not hold."""
    import spyrrow

    shapes = {part.item.name: part.item.outline.region for part in instance.parts}
    items = [
        spyrrow.Item(
            part.item.name, list(map(tuple, shapes[part.item.name].exterior.coords)),
            demand=part.count,
            allowed_orientations=None if part.angles is None else list(part.angles),
        )
        for part in instance.parts
    ]  # fmt: skip
    problem = spyrrow.StripPackingInstance(instance.name, strip_height=instance.height, items=items)
    config = spyrrow.StripPackingConfig(
        early_termination=False, total_computation_time=round(seconds), num_workers=workers,
        seed=seed,
    )  # fmt: skip
    solution: Any = problem.solve(config)
    regions = [
        translate(rotate(shapes[one.id], one.rotation, origin=(0, 0)), *one.translation)
        for one in solution.placed_items
    ]
    left, _, right, _ = shapely.total_bounds(regions)
    return _checked(regions, right - left, instance.height)


def _checked(regions: list[Any], length: float, height: float) -> float:
    """Density of regions on a strip; 0 where two overlap or one sticks out."""
    area = sum(region.area for region in regions)
    first, second = shapely.STRtree(regions).query(regions)
    pairs = [(a, b) for a, b in zip(first, second, strict=True) if a < b]
    worst = max((regions[a].intersection(regions[b]).area for a, b in pairs), default=0.0)
    left, top, right, bottom = shapely.total_bounds(regions)
    is_in = right - left < length * (1 + 1e-9) and bottom - top < height * (1 + 1e-9)
    return area / (length * height) if is_in and worst <= MOST_OVERLAP * area else 0.0


def main(arguments: list[str]) -> None:
    """Print a line for each instance."""
    folder, *rest = arguments
    asked = {"seconds": "60", "seeds": "3", "only": "", "workers": "2"}
    asked |= dict(one.split("=", 1) for one in rest)
    seconds, workers = float(asked["seconds"]), int(asked["workers"])
    has_peer = version("spyrrow") is not None
    print(f"| instance | packwork | spyrrow {version('spyrrow') or '(not installed)'} | ahead |")
    print("| --- | --- | --- | --- |")
    for path in sorted(Path(folder).glob("*.json")):
        if asked["only"] and path.stem not in asked["only"].split(","):
            continue
        instance = read_instance(path)
        own, other = [], []
        for seed in range(int(asked["seeds"])):
            own.append(100 * ours(instance, seconds, seed, workers))
            if has_peer:
                other.append(100 * theirs(instance, seconds, seed, workers))
        cells = [_cell(own), _cell(other) if other else "-"]
        ahead = f"{statistics.median(own) - statistics.median(other):+.2f}" if other else "-"
        print(f"| {path.stem} | {cells[0]} | {cells[1]} | {ahead} |", flush=True)


def _cell(found: list[float]) -> str:
    return f"{statistics.median(found):.2f} ({min(found):.2f} to {max(found):.2f})"


if __name__ == "__main__":
    main(sys.argv[1:])

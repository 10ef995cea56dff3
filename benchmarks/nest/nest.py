"""Strip packing instances of a folder, beside spyrrow where it is installed.

    packwork bench nest FOLDER [seconds=60] [seeds=3] [only=swim,shirts] [workers=2] [page=yes]

Both get the same seconds and cores. Density is the parts' true area over the used strip; what
either gives is held against the exact polygons by Shapely. ``page=yes`` writes the page of figures
and its manifest.
"""

from __future__ import annotations

import math
import statistics
import sys
from pathlib import Path
from typing import Any

import shapely
from shapely.affinity import rotate, translate

from benchmarks.kit.manifests import write_page
from benchmarks.peers.peering import version
from packwork.phrasing import number_of
from packwork.readers.instances import Instance, read_instance
from packwork.separation.strip import WorkBound
from packwork.uses.nested import NestedSheets, Sheet, SheetPart
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
    made: NestedSheets = nest(
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


LEVEL = 0.005
"""Difference of densities in per cent below which the two are level."""

AUTHORS = {
    "albano": 89.5, "blaz1": 84.7, "dagli": 89.2, "fu": 92.3, "jakobs1": 89.1, "jakobs2": 84.9,
    "mao": 86.1, "marques": 90.9, "shapes0": 68.6, "shapes1": 75.7, "shirts": 89.7, "swim": 78.3,
    "trousers": 91.8,
}  # fmt: skip
"""Mean densities in per cent of J. Gardeyn and G. Vanden Berghe, arXiv:2509.13329: 1,200 s on 16
threads."""

PAGE = """# Nesting beside another program

Strip packing instances of the public collections, given angles and any angle (`_c`): density in
per cent, the parts' true area over the used strip. packwork's `nest` and
[spyrrow](https://pypi.org/project/spyrrow/) (sparrow, arXiv:2509.13329) in the same run, with the
same seconds and worker threads; of several seeds medians, least and greatest in brackets. What
either gives is held against the exact polygons by Shapely: 0 would be a layout that does not hold.
Beside them stand its authors' means after 1,200 s on 16 threads, where they give one.

{table}

{said}

Measured on {date}: {machine} for all but the two searches.
"""


def main(arguments: list[str]) -> None:
    """Print a line for each instance."""
    folder, *rest = arguments
    asked = {"seconds": "60", "seeds": "3", "only": "", "workers": "2", "page": ""}
    asked |= dict(one.split("=", 1) for one in rest)
    seconds, workers = float(asked["seconds"]), int(asked["workers"])
    peer = version("spyrrow")
    lines = [
        f"| instance | packwork | spyrrow {peer or '(not installed)'} | ahead | its authors |",
        "| --- | --- | --- | --- | --- |",
    ]
    print("\n".join(lines))
    aheads = list[float]()
    for path in sorted(Path(folder).glob("*.json")):
        if asked["only"] and path.stem not in asked["only"].split(","):
            continue
        instance = read_instance(path)
        own, other = list[float](), list[float]()
        for seed in range(int(asked["seeds"])):
            own.append(100 * ours(instance, seconds, seed, workers))
            if peer:
                other.append(100 * theirs(instance, seconds, seed, workers))
        ahead = "-"
        if other:
            aheads.append(statistics.median(own) - statistics.median(other))
            ahead = f"{aheads[-1]:+.2f}"
        cells = [_cell(own), _cell(other) if other else "-", ahead, AUTHORS.get(path.stem, "-")]
        lines.append(f"| {' | '.join([path.stem, *map(str, cells)])} |")
        print(lines[-1], flush=True)
    if asked["page"]:
        said = (
            f"{seconds:g} s, {workers} threads, {number_of(int(asked['seeds']), 'seed')}: ahead on "
            f"{sum(ahead >= LEVEL for ahead in aheads)} of {len(aheads)}, behind on "
            f"{sum(ahead <= -LEVEL for ahead in aheads)}; {min(aheads):+.2f} to {max(aheads):+.2f}."
        )
        write_page("nesting.md", PAGE, table="\n".join(lines), said=said)


def _cell(found: list[float]) -> str:
    middle = f"{statistics.median(found):.2f}"
    return middle if len(found) == 1 else f"{middle} ({min(found):.2f} to {max(found):.2f})"


if __name__ == "__main__":
    main(sys.argv[1:])

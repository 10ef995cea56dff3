"""Strip packing instances of a folder, beside spyrrow where it is installed.

    packwork bench nest FOLDER [seconds=60] [seeds=3] [only=swim,shirts] [workers=2] [page=yes]
                               [kept=FILE.json] [long=600] [note=TEXT]
    packwork bench nest wild [seconds=30] [seeds=3] [workers=2] [page=yes]

Both get the same seconds and cores. Density is the parts' true area over the used strip; what
either gives is held against the exact polygons by Shapely. ``wild`` are thin, hooked and holed
parts that are made here. ``page=yes`` writes the page of figures and its manifest. Twelve
instances with three seeds take more than an hour: what is found goes to ``kept`` at once, and a
run that was broken off goes on from there; ``seeds=kept`` shows what was found and runs nothing.
``long`` adds a column: ours after so many seconds, one seed, where the authors give a mean;
``note`` is said below the table.
"""

from __future__ import annotations

import json
import math
import statistics
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from shapely.affinity import rotate, translate

from benchmarks.kit.manifests import (
    blocks_of,
    of_parts,
    read_manifest,
    stamp,
    text_of,
    write_manifest,
    write_page,
    write_text,
)
from benchmarks.peers.peering import version
from packwork.geometry.polygon import polygon_parts
from packwork.readers.instances import Instance, InstancePart, read_instance
from packwork.scene.item import Item
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


def wild_parts(seed: int) -> Instance:
    """60 parts of a workshop, mm: slats, hooks and rings, for a sheet 400 mm high."""
    rng, parts = np.random.default_rng(seed), list[InstancePart]()
    for k in range(60):
        if k % 3 == 0:
            region = shapely.box(0, 0, rng.uniform(80, 200), rng.uniform(4, 12))
        elif k % 3 == 1:
            wide, tall = rng.uniform(40, 110), rng.uniform(30, 90)
            arm, foot = rng.uniform(8, 20, 2)
            region = shapely.Polygon(
                [(0, 0), (wide, 0), (wide, 0.6 * tall), (wide - arm, 0.6 * tall),
                 (wide - arm, foot), (arm, foot), (arm, tall), (0, tall)]
            )  # fmt: skip
        else:
            radius, hole = rng.uniform(20, 42), rng.uniform(0.4, 0.75)
            disc, inner = (shapely.Point(0, 0).buffer(r, 8) for r in (radius, hole * radius))
            region = disc - inner
        item = Item(f"part {k}", outline=region)
        parts.append(InstancePart(item, 1, (0.0, 90.0, 180.0, 270.0)))
    return Instance(f"wild {seed}", 400.0, tuple(parts))


def ours(
    instance: Instance, seconds: float, seed: int, workers: int, *, gap: float = 0.0,
    length: float = math.inf,
) -> float:  # fmt: skip
    """Density of our nest, on a strip or on sheets of a length; 0 if it does not hold."""
    sheet = Sheet(height=instance.height, length=length, name=instance.name)
    made: NestedSheets = nest(
        sheet_parts(instance), [sheet], gap=gap, seed=seed, workers=workers,
        work=WorkBound(seconds=seconds),
    )  # fmt: skip
    if gap:
        is_whole = not made.unplaced and made.certified
        return made.density if is_whole else 0.0
    regions = [outline.region for outline in made.sheets[0].layout.outlines]
    return _checked(regions, made.length, instance.height)


def theirs(
    instance: Instance, seconds: float, seed: int, workers: int, *, gap: float = 0.0
) -> float:
    """Density of spyrrow's, 0 if it does not hold; a gap is kept from the strip's edges, too."""
    import spyrrow

    shapes = {part.item.name: polygon_parts(part.item.outline.region)[0] for part in instance.parts}
    items = [
        spyrrow.Item(
            part.item.name, list(map(tuple, shapes[part.item.name].exterior.coords)),
            demand=part.count,
            allowed_orientations=None if part.angles is None else list(part.angles),
        )
        for part in instance.parts
    ]  # fmt: skip
    height = instance.height - 2.0 * gap
    problem = spyrrow.StripPackingInstance(instance.name, strip_height=height, items=items)
    config = spyrrow.StripPackingConfig(
        early_termination=False, total_computation_time=round(seconds), num_workers=workers,
        seed=seed, min_items_separation=gap or None,
    )  # fmt: skip
    solution: Any = problem.solve(config)
    regions = [
        translate(rotate(shapes[one.id], one.rotation, origin=(0, 0)), *one.translation)
        for one in solution.placed_items
    ]
    left, _, right, _ = shapely.total_bounds(regions)
    found = _checked(regions, right - left, height)
    return found * (right - left) * height / ((right - left + 2.0 * gap) * instance.height)


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

{wild}

Measured on {date}: {machine} for all but the two searches.
"""


WILD = """Sixty parts of a workshop, slats, hooks and rings made by chance, .2 mm apart, at four
angles: density in per cent on sheets of 600 x 400 mm, the last one as far as it is used, and on a
strip 400 mm high. Ours lie in the holes of rings, which spyrrow does not know.

{table}

{seconds:g} s, {workers} threads, on {date} by `{command}`:
{ahead} to {most} points ahead on a strip."""

GAP_MM, SHEET_MM = 0.2, 600.0


def wild(seconds: float, seeds: int, workers: int) -> str:
    """Figures of parts of a workshop, a set of them for each seed."""
    lines = ["| parts | on sheets | on a strip | spyrrow |", "| --- | --- | --- | --- |"]
    aheads = list[float]()
    for seed in range(seeds):
        instance = wild_parts(seed)
        found = [
            100 * ours(instance, seconds, 0, workers, gap=GAP_MM, length=SHEET_MM),
            100 * ours(instance, seconds, 0, workers, gap=GAP_MM),
            100 * theirs(instance, seconds, 0, workers, gap=GAP_MM),
        ]
        aheads.append(found[1] - found[2])
        lines.append(f"| {instance.name} | {' | '.join(f'{one:.2f}' for one in found)} |")
        print(lines[-1], flush=True)
    about = stamp()
    return WILD.format(
        table="\n".join(lines), seconds=seconds, workers=workers, date=about["date"],
        command=about["command"], ahead=f"{min(aheads):.1f}", most=f"{max(aheads):.1f}",
    )  # fmt: skip


def main(arguments: list[str]) -> None:
    """Print a line for each instance."""
    folder, *rest = arguments
    asked = {"seconds": "60", "seeds": "3", "only": "", "workers": "2", "page": "", "kept": ""}
    asked |= {"long": "", "note": ""}
    asked |= dict(one.split("=", 1) for one in rest)
    seconds, workers = float(asked["seconds"]), int(asked["workers"])
    if folder == "wild":
        text = wild(seconds, int(asked["seeds"]), workers)
        if asked["page"]:
            manifest = read_manifest("nesting")
            manifest["parts"]["wild"] = blocks_of(text)
            write_text("nesting.md", of_parts(PAGE, write_manifest("nesting", manifest)))
        return
    peer = version("spyrrow")
    after = f"packwork, {asked['long']} s"
    heads = ["instance", "packwork", f"spyrrow {peer or '(not installed)'}", "ahead"]
    heads += [after, "its authors"] if asked["long"] else ["its authors"]
    lines = [f"| {' | '.join(heads)} |", f"|{' --- |' * len(heads)}"]
    print("\n".join(lines))
    aheads = list[float]()
    found = Found(Path(asked["kept"]) if asked["kept"] else None)
    for path in sorted(Path(folder).glob("*.json")):
        if asked["only"] and path.stem not in asked["only"].split(","):
            continue
        instance = read_instance(path)
        own, other = list[float](), list[float]()
        given = asked["seeds"]
        of_all = found.seeds(path.stem, seconds, workers)
        for seed in of_all if given == "kept" else range(int(given)):
            own.append(found.of("packwork", ours, instance, seconds, seed, workers))
            if peer:
                other.append(found.of(f"spyrrow {peer}", theirs, instance, seconds, seed, workers))
        ahead = "-"
        if other:
            aheads.append(statistics.median(own) - statistics.median(other))
            ahead = f"{aheads[-1]:+.2f}"
        cells = [_cell(own), _cell(other) if other else "-", ahead]
        cells += ["-"] * bool(asked["long"]) + [str(AUTHORS.get(path.stem, "-"))]
        if asked["long"] and path.stem in AUTHORS:
            long = found.of("packwork", ours, instance, float(asked["long"]), 0, workers)
            cells[-2] = f"{long:.2f}"
        lines.append(f"| {' | '.join([path.stem, *cells])} |")
        print(lines[-1], flush=True)
    if asked["page"]:
        how_many = f"{asked['seeds']} seeds"
        if asked["seeds"] == "kept":
            how_many = "three seeds, or one where no brackets stand"
        said = (
            f"{seconds:g} s, {workers} threads, {how_many}: ahead on "
            f"{sum(ahead >= LEVEL for ahead in aheads)} of {len(aheads)}, behind on "
            f"{sum(ahead <= -LEVEL for ahead in aheads)}; {min(aheads):+.2f} to {max(aheads):+.2f}."
            f" {asked['note']}"
        ).strip()
        kept = text_of(read_manifest("nesting")["parts"]["wild"])
        write_page("nesting.md", PAGE, table="\n".join(lines), said=said, wild=kept)


class Found:
    """Densities in per cent, kept in a file where one is given."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.densities: dict[str, float] = {}
        if path is not None and path.exists():
            self.densities = json.loads(path.read_text(encoding="utf-8"))

    def seeds(self, instance: str, seconds: float, workers: int) -> range:
        """Seeds with which all programs were run so long."""
        programs = {key.partition(",")[0] for key in self.densities}
        run = f", {instance}, {seconds:g} s, {workers} threads, "
        found = [key.rpartition(" ")[2] for key in self.densities if run in key]
        return range(sum(found.count(seed) == len(programs) for seed in set(found)))

    def of(
        self, program: str, search: Callable[[Instance, float, int, int], float],
        instance: Instance, seconds: float, seed: int, workers: int,
    ) -> float:  # fmt: skip
        """Density that a program's search finds, or has found in a run before."""
        key = f"{program}, {instance.name}, {seconds:g} s, {workers} threads, seed {seed}"
        if key not in self.densities:
            self.densities[key] = 100.0 * search(instance, seconds, seed, workers)
            if self.path:
                self.path.write_text(json.dumps(self.densities, indent=1) + "\n", encoding="utf-8")
        return self.densities[key]


def _cell(found: list[float]) -> str:
    middle = f"{statistics.median(found):.2f}"
    return middle if len(found) == 1 else f"{middle} ({min(found):.2f} to {max(found):.2f})"


if __name__ == "__main__":
    main(sys.argv[1:])

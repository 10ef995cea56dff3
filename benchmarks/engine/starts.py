"""Where items begin, and what it is worth: ``packwork bench starts [good|few|bad]``.

``good``: every start on every bundled container and the frozen four, 100 items.
``few``: the same with 20 items, which fill narrow containers from wall to wall.
``bad``: starts that no method of ours would make, as they are and with buried items
relocated before the run.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from benchmarks.kit import frozen
from benchmarks.kit.measuring import machine, markdown_table
from packwork import precompile
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull_areas
from packwork.metrics.pixel import pixel_metrics
from packwork.pipeline.plan.plan import Plan
from packwork.readers.builtin import builtin_container, container_names
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.level import Level
from packwork.solve.outlines import simplify_at_scales
from packwork.solve.relocate_trapped import violation_shares
from packwork.solve.solver import solve
from packwork.start.angles_and_sizes import nominal_scales, start_angles, yielding_scales
from packwork.start.first_poses import first_poses, relocated
from packwork.start.options import StartOptions
from packwork.steps.place import NOMINAL_COVERAGE

METHODS = ("distance-field", "medial-axis", "auto", "scatter")
SEEDS = (0, 1, 2)
BAD_SEEDS = (0, 1, 2, 3, 4)
EPOCHS = 200
BURIED_SHARE = 0.5
BURIED_RESOLUTION = 200


def containers() -> list[Container]:
    """The frozen four, then every bundled one."""
    return [make() for make in frozen.CONTAINERS] + [
        builtin_container(name) for name in container_names()
    ]


@dataclass(frozen=True)
class Setting:
    """A container, its items, and all that precedes their places."""

    container: Container
    outlines: list[Outline]
    nominal: FloatArray
    scales: FloatArray
    angles: FloatArray
    rng: np.random.Generator

    def begin(self, method: str) -> tuple[Poses, str]:
        """First poses by one method, and the method that was chosen."""
        options = StartOptions.model_validate({"method": method})
        first = first_poses(
            self.container, self.outlines, self.scales, self.angles, options, self.rng
        )
        return first.poses, first.method


def setting(container: Container, count: int, seed: int) -> Setting:
    """As the pipeline sets up a run with free sizes."""
    outlines = [item.outline for item in frozen.items()[:count]]
    rng = np.random.default_rng(seed)
    areas, hulls = np.array([o.area for o in outlines]), hull_areas(outlines)
    whole = container.outline.area
    nominal = nominal_scales(hulls, np.ones(count), NOMINAL_COVERAGE * whole)
    scales = yielding_scales(areas, hulls, nominal, 2.0, StartOptions().coverage * whole)
    return Setting(container, outlines, nominal, scales, start_angles(count, None, None, rng), rng)


def outcome(case: Setting, start: Poses, epochs: int) -> list[float]:
    """LC, OO, EA and L-nU after a solve."""
    plan = Plan.of(make_recipe(container="given", epochs=epochs), case.container)
    ends = solve(case.container, case.outlines, start, case.nominal, plan.solve_options())
    items = tuple(frozen.items()[: len(case.outlines)])
    placed = Layout(case.container, items, ends.poses, np.ones(len(items))).outlines
    m = pixel_metrics(placed, case.container)
    return [m.LC, m.OO, m.EA, m.LnU]


def start_rows(count: int) -> list[list[str]]:
    """LC of each method per container; at the end the means and all measures."""
    rows, everything = [], []
    for container in containers():
        taken, chosen = {}, ""
        for method in METHODS:
            measured = []
            for seed in SEEDS:
                case = setting(container, count, seed)
                poses, name = case.begin(method)
                chosen = name if method == "auto" else chosen
                measured.append(outcome(case, poses, EPOCHS))
            taken[method] = np.mean(measured, axis=0)
        everything.append([taken[method] for method in METHODS])
        rows.append([container.name, chosen, *(f"{taken[m][0]:.3f}" for m in METHODS)])
        print("  ".join(rows[-1]), flush=True)
    means = np.mean(everything, axis=0)
    for k, label in enumerate(("LC", "OO", "EA", "L-nU")):
        form = "{:.4f}" if k == 0 else "{:.1e}" if k < 3 else "{:.1f}"
        rows.append([f"mean {label}", "", *(form.format(v) for v in means[:, k])])
    return rows


def in_one_point(case: Setting) -> Poses:
    """All items where the first of them would go."""
    poses, _ = case.begin("distance-field")
    widest = int(np.argmax(poses.scale * np.sqrt([o.area for o in case.outlines])))
    return _at(case, np.full(len(poses), poses.x[widest]), np.full(len(poses), poses.y[widest]))


def in_one_part(case: Setting) -> Poses:
    """All items in the left half of the canvas, at random."""
    poses, _ = case.begin("scatter")
    middle = case.container.width / 2
    return _at(case, np.where(poses.x < middle, poses.x, poses.x - middle), poses.y)


def inside_others(case: Setting) -> Poses:
    """The larger half well placed, each of the others at the centre of one of them."""
    poses, _ = case.begin("distance-field")
    order = np.argsort(-poses.scale * np.sqrt([o.area for o in case.outlines]))
    half = (len(order) + 1) // 2
    large, small = order[:half], order[half:]
    x, y = poses.x.copy(), poses.y.copy()
    x[small], y[small] = x[large[: len(small)]], y[large[: len(small)]]
    return _at(case, x, y)


def _at(case: Setting, x: FloatArray, y: FloatArray) -> Poses:
    return Poses(x, y, case.angles, case.scales)


def unburied(case: Setting, start: Poses) -> Poses:
    """The start with its buried items relocated."""
    seen = simplify_at_scales(case.outlines, start.scale, BURIED_RESOLUTION / case.container.side)
    level = Level(case.container, seen, BURIED_RESOLUTION)
    shares = violation_shares(level, start, level.density(start))
    buried = np.flatnonzero(shares > BURIED_SHARE)
    return relocated(case.container, case.outlines, start, buried, case.rng)


def two_discs() -> Container:
    """Two discs of one size, 30 apart, side by side."""
    discs = [shapely.Point(x, 300).buffer(135, quad_segs=64) for x in (150, 450)]
    outline = Outline.from_region(shapely.union_all(discs))
    return Container("two discs", "frozen", outline, frozen.SIDE, frozen.SIDE)


BAD: tuple[tuple[str, Callable[[], Container], Callable[[Setting], Poses]], ...] = (
    ("all in one point", frozen.round_container, in_one_point),
    ("all in one point", frozen.letter_container, in_one_point),
    ("all in one of two parts", two_discs, in_one_part),
    ("small ones inside large ones", frozen.round_container, inside_others),
)


def bad_rows(epochs: int) -> list[list[str]]:
    """LC and L-nU from a good start, from a bad one, and from the bad one relocated."""
    rows = []
    for label, make, spoil in BAD:
        taken = []
        for seed in BAD_SEEDS:
            good = setting(make(), frozen.COUNT, seed)
            bad = setting(make(), frozen.COUNT, seed)
            spoilt = spoil(bad)
            starts = (good.begin("distance-field")[0], spoilt, unburied(bad, spoilt))
            taken.append([outcome(good, start, epochs) for start in starts])
        m = np.mean(taken, axis=0)
        cells = [f"{lc:.3f}, {lnu:.1f}, {oo:.1e}" for lc, oo, _, lnu in m]
        rows.append([f"{label}, {make().name}", str(epochs), *cells])
        print("  ".join(rows[-1]), flush=True)
    return rows


def main(parts: list[str]) -> None:
    """Measure and print."""
    print(machine(), flush=True)
    precompile.warm_up()
    tables = []
    header = ["container", "auto chose", *METHODS]
    if "good" in parts:
        tables.append(markdown_table(header, start_rows(frozen.COUNT)))
    if "few" in parts:
        tables.append(markdown_table(header, start_rows(20)))
    if "bad" in parts:
        bad_header = ["start", "epochs", "good: LC, L-nU, OO", "bad", "bad, relocated"]
        tables.append(markdown_table(bad_header, [*bad_rows(EPOCHS), *bad_rows(1_000)]))
    print("\n\n".join(["", *tables]))


if __name__ == "__main__":
    main(sys.argv[1:] or ["good", "few", "bad"])

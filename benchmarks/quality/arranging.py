"""Items in an order: ``packwork bench arranging [items=N]``.

How well what is measured rises along the way, and what the order costs in coverage and time, beside
the same run without.
"""

from __future__ import annotations

import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table
from packwork import precompile, uses
from packwork.arrays import FloatArray
from packwork.recipe import make_recipe
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.layout import Layout
from packwork.scene.swatch import mean_lights

ITEMS = 100
CONTAINERS = ("circle", "heart", "text:G")
WAYS = ("right by=lightness", "outwards by=lightness", "around by=hue")

HEADER = ["container", "arrange", "in order", "without", "covered", "without",
          "seconds over those without", "certified"]  # fmt: skip

PAGE = """# Items in an order

Made by `packwork bench arranging` on {date}.
{machine}.

{items} icons of free sizes. "in order": Spearman's rank correlation of what is measured with the
place along the way; of hues the mean cosine of the turn between an icon's hue and that of the next
one round the middle, grey ones and the innermost quarter left out. Covered is exact; seconds are of
the whole run but writing, on a machine that others use too.

{table}
"""


def in_order(layout: Layout, way: str) -> float:
    """How well a layout keeps an order."""
    lightness, *ab = oklabs_of_light(mean_lights(layout.items)).T
    off = np.column_stack([layout.poses.x, layout.poses.y]) - layout.container.outline.centroid
    away = np.hypot(off[:, 0], off[:, 1])
    if way.startswith("around"):
        is_seen = (np.hypot(*ab) > 0.02) & (away > np.quantile(away, 0.25))
        hues = np.arctan2(ab[1], ab[0])[is_seen]
        turns: FloatArray = np.arctan2(off[:, 1], off[:, 0])[is_seen]
        round_about = hues[np.argsort(turns)]
        return float(np.cos(np.diff(np.append(round_about, round_about[0]))).mean())
    # Half a second to load, also for what reads only the page of this module.
    from scipy.stats import spearmanr

    along = off[:, 0] if way.startswith("right") else away
    return float(spearmanr(lightness, along).statistic)


def main() -> None:
    asked = dict(word.split("=", 1) for word in sys.argv[1:])
    count = int(asked.get("items", ITEMS))
    precompile.warm_up()
    rows = []
    for container in CONTAINERS:
        plain = uses.fill(make_recipe(container=container, count=count))
        for way in WAYS:
            run = uses.fill(make_recipe(container=container, count=count, arrange=way))
            seconds = [sum(one.seconds.values()) for one in (run, plain)]
            orders = [f"{in_order(one.layout, way):.2f}" for one in (run, plain)]
            covered = [f"{one.metrics.exact.coverage:.3f}" for one in (run, plain)]
            ratio = f"{seconds[0] / seconds[1]:.2f}"
            certified = "yes" if run.certified else "no"
            rows.append([container, f"`{way}`", *orders, *covered, ratio, certified])
            print("  ".join(rows[-1]), flush=True)
    table = markdown_table(HEADER, rows)
    write_page("arranging.md", PAGE, items=str(count), table=table)


if __name__ == "__main__":
    main()

"""Unit charts: ``packwork bench charts [SEED...]``.

The two bundled charts, each in one container, in bars and in a container for each group. Areas are
those of the SVG that is written, read back, against the numbers of the table. Without arguments
docs/benchmarks/charts.md is written.
"""

from __future__ import annotations

import os
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table, ranged
from packwork import pipeline, precompile, uses, writers
from packwork.readers.layouts.read import read_written

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
COFFEE, NOBEL = EXAMPLES / "chart-coffee", EXAMPLES / "chart-nobel"
KG = "kg of coffee, 2019/20"
SEEDS = (0, 1, 2)
HEADER = ["chart", "marks", "groups", "covered", "largest error of an area", "certified",
          "labels", "seconds"]  # fmt: skip

PAGE = """# Unit charts

Made by `packwork bench charts` on {date}.
{machine}.

The bundled charts: coffee of 53 countries as beans, areas in proportion to kilograms, and 259
laureates as circles that are all alike. Covered is exact, the share of all containers or, of
bars, of the rectangles round the heaps; the error of an area is that of a mark in the SVG that
is written, read back, against its row, at the scale that fits all marks best; labels are those
drawn on marks. Seconds are all but writing (reading, layout, measuring), on a machine that others
use too. Median and range of the seeds {seeds}.

{table}
"""


@dataclass(frozen=True)
class Chart:
    """One chart: its name, container, table and options."""

    name: str
    container: str
    data: Path
    options: dict[str, Any] = field(default_factory=dict)


BEANS: dict[str, Any] = {
    "mark": str(COFFEE / "bean.svg"), "size_by": KG, "color_by": "type", "label_by": "country",
    "rotate": "free",
}  # fmt: skip
PRIZES: dict[str, Any] = {"color_by": "category", "label_by": "laureate"}
CUP, BEAN_DATA, PRIZE_DATA = (
    str(COFFEE / "cup.svg"), COFFEE / "coffee.csv", NOBEL / "nobel-us.csv",
)  # fmt: skip
CHARTS = (
    Chart("coffee in a cup", CUP, BEAN_DATA, BEANS),
    Chart("coffee, a bar for each type", "none", BEAN_DATA, {**BEANS, "by": "type"}),
    Chart("coffee, a cup for each type", CUP, BEAN_DATA, {**BEANS, "by": "type"}),
    Chart("laureates in a circle", "circle", PRIZE_DATA, PRIZES),
    Chart("laureates, a bar for each decade", "none", PRIZE_DATA,
          {**PRIZES, "by": "year", "by_step": 10}),
    Chart("laureates, a circle for each category", "circle", PRIZE_DATA,
          {**PRIZES, "by": "category"}),
)  # fmt: skip


def row(chart: Chart, seeds: tuple[int, ...], folder: Path) -> list[str]:
    runs = [
        uses.fill(uses.chart_recipe(chart.container, str(chart.data), seed=seed, **chart.options))
        for seed in seeds
    ]
    layout = runs[0].layout
    groups = {item.datum.group for item in layout.items if item.datum}
    return [
        chart.name,
        str(len(layout.items)),
        str(len(groups)) if groups != {""} else "",
        ranged([run.metrics.exact.coverage for run in runs], ".3f"),
        f"{max(largest_error(run, folder) for run in runs):.0e}",
        f"{sum(run.certified for run in runs)} of {len(runs)}",
        ranged([labelled(run) for run in runs], ".0f"),
        ranged([sum(run.seconds.values()) for run in runs], ".1f"),
    ]


def largest_error(run: pipeline.Run, folder: Path) -> float:
    """Largest share by which a mark of the SVG is off the area that its row says."""
    file = folder / "chart.svg"
    writers.write(run.layout, file, writers.write_options())
    values = np.array([item.datum.value for item in run.layout.items if item.datum])
    per_value = read_written(file).areas / values
    return float(np.abs(per_value / np.median(per_value) - 1).max())


def labelled(run: pipeline.Run) -> int:
    """Rows whose label is drawn on a mark, in as many lines as it takes."""
    names = {item.label.name for item in run.layout.items}
    said = " ".join(note.says for note in run.layout.notes if note.is_on_item)
    return sum(bool(name) and name in said for name in names)


def main() -> None:
    seeds = tuple(map(int, sys.argv[1:])) or SEEDS
    precompile.warm_up()
    found = []
    with tempfile.TemporaryDirectory() as name:
        for chart in CHARTS:
            found.append(row(chart, seeds, Path(name)))
            print("  ".join(found[-1]), flush=True)
    if len(sys.argv) == 1:
        write_page(
            "charts.md", PAGE, seeds=", ".join(map(str, seeds)),
            table=markdown_table(HEADER, found),
        )  # fmt: skip


if __name__ == "__main__":
    main()

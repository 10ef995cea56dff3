"""``packwork measure``: what a saved layout is worth."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors


def measure(
    layout: Annotated[
        Path, typer.Argument(metavar="LAYOUT.geojson", help="A layout that was saved.")
    ],
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    pixels: shared.Pixels = 1_600,
    quiet: shared.Quiet = False,
) -> None:
    """Measure a saved layout: coverage, overlap, what sticks out, evenness, gaps.

    [bold]packwork measure bear.geojson --diagnose bear-check.png[/]
    """
    with clear_errors():
        from rich.console import Console

        from packwork import writers
        from packwork.cli.show import metrics_table
        from packwork.metrics.measure import measure as measure_layout
        from packwork.readers.layout import read_layout

        for path in (report, diagnose):
            if path is not None:
                writers.check_writable(path)
        found = read_layout(layout)
        metrics = measure_layout(found).as_dict()
        # A saved layout holds outlines, not what was drawn in them.
        del metrics["LC_ink"]
        picture = None if diagnose is None else writers.diagnose_png(found, pixels)
        if report is not None:
            writers.write_atomic(
                report, writers.json_bytes({"metrics": metrics, "items": len(found.items)})
            )
        if diagnose is not None and picture is not None:
            writers.write_atomic(diagnose, picture)
        Console(quiet=quiet, highlight=False).print(metrics_table(metrics))

"""``packwork measure``: what a saved layout is worth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import SHORTFALL, clear_errors
from packwork.cli.terminal import say
from packwork.errors import RecipeError

if TYPE_CHECKING:
    from packwork.scene.layout import Layout
    from packwork.verify.paint import PaintedPixels


@shared.by_name
def measure(
    layout: Annotated[
        Path,
        typer.Argument(
            metavar="LAYOUT",
            help="A layout that was saved, as .geojson, .svg, .dxf or .packwork; or any PDF.",
        ),
    ],
    painted: Annotated[
        bool,
        typer.Option(
            "--painted", help="Paint an SVG, too: pixels outside, and in more than one item."
        ),
    ] = False,
    preflight: Annotated[
        bool,
        typer.Option(
            "--preflight", help="What a print shop looks at in a PDF (always) or an SVG, instead."
        ),
    ] = False,
    *,
    report: Path | None,
    diagnose: Path | None,
    pixels: int,
    no_clobber: bool,
    quiet: bool,
) -> None:
    """Measure a saved layout: coverage, overlap, what sticks out, evenness, gaps.

    Exit code 1 if it does not keep what its run promised. Of an SVG or a DXF the outlines
    are measured that stand in the file, so what goes to a printer or a cutter is checked.

    [bold]packwork measure bear.geojson --diagnose bear-check.png[/]

    [bold]packwork measure cut.dxf[/]

    [bold]packwork measure flyer.pdf[/]
    """
    with clear_errors():
        if preflight or layout.suffix.lower() == ".pdf":
            of_layouts = {"report": report, "diagnose": diagnose, "painted": painted or None}
            _show_preflight(layout, quiet, of_layouts)
            return
        from packwork import writers
        from packwork.cli.show import Paper, certificate_line, metrics_table, printing
        from packwork.metrics import certificate
        from packwork.metrics.measure import measure as measure_layout
        from packwork.readers.layouts.read import read_written
        from packwork.sources import check_no_input

        outputs = [path for path in (report, diagnose) if path is not None]
        writers.check_all(outputs, keeps=no_clobber)
        found = read_written(layout)
        for path in outputs:
            check_no_input(path)
        measured = measure_layout(found)
        # A saved layout holds outlines, not what was drawn in them.
        metrics = {key: said for key, said in measured.as_dict().items() if key != "LC_ink"}
        promise = certificate.Promise.of(found.manifest)
        on_trust = certificate.taken_on_trust(found.manifest)
        faults = () if promise is None else certificate.broken(promise, found, measured.exact)
        certified = promise is not None and not certificate.unclean(promise, found, measured.exact)
        changed = bool(certificate.changed_since(found.manifest))
        picture = None if diagnose is None else writers.diagnose_png(found, pixels)
        seen = _painted(layout, found) if painted else None
        if report is not None:
            writers.write_atomic(
                report,
                writers.json_bytes(
                    {
                        "metrics": metrics,
                        "items": len(found.items),
                        "certified": certified,
                        "broken": faults,
                        "on_trust": on_trust,
                        "painted": None if seen is None else asdict(seen),
                    }
                ),
            )
        if diagnose is not None and picture is not None:
            writers.write_atomic(diagnose, picture)
        console = Paper(quiet)
        with printing():
            console.print(metrics_table(metrics, found.container.unit))
            if seen is not None:
                console.print(f"{seen}", soft_wrap=True)
            line = certificate_line(promise is not None, certified, changed=changed)
            console.print(line, soft_wrap=True)
        for sentence in (*on_trust, *faults):
            say(f"{layout}: {sentence}")
        if faults:
            raise typer.Exit(SHORTFALL)


def _show_preflight(path: Path, quiet: bool, of_layouts: Mapping[str, object]) -> None:
    from packwork.cli.show import Paper, preflight_table, printing
    from packwork.verify.preflight import preflight

    for flag, value in of_layouts.items():
        if value is not None:
            raise RecipeError(flag, "is of a layout, and this is looked at before printing")
    checks = preflight(path)
    with printing():
        Paper(quiet).print(preflight_table(path.name, checks))


def _painted(path: Path, layout: Layout) -> PaintedPixels:
    """Pixels that a file's picture paints."""
    from packwork.readers.gate.door import MAX_BYTES
    from packwork.readers.reading import UnfitError, read_bytes, reading_file
    from packwork.verify import painted_pixels

    with reading_file(str(path)):
        if path.suffix.lower() != ".svg":
            raise UnfitError("is no SVG, which alone is painted; leave --painted out")
        return painted_pixels(read_bytes(path, MAX_BYTES), layout)

"""``packwork nest``: parts of true size on as little of a sheet as possible."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt, clear_errors
from packwork.errors import ReadError, RecipeError
from packwork.phrasing import number_of

if TYPE_CHECKING:
    from packwork.uses.nesting import Sheet, SheetPart

DEFAULT_OUTPUT = Path("nest.svg")

WITHIN_LIMIT = 4
"""Angles tried to each side where parts may turn within a limit."""

_TIMES = re.compile(r"(?P<source>.+)\*(?P<count>[0-9]{1,6})")


@shared.by_name
def nest(
    sheet: Annotated[
        str,
        typer.Argument(
            metavar="SHEET",
            help="Width x height with a unit (600x400mm), one number for a strip of that height "
            "and open length (400mm), or a strip packing instance (.json).",
        ),
    ],
    parts: Annotated[
        list[str] | None,
        typer.Argument(metavar="PART...", help="SVG files or folders; part.svg*12 for twelve."),
    ] = None,
    rotate: Annotated[
        str,
        typer.Option(
            help="Angles in degrees: the only ones, as 0,180; free; none; 30: nine up to 30 off."
        ),
    ] = "0,90,180,270",
    kerf: Annotated[
        str,
        typer.Option(
            help="Distance of parts, and from the sheet's edge, as 2mm: the tool's width."
        ),
    ] = "0",
    seconds: Annotated[
        float,
        typer.Option("--time", min=0.1, help="Seconds to search; results depend on the machine."),
    ] = 20.0,
    passes: Annotated[
        int | None,
        typer.Option(min=1, help="Passes to search, in place of seconds: the same bytes again."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Another one gives another nest.")] = 0,
    *,
    output: tuple[Path, ...],
    report: Path | None,
    no_clobber: bool,
    quiet: bool,
) -> None:
    """Nest parts of true size on as little of a strip or sheet as possible.

    [bold]packwork nest 600x400mm bracket.svg*12 gear.svg*4 --kerf 2mm -o sheet.dxf[/]

    [bold]packwork nest swim.json --time 60 -o swim.geojson[/]
    """
    with clear_errors():
        from packwork import writers
        from packwork.cli.running import faults_in
        from packwork.cli.show import Paper
        from packwork.cli.terminal import say
        from packwork.separation.strip import WorkBound
        from packwork.sources import check_no_input
        from packwork.units import parse_length
        from packwork.uses.nesting import nest as nest_parts

        files = list(output or (DEFAULT_OUTPUT,))
        every = [*files, *([report] if report else [])]
        for path in files:
            writers.check_output(path)
        for path in every:
            writers.check_writable(path)
        writers.check_outputs(every)
        if no_clobber:
            writers.check_new(every)
        ground, counted = _asked(sheet, parts or [], rotate)
        try:
            gap = parse_length(kerf, ground.unit, ground.height)
        except ValueError as error:
            raise RecipeError("kerf", str(error)) from None
        for path in every:
            check_no_input(path)
        console = Paper(quiet)
        work = WorkBound(seconds=seconds) if passes is None else WorkBound(passes=passes)
        interrupt = Interrupt()
        with interrupt.listening():
            found = nest_parts(
                counted, ground, gap=gap, seed=seed,
                work=work, stop=interrupt,
            )  # fmt: skip
        drawn = [(path, writers.encoded(found.layout, path)) for path in files]
        faults = [*found.faults, *faults_in(drawn, found.layout, writers.WriteOptions())]
        certified = found.certified and not faults
        if report is not None:
            said = {**found.report(), "certified": certified, "faults": faults}
            drawn.append((report, writers.json_bytes(said)))
        writers.write_all(drawn)
        about, unit = found.layout.manifest["nest"], ground.unit
        console.print(
            f"{number_of(about['parts'], 'part')} on {about['length']:.6g} x {about['height']:.6g} "
            f"{unit}, {about['density']:.1%} of it covered; "
            f"{'certified' if certified else 'not certified'}"
        )
        console.print("wrote " + ", ".join(str(path) for path, _ in drawn))
        for fault in faults:
            say(fault)
        if interrupt.pressed:
            say("stopped by Ctrl-C; this is the shortest so far")
            raise typer.Exit(INTERRUPTED)
        is_too_long = about["length"] > ground.length
        if is_too_long:
            say(
                f"the parts need {about['length']:.6g} {unit}, there are {ground.length:.6g}; "
                "take a longer sheet, fewer parts or more time"
            )
    raise typer.Exit(SHORTFALL if is_too_long or not certified else 0)


def _asked(sheet: str, named: list[str], rotate: str) -> tuple[Sheet, list[SheetPart]]:
    """Sheet and parts of a command line."""
    from packwork.readers.files import exists
    from packwork.readers.instances import is_instance, read_instance
    from packwork.readers.items import read_items
    from packwork.recipe.rules import Rotation
    from packwork.units import canvas_size, convert
    from packwork.uses.nesting import Sheet, SheetPart

    if is_instance(sheet):
        if named:
            raise RecipeError("items", "an instance holds its parts; name none besides")
        instance = read_instance(sheet)
        parts = [
            SheetPart(item=one.item, count=one.count,
                  angles=None if one.angles is None else tuple(map(math.radians, one.angles)))
            for one in instance.parts
        ]  # fmt: skip
        return Sheet(height=instance.height, name=instance.name), parts
    if not named:
        raise RecipeError("items", "there is nothing to nest; name parts, as bracket.svg*12")
    try:
        size = canvas_size(sheet)
    except RecipeError as error:
        raise ReadError(sheet, str(error).removeprefix("canvas: ")) from None
    turned = Rotation.parse(rotate)
    angles = turned.choices
    if turned.limit is not None:
        steps = WITHIN_LIMIT if turned.limit > 0 else 0
        angles = tuple(turned.limit * k / max(steps, 1) for k in range(-steps, steps + 1))
    length, height = (math.inf, size.width) if size.height is None else (size.width, size.height)
    parts = []
    for text in named:
        met = None if exists(text) else _TIMES.fullmatch(text)
        source, count = (met["source"], int(met["count"])) if met else (text, 1)
        parts += [
            SheetPart(item=item, count=count, angles=angles, scale=convert(1.0, "px", size.unit))
            for item in read_items(source, holes="keep").items
        ]
    return Sheet(height=height, length=length, unit=size.unit), parts

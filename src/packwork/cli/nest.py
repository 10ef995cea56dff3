"""``packwork nest``: parts of true size on as little of a sheet as possible."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from pydantic import Field

from packwork.cli import options as shared
from packwork.cli.failure import INTERRUPTED, SHORTFALL, WATCH, Interrupt, clear_errors
from packwork.cli.options import SideFiles, Terminal
from packwork.options import Group, Offer, Options, Verbs
from packwork.phrasing import number_of
from packwork.recipe import Effort

if TYPE_CHECKING:
    from packwork.uses.nested import NestedSheets, Sheet

DEFAULT_OUTPUT = Path("nest.svg")

MOST_NUMBERED = 100
"""Sheets of an earlier nest whose files are looked for."""

TABLE = ".csv"
"""Ending of a table of where each part lies."""

NOT_OF_NESTS = ("show_saliency", "diagnose", "preflight", "save_recipe")
"""Further files that nests do without."""


class NestOptions(Options):
    """Options of a nest."""

    offers = Offer(verbs=Verbs.EVERY)

    rotate: str = "0,90,180,270"
    """Angles in degrees: the only ones, as 0,180; free; none; 30: nine up to 30 off."""

    kerf: str = "0"
    """Distance of parts, and from the sheet's edge, as 2mm: the tool's width. Lines are not
    offset."""

    tool: str = "0"
    """Diameter of a mill's tool, as 6mm: --kerf is as much at least, and places that it cannot
    enter are named."""

    mirror: bool = False
    """Parts may be turned over."""

    holes: Literal["keep", "fill"] = "keep"
    """keep: the holes of items stay free, so that small items may sit in them."""

    engrave: Annotated[tuple[str, ...], Offer(metavar="COLOUR")] = ()
    """Lines and areas in this colour, or on the layer of this name, are engraved and not cut. May
    be given several times."""

    optional: Annotated[tuple[str, ...], Offer(metavar="PART")] = ()
    """As part.svg*20: only fills what all others leave of the sheets that they take. May be given
    several times."""

    margin: str | None = None
    """Distance from the sheet's edge, as 10mm, where it is more than --kerf."""

    effort: Effort = "normal"
    """How long is searched: draft, normal or best; the same bytes on any machine."""

    passes: Annotated[int | None, Field(ge=1)] = None
    """Passes to search, instead of an effort."""

    time: Annotated[float | None, Field(ge=0.1)] = None
    """Seconds to search, instead of an effort: results then depend on the machine."""

    seed: Annotated[int, Field(ge=0)] = 0
    """Another one gives another nest."""

    output: Annotated[tuple[Path, ...], Offer(flags="--output -o", group=Group.WRITTEN)] = ()
    """File to write, one for each sheet where there are several: .dxf, .svg, .png, .jpg, .webp,
    .tif, .geojson; .packwork, to go on by hand. One for all: .pdf, with a list of parts; .csv, a
    table of where each part lies. May be given several times. Default: nest.svg."""

    def lengths(self, sheet: Sheet) -> dict[str, Any]:
        """Distances and the tool's diameter in units of a sheet, as a nest takes them."""
        from packwork.uses.nest_request import length_of

        margin = None if self.margin is None else length_of("margin", self.margin, sheet)
        gap, tool = length_of("kerf", self.kerf, sheet), length_of("tool", self.tool, sheet)
        return {"gap": gap, "margin": margin, "tool": tool}


@shared.of_models(NestOptions, SideFiles, Terminal, without=NOT_OF_NESTS)
def nest(
    sheet: Annotated[
        str,
        typer.Argument(
            metavar="SHEET",
            help="Width x height with a unit (600x400mm: as many as are needed, 600x400mm*2: two), "
            "an outline (hide.svg, scan.png@900mm), an earlier nest, whose parts stay "
            "(nest-1.dxf); several with commas between them. One number is a strip of that "
            "height and open length (400mm); square is the smallest one. Or a strip packing "
            "instance (.json).",
        ),
    ],
    parts: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="PART...",
            help="DXF or SVG files, folders; part.dxf*12 for twelve, icon.svg@80mm for one of that "
            "longer side. Or a table of them, with the "
            "columns file, count and, where wanted, name, rotate, mirror, optional, priority, "
            "together, size.",
        ),
    ] = None,
    **asked: Any,
) -> None:
    """Nest parts of true size on as few sheets and as little of the last one as possible.

    [bold]packwork nest 600x400mm bracket.dxf*12 gear.svg*4 --kerf 2mm -o sheet.dxf[/]

    [bold]packwork nest swim.json --time 60 -o swim.geojson[/]
    """
    with clear_errors():
        from packwork.cli.show import Paper, tell_advice
        from packwork.cli.terminal import say
        from packwork.display.bar import TerminalBar
        from packwork.readers.engraving import Engraving
        from packwork.uses.nest_request import read_request
        from packwork.uses.nest_work import work_of
        from packwork.uses.nesting import nest as nest_parts

        options = shared.part_of(NestOptions, asked)
        report, no_clobber, quiet = asked["report"], asked["no_clobber"], asked["quiet"]
        files = list(options.output or (DEFAULT_OUTPUT,))
        every = [*files, *([report] if report else [])]
        sheets, counted = read_request(
            sheet, parts or [], options.optional, shared.typed_rotation(options.rotate),
            mirror=options.mirror, holes=options.holes, engraving=Engraving(options.engrave),
        )  # fmt: skip
        lengths = options.lengths(sheets[0])
        _check_files(files, every, no_clobber)
        console = Paper(quiet)
        work = work_of(counted, effort=options.effort, passes=options.passes, time=options.time)
        bar, interrupt = TerminalBar(None, quiet), Interrupt()

        def stop() -> bool:
            bar.tell(min(work.share, 1.0), work.best_so_far)
            return interrupt.pressed

        with interrupt.listening():
            with bar.showing():
                found = nest_parts(
                    counted, sheets, **lengths, seed=options.seed, work=work, stop=stop
                )
            if interrupt.pressed and not found.sheets:
                raise KeyboardInterrupt
            written, described, faults = _write(found, files, report, no_clobber)
            interrupt.is_over = True
            WATCH.finish()
        certified = found.certified and not faults
        console.print(_summary(found, sheets[0], certified))
        console.print(_lines(found, sheets[0]))
        tell_advice(found.advice if certified else (), console)
        console.print("wrote " + ", ".join(described))
        if older := [str(one) for path in files for one in _numbered(path) if one not in written]:
            say(f"of an earlier nest: {', '.join(older)}")
        for fault in faults:
            say(fault)
        if interrupt.pressed:
            say("stopped by Ctrl-C; this is the best so far")
            raise typer.Exit(INTERRUPTED)
        if found.left:
            left = ", ".join(f"{item.name}*{many}" for item, many in found.left)
            console.print(f"optional, left out: {left}")
        if found.unplaced:
            missing = ", ".join(f"{item.name}*{many}" for item, many in found.unplaced)
            area = f"{found.unplaced_area:,.1f} {sheets[0].unit}²"
            say(f"no room for {missing}, {area} in all; give more sheets, larger ones or more time")
    raise typer.Exit(SHORTFALL if found.unplaced or not certified else 0)


def _check_files(files: list[Path], every: list[Path], no_clobber: bool) -> None:
    """Refuse, before a run, what could not be written after it; ``every``: reports, too."""
    from packwork import writers
    from packwork.readers.layouts.read import SESSION, is_session
    from packwork.sources import check_no_input

    for path in files:
        if path.suffix.lower() != TABLE and not is_session(path):
            writers.check_output(path, TABLE, SESSION)
    writers.check_all(every)
    numbered = [path for one in files for path in _numbered(one)]
    for path in (*every, *numbered):
        check_no_input(path)
    if no_clobber:
        writers.check_new([*every, *numbered])


def _write(
    found: NestedSheets, files: list[Path], report: Path | None, no_clobber: bool
) -> tuple[list[Path], list[str], list[str]]:
    """Write all files or none; returns them, how that is told, and what is wrong with them."""
    from packwork import writers

    drawn, faults = _drawn(found, files)
    if no_clobber:
        writers.check_new([path for path, _ in drawn])
    if report is not None:
        said = {**found.report(), "certified": found.certified and not faults, "faults": faults}
        drawn.append((report, writers.json_bytes(said)))
    with _sessions(found, files) as sessions:
        drawn += sessions
        described = writers.described(path for path, _ in drawn)
        writers.write_all(drawn)
    return [path for path, _ in drawn], described, faults


def _numbered(path: Path) -> list[Path]:
    """Files that are there of the name that one of several sheets has."""
    from packwork.uses.nested import sheet_file

    return [one for k in range(1, MOST_NUMBERED) if (one := sheet_file(path, k, 2)).exists()]


def _drawn(found: NestedSheets, files: list[Path]) -> tuple[list[tuple[Path, bytes]], list[str]]:
    """Files of all sheets, and what is wrong with them."""
    from packwork import writers
    from packwork.cli.running import faults_in
    from packwork.readers.layouts.read import is_session
    from packwork.uses.nested import sheet_file
    from packwork.writers.parts_list import all_sheets_bytes, is_for_all

    # The sheet's edge is to be seen in a picture, and not to be cut.
    options = writers.WriteOptions(png=writers.SvgOptions(background="white", show_container=True))
    drawn, faults = list[tuple[Path, bytes]](), list(found.faults)
    layouts, pages = [one.layout for one in found.sheets], list[bytes]()
    files = [path for path in files if not is_session(path)]
    of_all = [path for path in files if is_for_all(path)]
    for k, layout in enumerate(layouts, start=1):
        paths = [sheet_file(path, k, len(layouts)) for path in files if path not in of_all]
        written = [(path, writers.encoded(layout, path, options)) for path in paths]
        faults += faults_in(written, layout, options)
        drawn += written
        if any(path.suffix.lower() != TABLE for path in of_all):
            page = Path(f"page-{k}.pdf")
            pages.append(writers.encoded(layout, page, options))
            faults += faults_in([(page, pages[-1])], layout, options)
    if layouts:
        drawn += [(path, all_sheets_bytes(path, layouts, pages)) for path in of_all]
    return drawn, faults


@contextlib.contextmanager
def _sessions(found: NestedSheets, files: list[Path]) -> Iterator[list[tuple[Path, bytes]]]:
    """Session files of all sheets, for the block to write."""
    from packwork.cli.outputs import saving
    from packwork.uses.nested import sheet_file

    with contextlib.ExitStack() as saved:
        many = len(found.sheets)
        yield [
            one
            for k, sheet in enumerate(found.sheets, start=1)
            for one in saved.enter_context(
                saving(sheet.layout, [sheet_file(path, k, many) for path in files])
            )
        ]


def _summary(found: NestedSheets, sheet: Sheet, certified: bool) -> str:
    height = found.length if sheet.is_square else sheet.height
    where = f"{found.length:.6g} x {height:.6g} {sheet.unit}"
    if len(found.sheets) > 1:
        where = f"{len(found.sheets)} sheets, {found.length:.6g} {sheet.unit} of the last one"
    count = number_of(sum(len(one.layout.items) for one in found.sheets), "part")
    said = "certified" if certified else "not certified"
    return f"{count} on {where}, {found.density:.1%} covered; {said}"


def _lines(found: NestedSheets, sheet: Sheet) -> str:
    """Lengths of lines, for the machine's time, and what is left over of the last sheet."""
    cut, engraved = (f"{length:,.1f} {sheet.unit}" for length in found.line_lengths)
    said = f"to cut: {cut}" + (f"; to engrave: {engraved}" if found.line_lengths[1] else "")
    rest = "" if sheet.is_strip or not found.sheets else found.sheets[-1].rest
    return f"{said}; left over: {rest}" if rest else said

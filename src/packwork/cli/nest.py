"""``packwork nest``: parts of true size on as little of a sheet as possible."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from packwork.cli import options as shared
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt, clear_errors
from packwork.errors import ReadError, RecipeError
from packwork.phrasing import number_of

if TYPE_CHECKING:
    from packwork.uses.nesting import Nest, Sheet, SheetPart

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
            help="Width x height with a unit (600x400mm: as many as are needed, 600x400mm*2: two), "
            "an outline (hide.svg), an earlier nest, whose parts stay (nest-1.svg); several with "
            "commas between them. One number is a strip of that height and open length (400mm). "
            "Or a strip packing instance (.json).",
        ),
    ],
    parts: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="PART...",
            help="DXF or SVG files, folders; part.dxf*12 for twelve. Or a table of them, with the "
            "columns file, count and, where wanted, name, rotate, mirror, optional, priority.",
        ),
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
    mirror: Annotated[bool, typer.Option("--mirror", help="Parts may be turned over.")] = False,
    holes: Annotated[
        Literal["keep", "fill"],
        typer.Option(
            help="keep: the holes of items stay free, so that small items may sit in them."
        ),
    ] = "keep",
    optional: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PART",
            help="As part.svg*20: only fills what all others leave of the sheets that they take. "
            "May be given several times.",
        ),
    ] = None,
    margin: Annotated[
        str | None,
        typer.Option(help="Distance from the sheet's edge, as 10mm, where it is more than --kerf."),
    ] = None,
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
    """Nest parts of true size on as few sheets and as little of the last one as possible.

    [bold]packwork nest 600x400mm bracket.dxf*12 gear.svg*4 --kerf 2mm -o sheet.dxf[/]

    [bold]packwork nest swim.json --time 60 -o swim.geojson[/]
    """
    with clear_errors():
        from packwork import writers
        from packwork.cli.show import Paper
        from packwork.cli.terminal import say
        from packwork.separation.strip import WorkBound
        from packwork.sources import check_no_input
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
        sheets, counted = _asked(sheet, parts or [], optional or [], rotate, mirror, holes)
        gap, away = _length("kerf", kerf, sheets[0]), None
        if margin is not None:
            away = _length("margin", margin, sheets[0])
        for path in every:
            check_no_input(path)
        console = Paper(quiet)
        work = WorkBound(seconds=seconds) if passes is None else WorkBound(passes=passes)
        interrupt = Interrupt()
        with interrupt.listening():
            found = nest_parts(
                counted, sheets, gap=gap, margin=away, seed=seed, work=work, stop=interrupt
            )
        drawn, faults = _drawn(found, files)
        certified = found.certified and not faults
        if no_clobber:
            writers.check_new([path for path, _ in drawn])
        if report is not None:
            said = {**found.report(), "certified": certified, "faults": faults}
            drawn.append((report, writers.json_bytes(said)))
        writers.write_all(drawn)
        console.print(_summary(found, sheets[0], certified))
        console.print("wrote " + ", ".join(str(path) for path, _ in drawn))
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
            say(f"no room for {missing}; give more sheets, larger ones or more time")
    raise typer.Exit(SHORTFALL if found.unplaced or not certified else 0)


def _drawn(found: Nest, files: list[Path]) -> tuple[list[tuple[Path, bytes]], list[str]]:
    """Files of all sheets, one for each where there are several, and what is wrong with them."""
    from packwork import writers
    from packwork.cli.running import faults_in

    # The sheet's edge is to be seen in a picture, and not to be cut.
    options = writers.WriteOptions(png=writers.SvgOptions(background="white", show_container=True))
    drawn, faults = list[tuple[Path, bytes]](), list(found.faults)
    for k, one in enumerate(found.sheets, start=1):
        paths = files
        if len(found.sheets) > 1:
            paths = [path.with_name(f"{path.stem}-{k}{path.suffix}") for path in files]
        written = [(path, writers.encoded(one.layout, path, options)) for path in paths]
        faults += faults_in(written, one.layout, options)
        drawn += written
    return drawn, faults


def _summary(found: Nest, sheet: Sheet, certified: bool) -> str:
    where = f"{found.length:.6g} x {sheet.height:.6g} {sheet.unit}"
    if len(found.sheets) > 1:
        where = f"{len(found.sheets)} sheets, {found.length:.6g} {sheet.unit} of the last one"
    count = number_of(sum(len(one.layout.items) for one in found.sheets), "part")
    said = "certified" if certified else "not certified"
    return f"{count} on {where}, {found.density:.1%} covered; {said}"


def _length(option: str, text: str, sheet: Sheet) -> float:
    from packwork.units import parse_length

    try:
        return parse_length(text, sheet.unit, sheet.height)
    except ValueError as error:
        raise RecipeError(option, str(error)) from None


def _counted(text: str) -> tuple[str, int | None]:
    """Source and count of ``part.svg*12``; None where no count is given."""
    from packwork.readers.files import exists

    met = None if exists(text) else _TIMES.fullmatch(text)
    return (met["source"], int(met["count"])) if met else (text, None)


def _sheets(text: str) -> list[Sheet]:
    """Sheets of ``600x400mm*2,hide.svg``; all in the unit of the first."""
    from packwork.readers.container import read_container
    from packwork.readers.files import exists
    from packwork.readers.layouts.read import read_written
    from packwork.units import canvas_size, convert
    from packwork.uses.nesting import Sheet

    found = list[Sheet]()
    for one in [text] if exists(text) else text.split(","):
        source, count = _counted(one.strip())
        if exists(source) and _is_nest(source):
            layout = read_written(source)
            ground = layout.container
            found.append(
                Sheet(height=ground.height, length=ground.width, unit=ground.unit,
                      name=ground.name, outline=ground.outline, count=1, held=layout)
            )  # fmt: skip
            continue
        if exists(source) or Path(source).suffix:
            read = read_container(source)
            found.append(
                Sheet(height=read.height, length=read.width, unit=read.unit, name=read.name,
                      outline=read.outline, count=1 if count is None else count)
            )  # fmt: skip
            continue
        try:
            size = canvas_size(source)
        except RecipeError as error:
            raise ReadError(source, str(error).removeprefix("canvas: ")) from None
        sides = (math.inf, size.width) if size.height is None else (size.width, size.height)
        found.append(Sheet(length=sides[0], height=sides[1], unit=size.unit, count=count))
    unit = found[0].unit
    return [one.scaled(convert(1.0, one.unit, unit), unit) for one in found]


def _is_nest(source: str) -> bool:
    """Whether a file holds a layout of ours, on whose sheet more parts can be laid."""
    from packwork.readers.layouts.read import holds_layout

    ending = Path(source).suffix.lower()
    return ending == ".geojson" or (ending in {".svg", ".dxf"} and holds_layout(source))


def _asked(
    sheet: str,
    named: list[str],
    optional: list[str],
    rotate: str,
    mirror: bool,
    holes: Literal["keep", "fill"],
) -> tuple[list[Sheet], list[SheetPart]]:
    """Sheets and parts of a command line."""
    from packwork.readers.instances import is_instance, read_instance
    from packwork.units import convert
    from packwork.uses.nesting import Sheet, SheetPart

    if is_instance(sheet):
        if named or optional:
            raise RecipeError("items", "an instance holds its parts; name none besides")
        instance = read_instance(sheet)
        parts = [
            SheetPart(item=one.item, count=one.count,
                  angles=None if one.angles is None else tuple(map(math.radians, one.angles)))
            for one in instance.parts
        ]  # fmt: skip
        return [Sheet(height=instance.height, name=instance.name)], parts
    if not named and not optional:
        raise RecipeError("items", "there is nothing to nest; name parts, as bracket.dxf*12")
    sheets = _sheets(sheet)
    usual = {"rotate": rotate, "mirror": "yes" if mirror else "no"}
    parts = [
        part
        for k, text in enumerate([*named, *optional])
        for part in _parts(
            text, {**usual, "optional": "yes" if k >= len(named) else "no"}, holes,
            convert(1.0, "px", sheets[0].unit),
        )
    ]  # fmt: skip
    return sheets, parts


RULES = ("rotate", "mirror", "optional", "priority")
"""Columns of a cut list that say how its parts may lie."""


def _parts(
    text: str, usual: Mapping[str, str], holes: Literal["keep", "fill"], scale: float
) -> Iterator[SheetPart]:
    """Parts of a file, a folder or a cut list; rules that none of its rows has are the usual."""
    from packwork.readers.cut_list import CutListRow, is_cut_list, read_cut_list
    from packwork.readers.items import read_items
    from packwork.uses.nesting import SheetPart

    source, times = _counted(text)
    rows: Iterable[CutListRow] = [CutListRow(file=source)]
    if is_cut_list(source):
        rows = read_cut_list(source, RULES)
    for row in rows:
        rules = {**usual, **row.rules}
        try:
            angles, priority = _angles(rules["rotate"]), _whole(rules.get("priority", "0"))
            mirrors, is_optional = (_is_yes(name, rules[name]) for name in ("mirror", "optional"))
        except RecipeError as error:
            raise ReadError(source, f"{row.where}: {error}") if row.where else error from None
        items = read_items(row.file, holes=holes).items
        for k, item in enumerate(items, start=1):
            name = f"{row.name} {k}" if len(items) > 1 else row.name
            yield SheetPart(
                item=replace(item, name=name) if row.name else item,
                count=row.count * (1 if times is None else times), angles=angles, scale=scale,
                mirrors=mirrors, is_optional=is_optional, priority=priority,
            )  # fmt: skip


def _angles(rotate: str) -> tuple[float, ...] | None:
    """Allowed angles in radians; None for any."""
    from packwork.recipe.rules import Rotation

    turned = Rotation.parse(rotate)
    if turned.limit is None:
        return turned.choices
    steps = WITHIN_LIMIT if turned.limit > 0 else 0
    return tuple(turned.limit * k / max(steps, 1) for k in range(-steps, steps + 1))


def _whole(text: str) -> int:
    try:
        return int(text[:9])
    except ValueError:
        raise RecipeError("priority", f"is a whole number, not {text[:20]!r}") from None


def _is_yes(name: str, text: str) -> bool:
    word = text.casefold()
    if word not in {*_YES, *_NO}:
        raise RecipeError(name, f"is yes or no, not {text[:20]!r}")
    return word in _YES


_YES, _NO = ("yes", "y", "true", "1", "x"), ("no", "n", "false", "0", "-")

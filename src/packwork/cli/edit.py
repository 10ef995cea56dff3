"""``packwork edit``: a saved layout changed here and there, the rest making room."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.edits import planned, read_drawings, with_edits
from packwork.cli.failure import SHORTFALL, clear_errors
from packwork.cli.terminal import printable, say
from packwork.errors import RecipeError
from packwork.writers.options import GONE_ON_WITH

if TYPE_CHECKING:
    from packwork.live.file.disk import Disk
    from packwork.live.session import Session
    from packwork.scene.layout import Layout

NEARLY = 0.005
"""Share of the container by which less than was asked for may be covered. Chosen."""

DEFAULT_OUTPUT = Path("edited.svg")
"""File to write where none is named."""


@with_edits
@shared.by_name
def edit(
    layout: Annotated[
        Path,
        typer.Argument(
            metavar="LAYOUT",
            help="A layout that was saved, as .geojson, .svg or .dxf, or a session (.packwork).",
        ),
    ],
    items: Annotated[
        list[str],
        typer.Option(
            "--items",
            metavar="ITEM",
            help="Drawings of the layout's items, by name: it holds shapes. May be given several "
            "times.",
        ),
    ] = [],  # noqa: B006
    *,
    output: tuple[Path, ...] | None,
    report: Path | None,
    pixels: int,
    no_clobber: bool,
    quiet: bool,
    **asked: Any,
) -> None:
    """Change a saved layout here and there; the rest makes room, certified again.

    Exit code 1 if that cannot be: what is in the way is named.

    [bold]packwork edit bear.geojson --items icons/ --hold owl --move fox=50%,45% -o new.svg[/]

    [bold]packwork edit heart.geojson --add star.svg --remove "cat#2" --recolor "fish=teal"[/]

    [bold]packwork edit work.packwork --count 120 -o work.packwork -o poster.pdf[/]
    """
    with clear_errors():
        from packwork import writers
        from packwork.readers.layouts.read import SESSION, is_session
        from packwork.sources import check_no_input

        outputs = list(output or ([] if report else [DEFAULT_OUTPUT]))
        sides = [path for path in outputs if is_session(path)]
        outputs = [path for path in outputs if not is_session(path)]
        sides += [] if report is None else [report]
        for path in outputs:
            writers.check_output(path, SESSION)
        for side in sides:
            writers.check_writable(side)
        writers.check_outputs([*outputs, *sides])
        if no_clobber:
            writers.check_new([*outputs, *sides])
        session, disk = _opened(layout, items)
        for path in (*outputs, *sides):
            check_no_input(path)
        # Names mean what they meant in the file, whatever is taken away before.
        for make in planned(session, asked):
            make()
        is_well = _written(session, disk, [*outputs, *sides], report, pixels, quiet)
        for line in session.unmet:
            say(line)
        if session.unmet or (asked["cover"] is not None and not _covers(session, asked["cover"])):
            is_well = False
        if not is_well:
            raise typer.Exit(SHORTFALL)


def _covers(session: Session, cover: str) -> bool:
    """Whether as much is covered as was asked for; told if not."""
    from packwork.units import parse_share

    asked, layout = float(str(parse_share(cover))), session.layout
    covered = float(layout.areas.sum()) / layout.container.outline.area
    if covered >= asked - NEARLY:
        return True
    say(f"{100 * covered:.1f} % is covered, not {100 * asked:g} %: no more goes here")
    return False


def _opened(path: Path, items: list[str]) -> tuple[Session, Disk | None]:
    """A session that begins with a file, and the file if it is a session's own."""
    from packwork.live.document import Document
    from packwork.live.file.disk import Disk
    from packwork.live.session import Session
    from packwork.metrics.certificate import changed_since
    from packwork.pipeline.drawings import with_drawings
    from packwork.pipeline.registration import drawn_by
    from packwork.readers.layouts.dxf import LINES_ALONE
    from packwork.readers.layouts.read import is_drawn, is_session, read_written

    if not is_session(path):
        found = read_written(path)
        not_kept = found.manifest.get("not_kept", ()) if is_drawn(path) else ()
        if items:
            found = drawn_by(found, read_drawings(items))
            not_kept = [line for line in not_kept if line != LINES_ALONE]
        elif not is_drawn(path):
            found, not_kept = with_drawings(found, path.parent)
        for line in (*changed_since(found.manifest), *not_kept):
            say(f"{path}: {line}")
        return Session(Document.from_layout(found)), None
    if items:
        raise RecipeError("items", "are in a session file already; leave them out")
    disk = Disk(path, is_journaled=False)
    return disk.opened(Session), disk


def _written(
    session: Session,
    disk: Disk | None,
    outputs: Sequence[Path],
    report: Path | None,
    pixels: int,
    quiet: bool,
) -> bool:
    """Settle, write and show a session's layout; whether it is certified."""
    from packwork import writers
    from packwork.cli.running import faults_in, on_trust_in
    from packwork.cli.show import Paper, certificate_line, metrics_table, printing
    from packwork.live.file.disk import Disk
    from packwork.metrics.measure import measure
    from packwork.pipeline import tell_coarse
    from packwork.readers.layouts.read import is_session

    done = session.finish()
    made = session.layout
    # The file's own way of drawing is gone on with.
    drawing = writers.write_options(**_drawing_of(made), pixels=pixels)
    files = [
        (path, writers.encoded(made, path, drawing))
        for path in outputs
        if path != report and not is_session(path)
    ]
    faults = faults_in(files, made, drawing) if done.certified else []
    certified = done.certified and not faults
    metrics = measure(made).as_dict()
    summary = {
        "metrics": metrics,
        "items": len(made.items),
        "certified": certified,
        "in_the_way": done.in_the_way,
        "unmet": session.unmet,
        "advice": session.advice,
        "moved": done.moved,
    }
    if report is not None:
        files.append((report, writers.json_bytes(summary)))
    with contextlib.ExitStack() as saved:
        for path in filter(is_session, outputs):
            own = disk if disk and disk.is_at(path) else Disk(path, is_journaled=False)
            files.append((path, saved.enter_context(own.replacing(session))))
        writers.write_all(files)
    tell_coarse(made, drawing.dpi)
    console = Paper(quiet)
    with printing():
        console.print(metrics_table(metrics, made.container.unit))
        console.print(certificate_line(True, certified, broken=faults), soft_wrap=True)
        names = ", ".join(printable(str(path)) for path, _ in files)
        console.print(f"wrote {names}", soft_wrap=True)
    on_trust = on_trust_in(files, made) if certified else []
    for line in (*done.in_the_way, *faults, *on_trust, *session.advice):
        say(line)
    return certified


def _drawing_of(layout: Layout) -> dict[str, Any]:
    found = layout.manifest.get("drawing")
    known = found if isinstance(found, Mapping) else {}
    return {key: known[key] for key in GONE_ON_WITH if key in known}

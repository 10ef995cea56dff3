"""``packwork edit``: a saved layout changed here and there, the rest making room."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from packwork.cli import options as shared
from packwork.cli.edits import about, added, planned, read_drawings
from packwork.cli.failure import SHORTFALL, clear_errors
from packwork.cli.terminal import printable, say
from packwork.errors import RecipeError
from packwork.options import offered
from packwork.recipe import Recipe
from packwork.writers.options import GONE_ON_WITH

if TYPE_CHECKING:
    from packwork.live.file.disk import Disk
    from packwork.live.named import NamedSession
    from packwork.scene.layout import Layout

_HELP = {
    **{option.name: option.help for option in offered(Recipe)},
    "sizes": "free: each item finds its size; shared: all stay in proportion; fixed: none changes.",
}

Specs: TypeAlias = list[str]

NEARLY = 0.005
"""Share of the container by which less than was asked for may be covered. Chosen."""

DEFAULT_OUTPUT = Path("edited.svg")
"""File to write where none is named."""

_WHICH = "an item is NAME, NAME#2 for the second of several, or * for any letters"


def _specs(flag: str, metavar: str, text: str) -> typer.models.OptionInfo:
    """An option that may be given several times."""
    return typer.Option(  # type: ignore[no-any-return]
        flag, metavar=metavar, help=f"{text} May be given several times."
    )


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
        Specs,
        _specs("--items", "ITEM", "Drawings of the layout's items, by name: it holds shapes."),
    ] = [],  # noqa: B006
    hold: Annotated[
        Specs, _specs("--hold", "ITEM[=place,angle,size]", f"Keep exactly as it is: {_WHICH}.")
    ] = [],  # noqa: B006
    move: Annotated[
        Specs, _specs("--move", "ITEM=X,Y", "Put an item's middle there, as owl=50%,120.")
    ] = [],  # noqa: B006
    turn: Annotated[
        Specs, _specs("--turn", "ITEM=DEGREES", "Turn an item to that angle from upright.")
    ] = [],  # noqa: B006
    scale: Annotated[
        Specs, _specs("--scale", "ITEM=FACTOR", "Make an item so many times as large.")
    ] = [],  # noqa: B006
    exchange: Annotated[
        Specs, _specs("--exchange", "ITEM=ITEM", "Let two items change places.")
    ] = [],  # noqa: B006
    add: Annotated[
        Specs,
        _specs("--add", "FILE[@X,Y]", "Bring an item more, there or where most room is."),
    ] = [],  # noqa: B006
    remove: Annotated[Specs, _specs("--remove", "ITEM", "Take items away.")] = [],  # noqa: B006
    replace: Annotated[
        Specs, _specs("--replace", "ITEM=FILE", "Put another item in an item's place.")
    ] = [],  # noqa: B006
    recolor: Annotated[Specs, _specs("--recolor", "ITEM=COLOR", "Give items one colour.")] = [],  # noqa: B006
    words: Annotated[
        str | None,
        typer.Option("--words", help="A text or a table: have its words, with its weights."),
    ] = None,
    count: Annotated[
        int | None,
        typer.Option("-n", "--count", help="Have so many items: copies come, or go.", min=1),
    ] = None,
    cover: Annotated[
        str | None,
        typer.Option("--cover", metavar="SHARE", help="Make all larger or smaller, to cover that."),
    ] = None,
    padding: Annotated[str | None, typer.Option("--padding", help=_HELP["padding"])] = None,
    sizes: Annotated[str | None, typer.Option("--sizes", help=_HELP["sizes"])] = None,
    rotate: Annotated[str | None, typer.Option("--rotate", help=_HELP["rotate"])] = None,
    force: Annotated[Specs, typer.Option("--force", help=_HELP["force"])] = [],  # noqa: B006
    arrange: Annotated[str | None, typer.Option("--arrange", help=_HELP["arrange"])] = None,
    embeddings: Annotated[
        str | None, typer.Option("--embeddings", help=_HELP["embeddings"])
    ] = None,
    anchors: Annotated[Specs, typer.Option("--anchors", help=_HELP["anchors"])] = [],  # noqa: B006
    picture: Annotated[
        str | None,
        typer.Option("--picture", help="Show a picture: each item takes on its colour there."),
    ] = None,
    container: Annotated[
        str | None, typer.Option("--container", help="Fill another container, on that canvas.")
    ] = None,
    *,
    output: tuple[Path, ...] | None,
    report: Path | None,
    pixels: int,
    no_clobber: bool,
    quiet: bool,
) -> None:
    """Change a saved layout here and there; the rest makes room, certified again.

    Exit code 1 if that cannot be: what is in the way is named.

    [bold]packwork edit bear.geojson --items icons/ --hold owl --move fox=50%,45% -o new.svg[/]

    [bold]packwork edit heart.geojson --add star.svg --remove "cat#2" --recolor "fish=teal"[/]

    [bold]packwork edit work.packwork --count 120 -o work.packwork -o poster.pdf[/]
    """
    with clear_errors():
        from packwork import writers
        from packwork.inputs import check_no_input
        from packwork.readers.container import read_container
        from packwork.readers.layouts.read import SESSION, is_session

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
        asked = {
            "remove": remove, "replace": replace, "recolor": recolor, "exchange": exchange,
            "turn": turn, "scale": scale, "move": move, "hold": hold,
        }  # fmt: skip
        # Names mean what they meant in the file, whatever is taken away before.
        edits = [planned(session, flag, spec) for flag, specs in asked.items() for spec in specs]
        if container is not None:
            session.fill_container(read_container(container, session.canvas))
        asked_of_all = {"padding": padding, "sizes": sizes, "rotate": rotate, "force": tuple(force)}
        session.set(**{name: value for name, value in asked_of_all.items() if value})
        for make in edits:
            make()
        for spec in add:
            with about("add"):
                added(session, spec)
        if words is not None:
            session.set_words(words)
        if count is not None:
            session.count(count)
        if cover is not None:
            session.cover(cover)
        _put_anew(session, arrange, embeddings, anchors)
        if picture is not None:
            session.show_picture(picture)
        is_well = _written(session, disk, [*outputs, *sides], report, pixels, quiet)
        for line in session.unmet:
            say(line)
        if session.unmet or (cover is not None and not _covers(session, cover)):
            is_well = False
        if not is_well:
            raise typer.Exit(SHORTFALL)


def _put_anew(
    session: NamedSession, arrange: str | None, embeddings: str | None, anchors: Specs
) -> None:
    """Put all in the order that is asked for."""
    if arrange is not None and embeddings is not None:
        raise RecipeError("embeddings", "and --arrange both say where items lie; leave one out")
    if anchors and embeddings is None:
        raise RecipeError("anchors", "are of vectors; say which: --embeddings FILE or auto")
    if arrange is not None:
        session.arrange(arrange)
    if embeddings is not None:
        session.put_alike(embeddings, anchors)


def _covers(session: NamedSession, cover: str) -> bool:
    """Whether as much is covered as was asked for; told if not."""
    from packwork.units import parse_share

    asked, layout = float(str(parse_share(cover))), session.layout
    covered = float(layout.areas.sum()) / layout.container.outline.area
    if covered >= asked - NEARLY:
        return True
    say(f"{100 * covered:.1f} % is covered, not {100 * asked:g} %: no more goes here")
    return False


def _opened(path: Path, items: Specs) -> tuple[NamedSession, Disk | None]:
    """A session that begins with a file, and the file if it is a session's own."""
    from packwork.live.document import Document
    from packwork.live.file.disk import Disk
    from packwork.live.named import NamedSession
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
        return NamedSession(Document.of(found)), None
    if items:
        raise RecipeError("items", "are in a session file already; leave them out")
    disk = Disk(path, is_journaled=False)
    return disk.opened(NamedSession), disk


def _written(
    session: NamedSession,
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
    said = {
        "metrics": metrics,
        "items": len(made.items),
        "certified": certified,
        "in_the_way": done.in_the_way,
        "unmet": session.unmet,
        "advice": session.advice,
        "moved": done.moved,
    }
    if report is not None:
        files.append((report, writers.json_bytes(said)))
    with contextlib.ExitStack() as saved:
        for path in filter(is_session, outputs):
            own = disk if disk and disk.is_at(path) else Disk(path, is_journaled=False)
            files.append((path, saved.enter_context(own.replacing(session))))
        writers.write_all(files)
    tell_coarse(made, drawing.dpi)
    console = Paper(quiet)
    with printing():
        console.print(metrics_table(metrics, made.container.unit))
        console.print(certificate_line(True, certified), soft_wrap=True)
        names = ", ".join(printable(str(path)) for path, _ in files)
        console.print(f"wrote {names}", soft_wrap=True)
    on_trust = on_trust_in(files, made) if certified else []
    for line in (*done.in_the_way, *faults, *on_trust, *session.advice):
        say(line)
    return certified


def _drawing_of(layout: Layout) -> dict[str, Any]:
    """Options by which the file was drawn that a layout came from."""
    found = layout.manifest.get("drawing")
    known = found if isinstance(found, Mapping) else {}
    return {key: known[key] for key in GONE_ON_WITH if key in known}

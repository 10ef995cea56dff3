"""``packwork edit``: a saved layout changed here and there, the rest making room.

Flags of edits are made of their declarations.
"""

from __future__ import annotations

import contextlib
import inspect
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import SHORTFALL, clear_errors
from packwork.cli.terminal import printable, say
from packwork.errors import RecipeError
from packwork.live.edit_flags import Edit, Flag
from packwork.live.edits import EDITS
from packwork.options import offered
from packwork.recipe import Recipe
from packwork.writers.options import GONE_ON_WITH, DrawingOptions

if TYPE_CHECKING:
    from packwork.live.file.disk import Disk
    from packwork.live.session import Session
    from packwork.scene.item import Item
    from packwork.scene.layout import Layout


Command = Callable[..., None]


def with_edits(command: Command) -> Command:
    """Replace a command's ``**asked`` by the flags of all edits."""
    own = inspect.signature(command, eval_str=True).parameters.values()
    before = [each for each in own if each.kind is each.POSITIONAL_OR_KEYWORD]
    after = [each for each in own if each.kind is each.KEYWORD_ONLY]
    flags = [_parameter(edit, flag) for edit in EDITS for flag in edit.flags]
    changed: Any = command
    changed.__signature__ = inspect.Signature([*before, *flags, *after])
    return command


def _parameter(edit: Edit, flag: Flag) -> inspect.Parameter:
    own = inspect.signature(edit.apply).parameters.get(flag.name)
    settings: dict[str, Any] = {"metavar": flag.form, "help": flag.help or _help_of(flag.name)}
    kind: Any = str
    if flag.is_an_edit_each or flag.is_repeated:
        kind = list[str]
    elif own is not None and own.annotation == "int":
        kind, settings["min"] = int, 1
    if flag.is_an_edit_each:
        settings["help"] += " May be given several times."
    option = typer.Option(*flag.names.split(), **settings)
    return inspect.Parameter(
        flag.name,
        inspect.Parameter.KEYWORD_ONLY,
        default=None,
        annotation=Annotated[kind | None, option],
    )


def _help_of(name: str) -> str:
    known = (*offered(Recipe), *offered(DrawingOptions))
    return next(option.help for option in known if option.name == name)


def planned(session: Session, asked: Mapping[str, Any]) -> list[Callable[[], object]]:
    """Edits that flags ask for, of items that are there now, in the order of :data:`EDITS`."""
    if asked["arrange"] is not None and asked["embeddings"] is not None:
        raise RecipeError("embeddings", "and --arrange both say where items lie; leave one out")
    if asked["anchors"] and asked["embeddings"] is None:
        raise RecipeError("anchors", "are of vectors; say which: --embeddings FILE or auto")
    return [make for edit in EDITS for make in _planned(session, edit, asked)]


def _planned(
    session: Session, edit: Edit, asked: Mapping[str, Any]
) -> Iterator[Callable[[], object]]:
    first = edit.flags[0]
    if first.is_an_edit_each:
        for text in asked[first.name] or ():
            with about(first.name):
                values = _values(session, edit, first, text)
            yield partial(_make, first.name, partial(edit.apply, session, *values))
        return
    given = {flag.name: asked[flag.name] for flag in edit.flags}
    given = {name: value for name, value in given.items() if value not in (None, [])}
    given = {name: tuple(v) if isinstance(v, list) else v for name, v in given.items()}
    _, *parameters = inspect.signature(edit.apply).parameters.values()
    if parameters[0].kind is inspect.Parameter.VAR_KEYWORD:
        # An empty text leaves what holds for all as it is.
        yield partial(edit.apply, session, **{name: v for name, v in given.items() if v})
    elif first.name in given:
        values = [_of_text(session, parameters[0], given.pop(first.name)), *given.values()]
        yield partial(edit.apply, session, *values)


def _make(flag: str, make: Callable[[], object]) -> None:
    with about(flag):
        make()


def _values(session: Session, edit: Edit, flag: Flag, text: str) -> list[Any]:
    form = flag.form or ""
    shown = form.replace("[=", " or ITEM=").rstrip("]")
    shown += f" such as {flag.example}" if flag.example else ""
    _, _item, *parameters = inspect.signature(edit.apply).parameters.values()
    if form.startswith("FILE"):
        source, place = _placed(text)
        return [read_drawings([source]), *place]
    which, sign, value = _parted(session, text)
    if ("ITEM=" in form and not (sign and which and value)) or (
        sign and not (value and "=" in form)
    ):
        raise RecipeError(flag.name, f"must be {shown}, not {text[:60]!r}")
    item = session.find(which) if flag.of_many else session.one(which)
    if parameters and parameters[0].kind is inspect.Parameter.VAR_POSITIONAL:
        return [item, *(end.strip() for end in value.split(",") if end)]
    texts = value.split(",", max(len(parameters) - 1, 0)) if value and parameters else []
    least = sum(one.default is one.empty for one in parameters)
    if not least <= len(texts) <= len(parameters):
        raise RecipeError(flag.name, f"must be {shown}, not {value[:40]!r}")
    return [item, *(_of_text(session, *pair) for pair in zip(parameters, texts, strict=False))]


def _of_text(session: Session, parameter: inspect.Parameter, text: Any) -> Any:
    kind = parameter.annotation
    if kind == "float":
        return _number(text)
    if kind == "Which":
        return session.one(text)
    if kind == "Item":
        found = read_drawings([text])
        if len(found) != 1:
            raise RecipeError("item", f"takes one item, not {len(found)}")
        return found[0]
    if kind == "Container":
        from packwork.readers.container import read_container

        return read_container(text, session.canvas)
    return text


def _parted(session: Session, text: str) -> tuple[str, str, str]:
    """An item's name, ``=`` and what is asked of it; names may hold such signs too."""
    names = {item.name for item in session.document.items}
    ends = [k for k, letter in enumerate(text) if letter == "="]
    for end in (len(text), *reversed(ends)):
        which = text[:end].strip()
        if re.sub("#[0-9]+$", "", which) in names:
            return which, text[end : end + 1], text[end + 1 :].strip()
    which, sign, value = text.partition("=")
    return which.strip(), sign, value.strip()


def _placed(text: str) -> tuple[str, list[str]]:
    """File and place that ``FILE`` or ``FILE@X,Y`` names."""
    source, sign, place = text.rpartition("@")
    x, comma, y = place.partition(",")
    if sign and source and comma and not Path(text).exists():
        return source, [x, y]
    return text, []


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise RecipeError("number", f"must be a number, not {text[:40]!r}")
    return number


def read_drawings(sources: list[str]) -> Sequence[Item]:
    """Items of files, folders and built-in names."""
    from packwork.readers.items import read_items

    return read_items(sources).items


@contextlib.contextmanager
def about(flag: str) -> Iterator[None]:
    """Have errors be about the flag that people have typed."""
    try:
        yield
    except RecipeError as error:
        raise RecipeError(flag, error.problem) from error


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
        writers.check_all([*outputs, *sides], keeps=no_clobber)
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
    is_told = report is not None or not quiet
    metrics = measure(made).as_dict() if is_told else None
    advice = session.advice if is_told else ()
    if report is not None:
        summary = {
            "metrics": metrics,
            "items": len(made.items),
            "certified": certified,
            "in_the_way": done.in_the_way,
            "unmet": session.unmet,
            "advice": advice,
            "moved": done.moved,
        }
        files.append((report, writers.json_bytes(summary)))
    with contextlib.ExitStack() as saved:
        for path in filter(is_session, outputs):
            own = disk if disk and disk.is_at(path) else Disk(path, is_journaled=False)
            files.append((path, saved.enter_context(own.replacing(session))))
        described = writers.described(path for path, _ in files)
        writers.write_all(files)
    tell_coarse(made, drawing.dpi)
    console = Paper(quiet)
    with printing():
        if metrics is not None:
            console.print(metrics_table(metrics, made.container.unit))
        console.print(certificate_line(True, certified, broken=faults), soft_wrap=True)
        console.print(printable(f"wrote {', '.join(described)}"), soft_wrap=True)
    on_trust = on_trust_in(files, made) if certified else []
    for line in (*done.in_the_way, *faults, *on_trust, *(() if quiet else advice)):
        say(line)
    return certified


def _drawing_of(layout: Layout) -> dict[str, Any]:
    found = layout.manifest.get("drawing")
    known = found if isinstance(found, Mapping) else {}
    return {key: known[key] for key in GONE_ON_WITH if key in known}

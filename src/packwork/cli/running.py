"""One run as the command line makes it: check, run, write, show. Imported when a run begins."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import typer
from rich.console import Console

from packwork import pipeline, precompile, threads, uses, verify, writers
from packwork.cli.failure import INTERRUPTED, SHORTFALL, WATCH, Interrupt
from packwork.cli.options import Choosing
from packwork.cli.outputs import Outputs, check_room, outputs_asked, saving, with_room
from packwork.cli.show import Paper, preflight_table, printing, show_results
from packwork.cli.start_up import START_UP
from packwork.cli.terminal import MOST_LINES, NOTICES, joined_notices, printable, say
from packwork.display.bar import TerminalBar
from packwork.errors import PackworkError, WriteError
from packwork.progress import NOBODY
from packwork.readers.layouts.read import is_session
from packwork.recipe import Recipe
from packwork.scene.layout import Layout

DRAWN = (".svg", ".png", ".jpg", ".jpeg", ".pdf")
"""Endings of files that people look at."""

LARGE_FILM = 3_000_000
"""Bytes of a film from which a smaller format is named. Larger are slow in a page or a mail; a GIF
of 60 icons has 12 MB, its MP4 2. Chosen."""


def carry_out(recipe: Recipe, asked: Mapping[str, Any], default: Path) -> NoReturn:
    """Run and write what a command line asks for, and leave with the exit code of that.

    ``asked`` are all options of the command by name; ``default`` is written where no file of any
    kind is named.
    """
    outputs = outputs_asked(asked, default, recipe.film)
    raise typer.Exit(run_and_write(recipe, outputs, asked["quiet"]))


def run_and_write(recipe: Recipe, outputs: Outputs, quiet: bool = False) -> int:
    """Run a recipe, write all that was asked for, show the measures; the exit code.

    That is 0; 1 if an item was not placed, the result is not certified or one of its files could
    not be drawn; 130 after Ctrl-C. Outputs are checked before the run, so that no run is lost to a
    bad path.
    """
    START_UP.end()
    outputs.check()
    recipe = on_background(with_room(recipe, outputs.kiss), outputs.options)
    console = Paper(quiet)
    with NOTICES.joining():
        job = uses.read(recipe)
    outputs.check_read(job)
    check_room(job, outputs.kiss)
    # Beforehand, so that no run is lost to what its recipe holds.
    saved = outputs.saved_recipe(recipe)
    if outputs.saliency is not None:
        # Only what is asked for loads the picture library.
        from packwork.display.saliency import write_saliency

        write_saliency(recipe, outputs.saliency)
    with START_UP.more(), threads.using(recipe.threads):
        compile_kernels(TerminalBar(console, quiet))
    bar = TerminalBar(console, quiet)
    interrupt = Interrupt()
    with interrupt.listening():
        with bar.showing():
            run, tried = run_chosen(
                job, outputs.choosing, bar, interrupt, record=bool(outputs.films), quiet=quiet
            )
            was_cut_short = interrupt.pressed
            began = time.perf_counter()
            films = _filmed(run, outputs, bar, interrupt)
        was_stopped = was_cut_short or len(films) < len(outputs.films)
        drawn, undrawn = _drawn(run, outputs)
        run = certify_files(run, drawn, outputs.options)
        if tried:
            seed = run.layout.manifest["seed"]
            saved = outputs.saved_recipe(recipe.model_copy(update={"seed": seed}))
        written = [*drawn, *saved, *films, *sheet_of(tried, outputs.choosing)]
        wrote, is_read = time.perf_counter(), outputs.report is not None or not quiet
        advice, painted = _looked_at(
            job, run, outputs, drawn, films, by_eye=is_read and not was_cut_short
        )
        seconds = {"write": wrote - began, "check": time.perf_counter() - wrote}
        results = {**run.report(seconds, START_UP.told()), "painted": painted}
        results["advice"] += advice
        if outputs.report is not None:
            written.append((outputs.report, writers.json_bytes(results)))
        with saving(outputs.with_drawing(run.layout), outputs.files) as sessions:
            written += sessions
            names = writers.described(path for path, _ in written)
            writers.write_all(written)
        interrupt.is_over = True
        WATCH.finish()
        _warn(run, was_cut_short)
        for error in undrawn:
            say(f"not written: {' '.join(str(error).split())}")
        _print_results(results, names, console, run.layout, drawn if outputs.preflight else ())
        if was_cut_short:
            worth = "certified" if run.certified else "not certified"
            say(f"stopped by Ctrl-C; this is the best so far, {worth}")
    return INTERRUPTED if was_stopped else 0 if run.is_as_asked and not undrawn else SHORTFALL


def _bounds_resolution(job: pipeline.Job) -> bool:
    """Whether ``least_dpi`` may be asked of it."""
    recipe = job.recipe
    is_collage = recipe.words is None and recipe.chart is None and recipe.pile is None
    return is_collage and job.plan.sizes == "free"


def _print_results(
    results: Mapping[str, Any],
    names: Sequence[str],
    console: Console,
    layout: Layout,
    looked_at: Sequence[tuple[Path, bytes]],
) -> None:
    try:
        with printing():
            unit = layout.container.unit
            show_results(results, [printable(name) for name in names], console, unit)
            _print_preflight(looked_at, layout, console)
    except WriteError as error:
        # The files are there; that is what was asked for.
        say(f"{error}; all files are written")


def _print_preflight(files: Sequence[tuple[Path, bytes]], layout: Layout, console: Console) -> None:
    for path, data in files:
        if path.suffix.lower() in {".pdf", ".svg"}:
            # Loads what reads PDFs.
            from packwork.verify.preflight import preflight_of

            console.print(preflight_table(path.name, preflight_of(data, path, layout)))


def on_background(recipe: Recipe, options: writers.WriteOptions) -> Recipe:
    """The recipe, the colours of whose picture make up for the background that is asked for."""
    background = options.png.background
    if recipe.picture is None or recipe.ground is not None or options.takes_ground:
        return recipe
    return recipe.model_copy(update={"ground": background or "#ffffff"})


def compile_kernels(bar: TerminalBar) -> None:
    """Compile what no earlier run has, with a bar that counts."""

    def tell(done: int) -> None:
        of = precompile.KERNELS
        bar.tell(done / of, f"compiling, on the first run only: {done} of {of} kernels")

    with bar.showing():
        precompile.warm_up(tell, second=True)


def _filmed(
    run: pipeline.Run, outputs: Outputs, bar: TerminalBar, interrupt: Interrupt
) -> list[tuple[Path, bytes]]:
    """Bytes of all films; none if Ctrl-C was pressed meanwhile, so that none is half a film."""
    if not outputs.films:
        return []
    options, was_pressed = outputs.options, interrupt.pressed
    background = options.on_ground(run.layout).png.background or "none"
    film = writers.Film(run.layout, outputs.filming, background, options.svg.show_container)

    def encoded(path: Path) -> bytes:
        def tell(share: float) -> None:
            bar.tell(share, printable(f"film {path.name}"))
            if interrupt.pressed and not was_pressed:
                raise KeyboardInterrupt

        return writers.film_bytes(film, path, tell)

    try:
        return [(path, encoded(path)) for path in outputs.films]
    except KeyboardInterrupt:
        interrupt.pressed = True
        say("stopped by Ctrl-C: no film was written")
        return []


def large_films(films: Sequence[tuple[Path, bytes]]) -> list[str]:
    """Advice on films of many bytes, whose formats keep each picture whole.

    Examples
    --------
    >>> large_films([(Path("way.gif"), bytes(8_000_000)), (Path("way.mp4"), bytes(8_000_000))])
    ['way.gif has 8 MB: way.svg or way.mp4 would have a fraction, a smaller --film-pixels less']
    """
    return [
        f"{path.name} has {len(data) / 1e6:.0f} MB: {path.stem}.svg or {path.stem}.mp4 would have "
        "a fraction, a smaller --film-pixels less"
        for path, data in films
        if len(data) > LARGE_FILM and path.suffix.lower() in {".gif", ".webp"}
    ]


def _drawn(
    run: pipeline.Run, outputs: Outputs
) -> tuple[list[tuple[Path, bytes]], list[PackworkError]]:
    """Bytes of all layouts and the diagnostic picture, and what could not be drawn.

    One format that fails takes none of the others with it.
    """
    layout, options = outputs.with_drawing(run.layout), outputs.options
    makers: list[tuple[Path, Callable[[], bytes]]] = [
        (path, partial(writers.encoded, layout, path, options))
        for path in outputs.files
        if not is_session(path)
    ]
    if outputs.diagnose is not None:
        makers.append(
            (outputs.diagnose, partial(writers.diagnose_png, layout, options.png_side_px))
        )
    drawn: list[tuple[Path, bytes]] = []
    failed: list[PackworkError] = []
    for path, make in makers:
        try:
            drawn.append((path, make()))
        except PackworkError as error:
            failed.append(error)
        except MemoryError:
            failed.append(WriteError(path, "needs more memory than there is; try a smaller size"))
    if not drawn and failed:
        raise failed[0]
    return drawn, failed


def _hard_to_see(run: pipeline.Run, outputs: Outputs) -> list[str]:
    """Warning of items that are like the background, if any are drawn on one."""
    options = outputs.options
    is_drawn = any(path.suffix.lower() in DRAWN for path in outputs.files)
    if options.halo != "none" or not is_drawn or run.layout.ground:
        return []
    told = writers.faint_message(run.layout, options.svg.background)
    return [told] if told else []


def _warn(run: pipeline.Run, was_cut_short: bool) -> None:
    lines = joined_notices(
        [(f"{u.item} (item {u.index + 1})", u.reason) for u in run.unplaced], "items"
    )
    for line in lines[:MOST_LINES]:
        say(f"not placed: {line}")
    if len(lines) < len(run.unplaced) or len(lines) > MOST_LINES:
        say(f"not placed: {len(run.unplaced)} items in all; --report names them")
    for sentence in run.complaints(was_cut_short):
        say(sentence)


def run_chosen(
    job: pipeline.Job,
    choosing: Choosing,
    bar: TerminalBar,
    interrupt: Interrupt,
    *,
    record: bool,
    quiet: bool,
) -> tuple[pipeline.Run, tuple[pipeline.Run, ...]]:
    """A run, or the best of several, and all that were tried then."""
    if choosing.best_of == 1:
        return pipeline.run(job, NOBODY if quiet else bar, interrupt, record), ()
    from packwork.batches.seeds import best_of

    def tell(done: int) -> None:
        bar.tell(done / choosing.best_of, f"{done} of {choosing.best_of} seeds")

    found = best_of(
        job.recipe, choosing.best_of, choosing.best_by, record, job.recipe.threads, tell, interrupt
    )
    return found[0], found


def sheet_of(tried: Sequence[pipeline.Run], choosing: Choosing) -> list[tuple[Path, bytes]]:
    """The picture of all that were tried, if it is asked for, and its bytes."""
    if choosing.contact_sheet is None or not tried:
        return []
    from packwork.batches.sheet import THUMB_PX, sheet_bytes

    pictures = [writers.png_bytes(run.layout, THUMB_PX) for run in tried]
    return [(choosing.contact_sheet, sheet_bytes(pictures))]


def faults_in(
    drawn: Sequence[tuple[Path, bytes]], layout: Layout, options: writers.WriteOptions
) -> list[str]:
    """Parts of a layout's promise that the text of a file breaks, a sentence each."""
    return [
        f"{path.name}: {fault}"
        for path, data in drawn
        for fault in verify.faults_in_file(data, path, layout, options)
    ]


def on_trust_in(drawn: Sequence[tuple[Path, bytes]], layout: Layout) -> list[str]:
    """Parts of the files that are not held against what was measured, a sentence each."""
    return [
        f"{path.name}: {one}"
        for path, data in drawn
        for one in verify.on_trust_in_file(path, layout, len(data))
    ]


def certify_files(
    run: pipeline.Run, drawn: Sequence[tuple[Path, bytes]], options: writers.WriteOptions
) -> pipeline.Run:
    """A run that is certified if the texts of its files are, measured by themselves."""
    if not run.certified:
        return run
    faults = faults_in(drawn, run.layout, options)
    return replace(run, certified=False, broken=(*run.broken, *faults)) if faults else run


def _looked_at(
    job: pipeline.Job,
    run: pipeline.Run,
    outputs: Outputs,
    drawn: Sequence[tuple[Path, bytes]],
    films: Sequence[tuple[Path, bytes]],
    *,
    by_eye: bool,
) -> tuple[list[str], dict[str, int] | None]:
    """Advice on what was drawn, and pixels that the first SVG paints outside or twice.

    ``by_eye`` looks at pictures of all items, for which nobody waits who wants it to end.
    """
    options, is_bounded = outputs.options, _bounds_resolution(job)
    advice = [*_hard_to_see(run, outputs), *large_films(films)] if by_eye else []
    advice += pipeline.coarse_photos(run.layout, options.dpi, is_bounded=is_bounded)
    advice += on_trust_in(drawn, run.layout) if run.certified else []
    data = next((data for path, data in drawn if path.suffix.lower() == ".svg"), None)
    if not by_eye or data is None or len(data) > verify.PAINTED_BYTES or options.svg.tiles > 1:
        return advice, None
    painted = verify.painted_pixels(data, run.layout, is_own=True)
    if run.certified and (painted.outside or painted.double):
        advice.append(f"{painted}")
    return advice, asdict(painted)

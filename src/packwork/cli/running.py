"""One run as the command line makes it: check, run, write, show. Imported when a run begins."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, NoReturn

import typer
from rich.console import Console

from packwork import pipeline, precompile, threads, uses, writers
from packwork.cli.checking import held_against_files, on_trust_in, painted_in
from packwork.cli.choosing import check_choosing, run_chosen, seeded, sheet_of
from packwork.cli.cutting import check_bleed, check_room, with_room
from packwork.cli.failure import INTERRUPTED, SHORTFALL, Interrupt
from packwork.cli.files import Choosing
from packwork.cli.notices import NOTICES, joined
from packwork.cli.sessions import saving, told
from packwork.cli.show import Paper, printing, show_results
from packwork.cli.start_up import START_UP
from packwork.cli.terminal import printable, say
from packwork.cli.watch import WATCH
from packwork.display.bar import TerminalBar
from packwork.errors import PackworkError, WriteError
from packwork.inputs import check_no_input
from packwork.readers.layouts.read import SESSION, is_session
from packwork.recipe import Recipe
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import film_options
from packwork.scene.layout import Layout
from packwork.uses.icons import NO_CONTAINER
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions

MOST_NAMED = 5
"""Lines about items without a place on the terminal; a report names all. Chosen."""

DRAWN = (".svg", ".png", ".jpg", ".jpeg", ".pdf")
"""Endings of files that people look at."""


@dataclass(frozen=True, kw_only=True)
class Outputs:
    """All that one run is to write.

    Parameters
    ----------
    report, diagnose, recipe, saliency
        Measures (JSON), the diagnostic picture (PNG), the recipe (TOML), what stands out of the
        container's picture (PNG); None for none.
    drawing
        Options of drawing as they were asked for, by name.
    """

    files: Sequence[Path]
    options: writers.WriteOptions
    films: Sequence[Path] = ()
    filming: FilmOptions = field(default_factory=FilmOptions)
    report: Path | None = None
    diagnose: Path | None = None
    recipe: Path | None = None
    saliency: Path | None = None
    keeps_files: bool = False
    choosing: Choosing = field(default_factory=Choosing)
    drawing: Mapping[str, Any] = field(default_factory=dict)

    @property
    def kiss(self) -> str | None:
        """Distance of the lines that are cut from items; None if there are none such."""
        cut = self.options.svg.cut
        return None if cut is None else cut.kiss

    @property
    def sides(self) -> list[Path]:
        """Files that are written beside the layouts."""
        sheet = self.choosing.contact_sheet
        sides = (self.report, self.diagnose, self.recipe, self.saliency, sheet)
        return [side for side in sides if side is not None]

    @property
    def every(self) -> list[Path]:
        """All files."""
        return [*self.files, *self.films, *self.sides]

    def check(self) -> None:
        """Refuse paths that cannot be written or that collide.

        Raises
        ------
        WriteError
            Before anything has been run or written.
        """
        for path in self.files:
            if is_session(path):
                writers.check_writable(path)
            else:
                writers.check_output(path, SESSION)
        for path in self.films:
            writers.check_film(path)
        for side in self.sides:
            writers.check_writable(side)
        writers.check_outputs(self.every)
        check_choosing(self.choosing)
        check_bleed(self.files, self.options.bleed)
        if self.keeps_files:
            writers.check_new(self.every)

    def told(self, layout: Layout) -> Layout:
        """The layout, its manifest saying how it is drawn."""
        return told(layout, self.options.svg.background, self.drawing)

    def saved_recipe(self, recipe: Recipe) -> list[tuple[Path, bytes]]:
        """The recipe's file, if one is asked for, and its bytes."""
        if self.recipe is None:
            return []
        if self.filming.model_fields_set:
            recipe = recipe.model_copy(update={"film": self.filming})
        return [(self.recipe, writers.recipe_bytes(recipe.plain(), self.recipe.parent))]

    def check_read(self, job: pipeline.Job) -> None:
        """Refuse, once all is read, to write over any of it, and pictures that are too large.

        Raises
        ------
        WriteError
            Naming the output and the input.
        RecipeError
            About the pixels.
        """
        for path in self.every:
            check_no_input(path)
        if job.recipe.container != NO_CONTAINER:
            pictures = [*self.files, *([] if self.diagnose is None else [self.diagnose])]
            for path in pictures:
                writers.check_picture_size(path, job.container, self.options)


def carry_out(recipe: Recipe, asked: Mapping[str, Any], default: Path) -> NoReturn:
    """Run and write what a command line asks for, and leave with the exit code of that.

    Parameters
    ----------
    asked
        All options of the command by name.
    default
        File to write where no file of any kind is named.
    """
    outputs = outputs_asked(asked, default, recipe.film)
    raise typer.Exit(run_and_write(recipe, outputs, asked["quiet"]))


def outputs_asked(
    asked: Mapping[str, Any], default: Path, recipes: FilmOptions | None = None
) -> Outputs:
    """Outputs that the options of a command ask for.

    Parameters
    ----------
    recipes
        How the recipe makes films; None if it does not say.
    """
    drawing = {key: asked[key] for key in DrawingOptions.model_fields if key in asked}
    filming = {key: asked[key] for key in FilmOptions.model_fields if key in asked}
    outputs = Outputs(
        files=asked["output"] or (),
        options=writers.write_options(**drawing),
        films=asked["film"] or (),
        filming=film_options(recipes, **filming),
        report=asked["report"],
        diagnose=asked["diagnose"],
        recipe=asked["save_recipe"],
        saliency=asked.get("show_saliency"),
        keeps_files=asked["no_clobber"],
        choosing=validated(Choosing, {name: asked[name] for name in Choosing.model_fields}),
        drawing=drawing,
    )
    return outputs if outputs.every else replace(outputs, files=[default])


def run_and_write(recipe: Recipe, outputs: Outputs, quiet: bool = False) -> int:
    """Run a recipe, write all that was asked for, show the measures.

    Outputs are checked before the run, so that no run is lost to a bad path.

    Returns
    -------
    int
        The exit code: 0; 1 if an item was not placed, the result is not certified or one of its
        files could not be drawn; 130 after Ctrl-C.
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
        run = held_against_files(run, drawn, outputs.options)
        if tried:
            saved = outputs.saved_recipe(seeded(recipe, run))
        written = [*drawn, *saved, *films, *sheet_of(tried, outputs.choosing)]
        results = run.report(time.perf_counter() - began, START_UP.told())
        if not was_cut_short and (outputs.report is not None or not quiet):
            # Looks at pictures of all items, for which nobody waits who wants it to end.
            results["advice"] += _hard_to_see(run, outputs)
        results["advice"] += pipeline.coarse_photos(
            run.layout, outputs.options.dpi, is_bounded=_bounds_resolution(job)
        )
        results["advice"] += on_trust_in(drawn, run.layout) if run.certified else []
        results["painted"] = None if was_cut_short else painted_in(run, drawn, results["advice"])
        if outputs.report is not None:
            written.append((outputs.report, writers.json_bytes(results)))
        with saving(outputs.told(run.layout), outputs.files) as sessions:
            written += sessions
            replaced = {path for path, _ in written if os.path.lexists(path)}
            writers.write_all(written)
        interrupt.is_over = True
        WATCH.finish()
        _warn(run, was_cut_short)
        for error in undrawn:
            say(f"not written: {' '.join(str(error).split())}")
        names = [f"{path} (replaced)" if path in replaced else f"{path}" for path, _ in written]
        _print_results(results, names, console, run.layout.container.unit)
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
    results: Mapping[str, Any], names: Sequence[str], console: Console, unit: str
) -> None:
    try:
        with printing():
            show_results(results, [printable(name) for name in names], console, unit)
    except WriteError as error:
        # The files are there; that is what was asked for.
        say(f"{error}; all files are written")


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


def _drawn(
    run: pipeline.Run, outputs: Outputs
) -> tuple[list[tuple[Path, bytes]], list[PackworkError]]:
    """Bytes of all layouts and the diagnostic picture, and what could not be drawn.

    One format that fails takes none of the others with it.
    """
    layout, options = outputs.told(run.layout), outputs.options
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
    told = writers.faint_told(run.layout, options.svg.background)
    return [told] if told else []


def _warn(run: pipeline.Run, was_cut_short: bool) -> None:
    lines = joined([(f"{u.item} (item {u.index + 1})", u.reason) for u in run.unplaced], "items")
    for line in lines[:MOST_NAMED]:
        say(f"not placed: {line}")
    if len(lines) < len(run.unplaced) or len(lines) > MOST_NAMED:
        say(f"not placed: {len(run.unplaced)} items in all; --report names them")
    share = float(run.layout.areas.sum()) / run.layout.container.outline.area
    if run.unplaced and share > 1:
        say(
            f"the items' area is {share:.1f} times the container's; "
            "use fewer, a larger --canvas or --sizes free"
        )
    for fault in run.broken:
        say(f"{fault}")
    if run.is_rough:
        exact = run.metrics.exact
        option = "--effort" if run.layout.manifest["recipe"]["time"] is None else "--time"
        remedy = f"try more {option}, fewer items or --sizes free"
        if was_cut_short:
            remedy = "let it run to its end"
        say(
            f"still rough: {100 * exact.overlap:.1f} % of the container is covered "
            f"twice, {100 * exact.exceeding:.1f} % as much lies outside; {remedy}"
        )

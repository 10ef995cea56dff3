"""``packwork pile``: items of given sizes, heaped by forces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import ItemNames
from packwork.piles import PileOptions

DEFAULT_OUTPUT = Path("pile.svg")


def _flag(field: str) -> Any:
    described = PileOptions.model_fields[field].description or ""
    return typer.Option(f"--{field}", help=described, rich_help_panel=shared.PLACING)


def pile(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG (an open path is a wall with an "
            "opening), text:WORD, a built-in name such as square, page (the whole sheet), or none.",
        ),
    ],
    items: ItemNames = None,
    output: shared.Output = None,
    force: shared.Force = None,
    open: Annotated[list[str] | None, _flag("open")] = None,
    size: Annotated[str | None, _flag("size")] = None,
    emit: Annotated[str | None, _flag("emit")] = None,
    release: Annotated[int, _flag("release")] = 0,
    compact: Annotated[bool, _flag("compact")] = False,
    count: shared.Count = None,
    font: shared.Font = None,
    canvas: shared.Canvas = None,
    rotate: shared.Rotate = "free",
    padding: shared.Padding = "0",
    weights: shared.Weights = None,
    delimiter: shared.Delimiter = None,
    decimal: shared.Decimal = None,
    encoding: shared.Encoding = None,
    palette: shared.Palette = None,
    shades: shared.Shades = "tint",
    holes: shared.Holes = "fill",
    strict: shared.Strict = False,
    start: shared.Start = "distance-field",
    trim: shared.Trim = None,
    keep_page: shared.KeepPage = None,
    close_gaps: shared.CloseGaps = "auto",
    alpha_threshold: shared.AlphaThreshold = 0.5,
    stroke_width: shared.StrokeWidth = "scaled",
    seed: shared.Seed = 0,
    pixels: shared.Pixels = 1_600,
    dpi: shared.Dpi = None,
    background: shared.Background = None,
    halo: shared.Halo = "none",
    show_container: shared.ShowContainer = False,
    flatten: shared.Flatten = False,
    cut: shared.Cut = None,
    kiss_cut: shared.KissCut = None,
    bleed: shared.Bleed = None,
    film: shared.Film = None,
    fps: shared.Fps = None,
    seconds: shared.Seconds = None,
    hold: shared.Hold = None,
    loop: shared.Loop = None,
    easing: shared.Easing = None,
    film_pixels: shared.FilmPixels = None,
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    save_recipe: shared.SaveRecipe = None,
    no_clobber: shared.NoClobber = False,
    quiet: shared.Quiet = False,
) -> None:
    """Heap items of given sizes, under forces, until they are at rest.

    [bold]packwork pile square icons -n 300 --size 6% --open top[/]  an open bin

    [bold]packwork pile jar.svg icons -n 80[/]  an open path is a jar

    [bold]packwork pile none circle -n 200 --force "towards centre"[/]  a round pack
    """
    with clear_errors():
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.pipeline import pile_recipe

        recipe = pile_recipe(
            container,
            items or ["builtin:icons"],
            force=force,
            open=open,
            size=size,
            emit=emit,
            release=release,
            compact=compact,
            count=count,
            font=font,
            canvas=canvas,
            rotate=rotate,
            padding=padding,
            weights=weights,
            delimiter=delimiter,
            decimal=decimal,
            encoding=encoding,
            palette=palette,
            shades=shades,
            holes=holes,
            strict=strict,
            start=start,
            trim=trim,
            keep_page=keep_page,
            close_gaps=close_gaps,
            alpha_threshold=alpha_threshold,
            stroke_width=stroke_width,
            seed=seed,
        )
        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose, recipe=save_recipe,
            pixels=pixels, dpi=dpi, background=background, halo=halo,
            show_container=show_container, flatten=flatten,
            film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=recipe.film, no_clobber=no_clobber,
            cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(recipe, outputs, quiet))

"""``packwork photos``: a collage of photographs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.readers.photos.options import PhotoOptions

DEFAULT_OUTPUT = Path("photos.jpg")
EDGES = "What becomes of edges"


def _flag(field: str) -> Any:
    described = PhotoOptions.model_fields[field].description or ""
    return typer.Option(f"--{field.replace('_', '-')}", help=described, rich_help_panel=EDGES)


def photos(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, around:IMAGE (its quiet "
            "part), a built-in name such as moon, or page (the whole sheet of --canvas).",
        ),
    ],
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="PHOTO...",
            help="Photos (JPEG, PNG, WebP), folders of them, or patterns. One that is clear in "
            "places is placed as a cut-out.",
        ),
    ],
    output: shared.Output = None,
    count: shared.Count = None,
    shape: Annotated[str | None, _flag("shape")] = None,
    border: Annotated[str, _flag("border")] = "0%",
    border_color: Annotated[str, _flag("border_color")] = "white",
    edge: Annotated[str, _flag("edge")] = "inside",
    add: Annotated[
        list[str] | None,
        typer.Option(
            "--add",
            help="Items that are placed too: files, folders or built-in names. May be given "
            "several times.",
            rich_help_panel=shared.PLACING,
        ),
    ] = None,
    share: shared.Share = None,
    canvas: shared.Canvas = None,
    quiet_share: shared.QuietShare = 0.4,
    keep_clear: shared.KeepClear = None,
    sizes: shared.Sizes = "free",
    size_ratio: shared.SizeRatio = 2.0,
    rotate: shared.Rotate = "15",
    padding: shared.Padding = "0",
    weights: shared.Weights = None,
    least_dpi: shared.LeastDpi = None,
    delimiter: shared.Delimiter = None,
    decimal: shared.Decimal = None,
    encoding: shared.Encoding = None,
    hero: shared.Hero = None,
    font: shared.Font = None,
    apart: shared.Apart = False,
    target_coverage: shared.TargetCoverage = None,
    max_items: shared.MaxItems = None,
    smallest: shared.Smallest = None,
    filler: shared.Filler = None,
    strict: shared.Strict = False,
    trim: shared.Trim = None,
    keep_page: shared.KeepPage = None,
    close_gaps: shared.CloseGaps = "auto",
    alpha_threshold: shared.AlphaThreshold = 0.5,
    seed: shared.Seed = 0,
    finish: shared.Finish = "exact",
    effort: shared.Effort = "normal",
    epochs: shared.Epochs = None,
    time: shared.Time = None,
    levels: shared.Levels = None,
    start: shared.Start = None,
    loss: shared.Loss = None,
    pixels: shared.Pixels = 1_600,
    dpi: shared.Dpi = None,
    background: shared.Background = None,
    halo: shared.Halo = "none",
    show_container: shared.ShowContainer = False,
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
    show_saliency: shared.ShowSaliency = None,
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    save_recipe: shared.SaveRecipe = None,
    no_clobber: shared.NoClobber = False,
    quiet: shared.Quiet = False,
) -> None:
    """Fill a container with photographs.

    [bold]packwork photos heart holidays/[/]  each photo once, none upside down

    [bold]packwork photos moon *.jpg --canvas 60x40cm --dpi 300 -o poster.jpg[/]  a poster

    [bold]packwork photos cat pets/ --border 4% --padding 1mm --canvas A3 -o cat.pdf[/]

    [bold]packwork photos circle party/ --shape circle --rotate none[/]  round photos
    """
    with clear_errors():
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.pipeline.photographing import photos_recipe

        recipe = photos_recipe(
            container,
            sources,
            add=add or (),
            share=share,
            count=count,
            shape=shape,
            border=border,
            border_color=border_color,
            edge=edge,
            canvas=canvas,
            quiet_share=quiet_share,
            keep_clear=keep_clear,
            sizes=sizes,
            size_ratio=size_ratio,
            rotate=rotate,
            padding=padding,
            weights=weights,
            least_dpi=least_dpi,
            delimiter=delimiter,
            decimal=decimal,
            encoding=encoding,
            hero=hero,
            font=font,
            apart=apart,
            target_coverage=target_coverage,
            max_items=max_items,
            smallest=smallest,
            filler=filler,
            strict=strict,
            trim=trim,
            keep_page=keep_page,
            close_gaps=close_gaps,
            alpha_threshold=alpha_threshold,
            seed=seed,
            finish=finish,
            effort=effort,
            epochs=epochs,
            time=time,
            levels=levels,
            start=start,
            losses=shared.loss_weights(loss),
        )
        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose, recipe=save_recipe,
            pixels=pixels, dpi=dpi, background=background, halo=halo, show_container=show_container,
            film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=recipe.film, saliency=show_saliency,
            no_clobber=no_clobber,
            cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(recipe, outputs, quiet))

"""``packwork fill``: a container filled with items."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.recipe import make_recipe

DEFAULT_OUTPUT = Path("collage.svg")

ItemNames = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="ITEM...",
        help="SVGs, pictures, folders of them, globs, or built-in names such as star.",
        show_default="all built-in icons",
    ),
]


def fill(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD (text:ONE|TWO for two "
            "lines), around:IMAGE (its quiet part), a built-in name such as heart, or page "
            "(the whole sheet of --canvas).",
        ),
    ],
    items: ItemNames = None,
    output: shared.Output = None,
    count: shared.Count = None,
    font: shared.Font = None,
    canvas: shared.Canvas = None,
    quiet_share: shared.QuietShare = 0.4,
    keep_clear: shared.KeepClear = None,
    sizes: shared.Sizes = "free",
    size_ratio: shared.SizeRatio = 2.0,
    stretch: shared.Stretch = 1.0,
    rotate: shared.Rotate = "free",
    padding: shared.Padding = "0",
    weights: shared.Weights = None,
    delimiter: shared.Delimiter = None,
    decimal: shared.Decimal = None,
    encoding: shared.Encoding = None,
    hero: shared.Hero = None,
    force: shared.Force = None,
    palette: shared.Palette = None,
    shades: shared.Shades = "tint",
    apart: shared.Apart = False,
    holes: shared.Holes = "fill",
    outline: shared.OutlineChoice = "exact",
    target_coverage: shared.TargetCoverage = None,
    max_items: shared.MaxItems = None,
    smallest: shared.Smallest = None,
    filler: shared.Filler = None,
    strict: shared.Strict = False,
    trim: shared.Trim = None,
    keep_page: shared.KeepPage = None,
    close_gaps: shared.CloseGaps = "auto",
    alpha_threshold: shared.AlphaThreshold = 0.5,
    stroke_width: shared.StrokeWidth = "scaled",
    seed: shared.Seed = 0,
    finish: shared.Finish = "exact",
    effort: shared.Effort = "normal",
    epochs: shared.Epochs = None,
    time: shared.Time = None,
    preset: shared.Preset = "default",
    levels: shared.Levels = None,
    start: shared.Start = None,
    stay: shared.Stay = False,
    loss: shared.Loss = None,
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
    show_saliency: shared.ShowSaliency = None,
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    save_recipe: shared.SaveRecipe = None,
    no_clobber: shared.NoClobber = False,
    quiet: shared.Quiet = False,
) -> None:
    """Fill a container with items.

    [bold]packwork fill heart[/]  the built-in icons in a heart

    [bold]packwork fill bear.png icons/ -n 100 -o bear.svg -o bear.png[/]  your own

    [bold]packwork fill text:HELLO icons/ -n 150[/]  a word to fill

    [bold]packwork fill logo.svg star circle --rotate none --sizes shared[/]
    """
    with clear_errors():
        recipe = make_recipe(
            container=container,
            items=items or ["builtin:icons"],
            count=count,
            font=font,
            canvas=canvas,
            quiet_share=quiet_share,
            keep_clear=keep_clear,
            sizes=sizes,
            size_ratio=size_ratio,
            stretch=stretch,
            rotate=rotate,
            padding=padding,
            weights=weights,
            delimiter=delimiter,
            decimal=decimal,
            encoding=encoding,
            hero=hero,
            force=force,
            palette=palette,
            shades=shades,
            apart=apart,
            holes=holes,
            outline=outline,
            target_coverage=target_coverage,
            max_items=max_items,
            smallest=smallest,
            filler=filler,
            strict=strict,
            trim=trim,
            keep_page=keep_page,
            close_gaps=close_gaps,
            alpha_threshold=alpha_threshold,
            stroke_width=stroke_width,
            seed=seed,
            finish=finish,
            effort=effort,
            epochs=epochs,
            time=time,
            preset=preset,
            levels=levels,
            start=start,
            stay=stay,
            losses=shared.loss_weights(loss),
        )
        from packwork.cli.running import outputs_asked, run_and_write

        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose, recipe=save_recipe,
            pixels=pixels, dpi=dpi, background=background, halo=halo,
            show_container=show_container, flatten=flatten,
            film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=recipe.film, saliency=show_saliency,
            no_clobber=no_clobber,
            cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(recipe, outputs, quiet))

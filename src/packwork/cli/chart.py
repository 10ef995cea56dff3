"""``packwork chart``: a unit chart."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.readers.charts.options import ChartOptions

DEFAULT_OUTPUT = Path("chart.svg")
SHOWN = "What marks say"


def _flag(field: str) -> Any:
    described = ChartOptions.model_fields[field].description or ""
    return typer.Option(f"--{field.replace('_', '-')}", help=described, rich_help_panel=SHOWN)


def chart(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, a built-in name such "
            "as heart; or none, for bars of --by.",
        ),
    ],
    data: Annotated[
        str,
        typer.Argument(
            metavar="DATA", help="A table: .csv, .tsv, .json, or (with pandas) .parquet."
        ),
    ],
    output: shared.Output = None,
    size_by: Annotated[str | None, _flag("size_by")] = None,
    size_is: Annotated[Literal["area", "height", "width"], _flag("size_is")] = "area",
    unit: Annotated[float | None, _flag("unit")] = None,
    color_by: Annotated[str | None, _flag("color_by")] = None,
    mark: Annotated[list[str] | None, _flag("mark")] = None,
    mark_by: Annotated[str | None, _flag("mark_by")] = None,
    label_by: Annotated[str | None, _flag("label_by")] = None,
    by: Annotated[str | None, _flag("by")] = None,
    by_step: Annotated[float | None, _flag("by_step")] = None,
    title: Annotated[str | None, _flag("title")] = None,
    legend: Annotated[
        bool,
        typer.Option(
            "--legend/--no-legend",
            help=ChartOptions.model_fields["legend"].description or "",
            rich_help_panel=SHOWN,
        ),
    ] = True,
    palette: shared.Palette = None,
    delimiter: shared.Delimiter = None,
    decimal: shared.Decimal = None,
    encoding: shared.Encoding = None,
    canvas: shared.Canvas = None,
    rotate: shared.Rotate = "none",
    padding: shared.Padding = "0.2%",
    holes: shared.Holes = "fill",
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
    start: shared.Start = "distance-field",
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
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    save_recipe: shared.SaveRecipe = None,
    no_clobber: shared.NoClobber = False,
    quiet: shared.Quiet = False,
) -> None:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    [bold]packwork chart circle coffee.csv --size-by kg --label-by country[/]

    [bold]packwork chart heart prizes.csv --color-by category -o prizes.png[/]

    [bold]packwork chart square people.csv --size-by people --unit 1000[/]

    [bold]packwork chart none prizes.csv --by year --by-step 10 --color-by category[/]
    """
    with clear_errors():
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.pipeline import chart_recipe

        recipe = chart_recipe(
            container,
            data,
            size_by=size_by,
            size_is=size_is,
            unit=unit,
            color_by=color_by,
            mark=mark,
            mark_by=mark_by,
            label_by=label_by,
            by=by,
            by_step=by_step,
            title=title,
            legend=legend,
            palette=palette,
            background=background,
            delimiter=delimiter,
            decimal=decimal,
            encoding=encoding,
            canvas=canvas,
            rotate=rotate,
            padding=padding,
            holes=holes,
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
            pixels=pixels, dpi=dpi, background=background, halo=halo,
            show_container=show_container, flatten=flatten,
            film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=recipe.film, no_clobber=no_clobber,
            cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(recipe, outputs, quiet))

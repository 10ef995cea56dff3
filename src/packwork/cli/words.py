"""``packwork words``: a word cloud."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.readers.words.options import WordOptions

DEFAULT_OUTPUT = Path("words.svg")
TYPE = "How words are set"


def _flag(field: str, *names: str, panel: str = shared.PLACING) -> Any:
    described = WordOptions.model_fields[field].description or ""
    return typer.Option(
        *(names or (f"--{field.replace('_', '-')}",)), help=described, rich_help_panel=panel
    )


def words(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, around:IMAGE (its quiet "
            "part), a built-in name such as heart, or page (the whole sheet of --canvas).",
        ),
    ],
    source: Annotated[
        str,
        typer.Argument(
            metavar="SOURCE",
            help="A text, a table of word,weight (.csv, .tsv, .json), or - for standard input.",
        ),
    ],
    output: shared.Output = None,
    count: shared.Count = None,
    min_count: Annotated[int, _flag("min_count")] = 1,
    language: Annotated[str, _flag("language")] = "auto",
    stopwords: Annotated[str | None, _flag("stopwords")] = None,
    min_word_length: Annotated[int, _flag("min_word_length")] = 2,
    include_numbers: Annotated[bool, _flag("include_numbers", "--include-numbers")] = False,
    regexp: Annotated[str | None, _flag("regexp")] = None,
    phrases: Annotated[int, _flag("phrases")] = 1,
    plurals: Annotated[Literal["merge", "keep"], _flag("plurals")] = "merge",
    case: Annotated[Literal["common", "lower", "upper"], _flag("case", panel=TYPE)] = "common",
    font: Annotated[list[str] | None, shared.flag("font", panel=TYPE)] = None,
    font_weight: Annotated[int, _flag("font_weight", panel=TYPE)] = 700,
    weight_is: Annotated[
        Literal["height", "area", "ink"], _flag("weight_is", panel=TYPE)
    ] = "height",
    color_by: Annotated[str | None, _flag("color_by", panel=TYPE)] = None,
    palette: shared.Palette = None,
    contrast: Annotated[float, _flag("contrast", panel=TYPE)] = 3.0,
    add: Annotated[
        list[str] | None,
        typer.Option(
            "--add",
            help="Items that are placed among the words, each as large as a middling one: "
            "files, folders or built-in names. May be given several times.",
            rich_help_panel=shared.PLACING,
        ),
    ] = None,
    photos: shared.AddedPhotos = None,
    share: shared.Share = None,
    delimiter: shared.Delimiter = None,
    decimal: shared.Decimal = None,
    encoding: shared.Encoding = None,
    canvas: shared.Canvas = None,
    quiet_share: shared.QuietShare = 0.4,
    keep_clear: shared.KeepClear = None,
    sizes: shared.Sizes = "shared",
    size_ratio: shared.SizeRatio = 2.0,
    rotate: shared.Rotate = "horizontal",
    padding: shared.Padding = "0.3%",
    target_coverage: shared.TargetCoverage = None,
    max_items: shared.MaxItems = None,
    smallest: shared.Smallest = None,
    largest: Annotated[str | None, _flag("largest", panel=TYPE)] = None,
    filler: shared.Filler = None,
    hero: shared.Hero = None,
    force: shared.Force = None,
    holes: shared.Holes = "fill",
    outline: shared.OutlineChoice = "exact",
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
    text: shared.Text = "outlines",
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
    """Fill a container with words.

    [bold]packwork words heart speech.txt[/]  its hundred most frequent words

    [bold]packwork words bird.png table.csv --rotate 20 -o bird.svg -o bird.png[/]

    [bold]cat *.md | packwork words circle - -n 200 --rotate mixed[/]

    [bold]packwork words cat ar.txt --font "Noto Naskh Arabic"[/]  any script
    """
    with clear_errors():
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.pipeline.wording import words_recipe

        recipe = words_recipe(
            container,
            source,
            **shared.mixing(add, photos, share),
            count=count, min_count=min_count, language=language, stopwords=stopwords,
            min_word_length=min_word_length, include_numbers=include_numbers, regexp=regexp,
            phrases=phrases, plurals=plurals,
            case=case,
            fonts=font,
            font_weight=font_weight,
            weight_is=weight_is,
            color_by=color_by,
            palette=palette,
            contrast=contrast,
            background=background,
            delimiter=delimiter,
            decimal=decimal,
            encoding=encoding,
            canvas=canvas,
            quiet_share=quiet_share,
            keep_clear=keep_clear,
            sizes=sizes,
            size_ratio=size_ratio,
            rotate=rotate,
            padding=padding,
            target_coverage=target_coverage,
            max_items=max_items,
            smallest=smallest,
            largest=largest,
            filler=filler,
            hero=hero,
            force=force,
            holes=holes,
            outline=outline,
            trim=trim, keep_page=keep_page,
            close_gaps=close_gaps,
            alpha_threshold=alpha_threshold, stroke_width=stroke_width,
            seed=seed,
            finish=finish,
            effort=effort,
            epochs=epochs,
            time=time,
            levels=levels,
            start=start,
            stay=stay,
            losses=shared.loss_weights(loss),
        )  # fmt: skip
        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose, recipe=save_recipe,
            pixels=pixels, dpi=dpi, background=background, halo=halo, text=text,
            show_container=show_container, flatten=flatten, film=film, fps=fps, seconds=seconds,
            hold=hold, loop=loop, easing=easing, film_pixels=film_pixels, recipes=recipe.film,
            saliency=show_saliency, no_clobber=no_clobber, cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(recipe, outputs, quiet))

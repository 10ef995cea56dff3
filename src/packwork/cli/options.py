"""Options that commands share. Help comes from the recipe's own fields."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from packwork.recipe import Recipe
from packwork.units import parse_share
from packwork.writers.film.options import FilmOptions

PLACING = "What is placed"
TABLES = "How tables are written"
GAPS = "What fills the voids"
SOLVING = "How it is solved"
WRITING = "What is written"
FILMING = "What is filmed"


def flag(field: str, *names: str, panel: str, **more: Any) -> Any:
    """Typer option whose help is the recipe field's own description."""
    described = Recipe.model_fields[field].description or ""
    return typer.Option(
        *(names or (f"--{field.replace('_', '-')}",)),
        help=described,
        rich_help_panel=panel,
        **more,
    )


def film_flag(field: str, *names: str) -> Any:
    """Typer option of a film: not given, it is what the recipe says, or that default."""
    described = FilmOptions.model_fields[field]
    value = described.default
    shown = {True: "loop", False: "once"}.get(value, value) if field == "loop" else value
    return typer.Option(
        *(names or (f"--{field.replace('_', '-')}",)),
        help=described.description or "",
        show_default=f"{shown:g}" if isinstance(shown, float) else str(shown),
        rich_help_panel=FILMING,
    )


Output = Annotated[
    list[Path] | None,
    typer.Option(
        "-o",
        "--output",
        help="File to write; the ending (.svg, .png, .jpg, .webp, .tif, .pdf, .dxf, .geojson) "
        "picks the format. May be given several times.",
        rich_help_panel=WRITING,
    ),
]
Count = Annotated[str | None, flag("count", "-n", "--count", panel=PLACING)]
Font = Annotated[str | None, flag("font", panel=PLACING)]
Canvas = Annotated[str | None, flag("canvas", panel=PLACING)]
LeastDpi = Annotated[float | None, flag("least_dpi", panel=PLACING)]
Delimiter = Annotated[str | None, flag("delimiter", panel=TABLES)]
Decimal = Annotated[Literal[".", ","] | None, flag("decimal", panel=TABLES)]
Encoding = Annotated[str | None, flag("encoding", panel=TABLES)]
Sizes = Annotated[Literal["free", "shared", "fixed"], flag("sizes", panel=PLACING)]
SizeRatio = Annotated[float, flag("size_ratio", panel=PLACING)]
Stretch = Annotated[float, flag("stretch", panel=PLACING)]
Rotate = Annotated[str, flag("rotate", panel=PLACING)]
Padding = Annotated[str, flag("padding", panel=PLACING)]
Hero = Annotated[str | None, flag("hero", panel=PLACING)]
Palette = Annotated[str | None, flag("palette", panel=PLACING)]
Shades = Annotated[Literal["tint", "nearest", "keep"], flag("shades", panel=PLACING)]
Apart = Annotated[bool, flag("apart", "--apart", panel=PLACING)]
Share = Annotated[str | None, flag("share", panel=PLACING)]
AddedPhotos = Annotated[
    list[str] | None,
    typer.Option(
        "--photos",
        help="Photos that are placed too: files, folders or patterns. May be given several times.",
        rich_help_panel=PLACING,
    ),
]
QuietShare = Annotated[
    float, flag("quiet_share", panel=PLACING, parser=parse_share, metavar="SHARE")
]
KeepClear = Annotated[list[str] | None, flag("keep_clear", panel=PLACING)]
ShowSaliency = Annotated[
    Path | None,
    typer.Option(
        "--show-saliency",
        help="Write a picture (PNG) of what was found of a container around:IMAGE: what stands out "
        "red, a line round what is filled.",
        rich_help_panel=WRITING,
    ),
]
Force = Annotated[list[str] | None, flag("force", panel=PLACING)]
Weights = Annotated[str | None, flag("weights", panel=PLACING)]
Holes = Annotated[Literal["fill", "keep"], flag("holes", panel=PLACING)]
OutlineChoice = Annotated[Literal["exact", "fitted", "hull"], flag("outline", panel=PLACING)]
Strict = Annotated[bool, flag("strict", "--strict", panel=PLACING)]
Trim = Annotated[bool | None, flag("trim", "--trim/--no-trim", panel=PLACING)]
KeepPage = Annotated[bool | None, flag("keep_page", "--keep-page/--drop-page", panel=PLACING)]
CloseGaps = Annotated[str, flag("close_gaps", panel=PLACING)]
AlphaThreshold = Annotated[float, flag("alpha_threshold", panel=PLACING)]
StrokeWidth = Annotated[Literal["scaled", "even"], flag("stroke_width", panel=PLACING)]
Seed = Annotated[int, flag("seed", panel=SOLVING)]
Finish = Annotated[Literal["exact", "none"], flag("finish", panel=SOLVING)]
TargetCoverage = Annotated[
    float | None, flag("target_coverage", panel=GAPS, parser=parse_share, metavar="SHARE")
]
MaxItems = Annotated[int | None, flag("max_items", panel=GAPS)]
Smallest = Annotated[str | None, flag("smallest", panel=GAPS)]
Filler = Annotated[list[str] | None, flag("filler", panel=GAPS)]
Effort = Annotated[Literal["draft", "normal", "best"], flag("effort", panel=SOLVING)]
Epochs = Annotated[int | None, flag("epochs", panel=SOLVING)]
Time = Annotated[float | None, flag("time", panel=SOLVING)]
Preset = Annotated[Literal["default", "paper"], flag("preset", panel=SOLVING)]
Levels = Annotated[str | None, flag("levels", panel=SOLVING)]
Start = Annotated[str | None, flag("start", panel=SOLVING)]
Stay = Annotated[bool, flag("stay", "--stay", panel=SOLVING)]
Loss = Annotated[
    list[str] | None,
    typer.Option(
        "--loss",
        help="A loss and its weight, in place of the preset's or beside them: NAME=1 or "
        "MODULE:FUNCTION=1; 0 switches one off. May be given several times.",
        rich_help_panel=SOLVING,
    ),
]
Pixels = Annotated[
    int, typer.Option("--pixels", help="Longer side of a PNG or JPEG.", rich_help_panel=WRITING)
]
Dpi = Annotated[
    float | None,
    typer.Option(
        "--dpi",
        help="Pixels to the inch of paper: of photos (default 300), and of a PNG or JPEG in place "
        "of --pixels.",
        rich_help_panel=WRITING,
    ),
]
Background = Annotated[
    str | None,
    typer.Option(
        "--background",
        help="Any CSS colour, or none. Default: none in SVG and PDF, white in PNG.",
        rich_help_panel=WRITING,
    ),
]
ShowContainer = Annotated[
    bool,
    typer.Option("--show-container", help="Draw the container's line.", rich_help_panel=WRITING),
]
Halo = Annotated[
    Literal["none", "faint", "all"],
    typer.Option(
        "--halo",
        help="A rim that makes items stand out from the background, in SVG, PNG, JPEG and PDF: "
        "faint (of those that are hardly to be seen on it) or all.",
        rich_help_panel=WRITING,
    ),
]
Flatten = Annotated[
    bool,
    typer.Option(
        "--flatten",
        help="In SVG, repeat each drawing in place, for tools that choke on <use>.",
        rich_help_panel=WRITING,
    ),
]
Text = Annotated[
    Literal["outlines", "live"],
    typer.Option(
        "--text",
        help="Words in SVG: outlines, or live text that can be selected and found, in parts of "
        "their fonts that the file carries.",
        rich_help_panel=WRITING,
    ),
]
Report = Annotated[
    Path | None,
    typer.Option("--report", help="Write measures and times as JSON.", rich_help_panel=WRITING),
]
Diagnose = Annotated[
    Path | None,
    typer.Option(
        "--diagnose",
        help="Write the diagnostic picture (PNG): container yellow, items grey, overlap "
        "red, what sticks out blue.",
        rich_help_panel=WRITING,
    ),
]
Film = Annotated[
    list[Path] | None,
    typer.Option(
        "--film",
        help="Film of the run to write; the ending (.svg, .gif, .apng, .webp, .mp4, .webm, .json "
        "for Lottie) picks the format. May be given several times.",
        rich_help_panel=FILMING,
    ),
]
Fps = Annotated[float | None, film_flag("fps")]
Seconds = Annotated[float | None, film_flag("seconds")]
Hold = Annotated[float | None, film_flag("hold")]
Loop = Annotated[bool | None, film_flag("loop", "--loop/--once")]
Easing = Annotated[Literal["smooth", "linear"] | None, film_flag("easing")]
FilmPixels = Annotated[int | None, film_flag("film_pixels")]
SaveRecipe = Annotated[
    Path | None,
    typer.Option(
        "--save-recipe",
        help="Write the recipe (TOML) that repeats this run.",
        rich_help_panel=WRITING,
    ),
]
Cut = Annotated[
    Literal["outlines", "silhouette"] | None,
    typer.Option(
        "--cut",
        help="Lines for a cutter in SVG and PDF (there in the spot colour CutContour) too: "
        "outlines, or silhouette: one closed line round each item. Default: outlines in DXF only.",
        rich_help_panel=WRITING,
    ),
]
KissCut = Annotated[
    str | None,
    typer.Option(
        "--kiss-cut",
        help="Cut at this distance round each item, a length such as 2mm, in DXF, SVG and PDF; the "
        "padding is at least twice that.",
        rich_help_panel=WRITING,
    ),
]
Bleed = Annotated[
    str | None,
    typer.Option(
        "--bleed",
        help="Let a PDF's background reach beyond the sheet on each side, a length such as 3mm; "
        "its boxes say where it is trimmed.",
        rich_help_panel=WRITING,
    ),
]
NoClobber = Annotated[
    bool,
    typer.Option(
        "--no-clobber",
        help="Keep files that are there already: refuse to run if one is to be written.",
        rich_help_panel=WRITING,
    ),
]
Quiet = Annotated[
    bool, typer.Option("-q", "--quiet", help="Print nothing but warnings and errors.")
]


def mixing(add: list[str] | None, photos: list[str] | None, share: str | None) -> dict[str, Any]:
    """Options of a recipe about what is mixed in with words.

    Examples
    --------
    >>> mixing(["star"], None, "words=80%,items=20%")
    {'add': ['star'], 'photos': None, 'share': 'words=80%,items=20%'}
    """
    return {
        "add": add or [], "photos": {"sources": photos} if photos else None, "share": share,
    }  # fmt: skip


def loss_weights(losses: list[str] | None) -> dict[str, float]:
    """Losses by name from ``NAME=WEIGHT`` texts; a bare name weighs 1.

    A module of one's own is found in the working folder too, as ``python -m`` finds it.

    Raises
    ------
    RecipeError
        If a weight is not a number.

    Examples
    --------
    >>> loss_weights(["overlap=2", "mine:calm"])
    {'overlap': 2.0, 'mine:calm': 1.0}
    """
    from packwork.errors import RecipeError

    weights = {}
    for text in losses or []:
        name, _, weight = text.partition("=")
        try:
            weights[name] = float(weight or 1)
        except ValueError:
            raise RecipeError("loss", f"use NAME=WEIGHT with a number, not {text!r}") from None
    if any(":" in name for name in weights):
        find_own_modules()
    return weights


def find_own_modules() -> None:
    """Let modules of the working folder be found, after all others."""
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))

"""Options that only command lines have: names of files, and what is printed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import Field

from packwork.offers import Group, Offer, Verbs
from packwork.options import Options


class LayoutFiles(Options):
    """Layouts and films to write."""

    offers = Offer(group=Group.WRITTEN, verbs=Verbs.EVERY)

    output: Annotated[tuple[Path, ...], Offer(flags="-o --output")] = ()
    """File to write; the ending (.svg, .png, .jpg, .webp, .tif, .pdf, .dxf, .geojson, or
    .packwork, a session to go on from) picks the format. May be given several times."""

    film: Annotated[tuple[Path, ...], Offer(group=Group.FILM)] = ()
    """Film of the run to write; the ending (.svg, .gif, .webp, .mp4, .webm, .json for
    Lottie) picks the format. May be given several times."""


class SideFiles(Options):
    """Further files to write, and whether files may be replaced."""

    offers = Offer(group=Group.WRITTEN, verbs=Verbs.EVERY)

    show_saliency: Annotated[Path | None, Offer(verbs=Verbs.COLLAGES)] = None
    """Write a picture (PNG) of what was found of a container around:IMAGE: what stands out red, a
    line round what is filled."""

    report: Path | None = None
    """Write measures and times as JSON."""

    diagnose: Path | None = None
    """Write the diagnostic picture (PNG): container yellow, items grey, overlap red, what sticks
    out blue."""

    preflight: Annotated[bool, Offer(group=Group.PRINTED)] = False
    """Print what a print shop looks at in each PDF and SVG: resolution of pictures, thin lines,
    small text, transparency, what ends near the trim, colours that are no inks."""

    save_recipe: Path | None = None
    """Write the recipe (TOML) that repeats this run."""

    no_clobber: bool = False
    """Keep files that are there already: refuse to run if one is to be written."""


class Choosing(Options):
    """Number of runs to choose from."""

    offers = Offer(group=Group.SOLVED, verbs=Verbs.EVERY)

    best_of: Annotated[int, Field(ge=1, le=10_000)] = 1
    """Try so many seeds, from --seed on, on all cores, and keep the best."""

    best_by: str = "coverage"
    """What the best of several is: coverage, evenness, or a metric of the report such as LC_ink,
    with a minus where less is better."""

    contact_sheet: Annotated[Path | None, Offer(group=Group.WRITTEN)] = None
    """Write a picture (PNG) of all that --best-of has tried, the best first, or of all steps of a
    series."""


class Serial(Options):
    """A layout for each step of a table."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.WORDS)

    series: Annotated[str | None, Offer(metavar="TABLE:COLUMN")] = None
    """Table of words and its column of steps, as talks.csv:year, in place of SOURCE: a layout for
    each step, all on one scale, words in their places for as long as goes."""


class SerialMarks(Options):
    """A chart for each step of a table."""

    offers = Offer(group=Group.MARKS, verbs=Verbs.CHART)

    series: Annotated[str | None, Offer(metavar="COLUMN")] = None
    """Column of steps, as year: a chart for each, all at one scale, marks of one name in their
    places for as long as goes. --by-step takes so many numbers together."""


class Terminal(Options):
    """Output on the terminal."""

    offers = Offer(verbs=Verbs.EVERY)

    quiet: Annotated[bool, Offer(flags="-q --quiet")] = False
    """Print nothing but warnings and errors."""

"""``packwork demo``: a collage of the built-in icons, or a word, each letter of another use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.recipe import Recipe, make_recipe

DEMOS: dict[str, dict[str, object]] = {
    "bear": {"count": 100, "seed": 0},
    "heart": {"count": 100, "seed": 1},
    "dragon": {"count": 140, "seed": 2},
    "islands": {"count": 90, "rotate": "30"},
}
"""Demos with options of their own; every other built-in container is filled with 100."""

TEASER = "teaser"
"""The demo of many ways: letters beside each other."""

NAMES = f"{', '.join(DEMOS)}, {TEASER} or another built-in container."


@shared.by_name
def demo(
    name: Annotated[
        str,
        typer.Argument(metavar="[NAME]", help=NAMES),
    ] = "bear",
    folder: Annotated[Path, typer.Option("--folder", help="Where the pictures go.")] = Path("out"),
    *,
    no_clobber: bool,
    quiet: bool,
) -> None:
    """Make a collage of the built-in icons and write it as SVG and PNG.

    [bold]packwork demo[/]  a bear

    [bold]packwork demo dragon --folder pictures[/]

    [bold]packwork demo teaser[/]  a word, each letter in a way of its own
    """
    with clear_errors():
        if name == TEASER:
            raise typer.Exit(make_teaser(folder, quiet, no_clobber=no_clobber))
        from packwork.cli.outputs import Outputs
        from packwork.cli.running import run_and_write
        from packwork.writers import write_options

        recipe = make_recipe(container=f"builtin:{name}", **DEMOS.get(name, {"count": 100}))
        files = [folder / f"{name}{ending}" for ending in (".svg", ".png", ".geojson")]
        outputs = Outputs(files=files, options=write_options(), keeps_files=no_clobber)
        raise typer.Exit(run_and_write(recipe, outputs, quiet))


SWEETS = ("donut", "icecream", "cherry", "apple", "pear", "carrot", "mushroom", "teacup")
GARDEN = ("flower", "apple", "snail", "leaf", "butterfly", "tulip", "cherry", "mushroom")
EARTH = ("#7a3b5e", "#f26b4e", "#e9b441", "#1f7a7a")
PAPER = "#fbf1de"

LETTER_PX = 600
"""Height of each letter on the sheet. Chosen."""

SPACE_PX = LETTER_PX // 20
"""Between two letters and around them."""


@dataclass(frozen=True)
class TeaserLetter:
    """A letter and how it is filled; its name, with what is shown, is part of its files' names."""

    name: str
    items: Sequence[str]
    options: Mapping[str, object] = field(default_factory=dict)
    is_pile: bool = False

    @property
    def recipe(self) -> Recipe:
        """Recipe to run."""
        from packwork.uses import pile_recipe

        make = pile_recipe if self.is_pile else make_recipe
        return make(container=f"text:{self.name[0]}", items=list(self.items), **self.options)


AXIS: Mapping[str, object] = {"count": 60, "start": "medial-axis", "size_ratio": 1.7, "seed": 1}

LETTERS = (
    TeaserLetter("S-plain", GARDEN, {"count": 70, "seed": 1}),
    TeaserLetter("I-padded", SWEETS, {"count": 40, "padding": "6", "seed": 1}),
    TeaserLetter("G-axis", ("icons",), {**AXIS, "count": 20, "size_ratio": 1.2}),
    TeaserLetter("G-filled", ("icons",), AXIS),
    TeaserLetter(
        "R-blocks",
        ("square",),
        {"count": 84, "stretch": 2, "size_ratio": 1.5, "padding": "2", "palette": ",".join(EARTH)},
    ),
    TeaserLetter("A-forced", ("icons",), {"count": 50, "force": "down", "seed": 1}),
    TeaserLetter(
        "P-poured",
        ("apple", "pear", "donut", "cherry"),
        {"count": 70, "size": "8%", "open": "top", "emit": "top", "release": 1, "seed": 1},
        is_pile=True,
    ),
    TeaserLetter("H-heaped", ("icons",), {"count": 105, "size": "8%", "open": "top"}, is_pile=True),
)
"""What the word is made of, from left to right."""


def make_teaser(
    folder: Path,
    quiet: bool,
    letters: Sequence[TeaserLetter] = LETTERS,
    *,
    no_clobber: bool = False,
) -> int:
    """Fill all letters, write each, and all of them beside each other; the exit code."""
    from packwork import writers
    from packwork.cli.failure import INTERRUPTED
    from packwork.cli.outputs import Outputs
    from packwork.cli.running import run_and_write

    sheet = folder / "teaser.png"
    writers.check_output(sheet)
    if no_clobber:
        writers.check_new([sheet])
    options = writers.write_options(pixels=2 * LETTER_PX, background=PAPER)
    pictures, codes = [], [0]
    for place, letter in enumerate(letters, start=1):
        stem = f"teaser-{place}-{letter.name}"
        files = [folder / f"{stem}{ending}" for ending in (".svg", ".png")]
        outputs = Outputs(files=files, options=options, keeps_files=no_clobber)
        codes.append(run_and_write(letter.recipe, outputs, quiet))
        if codes[-1] == INTERRUPTED:
            return INTERRUPTED
        pictures.append(files[-1])
    writers.write_all([(sheet, beside_each_other(pictures))])
    return max(codes)


def beside_each_other(pictures: Sequence[Path]) -> bytes:
    """PNG of pictures in a row, all of one height."""
    from PIL import Image

    from packwork.raster.drawing import encoded_picture

    row = []
    for path in pictures:
        with Image.open(path) as drawn:
            width = max(1, round(drawn.width * LETTER_PX / drawn.height))
            row.append(drawn.convert("RGB").resize((width, LETTER_PX), Image.Resampling.LANCZOS))
    width = sum(picture.width + SPACE_PX for picture in row) + SPACE_PX
    sheet = Image.new("RGB", (width, LETTER_PX + 2 * SPACE_PX), PAPER)
    left = SPACE_PX
    for picture in row:
        sheet.paste(picture, (left, SPACE_PX))
        left += picture.width + SPACE_PX
    return encoded_picture(sheet, "PNG", optimize=True)

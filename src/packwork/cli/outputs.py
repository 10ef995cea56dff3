"""All that a run is to write, and what has to hold for it: checked before anything is run."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from packwork import pipeline, writers
from packwork.cli.options import Choosing, part_of
from packwork.cli.terminal import say
from packwork.errors import RecipeError, WriteError
from packwork.readers.layouts.read import SESSION, is_session
from packwork.recipe import AUTO, Recipe
from packwork.recipe.verbs import film_options
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.sources import check_no_input
from packwork.units import length_asked, split_length
from packwork.uses.icons import NO_CONTAINER
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import GONE_ON_WITH, DrawingOptions
from packwork.writers.prepress.options import PrintOptions


@dataclass(frozen=True, kw_only=True)
class Outputs:
    """All that one run is to write; ``drawing`` are options of drawing as they were given."""

    files: Sequence[Path]
    options: writers.WriteOptions
    films: Sequence[Path] = ()
    filming: FilmOptions = field(default_factory=FilmOptions)
    report: Path | None = None
    diagnose: Path | None = None
    recipe: Path | None = None
    saliency: Path | None = None
    keeps_files: bool = False
    preflight: bool = False
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
        """Refuse, before anything is run, paths that cannot be written or that collide."""
        self.check_paths()
        check_choosing(self.choosing)
        check_printing(self.files, self.options.printing)

    def check_paths(self) -> None:
        """The same without what is only of one layout."""
        for path in self.files:
            if not is_session(path):
                writers.check_output(path, SESSION)
        for path in self.films:
            writers.check_film(path)
        writers.check_all(self.every, keeps=self.keeps_files)

    def with_drawing(self, layout: Layout) -> Layout:
        """The layout, its manifest saying how it is drawn, for files that are gone on with."""
        background = self.options.svg.background
        asked = {key: self.drawing[key] for key in GONE_ON_WITH if self.drawing.get(key)}
        said = {} if background is None else {"ground": hex_colour(parse_colour("", background))}
        if not asked and not said:
            return layout
        return replace(layout, manifest={**layout.manifest, **said, "drawing": asked})

    def saved_recipe(self, recipe: Recipe) -> list[tuple[Path, bytes]]:
        """The recipe's file, if one is asked for, and its bytes."""
        if self.recipe is None:
            return []
        if self.filming.model_fields_set:
            recipe = recipe.model_copy(update={"film": self.filming})
        return [(self.recipe, writers.recipe_bytes(recipe.plain(), self.recipe.parent))]

    def check_read(self, job: pipeline.Job) -> None:
        """Refuse, once all is read, to write over any of it, and what the container cannot be."""
        for path in self.every:
            check_no_input(path)
        self._check_edge(job.container)
        if job.recipe.container != NO_CONTAINER:
            pictures = [*self.files, *([] if self.diagnose is None else [self.diagnose])]
            for path in pictures:
                writers.check_picture_size(path, job.container, self.options)

    def _check_edge(self, container: Container) -> None:
        """Refuse what needs an edge of a tile, which would be found when it is written."""
        endings, svg = {path.suffix.lower() for path in self.files}, self.options.svg
        is_drawn = bool(endings & {".svg", ".pdf"})
        for key, what, is_asked in (
            ("output", "lines for a DXF", ".dxf" in endings),
            ("film", "film", bool(self.films)),
            ("cut", "lines for a cutter", is_drawn and svg.cut is not None and svg.cut.is_asked),
            ("flatten", "items without <use>", svg.flatten and ".svg" in endings),
        ):
            if is_asked:
                container.check_edge(key, what)


def outputs_asked(
    asked: Mapping[str, Any], default: Path, recipes: FilmOptions | None = None
) -> Outputs:
    """Outputs that the options of a command ask for; ``recipes`` is how its recipe makes films."""
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
        preflight=asked["preflight"],
        choosing=part_of(Choosing, asked),
        drawing=drawing,
    )
    return outputs if outputs.every else replace(outputs, files=[default])


def check_choosing(choosing: Choosing) -> None:
    """Refuse what has no meaning for a choice."""
    if choosing.best_of == 1:
        for key, usual in Choosing().model_dump(exclude={"best_of"}).items():
            if getattr(choosing, key) != usual:
                raise RecipeError(key, "is of --best-of; say of how many, as --best-of 8")
        return
    from packwork.batches.seeds import check_metric

    check_metric(choosing.best_by)


HAIR = 1.001
"""Factor on twice the distance: lines that are cut do not touch. Smaller is lost in rounding."""


def with_room(recipe: Recipe, kiss: str | None) -> Recipe:
    """Recipe whose padding lets lines at a distance lie between items, if none was asked for."""
    number, unit = split_length(kiss or "") or (0.0, "")
    if number <= 0 or recipe.padding != AUTO:
        return recipe
    padding = f"{2 * number * HAIR:.12g}{unit}"
    say(f"padding is {padding}, twice the --kiss-cut, so that no two cut lines meet")
    return recipe.model_copy(update={"padding": padding})


def check_room(job: pipeline.Job, kiss: str | None) -> None:
    """Refuse a padding between which two lines at a distance would not fit."""
    if kiss is None:
        return
    container = job.container
    offset = length_asked("kiss_cut", kiss, container.unit, container.side)
    if job.recipe.padding_cu(container) < 2 * offset:
        raise RecipeError(
            "kiss_cut",
            f"{kiss} on either side needs a --padding of {2 * HAIR * offset:.6g} {container.unit} "
            f"or more, not {job.recipe.padding}; without one it becomes so wide",
        )


def check_printing(files: Iterable[Path], asked: PrintOptions) -> None:
    """Refuse wishes of a print shop where none of the files is a PDF."""
    files, given = list(files), asked.given()
    if given and not any(file.suffix.lower() == ".pdf" for file in files):
        flag = given[0]
        raise WriteError(files[0], f"has no {flag}; --{flag} is for a PDF, such as -o print.pdf")


@contextlib.contextmanager
def saving(layout: Layout, files: Iterable[Path]) -> Iterator[list[tuple[Path, bytes]]]:
    """Session files among outputs, and their bytes, for the block to write."""
    paths = [path for path in files if is_session(path)]
    if not paths:
        yield []
        return
    # Only what is asked for loads all of a session.
    from packwork.live.file.disk import saving as saving_them

    with saving_them(layout, paths) as written:
        yield written

"""Photographs that fill a container, icons among them, or are tiles of a mosaic on a grid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.copies import expand_copies
from packwork.pipeline.read import Material, read_named
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.steps.lay_grid import TILES, LayGrid, hardly_shown
from packwork.steps.shortfalls import usual_remedy
from packwork.uses.collage import filling, placing, reporting
from packwork.uses.icons import KnownContainer, material_of
from packwork.uses.letters import copies_for_letters
from packwork.uses.photos.crop import AdviseOnEdge, CropAtEdge, crops

SQUARE = "square"
"""Shape of photos where none is asked for: the largest square in the middle of each."""


@final
class GridUse(Use):
    """Photographs in the cells of a grid."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """A choice of photos for the cells; measures and looks."""
        recipe, target = job.recipe, job.target
        assert target is not None  # noqa: S101
        most = recipe.count if isinstance(recipe.count, int) else TILES
        return [LayGrid(target, most, recipe.repeats), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False, shows_shape=False, judge=hardly_shown)


def read_grid(recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None) -> Material:
    """Photographs of a recipe, each once, whatever the number of tiles."""
    photos = recipe.photos
    if photos is None:
        raise RecipeError("grid", "is of photos; use packwork photos")
    if photos.edge == "crop":
        raise RecipeError("edge", "crop is of photos that lie freely; leave out --grid")
    if photos.shape is None:
        photos = photos.model_copy(update={"shape": SQUARE})
    named = read_named(recipe.model_copy(update={"photos": photos}), given)
    once = recipe.model_copy(update={"count": None})
    return Material(
        use=GridUse(),
        container=room.known,
        cast=expand_copies(once, named.items),
        fillers=named.items,
        skipped=named.skipped,
    )


PHOTO_STARTS = ("distance-field", "medial-axis", "scatter")
"""Starts that are tried of photos; what a short finish makes of the levels of each tells which ends
best. Covers up to a hundredth more than the first alone in the same time. Measured."""


@final
@dataclass(frozen=True)
class PhotosUse(Use):
    """Photographs; ``is_cut`` for those at the container's edge.

    Parameters
    ----------
    repeated
        How many there are, and copies of them, where the run repeats them for letters to be read.
    """

    is_cut: bool
    repeated: tuple[int, int] | None = None

    def steps(self, job: Job) -> Sequence[RunStep]:
        """The best of several starts; photos may be cut at the container's line."""
        if self.is_cut:
            return [CropAtEdge(job, _placed), *self.report(job)]
        return [*_placed(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        told = reporting(job, is_dressed=False)
        if self.is_cut:
            told.append(AdviseOnEdge())
        if self.repeated is not None:
            kinds, total = self.repeated
            told.append(RemarkRepeated(kinds, total))
        return told

    def remedy(self, job: Job) -> str | None:
        """Photos cut at the container's line, where they may be, or more of them."""
        photos = job.recipe.photos
        if self.is_cut or photos is None:
            return None
        cut = photos.model_copy(update={"edge": "crop"})
        try:
            crops(job.recipe.model_copy(update={"photos": cut}))
        except RecipeError:
            return None
        others = usual_remedy(job, len(job.items))
        return "; ".join(filter(None, (Sentence.CROPPED.of(), others)))


@final
class RemarkRepeated(RunStep):
    """Remark on photos that were repeated for letters to be read."""

    def __init__(self, kinds: int, total: int) -> None:
        self._kinds, self._total = kinds, total

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the remark."""
        many = number_of(self._kinds, "photo is", "photos are")
        said = {"many": many, "total": self._total, "option": f"-n {self._kinds}"}
        return state.with_finding(Sentence.READ_LETTERS, **said)


def _placed(job: Job) -> list[RunStep]:
    """Steps that place photos whole; first fit fills less than levels, by three points."""
    return [*placing(job, suits_first_fit=False, methods=starts_tried(job)), *filling(job)]


def starts_tried(job: Job) -> tuple[str, ...]:
    """Starts of which the best is gone on with; none where one is given or there is no time.

    Nor where sizes are not free, or a picture chooses places.
    """
    plan = job.plan
    is_open = plan.method is None and not plan.is_from_layout and not plan.detail
    is_patient = plan.seconds is None and plan.effort != "draft"
    return PHOTO_STARTS if is_open and is_patient and plan.sizes == "free" and plan.is_exact else ()


def read_collage(recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None) -> Material:
    """Photographs of a recipe, and the items among them."""
    if recipe.grid:
        # Only what is asked for is loaded.
        from packwork.uses.photos.use import read_grid

        return read_grid(recipe, room, given)
    found = material_of(PhotosUse(crops(recipe)), recipe, room, given)
    kinds = found.fillers
    total = copies_for_letters(recipe, len(kinds), lambda: room.needed(recipe, kinds))
    if total is None:
        return found
    use = PhotosUse(crops(recipe), (len(kinds), total))
    return replace(found, use=use, cast=expand_copies(recipe, kinds, total))

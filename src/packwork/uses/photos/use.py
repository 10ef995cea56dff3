"""Photographs that fill a container, icons among them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from packwork.pipeline.job import Job, Use
from packwork.pipeline.read import Material
from packwork.pipeline.run import RunStep
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.uses.collage import filling, placing, reporting
from packwork.uses.icons import KnownContainer, material_of
from packwork.uses.photos.crop import CropAtEdge, crops

PHOTO_STARTS = ("distance-field", "medial-axis", "scatter")
"""Starts that are tried of photos; what a short finish makes of the levels of each tells which ends
best. Covers up to a hundredth more than the first alone in the same time. Measured."""


@final
@dataclass(frozen=True)
class PhotosUse(Use):
    """Photographs; ``is_cut`` for those at the container's edge."""

    is_cut: bool

    def steps(self, job: Job) -> Sequence[RunStep]:
        """The best of several starts; photos may be cut at the container's line."""
        if self.is_cut:
            return [CropAtEdge(job, _placed), *self.report(job)]
        return [*_placed(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False)


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
        from packwork.uses.photos.grid import read_grid

        return read_grid(recipe, room, given)
    return material_of(PhotosUse(crops(recipe)), recipe, room, given)

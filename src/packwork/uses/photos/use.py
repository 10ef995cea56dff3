"""Photographs that fill a container, icons among them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.read import Material
from packwork.pipeline.result import Run
from packwork.pipeline.run import along
from packwork.pipeline.use import Use
from packwork.pipeline.watch import Watch
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.uses.icons import material_of
from packwork.uses.photos.crop import crops, run_cropped
from packwork.uses.photos.starts import jobs_tried
from packwork.uses.room import Room


@final
@dataclass(frozen=True)
class Photos(Use):
    """Photographs; ``is_cut`` for those at the container's edge."""

    is_cut: bool

    def run(self, job: Job, watch: Watch) -> Run:
        """The common road, or that of photos cut at the container's line."""
        if self.is_cut:
            return run_cropped(job, watch)
        return measured(Unmeasured.of(along(job, watch)))

    def suits_first_fit(self, count: int, is_turning: bool) -> bool:
        """Never: photos by themselves fill more by the levels, three points."""
        del count, is_turning
        return False

    def starts(self, job: Job) -> Sequence[Job]:
        """One job for each of several starts, where none was asked for."""
        return jobs_tried(job)


def read_collage(recipe: Recipe, room: Room, given: Sequence[Item] | None) -> Material:
    """Photographs of a recipe, and the items among them."""
    return material_of(Photos(crops(recipe)), recipe, room, given)

"""The one place that knows every stage: from a recipe to a measured layout."""

from packwork.pipeline.casting import item_weights
from packwork.pipeline.charting import chart_recipe
from packwork.pipeline.job import Clock, Job, Letters, read
from packwork.pipeline.outcome import Run, Unplaced, find_unplaced
from packwork.pipeline.padding import padded
from packwork.pipeline.photographing import photos_recipe
from packwork.pipeline.piling import pile_recipe
from packwork.pipeline.resolving import coarse_photos
from packwork.pipeline.run import fill, run
from packwork.pipeline.warming import KERNELS, warm_up
from packwork.pipeline.wording import words_recipe

__all__ = [
    "KERNELS",
    "Clock",
    "Job",
    "Letters",
    "Run",
    "Unplaced",
    "chart_recipe",
    "coarse_photos",
    "fill",
    "find_unplaced",
    "item_weights",
    "padded",
    "photos_recipe",
    "pile_recipe",
    "read",
    "run",
    "warm_up",
    "words_recipe",
]

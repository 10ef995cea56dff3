"""A run in values: its job and plan, the state that steps take and give, the loop, the result."""

from packwork.pipeline.findings import Unplaced
from packwork.pipeline.job import Clock, Job
from packwork.pipeline.plan.copies import item_weights
from packwork.pipeline.plan.limits import padded
from packwork.pipeline.plan.resolution import coarse_photos, tell_coarse
from packwork.pipeline.result import Run, find_unplaced
from packwork.pipeline.run import run

__all__ = [
    "Clock",
    "Job",
    "Run",
    "Unplaced",
    "coarse_photos",
    "find_unplaced",
    "item_weights",
    "padded",
    "run",
    "tell_coarse",
]

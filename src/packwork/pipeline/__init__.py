"""The road that every run takes: start, levels, exact finish, voids, measuring."""

from packwork.pipeline.job import Clock, Job
from packwork.pipeline.plan.cast import item_weights
from packwork.pipeline.plan.padding import padded
from packwork.pipeline.plan.resolution import coarse_photos, tell_coarse
from packwork.pipeline.result import Run, Unplaced, find_unplaced
from packwork.pipeline.run import run
from packwork.pipeline.warming import KERNELS, warm_up, warm_up_once

__all__ = [
    "KERNELS",
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
    "warm_up",
    "warm_up_once",
]

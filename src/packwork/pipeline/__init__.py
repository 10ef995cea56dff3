"""The road that every run takes: start, levels, exact finish, voids, measuring."""

from packwork.pipeline.findings import Unplaced
from packwork.pipeline.job import Clock, Job
from packwork.pipeline.painted import PAINTED_BYTES, painted_pixels
from packwork.pipeline.plan.cast import item_weights
from packwork.pipeline.plan.padding import padded
from packwork.pipeline.plan.resolution import coarse_photos, tell_coarse
from packwork.pipeline.result import Run, find_unplaced
from packwork.pipeline.run import run
from packwork.pipeline.warming import KERNELS, warm_up, warm_up_once
from packwork.pipeline.written import faults_in_file, on_trust_in_file

__all__ = [
    "KERNELS",
    "PAINTED_BYTES",
    "Clock",
    "Job",
    "Run",
    "Unplaced",
    "coarse_photos",
    "faults_in_file",
    "find_unplaced",
    "item_weights",
    "on_trust_in_file",
    "padded",
    "painted_pixels",
    "run",
    "tell_coarse",
    "warm_up",
    "warm_up_once",
]

"""Bars of equal upright marks in rows: Isotype.

After O. Neurath, "International Picture Language", 1936: a larger number is shown by more signs of
one size, side by side in rows that are as long as each other. Rows lie on each other from the foot
of a bar, each begun at the left.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.options import HAIR
from packwork.errors import RecipeError
from packwork.pipeline.job import Job
from packwork.scene.pose import Poses
from packwork.steps.finish import gap_with_bulge
from packwork.steps.place import first_angles
from packwork.uses.charts.copies import unit_scales
from packwork.uses.charts.layout import Chart, is_alike_and_round


def are_in_rows(job: Job, chart: Chart) -> bool:
    """Whether marks are equal and upright; equal discs lie closer in each other's hollows.

    Parts of a mark, of what is left over of a unit, take the place of a whole one.
    """
    is_equal = chart.options.unit is not None or bool(np.ptp(chart.read.areas) == 0)
    if not is_equal or not job.plan.rotation.is_still or is_alike_and_round(chart.read):
        return False
    return not first_angles(job, np.random.default_rng(job.plan.seed)).any()


def in_rows(job: Job, chart: Chart, ranks: IntArray) -> Poses:
    """Poses of all marks, as large as the fullest bar has room for; of low rank first."""
    units = unit_scales(job)
    outlines = zip(job.solid_outlines, units.tolist(), strict=True)
    boxes = np.array([unit * np.array(outline.bounds) for outline, unit in outlines])
    size = (boxes[:, 2:] - boxes[:, :2]).max(axis=0)
    left, top, right, foot = chart.cells[0].room.bounds
    most = max(len(own) for own in chart.members)
    gap = gap_with_bulge(job, np.arange(len(units)), units) + 4 * HAIR * job.container.side

    def scale(across: int) -> float:
        cells = np.array([across, -(-most // across)])
        room = np.array([right - left, foot - top]) - gap
        return float(((room / cells - gap) / size).min())

    across = max(range(1, most + 1), key=scale)
    common = scale(across)
    if common <= 0:
        raise RecipeError("padding", "leaves no room for marks in a bar; use a smaller one")
    pitch = common * size + gap
    x, y = np.zeros(len(units)), np.zeros(len(units))
    # Parts of a mark end the row of those of one rank: a bar has no hole in its middle.
    is_part = chart.read.values < (1 - 1e-9) * (chart.options.unit or 0.0)
    for cell, own in zip(chart.cells, chart.members, strict=True):
        ordered = own[np.lexsort((is_part[own], ranks[own]))]
        row, column = np.divmod(np.arange(len(own)), across)
        middle = common * (boxes[ordered, 0] + boxes[ordered, 2]) / 2
        # The left part of a mark lies where that of a whole one would.
        left_part = common * (boxes[ordered, 0] + size[0] / 2)
        middle = np.where(is_part[ordered], left_part, middle)
        x[ordered] = cell.middle + (column - (across - 1) / 2) * pitch[0] - middle
        y[ordered] = foot - gap - row * pitch[1] - common * boxes[ordered, 3]
    return Poses(x, y, np.zeros(len(units)), common * units)

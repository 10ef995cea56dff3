"""Estimated heights of piles in bars, by which canvas and scale are chosen."""

from __future__ import annotations

import numpy as np

from packwork.readers.charts.chart import ChartRead

COVER = 0.66
"""Share of a bar that marks are thought to cover before that is known. Larger lets marks come out
smaller than the width allows, smaller leaves paper over bars. Chosen: heaps of beans have 0.74."""

ROUND = 0.98
"""Share of the disc that holds it which a round mark covers at least. Chosen."""

HOLLOW = 3**0.5 / 2
"""Height of a row of discs that lies in the hollows of the one below, over their distance."""

UNEVEN = 1.06
"""Height of heaps of such rows over that of perfect ones. Measured on bars of 21 to 52 laureates,
in docs' example: 1.01 to 1.16, the middle one 1.06."""


def is_alike_and_round(chart: ChartRead) -> bool:
    """Whether all marks are one and the same disc."""
    first = chart.items[0].outline
    is_round = first.area > ROUND * np.pi * first.radius**2
    is_alike = all(item.outline is first for item in chart.items)
    return is_round and is_alike and bool(np.ptp(chart.areas) == 0)


def rows_in_hollows(most: int, width: float, height: float, gap: float) -> tuple[int, float]:
    """Number of discs in a row, and their distance, so that they are as large as goes.

    Bars are as wide as so many discs and a half: rows then lie in the hollows of those below.

    Parameters
    ----------
    most
        Discs of the fullest bar.
    width, height
        Of a bar at most.
    gap
        Between discs.

    Examples
    --------
    >>> rows_in_hollows(52, 1.0, 6.0, 0.0)
    (3, 0.2857142857142857)
    """

    def distance(across: int) -> float:
        by_width = (width - gap) / (across + 0.5)
        by_height = (height - gap) / height_over_distance(most, across)
        return float(min(by_width, by_height))

    across = max(range(1, most + 1), key=distance)
    return across, distance(across)


def height_over_distance(most: int, across: int) -> float:
    """Height of so many discs in rows of so many, over their distance."""
    rows = -(-most // across)
    return UNEVEN * (1 + (rows - 1) * HOLLOW)


def needed_height(chart: ChartRead, width: float, height: float) -> float:
    """Height that the fullest bar needs, at most the one given; its width is that of the bars."""
    if is_alike_and_round(chart):
        most = int(np.bincount(chart.group_of).max())
        across, distance = rows_in_hollows(most, width, height, 0.0)
        return min(height, distance * height_over_distance(most, across))
    radii = np.array([item.outline.radius for item in chart.items])
    own = np.array([item.outline.area for item in chart.items])
    widest = width / (2 * float((radii * np.sqrt(chart.areas / own)).max()))
    fullest = float(np.bincount(chart.group_of, weights=chart.areas).max())
    return float(min(height, max(fullest * widest**2 / (COVER * width), width)))

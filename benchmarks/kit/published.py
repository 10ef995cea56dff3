"""What others have published, and where: the only figures here that were not measured here.

Sources: "Image-Space Collage and Packing with Differentiable Rendering" (Wang and Lu,
SIGGRAPH 2025, doi 10.1145/3721238.3730690), its table of resolutions and its comparisons; what
is said of PAD's own results goes back to Kwan et al. 2016. What is not known stays out.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Resolution:
    """One row of the paper's table 1: LC, OO, EA in percent, seconds for 200 epochs."""

    LC: str
    OO: str
    EA: str
    seconds: str


RESOLUTIONS = {
    "50": Resolution("69.67", "2.72", "1.11", "12.90"),
    "100": Resolution("65.60", "0.68", "0.33", "13.41"),
    "200": Resolution("73.43", "0.42", "0.07", "15.44"),
    "400": Resolution("67.55", "0.08", "0.01", "22.36"),
    "600": Resolution("70.77", "0.11", "0.00", "32.54"),
    "800": Resolution("72.23", "0.12", "0.00", "52.42"),
    "1000": Resolution("71.16", "0.05", "0.00", "76.04"),
    "1200": Resolution("69.39", "0.01", "0.00", "99.76"),
    "100,600": Resolution("51.47", "0.02", "0.00", "18.51"),
    "50,200,600": Resolution("60.73", "0.01", "0.00", "20.74"),
}
"""By levels, in pixels."""


@dataclass(frozen=True)
class Comparison:
    """What the paper reports of one kind of item: coverage, a range over its cases; overlap.

    ``None``: not known. ``peer`` is the program that it compares itself with.
    """

    peer: str
    peer_coverage: tuple[float, float]
    coverage: tuple[float, float] | None = None
    overlap: float | None = None
    peer_overlap: tuple[float, float] | None = None


COMPARISONS = {
    "words": Comparison("ShapeWordle", (0.18, 0.25), (0.28, 0.29)),
    "icons": Comparison("PAD", (0.91, 0.94), peer_overlap=(0.03, 0.06)),
    "photos": Comparison("ShapeCollage", (0.67, 0.67), (0.86, 0.87), 0.9e-4, (0.04, 0.04)),
}
"""By kind of item; words by their ink."""

PAD_MINUTES, PAPER_MINUTES = 700, 6
"""For one example of icons, whose number of items is not known to us."""

MINKOWSKI_COUNT = 100
"""About as many elements as object-space penalties by Minkowski sums were shown with."""

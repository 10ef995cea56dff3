"""All measures of a layout together."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from packwork.metrics.exact import ExactMetrics, exact_coverage, exact_metrics
from packwork.metrics.pixel import PixelMetrics, pixel_metrics
from packwork.scene.layout import Layout


@dataclass(frozen=True)
class LayoutMetrics:
    """What a layout is worth, by pixels and in exact geometry.

    Parameters
    ----------
    pixel
        The paper's measures, of the outlines.
    exact
        The same shares without pixels, of the outlines.
    ink
        Exact share of the container that is really drawn: holes and gaps of the items'
        appearance taken off.
    """

    pixel: PixelMetrics
    exact: ExactMetrics
    ink: float

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers under the names of the report."""
        exact = self.exact
        return {
            **asdict(self.pixel),
            "LC_ink": self.ink,
            "exact": {
                "LC": exact.coverage,
                "OO": exact.overlap,
                "EA": exact.exceeding,
                "overlap_area": exact.overlap_area,
                "outside_area": exact.outside_area,
                "min_gap": exact.min_gap,
            },
        }


def measure(layout: Layout) -> LayoutMetrics:
    """Measure a layout's outlines, and the ink of its items, against its container."""
    same = all(item.ink is item.outline for item in layout.items)
    exact = exact_metrics(layout.outlines, layout.container.outline)
    return LayoutMetrics(
        pixel=pixel_metrics(layout.outlines, layout.container),
        exact=exact,
        ink=exact.coverage if same else exact_coverage(layout.inks, layout.container.outline),
    )

"""Certificate: whether a layout keeps what its run promised, by exact measures alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.rectangles import ROUNDING
from packwork.metrics.exact import ExactMetrics
from packwork.scene.layout import Layout

HAIR = 1e-6
"""Least gap of a certified layout, as a share of the canvas: ten times the precision of
the files that are written, and more than curves bulge past the polygons that were
checked. Smaller would certify touching curves. Derived."""

FILE_PRECISION = HAIR / 10
"""How far lines of a file may lie from those that were placed, as a share of the canvas: the area
of a speck may be off by that much along its whole outline. Derived, from the coarsest format."""

SHARE_TOLERANCE = 1e-3
"""How far areas may be off the shares asked for. Chosen."""


@dataclass(frozen=True)
class Promise:
    """Smallest gap and shares of area that a run promises of its layout.

    ``gap``: smallest distance between items and to the container's edge, canvas units.
    ``areas_in_shares``: whether the items' areas are in the shares of their weights.
    """

    gap: float = 0.0
    areas_in_shares: bool = False

    def least_gap(self, side: float) -> float:
        """Smallest distance that is certified on a canvas of that longer side."""
        return max(self.gap, HAIR * side)

    @classmethod
    def of(cls, manifest: Mapping[str, Any]) -> Promise | None:
        """Promise that a manifest holds; None if it has none, or one that is no promise."""
        found = manifest.get("promised")
        if not isinstance(found, Mapping):
            return None
        gap, shares = found.get("gap", 0.0), found.get("areas_in_shares", False)
        if isinstance(gap, bool) or not isinstance(gap, int | float) or not gap >= 0:
            return None
        return cls(float(gap), shares is True)


def taken_on_trust(manifest: Mapping[str, Any]) -> tuple[str, ...]:
    """Facts that a reader took from a file without seeing them, a sentence each.

    Examples
    --------
    >>> taken_on_trust({"on_trust": ["the sizes"]}), taken_on_trust({"on_trust": 3})
    (('the sizes',), ())
    """
    return _sentences(manifest, "on_trust")


def changed_since(manifest: Mapping[str, Any]) -> tuple[str, ...]:
    """Differences of a file's drawing from what was measured, a sentence each.

    Examples
    --------
    >>> changed_since({"changed": ["stroke of item 1"]}), changed_since({})
    (('stroke of item 1',), ())
    """
    return _sentences(manifest, "changed")


def _sentences(manifest: Mapping[str, Any], key: str) -> tuple[str, ...]:
    said = manifest.get(key)
    return tuple(str(one) for one in said) if isinstance(said, list | tuple) else ()


def broken(promise: Promise, layout: Layout, exact: ExactMetrics) -> tuple[str, ...]:
    """Parts of a promise that do not hold, a sentence each; empty if all do.

    Shares no code with the finish: it reads the measures of :func:`exact_metrics`.

    Examples
    --------
    >>> from packwork.metrics.exact import ExactMetrics
    >>> import packwork as pw
    >>> layout = pw.fill("circle", "star", count=3, effort="draft", levels="50")
    >>> touching = ExactMetrics(
    ...     coverage=0.5, overlap=0, exceeding=0, overlap_area=0, outside_area=0, min_gap=0
    ... )
    >>> broken(Promise(), layout, touching)
    ('the smallest gap is 0 instead of 0.0006 or more',)
    """
    return (*unclean(promise, layout, exact), *off_shares(promise, layout))


def unclean(promise: Promise, layout: Layout, exact: ExactMetrics) -> tuple[str, ...]:
    """Promises that the geometry breaks: overlaps, what sticks out, gaps; a sentence each.

    A layout of which nothing does not is certified.

    Examples
    --------
    >>> from packwork.metrics.exact import ExactMetrics
    >>> from packwork.scene.layout import blank
    >>> found = ExactMetrics(
    ...     coverage=0.5, overlap=0.1, exceeding=0, overlap_area=3, outside_area=0, min_gap=0
    ... )
    >>> unclean(Promise(), blank(), found)
    ('items overlap by 3 px² in all',)
    """
    unit, least = layout.container.unit, promise.least_gap(layout.container.side)
    found = []
    if exact.overlap_area > 0:
        found.append(f"items overlap by {exact.overlap_area:.3g} {unit}² in all")
    if exact.outside_area > 0:
        found.append(f"items stick out by {exact.outside_area:.3g} {unit}² in all")
    gap = exact.min_gap
    if exact.gap_beside is not None:
        gap = exact.gap_beside if promise.gap == 0.0 else gap + ROUNDING * layout.container.side
    if not found and gap < least:
        found.append(f"the smallest gap is {gap:.3g} instead of {least:.3g} or more")
    return (*found, *changed_since(layout.manifest))


def off_shares(promise: Promise, layout: Layout) -> tuple[str, ...]:
    """That areas are not in the shares of the weights, if they were to be; else nothing."""
    # What fills voids has no weight: its size says nothing.
    weighed = layout.weights > 0
    if not (promise.areas_in_shares and weighed.any()):
        return ()
    per_weight = layout.areas[weighed] / layout.weights[weighed]
    tolerance = FILE_PRECISION * layout.container.side
    slack = tolerance * _perimeters(layout)[weighed] / layout.areas[weighed]
    least_most, most_least = per_weight * (1 + slack), per_weight * (1 - slack)
    off = float((most_least.max() - least_most.min()) / per_weight.mean())
    if off <= SHARE_TOLERANCE:
        return ()
    return (f"areas are off the shares asked for by {100 * off:.2g} %",)


def _perimeters(layout: Layout) -> FloatArray:
    """Length of all lines of each item's outline, canvas units."""
    rings = [outline.rings for outline in layout.outlines]
    return np.array([
        sum(float(np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).sum()) for ring in one)
        for one in rings
    ])  # fmt: skip

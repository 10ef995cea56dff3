"""An outline as a few cubic curves: the paper's silhouettes, fitted by the renderer.

Wang and Lu 2025, section 3.1, fit N = 20 curves to each element with a general vector
renderer. Here the cuts come from dynamic programming and the fit from our own renderer's
exact gradient.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import lru_cache

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError, ShapeError
from packwork.fit.chains import flattened, straight_chain, without_loops
from packwork.fit.descent import fit_to_picture
from packwork.fit.knots import best_chain
from packwork.geometry.outline import Outline, OutlineLike
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import signed_area
from packwork.geometry.simplify import simplified

MOST_CURVES = 100
"""Curves that may be asked for: more is no simpler than the outline itself. Chosen."""

LARGEST = 1e50
"""Largest number of a point. Products of several differences must not overflow. Chosen."""

FLATNESS = 2e-4
"""Tolerance, as a share of the extent, to which the result is flattened. Chosen."""

FALLBACK = 2e-3
"""Tolerance, as a share of the extent, of the simplification where no fit is simple.
Larger needs fewer points, smaller is nearer. Chosen."""

CURVES_LESS = 2
"""Curves left out in the one more try where every level's fit crosses itself. Fewer fail again.
Tried."""


class FitEnding(Enum):
    """Ending of a fit."""

    FITTED = "fitted as asked"
    TRIMMED = "fitted, and small loops cut off"
    COARSER = "the finest fit crossed itself; this is of a coarser level or fewer curves"
    SIMPLIFIED = "every fit crossed itself; this is the outline itself, simplified"


@dataclass(frozen=True, eq=False)
class FittedOutline:
    """A closed area of cubic Bezier curves that stands for an outline.

    Results are cached and shared: do not write to the arrays.

    Parameters
    ----------
    controls
        One ``(k, 3, 2)`` array per ring, in the order of the outline's rings: start and
        two handles of each curve; its end is the next one's start. Straight edges where
        a ring was kept as it was.
    outline
        The curves flattened to ``FLATNESS`` of the extent; simple, always.
    iou
        Area shared with the true outline over that of both together, exact.
    kept
        Rings kept as they were, because there were not enough curves for all.
    """

    controls: tuple[FloatArray, ...]
    outline: Outline
    iou: float
    ending: FitEnding
    kept: int

    @property
    def is_fitted(self) -> bool:
        """Whether the curves are fitted, and not the outline's own, simplified edges."""
        return self.ending is not FitEnding.SIMPLIFIED


def fit_outline(outline: OutlineLike, curves: int = 20) -> FittedOutline:
    """Closed area of a few cubic curves that looks like an outline.

    Never crosses itself: small loops are cut off, and where that does not help a coarser
    fit, one of fewer curves or the simplified outline is given (see ``ending``). Curves
    are shared among rings by length, at least four each; the smallest rings keep their
    own edges if there are more rings than that allows (see ``kept``).

    The same outline, asked for again, is answered from memory. A fit takes about 15 ms,
    less than a person notices, so nothing is kept on the disk.

    Parameters
    ----------
    curves
        In all rings together, from 4 to ``MOST_CURVES``.

    Raises
    ------
    RecipeError
        If ``curves`` is not a whole number in that range.
    ShapeError
        If the outline has no area or crosses itself.

    Examples
    --------
    >>> t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    >>> circle = Outline.from_rings([np.column_stack([np.cos(t), np.sin(t)])])
    >>> fitted = fit_outline(circle, curves=4)
    >>> fitted.controls[0].shape, fitted.iou > 0.998, fitted.is_fitted
    ((4, 3, 2), True, True)
    """
    if isinstance(curves, bool) or not isinstance(curves, int | np.integer):
        raise RecipeError("curves", f"must be a whole number such as 20, not {curves!r}")
    if not FEWEST <= curves <= MOST_CURVES:
        raise RecipeError("curves", f"must be {FEWEST} to {MOST_CURVES}, not {curves}")
    outline = Outline.of(outline)
    if np.abs(outline.points).max(initial=0.0) > LARGEST:
        raise ShapeError(f"points must be at most {LARGEST:g} from the origin to be fitted")
    _check_simple(outline)
    return _remembered(outline.points.tobytes(), outline.starts.tobytes(), int(curves))


@lru_cache
def _remembered(points: bytes, starts: bytes, curves: int) -> FittedOutline:
    return fit_anew(
        Outline(
            np.frombuffer(points, dtype=np.float64).reshape(-1, 2).copy(),
            np.frombuffer(starts, dtype=np.int64).copy(),
        ),
        curves,
    )


def _check_simple(outline: Outline) -> None:
    region = outline.region
    if not region.is_valid or not np.isclose(region.area, outline.area, rtol=1e-6, atol=0.0):
        raise ShapeError(
            "the outline crosses itself or a hole runs the wrong way; clean it with "
            "Outline.from_region(packwork.geometry.polygon.region(rings))"
        )
    if outline.area <= 0:
        raise ShapeError("the outline has no area")


def fit_anew(outline: Outline, curves: int) -> FittedOutline:
    """Do what :func:`fit_outline` promises, its checks passed, without its memory."""
    found = _fit(outline, curves)
    if found:
        return found
    fewer = _fit(outline, max(curves - CURVES_LESS, FEWEST))
    if fewer:
        return replace(fewer, ending=FitEnding.COARSER)
    rest = simplified(outline, FALLBACK * outline.extent)
    edges = [straight_chain(ring) for ring in rest.rings]
    return _result(outline, edges, rest, FitEnding.SIMPLIFIED, 0)


def _fit(outline: Outline, curves: int) -> FittedOutline | None:
    """The finest fit that can be made simple, None if there is none."""
    shares = shared_curves(outline.rings, curves)
    fitted = [k for k, share in enumerate(shares) if share > 0]
    counts = [int(shares[k]) for k in fitted]
    target = Outline.from_rings([outline.rings[k] for k in fitted])
    start = np.concatenate(
        [best_chain(ring, count) for ring, count in zip(target.rings, counts, strict=True)]
    )
    stages = fit_to_picture(target, start, counts)
    for stage in reversed(stages):
        drawn = np.split(stage, np.cumsum(counts)[:-1])
        mended = [without_loops(chain, FLATNESS * outline.extent) for chain in drawn]
        chains = _all_chains(outline, fitted, mended)
        found = _sound_outline(outline, chains) if chains else None
        if found:
            ending = _ending(stage is stages[-1], drawn, mended)
            return _result(outline, chains, found, ending, len(shares) - len(fitted))
    return None


def _all_chains(
    outline: Outline, fitted: Sequence[int], mended: Sequence[FloatArray | None]
) -> list[FloatArray]:
    """Chains of all rings, straight ones where none was fitted; none if one is missing."""
    chains = [straight_chain(ring) for ring in outline.rings]
    for k, chain in zip(fitted, mended, strict=True):
        if chain is None:
            return []
        chains[k] = chain
    return chains


def _sound_outline(outline: Outline, chains: Sequence[FloatArray]) -> Outline | None:
    """Outline of the chains, if they are as simple and nested as the original's rings."""
    tolerance = FLATNESS * outline.extent
    rings = [np.concatenate(flattened(chain, tolerance)) for chain in chains]
    for ring, original in zip(rings, outline.rings, strict=True):
        if signed_area(ring) * signed_area(original) <= 0:
            return None
    lines = shapely.MultiLineString([shapely.LinearRing(ring) for ring in rings])
    found = Outline.from_rings(rings)
    # Rings that do not cross may still have left the ring they were holes of.
    if not lines.is_simple or not np.isclose(found.region.area, found.area, rtol=1e-6):
        return None
    return found


def _ending(
    is_finest: bool, drawn: Sequence[FloatArray], mended: Sequence[FloatArray | None]
) -> FitEnding:
    if not is_finest:
        return FitEnding.COARSER
    same = all(np.array_equal(a, b) for a, b in zip(drawn, mended, strict=True) if b is not None)
    return FitEnding.FITTED if same else FitEnding.TRIMMED


def _result(
    outline: Outline, chains: Sequence[FloatArray], found: Outline, ending: FitEnding, kept: int
) -> FittedOutline:
    shared = intersection(outline.region, found.region).area
    iou = shared / (outline.area + found.area - shared)
    return FittedOutline(tuple(chains), found, float(iou), ending, kept)


FEWEST = 4
"""Curves of one ring at least: with fewer, corners and ovals are out of reach. Chosen."""


def shared_curves(rings: Sequence[FloatArray], curves: int) -> IntArray:
    """Curves for each ring ``(n, 2)``: at least ``FEWEST``, the rest by length, zero for the tiny.

    Where the curves do not suffice for all, the shortest rings get none.

    >>> square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    >>> shared_curves([square, 3 * square], 20).tolist()
    [7, 13]
    >>> shared_curves([square, 3 * square], 6).tolist()
    [0, 6]
    """
    lengths = np.array([_length(ring) for ring in rings])
    served = np.argsort(-lengths, kind="stable")[: curves // FEWEST]
    counts = np.zeros(len(rings), dtype=np.int64)
    counts[served] = FEWEST
    spare = curves - int(counts.sum())
    wish = spare * lengths[served] / lengths[served].sum()
    counts[served] += np.floor(wish).astype(np.int64)
    left = curves - int(counts.sum())
    counts[served[np.argsort(np.floor(wish) - wish, kind="stable")[:left]]] += 1
    return counts


def _length(ring: FloatArray) -> float:
    return float(np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).sum())

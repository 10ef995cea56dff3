"""Contours of coverage images at one half, to a fraction of a pixel."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.overlay import simplify
from packwork.geometry.polygon import Region, oriented_rings, region, signed_area
from packwork.readers.pictures.stairs import without_stairs
from packwork.readers.unfit import UnfitError

MAX_CONTOURS = 5_000
"""Closed curves in one picture, specks left out. Noise has more, shapes fewer. Chosen."""

MAX_CROSSINGS = 1_000_000
"""Neighbouring pixels between which a picture passes one half. Each costs some 300 bytes while
contours are joined. Larger takes more memory for noise, smaller refuses fine patterns. Chosen."""

SMALLEST_PX = 4.0
"""Area of a contour, in square pixels, below which it is a speck. Chosen."""

_LEVEL = 0.5
_STEP = 0.8


def contour_region(coverage: FloatArray, simplify_px: float) -> Region:
    """Region where ``coverage`` is above one half; valid, possibly empty.

    Where nearly all edges are hard, their stairs are taken for the lines they stand for
    (see ``stairs``); else the contour runs where the grey passes one half.

    Parameters
    ----------
    coverage
        ``[row, col]``, 0..1; outside the picture it is 0, so a picture that is full to
        its border gives that border.
    simplify_px
        Largest distance the simplified contour may have from a soft edge.

    Returns
    -------
    Region
        In pixels: ``x`` right, ``y`` down, pixel ``(0, 0)`` spans 0..1.

    Examples
    --------
    >>> mask = np.zeros((20, 20)); mask[5:15, 5:15] = 1.0
    >>> contour_region(mask, simplify_px=0.1).area.__round__(6)
    100.0
    """
    rings = _rings(coverage)
    if has_hard_edges(coverage):
        return region([without_stairs(ring) for ring in rings], "evenodd")
    traced = region(rings, "evenodd")
    simple = simplify(traced, simplify_px, keeps_topology=True)
    return simple if simple.is_valid and oriented_rings(simple) else traced


def _rings(coverage: FloatArray) -> list[FloatArray]:
    """Contours at one half, specks left out."""
    from contourpy import contour_generator

    inside = coverage > _LEVEL
    crossings = sum(np.count_nonzero(np.diff(inside, axis=axis)) for axis in (0, 1))
    if crossings > MAX_CROSSINGS:
        raise _noisy(f"{crossings:,} edges between its pixels")
    # Contours run between pixel centres; the padding moves them by one.
    found = contour_generator(z=np.pad(coverage, 1), name="serial").lines(_LEVEL)
    rings = [np.asarray(ring)[:-1] - 0.5 for ring in found]
    kept = [ring for ring in rings if abs(signed_area(ring)) >= SMALLEST_PX]
    if len(kept) > MAX_CONTOURS:
        raise _noisy(f"{len(kept):,} separate contours")
    return kept


def _noisy(met: str) -> UnfitError:
    return UnfitError(f"has {met}, as noise has; give a picture of plain shapes")


def has_hard_edges(coverage: FloatArray) -> bool:
    """Whether a mask goes from nothing to full within a pixel nearly everywhere.

    Examples
    --------
    >>> mask = np.zeros((9, 9)); mask[3:6, 3:6] = 1.0
    >>> has_hard_edges(mask)
    True
    """
    steps = sum(np.count_nonzero(np.abs(np.diff(coverage, axis=k)) > _STEP) for k in (0, 1))
    soft = np.count_nonzero(np.abs(coverage - _LEVEL) < _STEP / 2)
    return bool(steps > soft)

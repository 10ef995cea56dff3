"""The pen that a font's glyphs are drawn with: contours to flattened rings."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.bezier import flatten_cubic
from packwork.readers.svg.crossings import Allowance
from packwork.readers.unfit import TooRichError, UnfitError

MAX_SEGMENTS = 20_000
"""Lines and curves in one glyph, its components counted. Ornaments have thousands. Chosen."""

MAX_REACH = 32.0
"""How far from its origin a glyph may reach, in ems: more is damage. Chosen."""

MAX_CROSSINGS = 2_000
"""Places where the contours of one glyph may cross themselves and each other, by estimate: larger
lets a scribble of 100 letters take minutes. Letters put together of strokes have tens. Chosen."""

MAX_POINTS = 400_000
"""Points of one glyph's flattened contours. An ornament has a tenth of it. Chosen."""

Point = tuple[float, float]
Draw = Callable[[str, "RingPen"], None]
"""Draws the glyph of a name with a pen."""


def check_glyph(rings: Sequence[FloatArray]) -> None:
    """Refuse a glyph whose flattened contours would take minutes, and all memory, to resolve.

    Raises
    ------
    UnfitError
        If they are too many points, or cross too often.

    Examples
    --------
    >>> check_glyph([np.random.default_rng(0).random((1000, 2))])
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: is a font with a glyph whose lines cross ...
    """
    points = sum(map(len, rings))
    if points > MAX_POINTS:
        raise UnfitError(f"is a font with a glyph of {points:,} points; give a plainer one")
    try:
        Allowance(MAX_CROSSINGS).spend([ring for ring in rings if len(ring)])
    except TooRichError as error:
        raise UnfitError(
            f"is a font with a glyph whose lines cross too often ({error.what}); give a plainer one"
        ) from None


class RingPen:
    """Collects what is drawn as rings, in the font's own units, y up.

    Components are drawn in place. It counts what it is given, so that a glyph made of
    itself, or of a thousand copies of a thousand copies, comes to an end.

    Parameters
    ----------
    draw
        Draws a component.
    em
        The font's units in one em.
    tolerance
        Largest distance of a curve from its chords, in the font's units.

    Examples
    --------
    >>> pen = RingPen(lambda name, pen: None, 1000.0, 0.1)
    >>> pen.moveTo((0, 0)), pen.lineTo((0, 9)), pen.lineTo((9, 0)), pen.closePath()
    (None, None, None, None)
    >>> [ring.tolist() for ring in pen.rings]
    [[[0.0, 0.0], [0.0, 9.0], [9.0, 0.0]]]
    """

    def __init__(self, draw: Draw, em: float, tolerance: float) -> None:
        self.rings: list[FloatArray] = []
        self._draw = draw
        self._reach = MAX_REACH * em
        self._tolerance = tolerance
        self._runs: list[FloatArray] = []
        self._place = affine.similarity(0.0, 0.0, 0.0, 1.0)
        self._count = 0

    def moveTo(self, point: Point) -> None:  # noqa: N802 - fontTools' pen protocol
        """Begin a contour."""
        self.closePath()
        self._runs = [self._points(point)]

    def lineTo(self, point: Point) -> None:  # noqa: N802
        """Go straight."""
        self._runs.append(self._points(point))

    def curveTo(self, *points: Point) -> None:  # noqa: N802
        """Go along one cubic."""
        if len(points) != 3:
            raise UnfitError("is a font with a curve of an unknown kind")
        self._curve(self._points(*points))

    def qCurveTo(self, *points: Point | None) -> None:  # noqa: N802
        """Go along quadratics whose on-curve points lie midway; closed if None is last."""
        handles = self._points(*[p for p in points[:-1] if p is not None])
        if points[-1] is None:
            end = (handles[-1] + handles[0]) / 2
            self._runs = [end[None]]
        else:
            end = self._points(points[-1])[0]
        joints = [*((handles[:-1] + handles[1:]) / 2), end]
        for handle, joint in zip(handles, joints, strict=True):
            start = self._runs[-1][-1]
            self._curve(np.array([start + 2 * handle, joint + 2 * handle, 3 * joint]) / 3)

    def closePath(self) -> None:  # noqa: N802
        """End a contour."""
        if self._runs:
            self.rings.append(np.concatenate(self._runs))
        self._runs = []

    endPath = closePath  # noqa: N815

    def addComponent(self, name: str, transform: tuple[float, ...]) -> None:  # noqa: N802
        """Draw another glyph under an affine map ``(xx, xy, yx, yy, dx, dy)``."""
        self._spend(1)
        before = self._place
        xx, xy, yx, yy, dx, dy = transform
        self._place = affine.compose(before, np.array([[xx, yx, dx], [xy, yy, dy]], dtype=float))
        self._draw(name, self)
        self._place = before

    def _curve(self, cubic: FloatArray) -> None:
        first, second, end = cubic
        run = flatten_cubic(self._runs[-1][-1], first, second, end, self._tolerance)
        self._runs.append(run)

    def _points(self, *points: Point) -> FloatArray:
        self._spend(len(points))
        placed = affine.apply(self._place, np.array(points, dtype=np.float64).reshape(-1, 2))
        if not (np.abs(placed) <= self._reach).all():
            raise UnfitError("is a font with a glyph that reaches too far; give an intact one")
        return placed

    def _spend(self, count: int) -> None:
        self._count += count
        if self._count > MAX_SEGMENTS:
            raise UnfitError(
                f"is a font with a glyph of more than {MAX_SEGMENTS:,} pieces; give a plainer one"
            )

"""Lines of straight and circular sides, and other curves as chains of arcs within a tolerance.

A curve between two points with tangents is met by two arcs that share a tangent where they join: a
biarc (K. M. Bolton, "Biarc curves", Computer-Aided Design 7, 1975). Its error goes with the third
power of the length, that of a chord with the second.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Self, TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine

MOST_HALVINGS = 14
"""Times that a part of a curve is halved at most: at a kink it would never fit. Chosen."""

STRAIGHT = 1e-9
"""Bulge up to which a side counts as straight: half of that share of its length lies off it."""

FULL = 6.28
"""Sum of the angles of a circle's arcs, in radians, from which it is whole but for rounding."""

_INSIDE = 1e-7
"""Share of a part of a curve by which tangents are taken inside its ends, where a kink may be."""

_WIDEST = 1.6
"""Angle of an arc, in radians, that two tangents go round at most."""

_SAMPLES = np.array([0.11, 0.25, 0.39, 0.5, 0.61, 0.75, 0.89])

Curve: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""Points and derivatives, ``(k, 2)`` each, at parameters ``(k,)``."""


@dataclass(frozen=True, eq=False)
class ArcLine:
    """Points one after another, each side straight or an arc.

    ``points``: ``(n, 2)``, in any unit.
    ``bulges``: ``(n,)`` of the side that begins at each point: the tangent of a quarter of its
    arc's angle, positive where that turns from x towards y; 0 is straight. The last one counts
    where the line is closed.
    """

    points: FloatArray
    bulges: FloatArray
    is_closed: bool = False

    @property
    def ends(self) -> FloatArray:
        """Ends of all sides, ``(sides, 2)``."""
        after = np.roll(self.points, -1, axis=0)
        return after if self.is_closed else after[:-1]

    @property
    def sides(self) -> int:
        """Number of sides."""
        return len(self.points) - (0 if self.is_closed else 1)

    @property
    def length(self) -> float:
        """Length along all sides, in the unit of the points."""
        chords = np.hypot(*(self.ends - self.points[: self.sides]).T)
        half = 2.0 * np.arctan(np.abs(self.bulges[: self.sides]))
        return float((chords / np.sinc(half / math.pi)).sum())

    def mapped(self, matrix: FloatArray, tolerance: float) -> Self:
        """Image under an affine map (2 x 3) to any unit, which may mirror.

        Where it stretches, arcs become parts of ellipses, which are met within ``tolerance``, in
        units of the image.

        Examples
        --------
        >>> mirrored = circle((0.0, 0.0), 1.0).mapped(np.array([[-2.0, 0, 5], [0, 2, 0]]), 1e-6)
        >>> mirrored.points.tolist(), mirrored.bulges.tolist()
        ([[3.0, 0.0], [7.0, 0.0]], [-1.0, -1.0])
        """
        first, second = matrix[:, 0], matrix[:, 1]
        wide, high = float(np.hypot(*first)), float(np.hypot(*second))
        is_even = math.isclose(wide, high, rel_tol=1e-12)
        points = affine.apply(matrix, self.points)
        if (is_even and abs(float(first @ second)) <= 1e-12 * wide * high) or not self.bulges.any():
            turned = -1.0 if np.linalg.det(matrix[:, :2]) < 0 else 1.0
            return replace(self, points=points, bulges=turned * self.bulges)
        found = []
        sides = zip(self.points, self.ends, self.bulges.tolist(), strict=False)
        for k, (start, end, bulge) in enumerate(sides):
            if bulge == 0.0:
                found.append(ArcLine(points[[k, (k + 1) % len(points)]], np.zeros(2)))
            else:
                found.append(_stretched(start, end, bulge, matrix, tolerance))
        whole = joined_lines(found, is_closed=self.is_closed)
        return replace(self, points=whole.points, bulges=whole.bulges)

    def reversed(self) -> ArcLine:
        """The same line the other way."""
        if self.is_closed:
            return ArcLine(self.points[::-1], -np.roll(self.bulges, 1)[::-1], is_closed=True)
        bulges = np.append(-self.bulges[:-1][::-1], 0.0)
        return ArcLine(self.points[::-1], bulges)

    def flattened(self, tolerance: float, *, around: bool = False) -> FloatArray:
        """Points ``(n, 2)`` of straight sides instead, within ``tolerance``.

        ``around`` lays those that stand for arcs of positive bulge on their outer side, so that of
        a ring with positive area nothing lies beyond; otherwise all corners are on the line.

        Examples
        --------
        >>> ring = circle((0.0, 0.0), 1.0)
        >>> bool(np.hypot(*ring.flattened(1e-4).T).max() <= 1 + 1e-12)
        True
        >>> bool(np.hypot(*ring.flattened(1e-4, around=True).T).min() >= 1 - 1e-12)
        True
        """
        if not self.bulges.any():
            return self.points
        found = []
        sides = zip(self.points, self.ends, self.bulges.tolist(), strict=False)
        for start, end, bulge in sides:
            found.append(start[None])
            if abs(bulge) > STRAIGHT:
                is_outer = around and bulge > 0
                found.append(_along(start, end, bulge, tolerance, is_outer=is_outer))
        if not self.is_closed:
            found.append(self.points[-1:])
        return np.concatenate(found)


def circle(centre: tuple[float, float], radius: float) -> ArcLine:
    """Circle of two arcs, from x towards y.

    Examples
    --------
    >>> circle((1.0, 0.0), 2.0).points.tolist()
    [[3.0, 0.0], [-1.0, 0.0]]
    """
    x, y = centre
    return ArcLine(np.array([[x + radius, y], [x - radius, y]]), np.ones(2), is_closed=True)


def arc(centre: tuple[float, float], radius: float, start: float, sweep: float) -> ArcLine:
    """Part of a circle from an angle on, in radians, of not more than a full turn; two arcs.

    Examples
    --------
    >>> arc((0.0, 0.0), 1.0, 0.0, np.pi).points.round(9).tolist()
    [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]
    """
    turns = start + sweep * np.array([0.0, 0.5, 1.0])
    points = np.array(centre) + radius * np.column_stack([np.cos(turns), np.sin(turns)])
    bulge = math.tan(sweep / 8)
    return ArcLine(points, np.array([bulge, bulge, 0.0]))


def with_longest_arcs(line: ArcLine, tolerance: float) -> ArcLine:
    """The same line with fewer sides: neighbouring arcs of one circle, within a tolerance, are one.

    A closed line that is all of one circle becomes that; other arcs are half a circle at most.

    Examples
    --------
    >>> quarters = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    >>> line = ArcLine(quarters, np.full(4, math.tan(math.pi / 8)), is_closed=True)
    >>> with_longest_arcs(line, 1e-9).bulges.tolist()
    [1.0, 1.0]
    """
    points, sides = line.points, line.sides
    ends, bulges = line.ends, line.bulges[:sides]
    chords = ends - points[:sides]
    across = np.column_stack([chords[:, 1], -chords[:, 0]])
    middles = (points[:sides] + ends + bulges[:, None] * across) / 2.0
    first, kept = 0, list[tuple[FloatArray, float]]()
    while first < sides:
        last, bulge = first, float(bulges[first])
        while bulge and last + 1 < sides and bulges[last + 1] * bulge > 0.0:
            sweep = 4.0 * float(np.arctan(bulges[first : last + 2]).sum())
            wider = math.tan(sweep / 4.0)
            seen = np.concatenate([middles[first : last + 2], points[first + 1 : last + 2]])
            centre = _centre(points[first], ends[last + 1], wider)
            far = np.hypot(*(seen - centre).T) - np.hypot(*(points[first] - centre))
            if abs(sweep) > math.pi + STRAIGHT or np.abs(far).max() > tolerance:
                break
            last, bulge = last + 1, wider
        kept.append((points[first], bulge))
        first = last + 1
    corners, bent = (np.array(column) for column in zip(*kept, strict=True))
    if not line.is_closed:
        return ArcLine(np.vstack([corners, points[-1:]]), np.append(bent, 0.0))
    goes_round = abs(4.0 * float(np.arctan(bulges).sum())) > FULL and bool(bulges.all())
    seen = np.concatenate([points, middles])
    whole = _circle_through(seen, tolerance) if goes_round else None
    if whole is None:
        return ArcLine(corners, bent, is_closed=True)
    return whole if bulges[0] > 0.0 else whole.reversed()


def _circle_through(points: FloatArray, tolerance: float) -> ArcLine | None:
    """Circle within a tolerance of all points, by least squares; None if there is none."""
    origin = points.mean(axis=0)
    moved = points - origin
    rows = np.column_stack([2.0 * moved, np.ones(len(moved))])
    x, y, _ = np.linalg.lstsq(rows, (moved**2).sum(axis=1), rcond=None)[0]
    far = np.hypot(*(moved - (x, y)).T)
    radius = float(far.max() + far.min()) / 2.0
    is_one = far.max() - radius <= tolerance
    return circle((float(origin[0] + x), float(origin[1] + y)), radius) if is_one else None


def joined_lines(lines: list[ArcLine], *, is_closed: bool) -> ArcLine:
    """Open lines end to end as one; the end of each gives way to the beginning of the next."""
    points = np.concatenate([line.points[:-1] for line in lines])
    bulges = np.concatenate([line.bulges[:-1] for line in lines])
    if is_closed:
        return ArcLine(points, bulges, is_closed=True)
    return ArcLine(np.vstack([points, lines[-1].points[-1:]]), np.append(bulges, 0.0))


def _stretched(
    start: FloatArray, end: FloatArray, bulge: float, matrix: FloatArray, tolerance: float
) -> ArcLine:
    """Image of an arc under a map that stretches."""
    centre, sweep = _centre(start, end, bulge), 4.0 * math.atan(bulge)
    spoke = start - centre
    across = np.array([-spoke[1], spoke[0]])
    middle = affine.apply(matrix, centre[None])[0]
    return ellipse(middle, matrix[:, :2] @ spoke, matrix[:, :2] @ across, (0.0, sweep), tolerance)


def ellipse(
    centre: FloatArray,
    first: FloatArray,
    second: FloatArray,
    turns: tuple[float, float],
    tolerance: float,
) -> ArcLine:
    """Part of an ellipse, open: ``centre + first cos t + second sin t`` for ``t`` in ``turns``.

    Examples
    --------
    >>> half = ellipse(np.zeros(2), np.array([2.0, 0]), np.array([0, 1.0]), (0.0, np.pi), 1e-6)
    >>> half.points[[0, -1]].round(9).tolist(), len(half.points) < 300
    ([[2.0, 0.0], [-2.0, 0.0]], True)
    """

    def curve(t: FloatArray) -> tuple[FloatArray, FloatArray]:
        c, s = np.cos(t)[:, None], np.sin(t)[:, None]
        return centre + c * first + s * second, c * second - s * first

    start, end = turns
    quarters = max(1, math.ceil(abs(end - start) / (math.pi / 2)))
    return arcs_along(curve, np.linspace(start, end, quarters + 1), tolerance)


def arcs_along(curve: Curve, knots: FloatArray, tolerance: float) -> ArcLine:
    """Open line of arcs within ``tolerance`` of a curve, between whose ``knots`` it is smooth."""
    knots = np.unique(knots) if knots[0] < knots[-1] else np.unique(knots)[::-1]
    starts, ends = knots[:-1], knots[1:]
    done: list[tuple[FloatArray, FloatArray]] = []
    for halving in range(MOST_HALVINGS + 1):
        points, bulges, error = _biarcs(curve, starts, ends)
        if halving == MOST_HALVINGS:
            # Straight where nothing fits.
            bulges = np.where((error > tolerance)[:, None], 0.0, bulges)
        fits = (error <= tolerance) | (halving == MOST_HALVINGS)
        done.append((starts[fits], np.concatenate([points, bulges[:, :, None]], axis=2)[fits]))
        starts, ends = starts[~fits], ends[~fits]
        if not len(starts):
            break
        middles = (starts + ends) / 2
        starts, ends = np.concatenate([starts, middles]), np.concatenate([middles, ends])
    order = np.argsort(np.concatenate([at for at, _ in done]), kind="stable")
    order = order if knots[0] < knots[-1] else order[::-1]
    sides = np.concatenate([both for _, both in done])[order].reshape(-1, 3)
    last = curve(knots[-1:])[0]
    return ArcLine(np.vstack([sides[:, :2], last]), np.append(sides[:, 2], 0.0))


def _biarcs(
    curve: Curve, starts: FloatArray, ends: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Start and joint ``(k, 2, 2)``, bulges ``(k, 2)`` and errors of a biarc for each part."""
    span = ends - starts
    p, q = curve(starts)[0], curve(ends)[0]
    v = q - p
    tp = _unit(curve(starts + _INSIDE * span)[1], v)
    tq = _unit(curve(ends - _INSIDE * span)[1], v)
    chord = _dot(v, v)
    along = _dot(v, tp + tq)
    lean = along + np.sqrt(along**2 + 2.0 * np.maximum(1.0 - _dot(tp, tq), 0.0) * chord)
    is_sound = (lean > 1e-3 * np.sqrt(chord)) & (chord > 0)
    reach = np.where(is_sound, chord / np.where(is_sound, lean, 1.0), 0.0)[:, None]
    joint = (p + q + reach * (tp - tq)) / 2.0
    # Neither arc is half a circle, as where a curve turns back.
    is_sound &= (_dot(joint - p, tp) > 0) & (_dot(q - joint, tq) > 0)
    bulges = np.column_stack([_half(tp, joint - p), _half(q - joint, tq)])
    error = np.where(is_sound, 0.0, np.sqrt(chord))
    # A circle through a point with a tangent there, of a curvature: how far others lie off it.
    bends = [_bend(bulges[:, 0], joint - p), _bend(bulges[:, 1], q - joint)]
    middle = _unit(joint - p, v) + _unit(q - joint, v)
    for share in _SAMPLES:
        at = curve(starts + share * span)[0]
        is_first = _dot(at - joint, middle) < 0
        off = [_off(at - p, tp, bends[0]), _off(at - q, tq, bends[1])]
        far = np.where(is_sound, np.where(is_first, *off), np.hypot(*(at - p).T))
        error = np.maximum(error, far)
    return np.stack([p, joint], axis=1), np.where(is_sound[:, None], bulges, 0.0), error


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray((a * b).sum(axis=1))


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _unit(vectors: FloatArray, instead: FloatArray) -> FloatArray:
    """Vectors of length 1; where one has none, the other's direction, or none."""
    lengths = np.hypot(*vectors.T)[:, None]
    chosen = np.where(lengths > 0, vectors, instead)
    lengths = np.hypot(*chosen.T)[:, None]
    return np.asarray(chosen / np.where(lengths > 0, lengths, 1.0))


def _half(a: FloatArray, b: FloatArray) -> FloatArray:
    """Bulge of an arc between whose tangent and chord, either first, that angle lies."""
    return np.asarray(np.tan(np.arctan2(_cross(a, b), _dot(a, b)) / 2.0))


def _bend(bulge: FloatArray, chord: FloatArray) -> FloatArray:
    length = np.hypot(*chord.T) * (1.0 + bulge**2)
    return np.asarray(4.0 * bulge / np.where(length > 0, length, 1.0))


def _off(at: FloatArray, tangent: FloatArray, bend: FloatArray) -> FloatArray:
    return np.asarray(np.abs(bend * _dot(at, at) / 2.0 - _cross(tangent, at)))


def _centre(start: FloatArray, end: FloatArray, bulge: float) -> FloatArray:
    chord = end - start
    left = np.array([-chord[1], chord[0]])
    return np.asarray((start + end) / 2.0 + left * (1.0 - bulge**2) / (4.0 * bulge))


def _along(
    start: FloatArray, end: FloatArray, bulge: float, tolerance: float, *, is_outer: bool
) -> FloatArray:
    """Corners between the ends of an arc."""
    radius, sweep = radius_of(start, end, bulge), 4.0 * math.atan(bulge)
    # Either way the largest distance is a half angle's share of the radius.
    half = 2.0 * math.asin(math.sqrt(min(tolerance / (2.0 * radius), 0.25))) if radius else 0.5
    steps = max(1, math.ceil(abs(sweep) / (2.0 * half)))
    if not is_outer:
        return _on_spokes(start, end, bulge, np.arange(1, steps) / steps, 1.0)
    steps = max(steps, math.ceil(abs(sweep) / _WIDEST))
    shares = (np.arange(steps) + 0.5) / steps
    return _on_spokes(start, end, bulge, shares, 1.0 / math.cos(sweep / steps / 2.0))


def radius_of(start: FloatArray, end: FloatArray, bulge: float) -> float:
    """Radius of an arc that is not straight.

    Examples
    --------
    >>> radius_of(np.zeros(2), np.array([4.0, 0.0]), -1.0)
    2.0
    """
    return float(np.hypot(*(end - start))) * (1.0 + bulge**2) / abs(4.0 * bulge)


def divided(start: FloatArray, end: FloatArray, bulge: float, longest_rad: float) -> FloatArray:
    """Ends ``(k, 2)`` of the parts of an arc, each of an angle of ``longest_rad`` at most.

    Examples
    --------
    >>> divided(np.array([1.0, 0.0]), np.array([-1.0, 0.0]), 1.0, 2.0).round(9).tolist()
    [[0.0, 1.0], [-1.0, 0.0]]
    """
    steps = max(1, math.ceil(abs(4.0 * math.atan(bulge)) / longest_rad - 1e-9))
    inner = _on_spokes(start, end, bulge, np.arange(1, steps) / steps, 1.0)
    return np.vstack([inner, end])


def _on_spokes(
    start: FloatArray, end: FloatArray, bulge: float, shares: FloatArray, scale: float
) -> FloatArray:
    """Points at shares of an arc's angle, ``scale`` times as far from its centre as it is."""
    centre, turns = _centre(start, end, bulge), 4.0 * math.atan(bulge) * shares
    x, y = start - centre
    c, s = scale * np.cos(turns), scale * np.sin(turns)
    return np.column_stack([centre[0] + c * x - s * y, centre[1] + s * x + c * y])

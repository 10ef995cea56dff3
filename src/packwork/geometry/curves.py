"""Plane curves as polylines, by their arc length."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from packwork.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve through points ``(n, 2)``, two at least, none of them twice in a row.

    Examples
    --------
    >>> bend = Curve(np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0]]))
    >>> bend.length, bend.at(5.0).tolist()
    (6.0, [4.0, 1.0])
    """

    points: FloatArray

    @cached_property
    def lengths(self) -> FloatArray:
        """``(n,)`` arc length from the first point to each."""
        return np.append(0.0, np.cumsum(np.hypot(*np.diff(self.points, axis=0).T)))

    @property
    def length(self) -> float:
        """Arc length of the whole."""
        return float(self.lengths[-1])

    def at(self, along: FloatArray | float) -> FloatArray:
        """``(..., 2)`` points at arc lengths; beyond an end, straight on."""
        along = np.asarray(along, dtype=np.float64)
        inside = np.clip(along, 0.0, self.length)
        found = np.stack([np.interp(inside, self.lengths, c) for c in self.points.T], axis=-1)
        over = (along - inside)[..., None]
        return np.asarray(found + over * self._headings[np.where(along > 0, -1, 0)])

    def angle(self, along: FloatArray | float, reach: float) -> FloatArray:
        """Headings at arc lengths, radians: of chords from ``reach`` before to ``reach`` after."""
        chord = self.at(np.asarray(along) + reach) - self.at(np.asarray(along) - reach)
        return np.arctan2(chord[..., 1], chord[..., 0])

    def turning(self, start: float, end: float, step: float) -> FloatArray:
        """Turns, radians, from each ``step`` of a stretch to the next."""
        along = np.linspace(start, end, max(3, math.ceil((end - start) / step) + 1))
        angles = np.unwrap(self.angle(along, step / 2))
        return np.diff(angles)

    def shifted(self, across: FloatArray) -> Curve:
        """Curve through points ``across`` ``(n,)`` to the right of the heading of each."""
        x, y = self._normals.T
        return Curve.through(self.points + np.column_stack([x, y]) * across[:, None])

    def reversed(self) -> Curve:
        """The same from its end."""
        return Curve(self.points[::-1])

    @classmethod
    def through(cls, points: FloatArray) -> Curve:
        """Curve through points ``(n, 2)``, less those that are twice in a row."""
        kept = np.append(True, np.hypot(*np.diff(points, axis=0).T) > 0)
        return cls(points[kept])

    @cached_property
    def _headings(self) -> FloatArray:
        """``(n - 1, 2)`` unit vectors from each point to the next."""
        steps = np.diff(self.points, axis=0)
        return np.asarray(steps / np.hypot(*steps.T)[:, None])

    @cached_property
    def _normals(self) -> FloatArray:
        """``(n, 2)`` unit vectors to the right of the heading at each point, y down."""
        edges = self._headings
        sums = np.concatenate([edges[:1], edges[:-1] + edges[1:], edges[-1:]])
        sums /= np.maximum(np.hypot(*sums.T), 1e-12)[:, None]
        return np.column_stack([-sums[:, 1], sums[:, 0]])

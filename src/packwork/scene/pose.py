"""Poses of items: translations, turns, scales and stretches."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
import numpy.typing as npt

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.geometry import affine


def _column(values: npt.ArrayLike, count: int, name: str) -> FloatArray:
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.shape == (count,):
        return numbers
    if numbers.ndim == 0:
        return np.full(count, numbers)
    raise ShapeError(f"poses need as many numbers of {name} as of x ({count}), not {numbers.shape}")


@dataclass(frozen=True, eq=False, init=False)
class Poses:
    """Poses of n items, one array per parameter; a single number is that of all.

    Parameters
    ----------
    x, y
        ``(n,)`` canvas units: where the item's origin (its centroid) lies.
    angle
        ``(n,)`` radians, clockwise on screen.
    scale
        ``(n,)`` canvas units per item unit, positive.
    stretch
        ``(n,)`` width over height of what was square in the item's own frame, before it
        was turned: the paper's elementwise scale is ``scale * sqrt(stretch)`` along the
        item's own x and ``scale / sqrt(stretch)`` along its y, so areas do not depend on
        it. All ones if none are given.

    Raises
    ------
    ShapeError
        If there are not as many of each.

    Examples
    --------
    >>> Poses([1, 2], [5, 5], scale=3).scale.tolist()
    [3.0, 3.0]
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    scale: FloatArray
    stretch: FloatArray

    def __init__(
        self,
        x: npt.ArrayLike,
        y: npt.ArrayLike,
        angle: npt.ArrayLike = 0.0,
        scale: npt.ArrayLike = 1.0,
        stretch: npt.ArrayLike = 1.0,
    ) -> None:
        numbers = np.asarray(x, dtype=np.float64)
        count, put = numbers.size, object.__setattr__
        put(self, "x", _column(numbers, count, "x"))
        put(self, "y", _column(y, count, "y"))
        put(self, "angle", _column(angle, count, "angle"))
        put(self, "scale", _column(scale, count, "scale"))
        put(self, "stretch", _column(stretch, count, "stretch"))

    def __len__(self) -> int:
        return len(self.x)

    def __repr__(self) -> str:
        return f"<Poses: {len(self)}>"

    @property
    def axis_scales(self) -> FloatArray:
        """``(n, 2)`` canvas units per item unit along each item's own x and y.

        Wang and Lu 2025 call them s: P' = r (P * s) + t.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(one, one, one, 3 * one, 4 * one).axis_scales.tolist()
        [[6.0, 1.5]]
        """
        root = np.sqrt(self.stretch)
        return np.column_stack([self.scale * root, self.scale / root])

    def matrix(self, k: int) -> FloatArray:
        """2 x 3 map from the units of item ``k`` to canvas units.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(2 * one, 3 * one, 0 * one, one).matrix(0)[:, 2].tolist()
        [2.0, 3.0]
        """
        place = affine.similarity(
            float(self.x[k]), float(self.y[k]), float(self.angle[k]), float(self.scale[k])
        )
        return affine.compose(place, affine.stretched(float(self.stretch[k])))

    def moved(self, x: float, y: float) -> Poses:
        """Poses moved by so much."""
        return replace(self, x=self.x + x, y=self.y + y)

    def subset(self, items: IntArray) -> Poses:
        """Poses of some items, ``(m,)`` indices.

        Examples
        --------
        >>> x = np.array([5.0, 6.0, 7.0])
        >>> Poses(x, x, x, x).subset(np.array([2, 0])).x.tolist()
        [7.0, 5.0]
        """
        return Poses(*(getattr(self, column.name)[items] for column in fields(Poses)))

    def with_some(self, items: IntArray, poses: Poses) -> Poses:
        """All poses, those of some items, ``(m,)`` indices, replaced.

        Examples
        --------
        >>> x, one = np.array([5.0, 6.0, 7.0]), np.ones(1)
        >>> Poses(x, x, x, x).with_some(np.array([1]), Poses(one, one, one, one)).x.tolist()
        [5.0, 1.0, 7.0]
        """
        columns = {column.name: getattr(self, column.name).copy() for column in fields(Poses)}
        for name, values in columns.items():
            values[items] = getattr(poses, name)
        return Poses(**columns)

    def followed_by(self, poses: Poses) -> Poses:
        """These poses, then others.

        Examples
        --------
        >>> one = Poses(*(np.ones(1),) * 4)
        >>> len(one.followed_by(one))
        2
        """
        both = ((getattr(self, c.name), getattr(poses, c.name)) for c in fields(Poses))
        return Poses(*(np.append(mine, theirs) for mine, theirs in both))
